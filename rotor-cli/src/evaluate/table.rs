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
    /// A quoted field without its end. The next row is the one on the next line.
    #[error("line {}: {OPEN_QUOTE}", .first_line.line)]
    OpenQuote {
        /// What stands on the line where the row starts.
        first_line: Row,
    },
    /// A row too long to be one.
    #[error("line {line}: this row is longer than {LONGEST_ROW} bytes")]
    TooLong {
        /// Where the row starts.
        line: u64,
    },
    /// Text in two-byte units.
    #[error("line 1: this is UTF-16; save the table as UTF-8")]
    Utf16,
}

/// What is said of a quoted field without its end.
pub(crate) const OPEN_QUOTE: &str = "a quoted field that starts in this row is never closed";

/// The mark of byte order of UTF-8.
const MARK: [u8; 3] = [0xef, 0xbb, 0xbf];

/// Splits a stream into rows. Blank lines are skipped, lines end with LF, CRLF or CR, a byte order mark is dropped.
///
/// The rows are split here and the fields by the `csv` crate, because the crate alone counts lines wrongly after a
/// blank line and takes an unclosed quote for the end of the table.
pub(crate) struct Rows<R> {
    source: R,
    /// What is read again before the source goes on.
    again: Vec<u8>,
    line: u64,
    /// Whether the last byte was a CR, with which an LF is the same line end.
    after_return: bool,
    row: Vec<u8>,
}

/// How the bytes of a row ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Taken {
    /// With the end of a line, or of the stream.
    Row,
    /// With the end of the stream, and there is none.
    Nothing,
    /// With the end of the stream or the longest row, inside of quotes.
    OpenQuote,
    /// Not within the longest row.
    TooLong,
}

impl<R: BufRead> Rows<R> {
    /// Rows of `source`, from its first line.
    pub(crate) fn new(source: R) -> Self {
        Self {
            source,
            again: Vec::new(),
            line: 1,
            after_return: false,
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
            let taken = self.take_row()?;
            if line == 1 && matches!(self.row.as_slice(), [0xff, 0xfe, ..] | [0xfe, 0xff, ..]) {
                return Err(TableError::Utf16);
            }
            match taken {
                Taken::Nothing => return Ok(None),
                Taken::TooLong => return Err(TableError::TooLong { line }),
                Taken::OpenQuote => {
                    let first_line = self.first_line(line)?;
                    return Err(TableError::OpenQuote { first_line });
                }
                Taken::Row => {}
            }
            if let Some(row) = fields(&self.row)? {
                return Ok(Some(Row { line, fields: row }));
            }
        }
    }

    /// Takes the bytes of one row, without the end of its last line.
    fn take_row(&mut self) -> Result<Taken, TableError> {
        self.row.clear();
        let mut quotes = Quotes::FieldStart;
        let again = std::mem::take(&mut self.again);
        if let Some((ended, used)) = self.take_bytes(&again, &mut quotes) {
            self.again = again.get(used..).unwrap_or_default().to_vec();
            return Ok(ended);
        }
        loop {
            // The buffer is the source's, so that it is given its bytes back by count.
            let buffer = match self.source.fill_buf() {
                Ok(buffer) => buffer.to_vec(),
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                Err(error) => return Err(error.into()),
            };
            if buffer.is_empty() {
                return Ok(match (self.row.is_empty(), quotes) {
                    (_, Quotes::Inside) => Taken::OpenQuote,
                    (true, Quotes::FieldStart) => Taken::Nothing,
                    _ => Taken::Row,
                });
            }
            let ended = self.take_bytes(&buffer, &mut quotes);
            self.source
                .consume(ended.map_or(buffer.len(), |(_, used)| used));
            if let Some((ended, _)) = ended {
                return Ok(ended);
            }
        }
    }

