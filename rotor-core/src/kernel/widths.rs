//! Both widths of a block in packs, in stages along its axis.

use lanes::{ALL, Kernel, Level, store};

use crate::equations::{self, Coefficients, Stiffness, both_widths, both_widths_squared, widths};
use crate::extremes::Extremes;
use crate::rotor::{LoadCase, NumericInput, Rotor, RotorParameters};
use crate::summary::{Summary, Wanted};

use super::closed_forms;

/// The inputs that leave the stiffness as it is.
pub(super) const INERTIA: [&str; 3] = ["disk_mass", "disk_diametral_inertia", "disk_polar_inertia"];

/// What varies along the axis, and with it what is done once for a row and once for the axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stages {
    /// The crack's angle: a root of two products is left for each width.
    Angle,
    /// The disk's asymmetry.
    Asymmetry,
    /// The disk's mass and inertias, which leave the stiffness as it is.
    Inertias,
    /// The crack's depth: its compliance is tabulated.
    Depth,
    /// The crack's place: the loads at its section are tabulated.
    Place,
}

/// Lists of numbers that depend on the axis.
pub(super) type Tables = Vec<Vec<f64>>;

/// The widths of blocks along one axis.
#[derive(Debug)]
pub(super) struct Widths {
    stages: Stages,
    /// What depends on the axis and the row.
    scratch: Tables,
    /// The last rotor, with values for what varies, and what it has.
    last: Option<(RotorParameters, Option<(Stiffness, Coefficients)>)>,
}

