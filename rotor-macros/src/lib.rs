//! The door to [`codegen`]: one attribute that hands a module's tokens over and hands tokens back.

use proc_macro::TokenStream;

/// Generates code from the formulas of a module.
///
/// The module is plain Rust over `f64` and stays as it is written. Beside a function with `#[generate(…)]` there is a
/// module of the same name with what was asked for:
///
/// | asked for | generated |
/// |---|---|
/// | `value` | `f::value(…)` |
/// | `gradient(x, c.y)` | `f::gradient(…) -> (value, [f64; 2])`; by every number without a list |
/// | `hessian(x, c.y)` | `f::hessian(…) -> (value, [f64; 2], [[f64; 2]; 2])` |
/// | `columns` | `f::columns(&f::Columns { … }, [&mut …])`, and `f::gradient_columns` where there is a gradient |
/// | `budget(operations = 96, div = 1)` | nothing: more than that is a compile error |
///
/// Formulas call each other, and each other's partials as `f::d_x(…)`, `f::d_x_y(…)`. Further attributes:
///
/// - `#[domain(x >= 0.0, c.y > 0.0)]` says what signs inputs have; rewriting relies on it.
/// - `#[specialise(name, x = y, generate(…))]` makes the function `name` with `x` replaced.
/// - `#[approximate(x = 0.0..=1.0, factor = x.powi(2), tolerance = 1e-13)]` tabulates a costly function of one number, or
///   one written as `integral(|t| …, a..b)`, when the crate is built.
#[proc_macro_attribute]
pub fn symbolic(_attribute: TokenStream, item: TokenStream) -> TokenStream {
    codegen::expand(item.into()).into()
}
