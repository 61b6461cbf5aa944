//! Reductions against the values of the points: along every input, of every quantity, over axes inside and outside.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking too")]

use rotor_core::input::Variable;
use rotor_core::input::{INPUTS, NumericInput, RotorParameters};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::quantity::Quantity;
use rotor_core::study::{Axis, Control, Plan, Reduced, Reduction, Scan, Statistic};

const WIDTHS: [Quantity; 2] = [Quantity::SirWidth, Quantity::CirWidth];
const BINS: u32 = 8;

fn input(name: &str) -> &'static NumericInput {
    NumericInput::find(name).unwrap()
}

/// The results of a plan for a quantity, point by point.
fn scanned(plan: &Plan, quantity: usize) -> Vec<Option<f64>> {
    let chunks = plan.chunks();
    let values = chunks.map(|chunk| chunk.quantity(quantity).iter().collect::<Vec<_>>());
    values.flatten().collect()
}

/// What is reduced: a statistic of each kind, more thresholds and bins than one.
fn statistics((low, high): (f64, f64)) -> Vec<Statistic> {
    let at = |share: f64| low + share * (high - low);
    let mut statistics = vec![
        Statistic::Maximum,
        Statistic::Minimum,
        Statistic::ArgMaximum,
        Statistic::ArgMinimum,
        Statistic::Mean,
    ];
    statistics.extend([0.2, 0.4, 0.6, 0.8].map(|share| Statistic::CountAbove(at(share))));
    statistics.extend([0.25, 0.5].map(|share| Statistic::Histogram {
        low: at(share),
        high: at(0.9),
        bins: BINS,
    }));
    statistics
}

/// A sum that hardly rounds: what each addition loses is added too.
fn sum(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, lost) = values.fold((0.0, 0.0), |(sum, lost): (f64, f64), value: f64| {
        let next: f64 = sum + value;
        let (large, small) = if sum.abs() > value.abs() {
            (sum, value)
        } else {
            (value, sum)
        };
        (next, lost + ((large - next) + small))
    });
    sum + lost
}

/// Holds a reduction's group to the values of its points, which have these numbers.
fn assert_group(reduced: &Reduced, quantity: usize, group: u64, points: &[(u64, Option<f64>)]) {
    let name = reduced.reduction().to_string();
    let known = points
        .iter()
        .filter_map(|(point, value)| Some((*point, (*value)?)));
    let known: Vec<(u64, f64)> = known.collect();
    let values = known.iter().map(|(_, value)| *value);
    let extreme = |wanted: f64| {
        let first = known.iter().find(|(_, value)| *value == wanted);
        first.map(|(point, value)| (*point, *value))
    };
    let greatest = extreme(values.clone().fold(f64::NEG_INFINITY, f64::max));
    let least = extreme(values.clone().fold(f64::INFINITY, f64::min));
    let value = reduced.value(quantity, group);
    let count = known.len();
    match *reduced.reduction().statistic() {
        Statistic::Maximum => assert_eq!(value, greatest.map(|(_, value)| value), "{name}"),
        Statistic::Minimum => assert_eq!(value, least.map(|(_, value)| value), "{name}"),
        Statistic::ArgMaximum => {
            assert_eq!(
                reduced.point(quantity, group),
                greatest.map(|(point, _)| point),
                "{name}"
            );
        }
        Statistic::ArgMinimum => {
            assert_eq!(
                reduced.point(quantity, group),
                least.map(|(point, _)| point),
                "{name}"
            );
        }
        Statistic::Mean if count == 0 => assert_eq!(value, None, "{name}"),
        Statistic::Mean => {
            let mean = sum(values.clone()) / count as f64;
            let size = values.map(f64::abs).fold(0.0, f64::max);
            assert!(
                (value.unwrap() - mean).abs() <= 1e-14 * size,
                "{name}: {value:?} {mean}"
            );
        }
        Statistic::CountAbove(threshold) => {
            let above = values.filter(|value| *value > threshold).count();
            assert_eq!(value, Some(above as f64), "{name}");
        }
        Statistic::Histogram { low, high, bins } => {
            let ends = reduced.reduction().statistic().bin_ends();
            let mut expected = vec![0; bins as usize + 2];
            for value in values {
                let place = match ends.partition_point(|end| *end <= value) {
                    _ if value < low => 0,
                    _ if value > high => bins as usize + 1,
                    // The last one has both of its ends.
                    begun => begun.min(bins as usize),
                };
                expected[place] += 1;
            }
            assert_eq!(reduced.histogram(quantity, group), expected, "{name}");
        }
    }
}

