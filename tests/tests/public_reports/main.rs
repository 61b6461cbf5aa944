//! Wrong numbers that were publicly reported of other tools, each as a formula of its own.
//!
//! A report stands at its formula: what was seen, of which tool, and where. Right values come from mpmath at 50 digits
//! and more, of the very `f64` that the formula is given, or from what IEEE arithmetic gives operation by operation
//! where a formula is made of roundings. Where the function as written is asserted too, it shows that what is asked of
//! the generated forms is not too much. Of derivatives no more is asked than dual numbers give on the function as written.
#![allow(
    unreachable_pub,
    clippy::approx_constant,
    clippy::eq_op,
    clippy::excessive_precision,
    clippy::manual_clamp,
    reason = "formulas are `pub` as in a library, and written as they were reported"
)]

mod clamped;
mod compensated;
mod digits;
mod literals;
mod range;
mod roots;
mod rules;
mod ties;

/// The same bits, or no number on both sides.
const SAME: f64 = 0.0;
/// Some units in the last place, relative. Zero is asked for exactly, but for its sign.
const CLOSE: f64 = 4e-15;

/// What is compared, what was found, what is right, and how far they may be apart.
type Check = (&'static str, f64, f64, f64);

/// Says of all checks which are off, not of the first only.
fn check(checks: &[Check]) {
    let agree = |found: f64, right: f64, tolerance: f64| {
        if tolerance == SAME {
            found.to_bits() == right.to_bits() || (found.is_nan() && right.is_nan())
        } else {
            (found - right).abs() <= tolerance * right.abs()
        }
    };
    let off: Vec<String> = checks
        .iter()
        .filter(|(_, found, right, tolerance)| !agree(*found, *right, *tolerance))
        .map(|(what, found, right, _)| format!("{what}: {found:e}, right {right:e}"))
        .collect();
    assert!(off.is_empty(), "{}", off.join("; "));
}