impl Widths {
    /// For an axis along which these inputs vary; none where there are no stages along them.
    pub(super) fn along(inputs: &[&'static NumericInput]) -> Option<Self> {
        if inputs.is_empty() {
            return None;
        }
        let names: Vec<_> = inputs.iter().map(|input| input.name).collect();
        let stages = match names[..] {
            ["crack_angle"] => Stages::Angle,
            ["disk_asymmetry"] => Stages::Asymmetry,
            ["crack_depth_ratio"] => Stages::Depth,
            ["crack_position_ratio"] => Stages::Place,
            _ if names.iter().all(|name| INERTIA.contains(name)) => Stages::Inertias,
            _ => return None,
        };
        Some(Self {
            stages,
            scratch: Tables::new(),
            last: None,
        })
    }

    /// What depends on the values of a block alone, which are one list for each input.
    pub(super) fn tabulate(&self, values: &[Vec<f64>], tables: &mut Tables) {
        match (self.stages, values) {
            (Stages::Angle, [angles]) => {
                use both_widths::along_crack_angle::{Along, TABLES};
                tabulate::<Along, 1, TABLES>([angles], tables);
            }
            (Stages::Asymmetry, [asymmetries]) => {
                use both_widths::along_disk_asymmetry::{Along, TABLES};
                tabulate::<Along, 1, TABLES>([asymmetries], tables);
            }
            (Stages::Depth, [depths]) => {
                use widths::along_crack_depth_ratio::{Along, TABLES};
                tabulate::<Along, 1, TABLES>([depths], tables);
            }
            _ => {}
        }
    }

    /// Evaluates those of the two results that are there, at points of plain values; whether that could be done. What comes
    /// out at other points, or where there is no region, says nothing.
    pub(super) fn evaluate(
        &mut self,
        points: closed_forms::Points<'_>,
        tables: &Tables,
        results: [Option<&mut [f64]>; 2],
    ) -> bool {
        let results = Results::new(results);
        match self.stages {
            Stages::Inertias => self.along_inertias(points, results),
            _ => self.finish(points, tables, results),
        }
        .is_some()
    }

    /// The stages of a row up to the last one; along inertias there are none that all kinds of a last stage have.
    fn finish<L: LastStage>(
        &mut self,
        points: closed_forms::Points<'_>,
        tables: &Tables,
        last: L,
    ) -> Option<L::Output> {
        let parameters = without_axis(points);
        match self.stages {
            Stages::Inertias => None,
            Stages::Angle => {
                use both_widths::along_crack_angle::{FIXED, Points, TABLES, fixed};
                let (_, c) = self.of_row(parameters)?;
                last.points::<Points, FIXED, TABLES>(&fixed(&c), tables)
            }
            Stages::Asymmetry => {
                use both_widths::along_disk_asymmetry::{FIXED, Points, TABLES, fixed};
                let (_, c) = self.of_row(parameters)?;
                last.points::<Points, FIXED, TABLES>(&fixed(&c), tables)
            }
            _ if Rotor::new(parameters).is_err() => None,
            Stages::Depth => {
                use widths::along_crack_depth_ratio::{FIXED, Points, TABLES, fixed};
                let loads = LoadCase::of(&parameters).loads(&parameters);
                let fixed = fixed(&parameters, &loads, parameters.crack_edge.factor());
                last.points::<Points, FIXED, TABLES>(&fixed, tables)
            }
            Stages::Place => self.along_places(parameters, points, last),
        }
    }

    /// What is wanted of both widths without the widths themselves, at points of plain values that all have regions. None
    /// where that cannot be done.
    pub(super) fn summaries(
        &mut self,
        points: closed_forms::Points<'_>,
        tables: &Tables,
        wanted: &Wanted,
    ) -> Option<[Summary; 2]> {
        if self.stages == Stages::Angle && *wanted == Wanted::default() {
            return self.extremes_along_angle(points, tables);
        }
        self.finish(points, tables, wanted)
    }

    /// The extremes along the crack's angle: those of the squares, which are the radicands. Of these one root is left.
    fn extremes_along_angle(
        &mut self,
        points: closed_forms::Points<'_>,
        tables: &Tables,
    ) -> Option<[Summary; 2]> {
        use both_widths_squared::along_crack_angle::{FIXED, Points, TABLES, fixed};
        let (_, c) = self.of_row(without_axis(points))?;
        let squares = Extremes::along::<Points, FIXED, TABLES, 2>(&fixed(&c), columns_of(tables));
        Some(squares.map(|squares| squares.of_roots().into()))
    }

    /// What the rotor of a row has; it is the same for all blocks of the row.
    fn of_row(&mut self, parameters: RotorParameters) -> Option<(Stiffness, Coefficients)> {
        if let Some((last, known)) = &self.last
            && *last == parameters
        {
            return *known;
        }
        let of = |rotor: Rotor| Some((rotor.stiffness().ok()?, rotor.coefficients().ok()?));
        let found = Rotor::new(parameters).ok().and_then(of);
        self.last = Some((parameters, found));
        found
    }

    fn along_inertias(
        &mut self,
        points: closed_forms::Points<'_>,
        results: Results<'_>,
    ) -> Option<()> {
        use both_widths::along_beta_and_gamma_and_delta::{Along, FIXED, Points, TABLES, fixed};
        let (k, c) = self.of_row(without_axis(points))?;
        let mut parameters = *points.row;
        let length = points.values.first().map_or(0, Vec::len);
        let mut columns = [(); 3].map(|()| Vec::with_capacity(length));
        for point in 0..length {
            set(&mut parameters, points, point);
            let c = equations::coefficients::value(&parameters, &k);
            for (column, value) in columns.iter_mut().zip([c.beta, c.gamma, c.delta]) {
                column.push(value);
            }
        }
        let columns = columns.each_ref().map(Vec::as_slice);
        tabulate::<Along, 3, TABLES>(columns, &mut self.scratch);
        results.points::<Points, FIXED, TABLES>(&fixed(&c), &self.scratch)
    }

    fn along_places<L: LastStage>(
        &mut self,
        mut parameters: RotorParameters,
        points: closed_forms::Points<'_>,
        last: L,
    ) -> Option<L::Output> {
        use widths::along_moment_of_force_and_shear_of_force_and_moment_of_couple_and_shear_of_couple::{
            Along, FIXED, Points, TABLES, fixed,
        };
        let loads = LoadCase::of(&parameters).loads(&parameters);
        let fixed = fixed(&parameters, &loads, parameters.crack_edge.factor());
        let length = points.values.first().map_or(0, Vec::len);
        let mut columns = [(); 4].map(|()| Vec::with_capacity(length));
        for point in 0..length {
            set(&mut parameters, points, point);
            let s = LoadCase::of(&parameters).loads(&parameters);
            let loads = [
                s.moment_of_force,
                s.shear_of_force,
                s.moment_of_couple,
                s.shear_of_couple,
            ];
            for (column, value) in columns.iter_mut().zip(loads) {
                column.push(value);
            }
        }
        tabulate::<Along, 4, TABLES>(columns.each_ref().map(Vec::as_slice), &mut self.scratch);
        last.points::<Points, FIXED, TABLES>(&fixed, &self.scratch)
    }
}

/// The row with values for the inputs of the axis that are allowed, whatever the others are.
fn without_axis(points: closed_forms::Points<'_>) -> RotorParameters {
    let mut parameters = *points.row;
    for input in points.varied {
        (input.set)(&mut parameters, (input.get)(&RotorParameters::PAPER));
        if INERTIA.contains(&input.name) {
            // Nothing is taken from them that depends on their values.
            (
                parameters.disk_diametral_inertia,
                parameters.disk_polar_inertia,
            ) = (1.0, 1.0);
        }
    }
    parameters
}

/// Whether the inertias are the same at all points, and with them the ratio for which there is a combination region,
/// beta < 2.
pub(super) fn all_have_regions(points: closed_forms::Points<'_>) -> bool {
    let mut varied = points.varied.iter();
    let same = !varied.any(|input| INERTIA.contains(&input.name));
    same && points.row.disk_polar_inertia < 2.0 * points.row.disk_diametral_inertia
}

/// Keeps of the known points those at which there is a combination region.
pub(super) fn keep_regions(points: closed_forms::Points<'_>, known: &mut [bool]) {
    let list = |name| {
        let position = points.varied.iter().position(|input| input.name == name);
        position.and_then(|position| points.values.get(position))
    };
    let (polar, diametral) = (list("disk_polar_inertia"), list("disk_diametral_inertia"));
    for (point, known) in known.iter_mut().enumerate() {
        let at = |list: Option<&Vec<f64>>, fixed| list.map_or(fixed, |list| list[point]);
        let polar = at(polar, points.row.disk_polar_inertia);
        *known &= polar < 2.0 * at(diametral, points.row.disk_diametral_inertia);
    }
}

/// Sets the inputs of the axis as they are at a point.
fn set(parameters: &mut RotorParameters, points: closed_forms::Points<'_>, point: usize) {
    for (input, values) in points.varied.iter().zip(points.values) {
        (input.set)(parameters, values[point]);
    }
}

/// What becomes of both widths in the last stage, the loop over the points.
trait LastStage {
    type Output;

