//! Everything that a report states about one rotor, computed once.

use rotor_core::equations::{Coefficients, CrackCompliance};
use rotor_core::jeffcott::exact::{self, Ends};
use rotor_core::jeffcott::region::{self, RegionKind};
use rotor_core::model::{Model, confirm_ends};
use rotor_core::periodic::boundary::{self, Boundary, NoBoundary};
use rotor_core::reason;
use thiserror::Error;

use crate::failure::Failure;
use crate::rotor_file::NamedRotor;

/// The relative difference between Hill's and the exact width above which the report's check fails, where rounding
/// alone moves the width of a narrow region by less.
const AGREEMENT: f64 = 1e-6;
/// Speeds at which the motion between two ends is looked at, and how near to the ends between them, over these.
const BETWEEN: u32 = 64;
const BESIDE: f64 = 1e-6;

/// Why there are no ends by Hill's method.
#[derive(Clone, Debug, Error)]
pub(crate) enum NoHillEnds {
    /// The other regions leave no room to look for them.
    #[error("{0}")]
    Untold(String),
    /// Its growth rates do not show them.
    #[error("{}", reason::of_boundary(.0))]
    Boundary(#[from] NoBoundary),
}

/// A rotor and what follows from it.
#[derive(Clone, Debug)]
pub(crate) struct Analysis {
    /// The rotor.
    pub(crate) named: NamedRotor,
    /// Crack compliance, Eq. (8).
    pub(crate) compliance: CrackCompliance,
    /// Dimensionless coefficients, Eq. (12).
    pub(crate) coefficients: Coefficients,
    /// ω_st, rad/s.
    pub(crate) reference_speed: f64,
    /// The regions, or why there is none.
    pub(crate) regions: Regions,
    /// The speed from which on the motion is unstable at every speed, in units of the reference speed.
    pub(crate) unstable_from: Option<f64>,
}

/// An instability region three ways, in units of the reference speed.
#[derive(Clone, Debug)]
pub(crate) struct Region {
    /// Where it starts, Eqs. (15), (16).
    pub(crate) start: f64,
    /// Its approximate width, Eq. (31), or why there is none.
    pub(crate) width: Result<f64, String>,
    /// Its exact ends, or why there are none.
    pub(crate) exact: Result<Ends, String>,
    /// Its ends by Hill's method, or why they are not told.
    pub(crate) hill: Result<Boundary, NoHillEnds>,
}

impl Region {
    /// Relative difference of the approximate width to the exact one; none where a width is missing or zero.
    pub(crate) fn approximation_difference(&self) -> Option<f64> {
        relative(
            *self.width.as_ref().ok()?,
            self.exact.as_ref().ok()?.width(),
        )
    }

    /// Relative difference of Hill's width to the exact one.
    pub(crate) fn hill_difference(&self) -> Option<f64> {
        relative(
            self.hill.as_ref().ok()?.width(),
            self.exact.as_ref().ok()?.width(),
        )
    }

    /// Whether Hill's method and the exact ends agree, as far as Hill's method tells.
    fn agrees(&self) -> bool {
        match &self.hill {
            Ok(hill) => self
                .hill_difference()
                .is_none_or(|difference| difference.abs() <= AGREEMENT.max(hill.rounding)),
            Err(NoHillEnds::Untold(_)) => true,
            Err(NoHillEnds::Boundary(why)) => !why.is_contradiction(),
        }
    }

