use super::*;
use crate::batch::extremes::is_size;
use crate::jeffcott::rotor::Rotor;

/// The least and the greatest value of an input that machines have, of those that matter for the sizes of other numbers.
fn ends(input: &NumericInput) -> Vec<f64> {
    let Sizes { above, below } = input.sizes;
    let allowed = input.allowed.range();
    let ends = match input.name {
        "crack_angle" | "disk_asymmetry" => return vec![(input.get)(&RotorParameters::PAPER)],
        "shaft_poissons_ratio" => [*allowed.start(), *allowed.end()],
        _ => [above.next_up(), below.next_down().min(*allowed.end())],
    };
    assert!(
        ends.iter().all(|end| input.is_of_a_machine(*end)),
        "{}",
        input.name
    );
    ends.into()
}

/// Rotors whose inputs are all at an end of the sizes that machines have.
fn corners() -> Vec<RotorParameters> {
    let mut corners = vec![RotorParameters::PAPER];
    for input in &INPUTS {
        let with = |corner: &RotorParameters| {
            let set = |end| {
                let mut corner = *corner;
                (input.set)(&mut corner, end);
                corner
            };
            ends(input).into_iter().map(set).collect::<Vec<_>>()
        };
        corners = corners.iter().flat_map(with).collect();
    }
    corners
}

/// A scan computes rotors of such sizes in packs, which do not look whether each number on the way is in range.
#[test]
fn sizes_of_machines_take_no_number_out_of_range() {
    for corner in corners() {
        for crack_model in [
            CrackModel::SupportArm,
            CrackModel::MidspanArm,
            CrackModel::SimplySupported,
        ] {
            let Ok(rotor) = Rotor::new(RotorParameters {
                crack_model,
                ..corner
            }) else {
                // The ratio of the inertias is none.
                continue;
            };
            let stiffness = rotor.stiffness().unwrap();
            let c = rotor.coefficients().unwrap();
            let speed = rotor.reference_speed().unwrap();
            let sizes = [
                stiffness.k_tt,
                stiffness.k_mm,
                stiffness.k_tm.abs(),
                c.delta,
                c.gamma.abs(),
                speed,
            ];
            assert!(sizes.into_iter().all(is_size), "{corner:?} {c:?}");
        }
    }
}
