//! How messages write numbers and text from outside.

/// A number in the fewest letters that read back as the same one.
#[must_use]
pub fn shortest(value: f64) -> String {
    let (plain, scientific) = (format!("{value}"), format!("{value:e}"));
    if plain.len() <= scientific.len() + 3 {
        plain
    } else {
        scientific
    }
}

/// A number with so many significant digits, with an exponent where it is very small or large.
#[must_use]
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    let exponent: i32 = scientific
        .rsplit('e')
        .next()
        .and_then(|exponent| exponent.parse().ok())
        .unwrap_or(0);
    if !(-5..=9).contains(&exponent) {
        return scientific;
    }
    let decimals = digits as i32 - 1 - exponent;
    format!("{value:.*}", usize::try_from(decimals).unwrap_or(0))
}

/// A cell, a line or a name of at most so many characters is shown whole: it leaves room for a sentence about it on a line.
const LONGEST: usize = 60;

/// Whether a character does something to a terminal other than stand there.
fn acts(character: char) -> bool {
    character.is_control()
        // Marks that turn the direction of writing, which can make a line read as another one.
        || matches!(character, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// The text with control codes written out, `\u{1b}`; line ends stay.
#[must_use]
pub fn escaped(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for character in text.chars() {
        if character != '\n' && acts(character) {
            shown.extend(character.escape_default());
        } else {
            shown.push(character);
        }
    }
    shown
}

/// The text with control codes written out and, where it is long, without its middle.
#[must_use]
pub fn brief(text: &str) -> String {
    shortened(&escaped(text).replace('\n', "\\n"), LONGEST)
}

/// The text without its middle where it is longer than `most` characters.
#[must_use]
pub fn shortened(text: &str, most: usize) -> String {
    let count = text.chars().count();
    if count <= most {
        return text.to_owned();
    }
    let kept = most.saturating_sub(1);
    let (first, last) = (kept.div_ceil(2), kept / 2);
    let start: String = text.chars().take(first).collect();
    let end: String = text.chars().skip(count - last).collect();
    format!("{start}…{end}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn significant_digits_are_counted_from_the_first() {
        assert_eq!(significant(0.0717331014860298, 6), "0.0717331");
        assert_eq!(significant(646.37005720746, 6), "646.370");
        assert_eq!(significant(-2.0e11, 4), "-2.000e11");
        assert_eq!(significant(0.999_999_99, 4), "1.000");
        assert_eq!(significant(1.2e-9, 2), "1.2e-9");
        assert_eq!(significant(0.0, 6), "0");
    }

    #[test]
    fn numbers_are_as_short_as_they_read() {
        assert_eq!(shortest(2.0e11), "2e11");
        assert_eq!(shortest(0.01188), "0.01188");
        assert_eq!(shortest(10.43), "10.43");
        assert_eq!(shortest(3.0e-7), "3e-7");
    }

    #[test]
    fn control_codes_are_written_out() {
        assert_eq!(
            escaped("a\u{1b}[31mb\r\u{202e}\nc"),
            "a\\u{1b}[31mb\\r\\u{202e}\nc"
        );
        assert_eq!(brief("a\nb"), "a\\nb");
    }

    #[test]
    fn long_texts_lose_their_middle() {
        assert_eq!(shortened("abcdefghi", 9), "abcdefghi");
        assert_eq!(shortened("abcdefghij", 9), "abcd…ghij");
        assert_eq!(brief(&"ü".repeat(1000)).chars().count(), LONGEST);
    }
}
