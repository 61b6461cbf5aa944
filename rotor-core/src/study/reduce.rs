//! Reductions: what is kept of a scan's points, per group of points.
//!
//! Each chunk is reduced alone, the parts are merged in the order of the chunks. The result
//! therefore does not depend on the number of threads, not by a bit.

mod cells;

use std::fmt;

use crate::batch::statistic::{Accumulator, Reducer, Statistic, Wanted};
use crate::input::Variable;

use super::Plan;
use super::chunk;
use super::space::Space;
use crate::error::{Error, StudyError};

use cells::{Cell, Cells};

/// The most results, over all reductions, quantities, groups and bins, that are kept in memory.
pub const MOST_RESULTS: u64 = 1 << 21;

/// The most bins of a histogram.
pub const MOST_BINS: u32 = 1 << 16;

/// How a state is laid out; another number where that changes.
const LAYOUT: u8 = 3;

/// Refuses thresholds and bins that are none.
fn check(statistic: Statistic) -> Result<(), Error> {
    match statistic {
        Statistic::CountAbove(value) if !value.is_finite() => {
            Err(StudyError::Threshold { value }.into())
        }
        Statistic::Histogram { low, high, bins }
            if !(low.is_finite() && (high - low).is_finite() && low < high)
                || bins == 0
                || bins > MOST_BINS =>
        {
            Err(StudyError::Histogram {
                low,
                high,
                bins,
                most: MOST_BINS,
            }
            .into())
        }
        _ => Ok(()),
    }
}

/// A statistic over some axes; what remains are groups, one for each combination of the other axes'
/// values.
#[derive(Clone, Debug, PartialEq)]
pub struct Reduction {
    statistic: Statistic,
    over: Vec<Variable>,
}

impl Reduction {
    /// A reduction over all axes: one group.
    pub const fn new(statistic: Statistic) -> Self {
        Self {
            statistic,
            over: Vec::new(),
        }
    }

    /// Only over the axis of this variable, and of others given so.
    #[must_use]
    pub fn over(mut self, variable: impl Into<Variable>) -> Self {
        self.over.push(variable.into());
        self
    }

    /// The statistic.
    pub const fn statistic(&self) -> &Statistic {
        &self.statistic
    }
}

/// `max`, `max:crack_angle`, `mean:crack_angle+disk_mass`.
impl fmt::Display for Reduction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.statistic)?;
        for (index, variable) in self.over.iter().enumerate() {
            let separator = if index == 0 { ':' } else { '+' };
            write!(f, "{separator}{}", variable.name())?;
        }
        Ok(())
    }
}

/// A reduction with the groups that it has in a space.
#[derive(Clone, Debug)]
pub(super) struct Grouping {
    reduction: Reduction,
    /// For each axis how many groups there are between two of its values, 0 if it is reduced.
    strides: Vec<u64>,
    groups: u64,
    /// Cells of a group.
    width: usize,
}

/// Finds the groups of all reductions.
pub(super) fn groupings(
    reductions: &[Reduction],
    space: &Space,
    quantities: usize,
) -> Result<Vec<Grouping>, Error> {
    let groupings: Vec<Grouping> = reductions
        .iter()
        .map(|reduction| grouping(reduction, space))
        .collect::<Result<_, _>>()?;
    let cells = groupings
        .iter()
        .map(|grouping| grouping.groups.saturating_mul(grouping.width as u64))
        .fold(0, u64::saturating_add)
        .saturating_mul(quantities as u64);
    if cells > MOST_RESULTS {
        let most = MOST_RESULTS;
        return Err(StudyError::TooManyResults { cells, most }.into());
    }
    Ok(groupings)
}

fn grouping(reduction: &Reduction, space: &Space) -> Result<Grouping, Error> {
    check(reduction.statistic)?;
    let axes = space.axes();
    if let Some(missing) = reduction
        .over
        .iter()
        .find(|&&variable| !axes.iter().any(|axis| axis.varies(variable)))
    {
        let variables = axes.iter().flat_map(super::Axis::variables);
        let varied: Vec<_> = variables.map(Variable::name).collect();
        return Err(StudyError::NotVaried {
            reduction: reduction.to_string(),
            input: missing.name(),
            varied: varied.join(", "),
        }
        .into());
    }
    let mut strides = vec![0; axes.len()];
    let mut groups = 1;
    for (axis, stride) in axes.iter().zip(&mut strides).rev() {
        let all = reduction.over.is_empty();
        if !all && !reduction.over.iter().any(|&variable| axis.varies(variable)) {
            *stride = groups;
            groups *= axis.len();
        }
    }
    let width = match reduction.statistic {
        Statistic::Histogram { bins, .. } => bins as usize + 2,
        _ => 1,
    };
    Ok(Grouping {
        reduction: reduction.clone(),
        strides,
        groups,
        width,
    })
}

impl Grouping {
    /// The reduction.
    pub(super) const fn reduction(&self) -> &Reduction {
        &self.reduction
    }

