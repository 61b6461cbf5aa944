//! From the inputs of the points of a block to the coefficients of their rotors, equation by equation in packs.
//!
//! Each equation is a stage. Its numbers are computed anew only where an input on which they depend is another one than in
//! the row before, and once only where they are the same at all points. What an axis alone decides, as the crack's compliance
//! along its depth, is therefore computed once for each of its values, and what the other inputs alone decide once a row.

use std::sync::LazyLock;

use lanes::{ALL, Level, store};

use crate::equations::both_widths::along_beta_and_gamma_and_delta_and_epsilon_1_and_epsilon_12_and_epsilon_2 as regions;
use crate::equations::widths::along_c11_and_c22_and_c33_and_c44 as crack;
use crate::equations::{
    CrackCompliance, SectionLoads, Stiffness, coefficients, crack_compliance, midspan_arm,
    simply_supported_left, simply_supported_right, stiffness, support_arm,
};
use crate::rotor::{CrackModel, INPUTS, LoadCase, NumericInput, RotorParameters};

use super::list::{FINITE, List, NONZERO, SIZES, Test, columns, set, written};

/// A set of inputs, bit 0 for the first of [`INPUTS`].
pub(super) type Inputs = u16;

/// The inputs that the loads at the crack's section depend on.
const PLACES: [&str; 3] = [
    "disk_position_ratio",
    "shaft_length",
    "crack_position_ratio",
];

/// Those that the crack's compliance depends on.
const CRACK: [&str; 4] = [
    "shaft_radius",
    "shaft_youngs_modulus",
    "shaft_poissons_ratio",
    "crack_depth_ratio",
];

/// Those that leave the stiffness as it is.
pub(super) const INERTIA: [&str; 3] = ["disk_mass", "disk_diametral_inertia", "disk_polar_inertia"];

/// The inputs of these names.
pub(super) fn inputs(names: &[&str]) -> Inputs {
    let places = (0..INPUTS.len()).filter(|place| names.contains(&INPUTS[*place].name));
    places.fold(0, |set, place| set | 1 << place)
}

/// The inputs that change the crack's compliance and nothing else.
pub(super) fn inputs_of_compliance_alone() -> Inputs {
    inputs(&["shaft_poissons_ratio", "crack_depth_ratio"])
}

/// The inputs that the coefficients depend on, but for the two that are coefficients themselves.
pub(super) fn inputs_of_coefficients() -> Inputs {
    DEPENDS[Stage::Coefficients as usize]
}

/// What each stage depends on: found once, for there may be many small tables.
static DEPENDS: LazyLock<[Inputs; Stage::ALL.len()]> =
    LazyLock::new(|| Stage::ALL.map(Stage::inputs));

/// What is computed together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    Loads,
    Compliance,
    Inertia,
    Crack,
    Stiffness,
    Coefficients,
    Regions,
}

impl Stage {
    const ALL: [Self; 7] = [
        Self::Loads,
        Self::Compliance,
        Self::Inertia,
        Self::Crack,
        Self::Stiffness,
        Self::Coefficients,
        Self::Regions,
    ];

    /// The inputs that it depends on.
    fn inputs(self) -> Inputs {
        let of_stiffness = inputs(&PLACES) | inputs(&CRACK);
        match self {
            Self::Loads => inputs(&PLACES),
            Self::Compliance | Self::Crack => inputs(&CRACK),
            Self::Inertia => inputs(&INERTIA),
            Self::Stiffness => of_stiffness,
            Self::Coefficients | Self::Regions => of_stiffness | inputs(&INERTIA),
        }
    }
}

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
    rows: usize,
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
    /// In the order of [`Coefficients`](crate::equations::Coefficients).
    coefficients: [List; 8],
    /// What both widths take from the compliance, and what from the coefficients.
    crack: [List; crack::TABLES],
    regions: [List; regions::TABLES],
    trust: [Trust; 3],
}

