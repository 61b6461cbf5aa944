//! Scans, reductions and tables that are not possible, or stopped early.

use thiserror::Error;

use crate::input::Variable;

/// Why an axis, a scan, a reduction or a table of rotors is not possible, or why a scan ended early.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum StudyError {
    /// An axis without a value: the whole scan would have no point.
    #[error("the axis of {input} has no value; it must have at least one")]
    EmptyAxis {
        /// What varies first along the axis.
        input: &'static str,
    },
    /// One value cannot be both ends of a range.
    #[error(
        "the axis of {input} runs from {start} to {stop} in one value, which cannot be both; \
         give at least 2 values, or the one value alone"
    )]
    OneValueForTwoEnds {
        /// What varies.
        input: &'static str,
        /// First value.
        start: f64,
        /// Last value.
        stop: f64,
    },
    /// A value that is not allowed, NaN among them.
    #[error("value {} of the axis of {name} is {value}; it must be {allowed}", .index + 1,
        name = .variable.name(), allowed = .variable.allowed())]
    NotAllowed {
        /// What varies.
        variable: Variable,
        /// Which value of the axis, from 0.
        index: u64,
        /// The value.
        value: f64,
    },
    /// A logarithmic range needs ends above zero.
    #[error(
        "the logarithmic axis of {input} runs from {start} to {stop}; both ends must be > 0 for a \
         constant ratio between neighbours"
    )]
    NoLogarithm {
        /// What varies.
        input: &'static str,
        /// First value.
        start: f64,
        /// Last value.
        stop: f64,
    },
    /// A distribution with parameters that it does not have.
    #[error("the distribution of {input} has {parameter} = {value}; it must be {allowed}")]
    Distribution {
        /// What varies.
        input: &'static str,
        /// Such as `the standard deviation`.
        parameter: &'static str,
        /// The value.
        value: f64,
        /// What it has to be.
        allowed: &'static str,
    },
    /// What is linked has a different number of values.
    #[error(
        "{first} has {first_length} values and {other} has {other_length}; what is varied \
         together must have the same number"
    )]
    LinkedLengths {
        /// What is linked first.
        first: &'static str,
        /// How many values it has.
        first_length: u64,
        /// The one that differs.
        other: &'static str,
        /// How many values that has.
        other_length: u64,
    },
    /// A variable is varied by two axes, or twice by one.
    #[error("{input} is varied twice; it can be varied by one axis only")]
    VariedTwice {
        /// What varies.
        input: &'static str,
    },
    /// Nothing is varied.
    #[error("nothing is varied; a scan needs at least one axis")]
    NoAxis,
    /// No result is asked for.
    #[error("no quantity is asked for; a scan needs at least one")]
    NoQuantity,
    /// A quantity that depends on the speed, which is not varied.
    #[error(
        "{quantity} is at a speed, which is not varied; vary the speed, also if it has one value"
    )]
    NoSpeed {
        /// The quantity.
        quantity: &'static str,
    },
    /// More points than can be counted.
    #[error(
        "the axes have {lengths} values, together more than {most} points (2^53), the most \
         that a scan can have"
    )]
    TooManyPoints {
        /// The lengths of the axes, `401 × 721`.
        lengths: String,
        /// The most.
        most: u64,
    },
    /// A reduction over what is not varied.
    #[error("the reduction {reduction} is over {input}, which is not varied; varied are {varied}")]
    NotVaried {
        /// The reduction as it is written.
        reduction: String,
        /// What varies.
        input: &'static str,
        /// What is varied.
        varied: String,
    },
    /// A reduction that keeps too many results in memory.
    #[error(
        "the reductions keep {cells} results in memory; the most is {most}. Reduce over a longer \
         axis or over all, or write the points to a file"
    )]
    TooManyResults {
        /// Results that would be kept.
        cells: u64,
        /// The most.
        most: u64,
    },
    /// More numbers than are collected in memory.
    #[error(
        "{numbers} numbers are more than can be collected in memory; the most is {} (2^32). Write them to a file, or reduce them",
        .most
    )]
    TooMuchToCollect {
        /// Points times quantities.
        numbers: u64,
        /// The most.
        most: u64,
    },
    /// A histogram without bins or with ends that are none.
    #[error(
        "a histogram from {low} to {high} in {bins} bins; the ends must be finite numbers that \
         increase, and the bins 1 to {most}"
    )]
    Histogram {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
        /// Bins.
        bins: u32,
        /// The most bins.
        most: u32,
    },
    /// A threshold that is no number.
    #[error("the threshold is {value}; it must be a finite number")]
    Threshold {
        /// The value.
        value: f64,
    },
    /// The state of an interrupted reduction does not belong to this scan.
    #[error("the saved state of the reductions does not belong to this scan, or is damaged")]
    ForeignState,
    /// The threads could not be started.
    #[error("the threads could not be started: {reason}")]
    Threads {
        /// What the system said.
        reason: String,
    },
    /// It was cancelled.
    #[error("the scan was cancelled after {chunks} of {all} chunks")]
    Cancelled {
        /// Chunks that were finished and delivered.
        chunks: u64,
        /// All chunks.
        all: u64,
    },
    /// There is no column to tell how many rotors there are.
    #[error("no input has a column; at least one must have")]
    NoColumn,
    /// A column of a table is longer or shorter than the first.
    #[error(
        "the column of {input} has {length} rows; it must have {expected}, as that of {first} has"
    )]
    ColumnLengths {
        /// Its input.
        input: &'static str,
        /// Its length.
        length: usize,
        /// The input of the first column.
        first: &'static str,
        /// The length of that.
        expected: usize,
    },
    /// A quantity that is at a speed: a table of rotors has none.
    #[error("{quantity} is at a speed, and a table of rotors has none")]
    NoSpeedInTable {
        /// The quantity.
        quantity: &'static str,
    },
    /// An input has two columns.
    #[error("{input} has two columns; an input has one at most")]
    TwoColumns {
        /// The input.
        input: &'static str,
    },
}
