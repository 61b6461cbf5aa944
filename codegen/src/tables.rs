//! The tabulated functions of a module, each fitted once, when it is first used.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use crate::approximate::piecewise::{self, FitError};
use crate::diagnostics::Diagnostics;
use crate::graph::{ExprId, Graph, Sign, SymbolId, Table};
use crate::interpret::{EvaluateError, Integrator, describe};
use crate::parse::attributes::Approximation;
use crate::parse::body::Reader;
use crate::parse::module::{Function, Module};
use crate::parse::place::Place;
use crate::parse::tabulated::TableSource;
use crate::parse::value::Value;

/// Share of a fit's tolerance that the quadrature behind it may use up.
const QUADRATURE_SHARE: f64 = 0.05;

/// The tolerance of a sketched fit: enough for the function's sign.
const SKETCH: f64 = 1e-3;

/// What tells a table: for which module it is read, and the module and the name of its function.
type Key = [String; 3];

/// The tabulated functions of one module, and those that it calls of modules that it links.
#[derive(Debug, Default)]
pub struct Tables {
    known: BTreeMap<Key, Option<Table>>,
    /// By the names of tables: those that another module has.
    lent: BTreeMap<String, Lent>,
    sketched: bool,
    /// Why a table could not be made.
    pub diagnostics: Diagnostics,
}

impl Tables {
    /// Tables that are fitted to three digits, whatever tolerance is asked for. The code that calls a table depends on
    /// its name and its sign alone, so that this is enough where only that code is looked at.
    pub fn sketched() -> Self {
        Self {
            sketched: true,
            ..Self::default()
        }
    }

    /// The table of a linked module's function, sketched: the module has it in full.
    fn borrow(
        &mut self,
        reading: &Module,
        home: &Module,
        function: &Function,
        approximation: &Approximation,
    ) -> Option<Table> {
        let before = self.diagnostics.len();
        let table = self.fit(home, function, approximation, true);
        self.diagnostics.split_off(before);
        let mut table = table?;
        let mut at = reading.linked.iter();
        let place = at
            .find(|linked| linked.module.key == home.key)?
            .place
            .clone();
        let taken = |name: &str| reading.function(name).is_some() || self.lent.contains_key(name);
        if taken(&table.name) {
            table.name = format!("{}_{}", place.last().unwrap_or("linked"), table.name);
            while taken(&table.name) {
                table.name.push('_');
            }
        }
        let function = function.name();
        self.lent
            .insert(table.name.clone(), Lent { place, function });
        Some(table)
    }

    /// Which function of which linked module a table is of, where it is of one.
    pub fn lent(&self, table: &str) -> Option<&Lent> {
        self.lent.get(table)
    }

    /// A linked module's table, fitted to all its digits.
    pub fn in_full(&mut self, reading: &Module, table: &Table) -> Table {
        let fitted = self.lent.get(&table.name).cloned().and_then(|lent| {
            let home = lent.home(reading)?;
            let function = home.function(&lent.function)?;
            let approximation = function.approximation.as_ref()?;
            self.fit(home, function, approximation, self.sketched)
        });
        let name = table.name.clone();
        fitted.map_or_else(|| table.clone(), |fitted| Table { name, ..fitted })
    }

    fn fit(
        &mut self,
        module: &Module,
        function: &Function,
        approximation: &Approximation,
        sketched: bool,
    ) -> Option<Table> {
        let mut reader = Reader::new(module, self);
        let body = reader.read_body(function);
        let factor = reader.read_factor(approximation);
        let (graph, diagnostics) = (reader.graph, reader.diagnostics);
        self.diagnostics.append(diagnostics);
        let body = match body? {
            Value::Number(id) => id,
            other => {
                let message = format!(
                    "an approximated function gives a number, not {}",
                    other.description()
                );
                let hint = "write a function of its own for each of them";
                self.diagnostics
                    .error_with_hint(function.item.sig.ident.span(), message, hint);
                return None;
            }
        };
        let factor = factor?;
        let symbol = graph.find_symbol(&approximation.variable.to_string())?;
        let tolerance = if sketched {
            SKETCH.max(approximation.tolerance)
        } else {
            approximation.tolerance
        };
        let integrators = Integrators {
            graph: &graph,
            tolerance: QUADRATURE_SHARE * tolerance,
            idle: Mutex::default(),
        };
        let quotient = |x| integrators.quotient([body, factor], symbol, x);
        let fit = piecewise::fit(
            &quotient,
            approximation.lower,
            approximation.upper,
            tolerance,
        );
        match fit {
            Ok(polynomial) => {
                let sign = sign(&polynomial);
                Some(Table {
                    name: function.name(),
                    polynomial,
                    sign,
                })
            }
            Err(error) => {
                self.diagnostics.error_with_hint(
                    approximation.span,
                    format!(
                        "`{}` can't be approximated: {}",
                        function.name(),
                        describe(&error)
                    ),
                    hint(&error),
                );
                None
            }
        }
    }
}

