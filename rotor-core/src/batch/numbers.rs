//! The columns of the chain at the points of a block, and those that are the same at all points, once a row.
//!
//! Every stage is a formula of the generated [`chain`](crate::equations::chain). It is computed anew only where an input on which
//! it depends is another one than when it was computed last. What the inputs along an axis alone decide, as the crack's
//! compliance along its depth, is therefore computed once for each of their values, and what the other inputs alone decide
//! once a row.

use lanes::chain::{StagedVisitor, Visitor};
use lanes::{ALL, Kernel, Level, once, store};

use crate::equations::chain::{Column, Stage, Staged};
use crate::jeffcott::rotor::LoadCase;

use super::list::{List, NONZERO, Test};
use super::row::Row;
use super::stages::{alternatives, own, stage_of};

/// What a number on the way has to be so that the results at its point are those of that rotor alone. Inputs of the sizes that
/// machines have take no number out of the range of doubles; without coupling some results are limits.
const fn requirement(column: Column) -> Option<&'static Test> {
    match column {
        Column::Gamma => Some(&NONZERO),
        _ => None,
    }
}

/// At which points the numbers of a stage are what they are for that rotor alone.
#[derive(Clone, Debug, Default)]
pub(super) struct Trust {
    pub(super) points: Vec<bool>,
    pub(super) all: bool,
}

impl Trust {
    /// Trusts so many points.
    pub(super) fn renew(&mut self, points: usize) {
        self.points.clear();
        self.points.resize(points, true);
        self.all = true;
    }

    /// Trusts only those of them whose numbers pass a test.
    fn require(&mut self, list: &List, test: &Test) {
        self.all &= list.require(&mut self.points, test);
    }

    /// Marks false the points that are not trusted; one answer holds for all points. Whether all are trusted.
    pub(super) fn mark(&self, points: &mut [bool]) -> bool {
        if !self.all {
            match self.points[..] {
                [_] => points.fill(false),
                _ => {
                    let trusts = points.iter_mut().zip(&self.points);
                    trusts.for_each(|(point, trust)| *point &= trust);
                }
            }
        }
        self.all
    }
}

/// The numbers of so many points: a list for each column, and when each stage was computed.
#[derive(Clone, Debug)]
pub(super) struct Numbers {
    points: usize,
    lists: [List; Column::ALL.len()],
    /// The update of the row at which a stage was computed, the first of those that are alternatives; none before that.
    computed: [Option<u64>; Stage::ALL.len()],
    trust: [Trust; Stage::ALL.len()],
    /// What staged forms have for every value of what runs along.
    tables: [Vec<Vec<f64>>; Staged::ALL.len()],
    tabulated: [Option<u64>; Staged::ALL.len()],
}

impl Numbers {
    /// Creates the lists of so many points, with columns of these inputs.
    pub(super) fn new(
        points: usize,
        columns: impl IntoIterator<Item = (Column, Vec<f64>)>,
    ) -> Self {
        let mut numbers = Self {
            points,
            lists: std::array::from_fn(|_| List::default()),
            computed: [None; Stage::ALL.len()],
            trust: std::array::from_fn(|_| Trust::default()),
            tables: std::array::from_fn(|_| Vec::new()),
            tabulated: [None; Staged::ALL.len()],
        };
        for (column, values) in columns {
            numbers.lists[column as usize] = List::of(values);
        }
        numbers
    }

    /// The list of a column that has been computed.
    pub(super) const fn list(&self, column: Column) -> &List {
        &self.lists[column as usize]
    }

    /// Sets the number that all points of a column have.
    pub(super) fn set(&mut self, column: Column, number: f64) {
        self.lists[column as usize].set(number);
    }

    /// Makes a list as long as there are points of each of these columns, and gives their slices.
    pub(super) fn columns<const COUNT: usize>(&mut self, columns: &[Column]) -> [&[f64]; COUNT] {
        for column in columns {
            self.lists[*column as usize].spread(self.points);
        }
        std::array::from_fn(|place| {
            let list = columns.get(place).map(|column| self.list(*column));
            list.map_or(&[][..], |list| list.first(self.points))
        })
    }

