//! Whether a form of a formula is as right as the formula as its author wrote it.
//!
//! Forms that are equal on paper differ in floating point: $(x-y)(x+y)$ keeps the digits that $x^2-y^2$ loses, $xy/(x+y)$ leaves
//! the range of numbers where $1/(1/x+1/y)$ does not. The author's form, evaluated operation by operation as Rust does, is what
//! every other form is held against, derivatives against those of the author's operations one by one, as dual numbers have
//! them (or, where the sizes of inputs are stated, the reverse mode). A form is taken only where it is finite wherever the author's is and its error is no larger than a stated multiple of
//! the author's: at points with zeros, infinities, and numbers far from 1, and where operations of the form's own leave the
//! range of numbers ([`probes`]), by running bounds of the errors ([`bounded`](super::bounded)); and, where bounds say nothing
//! because rounding errors cancel, by the errors themselves, measured in twice the digits. There each form also has to be the
//! same number as the author's to some 28 digits, which confirms all that was taken for equal on the way to it.

mod author;

use std::fmt;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::bounded::{Bounded, LAST_PLACE, Pack, UNIT};
use super::probes::{self, Difference};
use crate::circuit::{Circuit, Operation};
use crate::graph::{ExprId, Graph, Symbol, SymbolId};
use crate::interpret::double_double::DoubleDouble;
use crate::interpret::{Number, Prepared};
use crate::parallel::{WORTH_A_THREAD, on_all_cores};
use author::{Author, Group, Measured, exactly, lane_of, packed};

/// How much larger than the author's the error of a form may be. Both are bounds, which grow with the number of
/// operations; a cancellation is larger by orders of magnitude.
const ALLOWED: f64 = 64.0;

/// The share of a number by which two evaluations in twice the digits may differ, beside the running bound of their errors:
/// 2⁻⁹⁶, some hundred units of their last place.
const SAME: f64 = 1.0 / (1_u128 << 96) as f64;

/// A formula as its author wrote it, with the partials that a form asks for, derived operation by operation.
#[derive(Clone, Debug)]
pub struct Written {
    /// A graph as written.
    pub graph: Graph,
    /// The numbers, in the order of the form, with partials as dual numbers have them.
    pub roots: Vec<ExprId>,
    /// The numbers with partials in the reverse mode, which takes fewer operations.
    pub reverse: Vec<ExprId>,
    /// Whether the author wrote sums against rounding, so that the formula stays as it is.
    pub undoes_rounding: bool,
}

/// Why a form is not taken.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// The author's sums are there for the sake of rounding, which no other form has.
    UndoesRounding,
    /// Its constants or exponents are too long.
    TooLong,
    /// It is not finite at a point where the author's form is.
    NotFinite(String),
    /// It has fewer digits at a point.
    LosesDigits(String),
    /// It is another number.
    Another(String),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UndoesRounding => write!(
                f,
                "its sums take away what others added, for the sake of rounding"
            ),
            Self::TooLong => write!(f, "gathered, its constants or exponents are too long"),
            Self::NotFinite(at) => write!(f, "forms with fewer operations are not finite at {at}"),
            Self::LosesDigits(at) => write!(f, "forms with fewer operations lose digits at {at}"),
            Self::Another(at) => write!(f, "another form was found to be another number at {at}"),
        }
    }
}

/// How many forms were found to be another number than the author's, in this process. Each is a mistake of the generator's:
/// the form is not taken, and tests see that there is none.
pub fn refuted() -> usize {
    REFUTED.load(Ordering::Relaxed)
}

static REFUTED: AtomicUsize = AtomicUsize::new(0);

/// The author's form at all points: what every other form is held against.
pub struct Reference {
    /// The symbols' names, of those that the numbers depend on.
    names: Vec<Option<String>>,
    /// By packs of points; none of a formula with an integral.
    known: Vec<Known>,
    groups: Vec<Group>,
    /// What points beside these are found with and held against.
    more: Option<More>,
}

/// The author's form at a pack of points.
#[derive(Clone, Debug)]
struct Known {
    symbols: Vec<Pack>,
    outputs: Vec<Pack>,
}

/// The author's form with the symbols it depends on, ready to be looked at where another form leaves the range of numbers.
struct More {
    author: Author,
    used: Vec<SymbolId>,
    differences: Vec<Difference>,
    /// Of how large a share of all rays there are points.
    share: f64,
}

