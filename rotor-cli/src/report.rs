//! `rotor report`: everything about one rotor, on the terminal and as a folder of files.

mod analysis;
mod figures;
mod html;
mod tables;

use rayon::prelude::*;
use rotor_plot::{Figure, PlotError};

use crate::command_line::ReportArguments;
use crate::failure::{Failure, Outcome};
use crate::output::{self, StagedFolder};
use crate::rotor_file;
use crate::table::{Table, wrapped};
use crate::zup;
use analysis::Analysis;
use html::Picture;

/// Reports on a rotor: computes all, writes the files, prints the tables, and says where the files are.
///
/// # Errors
///
/// Where the rotor cannot be read, has no coefficients, or the files cannot be written; the tables are printed before
/// that is said.
pub(crate) fn run(arguments: &ReportArguments) -> Result<Outcome, Failure> {
    if arguments.output.as_os_str() == "-" {
        return Err(Failure::input(
            "a report is a folder of files and cannot be standard output; give a folder with -o",
        ));
    }
    let named = rotor_file::load(arguments.file.as_deref())?;
    // A folder that cannot be written to is known before the figures are drawn.
    let folder = StagedFolder::new(&arguments.output);
    let analysis = Analysis::new(named)?;
    let heading = zup::heading(&analysis.named);
    let tables = tables::tables(&analysis);
    let warnings = analysis.named.rotor.warnings();
    let warnings: Vec<String> = warnings.iter().map(ToString::to_string).collect();
    let written = folder.and_then(|folder| {
        let pictures = figures::figures(&analysis);
        write(folder, &pictures, |pictures| {
            html::page(&heading, &warnings, &tables, pictures)
        })
    });
    output::print(&terminal(&heading, &warnings, &tables))?;
    written?;
    let page = arguments.output.join("report.html");
    output::print(&format!(
        "\nThe figures and this report: {}\n",
        page.display()
    ))?;
    Ok(checked(&analysis))
}

/// Draws the figures and writes all files.
fn write(
    mut folder: StagedFolder,
    figures: &[Figure],
    page: impl Fn(&[Picture]) -> String,
) -> Result<(), Failure> {
    let drawn: Vec<_> = figures.par_iter().map(draw).collect();
    let mut pictures = Vec::new();
    for drawn in drawn {
        let Drawn { picture, png, csv } =
            drawn.map_err(|error| Failure::input(format!("no report: {error}")))?;
        folder.add(&format!("{}.svg", picture.name), picture.svg.as_bytes())?;
        folder.add(&format!("{}.png", picture.name), &png)?;
        folder.add(&format!("{}.csv", picture.name), csv.as_bytes())?;
        pictures.push(picture);
    }
    folder.add("report.html", page(&pictures).as_bytes())?;
    folder.finish()
}

/// A figure in all its forms.
struct Drawn {
    picture: Picture,
    png: Vec<u8>,
    csv: String,
}

fn draw(figure: &Figure) -> Result<Drawn, PlotError> {
    let picture = Picture {
        name: figure.name.clone(),
        svg: figure.svg()?,
    };
    Ok(Drawn {
        picture,
        png: figure.png()?,
        csv: figure.csv()?,
    })
}

fn terminal(heading: &str, warnings: &[String], tables: &[Table]) -> String {
    let mut text = wrapped(heading, "");
    for warning in warnings {
        text.push_str(&wrapped(&format!("Warning: {warning}"), ""));
    }
    for table in tables {
        text.push('\n');
        text.push_str(&table.plain());
    }
    text
}

fn checked(analysis: &Analysis) -> Outcome {
    let disagreements = analysis.disagreements();
    for (kind, why) in &disagreements {
        output::remark(&format!("check failed: {}: {why}", kind.description()));
    }
    if disagreements.is_empty() {
        Outcome::Passed
    } else {
        Outcome::CheckFailed
    }
}
