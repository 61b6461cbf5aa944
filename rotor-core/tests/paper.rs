//! The paper's rotor, to the digits that an independent high-precision program gives.
#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use approx::assert_relative_eq;
use rotor_core::input::RotorParameters;
use rotor_core::jeffcott::region::{Region, RegionKind};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::jeffcott::zup::{zup_depth, zup_position};
use rotor_core::quantity::Quantity;
use rotor_core::study::evaluate;

fn paper() -> Rotor {
    Rotor::new(RotorParameters::PAPER).expect("the paper's rotor is valid")
}

fn at_angle(angle: f64) -> Rotor {
    paper()
        .with(|p| p.crack_angle = angle)
        .expect("every angle is valid")
}

fn assert_quantities(rotor: &Rotor, expected: &[(Quantity, f64)]) {
    let quantities: Vec<_> = expected.iter().map(|&(quantity, _)| quantity).collect();
    for (&(quantity, expected), value) in expected.iter().zip(evaluate(&quantities, rotor)) {
        let value = value.unwrap_or_else(|reason| panic!("{quantity}: {reason}"));
        assert!(
            ((value - expected) / expected).abs() <= 1e-12,
            "{quantity} is {value:.17e}, expected {expected:.17e}, relative error {:.2e}",
            (value - expected) / expected
        );
    }
}

#[test]
fn coefficients_and_starts() {
    assert_quantities(
        &paper(),
        &[
            (Quantity::ReferenceSpeed, 646.370_057_207_460),
            (Quantity::Gamma, -0.910_280_807_137_150),
            (Quantity::Delta, 1.551_667_702_511_51),
            (Quantity::Epsilon1, 0.104_413_945_079_092),
            (Quantity::Epsilon12, 0.131_256_402_457_810),
            (Quantity::Epsilon2, 0.088_111_830_807_858_4),
            (Quantity::SirStart, 0.738_865_908_331_634),
            (Quantity::CirStart, 2.553_152_220_635_86),
        ],
    );
}

#[test]
fn widths_at_three_angles() {
    for (angle, sir, cir) in [
        (0.0, 0.071_733_101_486_029_8, 0.169_251_711_100_924),
        (FRAC_PI_4, 0.051_459_314_869_268_2, 0.455_838_268_620_553),
        (FRAC_PI_2, 0.012_267_205_257_267_0, 0.622_037_709_923_905),
    ] {
        assert_quantities(
            &at_angle(angle),
            &[(Quantity::SirWidth, sir), (Quantity::CirWidth, cir)],
        );
    }
}

#[test]
fn exact_widths_at_three_angles() {
    for (angle, sir, cir) in [
        (0.0, 0.071_717_218_471_143_5, 0.161_459_624_167_992),
        (FRAC_PI_4, 0.050_679_790_013_384_0, 0.437_756_256_567_587),
        (FRAC_PI_2, 0.011_839_955_422_267_4, 0.595_705_456_648_044),
    ] {
        let c = at_angle(angle)
            .coefficients()
            .expect("the paper's rotor has coefficients");
        for (kind, expected) in [(RegionKind::Simple, sir), (RegionKind::Combination, cir)] {
            let ends = Region::of(kind, &c)
                .expect("the paper's rotor has both regions")
                .exact_ends()
                .expect("the paper's rotor has both regions");
            // The width is a difference of two numbers that each have all digits.
            assert!(
                (ends.width() - expected).abs() <= 1e-12 * expected.max(1e-3 * ends.upper),
                "{kind} at {angle}: {:.17e}, expected {expected:.17e}, error {:.2e}",
                ends.width(),
                ends.width() - expected
            );
        }
    }
}

#[test]
fn closing_depths_of_section_4() {
    for (kind, expected) in [
        (
            RegionKind::Simple,
            [0.231_640_026_259, 0.274_948_233_096, 0.341_433_987_212],
        ),
        (
            RegionKind::Combination,
            [0.264_735_880_141, 0.300_689_527_889, 0.350_117_201_772],
        ),
    ] {
        for (position, expected) in [0.5, 0.4, 0.3].into_iter().zip(expected) {
            let rotor = paper()
                .with(|p| p.crack_position_ratio = position)
                .expect("valid");
            let points = zup_depth(&rotor, kind).expect("both regions exist");
            let [point] = points[..] else {
                panic!("{kind} at {position}: {points:?}")
            };
            // Twelve digits are given.
            assert_relative_eq!(
                point.value,
                expected,
                epsilon = 0.5e-12,
                max_relative = 1e-12
            );
            let angle = if kind == RegionKind::Simple {
                FRAC_PI_2
            } else {
                0.0
            };
            assert_eq!(point.crack_angle.to_bits(), angle.to_bits());
        }
    }
}

#[test]
fn closing_positions_invert_closing_depths() {
    for (kind, depth, position) in [
        (RegionKind::Simple, 0.274_948_233_096, 0.4),
        (RegionKind::Combination, 0.350_117_201_772, 0.3),
    ] {
        let rotor = paper()
            .with(|p| p.crack_depth_ratio = depth)
            .expect("valid");
        let points = zup_position(&rotor, kind).expect("both regions exist");
        assert!(
            points
                .iter()
                .any(|point| (point.value - position).abs() < 1e-11),
            "{kind}: {points:?}"
        );
    }
}
