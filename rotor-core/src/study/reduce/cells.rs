//! The numbers that a reduction keeps for its groups, and how it takes others.

use std::ops::Range;

use crate::batch::extremes::Extremes;
use crate::batch::statistic::{Accumulator, Bins, Statistic, Summary, Wanted};

/// What is kept of a group, or of a bin of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cell {
    /// The largest or smallest value, or the sum.
    value: f64,
    /// The point of that value, or how many values there are.
    pub(super) number: u64,
    /// What rounding has taken from the sum.
    rest: f64,
}

impl Cell {
    /// What the statistic of one cell says.
    pub(super) fn value(&self, statistic: Statistic) -> Option<f64> {
        match statistic {
            Statistic::CountAbove(_) | Statistic::Histogram { .. } => Some(self.number as f64),
            Statistic::Mean => {
                (self.number > 0).then(|| (self.value + self.rest) / self.number as f64)
            }
            // Quantities are finite: an infinity is what it was in the beginning. A zero has no sign.
            _ => self.value.is_finite().then_some(self.value + 0.0),
        }
    }
}

/// Cells, one after the other, in three columns. Whole numbers are kept as they are computed with: there are no more than 2^53
/// points.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cells {
    values: Vec<f64>,
    numbers: Vec<f64>,
    rests: Vec<f64>,
}

/// Adds to a sum, and what that loses by rounding to its rest, whichever is the larger of both (Knuth).
fn add((sum, rest): (&mut f64, &mut f64), term: f64) {
    let next = *sum + term;
    let taken = next - *sum;
    *rest += (*sum - (next - taken)) + (term - taken);
    *sum = next;
}

impl Cells {
    /// Creates so many cells, before any value.
    pub(super) fn empty(statistic: Statistic, count: usize) -> Self {
        let value = match statistic {
            Statistic::Maximum | Statistic::ArgMaximum => f64::NEG_INFINITY,
            Statistic::Minimum | Statistic::ArgMinimum => f64::INFINITY,
            Statistic::Mean | Statistic::CountAbove(_) | Statistic::Histogram { .. } => 0.0,
        };
        Self {
            values: vec![value; count],
            numbers: vec![0.0; count],
            rests: vec![0.0; count],
        }
    }

    /// The cells of a range.
    pub(super) fn range(&self, range: Range<usize>) -> Option<impl Iterator<Item = Cell>> {
        let (numbers, rests) = (
            self.numbers.get(range.clone())?,
            self.rests.get(range.clone())?,
        );
        let cells = self.values.get(range)?.iter().zip(numbers).zip(rests);
        Some(cells.map(|((value, number), rest)| Cell {
            value: *value,
            number: *number as u64,
            rest: *rest,
        }))
    }

    /// Gives an accumulator what was kept of its rows, a cell each.
    pub(super) fn begin(&self, rows: Range<usize>, accumulator: &mut Accumulator) {
        if let Statistic::Histogram { .. } = accumulator.statistic() {
            return accumulator.resize(rows.len());
        }
        let columns = [&self.values, &self.numbers, &self.rests];
        accumulator.resume(columns.map(|column| column.get(rows.clone()).unwrap_or_default()));
    }

    /// Takes what an accumulator has of its rows; the first cells of a row are `stride` beyond those of the row before.
    pub(super) fn end(&mut self, start: usize, stride: usize, accumulator: &Accumulator) {
        let kept = accumulator.kept();
        let [values, numbers, _] = kept;
        if let Statistic::Histogram { .. } = accumulator.statistic() {
            for (row, bin) in numbers.iter().enumerate().filter(|(_, bin)| !bin.is_nan()) {
                if let Some(count) = self.numbers.get_mut(start + row * stride + *bin as usize) {
                    *count += 1.0;
                }
            }
            return;
        }
        let cells = start..start + values.len();
        let columns = [&mut self.values, &mut self.numbers, &mut self.rests];
        for (column, kept) in columns.into_iter().zip(kept) {
            if let Some(column) = column.get_mut(cells.clone()) {
                column.copy_from_slice(kept);
            }
        }
    }

    /// Takes what was found of a block, whose first point is `point`, into the cells of one group.
    pub(super) fn take(
        &mut self,
        statistic: Statistic,
        start: usize,
        point: u64,
        (summary, wanted): (&Summary, &Wanted),
    ) {
        let numbers = self.numbers.get_mut(start..).unwrap_or_default();
        let (Some(value), Some(number), Some(rest)) = (
            self.values.get_mut(start),
            numbers.first_mut(),
            self.rests.get_mut(start),
        ) else {
            return;
        };
        let Extremes {
            least, greatest, ..
        } = summary.extremes;
        match statistic {
            Statistic::Maximum | Statistic::ArgMaximum => {
                if greatest > *value {
                    *value = greatest;
                    *number = (point + summary.first_greatest as u64) as f64;
                }
            }
            Statistic::Minimum | Statistic::ArgMinimum => {
                if least < *value {
                    *value = least;
                    *number = (point + summary.first_least as u64) as f64;
                }
            }
            Statistic::Mean => {
                add((value, rest), summary.sum);
                *number += summary.present as f64;
            }
            Statistic::CountAbove(threshold) => {
                let mut counts = wanted.thresholds.iter().zip(&summary.above);
                let of_threshold = counts.find(|(known, _)| **known == threshold);
                *number += of_threshold.map_or(0.0, |(_, count)| *count as f64);
            }
            Statistic::Histogram { low, high, bins } => {
                let count = bins;
                let mut counts = wanted.bins.iter().zip(&summary.counts);
                let of_bins = counts.find(|(known, _)| **known == Bins { low, high, count });
                let counts = of_bins.into_iter().flat_map(|(_, counts)| counts);
                for (number, count) in numbers.iter_mut().zip(counts) {
                    *number += *count as f64;
                }
            }
        }
    }

