//! `rotor scan`: quantities over a grid or a sample of rotors.

mod parts;
mod plot;
mod points;
mod progress;
mod reduced;
mod reduction;
mod sample;
mod stream;
mod vary;

use std::path::Path;
use std::time::{Duration, Instant};

use rotor_core::error::{Error, StudyError};
use rotor_core::input::INPUTS;
use rotor_core::input::Variable;
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::study::{Cancel, Control, Counts, Plan, Report, Sampling, Scan, Stopped};

use crate::command_line::ScanArguments;
use crate::failure::{Failure, Outcome};
use crate::files::{Format, is_stream};
use crate::{evaluate, interrupt, output, rotor_file};
use parts::Parts;
use progress::Progress;

/// The state of reductions is kept so often.
const BETWEEN_STATES: Duration = Duration::from_secs(2);

/// The names of what can be varied on the command line.
pub(crate) fn variable_names() -> Vec<String> {
    let inputs = INPUTS.iter().map(Variable::from);
    inputs
        .chain([Variable::Speed])
        .map(Variable::dotted_name)
        .collect()
}

/// A number of points, as 10000 or 1e4.
///
/// # Errors
///
/// Where it is no whole number above zero.
pub(crate) fn point_count(text: &str) -> Result<u64, String> {
    let whole =
        |number: &f64| *number >= 1.0 && number.fract() == 0.0 && *number <= (1_u64 << 53) as f64;
    let count = text.parse::<u64>().ok().filter(|&count| count > 0);
    count
        .or_else(|| {
            text.parse::<f64>()
                .ok()
                .filter(whole)
                .map(|number| number as u64)
        })
        .ok_or_else(|| format!("is \"{text}\"; it must be a whole number from 1 on"))
}

/// Scans.
///
/// # Errors
///
/// Where the rotor, an axis, a quantity or a reduction cannot be used, a file cannot be written, or
/// the scan is interrupted.
pub(crate) fn run(arguments: &ScanArguments) -> Result<Outcome, Failure> {
    let base = rotor_file::load(arguments.file.as_deref())?;
    let plan = plan(arguments, &base.rotor)?;
    let reduces = !arguments.reduce.is_empty();
    let about = points::about(&plan);
    let output = match &arguments.output {
        Some(path) => Some((path.as_path(), Format::of(path)?)),
        None if reduces || arguments.plot.is_some() => None,
        None => Some((Path::new("-"), Format::Csv)),
    };
    let running = Running {
        plan: &plan,
        about,
        resume: arguments.resume,
        threads: arguments.threads.map(usize::from),
        cancel: Cancel::default(),
    };
    let cancel = running.cancel.clone();
    interrupt::watch_asking(move || cancel.cancel());
    let picture = match &arguments.plot {
        Some(path) => Some(plot::draw(&plan, path, &base.name)?),
        None => None,
    };
    let start = Instant::now();
    let counts = match output {
        _ if reduces => running.reduce(output)?,
        Some((path, format)) if is_stream(path) => running.stream(path, format)?,
        Some((path, format)) => running.to_file(path, format)?,
        None => Counts::default(),
    };
    if counts.points > 0 {
        // One line, however long, for those who look for it.
        output::drawing(&summary(&plan, &counts, start.elapsed()));
    }
    if let Some(picture) = picture {
        picture.write()?;
    }
    Ok(Outcome::Passed)
}