impl Chain {
    /// Of so many points at which these inputs vary, in columns; where there are none, nothing may depend on what varies.
    pub(super) fn new(
        rows: usize,
        varied: &[&'static NumericInput],
        columns: Option<&[&[f64]]>,
    ) -> Self {
        let names: Vec<_> = varied.iter().map(|input| input.name).collect();
        let column = |place: usize| {
            let position = varied.iter().position(|input| *input == &INPUTS[place])?;
            Some(List::of(columns?.get(position)?.to_vec()))
        };
        Self {
            rows,
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
                along(self, self.rows)?;
            }
            self.stale[stage as usize] = false;
        }
        Some(())
    }

    /// The compliance of the crack.
    pub(super) fn compliance(&mut self) -> Option<&mut [List; 4]> {
        let alone = |chain: &mut Self, row: &RotorParameters| {
            let c = crack_compliance::value(row, row.crack_edge.factor());
            set(&mut chain.compliance, [c.c11, c.c22, c.c33, c.c44]);
        };
        self.renew(Stage::Compliance, alone, |chain, rows| {
            let [_, _, _, _, _, _, inputs @ .., _, _] = &mut chain.inputs;
            let [radius, modulus, poisson, depth] = columns(inputs, rows);
            let inputs = crack_compliance::Columns {
                p_shaft_radius: radius,
                p_shaft_youngs_modulus: modulus,
                p_shaft_poissons_ratio: poisson,
                p_crack_depth_ratio: depth,
                edge_factor: chain.edge_factor.spread(rows),
            };
            crack_compliance::columns(&inputs, written(&mut chain.compliance, rows)).ok()
        })?;
        Some(&mut self.compliance)
    }

    /// The loads at the crack's section.
    fn loads(&mut self) -> Option<()> {
        let alone = |chain: &mut Self, row: &RotorParameters| {
            let s = LoadCase::of(row).loads(row);
            let numbers = [
                s.moment_of_force,
                s.shear_of_force,
                s.moment_of_couple,
                s.shear_of_couple,
            ];
            set(&mut chain.loads, numbers);
        };
        self.renew(Stage::Loads, alone, |chain, rows| {
            let [_, _, _, _, disk, length, _, _, _, _, crack, _] = &mut chain.inputs;
            let [disk, length, crack] = [disk, length, crack].map(|list| list.spread(rows));
            // Each formula takes the inputs that it has.
            macro_rules! loads {
                ($formula:ident, $lists:expr $(, $field:ident: $list:ident)*) => {
                    $formula::columns(&$formula::Columns { $($field: $list),* }, written($lists, rows))
                        .ok()?
                };
            }
            let lists = &mut chain.loads;
            match chain.row?.crack_model {
                CrackModel::SupportArm => loads!(
                    support_arm, lists, p_crack_position_ratio: crack, p_shaft_length: length
                ),
                CrackModel::MidspanArm => loads!(
                    midspan_arm, lists, p_crack_position_ratio: crack, p_shaft_length: length
                ),
                CrackModel::SimplySupported => {
                    loads!(
                        simply_supported_right, lists, p_disk_position_ratio: disk,
                        p_crack_position_ratio: crack, p_shaft_length: length
                    );
                    let mut left: [List; 4] = Default::default();
                    loads!(
                        simply_supported_left, &mut left, p_disk_position_ratio: disk,
                        p_crack_position_ratio: crack, p_shaft_length: length
                    );
                    for (list, left) in lists.iter_mut().zip(&left) {
                        list.replace(left, |point| crack[point] < disk[point]);
                    }
                }
            }
            Some(())
        })
    }

