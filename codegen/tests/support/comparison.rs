//! Generated numbers beside those of the function as written, and beside the truth.

use super::high_precision::HighPrecision;
use super::interval::Interval;
use super::points::{Inputs, Place as Kind};
use super::subject::{Generation, Number, Subject};
use super::tape::{Arithmetic, Place};

/// How many times as far from the truth as the function as written a generated number may be.
pub const FACTOR: f64 = 64.0;
/// What is allowed beside that, in units in the last place.
const LAST_PLACES: f64 = 4.0;
/// Derivatives whose relative error is beyond this are not looked at: they say little.
const COARSE: f64 = 1e-3;

/// What is wrong with a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Wrong {
    /// It is further from the truth than it may be.
    Digits,
    /// It is infinite or NaN where the function as written is finite.
    NotFinite,
    /// It has another sign, or none, where that of the function as written is certain.
    Sign,
    /// There are not as many as there should be.
    Count,
    /// The generator panicked.
    Panic,
    /// It did not end in time.
    Time,
    /// The bound of the function as written does not hold the truth: a mistake of this test.
    Bound,
}

/// A number that is wrong.
#[derive(Clone, Debug)]
pub struct Failure {
    pub wrong: Wrong,
    pub form: String,
    pub number: String,
    pub place: Kind,
    pub inputs: Inputs,
    pub text: String,
}

/// What came of comparing.
#[derive(Clone, Debug, Default)]
pub struct Report {
    pub values: usize,
    pub derivatives: usize,
    /// How many of them were compared with 77 digits.
    pub with_truth: usize,
    /// Numbers of which the function as written says nothing that is certain.
    pub unknown: usize,
    /// The largest distance from the truth, in errors of the function as written, of numbers that are right.
    pub largest: f64,
    pub failures: Vec<Failure>,
}

impl Report {
    /// That of a program that gave nothing to compare.
    pub fn of_failure(wrong: Wrong, inputs: Inputs, text: String) -> Self {
        let failure = Failure {
            wrong,
            form: "hessian".to_owned(),
            number: "all".to_owned(),
            place: Kind::Ordinary,
            inputs,
            text,
        };
        Self {
            failures: vec![failure],
            ..Self::default()
        }
    }

    pub fn add(&mut self, other: Self) {
        self.values += other.values;
        self.derivatives += other.derivatives;
        self.with_truth += other.with_truth;
        self.unknown += other.unknown;
        self.largest = self.largest.max(other.largest);
        self.failures.extend(other.failures);
    }
}

/// The inputs that one point gives to a subject, with what is computed of it once.
struct Point<'s> {
    subject: &'s Subject,
    kind: Kind,
    inputs: Inputs,
    written: Vec<Interval<false>>,
    /// The same with every operation taken for rounded.
    rough: Vec<Interval<true>>,
}

/// Compares all forms at all points; `in_full` takes 77 digits for every number.
pub fn compare(subject: &Subject, points: &[(Kind, Inputs)], in_full: bool) -> Report {
    let mut report = Report::default();
    let all: Vec<Place> = (0..subject.tape.steps.len()).collect();
    for (kind, inputs) in points {
        let point = Point {
            subject,
            kind: *kind,
            inputs: *inputs,
            written: subject.tape.evaluate(&all, &inputs.map(Interval::exactly)),
            rough: subject.tape.evaluate(&all, &inputs.map(Interval::exactly)),
        };
        for generation in &subject.generations {
            point.compare(generation, in_full, &mut report);
        }
    }
    report
}

/// One unit in the last place.
fn last_place(value: f64) -> f64 {
    let above = value.abs().next_up();
    if above.is_finite() {
        above - value.abs()
    } else {
        f64::MAX * f64::EPSILON
    }
}

