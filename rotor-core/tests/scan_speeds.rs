//! Scans along the speed, inside and outside of other axes, against growth rates point by point.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking too")]

use rotor_core::error::{InputError, StudyError};
use rotor_core::input::Variable;
use rotor_core::input::{NumericInput, RotorParameters};
use rotor_core::jeffcott::exact;
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::quantity::Quantity;
use rotor_core::study;
use rotor_core::study::table::{self, Column};
use rotor_core::study::{Axis, Control, Distribution, Plan, Reduction, Sampling, Scan, Statistic};

const ASKED: [Quantity; 3] = [
    Quantity::GrowthRate,
    Quantity::SirWidth,
    Quantity::CirExactLower,
];

fn depths() -> Axis {
    let depth = NumericInput::find("crack_depth_ratio").unwrap();
    Axis::linear(depth, (0.1, 0.4), 4).unwrap()
}

fn speeds() -> Axis {
    Axis::linear(Variable::Speed, (0.5, 2.0), 61).unwrap()
}

fn plan(axes: impl IntoIterator<Item = Axis>) -> Plan {
    let scan = axes
        .into_iter()
        .fold(Scan::of(&Rotor::default()), Scan::vary);
    ASKED.into_iter().fold(scan, Scan::quantity).plan().unwrap()
}

/// The results of a plan for each quantity.
fn scanned(plan: &Plan) -> Vec<Vec<Option<f64>>> {
    let mut all = vec![Vec::new(); ASKED.len()];
    for chunk in plan.chunks() {
        for (number, all) in all.iter_mut().enumerate() {
            all.extend(chunk.quantity(number).iter());
        }
    }
    all
}

/// What each quantity is at a depth and a speed.
fn at(depth: f64, speed: f64) -> Vec<Option<f64>> {
    let rotor = Rotor::default()
        .with(|p| p.crack_depth_ratio = depth)
        .unwrap();
    let values = study::evaluate_at(&ASKED, &rotor, Some(speed));
    values.into_iter().map(Result::ok).collect()
}

/// A growth rate is what it is at that point, to the last bit; other quantities come from equations that share their parts.
fn assert_found(found: Option<f64>, expected: Option<f64>, quantity: Quantity) {
    match (found, expected) {
        (Some(found), Some(expected)) if !quantity.needs_speed() => {
            let error = (found / expected - 1.0).abs();
            assert!(error <= 1e-14, "{quantity}: {found} {expected}");
        }
        (found, expected) => assert_eq!(found, expected, "{quantity}"),
    }
}

#[test]
fn the_speed_is_an_axis_inside_and_outside_of_another_and_beside_it() {
    let (depths, speeds) = (depths(), speeds());
    let inside = scanned(&plan([depths.clone(), speeds.clone()]));
    let outside = scanned(&plan([speeds.clone(), depths.clone()]));
    let mut growing = 0;
    for row in 0..depths.len() {
        for column in 0..speeds.len() {
            let expected = at(depths.value(0, row), speeds.value(0, column));
            for (number, expected) in expected.iter().enumerate() {
                let place = |outer: u64, inner: u64, count: u64| (outer * count + inner) as usize;
                let found = inside[number][place(row, column, speeds.len())];
                assert_found(found, *expected, ASKED[number]);
                let found = outside[number][place(column, row, depths.len())];
                assert_found(found, *expected, ASKED[number]);
            }
            growing += u32::from(expected[0].unwrap() > 0.0);
        }
    }
    assert!(growing > 4, "the axes miss the regions");
    let four = Axis::linear(Variable::Speed, (0.9, 1.6), 4).unwrap();
    let beside = scanned(&plan([
        Axis::linked(vec![depths.clone(), four.clone()]).unwrap()
    ]));
    for point in 0..4 {
        let expected = at(depths.value(0, point), four.value(0, point));
        for (number, expected) in expected.into_iter().enumerate() {
            assert_found(beside[number][point as usize], expected, ASKED[number]);
        }
    }
}