    /// Whether a stage, the first of its alternatives, is to be computed anew.
    fn is_stale(&self, stage: Stage, row: &Row) -> bool {
        let renewed = row.renewed(stage);
        self.computed[stage as usize].is_none_or(|update| update < renewed)
    }

    /// The update of the row at which a stage, the first of its alternatives, was computed last.
    #[cfg(test)]
    pub(super) const fn update_of(&self, stage: Stage) -> Option<u64> {
        self.computed[stage as usize]
    }

    /// Computes a stage of which all that it takes is there. None where lengths differ, which does not happen.
    fn compute(&mut self, stage: Stage) -> Option<()> {
        stage.visit(Computing {
            stage,
            numbers: self,
        })?
    }

    /// Computes $\beta$ anew from both inertias, as one quotient, as every rotor alone has it: the generated stage multiplies by
    /// an inverse that other coefficients share.
    fn divide_inertias(&mut self) {
        let sides = [Column::DiskPolarInertia, Column::DiskDiametralInertia];
        if self.points == 1 {
            let [polar, diametral] = sides.map(|side| self.list(side).number());
            self.set(Column::Beta, polar / diametral);
            return;
        }
        let mut ratios = self.lists[Column::Beta as usize].take(self.points);
        let [polar, diametral] = self.columns(&sides);
        for (ratio, (polar, diametral)) in ratios.iter_mut().zip(polar.iter().zip(diametral)) {
            *ratio = polar / diametral;
        }
        self.lists[Column::Beta as usize] = List::of(ratios);
    }

    /// Checks what a stage has given, and keeps in mind at which update of the row.
    fn computed(&mut self, stage: Stage, update: u64) {
        self.computed[stage as usize] = Some(update);
        let trust = &mut self.trust[stage as usize];
        trust.renew(self.points);
        for column in stage.gives() {
            if let Some(test) = requirement(*column) {
                trust.require(&self.lists[*column as usize], test);
            }
        }
    }
}

/// Runs the rows of a stage, from lists to lists.
struct Computing<'a> {
    stage: Stage,
    numbers: &'a mut Numbers,
}

impl Visitor for Computing<'_> {
    type Output = Option<()>;

    fn rows<K, const WANTED: u64, const ALONG: usize, const RESULTS: usize>(self) -> Option<()>
    where
        K: Kernel<0, ALONG, RESULTS>,
    {
        let Self { stage, numbers } = self;
        let points = numbers.points;
        let is_own = |place: usize| WANTED >> place & 1 == 1;
        if points == 1 {
            let take = |place: usize| {
                stage
                    .takes()
                    .get(place)
                    .map_or(f64::NAN, |column| numbers.list(*column).number())
            };
            let results: [f64; RESULTS] =
                once::<K, 0, ALONG, RESULTS>(&[], &std::array::from_fn(take));
            let given = stage.gives().iter().zip(results).enumerate();
            for (_, (column, number)) in given.filter(|(place, _)| is_own(*place)) {
                numbers.set(*column, number);
            }
            return Some(());
        }
        let mut results: [Vec<f64>; RESULTS] =
            std::array::from_fn(|place| match stage.gives().get(place) {
                Some(column) if is_own(place) => numbers.lists[*column as usize].take(points),
                _ => Vec::new(),
            });
        let level = Level::best();
        let slices = results.each_mut().map(Vec::as_mut_slice);
        let stored = store::<K, WANTED, 0, ALONG, RESULTS>(
            level,
            &[],
            numbers.columns(stage.takes()),
            slices,
        );
        for (place, values) in results.into_iter().enumerate() {
            if let Some(column) = stage.gives().get(place).filter(|_| is_own(place)) {
                numbers.lists[*column as usize] = List::of(values);
            }
        }
        stored.ok()
    }
}

/// Runs what a staged form does for every value of what runs along, into its tables.
struct Tabulating<'a> {
    form: Staged,
    numbers: &'a mut Numbers,
}