/// Reduces quantities over the inner of two axes, over the outer one, and over both, and compares with their values.
fn assert_reduced(outer: &Axis, inner: &Axis, quantities: &[Quantity]) {
    let scan = Scan::of(&Rotor::default())
        .vary(outer.clone())
        .vary(inner.clone());
    let scan = quantities
        .iter()
        .fold(scan, |scan, quantity| scan.quantity(*quantity));
    let plan = scan.clone().plan().unwrap();
    let [over_outer, over_inner] = [outer, inner].map(|axis| axis.variables().next().unwrap());
    for (number, quantity) in quantities.iter().enumerate() {
        let values = scanned(&plan, number);
        let present = || values.iter().flatten().copied();
        let ends = (
            present().fold(f64::INFINITY, f64::min),
            present().fold(0.0, f64::max),
        );
        let ends = if ends.0 < ends.1 { ends } else { (0.0, 1.0) };
        let missing = values.iter().filter(|value| value.is_none()).count() as u64;
        let point = |point: u64| (point, values[point as usize]);
        let (rows, columns) = (outer.len(), inner.len());
        for over in [vec![over_inner], vec![over_outer], vec![]] {
            let reductions = statistics(ends).into_iter().map(|statistic| {
                let reduction = Reduction::new(statistic);
                over.iter()
                    .fold(reduction, |reduction, variable| reduction.over(*variable))
            });
            let plan = reductions.fold(scan.clone(), Scan::reduce).plan().unwrap();
            let report = plan.reduce(&Control::default()).unwrap();
            assert_eq!(report.counts.missing[number], missing, "{quantity}");
            for reduced in &report.reduced {
                for group in 0..reduced.groups() {
                    let points: Vec<_> = match over[..] {
                        [over] if over == over_inner => (group * columns..(group + 1) * columns)
                            .map(point)
                            .collect(),
                        [_] => (0..rows).map(|row| point(row * columns + group)).collect(),
                        _ => (0..rows * columns).map(point).collect(),
                    };
                    assert_group(reduced, number, group, &points);
                }
            }
        }
    }
}

/// Ends of an input between which both regions exist for the paper's rotor.
fn ends(input: &NumericInput) -> (f64, f64) {
    let value = (input.get)(&RotorParameters::PAPER);
    match input.name {
        "crack_depth_ratio" => (0.05, 0.4),
        "crack_angle" => (0.1, 3.0),
        "disk_asymmetry" => (0.05, 0.4),
        "shaft_poissons_ratio" => (0.1, 0.4),
        "disk_position_ratio" => (0.2, 0.4),
        "crack_position_ratio" => (0.1, 0.9),
        _ => (0.9 * value, 1.1 * value),
    }
}

#[test]
fn along_every_input_reductions_are_what_the_points_say() {
    for inner in &INPUTS {
        // An axis outside that leaves the coefficients as they are, and one that does not; rows that are no whole number of
        // packs.
        for outer in ["crack_angle", "shaft_length"].map(input) {
            if outer != inner {
                let outer = Axis::linear(outer, ends(outer), 7).unwrap();
                let inner = Axis::linear(inner, ends(inner), 197).unwrap();
                assert_reduced(&outer, &inner, &WIDTHS);
            }
        }
    }
}

#[test]
fn in_long_rows_reductions_are_what_the_points_say() {
    // Blocks and chunks that end within rows.
    let radii = Axis::linear(input("shaft_radius"), (0.009, 0.011), 31).unwrap();
    for name in ["crack_angle", "crack_depth_ratio"] {
        let inner = Axis::linear(input(name), ends(input(name)), 9001).unwrap();
        assert_reduced(&radii, &inner, &WIDTHS[..1]);
    }
}

#[test]
fn every_quantity_is_reduced_to_what_the_points_say() {
    let closed = Quantity::ALL
        .into_iter()
        .filter(|quantity| !quantity.needs_speed());
    let closed: Vec<_> = closed.collect();
    let asymmetries = Axis::linear(input("disk_asymmetry"), (0.1, 0.3), 3).unwrap();
    for name in ["crack_depth_ratio", "crack_angle", "disk_mass"] {
        let inner = Axis::linear(input(name), ends(input(name)), 43).unwrap();
        assert_reduced(&asymmetries, &inner, &closed);
    }
    let speeds = Axis::linear(Variable::Speed, (0.7, 1.4), 43).unwrap();
    let depths = Axis::linear(input("crack_depth_ratio"), (0.1, 0.4), 5).unwrap();
    assert_reduced(
        &depths,
        &speeds,
        &[Quantity::GrowthRate, Quantity::SirWidth],
    );
    assert_reduced(
        &speeds,
        &depths,
        &[Quantity::GrowthRate, Quantity::SirWidth],
    );
}

