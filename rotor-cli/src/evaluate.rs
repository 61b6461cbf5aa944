//! `rotor evaluate`: results for each rotor of a table.

mod columns;
mod inputs;
mod results;
mod source;
mod table;

use std::collections::VecDeque;
use std::path::Path;
use std::sync::mpsc;

use rotor_core::error::Error;
use rotor_core::input::RotorParameters;
use rotor_core::jeffcott::region::RegionKind;
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::quantity::Quantity;
use rotor_core::reason;
use rotor_core::study;
use rotor_core::text::brief;
use rotor_core::warning::Warning;

use crate::command_line::EvaluateArguments;
use crate::failure::{Failure, Outcome};
use crate::files::Part;
use crate::output;
use crate::rotor_file;
use columns::{Columns, ERROR};
use inputs::Inputs;
use results::{Encoding, Results};
use source::{Piece, Read, Source};

/// The names of all results that a rotor alone has.
pub(crate) fn result_names() -> Vec<&'static str> {
    of_rotor().map(Quantity::name).collect()
}

/// Quantities that every rotor has, or most have: not those at a speed, nor those of the upper simple region, which exists for
/// beta < 1 alone.
fn of_rotor() -> impl Iterator<Item = Quantity> {
    Quantity::ALL.into_iter().filter(|quantity| {
        !quantity.needs_speed() && quantity.region() != Some(RegionKind::UpperSimple)
    })
}

/// Evaluates the table.
///
/// # Errors
///
/// Where the table, a name of a result, the base rotor or, without `--keep-going`, a row cannot be used.
pub(crate) fn run(arguments: &EvaluateArguments) -> Result<Outcome, Failure> {
    let quantities = quantities("--quantities", &arguments.quantities)?;
    if let Some(quantity) = quantities.iter().find(|quantity| quantity.needs_speed()) {
        return Err(Failure::input(format!(
            "--quantities: {quantity} is at a speed, and a table of rotors has none; `rotor scan --vary speed=0.5:2:301 -q \
             {quantity}` has"
        )));
    }
    if arguments.table.as_os_str() == "-"
        && arguments
            .base
            .as_ref()
            .is_some_and(|base| base.as_os_str() == "-")
    {
        return Err(Failure::input(
            "the table and the base rotor cannot both be standard input",
        ));
    }
    let name = name_of(&arguments.table);
    let mut source = Source::open(&arguments.table)?;
    let header = source
        .header()
        .map_err(|error| Failure::input(format!("{name}: {error}")))?
        .ok_or_else(|| Failure::input(format!("{name} is empty: a header row is wanted")))?;
    let headings: Vec<_> = quantities
        .iter()
        .map(|quantity| quantity.name())
        .chain([ERROR])
        .collect();
    let columns = Columns::new(&header, &headings)
        .map_err(|failure| Failure::input(format!("{name}: {failure}")))?;
    for remark in columns.remarks() {
        output::remark(&format!("warning: {name}: {remark}"));
    }
    let base = rotor_file::load_base(arguments.base.as_deref(), &columns.input_names())?;
    let opened = (&header.fields, &columns);
    let mut results = Results::open(&arguments.output, opened, source.schema(), &quantities)?;
    let evaluation = Evaluation {
        name,
        unit: source.unit(),
        columns,
        quantities,
        base,
        keep_going: arguments.keep_going,
    };
    let tally = evaluation.all(&mut source, &mut results)?;
    results.finish()?;
    evaluation.remark_on(&tally);
    Ok(if tally.rows > 0 && tally.failed == tally.rows {
        Outcome::CheckFailed
    } else {
        Outcome::Passed
    })
}

/// The results asked for by an option, each once, in the order asked for; `all` are those that a rotor alone has.
///
/// # Errors
///
/// Where a name is empty or none of a result.
pub(crate) fn quantities(option: &str, names: &[String]) -> Result<Vec<Quantity>, Failure> {
    let mut quantities = Vec::new();
    for name in names.iter().map(|name| name.trim()) {
        let asked = match name {
            "" => {
                return Err(Failure::input(format!(
                    "{option}: a name is empty; give names of results with commas between, or `all`"
                )));
            }
            name if name.eq_ignore_ascii_case("all") => of_rotor().collect(),
            name => vec![
                name.to_ascii_lowercase()
                    .parse::<Quantity>()
                    .map_err(|error| {
                        Failure::input(format!("{option}: {error}; `--help` lists all"))
                    })?,
            ],
        };
        for quantity in asked {
            if !quantities.contains(&quantity) {
                quantities.push(quantity);
            }
        }
    }
    Ok(quantities)
}