    /// Whether the points of a block are of one group.
    fn reduces_inner_axis(&self) -> bool {
        self.strides.last() == Some(&0)
    }

    /// Whether a block is taken as a whole. It is point by point where its points are of different groups, and for a histogram
    /// of so many bins that they would take longer than the points of a row.
    fn takes_blocks(&self, space: &Space) -> bool {
        let points = space.axes().last().map_or(1, super::Axis::len);
        self.reduces_inner_axis() && self.width as u64 <= points.max(64)
    }

    /// The group of a point.
    fn group(&self, space: &Space, point: u64) -> u64 {
        let mut rest = point;
        let mut group = 0;
        for (axis, stride) in space.axes().iter().zip(&self.strides).rev() {
            group += rest % axis.len() * stride;
            rest /= axis.len();
        }
        group
    }

    /// The first cell of a point's group among those of a part.
    fn start(&self, part: &Part, space: &Space, point: u64) -> usize {
        (self.group(space, point) - part.first) as usize * self.width
    }

    /// The first group of consecutive points, and how many there are up to the last.
    fn window(&self, space: &Space, (first, length): (u64, u64)) -> (u64, u64) {
        // Within a row groups increase; rows can be in any order.
        let inner = space.axes().last().map_or(1, super::Axis::len);
        let end = first + length;
        let (mut low, mut high) = (u64::MAX, 0);
        let mut point = first;
        while point < end {
            let last = (point + inner - point % inner).min(end) - 1;
            low = low.min(self.group(space, point));
            high = high.max(self.group(space, last));
            point = last + 1;
        }
        (low, high + 1 - low)
    }
}

/// What has been kept of some chunks, for every reduction of a plan.
#[derive(Clone, Debug)]
pub struct Reductions<'a> {
    plan: &'a Plan,
    parts: Vec<Part>,
}

/// What has been kept for one reduction: the groups of a window, for each quantity.
#[derive(Clone, Debug)]
struct Part {
    first: u64,
    cells: Vec<Cells>,
}

impl<'a> Reductions<'a> {
    /// Creates reductions of a whole scan, before any point.
    pub(super) fn of_all(plan: &'a Plan) -> Self {
        Self::new(plan, |grouping| (0, grouping.groups))
    }

    /// Creates reductions of a chunk, before any point.
    pub(super) fn of_chunk(plan: &'a Plan, number: u64) -> Self {
        let extent = chunk::extent(plan, number);
        Self::new(plan, |grouping| grouping.window(&plan.space, extent))
    }

    fn new(plan: &'a Plan, window: impl Fn(&Grouping) -> (u64, u64)) -> Self {
        let part = |grouping: &Grouping| {
            let (first, groups) = window(grouping);
            let cells = groups as usize * grouping.width;
            let empty = Cells::empty(grouping.reduction.statistic, cells);
            Part {
                first,
                cells: vec![empty; plan.quantities.len()],
            }
        };
        let parts = plan.groupings.iter().map(part).collect();
        Self { plan, parts }
    }

    /// What takes the blocks of a chunk: the whole of them where the inner axis is reduced, each of their points where not.
    pub(super) fn reducer(&self) -> Reducer {
        let mut wanted = Wanted::default();
        let mut accumulators = Vec::new();
        for grouping in &self.plan.groupings {
            let statistic = grouping.reduction.statistic;
            if grouping.takes_blocks(&self.plan.space) {
                wanted.add(statistic);
            } else {
                accumulators.push(Accumulator::new(statistic));
            }
        }
        Reducer::new(wanted, &accumulators, self.plan.quantities.len())
    }

    /// Gives the reducer of the `points` points from `first` on what was kept of them.
    pub(super) fn begin(&self, (first, points): (u64, usize), reducer: &mut Reducer) {
        reducer.first = first;
        let parts = self.plan.groupings.iter().zip(&self.parts);
        let parts = parts.filter(|(grouping, _)| !grouping.takes_blocks(&self.plan.space));
        for (number, (grouping, part)) in parts.enumerate() {
            let start = grouping.start(part, &self.plan.space, first);
            for (quantity, cells) in part.cells.iter().enumerate() {
                if let Some(accumulator) = reducer.accumulators(quantity).get_mut(number) {
                    cells.begin(start..start + points, accumulator);
                }
            }
        }
    }

    /// Takes what came of them.
    pub(super) fn end(&mut self, first: u64, reducer: &mut Reducer) {
        let parts = self.plan.groupings.iter().zip(&mut self.parts);
        let mut number = 0;
        for (grouping, part) in parts {
            let start = grouping.start(part, &self.plan.space, first);
            let statistic = grouping.reduction.statistic;
            if grouping.takes_blocks(&self.plan.space) {
                for (quantity, cells) in part.cells.iter_mut().enumerate() {
                    if let Some(summary) = reducer.summary(quantity) {
                        cells.take(statistic, start, first, (summary, reducer.wanted()));
                    }
                }
                continue;
            }
            for (quantity, cells) in part.cells.iter_mut().enumerate() {
                if let Some(accumulator) = reducer.accumulators(quantity).get(number) {
                    let stride = if grouping.reduces_inner_axis() {
                        0
                    } else {
                        grouping.width
                    };
                    cells.end(start, stride, accumulator);
                }
            }
            number += 1;
        }
    }

