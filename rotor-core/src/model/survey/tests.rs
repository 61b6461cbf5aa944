use super::*;
use crate::input::RotorParameters;
use crate::jeffcott::rotor::Rotor;

fn coefficients(change: impl FnOnce(&mut RotorParameters)) -> Coefficients {
    let rotor = Rotor::default().with(change).unwrap();
    rotor.coefficients().unwrap()
}

/// The coefficients of the paper's rotor with another ratio of the inertias.
fn inertia_ratio(beta: f64) -> Coefficients {
    coefficients(|p| p.disk_polar_inertia = beta * p.disk_diametral_inertia)
}

fn without_hill(kind: RegionKind, c: &Coefficients) -> SurveyedRegion {
    SurveyedRegion::without_hill(Region::of(kind, c).unwrap())
}

#[test]
fn instability_that_reaches_to_infinite_speed_is_found() {
    for beta in [0.85, 0.95, 1.0, 1.19] {
        let c = inertia_ratio(beta);
        let from = Survey::of(&c).unstable_from.unwrap();
        for factor in [1.001, 2.0, 100.0] {
            assert!(
                exact::growth_rate(&c, factor * from).unwrap() > 0.0,
                "{beta}"
            );
        }
        assert_eq!(exact::growth_rate(&c, 0.999 * from), Ok(0.0), "{beta}");
    }
    for beta in [0.5, 0.79, 1.21, 2.0] {
        let survey = Survey::of(&inertia_ratio(beta));
        assert_eq!(survey.unstable_from, None, "{beta}");
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
    let region = without_hill(RegionKind::Simple, &c);
    let why = hill_ends(&c, &region, &[], Some(from)).unwrap_err();
    assert!(
        matches!(why, Error::Boundary(BoundaryError::Adjoined { .. })),
        "{why}"
    );
}

#[test]
fn a_region_that_leads_into_an_open_one_begins_it() {
    let c = coefficients(|p| (p.disk_polar_inertia, p.disk_asymmetry) = (0.1397, 0.9));
    let survey = Survey::of(&c);
    let (kind, combination) = survey.regions.last().unwrap();
    assert_eq!(*kind, RegionKind::Combination);
    let ends = combination.as_ref().unwrap().exact.clone().unwrap();
    assert_eq!(survey.unstable_from, Some(ends.lower));
    let simple = exact::simple_region_ends(&c).unwrap();
    assert!(simple[2] > ends.upper, "a gap without a stable speed");
}

#[test]
fn a_start_inside_another_region_is_told() {
    let c = Rotor::default().coefficients().unwrap();
    let mut region = without_hill(RegionKind::Simple, &c);
    let ends = region.exact.clone().unwrap();
    let kind = RegionKind::Simple;
    let reason = "not looked for";
    region.exact = Err(RegionError::NoExactEnds { kind, reason }.into());
    let found = hill_ends(&c, &region, &[], None).unwrap();
    assert!((found.width() / ends.width() - 1.0).abs() < 1e-6);
    let kind = RegionKind::Combination;
    let other = [(kind, ends)];
    let why = hill_ends(&c, &region, &other, None).unwrap_err();
    assert_eq!(why, BoundaryError::StartsInside { kind }.into());
    region.start = ends.lower - 1e-3;
    let why = hill_ends(&c, &region, &other, None).unwrap_err();
    assert_eq!(why, BoundaryError::LeadsInto { kind }.into());
    let why = hill_ends(&c, &region, &[], Some(0.5)).unwrap_err();
    assert_eq!(why, BoundaryError::AllUnstable { lower: 0.5 }.into());
}
