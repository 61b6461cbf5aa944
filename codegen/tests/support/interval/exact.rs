//! Operations of `f64` with what is known of their rounding.

/// Below this size the rounding error of a product may itself be rounded.
const SMALL: f64 = 1e-280;

/// Below a result that is off by one unit in the last place.
pub fn lowered(value: f64) -> f64 {
    value.next_down().next_down()
}

/// Above a result that is off by one unit in the last place.
pub fn raised(value: f64) -> f64 {
    value.next_up().next_up()
}

/// A sum and whether it is exact.
pub fn exact_sum(a: f64, b: f64) -> (f64, bool) {
    let sum = a + b;
    if a.is_infinite() || b.is_infinite() {
        return (sum, true);
    }
    let part = sum - a;
    let rest = (a - (sum - part)) + (b - part);
    (sum, rest == 0.0)
}

/// A product and whether it is exact.
pub fn exact_product(a: f64, b: f64) -> (f64, bool) {
    let product = a * b;
    let special = a.is_infinite() || b.is_infinite() || a == 0.0 || b == 0.0;
    let rest = a.mul_add(b, -product);
    (product, special || (product.abs() > SMALL && rest == 0.0))
}

/// A quotient and whether it is exact.
pub fn exact_quotient(a: f64, b: f64) -> (f64, bool) {
    let quotient = a / b;
    let special = a.is_infinite() || b.is_infinite() || a == 0.0;
    let rest = quotient.mul_add(-b, a);
    let large = quotient.abs() > SMALL && a.abs() > SMALL;
    (quotient, special || (large && rest == 0.0))
}

/// A root and whether it is exact.
pub fn exact_root(x: f64) -> (f64, bool) {
    let root = x.sqrt();
    let special = x == 0.0 || x.is_infinite();
    (
        root,
        special || (x > SMALL && root.mul_add(root, -x) == 0.0),
    )
}