    /// Takes what a later chunk has kept.
    pub(super) fn merge(&mut self, later: &Self) {
        let groupings = self.plan.groupings.iter();
        for ((grouping, part), later) in groupings.zip(&mut self.parts).zip(&later.parts) {
            let start = (later.first - part.first) as usize * grouping.width;
            for (cells, later) in part.cells.iter_mut().zip(&later.cells) {
                cells.merge(grouping.reduction.statistic, start, later);
            }
        }
    }

    /// All of it as bytes, to go on from later with [`Plan::reduce_from`](super::Plan::reduce_from).
    pub fn to_bytes(&self) -> Vec<u8> {
        let cells = self.parts.iter().flat_map(|part| &part.cells);
        let cells = cells.flat_map(Cells::to_bytes);
        std::iter::once(LAYOUT).chain(cells).collect()
    }

    /// What [`Reductions::to_bytes`] wrote, for the same plan.
    pub(super) fn from_bytes(plan: &'a Plan, bytes: &[u8]) -> Result<Self, Error> {
        let mut reductions = Self::of_all(plan);
        let Some((&LAYOUT, mut rest)) = bytes.split_first() else {
            return Err(StudyError::ForeignState.into());
        };
        for cells in reductions.parts.iter_mut().flat_map(|part| &mut part.cells) {
            rest = cells.read(rest).ok_or(StudyError::ForeignState)?;
        }
        if rest.is_empty() {
            Ok(reductions)
        } else {
            Err(StudyError::ForeignState.into())
        }
    }

    /// The results, one for each reduction.
    pub(super) fn finish(self) -> Vec<Reduced> {
        let groupings = self.plan.groupings.iter().cloned();
        groupings
            .zip(self.parts)
            .map(|(grouping, part)| Reduced {
                grouping,
                cells: part.cells,
            })
            .collect()
    }
}

/// The results of one reduction.
#[derive(Clone, Debug)]
pub struct Reduced {
    grouping: Grouping,
    cells: Vec<Cells>,
}

impl Reduced {
    /// The reduction.
    pub const fn reduction(&self) -> &Reduction {
        &self.grouping.reduction
    }

    /// How many groups there are.
    pub const fn groups(&self) -> u64 {
        self.grouping.groups
    }

    /// The numbers of the axes that are not reduced, the innermost last.
    pub fn kept(&self) -> Vec<usize> {
        let strides = self.grouping.strides.iter().enumerate();
        strides
            .filter(|(_, stride)| **stride > 0)
            .map(|(axis, _)| axis)
            .collect()
    }

    /// The index of a group along the axis number `axis`; none for one that is reduced.
    pub fn index(&self, space: &Space, axis: usize, group: u64) -> Option<u64> {
        let stride = *self.grouping.strides.get(axis)?;
        let length = space.axes().get(axis)?.len();
        (stride > 0).then(|| group / stride % length)
    }

    /// The value of a quantity's statistic in a group: a maximum, minimum, mean or count; of a
    /// histogram the count in all bins. None where the quantity exists at none of the group's
    /// points, except for a count, which then is 0.
    pub fn value(&self, quantity: usize, group: u64) -> Option<f64> {
        let mut cells = self.group(quantity, group)?;
        match self.grouping.reduction.statistic {
            Statistic::Histogram { bins, .. } => {
                let in_bins = cells.skip(1).take(bins as usize);
                Some(in_bins.map(|cell| cell.number).sum::<u64>() as f64)
            }
            statistic => cells.next()?.value(statistic),
        }
    }

    /// The point at which the maximum or minimum of a group lies; the first, where there are more.
    pub fn point(&self, quantity: usize, group: u64) -> Option<u64> {
        let statistic = self.grouping.reduction.statistic;
        let cell = self.group(quantity, group)?.next()?;
        let located = statistic.locates() && cell.value(statistic).is_some();
        located.then_some(cell.number)
    }

    /// The counts of a histogram in a group: below all bins, in each bin, above all bins. Empty for
    /// other statistics.
    pub fn histogram(&self, quantity: usize, group: u64) -> Vec<u64> {
        let histogram = matches!(
            self.grouping.reduction.statistic,
            Statistic::Histogram { .. }
        );
        let cells = self.group(quantity, group).filter(|_| histogram);
        let cells = cells.into_iter().flatten();
        cells.map(|cell| cell.number).collect()
    }

    fn group(&self, quantity: usize, group: u64) -> Option<impl Iterator<Item = Cell>> {
        let start = usize::try_from(group)
            .ok()?
            .checked_mul(self.grouping.width)?;
        self.cells
            .get(quantity)?
            .range(start..start + self.grouping.width)
    }
}