/// The packs of points at which forms were found wrong: where one is, others often are.
#[derive(Clone, Debug, Default)]
pub struct Decisive {
    /// By their places among those at which all forms are looked at.
    places: Vec<usize>,
    /// Beside these, those of single forms.
    beside: Vec<Known>,
}

impl Reference {
    /// The author's form.
    pub fn of(written: &Written) -> Self {
        Self::at(written, probes::differences(&written.graph, &written.roots))
    }

    /// The author's form, looked at also where differences nearly vanish that show only when it is gathered.
    pub fn beside(written: &Written, graph: &Graph, outputs: &[ExprId]) -> Self {
        let mut differences = probes::differences(&written.graph, &written.roots);
        differences.extend(probes::differences(graph, outputs));
        Self::at(written, differences)
    }

    fn at(written: &Written, differences: Vec<Difference>) -> Self {
        let Written { graph, roots, .. } = written;
        let used = graph.symbols_of(roots);
        let name =
            |(id, symbol): (SymbolId, &Symbol)| used.contains(&id).then(|| symbol.name.clone());
        let names = graph.symbols().map(name).collect();
        let Some(author) = Author::of(written) else {
            return Self {
                names,
                known: Vec::new(),
                groups: Vec::new(),
                more: None,
            };
        };
        let share = probes::share(author.bounds.len());
        let points = probes::points(graph, roots, &differences, share);
        let known = known(&author, &points);
        let groups = probes::groups(graph, &differences, share);
        let measured = in_parts(&groups, OF_A_GROUP * author.bounds.len(), |groups| {
            let groups = groups.iter();
            groups
                .map(|points| Group::of(&author, points))
                .collect::<Vec<_>>()
        });
        Self {
            names,
            known,
            groups: measured.into_iter().flatten().collect(),
            more: Some(More {
                author,
                used: used.into_iter().collect(),
                differences,
                share,
            }),
        }
    }

    /// What is wrong with a circuit of the same outputs; nothing where it is as right as the author's form.
    pub fn fault(&self, graph: &Graph, circuit: &Circuit) -> Option<Fault> {
        self.fault_by(graph, circuit, &mut Decisive::default())
    }

    /// What is wrong with a circuit, looked for first where others were found wrong.
    pub fn fault_by(
        &self,
        graph: &Graph,
        circuit: &Circuit,
        decisive: &mut Decisive,
    ) -> Option<Fault> {
        let prepared = Prepared::of_circuit(graph, circuit);
        let places = decisive.places.iter().map(|place| &self.known[*place]);
        let memory = &mut Vec::new();
        let fault = places
            .chain(&decisive.beside)
            .filter_map(|known| self.fault_at(known, &prepared, memory))
            .next();
        if fault.is_some() {
            return fault;
        }
        if let Some((place, fault)) = self.first_fault(&self.known, &prepared) {
            decisive.places.push(place);
            return Some(fault);
        }
        let fault = self.fault_of_groups(graph, circuit, &prepared);
        if fault.is_some() {
            return fault;
        }
        let beside = self.beyond_range(graph, circuit);
        let (place, fault) = self.first_fault(&beside, &prepared)?;
        decisive.beside.push(beside[place].clone());
        Some(fault)
    }

    /// The author's form where an operation of another form leaves the range of numbers.
    fn beyond_range(&self, graph: &Graph, circuit: &Circuit) -> Vec<Known> {
        let Some(more) = &self.more else {
            return Vec::new();
        };
        let sizes = Prepared::of_circuit(graph, circuit);
        let points = probes::rays(graph, &sizes, &more.used, &more.differences, more.share);
        known(&more.author, &points)
    }

    /// What is wrong at the first point where anything is, and the place of its pack.
    fn first_fault(&self, known: &[Known], prepared: &Prepared<Pack>) -> Option<(usize, Fault)> {
        let first = AtomicUsize::new(usize::MAX);
        let places: Vec<usize> = (0..known.len()).collect();
        let found = in_parts(&places, Pack::LANES * prepared.len(), |places| {
            let mut memory = Vec::new();
            for place in places {
                // One point decides: the first that does, whichever core finds one sooner.
                if first.load(Ordering::Relaxed) < *place {
                    return None;
                }
                if let Some(fault) = self.fault_at(&known[*place], prepared, &mut memory) {
                    first.fetch_min(*place, Ordering::Relaxed);
                    return Some((*place, fault));
                }
            }
            None
        });
        found.into_iter().flatten().next()
    }

