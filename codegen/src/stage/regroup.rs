//! Sums and products gathered by what their parts depend on.
//!
//! `a·t·b·x` with `x` at the points becomes `(a·b)·t·x`: one multiplication less there. `k·(a·x + b·y)` becomes
//! `(k·a)·x + (k·b)·y` where `k`, `a` and `b` stand still. Nothing but factors that stand still is multiplied out.

use std::collections::BTreeSet;

use super::{Stage, split, stages};
use crate::circuit::{Circuit, Net, Operation};
use crate::graph::{Rational, SymbolId};

/// The circuit with its operations gathered.
pub fn by_stage(circuit: &Circuit, inner: &BTreeSet<SymbolId>) -> Circuit {
    let mut regrouping = Regrouping {
        old: circuit,
        stages: stages(circuit, inner),
        uses: circuit.uses(),
        new: Circuit::default(),
        images: Vec::new(),
    };
    for net in circuit.nets() {
        let (coefficient, image) = regrouping.image(net);
        let image = regrouping.new.sum([(image, coefficient)]);
        if let Some(name) = circuit.suggested_name(net) {
            regrouping.new.suggest_name(image, name);
        }
        regrouping.images.push(image);
    }
    let outputs = &circuit.outputs;
    regrouping.new.outputs = outputs
        .iter()
        .map(|output| regrouping.images[output.index()])
        .collect();
    regrouping.new
}

/// Operands with their powers, negative where they divide.
type Powers = Vec<(Net, i32)>;

/// Operands with what they are raised to.
type Raised = Vec<(Net, u32)>;

/// A product taken apart by what its factors depend on.
struct Factors {
    coefficient: Rational,
    fixed: Powers,
    along: Powers,
    at_points: Powers,
}

struct Regrouping<'c> {
    old: &'c Circuit,
    stages: Vec<Stage>,
    uses: Vec<usize>,
    new: Circuit,
    /// For each operation of the old circuit that was visited its image.
    images: Vec<Net>,
}

