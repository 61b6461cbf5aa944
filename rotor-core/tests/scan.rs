//! Scans against point-by-point evaluation, and against themselves on other numbers of threads.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking too")]

use std::f64::consts::PI;
use std::sync::Mutex;

use rotor_core::error::StudyError;
use rotor_core::input::NumericInput;
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::quantity::Quantity;
use rotor_core::study::{
    Axis, Cancel, Chunk, Control, Counts, Distribution, Plan, Reduced, Reduction, Sampling, Scan,
    Sink, Statistic, Stopped,
};

fn input(name: &str) -> &'static NumericInput {
    NumericInput::find(name).unwrap()
}

fn linear(name: &str, ends: (f64, f64), count: u64) -> Axis {
    Axis::linear(input(name), ends, count).unwrap()
}

fn threads(threads: usize) -> Control<'static> {
    Control {
        threads: Some(threads),
        ..Control::default()
    }
}

/// Depths × positions × angles, where some rotors have no combination region.
fn grid() -> Scan {
    Scan::of(&Rotor::default())
        .vary(linear("crack.depth_ratio", (0.3, 0.0), 4))
        .vary(linear("disk.polar_inertia", (0.2, 0.2794), 3))
        .vary(linear("crack.angle", (0.0, PI), 5))
        .quantity(Quantity::SirWidth)
        .quantity(Quantity::CirWidth)
}

/// The inputs and the quantities of a point.
type Point = (Vec<f64>, Vec<Option<f64>>);

/// All points of a plan.
fn points(plan: &Plan) -> Vec<Point> {
    let mut points = Vec::new();
    for chunk in plan.chunks() {
        let axes = plan.space().axes().iter().enumerate();
        let inputs: Vec<_> = axes
            .flat_map(|(number, axis)| {
                (0..axis.variables().len()).map(move |column| (number, column))
            })
            .map(|(number, column)| chunk.values(number, column))
            .collect();
        let quantities: Vec<Vec<_>> = (0..plan.quantities().len())
            .map(|quantity| chunk.quantity(quantity).iter().collect())
            .collect();
        for point in 0..chunk.len() {
            points.push((
                inputs.iter().map(|values| values[point]).collect(),
                quantities.iter().map(|values| values[point]).collect(),
            ));
        }
    }
    points
}

#[test]
fn every_point_is_what_its_rotor_alone_has() {
    let plan = grid().plan().unwrap();
    let points = points(&plan);
    assert_eq!(points.len(), 60);
    for (inputs, values) in &points {
        let rotor = Rotor::default()
            .with(|p| {
                p.crack_depth_ratio = inputs[0];
                p.disk_polar_inertia = inputs[1];
                p.crack_angle = inputs[2];
            })
            .unwrap();
        let expected: Vec<_> = plan
            .quantities()
            .iter()
            .map(|quantity| quantity.evaluate(&rotor).ok())
            .collect();
        for (value, expected) in values.iter().zip(&expected) {
            assert_eq!(value.is_some(), expected.is_some(), "{inputs:?}");
            let difference = value.unwrap_or(0.0) - expected.unwrap_or(0.0);
            // Closed regions, of width 1e-17, have no digits; the widest is 0.1 wide.
            assert!(difference.abs() < 1e-13, "{inputs:?}: {difference:e}");
        }
    }
    let missing = points.iter().filter(|(_, values)| values[1].is_none());
    assert_eq!(missing.count(), 20, "no combination region at beta = 2");
    let counts = plan.reduce(&Control::default()).unwrap().counts;
    let expected = Counts {
        points: 60,
        missing: vec![0, 20],
        no_rotor: 0,
    };
    assert_eq!(counts, expected);
}

