//! A piecewise polynomial as Rust source.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::literal::float;
use crate::approximate::piecewise::PiecewisePolynomial;
use crate::cost::Cost;

/// Of so many pieces the numbers are chosen in all rows of a pack at once, if it has eight; else each row looks up its own.
/// It is `lanes::MOST_PIECES`.
const MOST_CHOSEN: usize = 16;

impl PiecewisePolynomial {
    /// The function `fn name(x: f64) -> f64`, which is seen as stated, with the same bits as
    /// [`evaluate`](Self::evaluate).
    ///
    /// `summary` is the first line of its documentation; interval, pieces, degree, tolerance and
    /// measured error follow. The function counts breakpoints, takes one row of a table and
    /// applies Horner's rule: no branch, no panic, and no `mul_add`, which without the
    /// instruction is a slow call. Tables are constants, not statics: whichever part of a crate
    /// the function is compiled into sees its numbers.
    pub fn emit(&self, name: &Ident, visibility: &TokenStream, summary: &str) -> TokenStream {
        let breakpoints = self.breakpoints();
        let inner = &breakpoints[1..breakpoints.len() - 1];
        let pieces = self.coefficients().len();
        let piece_count = Literal::usize_unsuffixed(pieces);
        let row_length = Literal::usize_unsuffixed(self.degree() + 3);
        let rows = self
            .coefficients()
            .iter()
            .enumerate()
            .map(|(piece, coefficients)| {
                let row = [self.center(piece), self.scale(piece)];
                let row = row.iter().chain(coefficients).copied().map(float);
                quote!([#(#row),*])
            });
        let names: Vec<Ident> = (0..=self.degree())
            .map(|power| format_ident!("a{power}"))
            .collect();
        let (constant, rising) = (
            names.first(),
            names.get(1..names.len() - 1).unwrap_or_default(),
        );
        let (first, between) = (names.last(), rising.iter().rev());
        let documentation = self.documentation(summary);
        let lookup = lookup(inner);
        quote! {
            #(#[doc = #documentation])*
            #[inline]
            #visibility fn #name(x: f64) -> f64 {
                /// Per piece: its middle, 2 / its width, and the coefficients of t⁰, t¹, ….
                const PIECES: &[[f64; #row_length]; #piece_count] = &[#(#rows),*];
                #lookup
                let [center, scale, #(#names),*] = PIECES[piece];
                let t = (x - center) * scale;
                let value = #first;
                #(let value = value * t + #between;)*
                value * t + #constant
            }
        }
    }

    /// The function `fn pack_name(x: Pack) -> Pack` with the same bits as `name`, which [`emit`](Self::emit) gives: Horner's
    /// rule, row by row where there are many pieces on which the rows may lie.
    pub fn emit_for_packs(
        &self,
        name: &Ident,
        visibility: &TokenStream,
        pack_name: &Ident,
    ) -> TokenStream {
        let documentation = format!(" [`{name}()`] of each row of a pack.");
        let body = match self.coefficients() {
            [coefficients] => {
                let (center, scale) = (float(self.center(0)), float(self.scale(0)));
                let mut falling = coefficients.iter().rev().copied().map(float);
                let first = falling.next();
                let (rest, one) = (falling, coefficients.len() == 1);
                if one {
                    quote!(0.0 * x + #first)
                } else {
                    quote! {
                        let t = (x - #center) * #scale;
                        let value = #first;
                        #(let value = value * t + #rest;)*
                        value
                    }
                }
            }
            pieces if pieces.len() <= MOST_CHOSEN => {
                let chosen = self.chosen();
                quote! {
                    if ::lanes::Pack::<S>::LENGTH < 8 {
                        return x.map(#name);
                    }
                    #chosen
                }
            }
            _ => quote!(x.map(#name)),
        };
        quote! {
            #[doc = #documentation]
            #[inline(always)]
            #visibility fn #pack_name<S: ::lanes::Simd>(x: ::lanes::Pack<S>) -> ::lanes::Pack<S> {
                #body
            }
        }
    }

    /// Horner's rule in each row with the numbers of its own piece: the bits of the rule row by row.
    fn chosen(&self) -> TokenStream {
        let breakpoints = self.breakpoints();
        let inner = &breakpoints[1..breakpoints.len() - 1];
        let begin_count = Literal::usize_unsuffixed(inner.len());
        let begins = inner.iter().copied().map(float);
        let coefficients = self.coefficients();
        let pieces = 0..coefficients.len();
        let places = [
            pieces.clone().map(|piece| self.center(piece)).collect(),
            pieces.map(|piece| self.scale(piece)).collect(),
        ];
        let of_power = |power: usize| coefficients.iter().map(|row| row[power]).collect();
        let lists = (places.into_iter().chain((0..=self.degree()).map(of_power))).map(
            // The last piece goes on to the end of the list.
            |numbers: Vec<f64>| {
                let last = numbers.last().copied().unwrap_or_default();
                let padded = numbers.into_iter().chain(std::iter::repeat(last));
                let padded = padded.take(MOST_CHOSEN).map(float);
                quote!([#(#padded),*])
            },
        );
        let list_count = Literal::usize_unsuffixed(self.degree() + 3);
        let list_length = Literal::usize_unsuffixed(MOST_CHOSEN);
        let mut falling = (2..self.degree() + 3).rev().map(Literal::usize_unsuffixed);
        let first = falling.next();
        quote! {
            /// Where the second and each further piece begins.
            const BEGINS: &[f64; #begin_count] = &[#(#begins),*];
            /// Of all pieces: their middles, 2 / their widths, and the coefficients of t⁰, t¹, ….
            const LISTS: &[[f64; #list_length]; #list_count] = &[#(#lists),*];
            let pieces = x.pieces(BEGINS);
            let t = (x - pieces.choose(&LISTS[0])) * pieces.choose(&LISTS[1]);
            let value = pieces.choose(&LISTS[#first]);
            #(let value = value * t + pieces.choose(&LISTS[#falling]);)*
            value
        }
    }

    /// Lines of the emitted function's documentation.
    fn documentation(&self, summary: &str) -> Vec<String> {
        let breakpoints = self.breakpoints();
        let [lower, upper] = [breakpoints[0], breakpoints[breakpoints.len() - 1]];
        let pieces = match self.coefficients().len() {
            1 => "1 piece".to_owned(),
            count => format!("{count} pieces"),
        };
        let mut lines = vec![
            format!(" {summary}"),
            String::new(),
            format!(
                " Piecewise polynomial for {lower:?} ≤ x ≤ {upper:?}: {pieces} of degree {}.",
                self.degree()
            ),
        ];
        let accuracy = format!(
            "relative error {:.1e} at most where measured, tolerance {:.1e}.",
            self.largest_error(),
            self.tolerance()
        );
        let slope = format!(
            "Relative error of the fit's first derivative, by |f'| and |f|/width: about {:.1e}.",
            self.derivative_error()
        );
        lines.push(match self.derivative_order() {
            0 => format!(" The fit: {accuracy}"),
            order => format!(" Exact derivative of order {order} of a fit, with {accuracy}"),
        });
        lines.push(format!(" {slope}"));
        lines.push(" Outside that interval the outer piece is continued.".to_owned());
        lines.push(String::new());
        lines.push(self.counts());
        lines
    }
}

impl PiecewisePolynomial {
    /// What one evaluation does: the place within the piece, and Horner's rule.
    fn counts(&self) -> String {
        let cost = Cost {
            add: self.degree() + 1,
            mul: self.degree() + 1,
            ..Cost::default()
        };
        match self.coefficients().len() - 1 {
            0 => format!(" Operations: {cost}."),
            1 => format!(" Operations: {cost}; 1 comparison finds the piece."),
            inner => format!(" Operations: {cost}; {inner} comparisons find the piece."),
        }
    }
}

/// The statements that find the index of the piece at `x`, given where each piece but the first
/// begins.
fn lookup(inner: &[f64]) -> TokenStream {
    if inner.is_empty() {
        return quote!(let piece = 0;);
    }
    let last = Literal::usize_unsuffixed(inner.len());
    let breakpoints = inner.iter().copied().map(float);
    // The count is never more than `last`; the minimum spares the check of the index.
    quote! {
        /// Where the second and each further piece begins.
        const BREAKPOINTS: &[f64; #last] = &[#(#breakpoints),*];
        let begun = BREAKPOINTS.iter().map(|&breakpoint| usize::from(x >= breakpoint));
        let piece = begun.sum::<usize>().min(#last);
    }
}

#[cfg(test)]
mod tests {
    use crate::approximate::piecewise::PiecewisePolynomial;
    use quote::{format_ident, quote};

    include!("polynomial/example.rs");

    /// Values that take a sign, an exponent, an exact integer and all 17 digits.
    fn example() -> PiecewisePolynomial {
        let coefficients = vec![
            vec![0.1 + 0.2, -1.0 / 3.0, 1.2345678901234567e-17, -0.0],
            vec![2.0, 1e22, -5e-324, 0.7],
            vec![-1.0, 0.25, 1.0 / 49.0, 3.5],
        ];
        PiecewisePolynomial::with_rows(vec![0.0, 0.25, 0.5, 1.1], coefficients)
    }

    fn source(polynomial: &PiecewisePolynomial, name: &str) -> String {
        let tokens = polynomial.emit(&format_ident!("{name}"), &quote!(), "Example of a fit.");
        prettyplease::unparse(&syn::parse2(tokens).unwrap())
    }

    #[test]
    fn the_committed_examples_are_what_is_emitted() {
        let single = PiecewisePolynomial::with_rows(vec![0.0, 1.0], vec![vec![1.0, 0.5]]);
        let emitted = source(&example(), "example_fit")
            + &source(&example().derivative(), "example_slope")
            + &source(&single, "example_line");
        assert_eq!(
            emitted,
            include_str!("polynomial/example.rs"),
            "emitted:\n{emitted}"
        );
    }

    #[test]
    fn the_emitted_function_has_the_bits_of_evaluate() {
        let (fit, slope) = (example(), example().derivative());
        for index in -500..1500 {
            let x = f64::from(index) / 1000.0;
            assert_eq!(example_fit(x).to_bits(), fit.evaluate(x).to_bits(), "{x}");
            assert_eq!(
                example_slope(x).to_bits(),
                slope.evaluate(x).to_bits(),
                "{x}"
            );
        }
        for x in [f64::MAX, -1e300, f64::MIN_POSITIVE, 0.25_f64.next_down()] {
            assert_eq!(example_fit(x).to_bits(), fit.evaluate(x).to_bits(), "{x}");
        }
        assert!(example_fit(f64::NAN).is_nan());
        assert_eq!(example_line(1.0), 1.5);
    }
}
