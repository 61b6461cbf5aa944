//! From the inputs of the points of a block to the coefficients of their rotors, equation by equation in packs.
//!
//! Each equation is a stage. Its numbers are computed anew only where an input on which they depend is another one than in
//! the row before, and once only where they are the same at all points. What an axis alone decides, as the crack's compliance
//! along its depth, is therefore computed once for each of its values, and what the other inputs alone decide once a row.

mod equations;

use crate::equations::both_widths::along_beta_and_gamma_and_delta_and_epsilon_1_and_epsilon_12_and_epsilon_2 as regions;
use crate::equations::widths::along_c11_and_c22_and_c33_and_c44 as crack;
use crate::input::{INPUTS, NumericInput, RotorParameters};

use super::list::{List, Test};
use super::stage::{DEPENDS, Inputs, Stage, inputs};

/// Of which points the numbers of a stage are what they are for that rotor alone.
#[derive(Clone, Debug, Default)]
struct Trust {
    points: Vec<bool>,
    all: bool,
}

impl Trust {
    /// All so many of them.
    fn renew(&mut self, points: usize) {
        self.points.clear();
        self.points.resize(points, true);
        self.all = true;
    }

    /// Only those whose numbers pass a test.
    fn require(&mut self, list: &List, test: &Test) {
        self.all &= list.require(&mut self.points, test);
    }
}

/// The stages of a block, or of a row where no coefficient varies along it.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    points: usize,
    varied: Inputs,
    depends: [Inputs; Stage::ALL.len()],
    stale: [bool; Stage::ALL.len()],
    /// The last row.
    row: Option<RotorParameters>,
    /// In the order of [`INPUTS`].
    inputs: [List; 12],
    edge_factor: List,
    /// In the order of [`SectionLoads`](crate::equations::SectionLoads).
    loads: [List; 4],
    /// In the order of [`CrackCompliance`](crate::equations::CrackCompliance).
    compliance: [List; 4],
    /// In the order of [`Stiffness`](crate::equations::Stiffness).
    stiffness: [List; 6],
    /// The first of [`Coefficients`](crate::equations::Coefficients); the others are inputs.
    coefficients: [List; 6],
    /// What both widths take from the compliance, and what from the coefficients.
    crack: [List; crack::TABLES],
    regions: [List; regions::TABLES],
    trust: [Trust; 3],
}

