//! Every pass gives something: without it a formula takes more operations. The table of the gains is that of the
//! documentation.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a helper of a test fails as a test does"
)]

use codegen::emit::scalar::Form;
use codegen::factor::extract::Step;
use codegen::factor::passes::{Pass, Passes};
use codegen::show;

const CHEMISTRY: &str = include_str!("../../benches/corpus/chemistry.rs");
const GEOMETRY: &str = include_str!("../../benches/corpus/geometry.rs");
const ROBOTICS: &str = include_str!("../../benches/corpus/robotics.rs");
const SMALL: &str = include_str!("formulas/passes.rs");

/// A pass, a formula and its form, and the weight of its operations with the pass and without it.
type Row = (Pass, &'static str, &'static str, Form, [usize; 2]);

/// What each pass gives.
const GAINS: [Row; 21] = {
    use Form::{Gradient, Value};
    [
        (Pass::Held, CHEMISTRY, "peng_robinson", Gradient, [105, 112]),
        (Pass::Identities, SMALL, "disguised_one", Value, [0, 5]),
        (Pass::Forward, GEOMETRY, "circumradius", Gradient, [60, 77]),
        (
            Pass::Homogeneous,
            GEOMETRY,
            "determinant_4",
            Gradient,
            [123, 127],
        ),
        (
            Pass::RootsOfQuotients,
            SMALL,
            "inverse_roots",
            Gradient,
            [46, 71],
        ),
        (
            Pass::CommonFactors,
            ROBOTICS,
            "reprojection_error",
            Gradient,
            [47, 55],
        ),
        (Pass::JoinedRoots, SMALL, "geometric_mean", Value, [12, 22]),
        (
            Pass::Exponentials,
            SMALL,
            "powers_of_exponential",
            Value,
            [31, 63],
        ),
        (
            Pass::Exponentials,
            SMALL,
            "product_of_exponentials",
            Value,
            [21, 41],
        ),
        (
            Pass::Step(Step::Factors),
            CHEMISTRY,
            "peng_robinson",
            Gradient,
            [105, 106],
        ),
        (
            Pass::Step(Step::SharedFactors),
            SMALL,
            "polynomial_and_slope",
            Value,
            [14, 16],
        ),
        (
            Pass::Step(Step::Products),
            CHEMISTRY,
            "lennard_jones",
            Gradient,
            [23, 57],
        ),
        (
            Pass::Step(Step::Sums),
            GEOMETRY,
            "circumradius",
            Gradient,
            [60, 64],
        ),
        (
            Pass::Step(Step::Multiples),
            ROBOTICS,
            "quaternion_rotation",
            Gradient,
            [84, 87],
        ),
        (
            Pass::Step(Step::Coefficients),
            ROBOTICS,
            "quaternion_rotation",
            Gradient,
            [84, 90],
        ),
        (
            Pass::Step(Step::Distribute),
            ROBOTICS,
            "quaternion_rotation",
            Gradient,
            [84, 94],
        ),
        (
            Pass::Repeats,
            ROBOTICS,
            "quaternion_rotation",
            Gradient,
            [84, 86],
        ),
        (
            Pass::LoneDivisors,
            GEOMETRY,
            "circumradius",
            Gradient,
            [60, 65],
        ),
        (
            Pass::SharedMultiples,
            CHEMISTRY,
            "peng_robinson",
            Gradient,
            [105, 107],
        ),
        (
            Pass::Quotients,
            GEOMETRY,
            "circumradius",
            Gradient,
            [60, 64],
        ),
        (Pass::Written, SMALL, "size_and_cube", Value, [2, 4]),
    ]
};

/// The weight of a form's operations.
fn weight(source: &str, name: &str, form: Form, passes: Passes) -> usize {
    let mut expansion = show::module(source).unwrap().with_passes(passes);
    expansion.read_only(name);
    let function = expansion.module().function(name).cloned().unwrap();
    let request = function.request.clone().unwrap();
    let by = request.gradient.unwrap_or_default();
    let generated = expansion.generate(&function, form, &by).unwrap();
    generated.circuit.cost().weight()
}

#[test]
fn every_pass_saves_operations() {
    for (pass, source, name, form, [with, without]) in GAINS {
        let found =
            [Passes::ALL, Passes::without(pass)].map(|passes| weight(source, name, form, passes));
        assert_eq!(found, [with, without], "{pass:?}: {name}");
        assert!(with < without, "{pass:?} saves nothing in {name}");
    }
}

#[test]
fn the_gains_are_documented() {
    let text = include_str!("../src/factor/passes.rs");
    for (pass, _, name, form, [with, without]) in GAINS {
        let pass = match pass {
            Pass::Step(step) => format!("Step::{step:?}"),
            other => format!("Pass::{other:?}"),
        };
        let row = format!(
            "//! | [`{pass}`] | `{name}`, {} | {with} | {without} |",
            form.name()
        );
        assert!(text.contains(&row), "not in the documentation: {row}");
    }
}
