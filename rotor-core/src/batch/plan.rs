//! How each quantity of a kernel is computed, chosen once for what varies.

use crate::equations::chain::{Column, Formula, Stage, Staged};
use crate::jeffcott::region::RegionKind;
use crate::quantity::{Measure, Quantity, Subject};

/// How some of the quantities asked for are computed together.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Way {
    /// Read from a column of the chain.
    Column { place: usize, column: Column },
    /// By a formula, whose results go to these places; in stages, where that is given.
    Formula {
        formula: Formula,
        staged: Option<Staged>,
        places: Vec<Option<usize>>,
    },
    /// The exact ends of a region, the lower and the upper, by iteration.
    Ends {
        region: RegionKind,
        places: [Option<usize>; 2],
    },
    /// The growth rate at the speed, by iteration.
    GrowthRate { place: usize },
}

/// How the quantities of a kernel are computed.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub(super) ways: Vec<Way>,
    /// The stages that are to be computed before, in order; of alternatives the first.
    pub(super) stages: Vec<Stage>,
    /// What $\beta$ has to be below for all regions that quantities are of.
    pub(super) inertia_ratio_limit: Option<f64>,
    /// Whether a quantity is found by iteration, which takes no other points than those that are to be trusted.
    pub(super) iteration: bool,
}

/// What varies: inputs as sets.
#[derive(Clone, Copy, Debug)]
pub(super) struct Varied {
    /// Inputs that vary along a block.
    pub(super) block: u64,
    /// Inputs that change from one row to the next; all of them where that is not known.
    pub(super) next: u64,
}

/// Which digits results have to have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Digits {
    /// Those of the stages in which widths are computed along an axis: the last ones may differ from those of a rotor alone.
    OfStages,
    /// The digits that each rotor has alone.
    OfOneRotor,
}

impl Plan {
    /// Plans how to compute quantities where these inputs vary.
    pub(super) fn of(quantities: &[Quantity], varied: Varied, digits: Digits) -> Self {
        let regions = quantities.iter().filter_map(|quantity| quantity.region());
        let limits = regions.filter_map(RegionKind::inertia_ratio_limit);
        let mut plan = Self {
            ways: Vec::new(),
            stages: Vec::new(),
            inertia_ratio_limit: limits.reduce(f64::min),
            iteration: false,
        };
        // What is computed for other quantities anyway costs nothing: formulas with a choice come last.
        let is_chosen = |quantity: &Quantity| {
            quantity
                .column()
                .is_some_and(|column| column.formulas().len() > 1)
        };
        for quantity in quantities.iter().filter(|quantity| !is_chosen(quantity)) {
            plan.add(quantities, *quantity, varied, digits);
        }
        for quantity in quantities.iter().filter(|quantity| is_chosen(quantity)) {
            plan.add(quantities, *quantity, varied, digits);
        }
        plan
    }

    /// Adds the ways of a quantity, and of what is computed with it, unless it has them.
    fn add(&mut self, quantities: &[Quantity], quantity: Quantity, varied: Varied, digits: Digits) {
        let places = |wanted: &dyn Fn(Quantity) -> bool| -> Vec<usize> {
            let places = quantities.iter().enumerate();
            places
                .filter(|(_, quantity)| wanted(**quantity))
                .map(|(place, _)| place)
                .collect()
        };
        let own = places(&|other| other == quantity);
        if own.iter().any(|place| self.has(*place)) {
            return;
        }
        match (quantity.subject(), quantity.column()) {
            (Subject::Region(region, Measure::ExactLower | Measure::ExactUpper), _) => {
                let ends = [Measure::ExactLower, Measure::ExactUpper];
                let ends = ends
                    .map(|end| places(&|other| other.subject() == Subject::Region(region, end)));
                let ways = together(&ends).map(|places| Way::Ends {
                    region,
                    places: std::array::from_fn(|end| places.get(end).copied().flatten()),
                });
                self.ways.extend(ways);
                self.need(Stage::Coefficients.gives());
                self.iteration = true;
            }
            (Subject::AtSpeed, _) => {
                self.ways
                    .extend(own.into_iter().map(|place| Way::GrowthRate { place }));
                self.need(Stage::Coefficients.gives());
                self.iteration = true;
            }
            (_, Some(column)) if column.formulas().is_empty() => {
                self.ways
                    .extend(own.into_iter().map(|place| Way::Column { place, column }));
                self.need(&[column]);
            }
            (_, Some(column)) => {
                let Some((formula, staged)) = self.best(column, varied, digits) else {
                    return;
                };
                let results = formula.gives().iter();
                let results = results.map(|given| places(&|other| other.column() == Some(*given)));
                let results: Vec<_> = results.collect();
                let ways = together(&results).map(|places| Way::Formula {
                    formula,
                    staged,
                    places,
                });
                self.ways.extend(ways);
                self.need(formula.takes());
            }
            (_, None) => {}
        }
    }

