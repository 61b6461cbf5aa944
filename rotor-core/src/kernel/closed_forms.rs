//! Quantities of closed form at the points of a block, in packs.
//!
//! As for one rotor, each equation is evaluated once for all quantities that need it: compliance, stiffness, coefficients,
//! and from these the rest. The columns form of an equation is its scalar form in packs, so that a quantity has the digits
//! that [`quantity::evaluate`](crate::quantity::evaluate) gives.

use crate::equations::{
    cir_start, cir_width, cir_zup_asymmetry, coefficients, crack_compliance, reference_speed,
    sir_start, sir_width, sir_zup_asymmetry, stiffness,
};
use crate::extremes::is_size;
use crate::quantity::Quantity;
use crate::region::RegionKind;
use crate::rotor::{INPUTS, LoadCase, NumericInput, RotorParameters};

/// Rows that are computed together: what is between the inputs and the results stays in the cache.
const ROWS: usize = 1024;

/// The inputs that decide the loads at the crack's section.
const PLACES: [&str; 3] = [
    "disk_position_ratio",
    "shaft_length",
    "crack_position_ratio",
];

/// A list for each of some numbers, of the same length.
type Lists<const COUNT: usize> = [Vec<f64>; COUNT];

/// What is computed for one stretch of a block after the other.
#[derive(Debug)]
pub(super) struct ClosedForms {
    needs_compliance: bool,
    needs_stiffness: bool,
    needs_coefficients: bool,
    /// In the order of [`INPUTS`].
    inputs: Lists<12>,
    /// In the order of [`SectionLoads`](crate::equations::SectionLoads).
    loads: Lists<4>,
    edge_factor: Vec<f64>,
    /// In the order of [`CrackCompliance`](crate::equations::CrackCompliance).
    compliance: Lists<4>,
    /// In the order of [`Stiffness`](crate::equations::Stiffness).
    stiffness: Lists<6>,
    /// In the order of [`Coefficients`](crate::equations::Coefficients).
    coefficients: Lists<8>,
}

/// The points of a block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Points<'a> {
    /// The inputs of all points but for those that vary.
    pub(super) row: &'a RotorParameters,
    /// What varies.
    pub(super) varied: &'a [&'static NumericInput],
    /// Its values, one list for each input.
    pub(super) values: &'a [Vec<f64>],
}

/// Which equation a quantity comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Origin {
    /// A number of the compliance.
    Compliance(usize),
    /// The reference speed.
    ReferenceSpeed,
    /// A number of the coefficients.
    Coefficient(usize),
    /// A start, a width or a closing asymmetry.
    Region(RegionKind),
    /// None: it is found by iteration.
    Iteration,
}

fn origin(quantity: Quantity) -> Origin {
    match quantity {
        Quantity::C11 => Origin::Compliance(0),
        Quantity::C22 => Origin::Compliance(1),
        Quantity::C33 => Origin::Compliance(2),
        Quantity::C44 => Origin::Compliance(3),
        Quantity::ReferenceSpeed => Origin::ReferenceSpeed,
        Quantity::Beta => Origin::Coefficient(0),
        Quantity::Gamma => Origin::Coefficient(1),
        Quantity::Delta => Origin::Coefficient(2),
        Quantity::Epsilon1 => Origin::Coefficient(3),
        Quantity::Epsilon12 => Origin::Coefficient(4),
        Quantity::Epsilon2 => Origin::Coefficient(5),
        Quantity::SirStart | Quantity::SirWidth | Quantity::SirZupAsymmetry => {
            Origin::Region(RegionKind::Simple)
        }
        Quantity::CirStart | Quantity::CirWidth | Quantity::CirZupAsymmetry => {
            Origin::Region(RegionKind::Combination)
        }
        Quantity::SirExactLower
        | Quantity::SirExactUpper
        | Quantity::CirExactLower
        | Quantity::CirExactUpper
        | Quantity::GrowthRate => Origin::Iteration,
    }
}

/// Whether a quantity has a closed form.
pub(super) fn is_closed(quantity: Quantity) -> bool {
    origin(quantity) != Origin::Iteration
}

impl ClosedForms {
    /// For the closed forms among these quantities.
    pub(super) fn of(quantities: &[Quantity]) -> Self {
        let any = |wanted: fn(Origin) -> bool| quantities.iter().any(|q| wanted(origin(*q)));
        let needs_coefficients =
            any(|origin| matches!(origin, Origin::Coefficient(_) | Origin::Region(_)));
        Self {
            needs_compliance: any(|origin| matches!(origin, Origin::Compliance(_))),
            needs_stiffness: needs_coefficients || any(|origin| origin == Origin::ReferenceSpeed),
            needs_coefficients,
            inputs: Default::default(),
            loads: Default::default(),
            edge_factor: Vec::new(),
            compliance: Default::default(),
            stiffness: Default::default(),
            coefficients: Default::default(),
        }
    }

