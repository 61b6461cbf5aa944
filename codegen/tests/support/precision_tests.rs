//! Numbers of 77 digits are what they should be.

use super::high_precision::{HighPrecision, is_exact};
use super::interval::functions::slack;
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

/// A function with that of the standard library.
type WithStandard = (Unary, fn(f64) -> f64);

const OF_ONE: [WithStandard; 15] = [
    (Unary::Asin, f64::asin),
    (Unary::Acos, f64::acos),
    (Unary::Atan, f64::atan),
    (Unary::Sinh, f64::sinh),
    (Unary::Cosh, f64::cosh),
    (Unary::Tanh, f64::tanh),
    (Unary::Asinh, f64::asinh),
    (Unary::Acosh, f64::acosh),
    (Unary::Atanh, f64::atanh),
    (Unary::ExpM1, f64::exp_m1),
    (Unary::Ln1p, f64::ln_1p),
    (Unary::Cbrt, f64::cbrt),
    (Unary::Log10, f64::log10),
    (Unary::Log2, f64::log2),
    (Unary::Exp2, f64::exp2),
];

/// Numbers of many sizes, and some beside the edges of functions.
fn arguments() -> impl Iterator<Item = f64> {
    let sizes = (-300..=300).map(|n| 1.37 * 10.0_f64.powf(f64::from(n) / 20.0));
    let edges = (1..53).map(|n| 1.0 - 2.0_f64.powi(-n));
    sizes.chain(edges).flat_map(|x| [x, -x, x.recip()])
}

#[test]
fn the_standard_library_is_as_right_as_is_said() {
    for (function, value) in OF_ONE {
        let mut compared = 0;
        for x in arguments() {
            let (nearest, truth) = (value(x), HighPrecision::unary(function, &number(x)));
            // A bound of smaller numbers is none.
            if !truth.is_known() || !(1e-240..1e300).contains(&nearest.abs()) {
                continue;
            }
            let (places, beside) = slack(function, x);
            let allowed = f64::from(places) * (nearest.abs().next_up() - nearest.abs()) + beside;
            assert!(
                truth.is_within(nearest.abs() * 1e-60) && truth.distance(nearest) <= allowed,
                "{function:?} of {x:e}: {nearest:e}, {truth}"
            );
            compared += 1;
        }
        assert!(compared > 200, "{function:?}: {compared}");
    }
}

#[test]
fn functions_undo_each_other() {
    let pairs = [
        (Unary::Asin, Unary::Sin),
        (Unary::Acos, Unary::Cos),
        (Unary::Atan, Unary::Tan),
        (Unary::Asinh, Unary::Sinh),
        (Unary::Atanh, Unary::Tanh),
        (Unary::Ln1p, Unary::ExpM1),
    ];
    for (inverse, function) in pairs {
        for x in [0.7, -0.2, 1e-12, 0.999] {
            let there = HighPrecision::unary(inverse, &number(x));
            let back = HighPrecision::unary(function, &there);
            assert!(
                back.is_within(1e-60) && back.distance(x) < 1e-60,
                "{function:?} {x}: {back}"
            );
        }
    }
    let cosh = HighPrecision::unary(
        Unary::Cosh,
        &HighPrecision::unary(Unary::Acosh, &number(1.25)),
    );
    assert!(cosh.distance(1.25) < 1e-60, "{cosh}");
    let root = HighPrecision::unary(Unary::Cbrt, &number(-5.0));
    assert!(product(&product(&root, &root), &root).distance(-5.0) < 1e-60);
    let power = HighPrecision::binary(Binary::Powf, &number(-2.0), &number(-3.0));
    assert!(power.distance(-0.125) < 1e-60, "{power}");
    let length = HighPrecision::binary(Binary::Hypot, &number(3e200), &number(-4e200));
    assert!(length.distance(5e200) < 1e185, "{length}");
    for (y, x) in [(1.0, -2.0), (-3.0, -2.0), (4.0, 3.0), (-5.0, 0.25)] {
        let angle = HighPrecision::binary(Binary::Atan2, &number(y), &number(x));
        let tangent = HighPrecision::unary(Unary::Tan, &angle);
        assert!(product(&tangent, &number(x)).distance(y) < 1e-60, "{angle}");
        assert!(angle.distance(y.atan2(x)) < 1e-15, "{angle}");
    }
}

#[test]
fn jumps_are_where_they_are() {
    for (x, floor, ceil, round, trunc) in [
        (2.5, 2.0, 3.0, 3.0, 2.0),
        (-2.5, -3.0, -2.0, -3.0, -2.0),
        (4.0, 4.0, 4.0, 4.0, 4.0),
        (0.4, 0.0, 1.0, 0.0, 0.0),
        (-0.6, -1.0, 0.0, -1.0, 0.0),
    ] {
        let expected = [
            (Unary::Floor, floor),
            (Unary::Ceil, ceil),
            (Unary::Round, round),
            (Unary::Trunc, trunc),
        ];
        for (function, expected) in expected {
            let found = HighPrecision::unary(function, &number(x));
            assert!(
                found.is_known() && found.distance(expected) == 0.0,
                "{function:?} {x}: {found}"
            );
        }
    }
    // A third three times may be 1 or beside it.
    let third = quotient(&number(1.0), &number(3.0));
    let one = sum(&sum(&third, &third), &third);
    assert!(!HighPrecision::unary(Unary::Floor, &one).is_known());
}
