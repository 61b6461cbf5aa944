//! The options of `rotor scan`.

use std::path::PathBuf;

use clap::Args;
use rotor_core::quantity::Quantity;

use super::EXIT_CODES;

/// Scan quantities over a grid or a sample of rotors
///
/// Each --vary is an axis, the last one innermost; the points are all combinations of their values. The values are
/// a range, `start:stop:count` (both ends included) or `start:stop:count:log`; a list, `a,b,c`; or a column of a CSV
/// file, `table.csv:column`. Numbers may end with `deg` where an angle is meant, and with `%` where a ratio is.
/// Inputs that are linked by commas run together: `--vary disk.asymmetry=0:0.2:5,crack.depth_ratio=0.1:0.3:5` are 5
/// points. Beside the inputs the speed can be varied, in units of each rotor's own reference speed, for `growth_rate`,
/// which is at a speed; `all` are the quantities that need none.
///
/// Each --sample draws an input at random: `normal(mean,deviation)`, `uniform(low,high)` or
/// `lognormal(median,deviation of the logarithm)`; all of them together are one axis of --count points, outside of the
/// others. A draw that the input does not allow is no rotor; it has no quantities and is counted. At a speed that is not
/// above 0 there is no growth rate.
///
/// Without --reduce all points are written, one row each, with null where a quantity does not exist. With it, only
/// the reductions are kept, in little memory, and it is they that are printed and written.
///
/// A scan that was interrupted leaves its finished part beside the output, as `map.parquet.part`; the same command
/// with --resume goes on from there, to the same file as if there had been no interruption.
#[derive(Args, Debug)]
#[command(after_help = format!("Examples:\n  \
  $ rotor scan --vary crack.depth_ratio=0:0.4:41 --vary crack.angle=0deg:180deg:73 -q all -o a.arrow\n  \
  $ rotor scan --vary crack.angle=0deg:180deg:721 -q sir_width,cir_width --reduce max,argmin,mean\n  \
  $ rotor scan --vary crack.angle=0,45deg --vary disk.mass=1:100:9:log -q beta -r max:crack.angle\n  \
  $ rotor scan --sample 'disk.asymmetry=normal(0.2,0.01)' --count 1e4 --seed 7 -q sir_width -o b.npy\n  \
  $ rotor scan --vary crack.depth_ratio=0:0.4:97 --vary crack.angle=0:3:97 -q cir_width --plot m.svg\n  \
  $ rotor scan --vary crack.depth_ratio=0:0.4:97 --vary speed=0.6:1.8:97 -q growth_rate --plot g.svg\n\n\
Quantities: {}\n\
Inputs, and the speed: {}\n\
Reductions: max, min, argmax, argmin, mean, count(THRESHOLD), histogram(LOW,HIGH,BINS)\n\
{EXIT_CODES} Interrupted: 130.", Quantity::ALL.map(Quantity::name).join(" "), crate::scan::variable_names().join(" ")))]
pub(crate) struct ScanArguments {
    /// The rotor whose inputs hold where nothing varies, a TOML file as `rotor init` writes it; `-` is standard
    /// input. Without it, the paper's rotor
    #[arg(value_name = "FILE.toml")]
    pub(crate) file: Option<PathBuf>,

    /// An axis: an input or the speed and its values, or several that run together
    #[arg(long, value_name = "INPUT=VALUES")]
    pub(crate) vary: Vec<String>,

    /// An input, or the speed, that is drawn at random
    #[arg(long, value_name = "INPUT=DISTRIBUTION", requires = "count")]
    pub(crate) sample: Vec<String>,

    /// How many points are drawn, as 10000 or 1e4
    #[arg(long, value_name = "N", requires = "sample", value_parser = crate::scan::point_count)]
    pub(crate) count: Option<u64>,

    /// Which random numbers; the same seed draws the same points
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) seed: u64,

    /// Draw with Sobol's sequence, which fills the space evenly, instead of pseudo-random numbers
    #[arg(long, requires = "sample")]
    pub(crate) sobol: bool,

    /// The results
    #[arg(
        short,
        long = "quantity",
        visible_alias = "quantities",
        value_name = "NAMES",
        value_delimiter = ',',
        required = true
    )]
    pub(crate) quantities: Vec<String>,

    /// What to keep instead of all points: a reduction over one axis (`max:crack.angle`), several
    /// (`mean:crack.angle+disk.mass`) or all (`max`); several with commas between
    #[arg(short, long, value_name = "REDUCTIONS")]
    pub(crate) reduce: Vec<String>,

    /// Where the table goes: .parquet, .arrow, .csv or .npy; `-` is standard output, as CSV. A file appears whole or
    /// not at all
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,

    /// Draw the scan, .svg, .png or .pdf: curves over one axis, a map over two, small maps over three; axes of
    /// `:log` ranges are logarithmic
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,

    /// Go on from the finished part of an interrupted scan
    #[arg(long, requires = "output")]
    pub(crate) resume: bool,

    /// How many threads; without it, one for each core. The results are the same
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
}