#[test]
fn points_without_a_quantity_take_no_part() {
    // Over beta = 2, beyond which there is no rotor, and a crack that may be none, whose region may be closed.
    let polar = Axis::linear(input("disk_polar_inertia"), (0.25, 0.31), 101).unwrap();
    let asymmetries = Axis::linear(input("disk_asymmetry"), (0.0, 0.3), 4).unwrap();
    let depths = Axis::linear(input("crack_depth_ratio"), (0.0, 0.4), 101).unwrap();
    let asked = [Quantity::SirWidth, Quantity::CirWidth, Quantity::CirStart];
    assert_reduced(&asymmetries, &polar, &asked);
    assert_reduced(&polar, &asymmetries, &asked);
    assert_reduced(&asymmetries, &depths, &asked[..2]);
    let ends = [Quantity::SirExactLower, Quantity::CirExactUpper];
    assert_reduced(
        &asymmetries,
        &Axis::linear(input("disk_polar_inertia"), (0.25, 0.31), 11).unwrap(),
        &ends,
    );
}

#[test]
fn of_three_axes_any_are_reduced_over_several_chunks() {
    let axes = [
        ("crack_depth_ratio", 5),
        ("crack_position_ratio", 7),
        ("crack_angle", 5003),
    ];
    let lengths = axes.map(|(_, length)| length);
    let scan = axes
        .iter()
        .fold(Scan::of(&Rotor::default()), |scan, (name, length)| {
            scan.vary(Axis::linear(input(name), ends(input(name)), *length).unwrap())
        });
    let scan = scan.quantity(Quantity::CirWidth);
    let values = scanned(&scan.clone().plan().unwrap(), 0);
    assert!(values.len() as u64 > rotor_core::study::POINTS_PER_CHUNK);
    for reduced_axes in [
        vec![0],
        vec![1],
        vec![2],
        vec![0, 1],
        vec![0, 2],
        vec![1, 2],
    ] {
        let reductions = statistics((0.0, 0.2)).into_iter().map(|statistic| {
            let names = reduced_axes.iter().map(|axis| input(axes[*axis].0));
            names.fold(Reduction::new(statistic), Reduction::over)
        });
        let plan = reductions.fold(scan.clone(), Scan::reduce).plan().unwrap();
        let report = plan.reduce(&Control::default()).unwrap();
        let mut groups = vec![Vec::new(); report.reduced[0].groups() as usize];
        for (point, value) in (0..).zip(&values) {
            let mut rest: u64 = point;
            let (mut group, mut stride) = (0, 1);
            for axis in (0..3).rev() {
                let index = rest % lengths[axis];
                rest /= lengths[axis];
                if !reduced_axes.contains(&axis) {
                    group += index * stride;
                    stride *= lengths[axis];
                }
            }
            groups[group as usize].push((point, *value));
        }
        for reduced in &report.reduced {
            // Of the many groups along the angle a part.
            for (group, points) in groups.iter().enumerate().step_by(13) {
                assert_group(reduced, 0, group as u64, points);
            }
        }
    }
}

#[test]
fn a_histogram_of_more_bins_than_a_row_has_points_is_what_they_say() {
    let scan = Scan::of(&Rotor::default())
        .vary(Axis::linear(input("shaft_length"), (0.4, 0.6), 50).unwrap())
        .vary(Axis::linear(input("crack_angle"), (0.0, 3.0), 19).unwrap())
        .quantity(Quantity::SirWidth);
    let values = scanned(&scan.clone().plan().unwrap(), 0);
    let bins = 10_000;
    let (low, high) = (0.01, 0.15);
    let statistic = Statistic::Histogram { low, high, bins };
    for over in [vec![], vec![input("crack_angle")]] {
        let reduction = over
            .iter()
            .fold(Reduction::new(statistic), |reduction, over| {
                reduction.over(*over)
            });
        let plan = scan.clone().reduce(reduction).plan().unwrap();
        let reduced = plan.reduce(&Control::default()).unwrap().reduced;
        let size = values.len() / reduced[0].groups() as usize;
        for (group, values) in values.chunks(size).enumerate() {
            let points: Vec<_> = (0..).zip(values.iter().copied()).collect();
            assert_group(&reduced[0], 0, group as u64, &points);
        }
    }
}