impl TableSource for Tables {
    // Mistakes in a linked module's function are reported by that module itself.
    fn table(
        &mut self,
        reading: &Module,
        home: &Module,
        function: &Function,
        approximation: &Approximation,
    ) -> Option<&Table> {
        let key = [reading.key.clone(), home.key.clone(), function.name()];
        if !self.known.contains_key(&key) {
            // Entered first, so that a function whose integrand needs its own table ends here.
            self.known.insert(key.clone(), None);
            let table = if reading.key == home.key {
                self.fit(home, function, approximation, self.sketched)
            } else {
                self.borrow(reading, home, function, approximation)
            };
            self.known.insert(key.clone(), table);
        }
        self.known.get(&key)?.as_ref()
    }

    fn sketched_apart(&self) -> Box<dyn TableSource> {
        Box::new(Self::sketched())
    }
}

/// A table that another module has.
#[derive(Clone, Debug)]
pub struct Lent {
    /// Where the module is.
    pub place: Place,
    /// The approximated function.
    pub function: String,
}

impl Lent {
    /// The module that has it.
    fn home<'m>(&self, reading: &'m Module) -> Option<&'m Module> {
        let mut linked = reading.linked.iter();
        let linked = linked.find(|linked| linked.place == self.place)?;
        Some(&linked.module)
    }

    /// Whether the module has the table's derivative of that order for others, for packs if that is asked.
    pub fn has(&self, reading: &Module, order: usize, in_packs: bool) -> bool {
        self.home(reading).is_some_and(|home| {
            let function = home.function(&self.function);
            let most = function.and_then(|function| orders_for_others(function));
            most.is_some_and(|most| order <= most) && (!in_packs || home.runs_on_lanes())
        })
    }
}

/// The highest derivative of a function's table that its module has for others: what its own forms take.
pub fn orders_for_others(function: &Function) -> Option<usize> {
    let request = function.request.as_ref()?;
    function.approximation.as_ref()?;
    let (gradient, hessian) = (request.gradient.is_some(), request.hessian.is_some());
    Some(usize::from(gradient).max(2 * usize::from(hessian)))
}

/// Evaluators of a graph for as many threads as ask for one.
struct Integrators<'g> {
    graph: &'g Graph,
    tolerance: f64,
    idle: Mutex<Vec<Integrator<'g>>>,
}

impl Integrators<'_> {
    /// The quotient of two expressions where the symbol has the given value.
    fn quotient(
        &self,
        of: [ExprId; 2],
        symbol: SymbolId,
        value: f64,
    ) -> Result<f64, EvaluateError> {
        let idle = || self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        let taken = idle().pop();
        let mut integrator = taken.unwrap_or_else(|| Integrator::new(self.graph, self.tolerance));
        let [numerator, denominator] = of;
        let numerator = integrator.evaluate(numerator, symbol, value)?;
        let denominator = integrator.evaluate(denominator, symbol, value)?;
        idle().push(integrator);
        Ok(numerator / denominator)
    }
}

/// What may help where a function can't be approximated.
fn hint(error: &FitError<EvaluateError>) -> &'static str {
    match error {
        FitError::NotMet { .. } | FitError::DerivativeNotMet { .. } => {
            "a larger tolerance, a factor that takes out a root or pole at the ends, or a smaller interval may help"
        }
        FitError::NotFinite { .. } => {
            "choose an interval in which the function and its factor are finite and not zero, but for the ends"
        }
        FitError::Function { .. } => {
            "its integrals need finite bounds and an integrand that is finite between them, for all of the interval"
        }
        FitError::Zero { .. } => {
            "take it out with factor = …, or choose an interval on one side of it"
        }
        FitError::Interval { .. } | FitError::Tolerance { .. } => {
            "the interval is of two finite numbers, the tolerance above zero"
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
