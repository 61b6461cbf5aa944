//! Conditions and choices as LaTeX.

use syn::{BinOp, Expr, ExprBinary, ExprIf, ExprMatch, Lit, Pat};

use super::expression::{Writer, Written, unsupported};
use super::piece::{Piece, Precedence};

impl Writer<'_> {
    /// A comparison, or two conditions joined.
    pub(super) fn logical(&mut self, binary: &ExprBinary) -> Written {
        let (sign, precedence) = match binary.op {
            BinOp::And(_) => ("\\land", Precedence::And),
            BinOp::Or(_) => ("\\lor", Precedence::Or),
            BinOp::Lt(_) => ("<", Precedence::Comparison),
            BinOp::Le(_) => ("\\le", Precedence::Comparison),
            BinOp::Gt(_) => (">", Precedence::Comparison),
            BinOp::Ge(_) => ("\\ge", Precedence::Comparison),
            BinOp::Eq(_) => ("=", Precedence::Comparison),
            BinOp::Ne(_) => ("\\ne", Precedence::Comparison),
            _ => return unsupported(binary),
        };
        let [left, right] = [&binary.left, &binary.right].map(|side| self.piece(side));
        let (left, right) = (left?.at_least(precedence), right?.at_least(precedence));
        Ok(Piece::new(format!("{left} {sign} {right}"), precedence))
    }

    /// `!a`
    pub(super) fn negation(&mut self, operand: &Expr) -> Written {
        Ok(negated(self.piece(operand)?))
    }

    /// `if … { } else if … { } else { }` by cases.
    pub(super) fn choice(&mut self, choice: &ExprIf) -> Written {
        let mut rows = Vec::new();
        let mut clause = choice;
        loop {
            let (value, condition) = (self.block(&clause.then_branch)?, self.piece(&clause.cond)?);
            rows.push((value, Some(condition)));
            let Some((_, otherwise)) = &clause.else_branch else {
                return unsupported(clause);
            };
            match otherwise.as_ref() {
                Expr::If(next) => clause = next,
                last => {
                    rows.push((self.piece(last)?, None));
                    return Ok(cases(&rows));
                }
            }
        }
    }

    /// `match` by cases, of which the last is what is left.
    pub(super) fn matched(&mut self, choice: &ExprMatch) -> Written {
        let subject = match choice.expr.as_ref() {
            Expr::Tuple(tuple) => tuple.elems.iter().collect(),
            other => vec![other],
        };
        let subject: syn::Result<Vec<Piece>> =
            subject.into_iter().map(|part| self.piece(part)).collect();
        let subject = subject?;
        let mut rows = Vec::new();
        for (place, arm) in choice.arms.iter().enumerate() {
            let outer = self.bound.clone();
            let mut conditions = Vec::new();
            self.pattern(&arm.pat, &subject, &mut conditions)?;
            let value = self.piece(&arm.body)?;
            self.bound = outer;
            let is_last = place + 1 == choice.arms.len();
            let joined = conditions.into_iter().reduce(|left, right| {
                let sides = [left, right].map(|side| side.at_least(Precedence::And));
                Piece::new(sides.join(" \\land "), Precedence::And)
            });
            rows.push((value, joined.filter(|_| !is_last)));
        }
        Ok(cases(&rows))
    }

    /// The conditions under which the parts of a `match` are those of a pattern, whose names are bound.
    fn pattern(
        &mut self,
        pattern: &Pat,
        subject: &[Piece],
        conditions: &mut Vec<Piece>,
    ) -> syn::Result<()> {
        match (pattern, subject) {
            (Pat::Wild(_), _) => {}
            (Pat::Paren(inner), _) => self.pattern(&inner.pat, subject, conditions)?,
            (Pat::Guard(guarded), _) => {
                self.pattern(&guarded.pat, subject, conditions)?;
                conditions.push(self.piece(&guarded.guard)?);
            }
            (Pat::Ident(name), [part]) => {
                let text = part.clone().at_least(Precedence::Atom);
                self.bound.insert(name.ident.to_string(), text);
            }
            (Pat::Lit(literal), [part]) => conditions.push(match &literal.lit {
                Lit::Bool(truth) if !truth.value => negated(part.clone()),
                _ => part.clone(),
            }),
            (Pat::Tuple(tuple), parts) if tuple.elems.len() == parts.len() => {
                for (pattern, part) in tuple.elems.iter().zip(parts) {
                    self.pattern(pattern, std::slice::from_ref(part), conditions)?;
                }
            }
            _ => return unsupported(pattern),
        }
        Ok(())
    }
}

/// A condition turned around.
fn negated(condition: Piece) -> Piece {
    let text = format!("\\lnot {}", condition.at_least(Precedence::Atom));
    Piece::new(text, Precedence::Comparison)
}

/// Values with their conditions, of which one without is what is left.
fn cases(rows: &[(Piece, Option<Piece>)]) -> Piece {
    let row = |(value, condition): &(Piece, Option<Piece>)| match condition {
        Some(condition) => format!("{} & \\text{{if }} {}", value.text, condition.text),
        None => format!("{} & \\text{{otherwise}}", value.text),
    };
    let rows: Vec<String> = rows.iter().map(row).collect();
    let text = format!("\\begin{{cases}} {} \\end{{cases}}", rows.join(" \\\\ "));
    Piece::new(text, Precedence::Product)
}
