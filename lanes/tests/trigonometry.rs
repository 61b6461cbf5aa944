//! Sine and cosine of packs against the standard library's, on every level of the machine.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking too")]

use lanes::{ALL, EXACT_BEYOND, Kernel, Level, Pack, Simd, store};
use proptest::prelude::*;

/// Sine and cosine of a column.
struct SineAndCosine;

impl Kernel<0, 1, 2> for SineAndCosine {
    #[inline(always)]
    fn evaluate<S: Simd>(_: S, _: [Pack<S>; 0], [angle]: [Pack<S>; 1]) -> [Pack<S>; 2] {
        [angle.sin(), angle.cos()]
    }
}

fn sines_and_cosines(level: Level, angles: &[f64]) -> [Vec<f64>; 2] {
    let mut sines = vec![0.0; angles.len()];
    let mut cosines = vec![0.0; angles.len()];
    let results = [&mut sines[..], &mut cosines[..]];
    store::<SineAndCosine, ALL, 0, 1, 2>(level, &[], [angles], results).unwrap();
    [sines, cosines]
}

/// How many numbers lie between two of one sign.
fn units_apart(a: f64, b: f64) -> u64 {
    if a == b {
        return 0;
    }
    assert_eq!(a.is_sign_negative(), b.is_sign_negative(), "{a} and {b}");
    a.to_bits().abs_diff(b.to_bits())
}

/// The standard library's are right to within one unit, so that 2 from the truth may be 3 from them; 2 is what is found.
fn assert_close(level: Level, angles: &[f64]) {
    let [sines, cosines] = sines_and_cosines(level, angles);
    for (row, angle) in angles.iter().enumerate() {
        assert!(units_apart(sines[row], angle.sin()) <= 2, "sin {angle:e}");
        assert!(units_apart(cosines[row], angle.cos()) <= 2, "cos {angle:e}");
    }
}

#[test]
fn within_two_units_near_every_quarter_turn() {
    // The nearest numbers to multiples of π/2, where most digits cancel, and their neighbours.
    let mut angles = Vec::new();
    for quarter in -637..=637 {
        let nearest = f64::from(quarter) * std::f64::consts::FRAC_PI_2;
        let mut near = nearest.next_down().next_down();
        for _ in 0..5 {
            angles.push(near);
            near = near.next_up();
        }
        angles.extend([1e-9, 1e-4, 0.1, 0.785].map(|distance| nearest + distance));
    }
    angles.retain(|angle| angle.abs() <= EXACT_BEYOND);
    for level in Level::available() {
        assert_close(level, &angles);
    }
}

#[test]
fn large_angles_are_those_of_the_standard_library() {
    let angles = [1000.5, 1e9, -3e15, 1e300, 0.5, f64::INFINITY, f64::NAN, 0.0];
    for level in Level::available() {
        let [sines, cosines] = sines_and_cosines(level, &angles);
        let near = sines_and_cosines(level, &[0.5]);
        for (row, angle) in angles.into_iter().enumerate() {
            if angle.abs() > EXACT_BEYOND {
                assert_eq!(sines[row].to_bits(), angle.sin().to_bits(), "{angle}");
                assert_eq!(cosines[row].to_bits(), angle.cos().to_bits(), "{angle}");
            }
        }
        // A neighbour does not change what a row gets.
        assert_eq!([sines[4], cosines[4]], [near[0][0], near[1][0]]);
        assert!(sines[6].is_nan() && cosines[6].is_nan());
        assert_eq!([sines[7], cosines[7]], [0.0, 1.0]);
    }
}

proptest! {
    #[test]
    fn within_two_units_anywhere(angles in prop::collection::vec(-1e3..1e3_f64, 1..64)) {
        for level in Level::available() {
            assert_close(level, &angles);
        }
    }

    #[test]
    fn every_level_and_every_tail_has_the_same_bits(
        angles in prop::collection::vec(-2e3..2e3_f64, 1..40),
    ) {
        let expected = sines_and_cosines(Level::Baseline, &angles);
        for level in Level::available() {
            prop_assert_eq!(&sines_and_cosines(level, &angles), &expected);
            for (row, angle) in angles.iter().enumerate() {
                let [sine, cosine] = sines_and_cosines(level, &[*angle]);
                prop_assert_eq!(sine[0].to_bits(), expected[0][row].to_bits());
                prop_assert_eq!(cosine[0].to_bits(), expected[1][row].to_bits());
            }
        }
    }
}