/// What is asked for.
fn plan(arguments: &ScanArguments, base: &Rotor) -> Result<Plan, Failure> {
    let quantities = evaluate::quantities("--quantity", &arguments.quantities)?;
    if arguments.vary.is_empty() && arguments.sample.is_empty() {
        return Err(Failure::input(
            "nothing varies; give an axis, as --vary crack.angle=0deg:180deg:91, or a --sample",
        ));
    }
    let mut scan = Scan::of(base);
    if let Some(count) = arguments.count {
        let seed = arguments.seed;
        let sampling = if arguments.sobol {
            Sampling::Sobol { seed }
        } else {
            Sampling::Random { seed }
        };
        scan = scan.vary(sample::axis(&arguments.sample, count, sampling)?);
    }
    for text in &arguments.vary {
        scan = scan.vary(vary::axis(text)?);
    }
    for quantity in quantities {
        scan = scan.quantity(quantity);
    }
    for text in &arguments.reduce {
        for reduction in reduction::reductions(text)? {
            scan = scan.reduce(reduction);
        }
    }
    scan.plan().map_err(of_scan)
}

fn of_scan(error: Error) -> Failure {
    Failure::input(error.to_string())
}

/// A scan on its way.
struct Running<'a> {
    plan: &'a Plan,
    about: String,
    resume: bool,
    threads: Option<usize>,
    cancel: Cancel,
}

