use super::*;
use crate::input::NumericInput;
use crate::input::{Bound, CrackEdge};

fn changed(change: impl FnOnce(&mut RotorParameters)) -> Result<Rotor, InputError> {
    Rotor::default().with(change)
}

#[test]
fn every_input_refuses_what_its_row_does_not_allow() {
    for input in &INPUTS {
        let mut wrong = vec![f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
        for (bound, outside) in [(input.allowed.lower, -1.0), (input.allowed.upper, 1.0)] {
            match bound {
                Bound::Included(end) => {
                    assert!(
                        changed(|p| (input.set)(p, end)).is_ok(),
                        "{} = {end}",
                        input.name
                    );
                    wrong.push(end + 1e-9 * outside);
                }
                Bound::Excluded(end) => wrong.push(end),
                Bound::Finite => {}
            }
        }
        for value in wrong {
            let error = changed(|p| (input.set)(p, value)).expect_err(input.name);
            let InputError::OutOfRange { input: named, .. } = error else {
                panic!("{error}")
            };
            assert_eq!(named.name, input.name);
            assert!(
                error
                    .to_string()
                    .contains(&format!("{} is {value}", input.name))
            );
        }
    }
}

#[test]
fn the_table_reads_and_writes_its_own_field() {
    for (index, input) in INPUTS.iter().enumerate() {
        let mut parameters = RotorParameters::PAPER;
        (input.set)(&mut parameters, 0.125);
        for (other_index, other) in INPUTS.iter().enumerate() {
            let expected = if other_index == index {
                0.125
            } else {
                (other.get)(&RotorParameters::PAPER)
            };
            assert_eq!(
                (other.get)(&parameters),
                expected,
                "{} by {}",
                other.name,
                input.name
            );
        }
        let dotted = format!("{}.{}", input.section, input.key);
        assert_eq!(input.name, dotted.replace('.', "_"));
        assert_eq!(NumericInput::find(&dotted), Some(input));
        assert_eq!(NumericInput::find(input.name), Some(input));
    }
}

#[test]
fn messages_name_the_quantity_the_value_and_what_is_allowed() {
    let messages = [
        changed(|p| p.disk_mass = -1.0),
        changed(|p| p.crack_depth_ratio = 1.5),
        changed(|p| p.crack_angle = f64::NAN),
        changed(|p| p.disk_polar_inertia = 0.5),
    ]
    .map(|rotor| rotor.expect_err("not a rotor").to_string());
    assert_eq!(messages[0], "disk_mass is -1 kg; it must be > 0");
    assert_eq!(
        messages[1],
        "crack_depth_ratio is 1.5; it must be >= 0 and <= 1"
    );
    assert_eq!(messages[2], "crack_angle is NaN rad; it must be finite");
    assert!(
        messages[3].contains("0.5 kg m² / 0.1397 kg m² = 3.579"),
        "{}",
        messages[3]
    );
    assert!(
        messages[3].contains("must be > 0 and <= 2"),
        "{}",
        messages[3]
    );
}

#[test]
fn choices_are_read_by_the_names_they_show() {
    for model in CrackModel::ALL {
        assert_eq!(model.to_string().parse(), Ok(model));
    }
    for edge in CrackEdge::ALL {
        assert_eq!(edge.to_string().parse(), Ok(edge));
    }
    let error = "breathing"
        .parse::<CrackModel>()
        .expect_err("no such model");
    assert_eq!(
        error.to_string(),
        "crack_model is \"breathing\"; it must be one of support-arm, midspan-arm, simply-supported"
    );
}

#[test]
fn a_disk_that_breaks_the_triangle_inequality_is_warned_of() {
    assert_eq!(Rotor::default().warnings(), []);
    let rotor = changed(|p| p.disk_asymmetry = -0.8).expect("valid");
    let [Warning::TriangleInequality { disk_asymmetry, .. }] = rotor.warnings()[..] else {
        panic!("one warning")
    };
    assert_eq!(disk_asymmetry, -0.8);
    assert!(rotor.coefficients().is_ok());
}

#[test]
fn a_full_edge_doubles_the_lateral_compliance_only() {
    let half = Rotor::default().compliance().expect("finite");
    let full = changed(|p| p.crack_edge = CrackEdge::Full)
        .expect("valid")
        .compliance();
    assert_eq!(
        full,
        Ok(CrackCompliance {
            c44: 2.0 * half.c44,
            ..half
        })
    );
}

#[test]
fn without_a_crack_nothing_varies() {
    for model in CrackModel::ALL {
        let rotor = changed(|p| (p.crack_depth_ratio, p.crack_model) = (0.0, model));
        let c = rotor
            .map(|rotor| rotor.coefficients())
            .expect("valid")
            .expect("finite");
        assert_eq!(
            [c.epsilon_1, c.epsilon_12, c.epsilon_2],
            [0.0; 3],
            "{model}"
        );
    }
}

#[test]
fn a_disk_at_midspan_without_a_crack_is_uncoupled() {
    let rotor = changed(|p| (p.disk_position_ratio, p.crack_depth_ratio) = (0.5, 0.0));
    let c = rotor.expect("valid").coefficients().expect("defined");
    assert_eq!([c.gamma, c.epsilon_12], [0.0, 0.0]);
    // k_tt = 48EI/L³ and k_mm = 12EI/L for a beam loaded at midspan.
    let delta = 0.25 * 0.5045_f64.powi(2) * 10.43 / 0.1397;
    assert!(
        ((c.delta - delta) / delta).abs() < 1e-14,
        "{} {delta}",
        c.delta
    );
}

#[test]
fn the_side_of_the_disk_decides_the_loads() {
    // A crack left of the disk and its mirror image right of the mirrored disk are the same rotor,
    // seen from the other support: only the coupling changes its sign.
    let model = CrackModel::SimplySupported;
    let [left, right] = [(0.25, 0.1), (0.75, 0.9)].map(|(disk, crack)| {
        changed(|p| {
            p.crack_model = model;
            (p.disk_position_ratio, p.crack_position_ratio) = (disk, crack);
        })
        .expect("valid")
        .coefficients()
        .expect("finite")
    });
    for (left, right) in [
        (left.gamma, -right.gamma),
        (left.delta, right.delta),
        (left.epsilon_1, right.epsilon_1),
        (left.epsilon_12, right.epsilon_12),
        (left.epsilon_2, right.epsilon_2),
    ] {
        assert!(((left - right) / left).abs() < 1e-12, "{left} {right}");
    }
}

#[test]
fn extreme_inputs_are_an_error_never_nan() {
    for (radius, length, modulus) in [
        (1e-200, 1.0, 1.0),
        (1e200, 1.0, 1.0),
        (1.0, 1e200, 1e-300),
        (1e-90, 1e-200, 1e300),
    ] {
        let rotor = changed(|p| {
            (p.shaft_radius, p.shaft_length, p.shaft_youngs_modulus) = (radius, length, modulus);
        })
        .expect("each is allowed");
        let error = rotor.coefficients().expect_err("out of range");
        assert!(
            error.to_string().contains("range of double precision"),
            "{error}"
        );
    }
}

#[test]
fn a_shaft_without_length_bends_at_the_crack_alone() {
    let rotor = changed(|p| (p.shaft_radius, p.shaft_length) = (1.0, 1e-150)).expect("allowed");
    let compliance = rotor.compliance().expect("in range");
    let c = rotor.coefficients().expect("in range");
    let expected = (compliance.c22 - compliance.c11) / (compliance.c22 + compliance.c11);
    assert!(((c.epsilon_1 - expected) / expected).abs() < 1e-14, "{c:?}");
}
