//! What is said of a module as a whole: `#[symbolic(sizes = …, latex(…))]`.

use proc_macro2::TokenStream;
use syn::parse::Parser;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::{Expr, Token};

use super::{Target, domain, number};
use crate::diagnostics::Diagnostics;
use crate::graph::{Domain, Sizes};

/// What stands in the parentheses of `#[symbolic(…)]`.
#[derive(Clone, Debug, Default)]
pub struct ModuleAttribute {
    /// The words of `latex(…)`, each a name and its symbol.
    pub latex: Vec<Expr>,
    /// Where numbers of some names lie wherever a function takes them: `domain(c.beta <= 2.0)`.
    pub domain: Vec<(Target, Domain)>,
    /// The sizes of the module's numbers: `sizes = 1e-9..=1e9`.
    pub sizes: Sizes,
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
                            let read_all = conditions.filter_map(|word| domain(word, diagnostics));
                            read.domain.extend(read_all);
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
                        other => diagnostics.error_with_hint(
                            other.span(),
                            "`symbolic` takes the sizes and domains of numbers and a table of symbols, and nothing else",
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