    /// Evaluates the closed forms at those points of which `trusted` says that their inputs are plain, and says there
    /// of which points the results are what they would be for that rotor alone.
    pub(super) fn evaluate(
        &mut self,
        points: Points<'_>,
        quantities: &[Quantity],
        results: &mut [&mut [f64]],
        trusted: &mut [bool],
    ) {
        for (number, trusted) in trusted.chunks_mut(ROWS).enumerate() {
            let from = number * ROWS;
            let to = from + trusted.len();
            self.take(points, from, to);
            if self.shared(trusted).is_none() {
                trusted.fill(false);
                continue;
            }
            for (quantity, result) in quantities.iter().zip(results.iter_mut()) {
                if self
                    .quantity(*quantity, &mut result[from..to], trusted)
                    .is_none()
                {
                    trusted.fill(false);
                }
            }
        }
    }

    /// Takes the inputs of a stretch and the loads that they mean.
    fn take(&mut self, points: Points<'_>, from: usize, to: usize) {
        let varied = |name: &str| points.varied.iter().position(|input| input.name == name);
        for (list, input) in self.inputs.iter_mut().zip(&INPUTS) {
            list.clear();
            match varied(input.name).and_then(|place| points.values.get(place)) {
                Some(values) => list.extend_from_slice(&values[from..to]),
                None => list.resize(to - from, (input.get)(points.row)),
            }
        }
        self.edge_factor.clear();
        self.edge_factor
            .resize(to - from, points.row.crack_edge.factor());
        if !self.needs_stiffness {
            return;
        }
        let moved: Vec<_> = PLACES
            .iter()
            .filter_map(|name| Some((points.varied[varied(name)?], varied(name)?)))
            .collect();
        let mut parameters = *points.row;
        for list in &mut self.loads {
            list.clear();
        }
        for point in from..to {
            for (input, place) in &moved {
                (input.set)(&mut parameters, points.values[*place][point]);
            }
            let s = LoadCase::of(&parameters).loads(&parameters);
            let loads = [
                s.moment_of_force,
                s.shear_of_force,
                s.moment_of_couple,
                s.shear_of_couple,
            ];
            if moved.is_empty() {
                for (list, load) in self.loads.iter_mut().zip(loads) {
                    list.resize(to - from, load);
                }
                return;
            }
            for (list, load) in self.loads.iter_mut().zip(loads) {
                list.push(load);
            }
        }
    }

    /// Evaluates what several quantities have in common. None where it cannot be done.
    fn shared(&mut self, trusted: &mut [bool]) -> Option<()> {
        let [_, diametral, polar, ..] = &self.inputs;
        for ((trusted, polar), diametral) in trusted.iter_mut().zip(polar).zip(diametral) {
            *trusted &= polar / diametral <= 2.0;
        }
        if self.needs_compliance {
            self.evaluate_compliance()?;
        }
        if self.needs_stiffness {
            self.evaluate_stiffness(trusted)?;
        }
        if self.needs_coefficients {
            self.evaluate_coefficients(trusted)?;
        }
        Some(())
    }

    fn evaluate_compliance(&mut self) -> Option<()> {
        let [.., radius, modulus, poisson, depth, _, _] = &self.inputs;
        let inputs = crack_compliance::Columns {
            p_shaft_radius: radius,
            p_shaft_youngs_modulus: modulus,
            p_shaft_poissons_ratio: poisson,
            p_crack_depth_ratio: depth,
            edge_factor: &self.edge_factor,
        };
        let rows = self.edge_factor.len();
        crack_compliance::columns(&inputs, sized(&mut self.compliance, rows)).ok()
    }

    fn evaluate_stiffness(&mut self, trusted: &mut [bool]) -> Option<()> {
        let [.., place, length, radius, modulus, poisson, depth, _, _] = &self.inputs;
        let [
            moment_of_force,
            shear_of_force,
            moment_of_couple,
            shear_of_couple,
        ] = &self.loads;
        let inputs = stiffness::Columns {
            p_disk_position_ratio: place,
            p_shaft_length: length,
            p_shaft_radius: radius,
            p_shaft_youngs_modulus: modulus,
            p_shaft_poissons_ratio: poisson,
            p_crack_depth_ratio: depth,
            s_moment_of_force: moment_of_force,
            s_shear_of_force: shear_of_force,
            s_moment_of_couple: moment_of_couple,
            s_shear_of_couple: shear_of_couple,
            edge_factor: &self.edge_factor,
        };
        let rows = self.edge_factor.len();
        stiffness::columns(&inputs, sized(&mut self.stiffness, rows)).ok()?;
        let [k_tt, _, k_mm, ..] = &self.stiffness;
        require(trusted, k_tt, is_size);
        require(trusted, k_mm, is_size);
        for list in &self.stiffness {
            require(trusted, list, f64::is_finite);
        }
        Some(())
    }

