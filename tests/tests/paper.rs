//! The paper's rotor through the generated forms, one after the other; `rotor-core`'s own tests hold the public
//! functions to the same numbers.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use rotor_core::equations::{self, Coefficients, Stiffness};
use rotor_core::input::RotorParameters;
use rotor_tests::relative_error;

/// Every number has to be within this, relatively.
const TOLERANCE: f64 = 1e-12;
/// The factor of c₄₄ in the paper, E6.
const EDGE_FACTOR: f64 = 32.0;

fn stiffness(p: &RotorParameters) -> Stiffness {
    let compliance = equations::crack_compliance::value(p, EDGE_FACTOR);
    equations::stiffness::value(p, &equations::support_arm(p), &compliance)
}

fn coefficients(p: &RotorParameters) -> Coefficients {
    equations::coefficients::value(p, &stiffness(p))
}

fn assert_numbers(numbers: &[(&str, f64, f64)]) {
    for &(name, value, expected) in numbers {
        let error = relative_error(value, expected);
        assert!(
            error <= TOLERANCE,
            "{name} is {value:.17e}, expected {expected:.17e}, relative error {error:.1e}"
        );
    }
}

#[test]
fn coefficients_and_starts() {
    let p = RotorParameters::PAPER;
    let k = stiffness(&p);
    let c = equations::coefficients::value(&p, &k);
    assert_numbers(&[
        (
            "reference_speed",
            equations::reference_speed::value(&p, &k),
            646.370_057_207_460,
        ),
        ("gamma", c.gamma, -0.910_280_807_137_150),
        ("delta", c.delta, 1.551_667_702_511_51),
        ("epsilon_1", c.epsilon_1, 0.104_413_945_079_092),
        ("epsilon_12", c.epsilon_12, 0.131_256_402_457_810),
        ("epsilon_2", c.epsilon_2, 0.088_111_830_807_858_4),
        (
            "sir_start",
            equations::sir_start::value(&c),
            0.738_865_908_331_634,
        ),
        (
            "cir_start",
            equations::cir_start::value(&c),
            2.553_152_220_635_86,
        ),
    ]);
}

#[test]
fn widths_by_every_form_that_gives_them() {
    for (crack_angle, sir, cir) in [
        (0.0, 0.071_733_101_486_029_8, 0.169_251_711_100_924),
        (FRAC_PI_4, 0.051_459_314_869_268_2, 0.455_838_268_620_553),
        (FRAC_PI_2, 0.012_267_205_257_267_0, 0.622_037_709_923_905),
    ] {
        let p = RotorParameters {
            crack_angle,
            ..RotorParameters::PAPER
        };
        let c = coefficients(&p);
        let (straight_sir, straight_cir) = equations::widths_support_arm::value(&p, EDGE_FACTOR);
        let ((gradient_sir, gradient_cir), _) =
            equations::widths_support_arm::gradient(&p, EDGE_FACTOR);
        // As written, with the crack's integrals computed and not taken from their tables.
        let (written_sir, written_cir) = equations::widths_support_arm(&p, EDGE_FACTOR);
        assert_numbers(&[
            ("sir_width::value", equations::sir_width::value(&c), sir),
            ("cir_width::value", equations::cir_width::value(&c), cir),
            (
                "sir_width::gradient",
                equations::sir_width::gradient(&c).0,
                sir,
            ),
            (
                "cir_width::gradient",
                equations::cir_width::gradient(&c).0,
                cir,
            ),
            ("widths_support_arm::value, sir", straight_sir, sir),
            ("widths_support_arm::value, cir", straight_cir, cir),
            ("widths_support_arm::gradient, sir", gradient_sir, sir),
            ("widths_support_arm::gradient, cir", gradient_cir, cir),
            ("widths_support_arm, sir", written_sir, sir),
            ("widths_support_arm, cir", written_cir, cir),
        ]);
    }
}

#[test]
fn closing_asymmetries_of_section_4() {
    type Closing = fn(&Coefficients) -> f64;
    let closings: [(&str, Closing, [f64; 3]); 2] = [
        (
            "sir",
            equations::sir_zup_asymmetry::value,
            [0.231_640_026_259, 0.274_948_233_096, 0.341_433_987_212],
        ),
        (
            "cir",
            equations::cir_zup_asymmetry::value,
            [0.264_735_880_141, 0.300_689_527_889, 0.350_117_201_772],
        ),
    ];
    for (name, closing, depths) in closings {
        for (crack_position_ratio, depth) in [0.5, 0.4, 0.3].into_iter().zip(depths) {
            let short_of = |crack_depth_ratio: f64| {
                let p = RotorParameters {
                    crack_depth_ratio,
                    crack_position_ratio,
                    ..RotorParameters::PAPER
                };
                closing(&coefficients(&p)) - p.disk_asymmetry
            };
            // Where the root of the secant line lies, which is straight enough over this distance.
            let near = 1e-7;
            let slope = (short_of(depth + near) - short_of(depth - near)) / (2.0 * near);
            let off = short_of(depth) / slope;
            // Twelve digits are given.
            assert!(
                off.abs() <= 0.5e-12 + TOLERANCE * depth,
                "{name} at {crack_position_ratio}: off by {off:.1e}"
            );
        }
    }
}
