//! Messages to the formula's author, each at its own token, collected so that all come in one pass.

use proc_macro2::{Span, TokenStream};

/// One message: what is wrong at which token, and what to write instead.
#[derive(Clone, Debug)]
pub struct Diagnostic {
    /// The token that the message is about.
    pub span: Span,
    /// What is wrong.
    pub message: String,
    /// What to do.
    pub hint: String,
}

/// The messages of one pass.
#[derive(Clone, Debug, Default)]
pub struct Diagnostics {
    messages: Vec<Diagnostic>,
}

impl Diagnostics {
    /// Adds a message with its hint: no message goes without.
    pub fn error_with_hint(
        &mut self,
        span: Span,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) {
        self.messages.push(Diagnostic {
            span,
            message: message.into(),
            hint: hint.into(),
        });
    }

    /// Adds a parser's own message, with what is written there instead.
    pub fn syntax(&mut self, error: &syn::Error, hint: &str) {
        for error in error.clone() {
            self.error_with_hint(error.span(), error.to_string(), hint);
        }
    }

    /// The message that was found first.
    pub fn first(&self) -> Option<&Diagnostic> {
        self.messages.first()
    }

    /// Takes over the messages of another pass.
    pub fn append(&mut self, other: Self) {
        self.messages.extend(other.messages);
    }

    /// Takes off all messages but the first `length`.
    pub fn split_off(&mut self, length: usize) -> Self {
        let messages = self.messages.split_off(length.min(self.messages.len()));
        Self { messages }
    }

    /// Whether nothing is wrong.
    pub fn is_empty(&self) -> bool {
        self.messages.is_empty()
    }

    /// How many messages there are.
    pub fn len(&self) -> usize {
        self.messages.len()
    }

    /// All messages in the order in which they were found.
    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.messages.iter()
    }

    /// One `compile_error!` per message, at its token.
    pub fn to_tokens(&self) -> TokenStream {
        self.messages
            .iter()
            .map(|diagnostic| {
                syn::Error::new(diagnostic.span, diagnostic.text()).to_compile_error()
            })
            .collect()
    }
}

impl Diagnostic {
    /// The message with its hint on a line of its own.
    pub fn text(&self) -> String {
        format!("{}\n  help: {}", self.message, self.hint)
    }
}

/// The candidate most like `word`, if any is like it at all: at most a third of its letters differ.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    candidates
        .into_iter()
        .map(|candidate| (strsim::levenshtein(word, candidate), candidate))
        .filter(|(distance, candidate)| *distance <= 1 + candidate.chars().count() / 3)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// As [`nearest`], if the two have a letter in common: names of one letter are all as near to each other.
pub fn alike<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let shares = |candidate: &&str| candidate.chars().any(|letter| word.contains(letter));
    nearest(word, candidates.into_iter().filter(shares))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_names() {
        assert_eq!(nearest("omga", ["omega", "speed"]), Some("omega"));
        assert_eq!(nearest("columsn", ["columns", "gradient"]), Some("columns"));
        assert_eq!(nearest("zzzzzz", ["columns", "gradient"]), None);
        assert_eq!(nearest("g", ["f"]), Some("f"));
        assert_eq!(alike("z", ["x", "y"]), None);
        assert_eq!(alike("betta", ["mu", "beta"]), Some("beta"));
    }
}
