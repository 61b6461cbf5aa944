//! How names look: Greek letters, accents and subscripts by rule, all else by the module's own table.

use std::collections::BTreeMap;

use syn::spanned::Spanned;
use syn::{Expr, Lit};

use crate::diagnostics::Diagnostics;

/// The letters that LaTeX knows by their names; capitals likewise.
const GREEK: [&str; 24] = [
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa",
    "lambda", "mu", "nu", "xi", "omicron", "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi",
    "psi", "omega",
];

/// Words behind a letter that are put over it.
const ACCENTS: [&str; 4] = ["bar", "hat", "tilde", "dot"];

const EXAMPLE: &str =
    r#"write for example symbolic(latex(speed = "\\Omega", crack_angle = "\\phi"))"#;

/// The module's table of names: what stands in `#[symbolic(latex(name = "…"))]`.
#[derive(Clone, Debug, Default)]
pub struct Symbols {
    table: BTreeMap<String, String>,
}

impl Symbols {
    /// Reads the entries of a module's table; what can't be read is reported at its place.
    pub fn read(entries: &[Expr], diagnostics: &mut Diagnostics) -> Self {
        let mut symbols = Self::default();
        for entry in entries {
            let parts = match entry {
                Expr::Assign(assign) => name(&assign.left).zip(text(&assign.right)),
                _ => None,
            };
            match parts {
                Some((_, latex)) if !balanced(&latex) => {
                    diagnostics.error_with_hint(
                        entry.span(),
                        "the braces of the symbol do not match",
                        "each { is closed by a } behind it",
                    );
                }
                Some((name, _)) if symbols.table.contains_key(&name) => {
                    diagnostics.error_with_hint(
                        entry.span(),
                        format!("`{name}` has a symbol already"),
                        "leave one of the two",
                    );
                }
                Some((name, latex)) => {
                    symbols.table.insert(name, latex);
                }
                None => {
                    diagnostics.error_with_hint(entry.span(), "not a name and its symbol", EXAMPLE)
                }
            }
        }
        symbols
    }

    /// Takes over the symbols of names that have none here.
    pub(crate) fn take_over(&mut self, other: &Self) {
        for (name, latex) in &other.table {
            let known = self.table.entry(name.clone());
            known.or_insert_with(|| latex.clone());
        }
    }

    /// A name in LaTeX: from the table, else by rule.
    ///
    /// By rule, the parts between underscores are a letter with accents and subscripts, `omega_bar` $\bar{\omega}$,
    /// `epsilon_12` $\epsilon_{12}$, `f11` $f_{11}$, or words that stand upright, `edge_factor` $\mathrm{edge~factor}$.
    pub fn latex(&self, name: &str) -> String {
        self.table
            .get(name)
            .cloned()
            .unwrap_or_else(|| by_rule(name))
    }
}

fn name(expression: &Expr) -> Option<String> {
    match expression {
        Expr::Path(path) => path.path.get_ident().map(ToString::to_string),
        _ => None,
    }
}

fn text(expression: &Expr) -> Option<String> {
    match expression {
        Expr::Lit(syn::ExprLit {
            lit: Lit::Str(text),
            ..
        }) => Some(text.value()),
        _ => None,
    }
}

/// Whether every brace is closed.
pub(crate) fn balanced(latex: &str) -> bool {
    let depth = latex
        .chars()
        .try_fold(0_usize, |depth, character| match character {
            '{' => Some(depth + 1),
            '}' => depth.checked_sub(1),
            _ => Some(depth),
        });
    depth == Some(0)
}

fn by_rule(name: &str) -> String {
    let mut parts = name
        .split('_')
        .filter(|part| !part.is_empty())
        .flat_map(letters_and_digits)
        .peekable();
    let mut words = Vec::new();
    // Two letters in the first place would look like a product; behind a letter they are its index.
    while let Some(word) = parts.next_if(|part| is_word(part, if words.is_empty() { 2 } else { 3 }))
    {
        words.push(word);
    }
    let mut base = match words.as_slice() {
        [] => parts.next().map(letter).unwrap_or_default(),
        words => format!("\\mathrm{{{}}}", words.join("~")),
    };
    while let Some(accent) = parts.next_if(|part| words.is_empty() && ACCENTS.contains(part)) {
        base = format!("\\{accent}{{{base}}}");
    }
    let subscripts: Vec<&str> = parts.collect();
    // Words are kept apart; digits and letters in a row make one index.
    let apart = subscripts.iter().any(|part| is_word(part, 3));
    let subscripts: Vec<String> = subscripts.into_iter().map(letter).collect();
    with_subscript(&base, &subscripts.join(if apart { ",\\," } else { " " }))
}

/// A part as an index: `tt` as two letters, a word upright, a Greek letter by its command.
fn letter(part: &str) -> String {
    if is_greek(part) {
        format!("\\{part}")
    } else if is_word(part, 3) {
        format!("\\mathrm{{{part}}}")
    } else {
        part.to_owned()
    }
}

fn is_greek(part: &str) -> bool {
    let mut characters = part.chars();
    let lower = characters
        .next()
        .map(|first| first.to_ascii_lowercase().to_string() + characters.as_str());
    lower.is_some_and(|lower| GREEK.contains(&lower.as_str()))
}

/// Whether the part is a word: at least so many letters, and no letter's name.
fn is_word(part: &str, shortest: usize) -> bool {
    part.chars().count() >= shortest && part.chars().all(char::is_alphabetic) && !is_greek(part)
}

/// `f11` in the parts `f` and `11`.
fn letters_and_digits(part: &str) -> impl Iterator<Item = &str> {
    let mut rest = part;
    std::iter::from_fn(move || {
        let digit = rest.chars().next()?.is_ascii_digit();
        let end = rest
            .find(|c: char| c.is_ascii_digit() != digit)
            .unwrap_or(rest.len());
        let (first, others) = rest.split_at(end);
        rest = others;
        Some(first)
    })
}

/// A symbol with an index behind those that it has.
pub(crate) fn with_subscript(base: &str, index: &str) -> String {
    let indexed = base.rsplit_once('_').filter(|(head, _)| balanced(head));
    match (index, indexed) {
        ("", _) => base.to_owned(),
        (_, Some((head, last))) => {
            let last = last
                .strip_prefix('{')
                .and_then(|last| last.strip_suffix('}'))
                .unwrap_or(last);
            format!("{head}_{{{last},{index}}}")
        }
        (_, None) => format!("{base}_{}", braced(index)),
    }
}

/// `x` as it is, longer texts in braces.
pub(crate) fn braced(text: &str) -> String {
    if text.chars().count() == 1 {
        text.to_owned()
    } else {
        format!("{{{text}}}")
    }
}