    /// The stiffness of the cracked shaft.
    fn stiffness(&mut self) -> Option<()> {
        self.compliance()?;
        self.loads()?;
        let alone = |chain: &mut Self, row: &RotorParameters| {
            let (loads, compliance) = chain.crack_of_all();
            let k = stiffness::value(row, &loads, &compliance);
            let numbers = [
                k.k_tt,
                k.k_tm,
                k.k_mm,
                k.delta_k_tt,
                k.delta_k_tm,
                k.delta_k_mm,
            ];
            set(&mut chain.stiffness, numbers);
            chain.check_stiffness(1);
        };
        self.renew(Stage::Stiffness, alone, |chain, rows| {
            let [_, _, _, _, inputs @ .., _, _, _, _] = &mut chain.inputs;
            let [disk, length, radius, modulus] = columns(inputs, rows);
            let [
                moment_of_force,
                shear_of_force,
                moment_of_couple,
                shear_of_couple,
            ] = columns(&mut chain.loads, rows);
            let [c11, c22, c33, c44] = columns(&mut chain.compliance, rows);
            let inputs = stiffness::Columns {
                p_disk_position_ratio: disk,
                p_shaft_length: length,
                p_shaft_radius: radius,
                p_shaft_youngs_modulus: modulus,
                s_moment_of_force: moment_of_force,
                s_shear_of_force: shear_of_force,
                s_moment_of_couple: moment_of_couple,
                s_shear_of_couple: shear_of_couple,
                c_c11: c11,
                c_c22: c22,
                c_c33: c33,
                c_c44: c44,
            };
            stiffness::columns(&inputs, written(&mut chain.stiffness, rows)).ok()?;
            chain.check_stiffness(rows);
            Some(())
        })
    }

    /// The loads and the compliance, where they are the same at all points.
    fn crack_of_all(&self) -> (SectionLoads, CrackCompliance) {
        let [
            moment_of_force,
            shear_of_force,
            moment_of_couple,
            shear_of_couple,
        ] = self.loads.each_ref().map(List::number);
        let [c11, c22, c33, c44] = self.compliance.each_ref().map(List::number);
        let loads = SectionLoads {
            moment_of_force,
            shear_of_force,
            moment_of_couple,
            shear_of_couple,
        };
        (loads, CrackCompliance { c11, c22, c33, c44 })
    }

    fn check_stiffness(&mut self, rows: usize) {
        let [_, trust, _] = &mut self.trust;
        trust.renew(rows);
        let [k_tt, k_tm, k_mm, delta_k_tt, delta_k_tm, delta_k_mm] = &self.stiffness;
        for list in [k_tt, k_mm] {
            trust.require(list, &SIZES);
        }
        for list in [k_tm, delta_k_tt, delta_k_tm, delta_k_mm] {
            trust.require(list, &FINITE);
        }
    }

    /// The coefficients; the asymmetry and the angle among them may be those of an earlier row.
    pub(super) fn coefficients(&mut self) -> Option<&mut [List; 8]> {
        self.stiffness()?;
        let alone = |chain: &mut Self, row: &RotorParameters| {
            let [k_tt, k_tm, k_mm, delta_k_tt, delta_k_tm, delta_k_mm] =
                chain.stiffness.each_ref().map(List::number);
            let k = Stiffness {
                k_tt,
                k_tm,
                k_mm,
                delta_k_tt,
                delta_k_tm,
                delta_k_mm,
            };
            let c = coefficients::value(row, &k);
            let numbers = [
                c.beta,
                c.gamma,
                c.delta,
                c.epsilon_1,
                c.epsilon_12,
                c.epsilon_2,
                c.disk_asymmetry,
                c.crack_angle,
            ];
            set(&mut chain.coefficients, numbers);
            chain.check_coefficients(1);
        };
        self.renew(Stage::Coefficients, alone, |chain, rows| {
            let [inputs @ .., _, _, _, _, _, _, _, angle] = &mut chain.inputs;
            let [mass, diametral, polar, asymmetry] = columns(inputs, rows);
            let [k_tt, k_tm, k_mm, delta_k_tt, delta_k_tm, delta_k_mm] =
                columns(&mut chain.stiffness, rows);
            let inputs = coefficients::Columns {
                p_disk_mass: mass,
                p_disk_diametral_inertia: diametral,
                p_disk_polar_inertia: polar,
                p_disk_asymmetry: asymmetry,
                p_crack_angle: angle.spread(rows),
                k_k_tt: k_tt,
                k_k_tm: k_tm,
                k_k_mm: k_mm,
                k_delta_k_tt: delta_k_tt,
                k_delta_k_tm: delta_k_tm,
                k_delta_k_mm: delta_k_mm,
            };
            coefficients::columns(&inputs, written(&mut chain.coefficients, rows)).ok()?;
            chain.check_coefficients(rows);
            Some(())
        })?;
        Some(&mut self.coefficients)
    }