#[test]
fn reductions_are_those_of_the_points() {
    let over = |statistic, names: &[&str]| {
        let reduction = Reduction::new(statistic);
        names
            .iter()
            .fold(reduction, |reduction, name| reduction.over(input(name)))
    };
    let all_axes = ["crack.depth_ratio", "disk.polar_inertia", "crack.angle"];
    let choices: [&[usize]; 5] = [&[], &[0], &[1], &[2], &[0, 2]];
    for reduced_axes in choices {
        let names: Vec<_> = reduced_axes.iter().map(|&axis| all_axes[axis]).collect();
        let plan = [
            Statistic::Maximum,
            Statistic::ArgMinimum,
            Statistic::Mean,
            Statistic::CountAbove(0.1),
            Statistic::Histogram {
                low: 0.0,
                high: 0.5,
                bins: 4,
            },
        ]
        .into_iter()
        .fold(grid(), |scan, statistic| {
            scan.reduce(over(statistic, &names))
        })
        .plan()
        .unwrap();
        let report = plan.reduce(&Control::default()).unwrap();
        let points = points(&plan);
        for quantity in 0..2 {
            for group in 0..report.reduced[0].groups() {
                check_group(&plan, &report.reduced, &points, (quantity, group));
            }
        }
    }
}

/// Holds what five reductions say of a group against its points.
fn check_group(
    plan: &Plan,
    reduced: &[Reduced],
    points: &[Point],
    (quantity, group): (usize, u64),
) {
    let in_group = |point: u64| {
        reduced[0].kept().into_iter().all(|axis| {
            reduced[0].index(plan.space(), axis, group) == Some(plan.space().index(axis, point))
        })
    };
    let values: Vec<(u64, f64)> = (0..60)
        .filter(|&point| in_group(point))
        .filter_map(|point| Some((point, points[point as usize].1[quantity]?)))
        .collect();
    let value = |index: usize| reduced[index].value(quantity, group);
    let all = || values.iter().map(|(_, value)| *value);
    assert_eq!(value(0), all().reduce(f64::max));
    assert_eq!(value(1), all().reduce(f64::min));
    let least = values
        .iter()
        .find(|(_, value)| Some(*value) == all().reduce(f64::min));
    assert_eq!(
        reduced[1].point(quantity, group),
        least.map(|(point, _)| *point)
    );
    let mean = (!values.is_empty()).then(|| all().sum::<f64>() / values.len() as f64);
    match (value(2), mean) {
        (Some(found), Some(mean)) => assert!((found - mean).abs() < 1e-15),
        (found, mean) => assert_eq!(found, mean),
    }
    assert_eq!(
        value(3),
        Some(all().filter(|&value| value > 0.1).count() as f64)
    );
    let histogram = reduced[4].histogram(quantity, group);
    assert_eq!(histogram.iter().sum::<u64>(), values.len() as u64);
}

/// A sample that spans several chunks, some of its points no rotor.
fn sample(sampling: Sampling) -> Plan {
    let normal = |mean, deviation| Distribution::Normal { mean, deviation };
    let draws = [
        (input("disk.asymmetry"), normal(0.2, 0.01)),
        (input("disk.polar_inertia"), normal(0.26, 0.01)),
    ];
    Scan::of(&Rotor::default())
        .vary(Axis::sampled(&draws, 300_000, sampling).unwrap())
        .quantity(Quantity::Beta)
        .reduce(Reduction::new(Statistic::Mean))
        .reduce(Reduction::new(Statistic::ArgMaximum))
        .reduce(Reduction::new(Statistic::Histogram {
            low: 1.5,
            high: 2.0,
            bins: 10,
        }))
        .plan()
        .unwrap()
}

#[test]
fn the_number_of_threads_changes_nothing() {
    for sampling in [Sampling::Random { seed: 7 }, Sampling::Sobol { seed: 7 }] {
        let plan = sample(sampling);
        let state = |control: &Control<'_>| {
            let mut last = Vec::new();
            let report = plan
                .reduce_from(0, Counts::none(1), &[], control, |saved| {
                    last = saved.reductions.to_bytes();
                })
                .unwrap();
            (last, report.counts)
        };
        let alone = state(&threads(1));
        assert_eq!(alone, state(&threads(3)));
        assert!(
            alone.1.no_rotor > 1_000,
            "beta > 2 at a tail: {:?}",
            alone.1
        );
        assert_eq!(alone.1.missing, [alone.1.no_rotor]);
    }
}