    fn evaluate_coefficients(&mut self, trusted: &mut [bool]) -> Option<()> {
        let [mass, diametral, polar, asymmetry, .., angle] = &self.inputs;
        let [k_tt, k_tm, k_mm, delta_k_tt, delta_k_tm, delta_k_mm] = &self.stiffness;
        let inputs = coefficients::Columns {
            p_disk_mass: mass,
            p_disk_diametral_inertia: diametral,
            p_disk_polar_inertia: polar,
            p_disk_asymmetry: asymmetry,
            p_crack_angle: angle,
            k_k_tt: k_tt,
            k_k_tm: k_tm,
            k_k_mm: k_mm,
            k_delta_k_tt: delta_k_tt,
            k_delta_k_tm: delta_k_tm,
            k_delta_k_mm: delta_k_mm,
        };
        let rows = self.edge_factor.len();
        coefficients::columns(&inputs, sized(&mut self.coefficients, rows)).ok()?;
        let [_, gamma, delta, epsilons @ ..] = &self.coefficients;
        // Without coupling some are limits.
        require(trusted, gamma, |gamma| is_size(gamma.abs()));
        require(trusted, delta, is_size);
        for list in epsilons {
            require(trusted, list, f64::is_finite);
        }
        Some(())
    }

    /// Evaluates a closed form. None where it cannot be done.
    fn quantity(&self, quantity: Quantity, result: &mut [f64], trusted: &mut [bool]) -> Option<()> {
        let mut is_positive = false;
        match origin(quantity) {
            Origin::Compliance(place) => result.copy_from_slice(&self.compliance[place]),
            Origin::Coefficient(place) => result.copy_from_slice(&self.coefficients[place]),
            Origin::ReferenceSpeed => {
                let (p_disk_mass, k_k_tt) = (&self.inputs[0], &self.stiffness[0]);
                let inputs = reference_speed::Columns {
                    p_disk_mass,
                    k_k_tt,
                };
                reference_speed::columns(&inputs, [&mut *result]).ok()?;
                is_positive = true;
            }
            Origin::Region(kind) => {
                if kind == RegionKind::Combination {
                    require(trusted, &self.coefficients[0], |beta| beta < 2.0);
                }
                self.of_region(quantity, result)?;
                is_positive = !matches!(
                    quantity,
                    Quantity::SirZupAsymmetry | Quantity::CirZupAsymmetry
                );
            }
            Origin::Iteration => return Some(()),
        }
        if is_positive {
            require(trusted, result, is_size);
        } else {
            require(trusted, result, f64::is_finite);
        }
        // A zero has no sign.
        for value in result {
            *value += 0.0;
        }
        Some(())
    }

    /// Evaluates what a region has in closed form. None where it cannot be done.
    fn of_region(&self, quantity: Quantity, result: &mut [f64]) -> Option<()> {
        let [
            beta,
            gamma,
            delta,
            epsilon_1,
            epsilon_12,
            epsilon_2,
            asymmetry,
            angle,
        ] = &self.coefficients;
        // The equations take the first three, six or all of the coefficients.
        macro_rules! equation {
            ($equation:ident $(, $field:ident: $list:ident)*) => {
                $equation::columns(
                    &$equation::Columns {
                        c_beta: beta,
                        c_gamma: gamma,
                        c_delta: delta,
                        $($field: $list),*
                    },
                    [result],
                )
                .ok()
            };
        }
        macro_rules! width {
            ($equation:ident) => {
                equation!(
                    $equation, c_epsilon_1: epsilon_1, c_epsilon_12: epsilon_12,
                    c_epsilon_2: epsilon_2, c_disk_asymmetry: asymmetry, c_crack_angle: angle
                )
            };
        }
        macro_rules! closing {
            ($equation:ident) => {
                equation!(
                    $equation, c_epsilon_1: epsilon_1, c_epsilon_12: epsilon_12,
                    c_epsilon_2: epsilon_2
                )
            };
        }
        match quantity {
            Quantity::SirStart => equation!(sir_start),
            Quantity::CirStart => equation!(cir_start),
            Quantity::SirWidth => width!(sir_width),
            Quantity::CirWidth => width!(cir_width),
            Quantity::SirZupAsymmetry => closing!(sir_zup_asymmetry),
            Quantity::CirZupAsymmetry => closing!(cir_zup_asymmetry),
            _ => Some(()),
        }
    }
}

/// The lists as slices of so many rows.
fn sized<const COUNT: usize>(lists: &mut Lists<COUNT>, rows: usize) -> [&mut [f64]; COUNT] {
    for list in &mut *lists {
        list.resize(rows, f64::NAN);
    }
    lists.each_mut().map(Vec::as_mut_slice)
}

/// Trusts only the points whose number is allowed.
fn require(trusted: &mut [bool], list: &[f64], allowed: impl Fn(f64) -> bool) {
    for (trusted, value) in trusted.iter_mut().zip(list) {
        *trusted &= allowed(*value);
    }
}
