//! Formulas of the documentation, `$\omega_1 = \Omega$`, as a terminal can show them: `ω_1 = Ω`.

/// What commands of LaTeX look like; others are written as words.
#[rustfmt::skip]
const SIGNS: [(&str, &str); 28] = [
    ("alpha", "α"), ("beta", "β"), ("gamma", "γ"), ("delta", "δ"), ("epsilon", "ε"), ("theta", "θ"),
    ("vartheta", "ϑ"), ("kappa", "κ"), ("lambda", "λ"), ("mu", "μ"), ("nu", "ν"), ("xi", "ξ"), ("pi", "π"),
    ("varpi", "ϖ"), ("sigma", "σ"), ("phi", "φ"), ("psi", "ψ"), ("omega", "ω"), ("Gamma", "Γ"), ("Delta", "Δ"),
    ("Theta", "Θ"), ("Sigma", "Σ"), ("Phi", "Φ"), ("Psi", "Ψ"), ("Omega", "Ω"), ("partial", "∂"), ("ne", "≠"),
    ("iint", "∬"),
];

/// The text with every formula between `$` made plain.
pub(super) fn plain(text: &str) -> String {
    text.split('$')
        .enumerate()
        .map(|(index, part)| {
            if index % 2 == 0 {
                part.to_owned()
            } else {
                formula(part)
            }
        })
        .collect()
}

fn formula(latex: &str) -> String {
    let mut letters = latex.chars().peekable();
    let mut text = String::new();
    // What stands behind the next letter or the next closing brace.
    let (mut accent, mut closers) = (None, Vec::new());
    while let Some(letter) = letters.next() {
        match letter {
            '\\' => {
                let mut name = String::new();
                while let Some(letter) = letters.next_if(char::is_ascii_alphabetic) {
                    name.push(letter);
                }
                match name.as_str() {
                    "" => {
                        // `\,`, a narrow space.
                        letters.next();
                        text.push(' ');
                    }
                    "bar" => accent = Some('\u{304}'),
                    "sqrt" => {
                        letters.next_if_eq(&'{');
                        text.push_str("√(");
                        closers.push(")");
                        continue;
                    }
                    name => {
                        let sign = SIGNS.iter().find(|(known, _)| *known == name);
                        text.push_str(sign.map_or(name, |(_, sign)| sign));
                        text.extend(accent.take());
                    }
                }
                if name == "bar" {
                    letters.next_if_eq(&' ');
                }
            }
            '{' => closers.push(""),
            '}' => text.push_str(closers.pop().unwrap_or_default()),
            '^' => raised(&mut letters, &mut text),
            letter => {
                text.push(letter);
                text.extend(accent.take());
            }
        }
    }
    text
}

/// An exponent: digits above the line, others behind `^`.
fn raised(letters: &mut std::iter::Peekable<std::str::Chars<'_>>, text: &mut String) {
    let mut exponent = String::new();
    if letters.next_if_eq(&'{').is_some() {
        while let Some(letter) = letters.next_if(|&letter| letter != '}') {
            exponent.push(letter);
        }
        letters.next();
    } else {
        exponent.extend(letters.next());
    }
    let above = |letter| match letter {
        '-' => Some('⁻'),
        '1' => Some('¹'),
        '2' => Some('²'),
        '3' => Some('³'),
        _ => None,
    };
    match exponent.chars().map(above).collect::<Option<String>>() {
        Some(above) => text.push_str(&above),
        None => {
            text.push('^');
            text.push_str(&exponent);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_become_plain_text() {
        let cases = [
            ("at $\\omega_1 = \\Omega$.", "at ω_1 = Ω."),
            ("$F_{III}$, $\\gamma \\ne 0$", "F_III, γ ≠ 0"),
            (
                "$\\sqrt{1-\\bar\\mu^2} - (1-\\sigma)$",
                "√(1-μ\u{304}²) - (1-σ)",
            ),
            ("$A_1^{-1}$", "A_1⁻¹"),
            ("$\\bar H\\bar G$", "H\u{304}G\u{304}"),
            ("no formula", "no formula"),
        ];
        for (latex, expected) in cases {
            assert_eq!(plain(latex), expected);
        }
    }
}