impl StagedVisitor for Tabulating<'_> {
    type Output = Option<()>;

    fn staged<
        A,
        P,
        const FIXED: usize,
        const ALONG: usize,
        const TABLES: usize,
        const RESULTS: usize,
    >(
        self,
        _: fn(&[f64]) -> Option<[f64; FIXED]>,
    ) -> Option<()>
    where
        A: Kernel<0, ALONG, TABLES>,
        P: Kernel<FIXED, TABLES, RESULTS>,
    {
        let Self { form, numbers } = self;
        let mut tables = std::mem::take(&mut numbers.tables[form as usize]);
        tables.resize_with(TABLES, Vec::new);
        for table in &mut tables {
            table.resize(numbers.points, f64::NAN);
        }
        let mut slices = tables.iter_mut();
        let slices: [&mut [f64]; TABLES] =
            std::array::from_fn(|_| slices.next().map_or(&mut [][..], Vec::as_mut_slice));
        let level = Level::best();
        let stored =
            store::<A, ALL, 0, ALONG, TABLES>(level, &[], numbers.columns(form.along()), slices);
        numbers.tables[form as usize] = tables;
        stored.ok()
    }
}

/// The numbers of a block in a row: those that vary along it, and those of the row.
pub(super) struct Points<'a> {
    pub(super) row: &'a Row,
    /// What is the same at all points of every block.
    pub(super) of_row: &'a mut Numbers,
    pub(super) of_block: &'a mut Numbers,
    /// The inputs that vary along the block.
    pub(super) varied: u64,
}

