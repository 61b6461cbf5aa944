use super::*;
use crate::error::SystemError;

/// Growth between 0.9 and 1.1, as fast as its middle says, and nowhere else.
fn lens(peak: f64) -> impl Fn(f64) -> Result<f64, Error> {
    move |speed: f64| Ok(peak * (1.0 - ((speed - 1.0) / 0.1).powi(2)).max(0.0).sqrt())
}

#[test]
fn neville_finds_the_zero_of_a_parabola_from_three_of_its_points() {
    // The inverse of y = 4 - x is a line, that of y = √(4 - x) is a parabola.
    let samples = [0.0_f64, 1.0, 3.0].map(|x| (x, (4.0 - x).sqrt()));
    assert!((extrapolate(&samples) - 4.0).abs() < 1e-14);
}

#[test]
fn ends_are_found_from_a_start_inside_and_from_one_beside() {
    for (start, width) in [(1.0, 0.2), (1.05, 0.01), (1.15, 0.1), (0.85, 0.3)] {
        let found = search(lens(0.05), start, width).unwrap();
        assert!((found.lower - 0.9).abs() < 1e-9, "{start}: {found:?}");
        assert!((found.upper - 1.1).abs() < 1e-9, "{start}: {found:?}");
    }
}

#[test]
fn each_way_to_have_no_ends_has_its_kind() {
    let nothing = |_| Ok(0.0);
    let all = |_| Ok(0.1);
    let failed = |_| Err(SystemError::SingularMass { time: 0.0 }.into());
    assert_eq!(
        confirm(all, 1.0..=1.0, all),
        Err(BoundaryError::Closed.into())
    );
    let width = -0.1;
    assert_eq!(
        search(all, 1.0, width),
        Err(BoundaryError::NoWidth { width }.into())
    );
    let limit = 1e-5;
    let narrow = Err(BoundaryError::TooNarrow { limit }.into());
    assert_eq!(confirm(nothing, 0.9..=1.1, nothing), narrow);
    let quiet = Err(BoundaryError::NoGrowth { limit }.into());
    assert_eq!(search(nothing, 0.5, 0.1), quiet);
    assert_eq!(search(all, 1.0, 0.1), Err(BoundaryError::Endless.into()));
    let adjoined = Err(BoundaryError::Adjoined { speed: 0.9 }.into());
    assert_eq!(confirm(all, 0.9..=1.1, all), adjoined);
    for contradicted in [
        confirm(nothing, 0.9..=1.1, all),
        confirm(all, 0.9..=1.1, nothing),
        confirm(failed, 0.9..=1.1, all),
    ] {
        let why = contradicted.unwrap_err();
        assert!(is_contradiction(&why), "{why}");
    }
}

#[test]
fn growth_that_is_slow_beside_the_middle_is_none() {
    // Beyond the lens the motion grows a little, as where damping leaves a weak instability.
    let growth = |speed| Ok(lens(0.5)(speed)?.max(2e-6));
    let found = confirm(growth, 0.9..=1.1, growth).unwrap();
    assert!((found.width() - 0.2).abs() < 1e-9, "{found:?}");
}
