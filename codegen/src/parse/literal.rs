//! The constants of `std::f64::consts`.

use crate::graph::{ExprId, Function, Graph, NamedConstant, ratio};

/// The names that `std::f64::consts` knows and formulas may use.
pub const CONSTANTS: [&str; 18] = [
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
        "GOLDEN_RATIO" => {
            let five = graph.integer(5);
            let root = graph.sqrt(five);
            let one = graph.one();
            graph.sum([(one, ratio(1, 2)), (root, ratio(1, 2))])
        }
        _ => return None,
    })
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
}