    /// Runs the loop. None where that cannot be done.
    fn points<P, const FIXED: usize, const TABLES: usize>(
        self,
        fixed: &[f64; FIXED],
        tables: &Tables,
    ) -> Option<Self::Output>
    where
        P: Kernel<FIXED, TABLES, 2>;
}

/// Where the widths go that are wanted; the slices of others are empty.
struct Results<'a> {
    wanted: [bool; 2],
    slices: [&'a mut [f64]; 2],
}

impl<'a> Results<'a> {
    fn new(results: [Option<&'a mut [f64]>; 2]) -> Self {
        Self {
            wanted: results.each_ref().map(Option::is_some),
            slices: results.map(Option::unwrap_or_default),
        }
    }
}

impl LastStage for Results<'_> {
    type Output = ();

    fn points<P, const FIXED: usize, const TABLES: usize>(
        self,
        fixed: &[f64; FIXED],
        tables: &Tables,
    ) -> Option<()>
    where
        P: Kernel<FIXED, TABLES, 2>,
    {
        const SIMPLE: u64 = 0b01;
        const COMBINATION: u64 = 0b10;
        let (tables, slices) = (columns_of(tables), self.slices);
        let level = Level::best();
        let stored = match self.wanted {
            [true, false] => store::<P, SIMPLE, FIXED, TABLES, 2>(level, fixed, tables, slices),
            [false, true] => {
                store::<P, COMBINATION, FIXED, TABLES, 2>(level, fixed, tables, slices)
            }
            _ => store::<P, ALL, FIXED, TABLES, 2>(level, fixed, tables, slices),
        };
        stored.ok()
    }
}

impl LastStage for &Wanted {
    type Output = [Summary; 2];

    fn points<P, const FIXED: usize, const TABLES: usize>(
        self,
        fixed: &[f64; FIXED],
        tables: &Tables,
    ) -> Option<[Summary; 2]>
    where
        P: Kernel<FIXED, TABLES, 2>,
    {
        Summary::along::<P, FIXED, TABLES, 2>(Level::best(), self, fixed, columns_of(tables))
    }
}

/// The first so many columns; those that are missing are empty.
fn columns_of<const COLUMNS: usize>(columns: &[Vec<f64>]) -> [&[f64]; COLUMNS] {
    std::array::from_fn(|column| columns.get(column).map_or(&[][..], Vec::as_slice))
}

/// The stage along the axis: its numbers for each value. Without any, where it cannot be done.
fn tabulate<A, const INNER: usize, const TABLES: usize>(inner: [&[f64]; INNER], tables: &mut Tables)
where
    A: Kernel<0, INNER, TABLES>,
{
    let length = inner.first().map_or(0, |values| values.len());
    tables.resize_with(TABLES, Vec::new);
    for table in tables.iter_mut() {
        table.resize(length, f64::NAN);
    }
    let mut slices = tables.iter_mut();
    let slices = std::array::from_fn(|_| slices.next().map_or(&mut [][..], Vec::as_mut_slice));
    if store::<A, ALL, 0, INNER, TABLES>(Level::best(), &[], inner, slices).is_err() {
        tables.clear();
    }
}
