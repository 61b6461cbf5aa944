//! Tables as data, shown alike on the terminal and in HTML.

use std::fmt::Write as _;

use rotor_core::text::significant;

/// A table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Table {
    /// What it shows.
    pub(crate) title: String,
    /// Headings of the columns.
    pub(crate) headings: Vec<&'static str>,
    /// Rows of as many cells as there are headings.
    pub(crate) rows: Vec<Vec<Cell>>,
    /// Sentences below it.
    pub(crate) notes: Vec<String>,
}

/// A cell of a table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Cell {
    /// Words, to the left.
    Text(String),
    /// A symbol with `_` before its subscript.
    Symbol(&'static str),
    /// A number, to the right.
    Number(String),
}

impl Cell {
    /// Words.
    pub(crate) fn text(text: impl Into<String>) -> Self {
        Self::Text(text.into())
    }

    #[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_line_of_a_wrapped_sentence_is_too_wide_and_no_word_is_lost() {
        let sentence = "the width of the region ".repeat(20);
        let text = wrapped(&sentence, "  ");
        assert!(text.lines().all(|line| line.chars().count() <= LINE));
        assert!(text.lines().count() > 4);
        let words: Vec<_> = text.split_whitespace().collect();
        assert_eq!(words, sentence.split_whitespace().collect::<Vec<_>>());
    }
}
