//! The number that a reduction keeps for a group, and how it takes values.

use crate::extremes::Extremes;
use crate::summary::{Bins, SUMS, Summary, Wanted};

use super::super::chunk::Block;
use super::Statistic;

/// What is kept of a group, or of a bin of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cell {
    /// The largest or smallest value, or the sum.
    value: f64,
    /// The point of that value, or how many values there are.
    pub(super) number: u64,
}

impl Cell {
    /// Before any value.
    pub(super) const fn empty(statistic: Statistic) -> Self {
        let value = match statistic {
            Statistic::Maximum | Statistic::ArgMaximum => f64::NEG_INFINITY,
            Statistic::Minimum | Statistic::ArgMinimum => f64::INFINITY,
            Statistic::Mean | Statistic::CountAbove(_) | Statistic::Histogram { .. } => 0.0,
        };
        Self { value, number: 0 }
    }

    /// What the statistic of one cell says.
    pub(super) fn value(&self, statistic: Statistic) -> Option<f64> {
        match statistic {
            Statistic::CountAbove(_) | Statistic::Histogram { .. } => Some(self.number as f64),
            Statistic::Mean => (self.number > 0).then(|| self.value / self.number as f64),
            // Quantities are finite: an infinity is what it was in the beginning.
            _ => self.value.is_finite().then_some(self.value),
        }
    }

    pub(super) fn to_bytes(self) -> [u8; 16] {
        let mut bytes = [0; 16];
        bytes[..8].copy_from_slice(&self.value.to_le_bytes());
        bytes[8..].copy_from_slice(&self.number.to_le_bytes());
        bytes
    }

    pub(super) fn from_bytes(bytes: &[u8; 16]) -> Self {
        let both = u128::from_le_bytes(*bytes);
        Self {
            value: f64::from_bits(both as u64),
            number: (both >> 64) as u64,
        }
    }
}

/// Takes what was wanted of a block into the cells of one group.
pub(super) fn take(
    statistic: Statistic,
    cells: &mut [Cell],
    block: &Block<'_>,
    (summary, wanted): (&Summary, &Wanted),
) {
    let Some(cell) = cells.first_mut() else {
        return;
    };
    let Extremes {
        least, greatest, ..
    } = summary.extremes;
    match statistic {
        Statistic::Maximum | Statistic::ArgMaximum => {
            if greatest > cell.value {
                cell.value = greatest;
                if statistic.locates() {
                    cell.number = block.first + summary.first_greatest as u64;
                }
            }
        }
        Statistic::Minimum | Statistic::ArgMinimum => {
            if least < cell.value {
                cell.value = least;
                if statistic.locates() {
                    cell.number = block.first + summary.first_least as u64;
                }
            }
        }
        Statistic::Mean => {
            cell.value += summary.sum;
            cell.number += block.points;
        }
        Statistic::CountAbove(threshold) => {
            let mut counts = wanted.thresholds.iter().zip(&summary.above);
            let of_threshold = counts.find(|(known, _)| **known == threshold);
            cell.number += of_threshold.map_or(0, |(_, count)| *count);
        }
        Statistic::Histogram { low, high, bins } => {
            let count = bins;
            let mut counts = wanted.bins.iter().zip(&summary.counts);
            let of_bins = counts.find(|(known, _)| **known == Bins { low, high, count });
            for (cell, count) in cells
                .iter_mut()
                .zip(of_bins.into_iter().flat_map(|(_, of)| of))
            {
                cell.number += count;
            }
        }
    }
}

/// Takes consecutive values, the first that of `point`, into the cells of one group. Comparisons
/// with NaN, the mark of what does not exist, are false.
pub(super) fn fold(statistic: Statistic, cells: &mut [Cell], point: u64, values: &[f64]) {
    let Some(cell) = cells.first_mut() else {
        return;
    };
    match statistic {
        Statistic::Maximum | Statistic::ArgMaximum => {
            let top = Extremes::of(values).greatest;
            if top > cell.value {
                cell.value = top;
                if statistic.locates() {
                    cell.number = first(values, top, point);
                }
            }
        }
        Statistic::Minimum | Statistic::ArgMinimum => {
            let least = Extremes::of(values).least;
            if least < cell.value {
                cell.value = least;
                if statistic.locates() {
                    cell.number = first(values, least, point);
                }
            }
        }
        Statistic::Mean => {
            // The block is summed alone, so that rounding grows with the blocks, not with the points.
            let sums = in_lanes(
                values,
                0.0,
                |sum, value| {
                    if value.is_nan() { sum } else { sum + value }
                },
            );
            cell.value += sums.into_iter().sum::<f64>();
            cell.number += values.iter().filter(|value| !value.is_nan()).count() as u64;
        }
        Statistic::CountAbove(threshold) => {
            cell.number += values.iter().filter(|&&value| value > threshold).count() as u64;
        }
        Statistic::Histogram { low, high, bins } => {
            let count = bins;
            let bins = Bins { low, high, count };
            for value in values.iter().filter(|value| !value.is_nan()) {
                if let Some(cell) = cells.get_mut(bins.place(*value)) {
                    cell.number += 1;
                }
            }
        }
    }
}