    /// What the check of this region has found where it failed.
    pub(crate) fn disagreement(&self) -> Option<String> {
        if self.agrees() {
            return None;
        }
        Some(match (&self.hill, self.hill_difference()) {
            (Err(why), _) => format!("Hill's method does not give its exact ends: {why}"),
            (Ok(_), difference) => format!(
                "its width by Hill's method is off the exact one by {:.1e} of it",
                difference.unwrap_or_default()
            ),
        })
    }
}

fn relative(value: f64, reference: f64) -> Option<f64> {
    (reference > 0.0).then(|| value / reference - 1.0)
}

impl Analysis {
    /// Computes everything.
    ///
    /// # Errors
    ///
    /// Where the rotor has no coefficients, or a region no start, in double precision.
    pub(crate) fn new(named: NamedRotor) -> Result<Self, Failure> {
        let rotor = &named.rotor;
        let failed = |error: rotor_core::jeffcott::rotor::NoCoefficients| {
            Failure::input(format!("{}: {error}", named.name))
        };
        let compliance = rotor.compliance().map_err(failed)?;
        let coefficients = rotor.coefficients().map_err(failed)?;
        let reference_speed = rotor.reference_speed().map_err(failed)?;
        let out_of_range = RegionKind::ALL
            .into_iter()
            .find_map(|kind| reason::out_of_range(kind, &coefficients));
        if let Some(why) = out_of_range {
            return Err(Failure::input(format!("{}: {why}", named.name)));
        }
        let (regions, unstable_from) = regions(&coefficients);
        Ok(Self {
            named,
            compliance,
            coefficients,
            reference_speed,
            regions,
            unstable_from,
        })
    }

