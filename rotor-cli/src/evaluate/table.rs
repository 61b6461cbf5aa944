//! Reading a CSV table row by row, each with the line on which it starts, in bounded memory.

use std::io::{self, BufRead};

use csv::ByteRecord;

/// The longest row that is read; beyond it a quote was most likely never closed.
const LONGEST_ROW: usize = 1 << 20;

/// One row.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Row {
    /// The line of the file on which it starts, from 1.
    pub(crate) line: u64,
    /// Its fields, as bytes: only columns that are read need be UTF-8.
    pub(crate) fields: ByteRecord,
}

/// Why a row cannot be read.
#[derive(Debug, thiserror::Error)]
pub(crate) enum TableError {
    /// The system's error.
    #[error("{0}")]
    Stream(#[from] io::Error),
    /// A quoted field without its end.
    #[error("line {line}: a quoted field that starts in this row is never closed")]
    OpenQuote {
        /// Where the row starts.
        line: u64,
    },
    /// A row too long to be one.
    #[error("line {line}: this row is longer than {LONGEST_ROW} bytes; is a quote not closed?")]
    TooLong {
        /// Where the row starts.
        line: u64,
    },
    /// Text in two-byte units.
    #[error("line 1: this is UTF-16; save the table as UTF-8")]
    Utf16,
}

/// Splits a stream into rows. Blank lines are skipped, lines end with LF or CRLF, a byte order mark is dropped.
///
/// The rows are split here and the fields by the `csv` crate, because the crate alone counts lines wrongly after a
/// blank line and takes an unclosed quote for the end of the table.
pub(crate) struct Rows<R> {
    source: R,
    line: u64,
    row: Vec<u8>,
}

impl<R: BufRead> Rows<R> {
    /// Rows of `source`, from its first line.
    pub(crate) fn new(source: R) -> Self {
        Self {
            source,
            line: 1,
            row: Vec::new(),
        }
    }

    /// The next row, none at the end.
    ///
    /// # Errors
    ///
    /// Where the stream fails, or a quote is not closed.
    pub(crate) fn next_row(&mut self) -> Result<Option<Row>, TableError> {
        loop {
            let line = self.line;
            if !self.take_lines(line)? {
                return Ok(None);
            }
            if line == 1 {
                match self.row.as_slice() {
                    [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => return Err(TableError::Utf16),
                    [0xef, 0xbb, 0xbf, ..] => drop(self.row.drain(..3)),
                    _ => {}
                }
            }
            if self.row.is_empty() {
                continue;
            }
            let mut reader = csv::ReaderBuilder::new()
                .has_headers(false)
                .flexible(true)
                .buffer_capacity(self.row.len())
                .from_reader(self.row.as_slice());
            let mut fields = ByteRecord::new();
            if reader
                .read_byte_record(&mut fields)
                .map_err(io::Error::from)?
            {
                return Ok(Some(Row { line, fields }));
            }
        }
    }

    /// Takes the lines of one row, without the end of the last; false at the end of the stream.
    fn take_lines(&mut self, start: u64) -> Result<bool, TableError> {
        self.row.clear();
        let mut quotes = Quotes::FieldStart;
        loop {
            let before = self.row.len();
            let room = (LONGEST_ROW - before) as u64 + 1;
            let taken = io::Read::take(&mut self.source, room).read_until(b'\n', &mut self.row)?;
            if self.row.len() > LONGEST_ROW {
                return Err(TableError::TooLong { line: start });
            }
            if taken == 0 {
                return match (before, quotes) {
                    (_, Quotes::Inside) => Err(TableError::OpenQuote { line: start }),
                    (length, _) => Ok(length > 0),
                };
            }
            self.line += 1;
            quotes = self.row[before..]
                .iter()
                .fold(quotes, |quotes, &byte| quotes.after(byte));
            if quotes != Quotes::Inside {
                while self
                    .row
                    .last()
                    .is_some_and(|byte| matches!(byte, b'\n' | b'\r'))
                {
                    self.row.pop();
                }
                return Ok(true);
            }
        }
    }
}

/// Where a byte of a row stands with respect to quotes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Quotes {
    /// At the start of a field, where a quote opens one.
    FieldStart,
    /// In a field without quotes, where a quote is a letter.
    Plain,
    /// Inside of quotes, where a line's end is a letter.
    Inside,
    /// After a quote that closed the field, or is the first of two that mean one.
    Closed,
}

impl Quotes {
    fn after(self, byte: u8) -> Self {
        match (self, byte) {
            (Self::FieldStart | Self::Closed, b'"') => Self::Inside,
            (Self::Inside, b'"') => Self::Closed,
            (Self::Inside, _) => Self::Inside,
            (_, b',' | b'\n') => Self::FieldStart,
            (Self::FieldStart | Self::Plain | Self::Closed, _) => Self::Plain,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(text: &[u8]) -> Result<Vec<(u64, Vec<String>)>, TableError> {
        let mut rows = Rows::new(text);
        let mut found = Vec::new();
        while let Some(row) = rows.next_row()? {
            let fields = row
                .fields
                .iter()
                .map(|field| String::from_utf8_lossy(field).into_owned());
            found.push((row.line, fields.collect()));
        }
        Ok(found)
    }

    fn row(line: u64, fields: &[&str]) -> (u64, Vec<String>) {
        (line, fields.iter().map(|&field| field.to_owned()).collect())
    }

    #[test]
    fn lines_are_counted_through_blank_lines_and_line_ends_in_quotes() {
        let text = b"a,b\r\n\r\n\"1\r\n2\",3\r\n\n4,\"5\"\"\n\"\n6,7";
        let expected = vec![
            row(1, &["a", "b"]),
            row(3, &["1\r\n2", "3"]),
            row(6, &["4", "5\"\n"]),
            row(8, &["6", "7"]),
        ];
        assert_eq!(rows(text).unwrap(), expected);
    }

    #[test]
    fn a_mark_of_byte_order_is_no_part_of_the_first_name() {
        assert_eq!(
            rows(b"\xef\xbb\xbfa,b\n").unwrap(),
            vec![row(1, &["a", "b"])]
        );
        assert!(matches!(rows(b"\xff\xfea\0"), Err(TableError::Utf16)));
    }

    #[test]
    fn a_quote_inside_a_plain_field_is_a_letter() {
        let expected = vec![row(1, &["5\" pipe", "x"]), row(2, &["1", "2"])];
        assert_eq!(rows(b"5\" pipe,x\n1,2\n").unwrap(), expected);
    }

    #[test]
    fn a_quote_that_is_not_closed_is_told_with_its_line() {
        assert!(matches!(
            rows(b"a,b\n1,\"2\n3,4\n"),
            Err(TableError::OpenQuote { line: 2 })
        ));
        let long = [b"a\n\"".as_slice(), &vec![b'x'; LONGEST_ROW + 5]].concat();
        assert!(matches!(rows(&long), Err(TableError::TooLong { line: 2 })));
    }

    #[test]
    fn nothing_and_only_blank_lines_have_no_rows() {
        assert_eq!(rows(b"").unwrap(), vec![]);
        assert_eq!(rows(b"\n\r\n").unwrap(), vec![]);
    }
}
