//! The paper's formulas in 77 digits: the derivatives that the generator makes against differences of the formulas as
//! written, and the compiled code against both.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use std::cell::RefCell;
use std::cmp::Ordering;

use astro_float::{BigFloat, Consts, Radix, RoundingMode};
use codegen::emit::scalar::Form;
use codegen::expand::{Expansion, derive};
use codegen::graph::{Function, NamedConstant, Rational, SymbolId, Table};
use codegen::interpret::{Number, evaluate};
use codegen::parse::body::Reader;
use codegen::show::System;
use codegen::tables::Tables;
use rotor_core::equations::{self, Coefficients};

/// Binary digits: 77 decimal ones.
const DIGITS: usize = 256;
const ROUNDING: RoundingMode = RoundingMode::ToEven;
/// Step of the differences: their own error is some 1e-36 of the function, its second derivatives' 1e-36 too.
const STEP: &str = "1e-18";

thread_local! {
    static CONSTANTS: RefCell<Consts> = RefCell::new(Consts::new().expect("the cache of constants"));
}

fn with_constants(value: impl FnOnce(&mut Consts) -> BigFloat) -> Precise {
    CONSTANTS.with_borrow_mut(|constants| Precise(value(constants)))
}

/// A number of 77 digits.
#[derive(Clone, Debug)]
struct Precise(BigFloat);

impl Precise {
    fn exactly(value: f64) -> Self {
        Self(BigFloat::from_f64(value, DIGITS))
    }

    fn decimal(digits: &str) -> Self {
        with_constants(|constants| BigFloat::parse(digits, Radix::Dec, DIGITS, ROUNDING, constants))
    }

    fn minus(&self, other: &Self) -> Self {
        Self(self.0.sub(&other.0, DIGITS, ROUNDING))
    }

    fn size(&self) -> Self {
        Self(self.0.abs())
    }

    fn compare(&self, other: &Self) -> Option<Ordering> {
        self.0.cmp(&other.0).map(|order| order.cmp(&0))
    }

    fn is_at_most(&self, other: &Self) -> bool {
        matches!(self.compare(other), Some(Ordering::Less | Ordering::Equal))
    }

    /// To the nearest `f64`, or one beside it.
    fn approximately(&self) -> f64 {
        self.0.to_string().parse().expect("a number of many digits")
    }
}

impl Number for Precise {
    fn rational(value: &Rational) -> Self {
        Self::decimal(&value.numerator().to_string())
            .divide(&Self::decimal(&value.denominator().to_string()))
    }

    fn constant(constant: NamedConstant) -> Self {
        with_constants(|constants| match constant {
            // No formula of the rotor has it, nor does the library of many digits.
            NamedConstant::EulerGamma => panic!("{constant:?}"),
            NamedConstant::Pi => constants.pi(DIGITS, ROUNDING),
            NamedConstant::E => constants.e(DIGITS, ROUNDING),
            NamedConstant::Ln2 => constants.ln_2(DIGITS, ROUNDING),
            NamedConstant::Ln10 => constants.ln_10(DIGITS, ROUNDING),
        })
    }

    fn add(&self, other: &Self) -> Self {
        Self(self.0.add(&other.0, DIGITS, ROUNDING))
    }

    fn multiply(&self, other: &Self) -> Self {
        Self(self.0.mul(&other.0, DIGITS, ROUNDING))
    }

    fn divide(&self, other: &Self) -> Self {
        Self(self.0.div(&other.0, DIGITS, ROUNDING))
    }

    fn apply(function: Function, operands: &[Self]) -> Self {
        let x = &operands[0];
        match (function, operands) {
            (Function::Sqrt, _) => Self(x.0.sqrt(DIGITS, ROUNDING)),
            (Function::Sin, _) => with_constants(|constants| x.0.sin(DIGITS, ROUNDING, constants)),
            (Function::Cos, _) => with_constants(|constants| x.0.cos(DIGITS, ROUNDING, constants)),
            (Function::Tan, _) => with_constants(|constants| x.0.tan(DIGITS, ROUNDING, constants)),
            (Function::Exp, _) => with_constants(|constants| x.0.exp(DIGITS, ROUNDING, constants)),
            (Function::Ln, _) => with_constants(|constants| x.0.ln(DIGITS, ROUNDING, constants)),
            (Function::Abs, _) => x.size(),
            (Function::Sign | Function::Side, _) => {
                Self::exactly(if x.0.is_negative() { -1.0 } else { 1.0 })
            }
            (Function::Min, [x, y]) => (if x.is_at_most(y) { x } else { y }).clone(),
            (Function::Max, [x, y]) => (if y.is_at_most(x) { x } else { y }).clone(),
            (Function::Select, [a, b, x, y]) => {
                let are_equal = a.is_at_most(b) && b.is_at_most(a);
                (if are_equal { x } else { y }).clone()
            }
            (Function::MulAdd, [a, b, c]) => a.multiply(b).add(c),
            other => panic!("{other:?}"),
        }
    }

