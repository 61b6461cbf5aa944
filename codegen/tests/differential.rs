//! Random programs over the whole language: what is generated is at least as right as the function as written. The truth
//! is known to 77 digits, the error of the function as written by bounds that run along.
//!
//! `FUZZ_PROGRAMS=1000000 FUZZ_SEED=7 cargo test --release -p codegen --test differential -- --nocapture` for a long run on
//! all cores, `FUZZ_SHOWN=50` for as many failures cut down, `FUZZ_SEED=7 FUZZ_FIRST=123 FUZZ_PROGRAMS=1` for one program.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::print_stdout,
    unreachable_pub,
    reason = "a test fails by panicking, and a long run says what it did"
)]

mod support {
    pub mod comparison;
    pub mod derivative;
    pub mod high_precision;
    pub mod hostile;
    pub mod interval;
    pub mod points;
    mod precision_tests;
    pub mod program;
    pub mod recorder;
    pub mod shrink;
    pub mod size;
    pub mod subject;
    pub mod tape;
}

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Duration;

use support::comparison::{Failure, Report, Wrong, compare};
use support::hostile::{Random, program};
use support::points::{Inputs, Place, points};
use support::program::{Kind, Node, Output, Program};
use support::shrink::{cut_down, shrunk};
use support::subject::{Code, Missing, Stages, Subject, Wanted};

/// Programs of the test as it runs every day.
const PROGRAMS: usize = 2000;
/// One program in as many is also looked at as tokens.
const EMITTED: usize = 10;
/// One program in as many has every number compared with 77 digits.
const WITH_TRUTH: usize = 16;
/// One program in as many is also looked at in stages along each of its inputs, but in a long run all are along two of them:
/// all would take half of the time.
const STAGED: usize = 5;
/// How long a program may take.
const PATIENCE: Duration = Duration::from_secs(10);
/// After so many programs on which the generator does not end there is no time for others.
const MOST_LEFT_BEHIND: usize = 2;

fn from_environment(name: &str) -> Option<usize> {
    std::env::var(name).ok()?.parse().ok()
}

/// A failure with where it was found.
struct Failing {
    number: usize,
    program: Program,
    failure: Failure,
}

/// What came of a run.
#[derive(Default)]
struct Run {
    programs: usize,
    refused: BTreeMap<String, usize>,
    report: Report,
    failing: Vec<Failing>,
}

impl Run {
    fn refusals(&self) -> usize {
        self.refused.values().sum()
    }

    fn add(&mut self, case: &Case, outcome: Result<Report, String>) {
        self.programs += 1;
        match outcome {
            Ok(mut report) => {
                let failures = std::mem::take(&mut report.failures);
                self.report.add(report);
                // One failure of each kind is enough: what is wrong in a form is often wrong in the next.
                let mut seen: Vec<Wrong> = Vec::new();
                for failure in failures {
                    if !seen.contains(&failure.wrong) {
                        seen.push(failure.wrong);
                        self.failing.push(Failing {
                            number: case.number,
                            program: case.program.clone(),
                            failure,
                        });
                    }
                }
            }
            Err(message) => *self.refused.entry(message).or_default() += 1,
        }
    }

    fn summary(&self) -> String {
        format!(
            "{} programs, {} refused, {} values and {} derivatives compared, {} of them with 77 digits, {} not certain, largest ratio {:.1}, {} failures",
            self.programs,
            self.refusals(),
            self.report.values,
            self.report.derivatives,
            self.report.with_truth,
            self.report.unknown,
            self.report.largest,
            self.failing.len()
        )
    }
}

/// A program and where it is looked at.
struct Case {
    number: usize,
    program: Program,
    points: Vec<(Place, Inputs)>,
}

impl Case {
    /// That of this number.
    fn new(seed: u64, number: usize) -> Self {
        let mut random = Random::new(seed ^ (number as u64).wrapping_mul(0xd134_2543_de82_ef95));
        let program = program(&mut random);
        let points = points(&mut random, &program);
        Self {
            number,
            program,
            points,
        }
    }
}

/// What comes of a program; the message where it is refused.
fn checked(case: &Case, in_full: bool) -> Result<Report, String> {
    let Case {
        program,
        points,
        number,
    } = case;
    let wanted = Wanted::Several {
        hessian: true,
        stages: if in_full {
            Stages::InTurn(*number)
        } else if number.is_multiple_of(STAGED) {
            Stages::All
        } else {
            Stages::None
        },
        emitted: number.is_multiple_of(EMITTED),
    };
    match Subject::of(&program.source(), &wanted) {
        Ok(subject) => Ok(compare(&subject, points, number.is_multiple_of(WITH_TRUTH))),
        Err(Missing::Refused(message)) => Err(message),
        Err(Missing::Panicked(text)) => Ok(Report::of_failure(Wrong::Panic, points[0].1, text)),
    }
}

