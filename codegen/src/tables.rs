//! The tabulated functions of a module, each fitted once, when it is first used.

use std::collections::BTreeMap;

use crate::approximate::piecewise;
use crate::diagnostics::Diagnostics;
use crate::graph::{Sign, Table};
use crate::interpret::{EvaluateError, Integrator, describe};
use crate::parse::attributes::Approximation;
use crate::parse::body::Reader;
use crate::parse::module::{Function, Module};
use crate::parse::value::Value;

/// Share of a fit's tolerance that the quadrature behind it may use up.
const QUADRATURE_SHARE: f64 = 0.05;

/// The tabulated functions of one module.
#[derive(Debug, Default)]
pub struct Tables {
    known: BTreeMap<String, Option<Table>>,
    /// Why a table could not be made.
    pub diagnostics: Diagnostics,
}

impl Tables {
    /// The table of an approximated function. None where it could not be made, which is then reported.
    pub fn get(&mut self, module: &Module, function: &Function, approximation: &Approximation) -> Option<&Table> {
        let name = function.name();
        if !self.known.contains_key(&name) {
            // Entered first, so that a function whose integrand needs its own table ends here.
            self.known.insert(name.clone(), None);
            let table = self.fit(module, function, approximation);
            self.known.insert(name.clone(), table);
        }
        self.known.get(&name)?.as_ref()
    }

    fn fit(&mut self, module: &Module, function: &Function, approximation: &Approximation) -> Option<Table> {
        let mut reader = Reader::new(module, self);
        let body = match reader.read_body(function)? {
            Value::Number(id) => id,
            other => {
                let message = format!("an approximated function gives a number, not {}", other.description());
                self.diagnostics.error(function.item.sig.ident.span(), message);
                return None;
            }
        };
        let factor = reader.read_factor(approximation)?;
        let graph = reader.graph;
        let symbol = graph.find_symbol(&approximation.variable.to_string())?;
        let mut integrator = Integrator::new(&graph, QUADRATURE_SHARE * approximation.tolerance);
        let mut quotient = |x: f64| -> Result<f64, EvaluateError> {
            let body = integrator.evaluate(body, symbol, x)?;
            Ok(body / integrator.evaluate(factor, symbol, x)?)
        };
        let fit = piecewise::fit(&mut quotient, approximation.lower, approximation.upper, approximation.tolerance);
        match fit {
            Ok(polynomial) => {
                let sign = sign(&polynomial);
                Some(Table { name: function.name(), polynomial, sign })
            }
            Err(error) => {
                self.diagnostics.error_with_hint(
                    approximation.span,
                    format!("`{}` can't be approximated: {}", function.name(), describe(&error)),
                    "a larger tolerance, a factor that takes out a root or pole at the ends, or a smaller interval may help",
                );
                None
            }
        }
    }
}

/// The sign of a fit over its interval: one where |a₀| is more than all other coefficients together on each piece.
fn sign(polynomial: &piecewise::PiecewisePolynomial) -> Sign {
    let signs = polynomial.coefficients().iter().map(|piece| {
        let (first, rest) = piece.split_first()?;
        let swing: f64 = rest.iter().map(|coefficient| coefficient.abs()).sum();
        (first.abs() > swing).then_some(*first > 0.0)
    });
    match signs.reduce(|left, right| if left == right { left } else { None }) {
        Some(Some(true)) => Sign::POSITIVE,
        Some(Some(false)) => Sign::NEGATIVE,
        _ => Sign::UNKNOWN,
    }
}
