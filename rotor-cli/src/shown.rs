//! Text from outside as it is shown: without control codes, and not endless.

/// A cell, a line or a name of at most so many characters is shown whole.
const LONGEST: usize = 60;

/// Whether a character does something to a terminal other than stand there.
fn acts(character: char) -> bool {
    character.is_control()
        // Marks that turn the direction of writing, which can make a line read as another one.
        || matches!(character, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// The text with control codes written out, `\u{1b}`; line ends stay.
pub(crate) fn escaped(text: &str) -> String {
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
pub(crate) fn brief(text: &str) -> String {
    shortened(&escaped(text).replace('\n', "\\n"), LONGEST)
}

/// The text without its middle where it is longer than `most` characters.
pub(crate) fn shortened(text: &str, most: usize) -> String {
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
