//! Chunks: consecutive points of a scan with their results.

use std::sync::Mutex;

use crate::kernel::{Kernel, POINTS_PER_BLOCK};
use crate::quantity::Quantity;
use crate::rotor::RotorParameters;
use crate::summary::{Summary, Wanted};

use super::Plan;
use super::axis::Axis;
use super::space::Space;

/// The points of a chunk; the last one of a scan may have fewer.
pub const POINTS_PER_CHUNK: u64 = 1 << 17;

/// What a scan, or a part of it, came to.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Points.
    pub points: u64,
    /// For each quantity the points that have none, as where a region does not exist.
    pub missing: Vec<u64>,
    /// Points whose inputs together are no rotor, as with $\beta > 2$. They have no quantity.
    pub no_rotor: u64,
}

impl Counts {
    /// No points yet.
    pub fn none(quantities: usize) -> Self {
        Self {
            missing: vec![0; quantities],
            ..Self::default()
        }
    }

    /// Adds those of another part.
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
        Column {
            values: self.results.get(quantity).map_or(&[], Vec::as_slice),
            missing: self.counts.missing.get(quantity).copied().unwrap_or(0),
        }
    }
}

/// A quantity at the points of a chunk.
#[derive(Clone, Copy, Debug)]
pub struct Column<'a> {
    /// NaN where there is none; this mark does not leave this type.
    values: &'a [f64],
    missing: u64,
}

impl<'a> Column<'a> {
    /// Point by point, none where it does not exist.
    pub fn iter(self) -> impl ExactSizeIterator<Item = Option<f64>> + 'a {
        self.values
            .iter()
            .map(|&value| (!value.is_nan()).then_some(value))
    }

    /// All values, if it exists at every point.
    pub fn complete(self) -> Option<&'a [f64]> {
        (self.missing == 0).then_some(self.values)
    }

    /// How many points have none.
    pub const fn missing(self) -> u64 {
        self.missing
    }
}

/// A block that has been evaluated: consecutive points of one row.
pub(super) struct Block<'a> {
    /// Its first point.
    pub(super) first: u64,
    /// How many it has.
    pub(super) points: u64,
    /// What is known of it.
    pub(super) results: Results<'a>,
}

/// What is known of a block, for each quantity.
pub(super) enum Results<'a> {
    /// Its values, NaN where there is none.
    Values(&'a [&'a mut [f64]]),
    /// What was wanted of them. Every point has one.
    Summaries(&'a [Summary], &'a Wanted),
}

/// The kernels of a plan that wait for work: what they have tabulated serves the next chunk too.
pub(super) struct Kernels<'a> {
    plan: &'a Plan,
    waiting: Mutex<Vec<Kernel<'a>>>,
}

impl<'a> Kernels<'a> {
    /// None yet.
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
            let (_, inner) = self.plan.space.outer_and_inner()?;
            Some(Kernel::new(inner.variables(), &self.plan.quantities))
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
    let first = number * POINTS_PER_CHUNK;
    (first, POINTS_PER_CHUNK.min(plan.space.len() - first))
}

/// Evaluates a chunk block by block; none where it is to stop. Where what is `wanted` of it is enough, a block may
/// come without values.
pub(super) fn evaluate_blocks(
    kernels: &Kernels<'_>,
    number: u64,
    stop: &dyn Fn() -> bool,
    wanted: Option<&Wanted>,
    mut take: impl FnMut(&Block<'_>),
) -> Option<Counts> {
    let plan = kernels.plan;
    let (outer, inner) = plan.space.outer_and_inner()?;
    let (mut first, length) = extent(plan, number);
    let end = first + length;
    let mut kernel = kernels.take()?;
    let mut buffers = vec![vec![f64::NAN; POINTS_PER_BLOCK]; plan.quantities.len()];
    let mut counts = Counts::none(plan.quantities.len());
    while first < end {
        if stop() {
            return None;
        }
        let (row, along) = (first / inner.len(), first % inner.len());
        // Blocks start at multiples of their length on the inner axis, wherever chunks start.
        let block = POINTS_PER_BLOCK as u64;
        let taken = (block - along % block)
            .min(inner.len() - along)
            .min(end - first);
        let taken_here = to_usize(taken);
        kernel.enter(along, taken_here, |column, values| {
            inner.fill(column, along, values);
        });
        let (row, speed) = row_of(&plan.base, outer, row);
        counts.points += taken;
        let summaries = wanted.and_then(|wanted| Some((kernel.summaries(&row, wanted)?, wanted)));
        if let Some((summaries, wanted)) = summaries {
            let results = Results::Summaries(&summaries, wanted);
            let points = taken;
            take(&Block {
                first,
                points,
                results,
            });
        } else {
            let buffers = buffers.iter_mut().map(|buffer| &mut buffer[..taken_here]);
            let mut values: Vec<&mut [f64]> = buffers.collect();
            let evaluated = kernel.evaluate(&row, speed, &mut values);
            counts.no_rotor += evaluated.no_rotor;
            if !evaluated.is_complete {
                for (missing, values) in counts.missing.iter_mut().zip(&values) {
                    *missing += values.iter().filter(|value| value.is_nan()).count() as u64;
                }
            }
            let results = Results::Values(&values);
            let points = taken;
            take(&Block {
                first,
                points,
                results,
            });
        }
        first += taken;
    }
    kernels.give_back(kernel);
    Some(counts)
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

/// Evaluates a chunk and keeps its results.
pub(super) fn evaluate<'a>(
    kernels: &Kernels<'a>,
    number: u64,
    stop: &dyn Fn() -> bool,
) -> Option<Chunk<'a>> {
    let plan = kernels.plan;
    let (first, length) = extent(plan, number);
    let empty = |_: &Quantity| Vec::with_capacity(to_usize(length));
    let mut results: Vec<Vec<f64>> = plan.quantities.iter().map(empty).collect();
    let counts = evaluate_blocks(kernels, number, stop, None, |block| {
        if let Results::Values(values) = block.results {
            for (all, values) in results.iter_mut().zip(values) {
                all.extend_from_slice(values);
            }
        }
    })?;
    Some(Chunk {
        space: &plan.space,
        number,
        first,
        results,
        counts,
    })
}

/// A number of points of a chunk or a block, which are few.
fn to_usize(points: u64) -> usize {
    usize::try_from(points).unwrap_or(usize::MAX)
}
