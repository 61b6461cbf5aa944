//! Chunks: consecutive points of a scan with their results.

use std::sync::Mutex;

use crate::batch::kernel::{Kernel, POINTS_PER_BLOCK};
use crate::batch::statistic::Reducer;
use crate::input::RotorParameters;

use super::Plan;
use super::axis::Axis;
use super::collected::Column;
use super::reduce::Reductions;
use super::space::Space;

/// The points of a chunk, give or take those of a block: chunks are cut where the axis inside of all others is cut into blocks.
/// The last chunk of a scan may have fewer.
pub const POINTS_PER_CHUNK: u64 = 1 << 17;

/// How many points a scan or a part of it has, and how many of them lack a quantity.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// How many points there are.
    pub points: u64,
    /// For each quantity how many points lack it, as where a region does not exist.
    pub missing: Vec<u64>,
    /// How many points are no rotor, as with $\beta > 2$. They lack every quantity.
    pub no_rotor: u64,
}

impl Counts {
    /// Creates counts of no points.
    pub fn none(quantities: usize) -> Self {
        Self {
            missing: vec![0; quantities],
            ..Self::default()
        }
    }

    /// Adds the counts of another part.
    pub fn add(&mut self, other: &Self) {
        self.points += other.points;
        self.no_rotor += other.no_rotor;
        for (sum, missing) in self.missing.iter_mut().zip(&other.missing) {
            *sum += missing;
        }
    }
}

/// Consecutive points of a scan with their results.
#[derive(Clone, Debug)]
pub struct Chunk<'a> {
    space: &'a Space,
    number: u64,
    first: u64,
    results: Vec<Vec<f64>>,
    counts: Counts,
}

impl<'a> Chunk<'a> {
    /// Which chunk of the scan it is, from 0.
    pub const fn number(&self) -> u64 {
        self.number
    }

    /// Its first point.
    pub const fn first(&self) -> u64 {
        self.first
    }

    /// How many points it has, at least one.
    #[expect(clippy::len_without_is_empty, reason = "a chunk is never empty")]
    pub const fn len(&self) -> usize {
        self.counts.points as usize
    }

    /// The points of which it is a part.
    pub const fn space(&self) -> &'a Space {
        self.space
    }

    /// How many of its points have no value.
    pub const fn counts(&self) -> &Counts {
        &self.counts
    }

    /// The values at its points of the variable number `column` of the axis number `axis`.
    pub fn values(&self, axis: usize, column: usize) -> Vec<f64> {
        let Some(varied) = self.space.axes().get(axis) else {
            return Vec::new();
        };
        let stride = self.space.stride(axis);
        let mut values = vec![f64::NAN; self.len()];
        let mut point = self.first;
        let mut rest = values.as_mut_slice();
        while !rest.is_empty() {
            let index = self.space.index(axis, point);
            let taken = if stride == 1 {
                // The innermost axis runs on to its end.
                let taken = to_usize(varied.len() - index).min(rest.len());
                varied.fill(column, index, &mut rest[..taken]);
                taken
            } else {
                // Others stand still.
                let taken = to_usize(stride - point % stride).min(rest.len());
                rest[..taken].fill(varied.value(column, index));
                taken
            };
            point += taken as u64;
            rest = rest.split_at_mut(taken).1;
        }
        values
    }

    /// The results of the quantity number `quantity`.
    pub fn quantity(&self, quantity: usize) -> Column<'_> {
        Column::of(&self.results, &self.counts, quantity)
    }
}

/// A store of kernels that wait for work: what they have tabulated serves the next chunk too.
pub(super) struct Kernels<'a> {
    plan: &'a Plan,
    waiting: Mutex<Vec<Kernel<'a>>>,
}

impl<'a> Kernels<'a> {
    /// Creates an empty store of kernels.
    pub(super) const fn new(plan: &'a Plan) -> Self {
        let waiting = Mutex::new(Vec::new());
        Self { plan, waiting }
    }

    fn take(&self) -> Option<Kernel<'a>> {
        let waiting = self
            .waiting
            .lock()
            .ok()
            .and_then(|mut waiting| waiting.pop());
        waiting.or_else(|| {
            let (outer, inner) = self.plan.space.outer_and_inner()?;
            let next = outer.last().map(Axis::variables);
            Some(Kernel::along(
                inner.variables(),
                next,
                &self.plan.quantities,
            ))
        })
    }

    fn give_back(&self, kernel: Kernel<'a>) {
        if let Ok(mut waiting) = self.waiting.lock() {
            waiting.push(kernel);
        }
    }
}

/// The first point of a chunk and how many it has.
pub(super) fn extent(plan: &Plan, number: u64) -> (u64, u64) {
    let first = start(&plan.space, number);
    (first, start(&plan.space, number + 1) - first)
}

/// The point at which a chunk starts: the first of the block that has the point after so many chunks. A block in two chunks would
/// have to be entered in both, and what is tabulated for whole blocks would not serve its parts.
fn start(space: &Space, number: u64) -> u64 {
    let point = number.saturating_mul(POINTS_PER_CHUNK);
    if point >= space.len() {
        return space.len();
    }
    let along = space.index(space.axes().len().saturating_sub(1), point);
    point - along % POINTS_PER_BLOCK as u64
}