impl Points<'_> {
    /// Whether a column has other numbers at other points.
    pub(super) const fn varies(&self, column: Column) -> bool {
        column.inputs() & self.varied != 0
    }

    /// Computes these stages, in an order in which each has what it takes, as far as they are to be computed anew; of alternatives
    /// the first stands for all. None where that cannot be done.
    pub(super) fn compute(&mut self, stages: &[Stage]) -> Option<()> {
        stages.iter().try_for_each(|stage| {
            if self.gives_the_same(*stage) {
                self.compute_once(*stage)
            } else {
                self.compute_along(*stage)
            }
        })
    }

    /// Whether a stage has the same numbers at all points.
    fn gives_the_same(&self, stage: Stage) -> bool {
        !self.varies(own(stage))
    }

    /// Computes a stage that has the same numbers at all points.
    fn compute_once(&mut self, stage: Stage) -> Option<()> {
        if !self.of_row.is_stale(stage, self.row) {
            return Some(());
        }
        let chosen = match alternatives(stage) {
            [only] => *only,
            _ => stage_of(LoadCase::of(self.row.parameters()?)),
        };
        for column in chosen
            .takes()
            .iter()
            .filter(|column| column.stages().is_empty())
        {
            self.of_row.set(*column, self.row.number(*column));
        }
        self.of_row.compute(chosen)?;
        if stage == Stage::Coefficients {
            self.of_row.divide_inertias();
        }
        self.of_row.computed(stage, self.row.updates());
        Some(())
    }

    /// Computes a stage along the points.
    fn compute_along(&mut self, stage: Stage) -> Option<()> {
        if !self.of_block.is_stale(stage, self.row) {
            return Some(());
        }
        match alternatives(stage) {
            [only] => {
                self.take(only.takes());
                self.of_block.compute(*only)?;
            }
            _ => self.compute_loads()?,
        }
        if stage == Stage::Coefficients {
            self.of_block.divide_inertias();
        }
        self.of_block.computed(stage, self.row.updates());
        Some(())
    }

    /// Takes the numbers of columns that are the same at all points into the lists of the block.
    pub(super) fn take(&mut self, columns: &[Column]) {
        for column in columns {
            if self.varies(*column) {
                continue;
            }
            self.of_block.set(*column, self.number(*column));
        }
    }

    /// Computes the loads at the crack's section, of which the crack's model and its side of the disk decide how.
    fn compute_loads(&mut self) -> Option<()> {
        let row = self.row.parameters()?;
        let case = LoadCase::of(row);
        let (LoadCase::SimplySupportedLeft | LoadCase::SimplySupportedRight) = case else {
            self.take(stage_of(case).takes());
            return self.of_block.compute(stage_of(case));
        };
        let [left, right] = [
            LoadCase::SimplySupportedLeft,
            LoadCase::SimplySupportedRight,
        ]
        .map(stage_of);
        self.take(left.takes());
        self.take(right.takes());
        self.of_block.compute(left)?;
        let of_left: Vec<List> = left
            .gives()
            .iter()
            .map(|column| self.of_block.list(*column).clone())
            .collect();
        self.of_block.compute(right)?;
        let sides = [Column::CrackPositionRatio, Column::DiskPositionRatio];
        self.take(&sides);
        let [crack, disk] = self.of_block.columns(&sides).map(<[f64]>::to_vec);
        for (column, of_left) in left.gives().iter().zip(&of_left) {
            let list = &mut self.of_block.lists[*column as usize];
            list.replace(of_left, |point| crack[point] < disk[point]);
        }
        Some(())
    }

    /// Trusts the points whose polar inertia a rigid body may have, and of which $\beta$ is below the limit of a region.
    pub(super) fn trust_inertia(&mut self, limit: Option<f64>, trust: &mut Trust) {
        let sides = [Column::DiskPolarInertia, Column::DiskDiametralInertia];
        self.take(&sides);
        let points = if sides.iter().any(|side| self.varies(*side)) {
            self.of_block.points
        } else {
            1
        };
        trust.renew(points);
        let [polar, diametral] = self.of_block.columns(&sides);
        let ratios = polar.iter().zip(diametral);
        for (point, (polar, diametral)) in trust.points.iter_mut().zip(ratios) {
            *point = match limit {
                // As the quotient is rounded, so may the product be: then the point is looked at alone.
                Some(limit) => *polar < limit * diametral && polar / diametral < limit,
                None => *polar <= 2.0 * diametral,
            };
            trust.all &= *point;
        }
    }

    /// Computes the tables of a staged form, if they are to be computed anew. None where that cannot be done.
    pub(super) fn tabulate(&mut self, form: Staged) -> Option<()> {
        self.take(form.along());
        let inputs = form
            .along()
            .iter()
            .fold(0, |inputs, column| inputs | column.inputs());
        let changed = self.row.changed(inputs);
        if self.of_block.tabulated[form as usize].is_none_or(|update| update < changed) {
            form.visit(Tabulating {
                form,
                numbers: self.of_block,
            })?;
            self.of_block.tabulated[form as usize] = Some(self.row.updates());
        }
        Some(())
    }

    /// The number of a column that is the same at all points.
    fn number(&self, column: Column) -> f64 {
        if column.stages().is_empty() {
            self.row.number(column)
        } else {
            self.of_row.list(column).number()
        }
    }

    /// Writes the numbers that a staged form takes once, those of the first point; none where there is no room for them.
    pub(super) fn still<'n>(&self, form: Staged, numbers: &'n mut [f64]) -> Option<&'n [f64]> {
        let columns = form.still();
        let numbers = numbers.get_mut(..columns.len())?;
        for (number, column) in numbers.iter_mut().zip(columns) {
            *number = if self.varies(*column) {
                self.of_block.list(*column).number()
            } else {
                self.number(*column)
            };
        }
        Some(numbers)
    }

    /// The tables of a staged form.
    pub(super) fn tables<const TABLES: usize>(&self, form: Staged) -> [&[f64]; TABLES] {
        let tables = &self.of_block.tables[form as usize];
        std::array::from_fn(|place| tables.get(place).map_or(&[][..], Vec::as_slice))
    }

    /// Marks false the points whose numbers of these stages are not what they are for that rotor alone; whether there are none.
    pub(super) fn trust(&self, stages: &[Stage], points: &mut [bool]) -> bool {
        let marked = stages.iter().map(|stage| {
            let same = self.gives_the_same(*stage);
            let numbers = if same { &self.of_row } else { &self.of_block };
            numbers.trust[*stage as usize].mark(points)
        });
        // Each marks its own.
        marked.fold(true, |all, of_stage| all & of_stage)
    }
}
