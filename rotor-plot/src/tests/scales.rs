//! Properties of ticks on linear and logarithmic axes.

use proptest::prelude::*;

use super::*;
use crate::scale::{Ends, Scale};

/// A range and how it ends.
fn range() -> impl Strategy<Value = (f64, f64, Ends)> {
    let ends = prop_oneof![Just(Ends::Kept), Just(Ends::Rounded)];
    // Down to spans of a millionth of the values: narrower ones have too many digits to tell their ticks apart.
    (-1.0..1.0, -6.0..0.0, -12.0..12.0, ends).prop_map(
        |(middle, span, size, ends): (f64, f64, f64, _)| {
            let (span, size) = (10f64.powf(span), 10f64.powf(size));
            ((middle - span) * size, (middle + span) * size, ends)
        },
    )
}

/// Checks what holds for every scale over a range, and answers with its ticks.
fn check(scale: &Scale, (low, high): (f64, f64), count: f64) -> Vec<f64> {
    let ticks = scale.ticks.clone();
    let near = 1e-6 * (high - low);
    assert!(scale.low <= low + near && scale.high >= high - near);
    assert!(ticks.windows(2).all(|pair| pair[0] < pair[1]), "{ticks:?}");
    assert!(
        ticks
            .iter()
            .all(|&tick| tick >= scale.low - near && tick <= scale.high + near),
        "{scale:?}"
    );
    assert!(ticks.len() as f64 <= count + 3.0, "{scale:?}");
    let labels: Vec<String> = ticks.iter().map(|&tick| scale.write(tick)).collect();
    assert!(
        labels.windows(2).all(|pair| pair[0] != pair[1]),
        "{labels:?}"
    );
    let shares: Vec<f64> = ticks.iter().map(|&tick| scale.share(tick)).collect();
    assert!(
        shares.windows(2).all(|pair| pair[0] < pair[1]),
        "{shares:?}"
    );
    assert!(
        shares
            .iter()
            .all(|share| (-1e-6..1.0 + 1e-6).contains(share)),
        "{shares:?}"
    );
    ticks
}

/// The first digit of a number that has no other.
fn only_digit(value: f64) -> Option<u32> {
    let written = format!("{value:.5e}");
    let (digits, _) = written.split_once('e')?;
    let (first, rest) = digits.split_once('.')?;
    rest.bytes()
        .all(|digit| digit == b'0')
        .then(|| first.parse().ok())
        .flatten()
}

/// The number that a label of a tick writes.
fn read(label: &str) -> f64 {
    let powers = "⁰¹²³⁴⁵⁶⁷⁸⁹";
    let plain: String = label
        .replace("×10", "e")
        .chars()
        .map(|letter| match letter {
            '−' | '⁻' => '-',
            _ => powers
                .chars()
                .position(|power| power == letter)
                .and_then(|digit| char::from_digit(digit as u32, 10))
                .unwrap_or(letter),
        })
        .collect();
    plain.parse().unwrap_or(f64::NAN)
}

proptest! {
    #[test]
    fn linear_ticks_are_round_multiples_and_read_back((low, high, ends) in range(), count in 5..8) {
        let count = f64::from(count);
        let scale = Scale::new(low, high, Ticks::Decimal, ends, count);
        let ticks = check(&scale, (low, high), count);
        let Some([first, second]) = ticks.first_chunk() else {
            panic!("{scale:?}")
        };
        let step = second - first;
        prop_assert!(matches!(only_digit(step), Some(1 | 2 | 5)), "{step}");
        for &tick in &ticks {
            prop_assert!((tick / step - (tick / step).round()).abs() < 1e-3, "{tick} {step}");
            let label = scale.write(tick);
            prop_assert!((read(&label) - tick).abs() < 1e-3 * step, "{label} is {tick}");
        }
        if ends == Ends::Rounded {
            prop_assert!((scale.low - first).abs() < 1e-3 * step);
        }
    }

    #[test]
    fn logarithmic_ticks_are_round_and_tell_apart(
        (start, decades) in (-200.0..200.0, 0.01..60.0),
        kept in any::<bool>(),
        count in 3..8,
    ) {
        let (low, high) = (10f64.powf(start), 10f64.powf(start + decades));
        let ends = if kept { Ends::Kept } else { Ends::Rounded };
        let scale = Scale::new(low, high, Ticks::Logarithmic, ends, f64::from(count));
        let ticks = check(&scale, (low, high), f64::from(count));
        prop_assert!(!ticks.is_empty(), "{scale:?}");
        if decades > 1.0 {
            prop_assert!(ticks.iter().all(|&tick| matches!(only_digit(tick), Some(1 | 2 | 5))), "{ticks:?}");
        }
        prop_assert!((scale.share(low) - scale.share(high)).abs() <= 1.0 + 1e-9);
    }

    #[test]
    fn ticks_of_angles_are_usual_fractions(low in -10.0..10.0, span in 0.2..30.0) {
        for kind in [Ticks::Degrees, Ticks::FractionsOfPi] {
            let scale = Scale::new(low, low + span, kind, Ends::Kept, 6.0);
            let ticks = check(&scale, (low, low + span), 6.0);
            prop_assert!(ticks.len() >= 2, "{scale:?}");
        }
    }
}

proptest! {
    #[test]
    fn levels_are_round_and_lie_between((low, high, _) in range()) {
        let found = levels(&[Some(high), None, Some(low)], 10.0);
        prop_assert!((3..=12).contains(&found.len()), "{found:?}");
        prop_assert!(found.windows(2).all(|pair| pair[0] < pair[1]));
        prop_assert!(found.iter().all(|&level| low < level && level < high));
        prop_assert!(matches!(only_digit(found[1] - found[0]), Some(1 | 2 | 5)), "{found:?}");
    }
}

#[test]
fn values_that_agree_have_no_levels() {
    for values in [
        &[][..],
        &[None],
        &[Some(1.0)],
        &[Some(0.0), Some(5e-324)],
        &[Some(-1.7e308), Some(1.7e308)],
    ] {
        assert_eq!(levels(values, 10.0), [0.0; 0], "{values:?}");
    }
    let next = 1.0 + f64::EPSILON;
    assert!(levels(&[Some(1.0), Some(next)], 10.0).len() <= 1);
}

#[test]
fn logarithmic_ticks_are_written_alike() {
    let written = |low, high| -> Vec<String> {
        let scale = Scale::new(low, high, Ticks::Logarithmic, Ends::Kept, 6.0);
        scale.ticks.iter().map(|&tick| scale.write(tick)).collect()
    };
    assert_eq!(
        written(0.01, 1.0),
        ["0.01", "0.02", "0.05", "0.1", "0.2", "0.5", "1"]
    );
    assert_eq!(
        written(1e-6, 1e6),
        ["10⁻⁶", "10⁻⁴", "10⁻²", "10⁰", "10²", "10⁴", "10⁶"]
    );
    assert_eq!(written(1e-5, 1e-3)[..3], ["10⁻⁵", "2×10⁻⁵", "5×10⁻⁵"]);
    // Within less than a decade evenly spaced ones.
    assert_eq!(
        written(3.0, 4.0),
        ["3.0", "3.2", "3.4", "3.6", "3.8", "4.0"]
    );
}