    fn check_coefficients(&mut self, rows: usize) {
        let [.., trust] = &mut self.trust;
        trust.renew(rows);
        let [_, gamma, delta, epsilons @ .., _, _] = &self.coefficients;
        // Without coupling some are limits.
        trust.require(gamma, &NONZERO);
        trust.require(delta, &SIZES);
        for list in epsilons {
            trust.require(list, &FINITE);
        }
    }

    /// What both widths take from the compliance at each point, and from all other inputs, where the compliance alone varies.
    pub(super) fn crack(&mut self) -> Option<([f64; crack::FIXED], &mut [List; crack::TABLES])> {
        self.compliance()?;
        self.loads()?;
        self.renew(Stage::Crack, not_along, |chain, rows| {
            let inner = columns(&mut chain.compliance, rows);
            let tables = written(&mut chain.crack, rows);
            store::<crack::Along, ALL, 0, 4, { crack::TABLES }>(Level::best(), &[], inner, tables)
                .ok()
        })?;
        let (loads, compliance) = self.crack_of_all();
        let fixed = crack::fixed(self.row.as_ref()?, &loads, &compliance);
        Some((fixed, &mut self.crack))
    }

    /// What both widths take from the coefficients at each point, where these vary, but for the asymmetry and the angle.
    pub(super) fn regions(&mut self) -> Option<&mut [List; regions::TABLES]> {
        self.coefficients()?;
        self.renew(Stage::Regions, not_along, |chain, rows| {
            let [coefficients @ .., _, _] = &mut chain.coefficients;
            let inner = columns(coefficients, rows);
            let tables = written(&mut chain.regions, rows);
            store::<regions::Along, ALL, 0, 6, { regions::TABLES }>(
                Level::best(),
                &[],
                inner,
                tables,
            )
            .ok()
        })?;
        Some(&mut self.regions)
    }

    /// The disk's mass and the shaft's stiffness there.
    pub(super) fn mass_and_stiffness(&mut self) -> Option<[&mut List; 2]> {
        self.stiffness()?;
        let ([mass, ..], [k_tt, ..]) = (&mut self.inputs, &mut self.stiffness);
        Some([mass, k_tt])
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
        let check = |chain: &mut Self, rows| {
            let [_, diametral, polar, ..] = &mut chain.inputs;
            let [trust, ..] = &mut chain.trust;
            trust.renew(rows);
            let ratios = polar.spread(rows).iter().zip(diametral.spread(rows));
            for (point, (polar, diametral)) in trust.points.iter_mut().zip(ratios) {
                let most = 2.0 * diametral;
                *point = polar < &most || !combination && polar == &most;
                trust.all &= *point;
            }
        };
        let along = |chain: &mut Self, rows| {
            check(chain, rows);
            Some(())
        };
        self.renew(Stage::Inertia, |chain, _| check(chain, 1), along)
    }
}

/// What is asked of a stage that there is only along an axis.
fn not_along(_: &mut Chain, _: &RotorParameters) {}

/// What quantities need of the chain.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Needs {
    pub(super) stiffness: bool,
    pub(super) coefficients: bool,
    /// A combination region, for which $\beta < 2$.
    pub(super) combination: bool,
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
        assert_eq!(
            renewed(|row| row.disk_mass = 9.0),
            [Inertia, Coefficients, Regions]
        );
        let of_loads = [Loads, Stiffness, Coefficients, Regions];
        assert_eq!(renewed(|row| row.crack_position_ratio = 0.4), of_loads);
        let of_crack = [Compliance, Crack, Stiffness, Coefficients, Regions];
        assert_eq!(renewed(|row| row.shaft_radius = 0.01), of_crack);
        // It varies along the axis.
        assert_eq!(renewed(|row| row.crack_depth_ratio = 0.4), []);
    }
}
