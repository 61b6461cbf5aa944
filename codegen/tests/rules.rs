//! Each rule of the table on both sides of its arrow.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod support;

use codegen::gather::gather;
use codegen::graph::{ExprId, Graph};
use codegen::interpret::evaluate;
use codegen::parse::body::Reader;
use codegen::parse::value::Value;
use codegen::rewrite::rules::{RULES, TRIED};
use codegen::rewrite::{Rule, rewrite};
use codegen::tables::Tables;
use proptest::prelude::Rng;
use proptest::test_runner::{RngAlgorithm, TestRng};
use support::bounded::Bounded;

/// Points at which both sides must be compared.
const POINTS: usize = 250;
const NAMES: [&str; 4] = ["x", "y", "z", "w"];

/// Both sides of a rule in one graph, on a domain.
fn sides(rule: &Rule, given: &str) -> (Graph, ExprId, ExprId) {
    let domain = if given.is_empty() {
        String::new()
    } else {
        format!("#[domain({given})]")
    };
    let Rule {
        pattern, result, ..
    } = rule;
    let parameters = "x: f64, y: f64, z: f64, w: f64";
    let module = support::module(&format!(
        "mod rule {{ {domain} fn pattern({parameters}) -> f64 {{ {pattern} }} fn result({parameters}) -> f64 {{ {result} }} }}"
    ));
    let mut tables = Tables::default();
    let mut reader = Reader::new(&module, &mut tables);
    let mut side = |name: &str| match reader.read(module.function(name).unwrap()) {
        Some(Value::Number(id)) => id,
        other => panic!("{}: {name} is {other:?}", rule.name),
    };
    let (left, right) = (side("pattern"), side("result"));
    let gathered = gather(&reader.graph, &[left, right]);
    (gathered.graph, gathered.roots[0], gathered.roots[1])
}

/// Random numbers of either sign and of sizes around 1, their signs turned where the domain says so.
struct Points {
    random: TestRng,
    signs: Vec<f64>,
}

impl Points {
    fn new(given: &str) -> Self {
        let sign = |name: &&str| {
            let condition = given
                .split(", ")
                .find(|condition| condition.starts_with(*name));
            condition.map_or(
                0.0,
                |condition| if condition.contains('<') { -1.0 } else { 1.0 },
            )
        };
        Self {
            random: TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]),
            signs: NAMES.iter().map(sign).collect(),
        }
    }

    fn next(&mut self) -> Vec<f64> {
        let draw = |sign: &f64| {
            let unit = self.random.next_u64() as f64 / u64::MAX as f64;
            let number: f64 = 6.0 * unit - 3.0;
            if *sign == 0.0 {
                number
            } else {
                sign * number.abs()
            }
        };
        self.signs.iter().map(draw).collect()
    }
}

/// Compares two expressions where the first is finite and well-conditioned. The bounds of rounding say how far apart
/// they may be, and no point counts at which that is more than 1e-12 of the value.
fn assert_equal(graph: &Graph, left: ExprId, right: ExprId, given: &str, what: &str) {
    let mut points = Points::new(given);
    let mut compared = 0;
    for _ in 0..100 * POINTS {
        let at = points.next();
        let symbol = |name: &str| {
            NAMES
                .iter()
                .position(|known| *known == name)
                .map_or(f64::NAN, |i| at[i])
        };
        let symbols: Vec<Bounded> = graph
            .symbols()
            .map(|(_, known)| Bounded::exact(symbol(&known.name)))
            .collect();
        let values = evaluate(graph, &[left, right], &symbols).unwrap();
        let (a, b) = (values[0], values[1]);
        if !a.is_known() || a.error > 1e-13 * a.value.abs() {
            continue;
        }
        assert!(
            b.value.is_finite(),
            "{what}: {} became {} at {at:?}",
            a.value,
            b.value
        );
        if b.error > 1e-12 * a.value.abs() {
            continue;
        }
        assert!(a.agrees(b), "{what}: {a:?} became {b:?} at {at:?}");
        compared += 1;
        if compared == POINTS {
            return;
        }
    }
    panic!("{what}: compared at {compared} points only");
}

/// The expression with the rule applied once, at the node nearest to the root that it takes.
fn applied_once(rule: &Rule, graph: &mut Graph, root: ExprId) -> Option<ExprId> {
    let mut taken = None;
    for id in graph.reachable(&[root]).into_iter().rev() {
        taken = (rule.apply)(graph, id)
            .filter(|next| *next != id)
            .map(|next| (id, next));
        if taken.is_some() {
            break;
        }
    }
    let (node, next) = taken?;
    let source = graph.clone();
    source
        .rebuild(
            graph,
            &[root],
            |_, old, image| if old == node { next } else { image },
        )
        .first()
        .copied()
}

#[test]
fn each_rule_takes_its_own_pattern_and_keeps_its_value() {
    for rule in RULES.iter().chain(TRIED) {
        let (mut graph, left, right) = sides(rule, rule.given);
        assert_equal(&graph, left, right, rule.given, rule.name);
        let next = applied_once(rule, &mut graph, left)
            .unwrap_or_else(|| panic!("{} does not apply", rule.name));
        assert_equal(&graph, left, next, rule.given, rule.name);
    }
}

#[test]
fn each_pattern_becomes_its_stated_result() {
    for rule in RULES {
        let (graph, left, right) = sides(rule, rule.given);
        assert_equal(&graph, left, right, rule.given, rule.name);
        let (rewritten, roots) = rewrite(&graph, &[left, right]);
        assert_eq!(
            rewritten.node(roots[0]),
            rewritten.node(roots[1]),
            "{}: {} does not become {}",
            rule.name,
            rule.pattern,
            rule.result
        );
    }
}

#[test]
fn a_rule_with_a_guard_changes_no_value_where_the_guard_is_not_given() {
    for rule in RULES.iter().filter(|rule| !rule.given.is_empty()) {
        let (mut graph, left, right) = sides(rule, "");
        let (rewritten, roots) = rewrite(&graph, &[left, right]);
        assert_ne!(
            roots[0], roots[1],
            "{}: its result does not need {}",
            rule.name, rule.given
        );
        // Both in one graph, for points of any sign.
        let images = rewritten.rebuild(&mut graph, &roots[..1], |_, _, image| image);
        assert_equal(&graph, left, images[0], "", rule.name);
    }
}

#[test]
fn each_rule_has_a_name_of_its_own() {
    let rules = || RULES.iter().chain(TRIED);
    let names: std::collections::BTreeSet<&str> = rules().map(|rule| rule.name).collect();
    assert_eq!(names.len(), rules().count());
}
