//! Cuts a failing program down to what fails.

use super::comparison::{Failure, Report, Wrong, compare};
use super::points::Inputs;
use super::program::{Kind, Node, Output, Program};
use super::subject::{Missing, Stages, Subject, Wanted};

/// How many programs are tried at most.
const TRIALS: usize = 1500;

/// A program that fails in the same way, cut down, with a failure of it.
pub fn shrunk(program: &Program, failure: &Failure) -> (Program, Failure) {
    if failure.wrong == Wrong::Time {
        return (program.clone(), failure.clone());
    }
    let (program, failure) = cut_down(program, failure, &same_failure);
    with_round_inputs(&program, failure)
}

/// The smallest program that `fails` finds a failure in, one change after the other.
pub fn cut_down(
    program: &Program,
    failure: &Failure,
    fails: &dyn Fn(&Program, &Failure) -> Option<Failure>,
) -> (Program, Failure) {
    let (mut program, mut failure) = (program.clone(), failure.clone());
    let mut trials = 0;
    while trials < TRIALS {
        let smaller = candidates(&program).into_iter().find_map(|candidate| {
            trials += 1;
            let again = (trials < TRIALS).then(|| fails(&candidate, &failure));
            again.flatten().map(|found| (candidate, found))
        });
        match smaller {
            Some(found) => (program, failure) = found,
            None => break,
        }
    }
    (program, failure)
}

/// The failure of a program that is like another.
fn same_failure(program: &Program, failure: &Failure) -> Option<Failure> {
    let wanted = if failure.wrong == Wrong::Panic {
        Wanted::Several {
            hessian: true,
            stages: Stages::All,
            emitted: false,
        }
    } else {
        Wanted::One(failure.form.clone())
    };
    let subject = match Subject::of(&program.source(), &wanted) {
        Ok(subject) => subject,
        Err(Missing::Panicked(text)) if failure.wrong == Wrong::Panic => {
            let failure = failure.clone();
            return Some(Failure { text, ..failure });
        }
        Err(_) => return None,
    };
    let report: Report = compare(&subject, &[(failure.place, failure.inputs)], false);
    let mut failures = report.failures.into_iter();
    failures.find(|found| found.wrong == failure.wrong)
}

/// The same with inputs that are round where that fails, too.
fn with_round_inputs(program: &Program, mut failure: Failure) -> (Program, Failure) {
    for input in 0..failure.inputs.len() {
        for round in [1.0, 2.0, 0.5, 3.0, -1.0, 0.0] {
            let mut inputs: Inputs = failure.inputs;
            inputs[input] = round;
            let moved = Failure {
                inputs,
                ..failure.clone()
            };
            if let Some(found) = same_failure(program, &moved) {
                failure = found;
                break;
            }
        }
    }
    (program.clone(), failure)
}

/// Smaller programs, the smallest first.
fn candidates(program: &Program) -> Vec<Program> {
    let mut candidates = without_parts(program);
    for position in 0..program.count() {
        for replacement in replacements(program, position) {
            let mut candidate = program.clone();
            if let Some((_, node)) = candidate.node_at(position) {
                *node = replacement;
                candidates.push(candidate);
            }
        }
    }
    candidates.sort_by_key(Program::count);
    candidates
}

/// What may stand in the place of a node: something smaller, or a plainer leaf.
fn replacements(program: &Program, position: usize) -> Vec<Node> {
    let mut program = program.clone();
    let Some((in_helper, node)) = program.node_at(position) else {
        return Vec::new();
    };
    let node = node.clone();
    match &node.kind {
        Kind::Name(_) => Vec::new(),
        Kind::Literal(digits) if digits == "1.0" => Vec::new(),
        Kind::Literal(digits) if digits == "2.0" => vec![Node::literal("1.0")],
        Kind::Literal(_) => vec![Node::literal("1.0"), Node::literal("2.0")],
        kind => {
            let mut all = node.parts.clone();
            all.push(Node::literal("1.0"));
            if !in_helper {
                all.push(Node::name("x"));
            }
            if let Kind::Sum(minus) = kind {
                all.extend(shorter_sums(minus, &node.parts));
            }
            if let Kind::Call(_, Some(_)) = kind {
                all.extend(
                    node.parts
                        .first()
                        .map(|part| Node::new(Kind::Method("sin"), vec![part.clone()])),
                );
            }
            all
        }
    }
}

/// A sum of more than two terms without one.
fn shorter_sums(minus: &[bool], parts: &[Node]) -> Vec<Node> {
    if parts.len() < 3 {
        return Vec::new();
    }
    let without = |left_out: usize| {
        let keep = |position: &usize| *position != left_out;
        let positions: Vec<usize> = (0..parts.len()).filter(keep).collect();
        let mut minus: Vec<bool> = positions.iter().map(|place| minus[*place]).collect();
        minus[0] = false;
        let parts = positions.iter().map(|place| parts[*place].clone());
        Node::new(Kind::Sum(minus), parts.collect())
    };
    (0..parts.len()).map(without).collect()
}

/// Programs without a `let` that is not used, with one put where it is used, with one result, without a domain.
fn without_parts(program: &Program) -> Vec<Program> {
    let mut candidates = Vec::new();
    if program.output != Output::Number {
        for result in &program.results {
            candidates.push(Program {
                output: Output::Number,
                results: vec![result.clone()],
                ..program.clone()
            });
        }
    }
    if !program.domain.is_empty() {
        candidates.push(Program {
            domain: Vec::new(),
            ..program.clone()
        });
    }
    for position in 0..program.lets.len() {
        let mut candidate = program.clone();
        let bound = candidate.lets.remove(position);
        if program.uses(&bound.name) {
            for (name, node) in bound.names().iter().zip(&bound.nodes) {
                put_in(&mut candidate, name, node);
            }
        }
        candidates.push(candidate);
    }
    if let Some(last) = program.helpers.len().checked_sub(1) {
        let mut called = false;
        for root in program.roots() {
            root.each(&mut |node| called |= matches!(node.kind, Kind::Call(at, _) if at == last));
        }
        if !called {
            let mut candidate = program.clone();
            candidate.helpers.pop();
            candidates.push(candidate);
        }
    }
    candidates
}

/// Puts an expression in the place of a name.
fn put_in(program: &mut Program, name: &str, node: &Node) {
    let mut position = 0;
    while let Some((in_helper, found)) = program.node_at(position) {
        if !in_helper && found.kind == Kind::Name(name.to_owned()) {
            *found = node.clone();
            position += node.count();
        } else {
            position += 1;
        }
    }
}
