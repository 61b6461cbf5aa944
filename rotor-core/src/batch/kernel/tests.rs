use super::*;
use crate::batch::plan::Way;
use crate::batch::statistic::Wanted;
use crate::input::INPUTS;

/// A rotor that has all three regions: the paper's with half the polar inertia.
const BASE: RotorParameters = RotorParameters {
    disk_polar_inertia: 0.105,
    ..RotorParameters::PAPER
};

/// Values of an input around this rotor's at which all regions exist.
fn around(input: &NumericInput) -> Vec<f64> {
    let value = (input.get)(&BASE);
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
    let reduced = kernel.reduce_in_packs(&BASE, speed, &mut reducer, |_| {});
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
    use crate::equations::chain::Formula;
    let depth = NumericInput::find("crack_depth_ratio").unwrap();
    let quantities = [Quantity::SirWidth, Quantity::CirWidth];
    let angle = NumericInput::find("crack_angle").map(Variable::Input);
    let formula = |next: Option<Variable>, quantities| {
        let kernel = Kernel::along([depth.into()], next.map(|next| [next]), quantities);
        let mut formulas = kernel.plan.ways.into_iter().filter_map(|way| match way {
            Way::Formula {
                formula,
                staged: Some(_),
                ..
            } => Some(formula),
            _ => None,
        });
        formulas.next()
    };
    // The next row has the same coefficients: their tables stay.
    assert_eq!(formula(angle, &quantities), Some(Formula::BothWidths));
    // Other coefficients, of which only the compliance varies along the row.
    assert_eq!(formula(None, &quantities), Some(Formula::Widths));
    // The coefficients are there anyway.
    let with_others = [Quantity::SirWidth, Quantity::Gamma];
    assert_eq!(formula(None, &with_others), Some(Formula::BothWidths));
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
            let mut row = BASE;
            // Each input in turn has another value, and the one before it the first again.
            for changed in INPUTS.iter().chain(&INPUTS[..2]) {
                row = BASE;
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

#[test]
fn the_compliance_along_the_depth_is_computed_once_for_all_rows() {
    use crate::equations::chain::Stage::{
        self, Coefficients, CrackCompliance, Stiffness, SupportArm,
    };
    let depth = NumericInput::find("crack_depth_ratio").unwrap();
    let angle = NumericInput::find("crack_angle").map(Variable::Input);
    let quantities = [Quantity::SirWidth, Quantity::ReferenceSpeed];
    let mut kernel = Kernel::along([depth.into()], angle.map(|next| [next]), &quantities);
    let mut row = BASE;
    let mut renewed = |change: fn(&mut RotorParameters)| {
        change(&mut row);
        row_of(&mut kernel, &row, &[0.1, 0.2, 0.3]);
        let update = Some(kernel.row.updates());
        let numbers = [&kernel.of_row, &kernel.blocks[0].numbers];
        let is_new = |stage: &Stage| {
            numbers
                .iter()
                .any(|numbers| numbers.update_of(*stage) == update)
        };
        let all = Stage::ALL.into_iter();
        all.filter(is_new).collect::<Vec<_>>()
    };
    let all = [CrackCompliance, SupportArm, Stiffness, Coefficients];
    assert_eq!(renewed(|_| {}), all);
    assert_eq!(renewed(|row| row.crack_angle = 0.4), []);
    assert_eq!(renewed(|row| row.disk_asymmetry = 0.1), []);
    assert_eq!(renewed(|row| row.disk_mass = 9.0), [Coefficients]);
    let of_loads = [SupportArm, Stiffness, Coefficients];
    assert_eq!(renewed(|row| row.crack_position_ratio = 0.4), of_loads);
    let of_crack = [CrackCompliance, Stiffness, Coefficients];
    assert_eq!(renewed(|row| row.shaft_radius = 0.01), of_crack);
    assert_eq!(renewed(|row| row.disk_polar_inertia = 0.2), [Coefficients]);
    // It varies along the axis.
    assert_eq!(renewed(|row| row.crack_depth_ratio = 0.4), []);
}

#[test]
fn every_input_has_a_column_and_every_closed_quantity_one_of_its_name() {
    for input in &INPUTS {
        assert!(row::column_of(input).is_some(), "{}", input.name);
    }
    for quantity in Quantity::ALL {
        let is_iterated = quantity.needs_speed() || quantity.name().contains("exact");
        assert_eq!(quantity.column().is_some(), !is_iterated, "{quantity}");
    }
}