fn name_of(path: &Path) -> String {
    if path.as_os_str() == "-" {
        "standard input".to_owned()
    } else {
        brief(&path.display().to_string())
    }
}

/// A result, or why there is none. A zero of a region may be all that is left of a number too small for double precision.
fn checked(rotor: &Rotor, quantity: Quantity, result: Result<f64, Error>) -> Result<f64, String> {
    let value = result.map_err(|error| error.to_string())?;
    let underflow = quantity
        .region()
        .filter(|_| value == 0.0)
        .and_then(|kind| Some((kind, rotor.coefficients().ok()?)))
        .and_then(|(kind, c)| reason::out_of_range(kind, &c));
    underflow.map_or(Ok(value), Err)
}

/// A table on its way.
struct Evaluation {
    name: String,
    /// What rows are counted in.
    unit: &'static str,
    columns: Columns,
    quantities: Vec<Quantity>,
    base: RotorParameters,
    keep_going: bool,
}

/// What is said of a table in the end.
#[derive(Default)]
struct Tally {
    rows: u64,
    /// Rows that are no rotor.
    failed: u64,
    doubtful: Option<Doubtful>,
}

/// A piece, what comes of it, and both encoded; none where its rows end it all.
type Done = (Piece, Answers, Option<Part>);

/// Rows whose rotors are doubtful.
struct Doubtful {
    rows: u64,
    /// The line of the first, and what is said of it.
    first: (u64, Warning),
}

/// What comes of some rows.
struct Answers {
    /// For each quantity a column, NaN where there is none; nothing once they are encoded.
    values: Vec<Vec<f64>>,
    /// The rows that lack a result or are no rotor, with the reasons.
    errors: Vec<(usize, String)>,
    /// The rows that are no rotor.
    no_rotors: Vec<usize>,
    /// How many rows are doubtful, and the first.
    doubtful: (u64, Option<usize>),
}

/// What comes of a row that is a rotor.
struct Evaluated {
    /// The results, none where there is none.
    values: Vec<Option<f64>>,
    /// The reasons for those.
    error: String,
}

impl Evaluation {
    /// Evaluates and writes piece after piece: this thread reads the next ones and writes those that are done, in order,
    /// while others evaluate and encode.
    fn all(&self, source: &mut Source, results: &mut Results) -> Result<Tally, Failure> {
        let most = 2 * rayon::current_num_threads();
        let encoding = results.encoding().clone();
        let mut tally = Tally::default();
        rayon::in_place_scope(|scope| {
            let mut under_way = VecDeque::new();
            loop {
                let piece = source.next_piece(self.keep_going);
                let piece =
                    piece.map_err(|error| Failure::input(format!("{}: {error}", self.name)))?;
                let at_end = piece.is_none();
                if let Some(piece) = piece {
                    let (sender, receiver) = mpsc::sync_channel(1);
                    let encoding = &encoding;
                    scope.spawn(move |_| {
                        // Nobody waits for it where an earlier piece has ended it all.
                        let _ = sender.send(self.done(encoding, piece));
                    });
                    under_way.push_back(receiver);
                }
                if at_end || under_way.len() == most {
                    // Without an answer the evaluation has panicked, which the scope passes on.
                    let first = under_way.pop_front().and_then(|first| first.recv().ok());
                    let Some(done) = first else {
                        return Ok(tally);
                    };
                    let (piece, answers, encoded) = done?;
                    self.take(&piece, &answers, &mut tally)?;
                    encoded.map_or(Ok(()), |encoded| results.add(encoded))?;
                }
            }
        })
    }

    /// A piece with what comes of it, encoded.
    fn done(&self, encoding: &Encoding, piece: Piece) -> Result<Done, Failure> {
        let answers = self.evaluate(&piece);
        let mut answers = answers.map_err(|error| Failure::input(error.to_string()))?;
        // Rows that end it all are not written.
        let ends = !(self.keep_going || answers.no_rotors.is_empty());
        let encoded = (!ends).then(|| encoding.encode(&self.columns, &piece, &mut answers));
        Ok((piece, answers, encoded.transpose()?))
    }