impl Running<'_> {
    /// What a finished part has to agree in.
    fn request(&self, format: Format) -> String {
        let plan = self.plan;
        let mut request = format!(
            "rotor {}\nformat {}\n",
            env!("CARGO_PKG_VERSION"),
            format.name()
        );
        request.push_str(&format!("rotor {:?}\n", plan.base()));
        for axis in plan.space().axes() {
            let names: Vec<_> = axis.variables().map(Variable::name).collect();
            request.push_str(&format!("axis {} {}\n", names.join("+"), axis.describe()));
        }
        for quantity in plan.quantities() {
            request.push_str(&format!("quantity {quantity}\n"));
        }
        for reduction in plan.reductions() {
            request.push_str(&format!("reduction {reduction}\n"));
        }
        request
    }

    /// Runs with a bar and the handler of interruptions.
    fn with_control<T>(&self, run: impl FnOnce(&Control<'_>) -> T) -> T {
        let progress = Progress::new(self.plan.space().len());
        let show = |points| progress.at(points);
        let outcome = run(&Control {
            threads: self.threads,
            cancel: self.cancel.clone(),
            progress: Some(&show),
        });
        progress.finish();
        outcome
    }

    /// All points to a file.
    fn to_file(&self, path: &Path, format: Format) -> Result<Counts, Failure> {
        let quantities = self.plan.quantities().len();
        let layout = points::layout(self.plan, format, &self.about);
        let parts = Parts::open(path, &self.request(format), self.resume)?;
        let sink = parts.sink(&layout, quantities);
        let counts = self
            .with_control(|control| self.plan.write_to(&sink, control))
            .map_err(|stopped| self.stopped(stopped, Some(&parts)))?;
        parts.join_chunks(&layout, self.plan.chunk_count(), quantities)?;
        Ok(counts)
    }

    /// All points to standard output or a special file, as they come.
    fn stream(&self, path: &Path, format: Format) -> Result<Counts, Failure> {
        if self.resume {
            return Err(Failure::input(
                "--resume needs a file (-o): what went to a stream is gone",
            ));
        }
        let layout = points::layout(self.plan, format, &self.about);
        let sink = stream::StreamSink::open(path, &layout, self.plan.quantities().len())?;
        let counts = self
            .with_control(|control| self.plan.write_to(&sink, control))
            .map_err(|stopped| self.stopped(stopped, None))?;
        sink.finish()?;
        Ok(counts)
    }

    /// The reductions, to the terminal and to a file.
    fn reduce(&self, output: Option<(&Path, Format)>) -> Result<Counts, Failure> {
        let file = output.filter(|(path, _)| !is_stream(path));
        let parts = match file {
            Some((path, format)) => Some(Parts::open(path, &self.request(format), self.resume)?),
            None => None,
        };
        let report = self.reduced(parts.as_ref())?;
        let written = match output {
            Some((_, format)) => {
                let long = reduced::long(self.plan, &report.reduced, format, &self.about);
                Some(long.map_err(|source| Failure::stream("write", "the reductions", source))?)
            }
            None => None,
        };
        if let (Some(parts), Some((layout, batch))) = (&parts, &written) {
            parts.join(layout, std::iter::once(layout.encode(batch)))?;
        }
        match (output, &written) {
            (Some((path, _)), Some((layout, batch))) if is_stream(path) => {
                stream::write_whole(path, layout, batch)?;
            }
            _ => {
                let tables: Vec<_> = reduced::tables(self.plan, &report.reduced)
                    .iter()
                    .map(crate::table::Table::plain)
                    .collect();
                output::print(&tables.join("\n"))?;
            }
        }
        Ok(report.counts)
    }

    /// Runs the reductions, from the state that was kept, and keeps it now and then.
    fn reduced(&self, parts: Option<&Parts>) -> Result<Report, Failure> {
        let quantities = self.plan.quantities().len();
        let kept = parts.and_then(|parts| parts.state(quantities));
        let (chunk, counts, state) = kept.unwrap_or((0, Counts::none(quantities), Vec::new()));
        let mut last = Instant::now();
        let mut failure = None;
        let all = self.plan.chunk_count();
        let outcome = self.with_control(|control| {
            self.plan
                .reduce_from(chunk, counts, &state, control, |saved| {
                    let due = last.elapsed() >= BETWEEN_STATES || self.cancel.is_cancelled();
                    if let Some(parts) = parts.filter(|_| due && saved.chunk < all) {
                        let state = saved.reductions.to_bytes();
                        if let Err(error) = parts.keep_state(saved.chunk, saved.counts, &state) {
                            failure = Some(error);
                            self.cancel.cancel();
                        }
                        last = Instant::now();
                    }
                })
        });
        match (outcome, failure) {
            (_, Some(failure)) => Err(failure),
            (Ok(report), None) => Ok(report),
            (Err(error), None) => Err(self.stopped(Stopped::Scan(error), parts)),
        }
    }

    /// Why it stopped, and what is left to go on from.
    fn stopped(&self, stopped: Stopped<Failure>, parts: Option<&Parts>) -> Failure {
        match stopped {
            Stopped::Sink(failure) => failure,
            Stopped::Scan(Error::Study(StudyError::Cancelled { .. })) => {
                let all = self.plan.chunk_count();
                let finished = parts.map_or(0, Parts::count_finished);
                match parts {
                    Some(_) if finished > 0 => Failure::Interrupted(format!(
                        "interrupted; no file was written. The same command with --resume goes on from what is \
                         finished of its {all} chunks"
                    )),
                    Some(parts) => match parts.remove() {
                        Ok(()) => {
                            Failure::Interrupted("interrupted; no file was written".to_owned())
                        }
                        Err(failure) => failure,
                    },
                    None => Failure::Interrupted("interrupted".to_owned()),
                }
            }
            Stopped::Scan(error) => of_scan(error),
        }
    }
}

/// Points, seconds, points/s, and what does not exist.
fn summary(plan: &Plan, counts: &Counts, elapsed: Duration) -> String {
    let seconds = elapsed.as_secs_f64();
    let mut summary = format!(
        "{} points in {seconds:.3} s, {:.3e} points/s",
        counts.points,
        counts.points as f64 / seconds.max(1e-9)
    );
    let missing = plan.quantities().iter().zip(&counts.missing);
    let missing: Vec<_> = missing
        .filter(|(_, missing)| **missing > 0)
        .map(|(quantity, missing)| format!("{quantity} {missing}"))
        .collect();
    if !missing.is_empty() {
        summary.push_str(&format!(
            "; null, since they do not exist: {}",
            missing.join(", ")
        ));
    }
    if counts.no_rotor > 0 {
        summary.push_str(&format!(
            "; {} points are no rotor (an input outside of what it allows, or beta > 2)",
            counts.no_rotor
        ));
    }
    summary
}
