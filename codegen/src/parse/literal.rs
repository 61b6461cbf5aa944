//! The constants of `std::f64::consts`, and those of the type.

use crate::graph::{ExprId, Function, Graph, NamedConstant, Rational, ratio};

/// The names that `std::f64::consts` knows and formulas may use.
pub const CONSTANTS: [&str; 21] = [
    "PI",
    "TAU",
    "FRAC_PI_2",
    "FRAC_PI_3",
    "FRAC_PI_4",
    "FRAC_PI_6",
    "FRAC_PI_8",
    "FRAC_1_PI",
    "FRAC_2_PI",
    "FRAC_2_SQRT_PI",
    "SQRT_2",
    "FRAC_1_SQRT_2",
    "E",
    "LN_2",
    "LN_10",
    "LOG2_E",
    "LOG10_E",
    "GOLDEN_RATIO",
    "LOG2_10",
    "LOG10_2",
    "EULER_GAMMA",
];

/// The exact expression behind a name of `std::f64::consts`.
pub fn constant(graph: &mut Graph, name: &str) -> Option<ExprId> {
    let pi = |graph: &mut Graph, numerator: i64, denominator: i64| {
        let pi = graph.constant(NamedConstant::Pi);
        graph.scale(pi, ratio(numerator, denominator))
    };
    let inverse = |graph: &mut Graph, constant: NamedConstant| {
        let constant = graph.constant(constant);
        graph.power(constant, -1)
    };
    Some(match name {
        "PI" => pi(graph, 1, 1),
        "TAU" => pi(graph, 2, 1),
        "FRAC_PI_2" => pi(graph, 1, 2),
        "FRAC_PI_3" => pi(graph, 1, 3),
        "FRAC_PI_4" => pi(graph, 1, 4),
        "FRAC_PI_6" => pi(graph, 1, 6),
        "FRAC_PI_8" => pi(graph, 1, 8),
        "FRAC_1_PI" => inverse(graph, NamedConstant::Pi),
        "FRAC_2_PI" => {
            let inverse = inverse(graph, NamedConstant::Pi);
            graph.scale(inverse, ratio(2, 1))
        }
        "FRAC_2_SQRT_PI" => {
            let pi = graph.constant(NamedConstant::Pi);
            let root = graph.sqrt(pi);
            let inverse = graph.power(root, -1);
            graph.scale(inverse, ratio(2, 1))
        }
        "SQRT_2" | "FRAC_1_SQRT_2" => {
            let two = graph.integer(2);
            let root = graph.apply(Function::Sqrt, vec![two]);
            if name == "SQRT_2" {
                root
            } else {
                graph.scale(root, ratio(1, 2))
            }
        }
        "E" => graph.constant(NamedConstant::E),
        "LN_2" => graph.constant(NamedConstant::Ln2),
        "LN_10" => graph.constant(NamedConstant::Ln10),
        "LOG2_E" => inverse(graph, NamedConstant::Ln2),
        "LOG10_E" => inverse(graph, NamedConstant::Ln10),
        "LOG2_10" | "LOG10_2" => {
            let [two, ten] = [NamedConstant::Ln2, NamedConstant::Ln10].map(|of| graph.constant(of));
            if name == "LOG2_10" {
                graph.divide(ten, two)
            } else {
                graph.divide(two, ten)
            }
        }
        "EULER_GAMMA" => graph.constant(NamedConstant::EulerGamma),
        "GOLDEN_RATIO" => {
            let five = graph.integer(5);
            let root = graph.sqrt(five);
            let one = graph.one();
            graph.sum([(one, ratio(1, 2)), (root, ratio(1, 2))])
        }
        _ => return None,
    })
}

/// The finite numbers of `f64` that have a name there, such as `f64::EPSILON`.
pub fn of_type(name: &str) -> Option<Rational> {
    let value = match name {
        "EPSILON" => f64::EPSILON,
        "MAX" => f64::MAX,
        "MIN" => f64::MIN,
        "MIN_POSITIVE" => f64::MIN_POSITIVE,
        _ => return None,
    };
    Rational::of_f64(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_listed_constant_is_known() {
        let mut graph = Graph::new();
        assert!(
            CONSTANTS
                .iter()
                .all(|name| constant(&mut graph, name).is_some())
        );
    }

    #[test]
    fn constants_are_those_of_the_standard_library() {
        use std::f64::consts;
        let known = [
            ("PI", consts::PI),
            ("TAU", consts::TAU),
            ("FRAC_PI_2", consts::FRAC_PI_2),
            ("FRAC_PI_3", consts::FRAC_PI_3),
            ("FRAC_PI_4", consts::FRAC_PI_4),
            ("FRAC_PI_6", consts::FRAC_PI_6),
            ("FRAC_PI_8", consts::FRAC_PI_8),
            ("FRAC_1_PI", consts::FRAC_1_PI),
            ("FRAC_2_PI", consts::FRAC_2_PI),
            ("FRAC_2_SQRT_PI", consts::FRAC_2_SQRT_PI),
            ("SQRT_2", consts::SQRT_2),
            ("FRAC_1_SQRT_2", consts::FRAC_1_SQRT_2),
            ("E", consts::E),
            ("LN_2", consts::LN_2),
            ("LN_10", consts::LN_10),
            ("LOG2_E", consts::LOG2_E),
            ("LOG10_E", consts::LOG10_E),
            ("GOLDEN_RATIO", consts::GOLDEN_RATIO),
            ("LOG2_10", consts::LOG2_10),
            ("LOG10_2", consts::LOG10_2),
            ("EULER_GAMMA", consts::EULER_GAMMA),
        ];
        assert_eq!(known.map(|(name, _)| name), CONSTANTS);
        for (name, nearest) in known {
            let mut graph = Graph::as_written();
            let id = constant(&mut graph, name).expect("a constant");
            let found = crate::interpret::evaluate::<f64>(&graph, &[id], &[]);
            let found = found.expect("a value")[0];
            assert!(
                (found - nearest).abs() <= nearest * f64::EPSILON,
                "{name}: {found}"
            );
        }
    }
}
