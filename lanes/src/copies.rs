//! Columns copied to where reading them does not wait for stores.
//!
//! A processor takes a load and a store for the same place as long as the low bits of their addresses agree, a page's
//! worth of them: a load that is some lines *behind* the stores under way, in that sense, waits for them. Where it is
//! ahead of them, or shares no line with them, it does not. That is not a detail: on Zen 4 a grid takes 12 ms with its
//! tables ahead of its results, 30 ms with them one line behind, 16 ms where a heap happened to put them.

use std::ops::Range;

/// How many numbers are a page.
const PAGE: usize = 4096 / size_of::<f64>();

/// How far ahead of the results a copy is.
const FAR: Range<usize> = PAGE / 4..3 * PAGE / 4;

/// Two copies of each column, half a page apart. One of them is ahead of any results by a quarter of a page at least, and by
/// less than three: also ahead of, or far behind, the other results of the row, which lie within a quarter of the first.
pub(crate) struct Copies<const COLUMNS: usize> {
    memory: Vec<f64>,
    /// Where the columns of each copy start.
    starts: [[usize; COLUMNS]; 2],
    rows: usize,
}

impl<const COLUMNS: usize> Copies<COLUMNS> {
    /// Copies of columns of the same length. Their numbers share lines of the cache as `results` does, which has the same
    /// length.
    pub(crate) fn of(columns: &[&[f64]; COLUMNS], results: &[f64]) -> Self {
        let rows = results.len();
        let stretch = rows + 2 * PAGE;
        let mut memory = vec![0.0; 2 * COLUMNS * stretch];
        let mut starts = [[0; COLUMNS]; 2];
        for (copy, starts) in starts.iter_mut().enumerate() {
            for (place, (column, start)) in columns.iter().zip(starts).enumerate() {
                let first = (copy * COLUMNS + place) * stretch;
                let quarters = 1 + 2 * copy;
                *start = first + ahead(results, &memory[first..]) + quarters * PAGE / 4;
                memory[*start..*start + rows].copy_from_slice(column);
            }
        }
        Self {
            memory,
            starts,
            rows,
        }
    }

    /// The columns for these results.
    #[inline]
    pub(crate) fn columns(&self, results: &[f64]) -> [&[f64]; COLUMNS] {
        let [starts, others] = &self.starts;
        let is_ahead = |start: &usize| FAR.contains(&ahead(&self.memory[*start..], results));
        let starts = if starts.iter().all(is_ahead) {
            starts
        } else {
            others
        };
        starts.map(|start| &self.memory[start..start + self.rows])
    }
}

/// By how many numbers, less than a page, one column is ahead of another within their pages.
fn ahead(column: &[f64], of: &[f64]) -> usize {
    let place = |numbers: &[f64]| numbers.as_ptr().addr() / size_of::<f64>();
    place(column).wrapping_sub(place(of)) % PAGE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_any_results_a_copy_is_far_ahead() {
        let columns = [[1.0; 100], [2.0; 100]];
        let memory = vec![0.0; 2 * PAGE];
        let copies = Copies::of(&columns.each_ref().map(|c| c.as_slice()), &memory[3..103]);
        for first in 0..PAGE {
            let results = &memory[first..first + 100];
            let found = copies.columns(results);
            assert_eq!(found, columns);
            for column in found {
                assert!(FAR.contains(&ahead(column, results)), "{first}");
            }
        }
        // In the results that the copies were made for, lines of the cache are lines of the columns.
        let found = copies.columns(&memory[3..103]);
        let lines = found.map(|column| ahead(column, &memory[3..]) % 8);
        assert_eq!(lines, [0, 0]);
    }
}
