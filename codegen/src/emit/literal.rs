//! Numbers as Rust literals.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::graph::Rational;

/// The shortest literal of the `f64` nearest to a constant, with its sign in front.
pub fn number(value: &Rational) -> TokenStream {
    float(value.to_f64().unwrap_or(f64::NAN))
}

/// The shortest literal that reads back to the same bits.
pub fn float(value: f64) -> TokenStream {
    let magnitude = value.abs();
    let sign = value.is_sign_negative().then(|| quote!(-));
    match format!("{magnitude:?}").parse::<Literal>() {
        Ok(literal) => quote!(#sign #literal),
        // No literal stands for infinity or what is not a number.
        Err(_) => {
            let bits = value.to_bits();
            quote!(f64::from_bits(#bits))
        }
    }
}