impl Regrouping<'_> {
    fn image(&mut self, net: Net) -> (Rational, Net) {
        let operation = self.old.operation(net);
        if self.stages[net.index()] != Stage::Point {
            return (Rational::ONE, self.copied(net));
        }
        match operation {
            Operation::Sum(terms) if terms.len() > 1 => {
                let terms = terms.clone();
                (Rational::ONE, self.sum(&terms, None))
            }
            Operation::Sum(_) | Operation::Product(_) | Operation::Quotient(..) => {
                let factors = self.factors(net);
                self.product(factors)
            }
            _ => (Rational::ONE, self.copied(net)),
        }
    }

    /// The operation as it is, on the images of its operands.
    fn copied(&mut self, net: Net) -> Net {
        let image = |operand: &Net| self.images[operand.index()];
        let operation = match self.old.operation(net) {
            Operation::Sum(terms) => {
                let terms = terms
                    .iter()
                    .map(|(operand, coefficient)| (image(operand), coefficient.clone()));
                let terms: Vec<_> = terms.collect();
                return self.new.sum(terms);
            }
            Operation::Product(factors) => {
                let factors = factors
                    .iter()
                    .map(|(operand, power)| (image(operand), *power));
                let factors: Vec<_> = factors.collect();
                return self.new.product(factors);
            }
            operation => split::on_images(operation, |net| self.images[net.index()]),
        };
        self.new.push(operation)
    }

    /// The factors of an operation at the points; products that only it uses are opened.
    fn factors(&self, net: Net) -> Factors {
        let mut factors = Factors {
            coefficient: Rational::ONE,
            fixed: Vec::new(),
            along: Vec::new(),
            at_points: Vec::new(),
        };
        self.gather(net, 1, true, &mut factors);
        factors
    }

    fn gather(&self, net: Net, power: i32, open: bool, factors: &mut Factors) {
        let open = open || self.uses[net.index()] == 1;
        let at_points = self.stages[net.index()] == Stage::Point;
        match self.old.operation(net) {
            // A division by zero stays one.
            Operation::Number(value) if power > 0 || !value.is_zero() => {
                factors.coefficient *= &value.pow(power);
            }
            Operation::Product(operands) if open && at_points => {
                for (operand, exponent) in operands {
                    let whole = i32::try_from(*exponent).unwrap_or(i32::MAX);
                    // A power of what is computed anyway is cheaper than its factors' powers.
                    let single = power.saturating_mul(whole).abs() == 1;
                    self.gather_operand(*operand, power.saturating_mul(whole), single, factors);
                }
            }
            Operation::Quotient(numerator, denominator) if open && at_points => {
                self.gather_operand(*numerator, power, power.abs() == 1, factors);
                self.gather_operand(*denominator, -power, power.abs() == 1, factors);
            }
            Operation::Sum(terms) if open && at_points && terms.len() == 1 => {
                factors.coefficient *= &terms[0].1.pow(power);
                self.gather_operand(terms[0].0, power, power.abs() == 1, factors);
            }
            _ => {
                let places = match self.stages[net.index()] {
                    Stage::Constant | Stage::Fixed => &mut factors.fixed,
                    Stage::Along => &mut factors.along,
                    Stage::Point => &mut factors.at_points,
                };
                places.push((net, power));
            }
        }
    }

    fn gather_operand(&self, net: Net, power: i32, single: bool, factors: &mut Factors) {
        if single || self.old.as_number(net).is_some() {
            self.gather(net, power, false, factors);
        } else {
            let places = match self.stages[net.index()] {
                Stage::Constant | Stage::Fixed => &mut factors.fixed,
                Stage::Along => &mut factors.along,
                Stage::Point => &mut factors.at_points,
            };
            places.push((net, power));
        }
    }

    /// The product of gathered factors, as a multiple of an operation.
    fn product(&mut self, factors: Factors) -> (Rational, Net) {
        if factors.fixed.is_empty() {
            return self.product_beside(None, factors);
        }
        let fixed = self.powers(&factors.fixed);
        let fixed = self.new.sum([(fixed, factors.coefficient.clone())]);
        if let Some(sum) = self.distributed(fixed, &factors) {
            return (Rational::ONE, sum);
        }
        let coefficient = Rational::ONE;
        self.product_beside(
            Some(fixed),
            Factors {
                coefficient,
                ..factors
            },
        )
    }

    /// The product of `fixed`, an operation of the new circuit, and of the factors that do not stand still.
    fn product_beside(&mut self, fixed: Option<Net>, factors: Factors) -> (Rational, Net) {
        let mut coefficient = factors.coefficient;
        let mut numerator: Vec<_> = fixed.map(|net| (net, 1)).into_iter().collect();
        if !factors.along.is_empty() {
            let along = self.powers(&factors.along);
            numerator.push((self.new.sum([(along, coefficient.abs())]), 1));
            coefficient = coefficient.signum();
        }
        let (positive, denominator) = self.both_signs(&factors.at_points);
        numerator.extend(positive);
        if denominator.is_empty() {
            return (coefficient, self.new.product(numerator));
        }
        let denominator = self.new.product(denominator);
        let numerator = if numerator.is_empty() {
            let magnitude = self.new.number(coefficient.abs());
            coefficient = coefficient.signum();
            magnitude
        } else {
            self.new.product(numerator)
        };
        let quotient = Operation::Quotient(numerator, denominator);
        (coefficient, self.new.push(quotient))
    }

    /// `k·(a·x + b·y)` as a sum, where `k` is `fixed` and every term has a part that stands still.
    fn distributed(&mut self, fixed: Net, factors: &Factors) -> Option<Net> {
        let &[(sum, 1)] = factors.at_points.as_slice() else {
            return None;
        };
        let Operation::Sum(terms) = self.old.operation(sum) else {
            return None;
        };
        let stands_still = |net: Net, coefficient: &Rational| {
            let stage = self.stages[net.index()];
            let own = self.uses[net.index()] == 1;
            stage.stands_still()
                || !coefficient.is_unit() && stage == Stage::Along
                || stage == Stage::Point && own && !self.factors(net).fixed.is_empty()
        };
        let all = terms
            .iter()
            .all(|(net, coefficient)| stands_still(*net, coefficient));
        let once = self.uses[sum.index()] == 1;
        if !(all && once && factors.along.is_empty() && terms.len() > 1) {
            return None;
        }
        let terms = terms.clone();
        Some(self.sum(&terms, Some(fixed)))
    }

    /// A sum, its terms multiplied by `scale` where there is one.
    fn sum(&mut self, terms: &[(Net, Rational)], scale: Option<Net>) -> Net {
        let (mut fixed, mut along, mut at_points) = (Vec::new(), Vec::new(), Vec::new());
        for (operand, coefficient) in terms {
            match self.stages[operand.index()] {
                Stage::Constant | Stage::Fixed => {
                    fixed.push((self.images[operand.index()], coefficient.clone()));
                }
                Stage::Along if scale.is_none() => {
                    along.push((self.images[operand.index()], coefficient.clone()));
                }
                Stage::Along => {
                    let image = self.images[operand.index()];
                    at_points.push(self.scaled_term(image, coefficient, scale));
                }
                Stage::Point => at_points.push(self.term(*operand, coefficient, scale)),
            }
        }
        if !fixed.is_empty() {
            let fixed = self.new.sum(fixed);
            at_points.push(match scale {
                Some(scale) => (self.new.product([(scale, 1), (fixed, 1)]), Rational::ONE),
                None => (fixed, Rational::ONE),
            });
        }
        if !along.is_empty() {
            at_points.push((self.new.sum(along), Rational::ONE));
        }
        self.new.sum(at_points)
    }

    fn scaled_term(
        &mut self,
        image: Net,
        coefficient: &Rational,
        scale: Option<Net>,
    ) -> (Net, Rational) {
        let Some(scale) = scale else {
            return (image, coefficient.clone());
        };
        let scale = self.new.sum([(scale, coefficient.abs())]);
        let product = self.new.product([(scale, 1), (image, 1)]);
        (product, coefficient.signum())
    }

    /// A term at the points: its coefficient and the sum's scale go to its part that stands still.
    fn term(
        &mut self,
        operand: Net,
        coefficient: &Rational,
        scale: Option<Net>,
    ) -> (Net, Rational) {
        let own = self.uses[operand.index()] == 1;
        let opened = own.then(|| self.factors(operand));
        let Some(mut factors) = opened.filter(|factors| !factors.fixed.is_empty()) else {
            let image = self.images[operand.index()];
            return self.scaled_term(image, coefficient, scale);
        };
        factors.coefficient *= &coefficient.abs();
        if let Some(scale) = scale {
            // The scale is an operation of the new circuit; it joins the image of the part that stands still.
            let fixed = self.powers(&factors.fixed);
            let fixed = self.new.sum([(fixed, factors.coefficient.clone())]);
            let fixed = self.new.product([(scale, 1), (fixed, 1)]);
            factors.coefficient = Rational::ONE;
            let (rest, product) = self.product_beside(Some(fixed), factors);
            return (product, rest * coefficient.signum());
        }
        let (rest, product) = self.product(factors);
        (product, rest * coefficient.signum())
    }

    /// The product of the images.
    fn powers(&mut self, powers: &Powers) -> Net {
        let (numerator, denominator) = self.both_signs(powers);
        let numerator = self.new.product(numerator);
        if denominator.is_empty() {
            return numerator;
        }
        let denominator = self.new.product(denominator);
        self.new.push(Operation::Quotient(numerator, denominator))
    }

    /// The images with positive powers, and those with negative ones.
    fn both_signs(&self, powers: &Powers) -> (Raised, Raised) {
        let image = |(net, power): (Net, i32)| (self.images[net.index()], power.unsigned_abs());
        let (positive, negative): (Powers, Powers) =
            powers.iter().partition(|(_, power)| *power > 0);
        (
            positive.into_iter().map(image).collect(),
            negative.into_iter().map(image).collect(),
        )
    }
}
