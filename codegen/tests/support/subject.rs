//! A program as written, on a tape with its derivatives, and all code that is generated from it.

use codegen::circuit::Circuit;
use codegen::emit::scalar::Form;
use codegen::expand::{Expansion, Generated};
use codegen::graph::{Graph, SymbolId};
use codegen::interpret::evaluate_circuit;
use codegen::parse::attributes::{StageRequest, Target};
use codegen::parse::module::Function;
use codegen::stage::Staged;
use proc_macro2::Span;

use super::derivative::derivative;
use super::points::Inputs;
use super::program::INPUTS;
use super::recorder::Recorder;
use super::tape::{Place, Step, Tape};

/// One number that a form gives.
#[derive(Clone, Debug)]
pub struct Number {
    /// `value 0`, `value 0 by x`, `value 0 by x, y`.
    pub name: String,
    /// Where the tape has it.
    pub place: Place,
    /// What it is the derivative of, and that is the derivative of, itself last.
    pub of: Vec<Place>,
}

impl Number {
    pub fn is_value(&self) -> bool {
        self.of.len() == 1
    }
}

/// What is generated.
pub enum Code {
    Circuit(Box<(Graph, Circuit)>),
    Staged(Box<Staged>),
    /// Tokens, read again.
    Emitted(Tape, Vec<Place>),
}

/// A form with what it should give.
pub struct Generation {
    pub name: String,
    pub code: Code,
    pub numbers: Vec<Number>,
}

/// A program and all that is generated from it.
pub struct Subject {
    pub tape: Tape,
    pub generations: Vec<Generation>,
}

/// Why there is nothing to compare.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Missing {
    /// The generator says what it does not take.
    Refused(String),
    /// It panicked.
    Panicked(String),
}

/// Along which inputs a program is looked at in stages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stages {
    None,
    /// Two of them, by this number.
    InTurn(usize),
    All,
}

/// Which forms are wanted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// The value and its gradient, and what is said here.
    Several {
        hessian: bool,
        stages: Stages,
        emitted: bool,
    },
    /// The one of that name.
    One(String),
}

impl Wanted {
    fn has(&self, name: &str) -> bool {
        match self {
            Self::One(wanted) => wanted == name,
            Self::Several {
                hessian,
                stages,
                emitted,
            } => {
                let excluded = (name.starts_with("emitted") && !emitted)
                    || (name.ends_with("hessian") && !hessian)
                    || (name.starts_with("stage") && *stages == Stages::None);
                !excluded
            }
        }
    }
}

impl Subject {
    /// Reads a source and generates what is wanted.
    ///
    /// # Errors
    /// What the generator says where it gives nothing.
    pub fn of(source: &str, wanted: &Wanted) -> Result<Self, Missing> {
        let attempt = std::panic::AssertUnwindSafe(|| Self::generated(source, wanted));
        std::panic::catch_unwind(attempt).unwrap_or_else(|payload| {
            let text = payload.downcast_ref::<String>().cloned();
            let text = text.or_else(|| payload.downcast_ref::<&str>().map(ToString::to_string));
            Err(Missing::Panicked(text.unwrap_or_default()))
        })
    }

    fn generated(source: &str, wanted: &Wanted) -> Result<Self, Missing> {
        let module: syn::ItemMod = syn::parse_str(source).unwrap();
        let written = Recorder::of(&module.content.as_ref().unwrap().1);
        let mut expansion = Expansion::of(module);
        if let Some(message) = expansion.diagnostics.iter().next() {
            return Err(Missing::Refused(message.text()));
        }
        let mut tape = Tape::default();
        let values = written.record("formula", &mut tape);
        let mut subject = Self {
            tape,
            generations: Vec::new(),
        };
        let function = expansion.module().function("formula").unwrap();
        let function = Function::clone(function);
        for form in [Form::Value, Form::Gradient, Form::Hessian] {
            let emitted = format!("emitted {}", form.name());
            if wanted.has(form.name()) || wanted.has(&emitted) {
                let generated = expansion.generate(&function, form, &[]).unwrap();
                subject.add_form(&written, generated, &values, wanted);
            }
        }
        subject.add_stages(&mut expansion, &function, &values, wanted);
        Ok(subject)
    }

    fn add_form(
        &mut self,
        written: &Recorder,
        generated: Generated,
        values: &[Place],
        wanted: &Wanted,
    ) {
        let by = generated.by.iter();
        let by: Vec<usize> = by
            .map(|symbol| input_of(&generated.graph, *symbol).unwrap())
            .collect();
        let name = generated.form.name().to_owned();
        let emitted = format!("emitted {name}");
        if wanted.has(&emitted) {
            let file: syn::File = syn::parse2(generated.tokens.clone()).unwrap();
            let code = Recorder::of(&file.items).with_structs_of(written);
            let mut tape = Tape::default();
            let places = code.record(&name, &mut tape);
            let numbers = self.numbers(values, &by, generated.form, |_| 0);
            self.generations.push(Generation {
                numbers,
                name: emitted,
                code: Code::Emitted(tape, places),
            });
        }
        if wanted.has(&name) {
            let numbers = self.numbers(values, &by, generated.form, |row| row);
            self.generations.push(Generation {
                numbers,
                name,
                code: Code::Circuit(Box::new((generated.graph, generated.circuit))),
            });
        }
    }

