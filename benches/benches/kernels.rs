//! Times of single kernels: `cargo bench -p rotor-benches`.
#![allow(
    missing_docs,
    reason = "criterion's macros define functions without documentation"
)]

use std::hint::black_box;
use std::time::Duration;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use rotor_benches::cases::{Bench, CASES, Sizes};
use rotor_benches::corpus::{chemistry, geometry, robotics};
use rotor_core::equations::{
    cir_width, coefficients, crack_compliance, phi, sir_width, stiffness, support_arm,
    widths_support_arm,
};
use rotor_core::input::RotorParameters;
use rotor_core::jeffcott::rotor::Rotor;

/// Small, so that one sample of the largest case takes some milliseconds.
const SIZES: Sizes = Sizes {
    grid: 128,
    max_rows: 16,
    max_angles: 1024,
};

/// The cases of the comparison with other tools, per point.
fn cases(criterion: &mut Criterion) {
    let mut bench = Bench::new(SIZES);
    let mut group = criterion.benchmark_group("cases");
    for case in &CASES {
        group.throughput(Throughput::Elements((case.points)(&SIZES) as u64));
        group.bench_function(case.name, |bencher| bencher.iter(|| (case.run)(&mut bench)));
    }
    group.finish();
}

/// Scalar forms of the rotor's formulas.
fn rotor(criterion: &mut Criterion) {
    let p = RotorParameters::PAPER;
    let s = support_arm(&p);
    let compliance = crack_compliance::value(&p, 32.0);
    let k = stiffness::value(&p, &s, &compliance);
    let c = coefficients::value(&p, &k);
    let mut group = criterion.benchmark_group("rotor");
    group.bench_function("stiffness", |b| {
        b.iter(|| stiffness::value(black_box(&p), &s, &compliance))
    });
    group.bench_function("coefficients", |b| {
        b.iter(|| coefficients::value(&p, black_box(&k)))
    });
    group.bench_function("phi", |b| b.iter(|| phi::value(black_box(0.7), 0.8, &c)));
    group.bench_function("phi_hessian", |b| {
        b.iter(|| phi::hessian(black_box(0.7), 0.8, &c))
    });
    group.bench_function("sir_width", |b| b.iter(|| sir_width::value(black_box(&c))));
    group.bench_function("sir_width_gradient", |b| {
        b.iter(|| sir_width::gradient(black_box(&c)))
    });
    group.bench_function("cir_width", |b| b.iter(|| cir_width::value(black_box(&c))));
    group.bench_function("cir_width_gradient", |b| {
        b.iter(|| cir_width::gradient(black_box(&c)))
    });
    group.bench_function("widths", |b| {
        b.iter(|| widths_support_arm::value(black_box(&p), 32.0))
    });
    group.bench_function("widths_gradient", |b| {
        b.iter(|| widths_support_arm::gradient(black_box(&p), 32.0));
    });
    group.bench_function("validation", |b| {
        b.iter_batched(|| p, Rotor::new, BatchSize::SmallInput);
    });
    group.finish();
}

/// Scalar gradients of some formulas of the corpus.
fn corpus(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("corpus");
    group.bench_function("quaternion_rotation", |b| {
        b.iter(|| {
            robotics::quaternion_rotation::gradient(
                black_box([0.1, 0.2, 0.3, 0.9]),
                [1.0, 2.0, 3.0],
            )
        });
    });
    group.bench_function("peng_robinson", |b| {
        b.iter(|| chemistry::peng_robinson::gradient(black_box(300.0), 1e-3, 304.1, 7.38e6, 0.225));
    });
    group.bench_function("circumradius", |b| {
        b.iter(|| geometry::circumradius::gradient(black_box(3.0), 4.0, 5.0));
    });
    group.finish();
}

criterion_group! {
    name = kernels;
    config = Criterion::default().sample_size(20).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(1));
    targets = cases, rotor, corpus
}
criterion_main!(kernels);