    /// Adds bytes to the row; where it ends among them, how, and after how many.
    fn take_bytes(&mut self, bytes: &[u8], quotes: &mut Quotes) -> Option<(Taken, usize)> {
        for (index, &byte) in bytes.iter().enumerate() {
            let same_end =
                std::mem::replace(&mut self.after_return, byte == b'\r') && byte == b'\n';
            let ends_line = matches!(byte, b'\n' | b'\r');
            self.line += u64::from(ends_line && !same_end);
            if ends_line && *quotes != Quotes::Inside {
                if same_end && self.row.is_empty() {
                    continue;
                }
                return Some((Taken::Row, index + 1));
            }
            *quotes = quotes.after(byte);
            self.row.push(byte);
            if self.line == 1 && self.row == MARK {
                self.row.clear();
                *quotes = Quotes::FieldStart;
            }
            if self.row.len() > LONGEST_ROW {
                let ended = match quotes {
                    Quotes::Inside if self.row.iter().any(|byte| matches!(byte, b'\n' | b'\r')) => {
                        Taken::OpenQuote
                    }
                    _ => Taken::TooLong,
                };
                return Some((ended, index + 1));
            }
        }
        None
    }

    /// The first line of what has been taken; the rest is read again.
    fn first_line(&mut self, line: u64) -> Result<Row, TableError> {
        let end = self
            .row
            .iter()
            .position(|byte| matches!(byte, b'\n' | b'\r'))
            .unwrap_or(self.row.len());
        let mut rest = self.row.split_off(end);
        rest.append(&mut self.again);
        self.again = rest;
        self.line = line;
        self.after_return = false;
        // The end of the first line is not read as that of a blank one.
        if !self.again.is_empty() {
            let both = usize::from(self.again.starts_with(b"\r\n"));
            self.again.drain(..=both);
            self.line += 1;
        }
        Ok(Row {
            line,
            fields: fields(&self.row)?.unwrap_or_default(),
        })
    }
}

/// The fields of a row, none of a blank one.
fn fields(row: &[u8]) -> Result<Option<ByteRecord>, TableError> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .buffer_capacity(row.len().max(1))
        .from_reader(row);
    let mut fields = ByteRecord::new();
    let found = reader
        .read_byte_record(&mut fields)
        .map_err(io::Error::from)?;
    Ok(found.then_some(fields))
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
            (_, b',') => Self::FieldStart,
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
            Err(TableError::OpenQuote {
                first_line: Row { line: 2, .. }
            })
        ));
        let long = [b"a\n\"".as_slice(), &vec![b'x'; LONGEST_ROW + 5]].concat();
        assert!(matches!(rows(&long), Err(TableError::TooLong { line: 2 })));
    }

    #[test]
    fn after_a_quote_that_is_not_closed_the_next_line_is_the_next_row() {
        for end in ["\n", "\r\n", "\r"] {
            let text = ["a,b", "1,\"2", "3,4", "", "5,6"].join(end);
            let mut rows = Rows::new(text.as_bytes());
            assert_eq!(rows.next_row().unwrap().unwrap().line, 1);
            let Err(TableError::OpenQuote { first_line }) = rows.next_row() else {
                panic!("{text:?}")
            };
            assert_eq!(
                (first_line.line, &first_line.fields[1]),
                (2, b"2".as_slice())
            );
            for (line, first) in [(3, b"3"), (5, b"5")] {
                let row = rows.next_row().unwrap().unwrap();
                assert_eq!(
                    (row.line, &row.fields[0]),
                    (line, first.as_slice()),
                    "{text:?}"
                );
            }
            assert!(rows.next_row().unwrap().is_none());
        }
    }

    #[test]
    fn a_lone_return_ends_a_line_too() {
        let expected = vec![
            row(1, &["a", "b"]),
            row(2, &["1", "x"]),
            row(4, &["2", "\"y\r"]),
            row(6, &["3", ""]),
        ];
        let text = b"a,b\r1,x\r\r2,\"\"\"y\r\"\r3,\r";
        assert_eq!(rows(text).unwrap(), expected);
        // Byte by byte, so that CR and LF come in different buffers.
        let mut rows = Rows::new(io::BufReader::with_capacity(
            1,
            b"a\r\n1\r\n\r\n2".as_slice(),
        ));
        for line in [1, 2, 4] {
            assert_eq!(rows.next_row().unwrap().unwrap().line, line);
        }
        assert!(rows.next_row().unwrap().is_none());
    }

    #[test]
    fn nothing_and_only_blank_lines_have_no_rows() {
        assert_eq!(rows(b"").unwrap(), vec![]);
        assert_eq!(rows(b"\n\r\n").unwrap(), vec![]);
    }
}
