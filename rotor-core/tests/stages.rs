//! Both widths in stages: the same numbers as straight from the coefficients, the same bits on every level.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking too")]

use lanes::{ALL, Kernel, Level, store};
use proptest::prelude::*;
use rotor_core::equations::both_widths::along_beta_to_epsilon_2 as along_coefficients;
use rotor_core::equations::both_widths::{
    Columns, along_crack_angle, along_disk_asymmetry, columns,
};
use rotor_core::equations::{Coefficients, cir_width, phi, sir_width};
use rotor_core::input::RotorParameters;
use rotor_core::jeffcott::rotor::Rotor;

const POINTS: usize = 37;

/// Both widths of `c` along points, by the two loops of a staged form.
fn staged<A, P, const INNER: usize, const FIXED: usize, const TABLES: usize>(
    level: Level,
    fixed: [f64; FIXED],
    inner: [&[f64]; INNER],
) -> [Vec<f64>; 2]
where
    A: Kernel<0, INNER, TABLES>,
    P: Kernel<FIXED, TABLES, 2>,
{
    let mut tables = [(); TABLES].map(|()| vec![0.0; POINTS]);
    let slices = tables.each_mut().map(|table| &mut table[..]);
    store::<A, ALL, 0, INNER, TABLES>(level, &[], inner, slices).unwrap();
    let mut widths = [(); 2].map(|()| vec![0.0; POINTS]);
    let slices = widths.each_mut().map(|width| &mut width[..]);
    let tables = tables.each_ref().map(|table| &table[..]);
    store::<P, ALL, FIXED, TABLES, 2>(level, &fixed, tables, slices).unwrap();
    widths
}

/// Compares the two loops on every level with the formulas at each point.
macro_rules! assert_staged {
    ($module:ident, $inner:expr, $c:expr, $at:expr) => {{
        use $module::{Along, FIXED, Points, TABLES, fixed};
        let expected: Vec<Coefficients> = (0..POINTS).map($at).collect();
        let run = |level| staged::<Along, Points, _, FIXED, TABLES>(level, fixed($c), $inner);
        let baseline = run(Level::Baseline);
        for level in Level::available() {
            let widths = run(level);
            for (row, c) in expected.iter().enumerate() {
                for (width, (exact, base)) in widths.iter().zip(
                    [sir_width(c), cir_width(c)]
                        .into_iter()
                        .zip([baseline[0][row], baseline[1][row]]),
                ) {
                    let size = width[row] / exact;
                    prop_assert!((size - 1.0).abs() < 1e-12, "{} for {exact}", width[row]);
                    prop_assert_eq!(width[row].to_bits(), base.to_bits());
                }
            }
        }
    }};
}

/// Rotors whose regions are open, so that relative differences mean something.
fn coefficients() -> impl Strategy<Value = Coefficients> {
    (0.1..0.3_f64, 0.05..0.4_f64, 0.2..0.8_f64, 0.3..1.2_f64).prop_map(
        |(asymmetry, depth, position, angle)| {
            let rotor = Rotor::new(RotorParameters {
                disk_asymmetry: asymmetry,
                crack_depth_ratio: depth,
                crack_position_ratio: position,
                crack_angle: angle,
                ..RotorParameters::PAPER
            });
            rotor.unwrap().coefficients().unwrap()
        },
    )
}

fn along(from: f64, to: f64) -> Vec<f64> {
    let step = (to - from) / (POINTS - 1) as f64;
    (0..POINTS)
        .map(|point| from + step * point as f64)
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn stages_have_the_numbers_of_the_formulas(c in coefficients()) {
        let angles = along(0.3, 1.2);
        assert_staged!(along_crack_angle, [&angles[..]], &c, |row| Coefficients {
            crack_angle: angles[row],
            ..c
        });
        let asymmetries = along(0.1, 0.3);
        assert_staged!(along_disk_asymmetry, [&asymmetries[..]], &c, |row| Coefficients {
            disk_asymmetry: asymmetries[row],
            ..c
        });
        let betas = along(1.1, 1.9);
        let (gammas, deltas) = (along(-0.9, -0.5), along(1.2, 1.7));
        let factors = along(0.9, 1.2);
        let epsilons = [c.epsilon_1, c.epsilon_12, c.epsilon_2];
        let epsilons = epsilons.map(|epsilon| factors.iter().map(|factor| factor * epsilon).collect::<Vec<_>>());
        assert_staged!(
            along_coefficients,
            [&betas[..], &gammas[..], &deltas[..], &epsilons[0][..], &epsilons[1][..], &epsilons[2][..]],
            &c,
            |row| Coefficients {
                beta: betas[row],
                gamma: gammas[row],
                delta: deltas[row],
                epsilon_1: epsilons[0][row],
                epsilon_12: epsilons[1][row],
                epsilon_2: epsilons[2][row],
                ..c
            }
        );
    }
}

/// The frequency equation along the speed, as a chart of its zeros over speeds wants it.
#[test]
fn along_the_speed_the_frequency_equation_has_its_numbers() {
    use rotor_core::equations::phi::along_speed::{Along, FIXED, Points, TABLES, fixed};
    let c = Rotor::default().coefficients().unwrap();
    let speeds = along(0.0, 2.5);
    for omega in [0.3, 0.9, 1.7] {
        let expected = speeds.iter().map(|speed| phi(omega, *speed, &c));
        let expected: Vec<f64> = expected.collect();
        let largest = expected
            .iter()
            .fold(0.0, |largest, value| f64::max(largest, value.abs()));
        for level in Level::available() {
            let mut tables = [(); TABLES].map(|()| vec![0.0; POINTS]);
            let slices = tables.each_mut().map(|table| &mut table[..]);
            store::<Along, ALL, 0, 1, TABLES>(level, &[], [&speeds], slices).unwrap();
            let mut found = vec![0.0; POINTS];
            let tables = tables.each_ref().map(|table| &table[..]);
            let fixed: [f64; FIXED] = fixed(omega, 0.0, &c);
            store::<Points, ALL, FIXED, TABLES, 1>(level, &fixed, tables, [&mut found]).unwrap();
            for (found, expected) in found.iter().zip(&expected) {
                assert!(
                    (found - expected).abs() <= 1e-13 * largest,
                    "{found} {expected}"
                );
            }
        }
    }
}

/// The inner loop along the crack's angle: two products, a sum and a root for each width.
#[test]
fn along_the_crack_angle_a_width_is_a_root_of_two_products() {
    assert_eq!(
        (along_crack_angle::FIXED, along_crack_angle::TABLES),
        (4, 2)
    );
}

#[test]
fn columns_of_different_lengths_are_refused_by_name() {
    let (long, short) = (vec![1.0; 8], vec![1.0; 7]);
    let inputs = Columns {
        c_beta: &long,
        c_gamma: &long,
        c_delta: &short,
        c_epsilon_1: &long,
        c_epsilon_12: &long,
        c_epsilon_2: &long,
        c_disk_asymmetry: &long,
        c_crack_angle: &long,
    };
    let mut results = [vec![0.0; 8], vec![0.0; 8]];
    let [sir, cir] = &mut results;
    let error = columns(&inputs, [sir, cir]).unwrap_err();
    assert_eq!(
        (error.column, error.length, error.expected),
        ("c_delta", 7, 8)
    );
}
