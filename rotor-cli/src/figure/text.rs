//! Labels: their small markup, how wide they are, and how they become SVG.
//!
//! The markup: a single letter before `_` is a symbol, and what follows `_` is its subscript, either letters and digits
//! (`λ_s`, `ω_st`) or anything in braces (`ε_{12}`). Symbols and Greek letters are set in italics (π is a number and
//! stays upright), so is what stands between two `*`. An underscore inside a word (`crack_angle`) is an underscore.

use std::fmt::{self, Write};

use ttf_parser::OutlineBuilder;

/// Size of a subscript, relative to its symbol's.
const SUBSCRIPT_SIZE: f64 = 0.72;
/// How far a subscript's baseline lies below its symbol's, relative to the symbol's size.
const SUBSCRIPT_DROP: f64 = 0.22;

/// Shape of a run of letters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    /// Upright.
    Upright,
    /// Slanted.
    Italic,
    /// Upright and heavy.
    Bold,
}

/// Letters that are set alike.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Run {
    text: String,
    shape: Shape,
    subscript: bool,
}

/// Splits a label into runs. `base` is the shape of everything that the markup does not slant.
pub(super) fn parse(label: &str, base: Shape) -> Vec<Run> {
    let letters: Vec<char> = label.chars().collect();
    let at = |index: usize| letters.get(index).copied();
    let mut runs: Vec<Run> = Vec::new();
    let (mut index, mut emphasised) = (0, false);
    while let Some(letter) = at(index) {
        let starts_word = index == 0
            || !at(index - 1).is_some_and(|before| before.is_alphanumeric() || before == '_');
        let subscript = if letter.is_alphabetic() && starts_word {
            subscript_at(&letters, index + 1)
        } else {
            None
        };
        let closes = emphasised || letters.iter().skip(index + 1).any(|&later| later == '*');
        if letter == '*' && closes {
            emphasised = !emphasised;
            index += 1;
            continue;
        }
        // `*l*_c`: the subscript of an emphasised letter.
        let after_emphasis =
            letter == '_' && index > 0 && at(index - 1) == Some('*') && !runs.is_empty();
        if let Some((text, next)) = after_emphasis
            .then(|| subscript_at(&letters, index))
            .flatten()
        {
            push(&mut runs, &text, base, true);
            index = next;
            continue;
        }
        let slanted = emphasised || subscript.is_some() || is_greek_symbol(letter);
        let shape = if slanted && base != Shape::Bold {
            Shape::Italic
        } else {
            base
        };
        push(&mut runs, letter.encode_utf8(&mut [0; 4]), shape, false);
        index += 1;
        if let Some((text, next)) = subscript {
            push(&mut runs, &text, base, true);
            index = next;
        }
    }
    runs
}

/// The subscript whose underscore stands at `index`, and the index after it.
fn subscript_at(letters: &[char], index: usize) -> Option<(String, usize)> {
    if letters.get(index) != Some(&'_') {
        return None;
    }
    let rest = letters.get(index + 1..)?;
    if rest.first() == Some(&'{') {
        let length = rest.iter().position(|&letter| letter == '}')?;
        return Some((
            rest.iter().take(length).skip(1).collect(),
            index + 2 + length,
        ));
    }
    let text: String = rest
        .iter()
        .take_while(|letter| letter.is_alphanumeric())
        .collect();
    let next = index + 1 + text.chars().count();
    (!text.is_empty()).then_some((text, next))
}

/// Greek letters stand for variables; π is a number.
fn is_greek_symbol(letter: char) -> bool {
    ('\u{370}'..='\u{3ff}').contains(&letter) && letter != 'π'
}

/// Appends to the last run if it is of the same kind.
fn push(runs: &mut Vec<Run>, text: &str, shape: Shape, subscript: bool) {
    match runs.last_mut() {
        Some(last) if last.shape == shape && last.subscript == subscript => {
            last.text.push_str(text)
        }
        _ => runs.push(Run {
            text: text.to_owned(),
            shape,
            subscript,
        }),
    }
}

/// The label without markup, for tables and for readers of the page who cannot see it: `ε_12`.
pub(super) fn plain(label: &str) -> String {
    let mut plain = String::new();
    for run in parse(label, Shape::Upright) {
        if run.subscript {
            plain.push('_');
        }
        plain.push_str(&run.text);
    }
    plain
}

/// Where a text stands.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placement {
    /// Anchor on the baseline.
    pub(super) at: (f64, f64),
    /// Share of the width that lies before the anchor: 0, 0.5 or 1.
    pub(super) before: f64,
    /// Clockwise turn about the anchor in degrees.
    pub(super) turn: i32,
    /// Size of the letters.
    pub(super) size: f64,
}

/// The embedded fonts.
pub(super) struct Fonts {
    upright: ttf_parser::Face<'static>,
    italic: ttf_parser::Face<'static>,
    bold: ttf_parser::Face<'static>,
}

impl Fonts {
    /// Reads the embedded fonts.
    ///
    /// # Errors
    /// Never with the files in `assets/fonts`; a broken file says what is broken.
    pub(super) fn embedded() -> Result<Self, ttf_parser::FaceParsingError> {
        let read = |data: &'static [u8]| ttf_parser::Face::parse(data, 0);
        Ok(Self {
            upright: read(include_bytes!("../../assets/fonts/DejaVuSans-subset.ttf"))?,
            italic: read(include_bytes!(
                "../../assets/fonts/DejaVuSans-Oblique-subset.ttf"
            ))?,
            bold: read(include_bytes!(
                "../../assets/fonts/DejaVuSans-Bold-subset.ttf"
            ))?,
        })
    }