    fn tabulated(table: &Table, _order: usize, _argument: &Self) -> Self {
        panic!("{} has no more digits than an f64", table.name)
    }
}

/// Points of the model that share no symmetry; the numbers are exact in `f64`, so that all ways start from the same.
fn coefficients() -> [Coefficients; 6] {
    [
        [
            1.5, 0.4375, 0.84375, 0.03125, 0.0234375, 0.015625, 0.203125, 0.6875,
        ],
        [
            0.5625,
            -0.8125,
            1.78125,
            0.0078125,
            -0.01171875,
            0.029296875,
            -0.140625,
            2.125,
        ],
        // A flat disk, a slender one, two whirls that come close, a strong excitation.
        [
            1.90625, -0.90625, 1.5625, 0.125, 0.140625, 0.09375, 0.1875, 0.375,
        ],
        [
            0.140625, 0.625, 0.71875, -0.15625, 0.046875, 0.109375, 0.0625, -1.28125,
        ],
        [
            0.625, 0.0625, 0.4375, 0.03125, -0.28125, 0.0546875, -0.21875, 0.8125,
        ],
        [
            1.25, 1.4375, 2.75, 0.34375, 0.28125, -0.40625, 0.46875, -2.65625,
        ],
    ]
    .map(
        |[
            beta,
            gamma,
            delta,
            epsilon_1,
            epsilon_12,
            epsilon_2,
            disk_asymmetry,
            crack_angle,
        ]| Coefficients {
            beta,
            gamma,
            delta,
            epsilon_1,
            epsilon_12,
            epsilon_2,
            disk_asymmetry,
            crack_angle,
        },
    )
}

const OMEGA: f64 = 0.71875;
const SPEED: f64 = 1.140625;

/// The number that a formula's symbol stands for.
fn input(name: &str, c: &Coefficients) -> f64 {
    match name {
        "omega" => OMEGA,
        "speed" => SPEED,
        "c.beta" => c.beta,
        "c.gamma" => c.gamma,
        "c.delta" => c.delta,
        "c.epsilon_1" => c.epsilon_1,
        "c.epsilon_12" => c.epsilon_12,
        "c.epsilon_2" => c.epsilon_2,
        "c.disk_asymmetry" => c.disk_asymmetry,
        "c.crack_angle" => c.crack_angle,
        // The formula's partials were taken over symbols of their own, which the arguments have replaced since.
        replaced if replaced.contains('#') => f64::NAN,
        other => panic!("{other} is no input"),
    }
}

fn formulas() -> System {
    codegen::show::system(&rotor_core::equations::SOURCES).expect("the modules of formulas")
}

/// A formula as written, moved from a point along some of its inputs.
struct AsWritten<'e> {
    expansion: &'e Expansion,
    name: &'e str,
    c: Coefficients,
}

impl AsWritten<'_> {
    fn at(&self, moved: &[(&str, &Precise)]) -> Precise {
        let module = self.expansion.module();
        let mut tables = Tables::default();
        let mut reader = Reader::new(module, &mut tables);
        let function = module.function(self.name).expect("a formula of that name");
        let value = reader.read(function).expect("a formula without mistakes");
        let roots: Vec<_> = value.numbers().into_iter().map(|(_, id)| id).collect();
        let symbols: Vec<Precise> = reader
            .graph
            .symbols()
            .map(|(_, symbol)| {
                let start = Precise::exactly(input(&symbol.name, &self.c));
                let steps = moved.iter().filter(|(name, _)| *name == symbol.name);
                steps.fold(start, |place, (_, step)| place.add(step))
            })
            .collect();
        evaluate(&reader.graph, &roots, &symbols)
            .expect("a value")
            .remove(0)
    }

    fn first(&self, by: &str, h: &Precise) -> Precise {
        let back = Precise::exactly(0.0).minus(h);
        let rise = self.at(&[(by, h)]).minus(&self.at(&[(by, &back)]));
        rise.divide(&h.add(h))
    }

    fn second(&self, by: [&str; 2], h: &Precise) -> Precise {
        let back = Precise::exactly(0.0).minus(h);
        let corner =
            |first: &Precise, second: &Precise| self.at(&[(by[0], first), (by[1], second)]);
        let rise = corner(h, h)
            .add(&corner(&back, &back))
            .minus(&corner(h, &back))
            .minus(&corner(&back, h));
        rise.divide(&h.add(h).multiply(&h.add(h)))
    }
}

