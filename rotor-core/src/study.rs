//! Scans: quantities over grids and samples of rotors, in parallel and in bounded memory.
//!
//! A [`Scan`] varies inputs of a rotor, or its speed, along [`Axis`] after [`Axis`]; its points are their product,
//! the last axis innermost. A [`Plan`] is a scan that has been checked. It is computed chunk by
//! chunk, on all cores, and what comes out is the same for every number of threads:
//!
//! - [`Plan::reduce`] keeps only maxima, means, histograms ([`Reduction`]), a few numbers per
//!   group, however many points there are;
//! - [`Plan::write_to`] gives every chunk, in order, to a [`Sink`], as a file is;
//! - [`Plan::collect`] keeps all of it in memory, a column for each quantity;
//! - [`Plan::chunks`] iterates over the chunks.
//!
//! A point at which a region does not exist has no value ([`Option::None`]): not NaN, not 0.
//!
//! ```
//! use rotor_core::quantity::Quantity;
//! use rotor_core::input::NumericInput;
//! use rotor_core::jeffcott::rotor::Rotor;
//! use rotor_core::study::{Axis, Control, Reduction, Scan, Statistic};
//!
//! let input = |name| NumericInput::find(name).ok_or("no such input");
//! let plan = Scan::of(&Rotor::default())
//!     .vary(Axis::linear(input("crack.depth_ratio")?, (0.0, 0.4), 5)?)
//!     .vary(Axis::linear(input("crack.angle")?, (0.0, std::f64::consts::PI), 19)?)
//!     .quantity(Quantity::SirWidth)
//!     .reduce(Reduction::new(Statistic::Maximum).over(input("crack.angle")?))
//!     .plan()?;
//! let report = plan.reduce(&Control::default())?;
//! // The widest region over the angle, for each of the five depths.
//! assert_eq!(report.reduced[0].groups(), 5);
//! assert!(report.reduced[0].value(0, 4) > report.reduced[0].value(0, 1));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axis;
mod chunk;
mod collected;
mod one;
mod reduce;
mod run;
mod sample;
mod sink;
mod space;
pub mod table;
mod threads;

use crate::error::{Error, StudyError};
use crate::input::RotorParameters;
use crate::jeffcott::rotor::Rotor;
use crate::quantity::Quantity;

pub use crate::batch::statistic::Statistic;
pub use crate::input::Variable;
pub use axis::Axis;
pub use chunk::{Chunk, Counts, POINTS_PER_CHUNK};
pub use collected::{Collected, Column};
pub use one::{evaluate, evaluate_at};
pub use reduce::{MOST_BINS, MOST_RESULTS, Reduced, Reduction, Reductions};
pub use run::{Cancel, Chunks, Control, MOST_COLLECTED, Report, Saved, Stopped};
pub use sample::{Distribution, Sampling};
pub use sink::{Discard, Sink};
pub use space::{MOST_POINTS, Space};

use reduce::Grouping;

/// What to scan; checked by [`Scan::plan`].
#[derive(Clone, Debug)]
pub struct Scan {
    base: RotorParameters,
    axes: Vec<Axis>,
    quantities: Vec<Quantity>,
    reductions: Vec<Reduction>,
}

impl Scan {
    /// A scan about a rotor: inputs that do not vary are this rotor's.
    pub fn of(rotor: &Rotor) -> Self {
        Self {
            base: *rotor.parameters(),
            axes: Vec::new(),
            quantities: Vec::new(),
            reductions: Vec::new(),
        }
    }

    /// Adds an axis, inside of those before it.
    #[must_use]
    pub fn vary(mut self, axis: Axis) -> Self {
        self.axes.push(axis);
        self
    }

    /// Adds a result, once.
    #[must_use]
    pub fn quantity(mut self, quantity: Quantity) -> Self {
        if !self.quantities.contains(&quantity) {
            self.quantities.push(quantity);
        }
        self
    }

    /// Adds a reduction of every quantity.
    #[must_use]
    pub fn reduce(mut self, reduction: Reduction) -> Self {
        self.reductions.push(reduction);
        self
    }

    /// Checks all of it.
    ///
    /// # Errors
    /// Where nothing is varied or asked for, a variable is varied twice, a quantity needs a speed and it is not varied,
    /// there are more points than [`MOST_POINTS`], or a reduction is none or keeps more than [`MOST_RESULTS`].
    pub fn plan(self) -> Result<Plan, Error> {
        if self.quantities.is_empty() {
            return Err(StudyError::NoQuantity.into());
        }
        let space = Space::new(self.axes)?;
        let has_speed = space.axes().iter().any(|axis| axis.varies(Variable::Speed));
        let mut at_speed = self
            .quantities
            .iter()
            .filter(|quantity| quantity.needs_speed());
        if let Some(quantity) = at_speed.next().filter(|_| !has_speed) {
            let quantity = quantity.name();
            return Err(StudyError::NoSpeed { quantity }.into());
        }
        let groupings = reduce::groupings(&self.reductions, &space, self.quantities.len())?;
        Ok(Plan {
            base: self.base,
            space,
            quantities: self.quantities,
            groupings,
        })
    }
}

/// A scan that has been checked and can be run.
#[derive(Clone, Debug)]
pub struct Plan {
    base: RotorParameters,
    space: Space,
    quantities: Vec<Quantity>,
    groupings: Vec<Grouping>,
}

impl Plan {
    /// The axes and their points.
    pub const fn space(&self) -> &Space {
        &self.space
    }

    /// The results, in the order asked for.
    pub fn quantities(&self) -> &[Quantity] {
        &self.quantities
    }

    /// The rotor whose inputs hold where nothing varies.
    pub const fn base(&self) -> &RotorParameters {
        &self.base
    }

    /// The reductions, in the order asked for.
    pub fn reductions(&self) -> impl ExactSizeIterator<Item = &Reduction> {
        self.groupings.iter().map(Grouping::reduction)
    }

    /// How many chunks there are.
    pub const fn chunk_count(&self) -> u64 {
        self.space.len().div_ceil(POINTS_PER_CHUNK)
    }
}