#[test]
fn the_growth_rate_is_above_zero_between_the_exact_ends_and_nowhere_else() {
    let rotor = Rotor::default();
    let of = |quantity: Quantity| quantity.evaluate(&rotor).unwrap();
    let regions = [
        [Quantity::SirExactLower, Quantity::SirExactUpper].map(of),
        [Quantity::CirExactLower, Quantity::CirExactUpper].map(of),
    ];
    let speeds = Axis::linear(Variable::Speed, (0.5, 2.0), 3001).unwrap();
    let found = &scanned(&plan([speeds.clone()]))[0];
    let c = rotor.coefficients().unwrap();
    for (index, found) in (0..).zip(found) {
        let speed = speeds.value(0, index);
        assert_eq!(*found, exact::growth_rate(&c, speed).ok());
        let within = regions
            .iter()
            .any(|[lower, upper]| (*lower..=*upper).contains(&speed));
        assert_eq!(found.unwrap() > 0.0, within, "{speed}");
    }
}

#[test]
fn reductions_go_over_the_speed() {
    let scan = [depths(), speeds()]
        .into_iter()
        .fold(Scan::of(&Rotor::default()), Scan::vary);
    let scan = scan.quantity(Quantity::GrowthRate);
    let greatest = Reduction::new(Statistic::Maximum).over(Variable::Speed);
    let plan = scan.reduce(greatest).plan().unwrap();
    let reduced = &plan.reduce(&Control::default()).unwrap().reduced[0];
    assert_eq!(reduced.groups(), 4);
    for group in 0..4 {
        let depth = depths().value(0, group);
        let all = (0..speeds().len()).map(|index| at(depth, speeds().value(0, index))[0].unwrap());
        assert_eq!(reduced.value(0, group), Some(all.fold(0.0, f64::max)));
    }
}

#[test]
fn without_a_speed_or_a_rotor_there_is_none() {
    let scan = Scan::of(&Rotor::default())
        .vary(depths())
        .quantity(Quantity::GrowthRate);
    let error = scan.plan().unwrap_err();
    assert_eq!(
        error,
        StudyError::NoSpeed {
            quantity: "growth_rate"
        }
        .into()
    );
    assert!(
        error
            .to_string()
            .starts_with("growth_rate is at a speed, which is not varied")
    );
    let reason = Quantity::GrowthRate
        .evaluate(&Rotor::default())
        .unwrap_err();
    assert_eq!(
        reason,
        InputError::NoSpeed {
            quantity: "growth_rate"
        }
        .into()
    );
    let not_allowed = Axis::linear(Variable::Speed, (0.0, 2.0), 3).unwrap_err();
    assert_eq!(
        not_allowed.to_string(),
        "value 1 of the axis of speed is 0; it must be > 0"
    );
    let asked = [Quantity::GrowthRate];
    let column = Column {
        input: NumericInput::find("crack_angle").unwrap(),
        values: &[0.0],
    };
    let refused = table::evaluate(&RotorParameters::PAPER, &[column], &asked).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "growth_rate is at a speed, and a table of rotors has none"
    );
    // With twice the diametral inertia and more, a disk is none.
    let inertia = NumericInput::find("disk_polar_inertia").unwrap();
    let wide = RotorParameters::PAPER.disk_diametral_inertia * 2.5;
    let scan = Scan::of(&Rotor::default()).vary(Axis::listed(inertia, vec![wide]).unwrap());
    let plan = scan
        .vary(speeds())
        .quantity(Quantity::GrowthRate)
        .plan()
        .unwrap();
    let chunk = plan.chunks().next().unwrap();
    assert_eq!(
        (chunk.counts().no_rotor, chunk.counts().missing[0]),
        (61, 61)
    );
}

#[test]
fn at_a_speed_that_is_drawn_and_not_allowed_there_is_no_growth_rate() {
    let wide = Distribution::Uniform {
        low: -1.0,
        high: 1.0,
    };
    let sampling = Sampling::Sobol { seed: 3 };
    let drawn = Axis::sampled(&[(Variable::Speed, wide)], 64, sampling).unwrap();
    let not_allowed = (0..64)
        .filter(|index| drawn.value(0, *index) <= 0.0)
        .count() as u64;
    assert!((28..=36).contains(&not_allowed));
    for axes in [vec![drawn.clone()], vec![drawn, depths()]] {
        let depths = axes.get(1).map_or(1, Axis::len);
        let plan = plan(axes);
        let chunk = plan.chunks().next().unwrap();
        let counts = chunk.counts();
        assert_eq!(counts.missing, [not_allowed * depths, 0, 0]);
        assert_eq!(counts.no_rotor, 0);
    }
}
