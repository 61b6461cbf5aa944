use super::*;
use crate::batch::statistic::Wanted;

/// Values of an input around the paper's at which both regions exist.
fn around(input: &NumericInput) -> Vec<f64> {
    let value = (input.get)(&RotorParameters::PAPER);
    let value = if input.name == "crack_angle" {
        1.0
    } else {
        value
    };
    (0..11)
        .map(|step| value * (0.95 + 0.01 * f64::from(step)))
        .collect()
}

/// Whether the quantities of a block along a variable, inside of another, are reduced without a column of them.
fn is_reduced_in_packs(
    variable: Variable,
    values: &[f64],
    next: Option<Variable>,
    quantities: &[Quantity],
) -> bool {
    let mut kernel = Kernel::along([variable], next.map(|next| [next]), quantities);
    kernel.enter(0, values.len(), |_, filled| filled.copy_from_slice(values));
    let mut reducer = Reducer::new(Wanted::default(), &[], quantities.len());
    let speed = (variable != Variable::Speed).then_some(0.9);
    let reduced = kernel.reduce_in_packs(&RotorParameters::PAPER, speed, &mut reducer, |_| {});
    let all = (0..quantities.len()).all(|quantity| reducer.summary(quantity).is_some());
    reduced.is_some() && all
}

#[test]
fn every_quantity_is_reduced_where_it_arises_along_every_variable() {
    let angle = NumericInput::find("crack_angle").map(Variable::Input);
    let length = NumericInput::find("shaft_length").map(Variable::Input);
    for quantity in Quantity::ALL {
        for next in [None, angle, length] {
            for input in &INPUTS {
                let reduced = is_reduced_in_packs(input.into(), &around(input), next, &[quantity]);
                assert!(reduced, "{quantity} along {} in {next:?}", input.name);
            }
            let speeds = [0.5, 0.9, 1.1, 1.4];
            assert!(is_reduced_in_packs(
                Variable::Speed,
                &speeds,
                next,
                &[quantity]
            ));
        }
    }
    assert!(is_reduced_in_packs(
        Variable::Speed,
        &[0.5, 0.9],
        None,
        &Quantity::ALL
    ));
}

#[test]
fn where_a_point_has_no_region_columns_are_needed() {
    let polar = NumericInput::find("disk_polar_inertia").map(Variable::Input);
    let values = [0.2, 0.25, 0.3];
    let asked = [Quantity::CirWidth];
    assert!(is_reduced_in_packs(
        polar.unwrap(),
        &values[..2],
        None,
        &asked
    ));
    assert!(!is_reduced_in_packs(polar.unwrap(), &values, None, &asked));
}

#[test]
fn widths_are_computed_as_suits_the_next_row() {
    let depth = NumericInput::find("crack_depth_ratio").unwrap();
    let quantities = [Quantity::SirWidth, Quantity::CirWidth];
    let angle = NumericInput::find("crack_angle").map(Variable::Input);
    let along = |widths: Option<Variable>, quantities| {
        Kernel::along([depth.into()], widths.map(|next| [next]), quantities).widths
    };
    assert_eq!(along(angle, &quantities), Some(Widths::FromCoefficients));
    assert_eq!(along(None, &quantities), Some(Widths::FromCompliance));
    let with_others = [Quantity::SirWidth, Quantity::Gamma];
    assert_eq!(along(None, &with_others), Some(Widths::FromCoefficients));
}

/// The bits of all quantities of a row along an input.
fn row_of(kernel: &mut Kernel<'_>, row: &RotorParameters, values: &[f64]) -> Vec<Vec<u64>> {
    kernel.enter(0, values.len(), |_, filled| filled.copy_from_slice(values));
    let mut results = vec![vec![f64::NAN; values.len()]; kernel.quantities.len()];
    let mut slices: Vec<_> = results.iter_mut().map(Vec::as_mut_slice).collect();
    kernel.evaluate(row, None, &mut slices);
    let bits = |column: Vec<f64>| column.into_iter().map(f64::to_bits).collect();
    results.into_iter().map(bits).collect()
}

#[test]
fn a_kernel_that_has_seen_other_rows_answers_as_a_new_one() {
    let closed = Quantity::ALL
        .into_iter()
        .filter(|quantity| !quantity.needs_speed());
    let closed: Vec<_> = closed.collect();
    let widths = [Quantity::SirWidth, Quantity::CirWidth];
    for (inner, quantities) in INPUTS
        .iter()
        .flat_map(|input| [(input, &closed[..]), (input, &widths[..])])
    {
        let values = around(inner);
        for next in [None, Some([Variable::from(&INPUTS[11])])] {
            let new = || Kernel::along([inner.into()], next, quantities);
            let mut seen = new();
            let mut row = RotorParameters::PAPER;
            // Each input in turn has another value, and the one before it the paper's again.
            for changed in INPUTS.iter().chain(&INPUTS[..2]) {
                row = RotorParameters::PAPER;
                (changed.set)(&mut row, around(changed)[9]);
                assert_eq!(
                    row_of(&mut seen, &row, &values),
                    row_of(&mut new(), &row, &values),
                    "along {} after {}",
                    inner.name,
                    changed.name
                );
            }
            // Of the same values fewer.
            let (few, all) = (&values[..3], &values);
            for part in [few, all, few] {
                assert_eq!(
                    row_of(&mut seen, &row, part),
                    row_of(&mut new(), &row, part)
                );
            }
        }
    }
}
