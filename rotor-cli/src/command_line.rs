//! The command line: every command, its options and its help.

mod scan;

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

pub(crate) use scan::ScanArguments;

const EXIT_CODES: &str = "Exit codes: 0 done; 1 it ran, and a check failed; 2 the input cannot be used, or a \
file could not be read or written; 130 and 143 interrupted.";

/// The folder that a report goes to unless told otherwise.
const DEFAULT_FOLDER: &str = "rotor-report";

/// Parametric instability of a rotor with an asymmetric disk and a transverse shaft crack
///
/// Where a Jeffcott rotor becomes unstable, how wide its simple and combination instability regions are, and
/// which crack closes them. With no command, it reports on the paper's rotor.
#[derive(Debug, Parser)]
#[command(name = "rotor", version, max_term_width = 100)]
#[command(after_help = "Examples:\n  \
  $ rotor\n  \
  $ rotor init -f -o my-rotor.toml && rotor report my-rotor.toml -o my-report\n\n\
Run `rotor COMMAND --help` for a command and its examples.\n\
Exit codes: 0 done; 1 it ran, and a check failed; 2 the input cannot be used.")]
pub(crate) struct CommandLine {
    /// What to do; nothing is `report`.
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Report(ReportArguments),
    Evaluate(EvaluateArguments),
    Scan(ScanArguments),
    Zup(ZupArguments),
    Init(InitArguments),
    Show(ShowArguments),
}

/// Report on one rotor: coefficients, instability regions, figures
///
/// Prints the tables and writes them, with Figures 3 to 9 of the paper drawn for this rotor and a map of the
/// widths, to a folder: report.html (self-contained), and each figure as SVG, PNG and CSV. The widths are given
/// three times: by the paper's approximation, exactly, and by Hill's method. The files appear once all are made; an
/// interrupted run leaves none. Where they cannot be written, the tables are printed all the same.
#[derive(Args, Debug)]
#[command(after_help = format!("Examples:\n  \
  $ rotor report\n  \
  $ rotor init -f -o my-rotor.toml && rotor report my-rotor.toml -o my-report\n\n\
The check that can fail (exit code 1): a width by Hill's method and the exact one differ by more than 1e-6 of \
it, in a narrow region by more than rounding may move it.\n\
{EXIT_CODES}"))]
pub(crate) struct ReportArguments {
    /// The rotor, a TOML file as `rotor init` writes it; `-` is standard input. Without it, the paper's rotor
    #[arg(value_name = "FILE.toml")]
    pub(crate) file: Option<PathBuf>,

    /// The folder for the files
    #[arg(short, long, value_name = "FOLDER", default_value = DEFAULT_FOLDER)]
    pub(crate) output: PathBuf,
}

impl ReportArguments {
    /// What `rotor` without a command does.
    pub(crate) fn on_the_papers_rotor() -> Self {
        Self {
            file: None,
            output: PathBuf::from(DEFAULT_FOLDER),
        }
    }
}

/// Evaluate a table of rotors
///
/// Each row of a table (CSV, Parquet or Arrow, by its extension) is a rotor. Columns named like the inputs (disk_mass or disk.mass, crack_depth_ratio,
/// crack_model, ...) are read; inputs without a column come from --base. All columns are kept as they are, in their
/// place; the results follow, then a column `error`, each in place of one that has its name already. Numbers are
/// written so that they read back exactly.
///
/// A region that is closed has the width 0: it exists. One that does not exist leaves its cells empty and says why in
/// `error`; that is an answer, not a mistake.
/// A row that is no rotor stops the run, and no file is written. An empty cell in an input's column is such a
/// mistake: the base rotor stands in for whole columns only.
///
/// Lines may end with LF, CRLF or CR; the results' lines end with LF. Blank lines are left out, and quotes are written
/// only where a cell needs them; what the cells say stays as it is.
#[derive(Args, Debug)]
#[command(after_help = format!("Examples:\n  \
  $ printf 'crack.depth_ratio\\n0.1\\n0.2\\n' | rotor evaluate - --quantities sir_width,cir_width\n  \
  $ printf 'crack_angle\\n0\\n1.5\\n' > in.csv && rotor evaluate in.csv -o widths.parquet\n\n\