    fn fault_of_groups(
        &self,
        graph: &Graph,
        circuit: &Circuit,
        bounds: &Prepared<Pack>,
    ) -> Option<Fault> {
        let other = Other {
            bounds,
            exact: &Prepared::of_circuit(graph, circuit),
            has_no_corners: has_no_corners(circuit),
        };
        let groups = self.groups.iter();
        groups
            .filter_map(|group| self.fault_of_group(group, &other))
            .next()
    }

    /// What is wrong at the first point of a pack where anything is.
    fn fault_at(
        &self,
        known: &Known,
        prepared: &Prepared<Pack>,
        memory: &mut Vec<Pack>,
    ) -> Option<Fault> {
        let Known { symbols, outputs } = known;
        let found = prepared.at_with(symbols, memory);
        let text = |lane: usize| {
            let at = lane_of(symbols, lane);
            self.text(at.iter().map(|number| number.value))
        };
        (0..Pack::LANES).find_map(|lane| {
            let mut both = outputs.iter().zip(&found);
            both.find_map(|(known, found)| {
                let (known, found) = (known.lane(lane), found.lane(lane));
                if !known.value.is_finite() {
                    return None;
                }
                if !found.value.is_finite() {
                    return Some(Fault::NotFinite(text(lane)));
                }
                (!is_as_right(known, found)).then(|| Fault::LosesDigits(text(lane)))
            })
        })
    }

    /// Compares the errors of both forms at points that differ in their last digits alone: the larger one of some is no
    /// matter of chance.
    fn fault_of_group(&self, group: &Group, other: &Other<'_>) -> Option<Fault> {
        let mut errors: Vec<[f64; 2]> = Vec::new();
        let found = other.bounds.at(&group.symbols);
        for (lane, measured) in group.points.iter().enumerate() {
            let Measured { at, bounds, exact } = measured;
            let found = lane_of(&found, lane);
            let found_exact = other.exact.at(&exactly(at));
            errors.resize(bounds.len(), [0.0; 2]);
            for (place, known) in bounds.iter().enumerate() {
                let (exact, found_exact) = (exact[place], found_exact[place]);
                let apart = exact.add(&-found_exact).high.abs();
                // Both lose in twice the digits what their operations lose in single ones.
                let of_both = (known.error + found[place].error) * (SAME / LAST_PLACE);
                let lost = of_both + SAME * known.value.abs();
                if !(known.value.is_finite() && apart.is_finite() && lost.is_finite()) {
                    continue;
                }
                if apart > ALLOWED * lost && other.has_no_corners {
                    REFUTED.fetch_add(1, Ordering::Relaxed);
                    return Some(Fault::Another(self.text(at.iter().copied())));
                }
                // Where twice the digits are lost as well, nothing is known.
                if lost <= 1e-3 * f64::EPSILON * exact.high.abs() {
                    let error = |value: f64| {
                        let error = DoubleDouble::exact(value).add(&-exact);
                        error.high.abs() / exact.high.abs()
                    };
                    let [author, other] = &mut errors[place];
                    *author = author.max(error(known.value));
                    *other = other.max(error(found[place].value));
                }
            }
        }
        let loses = |[author, other]: &[f64; 2]| *other > ALLOWED * (author + 4.0 * f64::EPSILON);
        let text = || self.text(group.points[0].at.iter().copied());
        errors.iter().any(loses).then(|| Fault::LosesDigits(text()))
    }

    /// A point as text.
    fn text(&self, values: impl Iterator<Item = f64>) -> String {
        let values = self.names.iter().zip(values);
        let values: Vec<String> = values
            .filter_map(|(name, value)| Some(format!("{} = {value:?}", name.as_ref()?)))
            .collect();
        values.join(", ")
    }
}

/// The author's form at points.
fn known(author: &Author, points: &[Vec<f64>]) -> Vec<Known> {
    let packs: Vec<Vec<Pack>> = points.chunks(Pack::LANES).map(packed).collect();
    let known = in_parts(&packs, Pack::LANES * author.bounds.len(), |packs| {
        let mut memory = Vec::new();
        let known = packs.iter().map(|symbols| Known {
            symbols: symbols.clone(),
            outputs: author.bounds_at(symbols, &mut memory),
        });
        known.collect::<Vec<_>>()
    });
    known.into_iter().flatten().collect()
}

