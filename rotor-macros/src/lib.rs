//! Generates fast code from formulas: put [`macro@symbolic`] on a module of plain functions over `f64`, and say beside each
//! function what you want of it: the value in few operations, the gradient, the Hessian, loops over columns.
//!
//! ```
//! #[rotor_macros::symbolic]
//! mod springs {
//!     /// Energy of a hardening spring.
//!     #[generate(value, gradient(x, stiffness))]
//!     pub fn energy(x: f64, stiffness: f64) -> f64 {
//!         0.5 * stiffness * x.powi(2) * (1.0 + 0.1 * x.powi(2))
//!     }
//! }
//!
//! let (energy, [force, by_stiffness]) = springs::energy::gradient(0.5, 3.0);
//! assert_eq!(energy, springs::energy(0.5, 3.0)); // the function itself is still there
//! assert!((force - 1.575).abs() < 1e-15 && by_stiffness == energy / 3.0);
//! ```
//!
//! Derivatives are exact: formulas are differentiated as formulas while the crate is built, and the value and all partials
//! share their operations. A crate that asks for `columns` or `stage` depends on the crate `lanes`, which runs these loops.
//!
//! Next: [`macro@symbolic`] lists what can be asked for; [`codegen`] describes the language of formulas and its limits; the
//! workspace's `examples/mathieu` is a tutorial.
//!
//! This crate has no logic of its own. It hands the tokens of a module to [`codegen`] and returns what that makes of them.

use proc_macro::TokenStream;

/// Generates code from the formulas of a module.
///
/// The module is plain Rust over `f64` and stays as it is written. Beside a function with `#[generate(…)]` there is a
/// module of the same name with what was asked for:
///
/// | asked for | generated |
/// |---|---|
/// | `value` | `f::value(…)` |
/// | `gradient(x, c.y)` | `f::gradient(…) -> (value, [f64; 2])`; by an array or a struct by all its numbers; without a list by every number that `f` names |
/// | `jacobian(q)` | `f::jacobian(…) -> (value, [[f64; N]; M])` of a result of M numbers, a row for each |
/// | `hessian(x, c.y)` | `f::hessian(…) -> (value, [f64; 2], [[f64; 2]; 2])` |
/// | `columns` | `f::columns(&f::Columns { … }, [&mut …])`, and `f::gradient_columns` where there is a gradient |
/// | `d_x`, `d_x_y` | `f::d_x(…)`, a partial that formulas of other modules call |
/// | `budget(operations = 96, div = 1)` | nothing: more than that in the richest form asked for is a compile error |
///
/// Formulas call each other, and each other's partials as `f::d_x(…)`, `f::d_x_y(…)`. Further attributes:
///
/// - `#[domain(x >= 0.0, c.y <= 2.0)]` says where inputs lie; rewriting relies on their signs, and forms need be right there.
/// - `#[specialise(name, x = y, generate(…))]` makes the function `name` with `x`, a field `c.y` or an element `a[0]` replaced.
/// - `#[approximate(x = 0.0..=1.0, factor = x.powi(2), tolerance = 1e-13)]` tabulates a costly function of one number, or
///   one written as `integral(|t| …, a..b)`, when the crate is built.
///
/// At the module, `#[symbolic(sizes = 1e-9..=1e9, domain(c.beta <= 2.0), latex(omega_bar = "\\varpi"))]` says how large its
/// numbers are, where those of some names lie, and how names are typeset by tools that show formulas. By
/// `#[symbolic(with(super::stiffness))]` it calls the formulas of another module, which may be in another file: see
/// [`codegen`]. By default a generated
/// form is as right as the function as written for every `f64`, and takes the more operations for it.
///
/// # Example
///
/// ```
/// #[rotor_macros::symbolic]
/// mod orbit {
///     /// Distance of a body on an ellipse from the focus, at the eccentric anomaly.
///     #[generate(gradient(anomaly, eccentricity), columns)]
///     pub fn distance(axis: f64, eccentricity: f64, anomaly: f64) -> f64 {
///         axis * (1.0 - eccentricity * anomaly.cos())
///     }
///
///     /// Radial speed over the rate of the anomaly.
///     #[generate(value)]
///     pub fn radial_speed(axis: f64, eccentricity: f64, anomaly: f64) -> f64 {
///         distance::d_anomaly(axis, eccentricity, anomaly)
///     }
/// }
///
/// let (distance, [by_anomaly, by_eccentricity]) = orbit::distance::gradient(2.0, 0.5, 0.0);
/// assert_eq!((distance, by_anomaly, by_eccentricity), (1.0, 0.0, -2.0));
/// assert_eq!(orbit::radial_speed::value(2.0, 0.5, std::f64::consts::FRAC_PI_2), 1.0);
/// // The formula itself is still there.
/// assert_eq!(orbit::distance(2.0, 0.5, 0.0), 1.0);
///
/// let inputs = orbit::distance::Columns { axis: &[1.0, 2.0], eccentricity: &[0.5, 0.5], anomaly: &[0.0, 0.0] };
/// let mut distances = [0.0; 2];
/// orbit::distance::columns(&inputs, [&mut distances])?;
/// assert_eq!(distances, [0.5, 1.0]);
/// # Ok::<(), orbit::ColumnLengthError>(())
/// ```
#[proc_macro_attribute]
pub fn symbolic(attribute: TokenStream, item: TokenStream) -> TokenStream {
    codegen::link::attribute(attribute.into(), item.into()).into()
}

/// Hands the tokens of a module on to the modules that link it. Code that [`macro@symbolic`] has generated calls it.
#[doc(hidden)]
#[proc_macro]
pub fn __linked(tokens: TokenStream) -> TokenStream {
    codegen::link::linked(tokens.into()).into()
}
