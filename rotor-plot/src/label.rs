//! Labels: their small markup and how wide they are.
//!
//! The markup: a single letter before `_` is a symbol, and what follows `_` is its subscript, either letters and digits
//! (`λ_s`, `ω_st`) or anything in braces (`ε_{12}`); `^{…}` is a superscript. Symbols and Greek letters are set in
//! italics (π is a number and stays upright), so is what stands between two `*`. An underscore inside a word
//! (`crack_angle`) is an underscore.

use ttf_parser::{Face, FaceParsingError};

/// Size of a subscript or superscript, relative to the letters that it belongs to.
const SCRIPT_SIZE: f64 = 0.72;

/// Shape of letters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shape {
    Upright,
    Italic,
    Bold,
}

/// The line on which letters stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Level {
    Base,
    Subscript,
    Superscript,
}

impl Level {
    /// How far the letters are below the baseline, relative to the size of the text.
    pub(crate) fn drop(self) -> f64 {
        match self {
            Self::Base => 0.0,
            Self::Subscript => 0.22,
            Self::Superscript => -0.36,
        }
    }

    /// Size of the letters, in a text whose size is given.
    pub(crate) fn size(self, size: f64) -> f64 {
        if self == Self::Base {
            size
        } else {
            SCRIPT_SIZE * size
        }
    }
}

/// Consecutive letters of one shape on one line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Run {
    pub(crate) text: String,
    pub(crate) shape: Shape,
    pub(crate) level: Level,
}

/// Splits a label into runs. `base` is the shape of everything that the markup does not slant.
pub(crate) fn parse(label: &str, base: Shape) -> Vec<Run> {
    let letters: Vec<char> = label.chars().collect();
    let at = |index: usize| letters.get(index).copied();
    let mut runs: Vec<Run> = Vec::new();
    let (mut index, mut emphasised) = (0, false);
    while let Some(letter) = at(index) {
        let before = index.checked_sub(1).and_then(at);
        let closes = emphasised || letters.iter().skip(index + 1).any(|&later| later == '*');
        if letter == '*' && closes {
            emphasised = !emphasised;
            index += 1;
            continue;
        }
        // A superscript follows anything, a subscript here the emphasised letter of `*l*_c`.
        let stands_alone = |level| level == Level::Superscript || before == Some('*');
        let script = script_at(&letters, index).filter(|_| !runs.is_empty());
        if let Some((level, text, next)) = script.filter(|script| stands_alone(script.0)) {
            push(&mut runs, &text, base, level);
            index = next;
            continue;
        }
        let starts_word = !before.is_some_and(|before| before.is_alphanumeric() || before == '_');
        let subscript = Some(index + 1)
            .filter(|_| letter.is_alphabetic() && starts_word)
            .and_then(|next| script_at(&letters, next))
            .filter(|script| script.0 == Level::Subscript);
        let slanted = emphasised || subscript.is_some() || is_greek_symbol(letter);
        let shape = if slanted && base != Shape::Bold {
            Shape::Italic
        } else {
            base
        };
        push(
            &mut runs,
            letter.encode_utf8(&mut [0; 4]),
            shape,
            Level::Base,
        );
        index += 1;
        if let Some((level, text, next)) = subscript {
            push(&mut runs, &text, base, level);
            index = next;
        }
    }
    runs
}

/// The subscript or superscript whose mark stands at `index`, and the index after it.
fn script_at(letters: &[char], index: usize) -> Option<(Level, String, usize)> {
    let level = match letters.get(index)? {
        '_' => Level::Subscript,
        '^' => Level::Superscript,
        _ => return None,
    };
    let rest = letters.get(index + 1..)?;
    if rest.first() == Some(&'{') {
        let length = rest.iter().position(|&letter| letter == '}')?;
        let text = rest.iter().take(length).skip(1).collect();
        return Some((level, text, index + 2 + length));
    }
    let text: String = rest
        .iter()
        .take_while(|letter| letter.is_alphanumeric())
        .collect();
    let next = index + 1 + text.chars().count();
    (level == Level::Subscript && !text.is_empty()).then_some((level, text, next))
}

/// Whether a letter is Greek and means a variable; π means a number.
fn is_greek_symbol(letter: char) -> bool {
    ('\u{370}'..='\u{3ff}').contains(&letter) && letter != 'π'
}

/// Appends to the last run if it is of the same kind.
fn push(runs: &mut Vec<Run>, text: &str, shape: Shape, level: Level) {
    match runs.last_mut() {
        Some(last) if last.shape == shape && last.level == level => last.text.push_str(text),
        _ => runs.push(Run {
            text: text.to_owned(),
            shape,
            level,
        }),
    }
}

/// Writes the label without markup, for tables and for readers of the page who cannot see it: `ε_12`.
pub(crate) fn plain(label: &str) -> String {
    let runs = parse(label, Shape::Upright);
    let write = |run: Run| match run.level {
        Level::Base => run.text,
        Level::Subscript => format!("_{}", run.text),
        Level::Superscript => format!("^{}", run.text),
    };
    runs.into_iter().map(write).collect()
}

/// Breaks a text into lines that fit, at its spaces but not at those about an `=`.
pub(crate) fn wrap(text: &str, fits: impl Fn(&str) -> bool) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text
        .replace(" = ", "\u{a0}=\u{a0}")
        .split([' ', '\n', '\t'])
    {
        let longer = lines.last().map(|line| format!("{line} {word}"));
        match (lines.last_mut(), longer.filter(|longer| fits(longer))) {
            _ if word.is_empty() => {}
            (Some(line), Some(longer)) => *line = longer,
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// Family of the embedded fonts.
pub(crate) const FAMILY: &str = "DejaVu Sans";

/// The embedded font files, upright, slanted and bold, of which the pixels of a PNG and the outlines of a PDF are made, too.
pub(crate) const FONT_FILES: [&[u8]; 3] = [
    include_bytes!("../assets/fonts/DejaVuSans-subset.ttf"),
    include_bytes!("../assets/fonts/DejaVuSans-Oblique-subset.ttf"),
    include_bytes!("../assets/fonts/DejaVuSans-Bold-subset.ttf"),
];

/// Measures text by the embedded fonts.
pub(crate) struct Fonts {
    upright: Face<'static>,
    italic: Face<'static>,
    bold: Face<'static>,
}

impl Fonts {
    /// Reads the embedded fonts.
    ///
    /// # Errors
    /// A font file that is damaged; those in `assets/fonts` are not.
    pub(crate) fn embedded() -> Result<Self, FaceParsingError> {
        let [upright, italic, bold] = FONT_FILES.map(|data| Face::parse(data, 0));
        Ok(Self {
            upright: upright?,
            italic: italic?,
            bold: bold?,
        })
    }

    /// Width of a label without bold letters, in the unit of the size.
    pub(crate) fn width(&self, label: &str, size: f64) -> f64 {
        self.width_of(&parse(label, Shape::Upright), size)
    }

    /// Width of runs, in the unit of the size.
    pub(crate) fn width_of(&self, runs: &[Run], size: f64) -> f64 {
        let widths = runs.iter().map(|run| {
            let face = match run.shape {
                Shape::Upright => &self.upright,
                Shape::Italic => &self.italic,
                Shape::Bold => &self.bold,
            };
            let advance = |letter| {
                let glyph = face.glyph_index(letter).unwrap_or_default();
                f64::from(face.glyph_hor_advance(glyph).unwrap_or_default())
            };
            let advances: f64 = run.text.chars().map(advance).sum();
            run.level.size(size) * advances / f64::from(face.units_per_em())
        });
        widths.sum()
    }
}