/// Whether a number of another form is as near the truth as the author's is known to be, and surely so where that has digits.
fn is_as_right(known: Bounded, found: Bounded) -> bool {
    // What is smaller than any normal number may be lost on the way.
    let lost = if known.value.abs() < f64::MIN_POSITIVE {
        f64::MIN_POSITIVE / UNIT
    } else {
        0.0
    };
    let bound = ALLOWED * (known.error + LAST_PLACE * known.value.abs()) + lost;
    let apart = (known.value - found.value).abs();
    if known.has_digits() {
        return found.error <= bound && apart <= UNIT * ALLOWED * (bound + found.error);
    }
    !known.error.is_finite() || apart <= UNIT * bound
}

/// What an operation at all points of a group, in twice the digits too, counts for beside one at a point.
const OF_A_GROUP: usize = 16;

/// What `work` makes of parts of the items, in order, worked out on all cores; for each item so many operations are done.
fn in_parts<T: Sync, R: Send>(
    items: &[T],
    operations: usize,
    work: impl Fn(&[T]) -> R + Sync,
) -> Vec<R> {
    let length = (WORTH_A_THREAD / operations.max(1)).max(1);
    let parts: Vec<&[T]> = items.chunks(length).collect();
    on_all_cores(&parts, |part| work(part))
}

/// Another form, ready to be evaluated.
struct Other<'o> {
    bounds: &'o Prepared<Pack>,
    exact: &'o Prepared<DoubleDouble>,
    has_no_corners: bool,
}

/// Whether a circuit has no function that jumps or bends, where rounding may decide which side a number is on.
fn has_no_corners(circuit: &Circuit) -> bool {
    circuit.nets().all(|net| {
        !matches!(
            circuit.operation(net),
            Operation::Apply(function, _) if function.is_step() || function.is_choice()
        )
    })
}

#[cfg(test)]
mod tests {
    use smallvec::smallvec;

    use super::*;
    use crate::graph::{Rational, Sizes, whole};

    /// The product of two symbols as written.
    fn product() -> Written {
        let mut graph = Graph::as_written();
        // Numbers too small for twice the digits show nothing.
        graph.sizes = Sizes::Within {
            smallest: 1e-9,
            largest: 1e300,
        };
        let symbols = ["x", "y"].map(|name| graph.symbol_named(name));
        let [x, y] = symbols.map(|symbol| graph.symbol_expression(symbol));
        let roots = vec![graph.multiply(x, y)];
        Written {
            graph,
            reverse: roots.clone(),
            roots,
            undoes_rounding: false,
        }
    }

    /// The product times a number.
    fn multiple(written: &Written, factor: Rational) -> Circuit {
        let mut circuit = super::super::written::circuit(&written.graph, &written.roots);
        let product = circuit.outputs[0];
        circuit.outputs = vec![circuit.push(Operation::Sum(smallvec![(product, factor)]))];
        circuit
    }

    #[test]
    fn another_number_is_found_in_its_twentieth_digit() {
        let written = product();
        let reference = Reference::of(&written);
        let itself = super::super::written::circuit(&written.graph, &written.roots);
        assert_eq!(reference.fault(&written.graph, &itself), None);
        let hair = Rational::new(
            1.into(),
            num_traits::Pow::pow(num_bigint::BigInt::from(10), 20_u32),
        );
        let before = refuted();
        let other = multiple(&written, whole(1) + hair);
        let fault = reference.fault(&written.graph, &other);
        assert!(matches!(fault, Some(Fault::Another(_))), "{fault:?}");
        assert!(refuted() > before);
    }

    #[test]
    fn what_loses_its_range_or_its_digits_is_found() {
        let written = product();
        let reference = Reference::of(&written);
        let fault = |circuit| reference.fault(&written.graph, &circuit);
        // x·y as x·(y·x)/x leaves the range, and as (x·y + x) − x loses digits.
        let mut far = super::super::written::circuit(&written.graph, &written.roots);
        let (x, product) = (far.operands(far.outputs[0])[0], far.outputs[0]);
        let twice = far.push(Operation::Product(smallvec![(x, 1), (product, 1)]));
        far.outputs = vec![far.push(Operation::Quotient(twice, x))];
        assert!(matches!(
            fault(far),
            Some(Fault::NotFinite(_) | Fault::LosesDigits(_))
        ));
        let mut near = super::super::written::circuit(&written.graph, &written.roots);
        let sum = near.sum_of_two((product, whole(1)), (x, whole(1)));
        near.outputs = vec![near.sum_of_two((sum, whole(1)), (x, whole(-1)))];
        assert!(matches!(fault(near), Some(Fault::LosesDigits(_))));
    }
}