fn assert_close(value: &Precise, expected: &Precise, tolerance: &str, what: &str) {
    let apart = value.minus(expected).size();
    let allowed = expected.size().multiply(&Precise::decimal(tolerance));
    assert!(
        apart.is_at_most(&allowed),
        "{what}: {} beside {}",
        value.0,
        expected.0
    );
}

/// Checks the graphs of a formula's derivatives, and gives the numbers that compiled code must give: the value, the
/// first partials, the upper triangle of the second.
fn checked(name: &str, form: Form, by: &[&str], c: Coefficients) -> Vec<Precise> {
    let mut system = formulas();
    let expansion = system.of(name).expect("a formula of that name");
    expansion.read_only(name);
    let formula = expansion.formula(name).expect("a formula without mistakes");
    let mut symbols: Vec<SymbolId> = by
        .iter()
        .filter_map(|name| formula.graph.find_symbol(name))
        .collect();
    if symbols.is_empty() {
        symbols = formula
            .graph
            .symbols_of(&formula.roots)
            .into_iter()
            .collect();
    }
    let (graph, outputs) = derive(formula, form, &symbols);
    let inputs: Vec<Precise> = graph
        .symbols()
        .map(|(_, symbol)| Precise::exactly(input(&symbol.name, &c)))
        .collect();
    let values = evaluate(&graph, &outputs.all(), &inputs).expect("values of the graph");

    let written = AsWritten { expansion, name, c };
    let h = Precise::decimal(STEP);
    let names: Vec<&str> = symbols
        .iter()
        .map(|symbol| graph.symbol(*symbol).name.as_str())
        .collect();
    let mut expected = vec![written.at(&[])];
    expected.extend(names.iter().map(|by| written.first(by, &h)));
    if form == Form::Hessian {
        for (row, first) in names.iter().enumerate() {
            expected.extend(
                names[row..]
                    .iter()
                    .map(|second| written.second([first, second], &h)),
            );
        }
    }
    assert_eq!(values.len(), expected.len());
    for (position, (value, expected)) in values.iter().zip(&expected).enumerate() {
        assert_close(
            value,
            expected,
            "1e-25",
            &format!("output {position} of {name} by {names:?}"),
        );
    }
    values
}

/// Compiled code gives the precise numbers to 12 digits.
fn assert_compiled(compiled: &[f64], precise: &[Precise], name: &str) {
    assert_eq!(compiled.len(), precise.len());
    for (position, (compiled, precise)) in compiled.iter().zip(precise).enumerate() {
        let what = format!(
            "output {position} of the code of {name}, {compiled:e} beside {:e}",
            precise.approximately()
        );
        assert_close(&Precise::exactly(*compiled), precise, "1e-12", &what);
    }
}

#[test]
fn the_whirl_equation_and_its_derivatives() {
    for c in coefficients() {
        let precise = checked("f_n", Form::Hessian, &["omega", "speed"], c);
        let (value, [a, b], [[aa, ab], [ba, bb]]) = equations::f_n::hessian(OMEGA, SPEED, &c);
        assert_compiled(&[value, a, b, aa, ab, bb], &precise, "f_n::hessian");
        assert_eq!(ab.to_bits(), ba.to_bits());
        let (value, [a, b]) = equations::f_n::gradient(OMEGA, SPEED, &c);
        assert_compiled(&[value, a, b], &precise[..3], "f_n::gradient");
    }
}

#[test]
fn the_frequency_equation_and_its_derivatives() {
    for c in coefficients() {
        let precise = checked("phi", Form::Hessian, &["omega", "speed"], c);
        let (value, [a, b], [[aa, ab], [ba, bb]]) = equations::phi::hessian(OMEGA, SPEED, &c);
        assert_compiled(&[value, a, b, aa, ab, bb], &precise, "phi::hessian");
        assert_eq!(ab.to_bits(), ba.to_bits());
        let (value, [a, b]) = equations::phi::gradient(OMEGA, SPEED, &c);
        assert_compiled(&[value, a, b], &precise[..3], "phi::gradient");
    }
}

#[test]
fn the_widths_and_their_gradients() {
    for c in coefficients() {
        let precise = checked("sir_width", Form::Gradient, &[], c);
        let (value, gradient) = equations::sir_width::gradient(&c);
        assert_compiled(
            &[&[value][..], &gradient].concat(),
            &precise,
            "sir_width::gradient",
        );
        let precise = checked("cir_width", Form::Gradient, &[], c);
        let (value, gradient) = equations::cir_width::gradient(&c);
        assert_compiled(
            &[&[value][..], &gradient].concat(),
            &precise,
            "cir_width::gradient",
        );
    }
}
