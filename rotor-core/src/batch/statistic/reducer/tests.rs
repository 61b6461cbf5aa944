use super::super::{Statistic, WithGaps, WithoutGaps};
use super::*;

/// A column as it is, and its squares.
struct Squares;

impl Kernel<0, 1, 2> for Squares {
    #[inline(always)]
    fn evaluate<S: Simd>(_: S, _: [Pack<S>; 0], [x]: [Pack<S>; 1]) -> [Pack<S>; 2] {
        [x, x * x]
    }
}

const STATISTICS: [Statistic; 9] = [
    Statistic::Maximum,
    Statistic::Minimum,
    Statistic::ArgMaximum,
    Statistic::ArgMinimum,
    Statistic::Mean,
    Statistic::CountAbove(-1.0),
    Statistic::CountAbove(0.25),
    Statistic::CountAbove(1.0),
    Statistic::Histogram {
        low: -0.5,
        high: 1.5,
        bins: 4,
    },
];

/// Halves from -2 to 2, each more than once in a longer column, so that sums are exact; with gaps every fourth is NaN.
fn column(length: usize, from: usize, gaps: bool) -> Vec<f64> {
    let value = |row: usize| match (row + from) % 4 {
        1 if gaps => f64::NAN,
        _ => ((row + from) * 5 % 9) as f64 / 2.0 - 2.0,
    };
    (0..length).map(value).collect()
}

fn reducer(level: Level, accumulators: &[Accumulator]) -> Reducer {
    let mut wanted = Wanted::default();
    STATISTICS
        .into_iter()
        .for_each(|statistic| wanted.add(statistic));
    let reducer = Reducer::new(wanted, accumulators, 2);
    Reducer { level, ..reducer }
}

fn take(reducer: &mut Reducer, values: &[f64], gaps: bool) {
    let places = [Some(0), Some(1)];
    let taken = if gaps {
        reducer.reduce::<Squares, WithGaps, 0, 1, 2>(places, &[], [values])
    } else {
        reducer.reduce::<Squares, WithoutGaps, 0, 1, 2>(places, &[], [values])
    };
    assert!(taken.is_some());
}

/// Numbers above a threshold of those that are no NaN.
fn above(values: &[f64], threshold: f64) -> u64 {
    values.iter().filter(|value| **value > threshold).count() as u64
}

/// How many numbers are in each bin of the histogram, and below and above all of them.
fn counts(values: &[f64]) -> Vec<u64> {
    let ends = [f64::NEG_INFINITY, -0.5, 0.0, 0.5, 1.0];
    let within = ends.windows(2).map(|ends| {
        let in_bin = |value: &&f64| **value >= ends[0] && **value < ends[1];
        values.iter().filter(in_bin).count() as u64
    });
    let last = values.iter().filter(|value| (1.0..=1.5).contains(*value));
    let last = last.count() as u64;
    within.chain([last, above(values, 1.5)]).collect()
}

#[test]
fn a_column_as_a_whole_is_what_its_numbers_say() {
    for (length, gaps) in [1, 2, 7, 8, 9, 16, 35]
        .into_iter()
        .flat_map(|n| [(n, false), (n, true)])
    {
        let values = column(length, 0, gaps);
        let squares: Vec<f64> = values.iter().map(|value| value * value).collect();
        for level in Level::available() {
            let mut reducer = reducer(level, &[]);
            take(&mut reducer, &values, gaps);
            for (place, column) in [&values, &squares].into_iter().enumerate() {
                let found = reducer.summary(place).unwrap();
                let numbers: Vec<f64> = column
                    .iter()
                    .copied()
                    .filter(|value| !value.is_nan())
                    .collect();
                let row = |wanted: f64| column.iter().position(|value| *value == wanted);
                let extremes = Extremes::of(column);
                assert_eq!(found.extremes, extremes, "{level}");
                assert_eq!(Some(found.first_least), row(extremes.least), "{level}");
                assert_eq!(
                    Some(found.first_greatest),
                    row(extremes.greatest),
                    "{level}"
                );
                assert_eq!(found.present, numbers.len() as u64);
                assert_eq!(found.sum, numbers.iter().sum::<f64>());
                let expected = [-1.0, 0.25, 1.0].map(|threshold| above(column, threshold));
                assert_eq!(found.above, expected, "{level} {length}");
                assert_eq!(found.counts, [counts(column)], "{level} {length}");
            }
        }
    }
}