    /// Evaluates a piece: in packs, and the rows that lack a result once more, for the reason.
    fn evaluate(&self, piece: &Piece) -> Result<Answers, Error> {
        let inputs = Inputs::of(piece, &self.columns, &self.base);
        let mut values = inputs.evaluate(&self.quantities)?;
        let mut answers = Answers {
            values: Vec::new(),
            errors: Vec::new(),
            no_rotors: Vec::new(),
            doubtful: (0, None),
        };
        for row in 0..inputs.len() {
            if self.lacks_any(&values, row) {
                let error = match self.row(&piece.read(row)) {
                    Ok(evaluated) => {
                        for (column, value) in values.iter_mut().zip(evaluated.values) {
                            // A zero has no sign.
                            column[row] = value.map_or(f64::NAN, |value| value + 0.0);
                        }
                        evaluated.error
                    }
                    Err(why) => {
                        answers.no_rotors.push(row);
                        why
                    }
                };
                answers.errors.push((row, error));
            }
        }
        for row in inputs.doubtful() {
            if answers.no_rotors.binary_search(&row).is_err() {
                answers.doubtful.0 += 1;
                answers.doubtful.1.get_or_insert(row);
            }
        }
        answers.values = values;
        Ok(answers)
    }

    /// Whether a result is missing in a row, or may be all that is left of a number too small for double precision.
    fn lacks_any(&self, values: &[Vec<f64>], row: usize) -> bool {
        let mut results = self.quantities.iter().zip(values);
        results.any(|(quantity, column)| {
            let value = column[row];
            value.is_nan() || (value == 0.0 && quantity.region().is_some())
        })
    }

    /// Takes notice of what came of a piece.
    ///
    /// # Errors
    ///
    /// Where a row is no rotor, and that is to be the end.
    fn take(&self, piece: &Piece, answers: &Answers, tally: &mut Tally) -> Result<(), Failure> {
        if let Some(row) = answers.no_rotors.first()
            && !self.keep_going
        {
            let why = answers.errors.iter().find(|(of, _)| of == row);
            let why = why.map_or("", |(_, why)| why);
            return Err(Failure::input(format!(
                "{}: {} {}: {why}; no results are written",
                self.name,
                self.unit,
                piece.read(*row).row.line
            )));
        }
        tally.rows += piece.len() as u64;
        tally.failed += answers.no_rotors.len() as u64;
        let (rows, Some(first)) = answers.doubtful else {
            return Ok(());
        };
        if let Some(doubtful) = &mut tally.doubtful {
            doubtful.rows += rows;
            return Ok(());
        }
        let read = piece.read(first);
        let parameters = self.columns.parameters(&read.row, &self.base);
        let rotor = parameters.ok().and_then(|p| Rotor::new(p).ok());
        let warning = rotor.and_then(|rotor| rotor.warnings().into_iter().next());
        tally.doubtful = warning.map(|warning| Doubtful {
            rows,
            first: (read.row.line, warning),
        });
        Ok(())
    }

    /// The results of a row, or why it is no rotor.
    fn row(&self, Read { row, broken }: &Read) -> Result<Evaluated, String> {
        if let Some(why) = broken {
            return Err((*why).to_owned());
        }
        let parameters = self.columns.parameters(row, &self.base)?;
        let rotor = Rotor::new(parameters).map_err(|error| error.to_string())?;
        let mut reasons: Vec<String> = Vec::new();
        let results = study::evaluate(&self.quantities, &rotor);
        let values = self
            .quantities
            .iter()
            .zip(results)
            .map(
                |(&quantity, result)| match checked(&rotor, quantity, result) {
                    Ok(value) => Some(value),
                    Err(reason) => {
                        if !reasons.contains(&reason) {
                            reasons.push(reason);
                        }
                        None
                    }
                },
            )
            .collect();
        Ok(Evaluated {
            values,
            error: reasons.join("; "),
        })
    }

    /// Says how many rows are doubtful, and how many no rotor; each of those is told why in its column, and keeping
    /// going was asked for.
    fn remark_on(&self, tally: &Tally) {
        let count = tally.rows;
        if let Some(Doubtful { rows, first }) = &tally.doubtful {
            output::remark(&format!(
                "warning: {}: {rows} of {count} rows are doubtful, the first in {} {}: {}",
                self.name, self.unit, first.0, first.1
            ));
        }
        if tally.failed > 0 {
            output::remark(&format!(
                "{}: {} of {count} rows are no rotor, their results are empty and `{ERROR}` says why",
                self.name, tally.failed
            ));
        }
    }
}