/// Folds every eighth value for itself.
fn in_lanes(values: &[f64], start: f64, step: impl Fn(f64, f64) -> f64) -> [f64; SUMS] {
    let mut lanes = [start; SUMS];
    let (packs, rest) = values.as_chunks::<SUMS>();
    for pack in packs {
        for (lane, value) in lanes.iter_mut().zip(pack) {
            *lane = step(*lane, *value);
        }
    }
    for (lane, value) in lanes.iter_mut().zip(rest) {
        *lane = step(*lane, *value);
    }
    lanes
}

/// The point of the first value that is the one wanted; that of the first value is `point`.
fn first(values: &[f64], wanted: f64, point: u64) -> u64 {
    let place = values.iter().position(|value| *value == wanted);
    point + place.unwrap_or(0) as u64
}

/// Takes what later points have kept.
pub(super) fn merge(statistic: Statistic, cells: &mut [Cell], later: &[Cell]) {
    for (cell, later) in cells.iter_mut().zip(later) {
        match statistic {
            Statistic::Maximum | Statistic::ArgMaximum => {
                if later.value > cell.value {
                    *cell = *later;
                }
            }
            Statistic::Minimum | Statistic::ArgMinimum => {
                if later.value < cell.value {
                    *cell = *later;
                }
            }
            Statistic::Mean | Statistic::CountAbove(_) | Statistic::Histogram { .. } => {
                cell.value += later.value;
                cell.number += later.number;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const VALUES: [f64; 7] = [0.5, f64::NAN, 2.0, -1.0, 2.0, f64::NAN, 0.25];

    fn folded(statistic: Statistic, width: usize) -> Vec<Cell> {
        let whole = {
            let mut cells = vec![Cell::empty(statistic); width];
            fold(statistic, &mut cells, 10, &VALUES);
            cells
        };
        let mut parts = vec![Cell::empty(statistic); width];
        for (first, values) in [(10, &VALUES[..3]), (13, &VALUES[3..])] {
            let mut part = vec![Cell::empty(statistic); width];
            fold(statistic, &mut part, first, values);
            merge(statistic, &mut parts, &part);
        }
        assert_eq!(parts, whole, "{statistic}");
        let bytes: Vec<_> = whole.iter().map(|cell| cell.to_bytes()).collect();
        assert_eq!(
            bytes.iter().map(Cell::from_bytes).collect::<Vec<_>>(),
            whole
        );
        whole
    }

    #[test]
    fn what_does_not_exist_takes_no_part() {
        let value = |statistic| folded(statistic, 1)[0].value(statistic);
        assert_eq!(value(Statistic::Maximum), Some(2.0));
        assert_eq!(value(Statistic::Minimum), Some(-1.0));
        assert_eq!(value(Statistic::Mean), Some(0.75));
        assert_eq!(value(Statistic::CountAbove(0.25)), Some(3.0));
        assert_eq!(
            folded(Statistic::ArgMaximum, 1)[0].number,
            12,
            "the first of two"
        );
        assert_eq!(folded(Statistic::ArgMinimum, 1)[0].number, 13);
    }

    #[test]
    fn a_group_of_nothing_has_no_value_and_the_count_zero() {
        for (statistic, expected) in [
            (Statistic::Maximum, None),
            (Statistic::Minimum, None),
            (Statistic::Mean, None),
            (Statistic::CountAbove(0.0), Some(0.0)),
        ] {
            let mut cells = [Cell::empty(statistic)];
            fold(statistic, &mut cells, 0, &[f64::NAN; 3]);
            assert_eq!(cells[0].value(statistic), expected);
        }
    }

    #[test]
    fn bins_have_their_lower_end_and_the_last_one_both() {
        let statistic = Statistic::Histogram {
            low: 0.0,
            high: 2.0,
            bins: 4,
        };
        let counts: Vec<_> = folded(statistic, 6)
            .iter()
            .map(|cell| cell.number)
            .collect();
        assert_eq!(counts, [1, 1, 1, 0, 2, 0]);
    }
}