Results: {}\n{EXIT_CODES}", crate::evaluate::result_names().join(" ")))]
pub(crate) struct EvaluateArguments {
    /// The table: .parquet, .arrow, or comma-separated with a header row; `-` is CSV from standard input
    #[arg(value_name = "TABLE")]
    pub(crate) table: PathBuf,

    /// Where the table with its results goes: .parquet, .arrow, otherwise CSV; `-` is standard output. A file appears
    /// whole or not at all
    #[arg(short, long, value_name = "OUT", default_value = "-")]
    pub(crate) output: PathBuf,

    /// The results to add, in this order, or `all`
    #[arg(
        short,
        long,
        value_name = "NAMES",
        value_delimiter = ',',
        default_value = "all"
    )]
    pub(crate) quantities: Vec<String>,

    /// The rotor that stands in for inputs without a column; without it, the paper's rotor
    #[arg(short, long, value_name = "FILE.toml")]
    pub(crate) base: Option<PathBuf>,

    /// Keep rows that are no rotor: their results stay empty, `error` says why, and names fields beyond the header.
    /// If no row at all is a rotor, the exit code is 1
    #[arg(short, long)]
    pub(crate) keep_going: bool,
}

/// The zero unstable points: which crack closes an instability region
///
/// For each region: the disk asymmetry that closes it, the crack angle at which it closes, the crack depth and the
/// crack positions that would, everything else as in the file. `none in range` is an answer too.
#[derive(Args, Debug)]
#[command(after_help = format!("Examples:\n  \
  $ rotor zup\n  \
  $ rotor init -o - | rotor zup -\n\n{EXIT_CODES}"))]
pub(crate) struct ZupArguments {
    /// The rotor, a TOML file as `rotor init` writes it; `-` is standard input. Without it, the paper's rotor
    #[arg(value_name = "FILE.toml")]
    pub(crate) file: Option<PathBuf>,
}

/// Write a rotor file to start from: the paper's rotor, commented
#[derive(Args, Debug)]
#[command(after_help = format!("Examples:\n  \
  $ rotor init --force\n  \
  $ rotor init -o - | rotor zup -\n\n{EXIT_CODES}"))]
pub(crate) struct InitArguments {
    /// The file to write; `-` is standard output
    #[arg(short, long, value_name = "FILE.toml", default_value = "rotor.toml")]
    pub(crate) output: PathBuf,

    /// Write over an existing file
    #[arg(short, long)]
    pub(crate) force: bool,
}

/// Show an equation: the generated code, typeset, or as a graph
///
/// Without a name, lists all equations: what each is, and the operations that its value takes.
#[derive(Args, Debug)]
#[command(after_help = format!("Examples:\n  \
  $ rotor show\n  \
  $ rotor show sir_width\n  \
  $ rotor show phi --latex\n  \
  $ rotor show f_n --graph > f_n.dot\n\n{EXIT_CODES}"))]
pub(crate) struct ShowArguments {
    /// The equation's name, as in the library's module `equations`; without it, all are listed
    #[arg(value_name = "NAME")]
    pub(crate) name: Option<String>,

    #[command(flatten)]
    pub(crate) form: FormArguments,
}

/// In which form to show an equation.
#[derive(Args, Debug)]
#[group(multiple = false)]
pub(crate) struct FormArguments {
    /// As the generated Rust (this is the default)
    #[arg(long, requires = "name")]
    pub(crate) rust: bool,

    /// As LaTeX for a display, with the definitions of all equations that it calls
    #[arg(long, requires = "name")]
    pub(crate) latex: bool,

    /// As a graph, in Graphviz' language
    #[arg(long, requires = "name")]
    pub(crate) graph: bool,
}