impl Point<'_> {
    fn compare(&self, generation: &Generation, in_full: bool, report: &mut Report) {
        let results = generation.code.run(&self.inputs);
        if results.len() != generation.numbers.len() {
            let text = format!("{} numbers", results.len());
            report
                .failures
                .push(self.failure(generation, "all", Wrong::Count, text));
            return;
        }
        for (number, generated) in generation.numbers.iter().zip(results) {
            if !self.is_certain(number) {
                report.unknown += 1;
                continue;
            }
            if number.is_value() {
                report.values += 1;
            } else {
                report.derivatives += 1;
            }
            if let Some((wrong, truth)) = self.wrong(number, generated, in_full, report) {
                let written = self.written[number.place];
                let text = format!(
                    "generated {generated:e}, written {:e} in [{:e}, {:e}], truth {truth}",
                    written.value, written.low, written.high
                );
                report
                    .failures
                    .push(self.failure(generation, &number.name, wrong, text));
            }
        }
    }

    /// Whether the function as written gives a finite number there and it is known how good it is; of a derivative, also
    /// what it is the derivative of.
    fn is_certain(&self, number: &Number) -> bool {
        number.of.iter().all(|place| {
            let written = self.written[*place];
            let (value, error) = (written.value, self.error(*place));
            let good = number.is_value() || error <= COARSE * value.abs() || value == 0.0;
            written.is_bounded() && value.is_finite() && error.is_finite() && good
        })
    }

    /// The running error bound of a number as written.
    fn error(&self, place: Place) -> f64 {
        let (written, rough) = (self.written[place], self.rough[place]);
        if rough.is_bounded() {
            written.error().max(rough.error())
        } else {
            written.error()
        }
    }

    fn failure(
        &self,
        generation: &Generation,
        number: &str,
        wrong: Wrong,
        text: String,
    ) -> Failure {
        Failure {
            wrong,
            form: generation.name.clone(),
            number: number.to_owned(),
            place: self.kind,
            inputs: self.inputs,
            text,
        }
    }

    fn truth(&self, place: Place) -> HighPrecision {
        let inputs = self.inputs.map(HighPrecision::number);
        self.subject.tape.evaluate(&[place], &inputs)[0].clone()
    }

    fn wrong(
        &self,
        number: &Number,
        generated: f64,
        in_full: bool,
        report: &mut Report,
    ) -> Option<(Wrong, String)> {
        let written = self.written[number.place];
        let (value, error) = (written.value, self.error(number.place));
        // What is smaller than any normal number may be lost on the way.
        let lost = if value.abs() < f64::MIN_POSITIVE {
            f64::MIN_POSITIVE
        } else {
            0.0
        };
        let allowance = LAST_PLACES * last_place(value) + lost;
        let truth = || self.truth(number.place);
        // What the author's operations leave open may be anything.
        let is_settled = error <= 1e-3 * value.abs() + f64::MIN_POSITIVE;
        if !generated.is_finite() {
            if !is_settled {
                return None;
            }
            return Some((Wrong::NotFinite, truth().to_string()));
        }
        let has_sign = value.abs() > FACTOR * error + allowance;
        if has_sign && generated * value.signum() <= 0.0 {
            return Some((Wrong::Sign, truth().to_string()));
        }
        let apart = (generated - value).abs();
        let unit = error.max(last_place(value));
        let passes = apart <= (FACTOR - 1.0) * error + allowance;
        if passes && !in_full {
            report.largest = report.largest.max(apart / unit);
            return None;
        }
        let truth = truth();
        if !truth.is_known() || !truth.is_within((error + allowance) / 1024.0) {
            // What is written is still as close to the truth as its bound says.
            let fails = apart > (FACTOR + 1.0) * error + allowance;
            return fails.then(|| (Wrong::Digits, truth.to_string()));
        }
        report.with_truth += 1;
        let away = truth.distance(value);
        if away > error * 1.000_001 {
            return Some((Wrong::Bound, truth.to_string()));
        }
        let found = truth.distance(generated);
        if found > FACTOR * error + allowance {
            return Some((Wrong::Digits, truth.to_string()));
        }
        report.largest = report.largest.max(found / unit);
        None
    }
}