/// Points of a chunk that lie in one row, a block of it at most.
struct Stretch {
    first: u64,
    points: usize,
    row: RotorParameters,
    speed: Option<f64>,
}

/// Goes through a chunk block by block; none where it is to stop. `work` is done with a kernel that is about the block; it
/// counts what is missing.
fn for_each_block(
    kernels: &Kernels<'_>,
    number: u64,
    stop: &dyn Fn() -> bool,
    mut work: impl FnMut(&mut Kernel<'_>, &Stretch, &mut Counts),
) -> Option<Counts> {
    let plan = kernels.plan;
    let (outer, inner) = plan.space.outer_and_inner()?;
    let (mut first, length) = extent(plan, number);
    let end = first + length;
    let mut kernel = kernels.take()?;
    let mut counts = Counts::none(plan.quantities.len());
    while first < end {
        if stop() {
            return None;
        }
        let (row, along) = (first / inner.len(), first % inner.len());
        // A chunk starts where a block starts and ends where one ends.
        let taken = (inner.len() - along).min(POINTS_PER_BLOCK as u64);
        let points = to_usize(taken);
        kernel.enter(along, points, |column, values| {
            inner.fill(column, along, values);
        });
        let (row, speed) = row_of(&plan.base, outer, row);
        counts.points += taken;
        let stretch = Stretch {
            first,
            points,
            row,
            speed,
        };
        work(&mut kernel, &stretch, &mut counts);
        first += taken;
    }
    kernels.give_back(kernel);
    Some(counts)
}

/// Reduces a chunk; none where it is to stop.
pub(super) fn reduce<'a>(
    kernels: &Kernels<'a>,
    number: u64,
    stop: &dyn Fn() -> bool,
) -> Option<(Counts, Reductions<'a>)> {
    let mut part = Reductions::of_chunk(kernels.plan, number);
    let mut reducer = part.reducer();
    let counts = for_each_block(kernels, number, stop, |kernel, block, counts| {
        let points = (block.first, block.points);
        let begin = |reducer: &mut Reducer| part.begin(points, reducer);
        counts.no_rotor += kernel.reduce(&block.row, block.speed, &mut reducer, begin);
        for (quantity, missing) in counts.missing.iter_mut().enumerate() {
            let present = reducer
                .summary(quantity)
                .map_or(0, |summary| summary.present);
            *missing += block.points as u64 - present;
        }
        part.end(block.first, &mut reducer);
    })?;
    Some((counts, part))
}

/// The inputs of a row, those of the inner axis as they are in the base rotor, and its speed where an outer axis has it.
fn row_of(base: &RotorParameters, outer: &[Axis], row: u64) -> (RotorParameters, Option<f64>) {
    let (mut parameters, mut speed) = (*base, None);
    let mut rest = row;
    for axis in outer.iter().rev() {
        let index = rest % axis.len();
        rest /= axis.len();
        for (column, variable) in axis.variables().enumerate() {
            variable.set(&mut parameters, &mut speed, axis.value(column, index));
        }
    }
    (parameters, speed)
}

/// Evaluates a chunk into slices of its length, one for each quantity; NaN marks points that have none.
pub(super) fn fill(
    kernels: &Kernels<'_>,
    number: u64,
    results: &mut [&mut [f64]],
    stop: &dyn Fn() -> bool,
) -> Option<Counts> {
    let (first, _) = extent(kernels.plan, number);
    for_each_block(kernels, number, stop, |kernel, block, counts| {
        let start = to_usize(block.first - first);
        let slices = results.iter_mut();
        let slices = slices.map(|result| &mut result[start..start + block.points]);
        let mut values: Vec<_> = slices.collect();
        let evaluated = kernel.evaluate(&block.row, block.speed, &mut values);
        counts.no_rotor += evaluated.no_rotor;
        if !evaluated.is_complete {
            for (missing, values) in counts.missing.iter_mut().zip(&values) {
                *missing += values.iter().filter(|value| value.is_nan()).count() as u64;
            }
        }
    })
}

/// Evaluates a chunk and keeps its results.
pub(super) fn evaluate<'a>(
    kernels: &Kernels<'a>,
    number: u64,
    stop: &dyn Fn() -> bool,
) -> Option<Chunk<'a>> {
    let plan = kernels.plan;
    let (first, length) = extent(plan, number);
    let mut results = vec![vec![f64::NAN; to_usize(length)]; plan.quantities.len()];
    let mut slices: Vec<&mut [f64]> = results.iter_mut().map(Vec::as_mut_slice).collect();
    let counts = fill(kernels, number, &mut slices, stop)?;
    Some(Chunk {
        space: &plan.space,
        number,
        first,
        results,
        counts,
    })
}

/// Converts a number of points of a chunk or a block, which is small.
fn to_usize(points: u64) -> usize {
    usize::try_from(points).unwrap_or(usize::MAX)
}