/// Checks programs in a thread of its own, so that one on which the generator does not end can be left behind.
struct Worker {
    numbers: Sender<usize>,
    outcomes: Receiver<Result<Report, String>>,
}

impl Worker {
    fn new(seed: u64, in_full: bool) -> Self {
        let (numbers, of_number) = channel();
        let (of_outcome, outcomes) = channel();
        std::thread::spawn(move || {
            for number in of_number {
                let outcome = checked(&Case::new(seed, number), in_full);
                // It may have been left behind.
                if of_outcome.send(outcome).is_err() {
                    break;
                }
            }
        });
        Self { numbers, outcomes }
    }

    /// What comes of the program of that number; None where there is nothing in time.
    fn checked(&self, number: usize) -> Option<Result<Report, String>> {
        self.numbers.send(number).ok()?;
        self.outcomes.recv_timeout(PATIENCE).ok()
    }
}

/// Checks as many programs; `in_full` looks at all of them in stages.
fn run(seed: u64, programs: Range<usize>, threads: usize, in_full: bool) -> Run {
    let (next, left_behind) = (AtomicUsize::new(programs.start), AtomicUsize::new(0));
    let result = Mutex::new(Run::default());
    let work = || {
        let mut worker = Worker::new(seed, in_full);
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= programs.end {
                break;
            }
            let case = Case::new(seed, number);
            let outcome = worker.checked(number).unwrap_or_else(|| {
                worker = Worker::new(seed, in_full);
                if left_behind.fetch_add(1, Ordering::Relaxed) + 1 >= MOST_LEFT_BEHIND {
                    next.store(programs.end, Ordering::Relaxed);
                }
                let text = format!("nothing after {PATIENCE:?}");
                Ok(Report::of_failure(Wrong::Time, case.points[0].1, text))
            });
            result.lock().unwrap().add(&case, outcome);
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(work);
        }
    });
    result.into_inner().unwrap()
}

/// The failures of each kind by turns, so that the first few are of different kinds.
fn distinct(failing: &[Failing]) -> Vec<&Failing> {
    let mut kinds: BTreeMap<(Wrong, Place, &str), usize> = BTreeMap::new();
    let mut ranked: Vec<(usize, &Failing)> = Vec::new();
    for one in failing {
        let failure = &one.failure;
        let form = failure.form.split(' ').next().unwrap_or_default();
        let rank = kinds
            .entry((failure.wrong, failure.place, form))
            .or_default();
        ranked.push((*rank, one));
        *rank += 1;
    }
    // A thread that was left behind takes time and memory: nothing else is looked into then.
    if failing.iter().any(|one| one.failure.wrong == Wrong::Time) {
        ranked.retain(|(_, one)| one.failure.wrong == Wrong::Time);
    }
    ranked.sort_by_key(|(rank, _)| *rank);
    ranked.into_iter().map(|(_, one)| one).collect()
}

/// A failure cut down, as text.
fn described(failing: &Failing, seed: u64) -> String {
    let (program, failure) = shrunk(&failing.program, &failing.failure);
    format!(
        "{:?} of {}, {}, at {:?} {:?} (from program {} of seed {seed})\n{}\n{}",
        failure.wrong,
        failure.form,
        failure.number,
        failure.place,
        failure.inputs,
        failing.number,
        failure.text,
        program.source()
    )
}

#[test]
fn generated_code_is_at_least_as_right_as_the_function_as_written() {
    let long = from_environment("FUZZ_PROGRAMS");
    let seed = from_environment("FUZZ_SEED").unwrap_or(1) as u64;
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = if long.is_some() { cores } else { 1 };
    let first = from_environment("FUZZ_FIRST").unwrap_or(0);
    let programs = first..first + long.unwrap_or(PROGRAMS);
    let run = run(seed, programs, threads, long.is_some());
    println!("{}", run.summary());
    let shown = from_environment("FUZZ_SHOWN").unwrap_or(5);
    let shown = distinct(&run.failing).into_iter().take(shown);
    let texts: Vec<String> = shown.map(|failing| described(failing, seed)).collect();
    assert!(
        run.failing.is_empty(),
        "{}\n\n{}",
        run.summary(),
        texts.join("\n")
    );
    if first > 0 {
        return;
    }
    assert!(run.refusals() * 5 < run.programs, "{:?}", run.refused);
    // A test that compares nothing would pass.
    let (values, derivatives) = (run.report.values, run.report.derivatives);
    assert!(
        values > 10 * run.programs && derivatives > 20 * run.programs,
        "{}",
        run.summary()
    );
    assert!(run.report.with_truth > run.programs, "{}", run.summary());
}

