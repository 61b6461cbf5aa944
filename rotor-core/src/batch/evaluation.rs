//! The last loop: from the columns of the chain to each quantity, in packs, to wherever it goes.

use lanes::chain::{StagedVisitor, Visitor};
use lanes::{Kernel, once};

use crate::batch::extremes::Itself;
use crate::batch::statistic::{Gaps, WithGaps, WithoutGaps};
use crate::equations::chain::{Column, Formula, Stage, Staged};
use crate::quantity::Quantity;

use super::destination::{Destination, FINITE_NUMBER, PARTIAL, POSITIVE_NUMBER, Requirement};
use super::iteration::{Ends, GrowthRate, number_of};
use super::list::List;
use super::numbers::{Points, Trust};
use super::plan::{Plan, Way};

/// The points of a block in a row, with the speed at each of them.
pub(super) struct Evaluation<'a> {
    pub(super) points: Points<'a>,
    /// The points whose polar inertia a rigid body may have.
    pub(super) inertia: &'a Trust,
    pub(super) speed: &'a mut List,
    /// A column of the points, whichever: it tells how many they are.
    pub(super) counted: &'a [f64],
}

impl Evaluation<'_> {
    /// Marks false the points that are no rotors, or whose numbers on the way are not what they are for that rotor alone; whether
    /// there are none.
    pub(super) fn trust(&self, plan: &Plan, points: &mut [bool]) -> bool {
        let inertia = self.inertia.mark(points);
        self.points.trust(&plan.stages, points) & inertia
    }

    /// Evaluates quantities in the ways of a plan. None where that cannot be done.
    pub(super) fn run<D: Destination>(
        &mut self,
        quantities: &[Quantity],
        ways: &[Way],
        to: &mut D,
    ) -> Option<()> {
        ways.iter().try_for_each(|way| match way {
            Way::Column { place, column } => self.column(*place, *column, to),
            Way::Ends { region, places } => {
                let columns = Stage::Coefficients.gives();
                self.points.take(columns);
                let region = [number_of(*region)];
                let varies = self.varies(columns);
                let along: [&[f64]; 8] = self.points.of_block.columns(columns);
                if varies {
                    return to.take::<Ends, WithGaps, 1, 8, 2>(*places, PARTIAL, &region, along);
                }
                let numbers = once::<Ends, 1, 8, 2>(&region, &first_row(along)?);
                self.same::<WithGaps, D, 2>(*places, PARTIAL, numbers, to)
            }
            Way::GrowthRate { place } => self.growth_rate(*place, to),
            Way::Formula {
                formula,
                staged,
                places,
            } => {
                let asked = places
                    .iter()
                    .flatten()
                    .next()
                    .and_then(|place| quantities.get(*place))?;
                let requirement = if asked.is_positive() {
                    POSITIVE_NUMBER
                } else {
                    FINITE_NUMBER
                };
                match staged {
                    Some(form) => self.staged(*form, requirement, places, to),
                    None => self.formula(*formula, requirement, places, to),
                }
            }
        })
    }

    fn varies(&self, columns: &[Column]) -> bool {
        columns.iter().any(|column| self.points.varies(*column))
    }

    /// A column of the chain as it is.
    fn column<D: Destination>(&mut self, place: usize, column: Column, to: &mut D) -> Option<()> {
        self.points.take(&[column]);
        let varies = self.varies(&[column]);
        let [values] = self.points.of_block.columns(&[column]);
        if varies {
            return to.take::<Itself, WithoutGaps, 0, 1, 1>(
                [Some(place)],
                FINITE_NUMBER,
                &[],
                [values],
            );
        }
        let number = *values.first()?;
        self.same::<WithoutGaps, D, 1>([Some(place)], FINITE_NUMBER, [number], to)
    }

    fn growth_rate<D: Destination>(&mut self, place: usize, to: &mut D) -> Option<()> {
        let columns = Stage::Coefficients.gives();
        self.points.take(columns);
        let varies = self.varies(columns) || !self.speed.is_same();
        let coefficients: [&[f64]; 8] = self.points.of_block.columns(columns);
        let speed = self.speed.spread(self.counted.len());
        let along: [&[f64]; 9] =
            std::array::from_fn(|place| coefficients.get(place).copied().unwrap_or(speed));
        if varies {
            return to.take::<GrowthRate, WithGaps, 0, 9, 1>([Some(place)], PARTIAL, &[], along);
        }
        let numbers = once::<GrowthRate, 0, 9, 1>(&[], &first_row(along)?);
        self.same::<WithGaps, D, 1>([Some(place)], PARTIAL, numbers, to)
    }

    fn formula<D: Destination>(
        &mut self,
        formula: Formula,
        requirement: Requirement,
        places: &[Option<usize>],
        to: &mut D,
    ) -> Option<()> {
        self.points.take(formula.takes());
        formula.visit(Rows {
            formula,
            requirement,
            places,
            evaluation: self,
            to,
        })?
    }

    fn staged<D: Destination>(
        &mut self,
        form: Staged,
        requirement: Requirement,
        places: &[Option<usize>],
        to: &mut D,
    ) -> Option<()> {
        self.points.tabulate(form)?;
        // Where the extremes alone are wanted, those of the squares will do, with one root of many.
        if to.is_of_extremes()
            && let Some(squares) = squared(form)
        {
            self.points.tabulate(squares)?;
            return squares.visit(OfStages {
                form: squares,
                requirement,
                places,
                evaluation: self,
                to,
                squares: true,
            });
        }
        form.visit(OfStages {
            form,
            requirement,
            places,
            evaluation: self,
            to,
            squares: false,
        })
    }

    /// Numbers that all points have.
    fn same<G: Gaps, D: Destination, const RESULTS: usize>(
        &self,
        places: [Option<usize>; RESULTS],
        requirement: Requirement,
        numbers: [f64; RESULTS],
        to: &mut D,
    ) -> Option<()> {
        places
            .into_iter()
            .zip(numbers)
            .try_for_each(|(place, number)| match place {
                Some(_) => to.same::<G>(place, requirement, number, self.counted),
                None => Some(()),
            })
    }
}

