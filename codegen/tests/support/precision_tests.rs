//! Numbers of 77 digits are what they should be.

use super::high_precision::{HighPrecision, is_exact};
use super::tape::{Arithmetic, Binary, Unary};

fn number(value: f64) -> HighPrecision {
    HighPrecision::exactly(value)
}

fn sum(x: &HighPrecision, y: &HighPrecision) -> HighPrecision {
    HighPrecision::binary(Binary::Add, x, y)
}

fn product(x: &HighPrecision, y: &HighPrecision) -> HighPrecision {
    HighPrecision::binary(Binary::Multiply, x, y)
}

fn quotient(x: &HighPrecision, y: &HighPrecision) -> HighPrecision {
    HighPrecision::binary(Binary::Divide, x, y)
}

#[test]
fn every_f64_is_exact() {
    for value in [
        0.0,
        5e-324,
        -1e-310,
        f64::MIN_POSITIVE,
        0.1,
        1e300,
        -f64::MAX,
    ] {
        let twice = sum(&number(value), &number(value));
        let half = quotient(&twice, &number(2.0));
        assert!(
            half.distance(value) <= value.abs() * 1e-70,
            "{value}: {half}"
        );
    }
}

#[test]
fn sizes_beyond_those_of_an_f64_are_known() {
    let large = product(&number(1e300), &number(1e300));
    let one = quotient(&large, &large);
    assert!(one.is_known() && one.distance(1.0) < 1e-70, "{one}");
    let small = quotient(&number(1.0), &product(&large, &large));
    let back = product(&product(&small, &large), &large);
    assert!(back.distance(1.0) < 1e-70, "{back}");
    let tiny = HighPrecision::unary(Unary::Exp, &number(-2000.0));
    assert!(HighPrecision::unary(Unary::Ln, &tiny).distance(-2000.0) < 1e-70);
}

#[test]
fn bounds_hold_what_cancels() {
    let third = quotient(&number(1.0), &number(3.0));
    let three = sum(&sum(&third, &third), &third);
    let nothing = sum(&three, &number(-1.0));
    assert!(
        nothing.is_within(1e-70) && nothing.distance(0.0) < 1e-70,
        "{nothing}"
    );
    assert!(!quotient(&number(1.0), &nothing).is_known());
    let (sine, cosine) = (Unary::Sin, Unary::Cos);
    let [sine, cosine] = [sine, cosine].map(|wave| HighPrecision::unary(wave, &number(1e22)));
    let one = sum(&product(&sine, &sine), &product(&cosine, &cosine));
    assert!(one.distance(1.0) < 1e-70, "{one}");
    assert!(sine.distance(-0.852_200_849_767_188_8) < 1e-15, "{sine}");
}

#[test]
fn literals_are_exact() {
    let tenth = HighPrecision::literal("0.1");
    assert!(product(&tenth, &number(10.0)).distance(1.0) < 1e-70);
    assert!(is_exact("0.25") && is_exact("9007199254740992.0"));
    assert!(!is_exact("0.1") && !is_exact("9007199254740993.0"));
}