/// A subject of the body of a formula with its gradient and Hessian.
fn subject(body: &str) -> Subject {
    let source = format!(
        "mod m {{ pub struct S {{ pub p: f64, pub q: f64 }} #[generate(value, gradient, hessian)] pub fn formula(x: f64, y: f64, a: [f64; 2], s: &S) -> f64 {{ {body} }} }}"
    );
    let wanted = Wanted::Several {
        hessian: true,
        stages: Stages::All,
        emitted: true,
    };
    Subject::of(&source, &wanted).unwrap_or_else(|missing| panic!("{missing:?}"))
}

const SOMEWHERE: [(Place, Inputs); 1] = [(Place::Ordinary, [1.3, 0.7, 0.2, -1.1, 2.5, 0.9])];

#[test]
fn right_code_is_right_and_wrong_code_is_reported() {
    let body = "(x * y + s.p).sqrt() + x / y";
    let right = compare(&subject(body), &SOMEWHERE, true);
    assert!(right.failures.is_empty(), "{:?}", right.failures);
    assert!(
        right.values >= 9 && right.derivatives >= 2 * (3 + 6),
        "{right:?}"
    );
    assert!(right.with_truth >= 27 && right.largest < 8.0, "{right:?}");
    let mut wrong = subject(body);
    let mut changed = Vec::new();
    for generation in &mut wrong.generations {
        match &mut generation.code {
            Code::Circuit(both) if both.1.outputs.len() > 2 => both.1.outputs.swap(1, 2),
            Code::Emitted(_, places) if places.len() > 2 => places.swap(1, 2),
            _ => continue,
        }
        changed.push(generation.name.clone());
    }
    assert_eq!(changed.len(), 4);
    let report = compare(&wrong, &SOMEWHERE, false);
    for name in changed {
        let of_it = report
            .failures
            .iter()
            .filter(|failure| failure.form == name);
        assert_eq!(of_it.count(), 2, "{name}: {:?}", report.failures);
    }
}

#[test]
fn other_formulas_are_reported() {
    // Each is that of the first by a little.
    let right = subject("x * y - s.p");
    for (body, wrong) in [
        ("x * y - s.p * 1.0000000000001", Wrong::Digits),
        ("s.p - x * y", Wrong::Sign),
        ("(x * y - s.p) / (a[0] - 0.2)", Wrong::NotFinite),
    ] {
        let mut changed = subject(body);
        changed.tape = right.tape.clone();
        for generation in &mut changed.generations {
            generation.numbers.truncate(1);
            let value = right.generations[0].numbers[0].clone();
            generation.numbers = vec![value];
        }
        changed
            .generations
            .retain(|generation| generation.name == "value");
        let failures = compare(&changed, &SOMEWHERE, false).failures;
        assert!(
            failures.len() == 1 && failures[0].wrong == wrong,
            "{body}: {failures:?}"
        );
    }
}

#[test]
fn failures_are_cut_down() {
    let name = Node::name;
    let sum = Node::new(Kind::Sum(vec![false, true]), vec![name("y"), name("a[0]")]);
    let root = Node::new(Kind::Method("sqrt"), vec![name("x")]);
    let node = Node::new(
        Kind::Product,
        vec![sum, Node::new(Kind::Quotient, vec![root, name("s.p")])],
    );
    let program = Program {
        helpers: Vec::new(),
        lets: Vec::new(),
        results: vec![node],
        output: Output::Number,
        domain: Vec::new(),
    };
    // What fails is that there is a root in it.
    let failure = Report::of_failure(Wrong::Digits, SOMEWHERE[0].1, String::new())
        .failures
        .remove(0);
    let (small, _) = cut_down(&program, &failure, &|candidate, failure| {
        candidate.source().contains("sqrt").then(|| failure.clone())
    });
    assert!(
        small.source().contains("        x.sqrt()\n"),
        "{}",
        small.source()
    );
}
