//! Columns whose times do not depend on where a heap puts them.
//!
//! Columns that begin at the same place of a page share the few lines of the nearest cache that belong to that place; and a
//! load some lines behind stores under way waits for them. So each has a line of its own: results those from 0 on,
//! inputs those behind them.

use std::ops::{Deref, DerefMut};

/// The bytes of a page.
const PAGE: usize = 4096;

/// The bytes of a line of the cache.
const LINE: usize = 64;

/// The line of the first input: there are no more results than that.
pub const FIRST_INPUT: usize = 26;

/// Numbers that start with a certain line of a page.
#[derive(Debug)]
pub struct Column {
    memory: Vec<f64>,
    first: usize,
    length: usize,
}

impl Column {
    /// Creates a column of zeros, from this line of a page on.
    pub fn zeros(length: usize, line: usize) -> Self {
        let memory = vec![0.0; length + 2 * PAGE / size_of::<f64>()];
        let place = memory.as_ptr().addr();
        let start = place.next_multiple_of(PAGE) + line * LINE % PAGE;
        Self {
            first: (start - place) / size_of::<f64>(),
            memory,
            length,
        }
    }

    /// An input: these numbers from the line of its number on.
    pub fn input(number: usize, numbers: &[f64]) -> Self {
        let mut column = Self::zeros(numbers.len(), FIRST_INPUT + number);
        column.copy_from_slice(numbers);
        column
    }
}

impl Deref for Column {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.memory[self.first..self.first + self.length]
    }
}

impl DerefMut for Column {
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.memory[self.first..self.first + self.length]
    }
}

impl AsRef<[f64]> for Column {
    fn as_ref(&self) -> &[f64] {
        self
    }
}