    fn has(&self, place: usize) -> bool {
        self.ways.iter().any(|way| match way {
            Way::Column { place: own, .. } | Way::GrowthRate { place: own } => *own == place,
            Way::Formula { places, .. } => places.contains(&Some(place)),
            Way::Ends { places, .. } => places.contains(&Some(place)),
        })
    }

    /// The formula for a column, and its staged form, that costs the least in each row.
    fn best(
        &self,
        column: Column,
        varied: Varied,
        digits: Digits,
    ) -> Option<(Formula, Option<Staged>)> {
        let formulas = column.formulas().iter().copied();
        if digits == Digits::OfOneRotor {
            let alone = |formula: &Formula| formula.gives().len() == 1 && formula.weight() > 0;
            return Some((formulas.clone().find(alone)?, None));
        }
        let staged = Staged::ALL
            .into_iter()
            .filter(|form| column.formulas().contains(&form.formula()));
        let runs = |form: &Staged| {
            let takes = form.formula().takes().iter();
            let mut varying = takes
                .filter(|taken| varies(**taken, varied.block))
                .peekable();
            varying.peek().is_some() && varying.all(|taken| form.along().contains(taken))
        };
        let staged = staged.filter(runs).map(|form| (form.formula(), Some(form)));
        // Without stages the formula that has most of the results together.
        let rows = formulas
            .filter(|formula| formula.weight() > 0)
            .max_by_key(|formula| formula.gives().len());
        let all = staged.chain(rows.map(|formula| (formula, None)));
        all.min_by_key(|(formula, form)| self.cost(*formula, *form, varied))
    }

    /// What a formula costs at each point of a row, with the stages before it that the next row has to compute anew.
    fn cost(&self, formula: Formula, form: Option<Staged>, varied: Varied) -> usize {
        let is_renewed = |inputs: u64| inputs & varied.block != 0 && inputs & varied.next != 0;
        let mut before = self.clone();
        before.need(form.map_or(formula.takes(), |form| form.along()));
        before.need(formula.takes());
        let new = before
            .stages
            .iter()
            .filter(|stage| !self.stages.contains(stage) && is_renewed(stage.inputs()));
        let stages: usize = new.map(|stage| stage.weight()).sum();
        let own = form.map_or(formula.weight(), |form| {
            let [along, points] = form.weights();
            let inputs = form
                .along()
                .iter()
                .fold(0, |inputs, column| inputs | column.inputs());
            points + if is_renewed(inputs) { along } else { 0 }
        });
        stages + own
    }

    /// Adds the stages that give these columns, after those that they take from.
    fn need(&mut self, columns: &[Column]) {
        for stage in columns
            .iter()
            .filter_map(|column| column.stages().first().copied())
        {
            if self.stages.contains(&stage) {
                continue;
            }
            for taking in Stage::ALL
                .iter()
                .filter(|other| is_alternative(**other, stage))
            {
                self.need(taking.takes());
            }
            self.stages.push(stage);
        }
    }
}

/// Whether two stages give the same columns.
fn is_alternative(one: Stage, other: Stage) -> bool {
    one.gives() == other.gives()
}

/// Whether a column has other numbers at other points where these inputs vary.
const fn varies(column: Column, varied: u64) -> bool {
    column.inputs() & varied != 0
}

/// The places of several quantities that are computed together, of which each may be asked for more than once.
fn together(of_each: &[Vec<usize>]) -> impl Iterator<Item = Vec<Option<usize>>> + use<'_> {
    let most = of_each.iter().map(Vec::len).max().unwrap_or_default();
    (0..most).map(|round| {
        of_each
            .iter()
            .map(|places| places.get(round).copied())
            .collect()
    })
}