#[test]
fn a_run_that_goes_on_from_a_state_ends_as_one_without_a_break() {
    let plan = sample(Sampling::Random { seed: 1 });
    let mut states = Vec::new();
    let whole = plan
        .reduce_from(0, Counts::none(1), &[], &threads(2), |saved| {
            states.push((
                saved.chunk,
                saved.counts.clone(),
                saved.reductions.to_bytes(),
            ));
        })
        .unwrap();
    assert_eq!(states.len(), 3);
    for (chunk, counts, state) in &states {
        let mut last = state.clone();
        let report = plan
            .reduce_from(*chunk, counts.clone(), state, &threads(2), |saved| {
                last = saved.reductions.to_bytes();
            })
            .unwrap();
        assert_eq!((report.counts, &last), (whole.counts.clone(), &states[2].2));
    }
    let damaged = &states[0].2[1..];
    let refused = plan.reduce_from(1, Counts::none(1), damaged, &threads(1), |_| {});
    assert_eq!(refused.unwrap_err(), StudyError::ForeignState.into());
}

/// Keeps the first point of each chunk, refuses one, has one already.
struct Firsts {
    taken: Mutex<Vec<u64>>,
    refused: Option<u64>,
    finished: Option<u64>,
}

impl Sink for Firsts {
    type Encoded = u64;
    type Error = u64;

    fn finished(&self, number: u64) -> Option<Counts> {
        (self.finished == Some(number)).then(|| Counts::none(1))
    }

    fn encode(&self, chunk: &Chunk<'_>) -> Result<u64, u64> {
        Ok(chunk.first())
    }

    fn take(&self, number: u64, first: u64) -> Result<(), u64> {
        if self.refused == Some(number) {
            return Err(number);
        }
        self.taken.lock().unwrap().push(first);
        Ok(())
    }
}

#[test]
fn sinks_take_chunks_in_order_and_can_refuse_or_have_them() {
    let plan = sample(Sampling::Random { seed: 0 });
    let sink = |refused, finished| Firsts {
        taken: Mutex::new(Vec::new()),
        refused,
        finished,
    };
    let all = sink(None, None);
    assert_eq!(plan.write_to(&all, &threads(3)).unwrap().points, 300_000);
    assert_eq!(*all.taken.lock().unwrap(), [0, 131_072, 262_144]);
    let some = sink(None, Some(1));
    plan.write_to(&some, &threads(3)).unwrap();
    assert_eq!(*some.taken.lock().unwrap(), [0, 262_144]);
    let refusing = sink(Some(1), None);
    assert_eq!(plan.write_to(&refusing, &threads(3)), Err(Stopped::Sink(1)));
    assert_eq!(*refusing.taken.lock().unwrap(), [0]);
}

#[test]
fn a_cancelled_scan_stops_and_says_how_far_it_came() {
    let plan = sample(Sampling::Random { seed: 0 });
    let cancel = Cancel::default();
    let after_one = |_| cancel.cancel();
    let control = Control {
        threads: Some(1),
        cancel: cancel.clone(),
        progress: Some(&after_one),
    };
    let stopped = plan.reduce(&control).unwrap_err();
    assert_eq!(stopped, StudyError::Cancelled { chunks: 1, all: 3 }.into());
}

#[test]
fn linked_inputs_run_together_and_the_inner_axis_can_be_long() {
    let both = Axis::linked(vec![
        linear("disk.asymmetry", (0.0, 0.2), 140_000),
        linear("crack.depth_ratio", (0.1, 0.3), 140_000),
    ]);
    let plan = Scan::of(&Rotor::default())
        .vary(both.unwrap())
        .quantity(Quantity::Beta)
        .plan()
        .unwrap();
    let points = points(&plan);
    assert_eq!(points.len(), 140_000);
    let (inputs, values) = &points[139_999];
    assert_eq!(inputs, &[0.2, 0.3]);
    assert!((values[0].unwrap() - 1.50036).abs() < 1e-5);
}