#[test]
fn more_blocks_than_are_kept_are_what_the_points_say() {
    // Of an axis with coefficients of its own, and of one without.
    for (name, length) in [
        ("crack_depth_ratio", 9 * 4096 + 1),
        ("crack_angle", 97 * 4096 + 1),
    ] {
        let scan = Scan::of(&Rotor::default())
            .vary(Axis::listed(input("disk_asymmetry"), vec![0.1, 0.2]).unwrap())
            .vary(Axis::linear(input(name), ends(input(name)), length).unwrap())
            .quantity(Quantity::SirWidth);
        let values = scanned(&scan.clone().plan().unwrap(), 0);
        let reduction = |statistic| Reduction::new(statistic).over(input(name));
        let scan = scan
            .reduce(reduction(Statistic::ArgMaximum))
            .reduce(reduction(Statistic::Mean));
        let report = scan.plan().unwrap().reduce(&Control::default()).unwrap();
        for (group, first) in [(0, 0), (1, length)] {
            let points: Vec<_> = (first..first + length)
                .map(|point| (point, values[point as usize]))
                .collect();
            for reduced in &report.reduced {
                assert_group(reduced, 0, group, &points);
            }
        }
    }
}

#[test]
fn reductions_over_axes_inside_and_outside_are_the_same_together_and_alone() {
    let scan = |over: &[&str]| {
        let depths = Axis::linear(input("crack_depth_ratio"), (0.0, 0.4), 57).unwrap();
        let angles = Axis::linear(input("crack_angle"), (0.0, 3.0), 4999).unwrap();
        let scan = Scan::of(&Rotor::default()).vary(depths).vary(angles);
        let scan = WIDTHS.iter().fold(scan, |scan, q| scan.quantity(*q));
        let reductions = over
            .iter()
            .map(|over| Reduction::new(Statistic::ArgMaximum).over(input(over)));
        let plan = reductions.fold(scan, Scan::reduce).plan().unwrap();
        [1, 2].map(|threads| {
            let threads = Some(threads);
            let control = Control {
                threads,
                ..Control::default()
            };
            let reduced = plan.reduce(&control).unwrap().reduced;
            let values = reduced.iter().flat_map(|reduced| {
                let groups = 0..reduced.groups();
                groups.map(|group| (reduced.value(1, group), reduced.point(1, group)))
            });
            values.collect::<Vec<_>>()
        })
    };
    let [together, on_two_threads] = scan(&["crack_angle", "crack_depth_ratio"]);
    assert_eq!(together, on_two_threads);
    let alone: Vec<_> = ["crack_angle", "crack_depth_ratio"]
        .iter()
        .flat_map(|over| scan(&[over])[0].clone())
        .collect();
    assert_eq!(together, alone);
}

#[test]
fn extremes_over_the_angle_alone_are_those_of_the_points() {
    let scan = |statistics: &[Statistic]| {
        let depths = Axis::listed(input("crack_depth_ratio"), vec![0.0, 0.1, 0.35]).unwrap();
        let angles = Axis::linear(input("crack_angle"), (0.0, 3.0), 9001).unwrap();
        let scan = Scan::of(&Rotor::default()).vary(depths).vary(angles);
        let scan = WIDTHS.iter().fold(scan, |scan, q| scan.quantity(*q));
        let over = |statistic: &Statistic| Reduction::new(*statistic).over(input("crack_angle"));
        let reductions = statistics.iter().map(over);
        let plan = reductions.fold(scan, Scan::reduce).plan().unwrap();
        plan.reduce(&Control::default()).unwrap()
    };
    // Of the squares, and of the widths for the sake of the mean.
    let extremes = scan(&[Statistic::Maximum, Statistic::Minimum]);
    let of_widths = scan(&[Statistic::Maximum, Statistic::Minimum, Statistic::Mean]);
    for (found, expected) in extremes.reduced.iter().zip(&of_widths.reduced) {
        for group in 0..3 {
            for quantity in 0..2 {
                let [found, expected] =
                    [found, expected].map(|all| all.value(quantity, group).unwrap());
                assert!((found / expected - 1.0).abs() < 1e-15, "{found} {expected}");
            }
        }
    }
    assert_eq!(extremes.counts, of_widths.counts);
}