impl Chain {
    /// Of so many points at which these inputs vary, in columns; where there are none, nothing may depend on what varies.
    pub(super) fn new(
        points: usize,
        varied: &[&'static NumericInput],
        columns: Option<&[&[f64]]>,
    ) -> Self {
        let names: Vec<_> = varied.iter().map(|input| input.name).collect();
        let column = |place: usize| {
            let position = varied.iter().position(|input| *input == &INPUTS[place])?;
            Some(List::of(columns?.get(position)?.to_vec()))
        };
        Self {
            points,
            varied: inputs(&names),
            depends: *DEPENDS,
            stale: [true; Stage::ALL.len()],
            row: None,
            inputs: std::array::from_fn(|place| column(place).unwrap_or_default()),
            edge_factor: List::default(),
            loads: Default::default(),
            compliance: Default::default(),
            stiffness: Default::default(),
            coefficients: Default::default(),
            crack: Default::default(),
            regions: Default::default(),
            trust: Default::default(),
        }
    }

    /// Takes the inputs of another row.
    pub(super) fn update(&mut self, row: &RotorParameters) {
        if self.row.as_ref() == Some(row) {
            return;
        }
        let mut changed = 0;
        for (place, (input, list)) in INPUTS.iter().zip(&mut self.inputs).enumerate() {
            let is_fixed = self.varied >> place & 1 == 0;
            if is_fixed && list.set((input.get)(row)) {
                changed |= 1 << place;
            }
        }
        let same_model = self
            .row
            .is_some_and(|last| last.crack_model == row.crack_model);
        if self.edge_factor.set(row.crack_edge.factor()) || !same_model {
            changed = Inputs::MAX;
        }
        for (stale, depends) in self.stale.iter_mut().zip(self.depends) {
            *stale |= depends & changed != 0;
        }
        self.row = Some(*row);
    }

    /// Whether a stage has the same numbers at all points.
    fn is_same(&self, stage: Stage) -> bool {
        self.depends[stage as usize] & self.varied == 0
    }

    /// Whether the coefficients are the same at all points, but for the asymmetry and the angle.
    pub(super) fn coefficients_are_same(&self) -> bool {
        self.is_same(Stage::Coefficients)
    }

    /// Does what is to be done for a stage, if it is to be done anew: for the rotor of a row where all points have the same
    /// numbers, for so many points otherwise.
    fn renew(
        &mut self,
        stage: Stage,
        alone: impl FnOnce(&mut Self, &RotorParameters),
        along: impl FnOnce(&mut Self, usize) -> Option<()>,
    ) -> Option<()> {
        if self.stale[stage as usize] {
            if self.is_same(stage) {
                let row = self.row?;
                alone(self, &row);
            } else {
                along(self, self.points)?;
            }
            self.stale[stage as usize] = false;
        }
        Some(())
    }

    /// Whether all points are rotors whose numbers are what they are for that rotor alone, as far as they are needed. Otherwise
    /// the others are marked false. None where that cannot be said.
    pub(super) fn trust(&mut self, needs: Needs, points: &mut [bool]) -> Option<bool> {
        self.trust_inertia(needs.combination)?;
        if needs.stiffness {
            self.stiffness()?;
        }
        if needs.coefficients {
            self.coefficients()?;
        }
        let [inertia, stiffness, coefficients] = &self.trust;
        let mut all = true;
        for (trust, is_needed) in [
            (inertia, true),
            (stiffness, needs.stiffness),
            (coefficients, needs.coefficients),
        ] {
            if !is_needed || trust.all {
                continue;
            }
            all = false;
            match trust.points[..] {
                [_] => points.fill(false),
                _ => points
                    .iter_mut()
                    .zip(&trust.points)
                    .for_each(|(point, trust)| *point &= trust),
            }
        }
        Some(all)
    }

    fn trust_inertia(&mut self, combination: bool) -> Option<()> {
        let check = |chain: &mut Self, points| {
            let [_, diametral, polar, ..] = &mut chain.inputs;
            let [trust, ..] = &mut chain.trust;
            trust.renew(points);
            let ratios = polar.spread(points).iter().zip(diametral.spread(points));
            for (point, (polar, diametral)) in trust.points.iter_mut().zip(ratios) {
                let most = 2.0 * diametral;
                *point = polar < &most || !combination && polar == &most;
                trust.all &= *point;
            }
        };
        let along = |chain: &mut Self, points| {
            check(chain, points);
            Some(())
        };
        self.renew(Stage::Inertia, |chain, _| check(chain, 1), along)
    }
}

/// What quantities need of the chain.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Needs {
    pub(super) stiffness: bool,
    pub(super) coefficients: bool,
    /// A combination region, for which $\beta < 2$.
    pub(super) combination: bool,
    /// Something that is found by iteration, which takes no other points than those that are to be trusted.
    pub(super) iteration: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Which stages a row would compute anew.
    fn stale(chain: &Chain) -> Vec<Stage> {
        let stages = Stage::ALL.into_iter().zip(chain.stale);
        stages
            .filter_map(|(stage, stale)| stale.then_some(stage))
            .collect()
    }

    #[test]
    fn the_compliance_along_the_depth_is_computed_once_for_all_rows() {
        use Stage::{Coefficients, Compliance, Crack, Inertia, Loads, Regions, Stiffness};
        let depth = NumericInput::find("crack_depth_ratio").unwrap();
        let depths = [0.1, 0.2, 0.3];
        let mut chain = Chain::new(depths.len(), &[depth], Some(&[&depths]));
        let mut row = RotorParameters::PAPER;
        let needs = Needs {
            stiffness: true,
            coefficients: true,
            combination: true,
            iteration: false,
        };
        let mut renewed = |change: fn(&mut RotorParameters)| {
            change(&mut row);
            chain.update(&row);
            let found = stale(&chain);
            assert_eq!(chain.trust(needs, &mut []), Some(true));
            assert!(chain.crack().is_some() && chain.regions().is_some());
            assert_eq!(stale(&chain), []);
            found
        };
        assert_eq!(renewed(|_| {}), Stage::ALL);
        assert_eq!(renewed(|row| row.crack_angle = 0.4), []);
        assert_eq!(renewed(|row| row.disk_asymmetry = 0.1), []);
        assert_eq!(renewed(|row| row.disk_mass = 9.0), [Coefficients, Regions]);
        let of_loads = [Loads, Stiffness, Coefficients, Regions];
        assert_eq!(renewed(|row| row.crack_position_ratio = 0.4), of_loads);
        let of_crack = [Compliance, Crack, Stiffness, Coefficients, Regions];
        assert_eq!(renewed(|row| row.shaft_radius = 0.01), of_crack);
        let of_inertia = [Inertia, Coefficients, Regions];
        assert_eq!(renewed(|row| row.disk_polar_inertia = 0.2), of_inertia);
        // It varies along the axis.
        assert_eq!(renewed(|row| row.crack_depth_ratio = 0.4), []);
    }
}
