//! Formulas of one system in several files, each of which links those that it needs: a diamond.
#![allow(unreachable_pub, reason = "a formula is `pub` as in a library")]

mod base;
mod left;
mod right;
mod top;

/// What all files take over.
#[rotor_macros::symbolic(sizes = 1e-6..=1e6, domain(s.width > 0.0, s.height > 0.0))]
mod conventions {}

use base::Sides;

const SIDES: Sides = Sides {
    width: 3.0,
    height: 4.0,
};

/// The partials of a function of the sides by central differences.
fn differences(f: impl Fn(&Sides) -> f64) -> [f64; 2] {
    const STEP: f64 = 1e-5;
    let at = |width, height| {
        let Sides {
            width: w,
            height: h,
        } = SIDES;
        f(&Sides {
            width: w + width,
            height: h + height,
        })
    };
    [
        (at(STEP, 0.0) - at(-STEP, 0.0)) / (2.0 * STEP),
        (at(0.0, STEP) - at(0.0, -STEP)) / (2.0 * STEP),
    ]
}

fn assert_close(value: f64, expected: f64) {
    let apart = (value - expected).abs();
    assert!(
        apart <= 1e-8 * expected.abs().max(1.0),
        "{value} beside {expected}"
    );
}

#[test]
fn a_diamond_has_the_values_of_the_functions_as_written() {
    assert_eq!(base::diagonal::value(&SIDES), 5.0);
    assert_close(left::slope::value(&SIDES), left::slope(&SIDES));
    assert_close(right::cost::value(&SIDES), right::cost(&SIDES));
    assert_close(top::merit::value(&SIDES), top::merit(&SIDES));
    assert_close(top::by_paths::value(&SIDES), top::by_paths(&SIDES));
    assert_close(top::by_paths(&SIDES), top::merit(&SIDES));
    assert_close(top::rate::value(&SIDES), top::rate(&SIDES));
    assert_close(top::stretched::value(&SIDES), top::stretched(&SIDES));
}

#[test]
fn gradients_go_through_linked_modules() {
    let (value, gradient) = top::merit::gradient(&SIDES);
    assert_close(value, top::merit(&SIDES));
    for (partial, expected) in gradient.into_iter().zip(differences(top::merit)) {
        assert_close(partial, expected);
    }
    let [expected, _] = differences(base::diagonal);
    assert_close(base::diagonal::d_s_width(&SIDES), expected);
    assert_close(top::rate(&SIDES), expected * top::SCALE * top::SCALE);
}

#[test]
fn columns_of_all_files_have_one_error() -> Result<(), lanes::ColumnLengthError> {
    let inputs = top::merit::Columns {
        s_width: &[3.0, 1.0],
        s_height: &[4.0, 2.0],
    };
    let mut results = [0.0; 2];
    top::merit::columns(&inputs, [&mut results])?;
    assert_close(results[0], top::merit(&SIDES));
    let inputs = base::diagonal::Columns {
        s_width: &[3.0],
        s_height: &[4.0, 2.0],
    };
    let outcome = base::diagonal::columns(&inputs, [&mut results]);
    assert_eq!(outcome.map_err(|error| error.column), Err("s_width"));
    Ok(())
}

#[test]
fn a_linked_table_is_the_one_of_its_module() {
    for tenth in 1..=10 {
        let x = f64::from(tenth) / 10.0;
        assert_eq!(top::twice_arc::value(x), 2.0 * base::arc::value(x));
        let both = top::arc::value(x) + base::arc::value(x);
        assert_close(top::own_and_linked::value(x), both);
        let (_, [slope]) = top::twice_arc::gradient(x);
        let (_, [expected]) = base::arc::gradient(x);
        assert_close(slope, 2.0 * expected);
    }
}