#[test]
fn a_scan_that_cannot_be_says_why() {
    let text = |scan: Scan| scan.plan().unwrap_err().to_string();
    let empty = Scan::of(&Rotor::default());
    assert!(text(empty.clone()).contains("no quantity"));
    assert!(text(empty.quantity(Quantity::Beta)).contains("nothing is varied"));
    let angle = || linear("crack.angle", (0.0, 1.0), 2);
    assert!(text(grid().vary(angle())).contains("crack_angle is varied twice"));
    let over = Reduction::new(Statistic::Maximum).over(input("disk.mass"));
    assert_eq!(
        text(grid().reduce(over)),
        "the reduction max:disk_mass is over disk_mass, which is not varied; varied are \
         crack_depth_ratio, disk_polar_inertia, crack_angle"
    );
    let histogram = Statistic::Histogram {
        low: 1.0,
        high: 0.0,
        bins: 3,
    };
    assert!(text(grid().reduce(Reduction::new(histogram))).contains("ends must be finite"));
    assert!(
        text(grid().reduce(Reduction::new(Statistic::CountAbove(f64::NAN)))).contains("threshold")
    );
    let many = Scan::of(&Rotor::default())
        .vary(linear("crack.depth_ratio", (0.0, 0.4), 10_000_000))
        .vary(angle())
        .quantity(Quantity::Beta)
        .reduce(Reduction::new(Statistic::Maximum).over(input("crack.angle")));
    assert!(text(many).contains("keep 10000000 results"));
}

#[test]
fn what_is_collected_is_what_chunks_have() {
    // The axis is longer than a chunk, and no rigid body is at its end.
    let polar = NumericInput::find("disk_polar_inertia").unwrap();
    let scan = Scan::of(&Rotor::default()).vary(Axis::linear(polar, (0.2, 0.3), 150_000).unwrap());
    let scan = scan
        .quantity(Quantity::SirWidth)
        .quantity(Quantity::CirWidth);
    let plan = scan.plan().unwrap();
    let mut collected = plan.collect(&Control::default()).unwrap();
    let mut point = 0;
    for chunk in plan.chunks() {
        for place in 0..2 {
            let of_chunk = chunk.quantity(place).iter();
            for (offset, value) in of_chunk.enumerate() {
                assert_eq!(collected.column(place).get(point + offset), value);
            }
        }
        point += chunk.len();
    }
    assert_eq!(point, collected.column(0).len());
    let [simple, combination] = [0, 1].map(|place| collected.column(place));
    assert!(simple.complete().is_none() && combination.complete().is_none());
    let missing = combination.validity().filter(|exists| !exists).count();
    assert_eq!(missing as u64, collected.counts().missing[1]);
    assert!(missing > 0 && collected.counts().no_rotor > 0);

    let cancel = Cancel::default();
    cancel.cancel();
    let stopped = Control {
        cancel,
        ..Control::default()
    };
    assert!(plan.collect_into(&mut collected, &stopped).is_err());
    assert!(collected.column(0).is_empty());
    plan.collect_into(
        &mut collected,
        &Control {
            threads: Some(1),
            ..Control::default()
        },
    )
    .unwrap();
    assert_eq!(collected.column(0).len(), 150_000);
}

#[test]
fn more_than_memory_has_is_not_collected() {
    let [depth, angle] =
        ["crack_depth_ratio", "crack_angle"].map(|name| NumericInput::find(name).unwrap());
    let scan = Scan::of(&Rotor::default()).vary(Axis::linear(depth, (0.0, 0.4), 1 << 20).unwrap());
    let scan = scan.vary(Axis::linear(angle, (0.0, 1.0), 1 << 13).unwrap());
    let refused = scan
        .quantity(Quantity::SirWidth)
        .plan()
        .unwrap()
        .collect(&Control::default());
    assert_eq!(
        refused.unwrap_err().to_string(),
        "8589934592 numbers are more than can be collected in memory; the most is 4294967296 (2^32). Write them to a \
         file, or reduce them"
    );
}
