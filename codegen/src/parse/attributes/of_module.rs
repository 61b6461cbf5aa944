//! What is said of a module as a whole: `#[symbolic(sizes = …, latex(…))]`.

use proc_macro2::{Span, TokenStream};
use syn::parse::Parser;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::{Expr, Path, Token};

use super::{Target, domain, number};
use crate::diagnostics::Diagnostics;
use crate::graph::{Domain, Sizes};
use crate::parse::place::Place;

/// What stands in the parentheses of `#[symbolic(…)]`.
#[derive(Clone, Debug, Default)]
pub struct ModuleAttribute {
    /// The words of `latex(…)`, each a name and its symbol.
    pub latex: Vec<Expr>,
    /// Where numbers of some names lie wherever a function takes them: `domain(c.beta <= 2.0)`.
    pub domain: Vec<(Target, Domain)>,
    /// The sizes of the module's numbers: `sizes = 1e-9..=1e9`.
    pub sizes: Sizes,
    /// Whether it has the chain of its formulas and of those that it links.
    pub chain: bool,
    /// The modules whose formulas are known to it: `with(super::stiffness)`.
    pub links: Vec<Link>,
}

/// A module that another one links.
#[derive(Clone, Debug)]
pub struct Link {
    /// The path as written.
    pub path: Path,
    /// Where it leads.
    pub place: Place,
}

impl Link {
    /// Where messages about it stand: at the module's name, the last one of the path.
    pub fn span(&self) -> Span {
        let last = self.path.segments.last();
        last.map_or_else(Span::call_site, |last| last.ident.span())
    }
}

const MODULE: &str = r#"write for example symbolic(sizes = 1e-9..=1e9, latex(speed = "\\Omega", crack_angle = "\\phi"))"#;

impl ModuleAttribute {
    /// Reads the attribute of a module; what can't be read is reported at its place.
    pub fn read(attribute: TokenStream, diagnostics: &mut Diagnostics) -> Self {
        let mut read = Self::default();
        let is = |expression: &Expr, name: &str| matches!(expression, Expr::Path(path) if path.path.is_ident(name));
        match Punctuated::<Expr, Token![,]>::parse_terminated.parse2(attribute) {
            Ok(words) => {
                for word in &words {
                    match word {
                        Expr::Call(call) if is(&call.func, "domain") => {
                            let conditions = call.args.iter();
                            let read_all = conditions.filter_map(|word| domain::read(word, diagnostics));
                            read.domain.extend(read_all);
                        }
                        Expr::Call(call) if is(&call.func, "with") => {
                            read.links.extend(call.args.iter().filter_map(|path| link(path, diagnostics)));
                        }
                        Expr::Call(call) if is(&call.func, "latex") => read.latex.extend(call.args.iter().cloned()),
                        Expr::Assign(assign) if is(&assign.left, "sizes") => match sizes(&assign.right) {
                            Some(sizes) => read.sizes = sizes,
                            None => diagnostics.error_with_hint(
                                assign.right.span(),
                                "not a range of sizes",
                                "sizes are above 0 and finite, and 1 is among them: sizes = 1e-9..=1e9",
                            ),
                        },
                        word if is(word, "chain") => read.chain = true,
                        other => diagnostics.error_with_hint(
                            other.span(),
                            "`symbolic` takes the sizes and domains of numbers, a table of symbols, modules to link and `chain`, and nothing else",
                            MODULE,
                        ),
                    }
                }
            }
            Err(error) => diagnostics.syntax(&error, MODULE),
        }
        read
    }
}

fn link(path: &Expr, diagnostics: &mut Diagnostics) -> Option<Link> {
    if let Expr::Path(syn::ExprPath {
        qself: None, path, ..
    }) = path
        && let Some(place) = Place::of_attribute(path)
    {
        let path = path.clone();
        return Some(Link { path, place });
    }
    diagnostics.error_with_hint(
        path.span(),
        "not the path of a module of this crate",
        "write it as from where the attribute stands: with(super::stiffness)",
    );
    None
}

fn sizes(range: &Expr) -> Option<Sizes> {
    let Expr::Range(syn::ExprRange {
        start: Some(start),
        end: Some(end),
        limits: syn::RangeLimits::Closed(_),
        ..
    }) = range
    else {
        return None;
    };
    let (smallest, largest) = (number(start)?, number(end)?);
    let fits = smallest > 0.0 && smallest <= 1.0 && largest >= 1.0 && largest.is_finite();
    fits.then_some(Sizes::Within { smallest, largest })
}