    /// The regions whose check failed, and what it has found.
    pub(crate) fn disagreements(&self) -> Vec<(RegionKind, String)> {
        self.regions
            .iter()
            .filter_map(|(kind, region)| Some((*kind, region.as_ref().ok()?.disagreement()?)))
            .collect()
    }
}

/// The speed from which on every speed is unstable. Where |Δ_d| > |β − 1| the last end of the simple regions has no
/// partner; other regions, of which the ends are `known`, may lie inside that one or lead into it.
fn unstable_from(c: &Coefficients, known: &[(RegionKind, Ends)]) -> Option<f64> {
    let simple = exact::simple_region_ends(c).ok()?;
    let (last, others) = simple.split_last()?;
    if simple.len() % 2 == 0 {
        return None;
    }
    let known = known.iter().flat_map(|(_, ends)| [ends.lower, ends.upper]);
    let below: Vec<f64> = others
        .iter()
        .copied()
        .chain(known)
        .filter(|end| end < last)
        .collect();
    let all_grow_from = |lower: f64| {
        let part = |index: u32| (f64::from(index) + 0.5) / f64::from(BETWEEN);
        let grid = (0..BETWEEN).map(|index| lower + part(index) * (last - lower));
        let inner = below.iter().chain([last]).filter(|&&end| end > lower);
        let beside = inner.flat_map(|end| [end * (1.0 - BESIDE), end * (1.0 + BESIDE)]);
        grid.chain(beside)
            .all(|speed| exact::growth_rate(c, speed).is_ok_and(|rate| rate > 0.0))
    };
    let lower = below.iter().copied().filter(|&end| all_grow_from(end));
    Some(lower.fold(*last, f64::min))
}

/// A rotor's regions, each found or with the reason why there is none.
type Regions = Vec<(RegionKind, Result<Region, String>)>;

/// The regions of a rotor, and from which speed on every speed is unstable. The second simple region is left out where
/// there is none: few rotors have it.
fn regions(c: &Coefficients) -> (Regions, Option<f64>) {
    let mut regions: Vec<_> = RegionKind::ALL
        .into_iter()
        .map(|kind| (kind, without_hill(kind, c)))
        .filter(|(kind, region)| *kind != RegionKind::UpperSimple || region.is_ok())
        .collect();
    let known: Vec<(RegionKind, Ends)> = regions
        .iter()
        .filter_map(|(kind, region)| Some((*kind, *region.as_ref().ok()?.exact.as_ref().ok()?)))
        .collect();
    let unstable_from = unstable_from(c, &known);
    for (_, region) in &mut regions {
        if let Ok(region) = region {
            region.hill = hill_ends(c, region, &known, unstable_from);
        }
    }
    (regions, unstable_from)
}

/// A region's ends by Hill's method, near the exact ones or, where there are none, about its start. The growth rate says
/// that the motion grows, not in which region: ends that are not known must lie apart from the `known` regions.
fn hill_ends(
    c: &Coefficients,
    region: &Region,
    known: &[(RegionKind, Ends)],
    unstable_from: Option<f64>,
) -> Result<Boundary, NoHillEnds> {
    if let Ok(exact) = region.exact {
        return Ok(confirm_ends(c, exact)?);
    }
    let untold = |why: String| Err(NoHillEnds::Untold(why));
    if let Some(lower) = unstable_from.filter(|lower| *lower <= region.start) {
        return untold(format!(
            "its start lies where every speed from {lower:.6} × ω_st upwards is unstable"
        ));
    }
    if let Some((kind, _)) = known
        .iter()
        .find(|(_, ends)| (ends.lower..=ends.upper).contains(&region.start))
    {
        return untold(format!(
            "its start lies inside the {}, growth rates do not tell the two apart",
            kind.description()
        ));
    }
    let width = match &region.width {
        Ok(width) => *width,
        Err(why) => return untold(why.clone()),
    };
    let found = boundary::search(|speed| c.growth_rate(speed), region.start, width)?;
    let overlaps = |ends: &Ends| ends.lower <= found.upper && found.lower <= ends.upper;
    match known.iter().find(|(_, ends)| overlaps(ends)) {
        Some((kind, _)) => untold(format!(
            "growth goes on from its start into the {}",
            kind.description()
        )),
        None => Ok(found),
    }
}

fn without_hill(kind: RegionKind, c: &Coefficients) -> Result<Region, String> {
    let start = region::start(kind, c).map_err(|error| error.to_string())?;
    Ok(Region {
        start,
        width: region::width(kind, c).map_err(|error| error.to_string()),
        exact: region::exact_ends(kind, c).map_err(|error| reason::of_exact_ends(&error)),
        hill: Err(NoHillEnds::Untold("not computed".to_owned())),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    use rayon::prelude::*;
    use rotor_core::error::StabilityError;
    use rotor_core::input::{INPUTS, RotorParameters};
    use rotor_core::jeffcott::rotor::Rotor;

    fn analysis(rotor: Rotor) -> Analysis {
        let named = NamedRotor {
            rotor,
            name: "a test".to_owned(),
        };
        Analysis::new(named).unwrap()
    }

    fn paper(change: impl FnOnce(&mut RotorParameters)) -> Analysis {
        analysis(Rotor::default().with(change).unwrap())
    }

    fn failed(analysis: &Analysis) -> Vec<RegionKind> {
        let failed = analysis.disagreements().into_iter();
        failed.map(|(kind, _)| kind).collect()
    }

    #[test]
    fn a_width_by_hill_that_is_off_fails_the_check() {
        let mut analysis = paper(|_| {});
        assert_eq!(failed(&analysis), []);
        let region = analysis.regions[1].1.as_mut().unwrap();
        let hill = region.hill.as_mut().unwrap();
        hill.upper += 1e-5 * hill.width();
        assert_eq!(failed(&analysis), [RegionKind::Combination]);
    }

    #[test]
    fn a_failure_of_hills_method_fails_the_check() {
        let mut analysis = paper(|_| {});
        let (_, region) = &mut analysis.regions[0];
        region.as_mut().unwrap().hill = Err(NoHillEnds::Boundary(NoBoundary::Failed(
            StabilityError::NoConvergence {
                what: "the Schur form",
                iterations: 1,
            },
        )));
        assert_eq!(failed(&analysis), [RegionKind::Simple]);
    }

    #[test]
    fn the_check_of_a_sound_rotor_passes() {
        let path =
            Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/reference/random_rotors.csv");
        let mut reader = csv::Reader::from_path(path).unwrap();
        let header = reader.headers().unwrap().clone();
        let records: Vec<_> = reader.records().map(Result::unwrap).collect();
        let counts: Vec<_> = records
            .par_iter()
            .enumerate()
            .map(|(row, record)| {
                let cell = |name: &str| {
                    let index = header.iter().position(|heading| heading == name).unwrap();
                    &record[index]
                };
                let mut parameters = RotorParameters::PAPER;
                for input in &INPUTS {
                    (input.set)(&mut parameters, cell(input.name).parse().unwrap());
                }
                parameters.crack_model = cell("crack_model").parse().unwrap();
                let analysis = analysis(Rotor::new(parameters).unwrap());
                let line = row + 2;
                assert_eq!(analysis.disagreements(), [], "line {line}");
                let regions = analysis
                    .regions
                    .iter()
                    .filter_map(|(_, region)| region.as_ref().ok());
                let exact: Vec<_> = regions.filter(|region| region.exact.is_ok()).collect();
                let checked = exact.iter().filter(|region| region.hill.is_ok()).count();
                (exact.len(), checked)
            })
            .collect();
        let exact: usize = counts.iter().map(|(exact, _)| exact).sum();
        let checked: usize = counts.iter().map(|(_, checked)| checked).sum();
        assert_eq!(counts.len(), 300);
        assert!(10 * checked >= 9 * exact, "{checked} of {exact}");
    }

    /// The paper's rotor with another ratio of the inertias.
    fn inertia_ratio(beta: f64) -> Analysis {
        paper(|p| p.disk_polar_inertia = beta * p.disk_diametral_inertia)
    }

    #[test]
    fn instability_that_reaches_to_infinite_speed_is_found() {
        for beta in [0.85, 0.95, 1.0, 1.19] {
            let analysis = inertia_ratio(beta);
            let from = analysis.unstable_from.unwrap();
            let c = &analysis.coefficients;
            for factor in [1.001, 2.0, 100.0] {
                assert!(
                    exact::growth_rate(c, factor * from).unwrap() > 0.0,
                    "{beta}"
                );
            }
            assert_eq!(exact::growth_rate(c, 0.999 * from), Ok(0.0), "{beta}");
        }
        for beta in [0.5, 0.79, 1.21, 2.0] {
            assert_eq!(inertia_ratio(beta).unstable_from, None, "{beta}");
        }
    }

    #[test]
    fn a_region_inside_an_open_one_does_not_bound_it() {
        // Nearly uncoupled: the transverse region between √0.8 and √1.2, and a disk whose asymmetry makes the tilting
        // motion unstable from √(δ/Δ_d) = 0.5 upwards.
        let c = Coefficients {
            beta: 1.0,
            gamma: 1e-3,
            delta: 0.05,
            epsilon_1: 0.2,
            epsilon_12: 0.0,
            epsilon_2: 0.0,
            disk_asymmetry: 0.2,
            crack_angle: 0.0,
        };
        let from = unstable_from(&c, &[]).unwrap();
        assert!((from - 0.5).abs() < 1e-4, "{from}");
        let region = without_hill(RegionKind::Simple, &c).unwrap();
        let why = hill_ends(&c, &region, &[], Some(from)).unwrap_err();
        assert!(why.to_string().contains("another region adjoins"), "{why}");
    }

    #[test]
    fn a_region_that_leads_into_an_open_one_begins_it() {
        let analysis = paper(|p| (p.disk_polar_inertia, p.disk_asymmetry) = (0.1397, 0.9));
        let (kind, combination) = analysis.regions.last().unwrap();
        assert_eq!(*kind, RegionKind::Combination);
        let ends = combination.as_ref().unwrap().exact.clone().unwrap();
        assert_eq!(analysis.unstable_from, Some(ends.lower));
        let simple = exact::simple_region_ends(&analysis.coefficients).unwrap();
        assert!(simple[2] > ends.upper, "a gap without a stable speed");
    }

    #[test]
    fn a_start_inside_another_region_is_told() {
        let c = Rotor::default().coefficients().unwrap();
        let mut region = without_hill(RegionKind::Simple, &c).unwrap();
        let ends = region.exact.clone().unwrap();
        region.exact = Err("not found".to_owned());
        let found = hill_ends(&c, &region, &[], None).unwrap();
        assert!((found.width() / ends.width() - 1.0).abs() < 1e-6);
        let other = [(RegionKind::Combination, ends)];
        let why = hill_ends(&c, &region, &other, None)
            .unwrap_err()
            .to_string();
        assert!(why.contains("start lies inside the combination"), "{why}");
        region.start = ends.lower - 1e-3;
        let why = hill_ends(&c, &region, &other, None)
            .unwrap_err()
            .to_string();
        assert!(why.contains("into the combination"), "{why}");
        let why = hill_ends(&c, &region, &[], Some(0.5))
            .unwrap_err()
            .to_string();
        assert!(why.contains("0.500000"), "{why}");
    }
}