/// The form of the squares of a form's results, along the same columns: that of a formula whose results have the same names
/// with `_squared` behind them.
fn squared(form: Staged) -> Option<Staged> {
    let is_square = |other: &Staged| {
        let squares = other.formula().gives().iter();
        let pairs = squares.zip(form.formula().gives());
        let mut named = pairs
            .map(|(square, result)| square.name().strip_suffix("_squared") == Some(result.name()));
        other.along() == form.along() && named.all(|is_square| is_square)
    };
    Staged::ALL.into_iter().find(is_square)
}

/// The first row of columns.
fn first_row<const ALONG: usize>(along: [&[f64]; ALONG]) -> Option<[f64; ALONG]> {
    let mut row = [f64::NAN; ALONG];
    for (number, column) in row.iter_mut().zip(along) {
        *number = *column.first()?;
    }
    Some(row)
}

/// The places of as many results as a kernel has.
fn array<const RESULTS: usize>(places: &[Option<usize>]) -> [Option<usize>; RESULTS] {
    std::array::from_fn(|result| places.get(result).copied().flatten())
}

/// Takes a formula's results to where they go.
struct Rows<'a, 'b, D> {
    formula: Formula,
    requirement: Requirement,
    places: &'a [Option<usize>],
    evaluation: &'a mut Evaluation<'b>,
    to: &'a mut D,
}

impl<D: Destination> Visitor for Rows<'_, '_, D> {
    type Output = Option<()>;

    fn rows<K, const WANTED: u64, const ALONG: usize, const RESULTS: usize>(self) -> Option<()>
    where
        K: Kernel<0, ALONG, RESULTS>,
    {
        let (places, evaluation) = (array::<RESULTS>(self.places), self.evaluation);
        let varies = evaluation.varies(self.formula.takes());
        let along: [&[f64]; ALONG] = evaluation.points.of_block.columns(self.formula.takes());
        if varies {
            return self.to.take::<K, WithoutGaps, 0, ALONG, RESULTS>(
                places,
                self.requirement,
                &[],
                along,
            );
        }
        let numbers = once::<K, 0, ALONG, RESULTS>(&[], &first_row(along)?);
        evaluation.same::<WithoutGaps, D, RESULTS>(places, self.requirement, numbers, self.to)
    }
}

/// Takes the results of a staged form to where they go.
struct OfStages<'a, 'b, D> {
    form: Staged,
    requirement: Requirement,
    places: &'a [Option<usize>],
    evaluation: &'a mut Evaluation<'b>,
    to: &'a mut D,
    /// Whether the results are squares, of which the roots are wanted.
    squares: bool,
}

impl<D: Destination> StagedVisitor for OfStages<'_, '_, D> {
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
        fixed: fn(&[f64]) -> Option<[f64; FIXED]>,
    ) -> Option<()>
    where
        A: Kernel<0, ALONG, TABLES>,
        P: Kernel<FIXED, TABLES, RESULTS>,
    {
        let points = &mut self.evaluation.points;
        let mut numbers = [f64::NAN; Column::ALL.len()];
        let fixed = fixed(points.still(self.form, &mut numbers)?)?;
        let tables = points.tables::<TABLES>(self.form);
        let places = array::<RESULTS>(self.places);
        if self.squares {
            return self.to.take_squares::<P, FIXED, TABLES, RESULTS>(
                places,
                self.requirement,
                &fixed,
                tables,
            );
        }
        self.to.take::<P, WithoutGaps, FIXED, TABLES, RESULTS>(
            places,
            self.requirement,
            &fixed,
            tables,
        )
    }
}
