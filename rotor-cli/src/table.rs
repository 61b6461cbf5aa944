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

    /// A number with so many significant digits.
    pub(crate) fn number(value: f64, digits: usize) -> Self {
        Self::Number(significant(value, digits))
    }

    /// Creates a cell that stays empty.
    pub(crate) fn empty() -> Self {
        Self::Text(String::new())
    }

    fn as_str(&self) -> &str {
        match self {
            Self::Text(text) | Self::Number(text) => text,
            Self::Symbol(symbol) => symbol,
        }
    }
}

/// The widest line on the terminal.
pub(crate) const LINE: usize = 100;

impl Table {
    /// The table as plain text, at most [`LINE`] wide; a last column that is too long goes on in lines below.
    pub(crate) fn plain(&self) -> String {
        let widths: Vec<usize> = (0..self.headings.len())
            .map(|column| self.width(column))
            .collect();
        let mut text = format!("{}\n", self.title);
        if self.headings.iter().any(|heading| !heading.is_empty()) {
            let cells = self
                .headings
                .iter()
                .enumerate()
                .map(|(column, heading)| (*heading, self.is_numeric(column)));
            push_line(&mut text, cells, &widths);
        }
        for row in &self.rows {
            let cells = row
                .iter()
                .map(|cell| (cell.as_str(), matches!(cell, Cell::Number(_))));
            push_line(&mut text, cells, &widths);
        }
        for note in &self.notes {
            text.push_str(&wrapped(note, "  "));
        }
        text
    }

    /// Whether a column holds numbers, which stand to the right, its heading too.
    pub(crate) fn is_numeric(&self, column: usize) -> bool {
        self.rows
            .iter()
            .any(|row| matches!(row.get(column), Some(Cell::Number(_))))
    }

    fn width(&self, column: usize) -> usize {
        let cells = self
            .rows
            .iter()
            .filter_map(|row| row.get(column))
            .map(Cell::as_str);
        let headings = self.headings.get(column).copied();
        cells
            .chain(headings)
            .map(|text| text.chars().count())
            .max()
            .unwrap_or(0)
    }
}

fn push_line<'a>(
    text: &mut String,
    cells: impl Iterator<Item = (&'a str, bool)>,
    widths: &[usize],
) {
    let mut line = String::new();
    for ((cell, right), &width) in cells.zip(widths) {
        if right {
            let _ = write!(line, "  {cell:>width$}");
        } else {
            let _ = write!(line, "  {cell:<width$}");
        }
    }
    let line = line.trim_end();
    if line.chars().count() <= LINE {
        text.push_str(line);
        text.push('\n');
    } else {
        let before: usize = widths.iter().rev().skip(1).map(|width| width + 2).sum();
        let start: String = line.chars().take(before).collect();
        let last: String = line.chars().skip(before).collect();
        let lines = wrapped(&last, &" ".repeat(before + 2));
        text.push_str(&start);
        text.push_str(&lines.chars().skip(before).collect::<String>());
    }
}

/// A sentence in lines of at most [`LINE`] characters, each after `indent`.
pub(crate) fn wrapped(sentence: &str, indent: &str) -> String {
    let mut text = String::new();
    let mut line = indent.to_owned();
    for word in sentence.split_whitespace() {
        if line.len() > indent.len() && line.chars().count() + 1 + word.chars().count() > LINE {
            text.push_str(&line);
            text.push('\n');
            line = format!("{indent}  ");
        } else if line.len() > indent.len() {
            line.push(' ');
        }
        line.push_str(word);
    }
    text.push_str(&line);
    text.push('\n');
    text
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
