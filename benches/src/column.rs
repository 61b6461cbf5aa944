//! Columns whose times do not depend on where a heap puts them.

use std::ops::{Deref, DerefMut};

/// The bytes of a page.
const PAGE: usize = 4096;

/// Numbers that start with a page, as those of every other column do.
#[derive(Clone, Debug, Default)]
pub struct Column {
    memory: Vec<f64>,
    first: usize,
    length: usize,
}

impl Column {
    /// So many zeros.
    pub fn zeros(length: usize) -> Self {
        let memory = vec![0.0; length + PAGE / size_of::<f64>()];
        let place = memory.as_ptr().addr();
        Self {
            first: (place.next_multiple_of(PAGE) - place) / size_of::<f64>(),
            memory,
            length,
        }
    }
}

impl From<&[f64]> for Column {
    fn from(numbers: &[f64]) -> Self {
        let mut column = Self::zeros(numbers.len());
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
