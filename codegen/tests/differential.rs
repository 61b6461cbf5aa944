//! Random programs over the whole language: what is generated is at least as right as the function as written. The truth
//! is known to 77 digits, the error of the function as written by bounds that run along.
//!
//! `FUZZ_PROGRAMS=1000000 FUZZ_SEED=7 cargo test --release -p codegen --test differential -- --nocapture` for a long run.
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
    pub mod program;
    pub mod recorder;
    pub mod shrink;
    pub mod subject;
    pub mod tape;
}

use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Duration;

use support::comparison::{Failure, Report, Wrong, compare};
use support::hostile::{Random, program};
use support::points::{Inputs, Place, points};
use support::program::Program;
use support::shrink::shrunk;
use support::subject::{Missing, Subject, Wanted};

/// Programs of the test as it runs every day.
const PROGRAMS: usize = 2000;
/// One program in as many is also looked at as tokens.
const EMITTED: usize = 10;
/// One program in as many has every number compared with 77 digits.
const IN_FULL: usize = 16;
/// How long a program may take.
const PATIENCE: Duration = Duration::from_secs(10);
/// After so many programs on which the generator does not end there is no time for others.
const MOST_LEFT_BEHIND: usize = 4;

fn from_environment(name: &str) -> Option<usize> {
    std::env::var(name).ok()?.parse().ok()
}

/// What came of a run.
#[derive(Default)]
struct Run {
    programs: usize,
    refused: BTreeMap<String, usize>,
    report: Report,
    failing: Vec<(Program, Failure)>,
}

impl Run {
    fn refusals(&self) -> usize {
        self.refused.values().sum()
    }

    fn add(&mut self, program: Program, outcome: Result<Report, String>) {
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
                        self.failing.push((program.clone(), failure));
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

/// The program of that number, and where it is looked at.
fn case(seed: u64, number: usize) -> (Program, Vec<(Place, Inputs)>) {
    let mut random = Random::new(seed ^ (number as u64).wrapping_mul(0xd134_2543_de82_ef95));
    let program = program(&mut random);
    let points = points(&mut random, &program);
    (program, points)
}

/// What comes of a program; the message where it is refused.
fn checked(program: &Program, points: &[(Place, Inputs)], number: usize) -> Result<Report, String> {
    let wanted = if number.is_multiple_of(EMITTED) {
        Wanted::All
    } else {
        Wanted::Circuits
    };
    match Subject::of(&program.source(), &wanted) {
        Ok(subject) => Ok(compare(&subject, points, number.is_multiple_of(IN_FULL))),
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
    fn new(seed: u64) -> Self {
        let (numbers, of_number) = channel();
        let (of_outcome, outcomes) = channel();
        std::thread::spawn(move || {
            for number in of_number {
                let (program, points) = case(seed, number);
                // It may have been left behind.
                if of_outcome.send(checked(&program, &points, number)).is_err() {
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

fn run(seed: u64, programs: usize, threads: usize) -> Run {
    let (next, result) = (AtomicUsize::new(0), Mutex::new(Run::default()));
    let left_behind = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                let mut worker = Worker::new(seed);
                loop {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    if number >= programs {
                        break;
                    }
                    let (program, points) = case(seed, number);
                    let begun = std::time::Instant::now();
                    let outcome = worker.checked(number).unwrap_or_else(|| {
                        worker = Worker::new(seed);
                        if left_behind.fetch_add(1, Ordering::Relaxed) + 1 >= MOST_LEFT_BEHIND {
                            next.store(programs, Ordering::Relaxed);
                        }
                        let text = format!("nothing after {PATIENCE:?}");
                        Ok(Report::of_failure(Wrong::Time, points[0].1, text))
                    });
                    if std::env::var("FUZZ_TRACE").is_ok() {
                        println!("TIME {} {number}", begun.elapsed().as_millis());
                        if begun.elapsed().as_millis() > 3000 { println!("{}", program.source()); }
                    }
                    result.lock().unwrap().add(program, outcome);
                }
            });
        }
    });
    result.into_inner().unwrap()
}

/// The failures of each kind by turns, so that the first few are of different kinds.
fn distinct(failing: &[(Program, Failure)]) -> Vec<&(Program, Failure)> {
    let mut kinds: BTreeMap<(Wrong, Place, &str), usize> = BTreeMap::new();
    let mut ranked: Vec<(usize, &(Program, Failure))> = Vec::new();
    for case in failing {
        let form = case.1.form.split(' ').next().unwrap_or_default();
        let rank = kinds.entry((case.1.wrong, case.1.place, form)).or_default();
        ranked.push((*rank, case));
        *rank += 1;
    }
    ranked.sort_by_key(|(rank, _)| *rank);
    ranked.into_iter().map(|(_, case)| case).collect()
}

fn described(program: &Program, failure: &Failure) -> String {
    format!(
        "{:?} of {}, {}, at {:?} {:?}\n{}\n{}",
        failure.wrong,
        failure.form,
        failure.number,
        failure.place,
        failure.inputs,
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
    let run = run(seed, long.unwrap_or(PROGRAMS), threads);
    println!("{}", run.summary());
    let shown = from_environment("FUZZ_SHOWN").unwrap_or(5);
    let mut texts = Vec::new();
    for (program, failure) in distinct(&run.failing).into_iter().take(shown) {
        let (program, failure) = shrunk(program, failure);
        texts.push(described(&program, &failure));
    }
    assert!(
        run.failing.is_empty(),
        "{}\n\n{}",
        run.summary(),
        texts.join("\n")
    );
    assert!(run.refusals() * 5 < run.programs, "{:?}", run.refused);
    // A test that compares nothing would pass.
    let (values, derivatives) = (run.report.values, run.report.derivatives);
    assert!(values > 10 * run.programs && derivatives > 20 * run.programs, "{}", run.summary());
    assert!(run.report.with_truth > run.programs, "{}", run.summary());
}
