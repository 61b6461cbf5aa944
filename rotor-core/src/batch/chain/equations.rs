//! The stages of a chain: an equation each, for the rotor of a row or along its points.

use lanes::{ALL, Level, store};

use crate::equations::both_widths::along_beta_and_gamma_and_delta_and_epsilon_1_and_epsilon_12_and_epsilon_2 as regions;
use crate::equations::widths::along_c11_and_c22_and_c33_and_c44 as crack;
use crate::equations::{
    CrackCompliance, SectionLoads, Stiffness, coefficients, crack_compliance, midspan_arm,
    simply_supported_left, simply_supported_right, stiffness, support_arm,
};
use crate::input::{CrackModel, RotorParameters};
use crate::jeffcott::rotor::LoadCase;

use super::super::list::{FINITE, List, NONZERO, SIZES, columns, set, written};
use super::super::stage::Stage;
use super::Chain;

/// All of the coefficients but the last two.
const WANTED: u64 = 0b11_1111;

impl Chain {
    /// The compliance of the crack.
    pub(in super::super) fn compliance(&mut self) -> Option<&mut [List; 4]> {
        let alone = |chain: &mut Self, row: &RotorParameters| {
            let c = crack_compliance::value(row, row.crack_edge.factor());
            set(&mut chain.compliance, [c.c11, c.c22, c.c33, c.c44]);
        };
        self.renew(Stage::Compliance, alone, |chain, points| {
            let [_, _, _, _, _, _, inputs @ .., _, _] = &mut chain.inputs;
            let [radius, modulus, poisson, depth] = columns(inputs, points);
            let inputs = crack_compliance::Columns {
                p_shaft_radius: radius,
                p_shaft_youngs_modulus: modulus,
                p_shaft_poissons_ratio: poisson,
                p_crack_depth_ratio: depth,
                edge_factor: chain.edge_factor.spread(points),
            };
            crack_compliance::columns(&inputs, written(&mut chain.compliance, points)).ok()
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
        self.renew(Stage::Loads, alone, |chain, points| {
            let [_, _, _, _, disk, length, _, _, _, _, crack, _] = &mut chain.inputs;
            let [disk, length, crack] = [disk, length, crack].map(|list| list.spread(points));
            // Each formula takes the inputs that it has.
            macro_rules! loads {
                ($formula:ident, $lists:expr $(, $field:ident: $list:ident)*) => {
                    $formula::columns(&$formula::Columns { $($field: $list),* }, written($lists, points))
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
    pub(super) fn stiffness(&mut self) -> Option<()> {
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
        self.renew(Stage::Stiffness, alone, |chain, points| {
            let [_, _, _, _, inputs @ .., _, _, _, _] = &mut chain.inputs;
            let [disk, length, radius, modulus] = columns(inputs, points);
            let [
                moment_of_force,
                shear_of_force,
                moment_of_couple,
                shear_of_couple,
            ] = columns(&mut chain.loads, points);
            let [c11, c22, c33, c44] = columns(&mut chain.compliance, points);
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
            stiffness::columns(&inputs, written(&mut chain.stiffness, points)).ok()?;
            chain.check_stiffness(points);
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

    fn check_stiffness(&mut self, points: usize) {
        let [_, trust, _] = &mut self.trust;
        trust.renew(points);
        let [k_tt, k_tm, k_mm, delta_k_tt, delta_k_tm, delta_k_mm] = &self.stiffness;
        for list in [k_tt, k_mm] {
            trust.require(list, &SIZES);
        }
        for list in [k_tm, delta_k_tt, delta_k_tm, delta_k_mm] {
            trust.require(list, &FINITE);
        }
    }

    /// The coefficients but for the last two, which are inputs.
    pub(in super::super) fn coefficients(&mut self) -> Option<&mut [List; 6]> {
        self.stiffness()?;
        self.renew(
            Stage::Coefficients,
            Self::coefficients_of_all,
            |chain, points| {
                let [inputs @ .., _, _, _, _, _, _, _, _, _] = &mut chain.inputs;
                let [mass, diametral, polar] = columns(inputs, points);
                let [k_tt, k_tm, k_mm, delta_k_tt, delta_k_tm, delta_k_mm] =
                    columns(&mut chain.stiffness, points);
                let inputs = coefficients::Columns {
                    p_disk_mass: mass,
                    p_disk_diametral_inertia: diametral,
                    p_disk_polar_inertia: polar,
                    // They only stand for results that are not wanted.
                    p_disk_asymmetry: mass,
                    p_crack_angle: mass,
                    k_k_tt: k_tt,
                    k_k_tm: k_tm,
                    k_k_mm: k_mm,
                    k_delta_k_tt: delta_k_tt,
                    k_delta_k_tm: delta_k_tm,
                    k_delta_k_mm: delta_k_mm,
                };
                let [beta, gamma, delta, epsilon_1, epsilon_12, epsilon_2] =
                    written(&mut chain.coefficients, points);
                let results = [
                    beta,
                    gamma,
                    delta,
                    epsilon_1,
                    epsilon_12,
                    epsilon_2,
                    &mut [],
                    &mut [],
                ];
                store::<coefficients::Rows, WANTED, 0, 11, 8>(
                    Level::best(),
                    &[],
                    inputs.slices(),
                    results,
                )
                .ok()?;
                chain.check_coefficients(points);
                Some(())
            },
        )?;
        Some(&mut self.coefficients)
    }

    /// The coefficients, where they are the same at all points.
    fn coefficients_of_all(&mut self, row: &RotorParameters) {
        let [k_tt, k_tm, k_mm, delta_k_tt, delta_k_tm, delta_k_mm] =
            self.stiffness.each_ref().map(List::number);
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
        ];
        set(&mut self.coefficients, numbers);
        self.check_coefficients(1);
    }

    fn check_coefficients(&mut self, points: usize) {
        let [.., trust] = &mut self.trust;
        trust.renew(points);
        let [_, gamma, delta, epsilons @ ..] = &self.coefficients;
        // Without coupling some are limits.
        trust.require(gamma, &NONZERO);
        trust.require(delta, &SIZES);
        for list in epsilons {
            trust.require(list, &FINITE);
        }
    }

    /// What both widths take from the compliance at each point, and from all other inputs, where the compliance alone varies.
    pub(in super::super) fn crack(
        &mut self,
    ) -> Option<([f64; crack::FIXED], &mut [List; crack::TABLES])> {
        self.compliance()?;
        self.loads()?;
        self.renew(Stage::Crack, not_along, |chain, points| {
            let inner = columns(&mut chain.compliance, points);
            let tables = written(&mut chain.crack, points);
            store::<crack::Along, ALL, 0, 4, { crack::TABLES }>(Level::best(), &[], inner, tables)
                .ok()
        })?;
        let (loads, compliance) = self.crack_of_all();
        let fixed = crack::fixed(self.row.as_ref()?, &loads, &compliance);
        Some((fixed, &mut self.crack))
    }

    /// What both widths take from the coefficients at each point, where these vary, but for the asymmetry and the angle.
    pub(in super::super) fn regions(&mut self) -> Option<&mut [List; regions::TABLES]> {
        self.coefficients()?;
        self.renew(Stage::Regions, not_along, |chain, points| {
            let inner = columns(&mut chain.coefficients, points);
            let tables = written(&mut chain.regions, points);
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
    pub(in super::super) fn mass_and_stiffness(&mut self) -> Option<[&mut List; 2]> {
        self.stiffness()?;
        let ([mass, ..], [k_tt, ..]) = (&mut self.inputs, &mut self.stiffness);
        Some([mass, k_tt])
    }
}

/// What is asked of a stage that there is only along an axis.
fn not_along(_: &mut Chain, _: &RotorParameters) {}