    /// Values, their gradients, and their second partials by rows from the column that is given for a row.
    fn numbers(
        &mut self,
        values: &[Place],
        by: &[usize],
        form: Form,
        first: impl Fn(usize) -> usize,
    ) -> Vec<Number> {
        let number = |name: String, of: &[Place]| Number {
            name,
            place: of[of.len() - 1],
            of: of.to_vec(),
        };
        let (mut numbers, mut gradients, mut hessians) = (Vec::new(), Vec::new(), Vec::new());
        for (position, value) in values.iter().enumerate() {
            numbers.push(number(format!("value {position}"), &[*value]));
            for (row, one) in by.iter().enumerate() {
                if form == Form::Value {
                    break;
                }
                let slope = self.derivative(*value, *one);
                let name = format!("value {position} by {}", INPUTS[*one]);
                gradients.push(number(name.clone(), &[*value, slope]));
                for (column, other) in by.iter().enumerate().skip(first(row)) {
                    if form == Form::Hessian {
                        // The matrix is symmetric by construction: both of two entries are derived in the same order.
                        let [first, second] = if column < row {
                            [other, one]
                        } else {
                            [one, other]
                        };
                        let slope = self.derivative(*value, *first);
                        let second = self.derivative(slope, *second);
                        let name = format!("{name}, {}", INPUTS[*other]);
                        hessians.push(number(name, &[*value, slope, second]));
                    }
                }
            }
        }
        numbers.extend(gradients);
        numbers.extend(hessians);
        numbers
    }

    fn derivative(&mut self, of: Place, input: usize) -> Place {
        let zero = self.tape.literal("0.0");
        let slopes = derivative(&mut self.tape, &[of], &Step::Input(input));
        slopes[0].unwrap_or(zero)
    }

    /// Along each input that is used, and along the first two.
    fn add_stages(
        &mut self,
        expansion: &mut Expansion,
        function: &Function,
        values: &[Place],
        wanted: &Wanted,
    ) {
        let graph = &expansion.formula("formula").unwrap().graph;
        let used: Vec<&str> = INPUTS
            .into_iter()
            .filter(|input| graph.find_symbol(input).is_some())
            .filter(|input| self.uses(input))
            .collect();
        let mut inner: Vec<Vec<&str>> = used.iter().map(|input| vec![*input]).collect();
        if used.len() > 2 {
            inner.push(used[..2].to_vec());
        }
        if let Wanted::Several {
            stages: Stages::InTurn(number),
            ..
        } = wanted
            && inner.len() > 2
        {
            let first = inner.remove(number % inner.len());
            let second = inner.swap_remove(number / (inner.len() + 1) % inner.len());
            inner = vec![first, second];
        }
        for inner in inner {
            let name = format!("stage {}", inner.join(" "));
            if !wanted.has(&name) {
                continue;
            }
            let target = |symbol: &&str| Target {
                symbol: (*symbol).to_owned(),
                span: Span::call_site(),
            };
            let request = StageRequest {
                inner: inner.iter().map(target).collect(),
                span: Span::call_site(),
            };
            let (staged, _, _) = expansion.staged(function, &request).unwrap();
            let numbers = self.numbers(values, &[], Form::Value, |row| row);
            self.generations.push(Generation {
                name,
                code: Code::Staged(Box::new(staged)),
                numbers,
            });
        }
    }

    fn uses(&self, input: &str) -> bool {
        let position = INPUTS.iter().position(|known| *known == input);
        let mut steps = self.tape.steps.iter();
        steps.any(|step| position.is_some_and(|position| *step == Step::Input(position)))
    }
}

/// The position of the input behind a symbol.
fn input_of(graph: &Graph, symbol: SymbolId) -> Option<usize> {
    let name = &graph.symbol(symbol).name;
    INPUTS.iter().position(|known| known == name)
}

fn symbols(graph: &Graph, inputs: &Inputs) -> Vec<f64> {
    let symbols = graph.symbols();
    symbols
        .map(|(symbol, _)| input_of(graph, symbol).map_or(f64::NAN, |input| inputs[input]))
        .collect()
}

impl Code {
    /// Its results in `f64`.
    pub fn run(&self, inputs: &Inputs) -> Vec<f64> {
        match self {
            Self::Circuit(both) => {
                let (graph, circuit) = both.as_ref();
                evaluate_circuit(graph, circuit, &symbols(graph, inputs))
            }
            Self::Staged(staged) => in_stages(staged, inputs),
            Self::Emitted(tape, places) => tape.evaluate(places, inputs),
        }
    }
}

/// What a staged form's three circuits give together.
fn in_stages(staged: &Staged, inputs: &Inputs) -> Vec<f64> {
    let graph = &staged.graph;
    let mut numbers = symbols(graph, inputs);
    let before = [
        (&staged.fixed, &staged.fixed_symbols),
        (&staged.along, &staged.along_symbols),
    ];
    for (circuit, symbols) in before {
        let values = evaluate_circuit(graph, circuit, &numbers);
        for (symbol, value) in symbols.iter().zip(values) {
            numbers[symbol.index()] = value;
        }
    }
    evaluate_circuit(graph, &staged.points, &numbers)
}