    /// The font of a shape.
    fn face(&self, shape: Shape) -> &ttf_parser::Face<'static> {
        match shape {
            Shape::Upright => &self.upright,
            Shape::Italic => &self.italic,
            Shape::Bold => &self.bold,
        }
    }

    /// Width of a label's runs at a size, in the unit of the size.
    pub(super) fn width(&self, runs: &[Run], size: f64) -> f64 {
        runs.iter()
            .flat_map(|run| run.text.chars().map(move |letter| (run, letter)))
            .map(|(run, letter)| self.advance(run, letter, size))
            .sum()
    }

    /// How far a letter moves the pen.
    fn advance(&self, run: &Run, letter: char, size: f64) -> f64 {
        let face = self.face(run.shape);
        let glyph = face.glyph_index(letter).unwrap_or_default();
        let em = f64::from(face.units_per_em());
        run_size(run, size) * f64::from(face.glyph_hor_advance(glyph).unwrap_or_default()) / em
    }

    /// Appends the outlines of all letters as path data. The turn is left to the caller.
    pub(super) fn outline(&self, out: &mut String, runs: &[Run], place: Placement) -> fmt::Result {
        let mut x = place.at.0 - place.before * self.width(runs, place.size);
        for run in runs {
            let y = place.at.1
                + if run.subscript {
                    SUBSCRIPT_DROP * place.size
                } else {
                    0.0
                };
            let face = self.face(run.shape);
            for letter in run.text.chars() {
                let scale = run_size(run, place.size) / f64::from(face.units_per_em());
                let mut pen = Pen {
                    out,
                    x,
                    y,
                    scale,
                    result: Ok(()),
                };
                face.outline_glyph(face.glyph_index(letter).unwrap_or_default(), &mut pen);
                pen.result?;
                x += self.advance(run, letter, place.size);
            }
        }
        Ok(())
    }
}

/// Size of the letters of a run in a text of a size.
fn run_size(run: &Run, size: f64) -> f64 {
    if run.subscript {
        SUBSCRIPT_SIZE * size
    } else {
        size
    }
}

/// Appends a `<text>` element. Subscripts are lowered by `dy` and raised again by the run after them, which browsers and
/// other readers of SVG all follow; `baseline-shift` is not.
pub(super) fn element(out: &mut String, runs: &[Run], place: Placement, fill: &str) -> fmt::Result {
    let ((x, y), size) = (place.at, place.size);
    write!(
        out,
        "<text x=\"{x:.2}\" y=\"{y:.2}\" font-size=\"{size:.2}\"{fill}"
    )?;
    if place.before > 0.0 {
        write!(
            out,
            " text-anchor=\"{}\"",
            if place.before < 1.0 { "middle" } else { "end" }
        )?;
    }
    if place.turn != 0 {
        write!(out, " transform=\"rotate({} {x:.2} {y:.2})\"", place.turn)?;
    }
    out.push('>');
    let mut lowered = false;
    for run in runs {
        write_run(out, run, size, lowered)?;
        lowered = run.subscript;
    }
    out.write_str("</text>\n")
}

/// Appends one run; `lowered` says whether the pen stands on a subscript's baseline.
fn write_run(out: &mut String, run: &Run, size: f64, lowered: bool) -> fmt::Result {
    if run.shape == Shape::Upright && !run.subscript && !lowered {
        escape(out, &run.text);
        return Ok(());
    }
    out.push_str("<tspan");
    let drop = SUBSCRIPT_DROP * size;
    match (lowered, run.subscript) {
        (false, true) => write!(out, " dy=\"{drop:.2}\"")?,
        (true, false) => write!(out, " dy=\"-{drop:.2}\"")?,
        _ => {}
    }
    if run.subscript {
        write!(out, " font-size=\"{:.2}\"", run_size(run, size))?;
    }
    match run.shape {
        Shape::Upright => {}
        Shape::Italic => out.push_str(" font-style=\"italic\""),
        Shape::Bold => out.push_str(" font-weight=\"bold\""),
    }
    out.push('>');
    escape(out, &run.text);
    out.write_str("</tspan>")
}

/// Appends text with the characters that XML keeps for itself replaced.
pub(super) fn escape(out: &mut String, text: &str) {
    for letter in text.chars() {
        match letter {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            // XML 1.0 has no place for other control characters.
            '\t' | '\n' | '\r' => out.push(' '),
            _ if letter.is_control() => out.push('\u{fffd}'),
            _ => out.push(letter),
        }
    }
}

/// Writes a glyph's outline as path data.
struct Pen<'a> {
    out: &'a mut String,
    x: f64,
    y: f64,
    scale: f64,
    result: fmt::Result,
}

impl Pen<'_> {
    /// Appends a command and its points.
    fn command(&mut self, name: char, points: &[(f32, f32)]) {
        self.out.push(name);
        for &(x, y) in points {
            let (x, y) = (
                self.x + self.scale * f64::from(x),
                self.y - self.scale * f64::from(y),
            );
            self.result = self
                .result
                .and_then(|()| write!(self.out, "{x:.2} {y:.2} "));
        }
    }
}

impl OutlineBuilder for Pen<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        self.command('M', &[(x, y)]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.command('L', &[(x, y)]);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.command('Q', &[(x1, y1), (x, y)]);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.command('C', &[(x1, y1), (x2, y2), (x, y)]);
    }

    fn close(&mut self) {
        self.command('Z', &[]);
    }
}