    /// Takes what later points have kept, whose first cell is here at `start`.
    pub(super) fn merge(&mut self, statistic: Statistic, start: usize, later: &Self) {
        let values = self.values.get_mut(start..).unwrap_or_default();
        let numbers = self.numbers.get_mut(start..).unwrap_or_default();
        let rests = self.rests.get_mut(start..).unwrap_or_default();
        let cells = values.iter_mut().zip(numbers).zip(rests);
        let later = later.values.iter().zip(&later.numbers).zip(&later.rests);
        for (((value, number), rest), ((later, of_later), lost)) in cells.zip(later) {
            let is_better = match statistic {
                Statistic::Maximum | Statistic::ArgMaximum => later > value,
                Statistic::Minimum | Statistic::ArgMinimum => later < value,
                Statistic::Mean | Statistic::CountAbove(_) | Statistic::Histogram { .. } => {
                    add((value, rest), *later);
                    *rest += lost;
                    *number += of_later;
                    continue;
                }
            };
            if is_better {
                (*value, *number) = (*later, *of_later);
            }
        }
    }

    pub(super) fn to_bytes(&self) -> impl Iterator<Item = u8> {
        let numbers = self.values.iter().chain(&self.numbers).chain(&self.rests);
        numbers.flat_map(|number| number.to_le_bytes())
    }

    /// Reads what [`Cells::to_bytes`] wrote of as many; what is left of the bytes. None where there are too few.
    pub(super) fn read<'a>(&mut self, bytes: &'a [u8]) -> Option<&'a [u8]> {
        let length = 8 * (self.values.len() + self.numbers.len() + self.rests.len());
        let (own, rest) = bytes.split_at_checked(length)?;
        let numbers = self.values.iter_mut().chain(&mut self.numbers);
        let numbers = numbers.chain(&mut self.rests);
        for (number, bytes) in numbers.zip(own.as_chunks::<8>().0) {
            *number = f64::from_le_bytes(*bytes);
        }
        Some(rest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cells of two groups with these values and numbers.
    fn cells(values: [f64; 2], numbers: [f64; 2]) -> Cells {
        let (values, numbers) = (values.into(), numbers.into());
        let rests = vec![0.0; 2];
        Cells {
            values,
            numbers,
            rests,
        }
    }

    #[test]
    fn later_points_are_merged_where_they_belong() {
        let later = Cells {
            values: vec![3.0],
            numbers: vec![7.0],
            rests: vec![0.0],
        };
        for (statistic, expected) in [
            (Statistic::Maximum, (3.0, 7.0)),
            (Statistic::ArgMaximum, (3.0, 7.0)),
            (Statistic::Minimum, (2.0, 5.0)),
            (Statistic::ArgMinimum, (2.0, 5.0)),
            (Statistic::Mean, (5.0, 12.0)),
            (Statistic::CountAbove(0.0), (5.0, 12.0)),
        ] {
            let mut kept = cells([1.0, 2.0], [4.0, 5.0]);
            kept.merge(statistic, 1, &later);
            assert_eq!(
                kept,
                cells([1.0, expected.0], [4.0, expected.1]),
                "{statistic}"
            );
        }
        // Of equal values the first one stays.
        let mut kept = cells([1.0, 3.0], [4.0, 5.0]);
        kept.merge(Statistic::ArgMaximum, 1, &later);
        assert_eq!(kept, cells([1.0, 3.0], [4.0, 5.0]));
    }

    #[test]
    fn a_sum_of_many_parts_keeps_its_digits() {
        let mut sum = (0.0, 0.0);
        for _ in 0..1_000_000 {
            add((&mut sum.0, &mut sum.1), 0.1);
        }
        assert_eq!(sum.0 + sum.1, 100_000.0);
    }

    #[test]
    fn a_group_of_nothing_has_no_value_and_the_count_zero() {
        for (statistic, expected) in [
            (Statistic::Maximum, None),
            (Statistic::Minimum, None),
            (Statistic::Mean, None),
            (Statistic::CountAbove(0.0), Some(0.0)),
        ] {
            let cell = Cells::empty(statistic, 1)
                .range(0..1)
                .and_then(|mut cells| cells.next());
            assert_eq!(cell.and_then(|cell| cell.value(statistic)), expected);
        }
    }

    #[test]
    fn bytes_are_read_back_and_what_follows_is_left() {
        let written = cells([0.1, f64::NEG_INFINITY], [9_007_199_254_740_992.0, 3.0]);
        let mut bytes: Vec<u8> = written.to_bytes().collect();
        bytes.push(17);
        let mut read = Cells::empty(Statistic::Mean, 2);
        assert_eq!(read.read(&bytes), Some(&[17_u8][..]));
        assert_eq!(read, written);
        assert_eq!(read.read(&bytes[..20]), None);
    }
}