#[test]
fn each_row_is_what_its_numbers_of_all_columns_say() {
    const COLUMNS: usize = 5;
    for (length, gaps) in [1, 2, 7, 9, 35]
        .into_iter()
        .flat_map(|n| [(n, false), (n, true)])
    {
        for level in Level::available() {
            let mut reducer = reducer(level, &STATISTICS.map(Accumulator::new));
            let columns: Vec<_> = (0..COLUMNS)
                .map(|from| column(length, from, gaps))
                .collect();
            let empty = |statistic: &Statistic| match statistic {
                Statistic::Maximum | Statistic::ArgMaximum => f64::NEG_INFINITY,
                Statistic::Minimum | Statistic::ArgMinimum => f64::INFINITY,
                _ => 0.0,
            };
            for place in 0..2 {
                for accumulator in reducer.accumulators(place) {
                    let value = empty(&accumulator.statistic());
                    let zeros = vec![0.0; length];
                    accumulator.resume([&vec![value; length], &zeros, &zeros]);
                }
            }
            for (number, values) in columns.iter().enumerate() {
                reducer.first = (100 * number) as u64;
                take(&mut reducer, values, gaps);
            }
            for row in 0..length {
                let values: Vec<f64> = columns.iter().map(|column| column[row]).collect();
                let squares: Vec<f64> = values.iter().map(|value| value * value).collect();
                assert_row(reducer.accumulators(0), row, &values);
                assert_row(reducer.accumulators(1), row, &squares);
            }
        }
    }
}

/// Holds what was kept of a row to its numbers in each column.
fn assert_row(accumulators: &[Accumulator], row: usize, values: &[f64]) {
    let numbers: Vec<f64> = values
        .iter()
        .copied()
        .filter(|value| !value.is_nan())
        .collect();
    let extremes = Extremes::of(values);
    let point = |wanted: f64| {
        let column = values.iter().position(|value| *value == wanted);
        column.map_or(0, |column| 100 * column + row) as f64
    };
    for accumulator in accumulators {
        let [kept, number, rest] = accumulator.kept().map(|kept| kept[row]);
        assert_eq!(rest, 0.0, "these sums are exact");
        match accumulator.statistic() {
            Statistic::Maximum => assert_eq!(kept, extremes.greatest),
            Statistic::Minimum => assert_eq!(kept, extremes.least),
            Statistic::ArgMaximum => {
                assert_eq!(
                    (kept, number),
                    (extremes.greatest, point(extremes.greatest))
                );
            }
            Statistic::ArgMinimum => {
                assert_eq!((kept, number), (extremes.least, point(extremes.least)));
            }
            Statistic::Mean => {
                assert_eq!((kept, number), (numbers.iter().sum(), numbers.len() as f64));
            }
            Statistic::CountAbove(threshold) => {
                assert_eq!(number, above(values, threshold) as f64);
            }
            // That of the last column, to be counted by whoever has the counts.
            Statistic::Histogram { .. } => {
                let last = &values[values.len() - 1..];
                let place = counts(last).iter().position(|count| *count == 1);
                assert_eq!(
                    place.map(|place| place as f64),
                    (!number.is_nan()).then_some(number)
                );
            }
        }
    }
}

#[test]
fn a_sum_has_the_same_digits_on_every_level() {
    // Reciprocals: their sums are rounded, and differ with the order.
    for length in [1, 7, 8, 35, 4096] {
        let values: Vec<f64> = (1..=length).map(|row| f64::from(row).recip()).collect();
        // Eight sums side by side, which are then added.
        let mut sums = [0.0; 8];
        for (row, value) in values.iter().enumerate() {
            sums[row % 8] += value;
        }
        let expected: f64 = sums.into_iter().sum();
        for level in Level::available() {
            let mut reducer = reducer(level, &[]);
            take(&mut reducer, &values, false);
            assert_eq!(
                reducer.summary(0).unwrap().sum,
                expected,
                "{level} {length}"
            );
        }
    }
}
