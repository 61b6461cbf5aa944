//! Both widths of a block in packs, in stages along its axis.

use lanes::{ALL, Kernel, Level, store};

use crate::equations::{
    self, both_widths, widths, widths_midspan_arm, widths_simply_supported_left,
    widths_simply_supported_right, widths_support_arm,
};
use crate::rotor::{INPUTS, LoadCase, NumericInput, Rotor, RotorParameters};

/// The inputs that leave the stiffness as it is.
const INERTIA: [&str; 3] = ["disk_mass", "disk_diametral_inertia", "disk_polar_inertia"];

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
    /// Anything else: everything at every point.
    All,
}

/// The widths of blocks along one axis.
pub(super) struct Widths {
    stages: Stages,
    inputs: Vec<&'static NumericInput>,
    /// What depends on the axis alone, one list for each number.
    tables: Vec<Vec<f64>>,
    /// Whether the values of the block are such that widths can be computed in packs, point by point.
    plain: Vec<bool>,
    /// Of these the points at which there is a combination region.
    open: Vec<bool>,
}

impl Widths {
    /// For an axis along which these inputs vary.
    pub(super) fn along(inputs: &[&'static NumericInput]) -> Self {
        let names: Vec<_> = inputs.iter().map(|input| input.name).collect();
        let stages = match names[..] {
            ["crack_angle"] => Stages::Angle,
            ["disk_asymmetry"] => Stages::Asymmetry,
            ["crack_depth_ratio"] => Stages::Depth,
            ["crack_position_ratio"] => Stages::Place,
            _ if names.iter().all(|name| INERTIA.contains(name)) => Stages::Inertias,
            _ => Stages::All,
        };
        Self {
            stages,
            inputs: inputs.to_vec(),
            tables: Vec::new(),
            plain: Vec::new(),
            open: Vec::new(),
        }
    }

    /// Takes the values of a block, one list for each input.
    pub(super) fn enter(&mut self, values: &[Vec<f64>]) {
        let length = values.first().map_or(0, Vec::len);
        self.plain.clear();
        self.plain.resize(length, true);
        for (input, values) in self.inputs.iter().zip(values) {
            for (plain, value) in self.plain.iter_mut().zip(values) {
                *plain &= is_plain(input, *value);
            }
        }
        let tables = &mut self.tables;
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

    /// Evaluates the row with these inputs, but for those of the axis, for those of the two results that are there.
    /// Whether that can be done in packs at all.
    pub(super) fn evaluate(
        &mut self,
        row: &RotorParameters,
        values: &[Vec<f64>],
        results: [Option<&mut [f64]>; 2],
    ) -> bool {
        let results = Results::new(results);
        let parameters = self.without_axis(row);
        let plain = |input: &NumericInput| {
            let varied = self.inputs.iter().any(|varied| varied.name == input.name);
            varied || is_plain(input, (input.get)(row))
        };
        let Ok(rotor) = Rotor::new(parameters) else {
            return false;
        };
        if !(INPUTS.iter().all(plain) && self.find_open(row, values)) {
            return false;
        }
        match self.stages {
            Stages::Angle | Stages::Asymmetry | Stages::Inertias => {
                self.along_coefficients(&rotor, row, values, results)
            }
            Stages::Depth => {
                use widths::along_crack_depth_ratio::{FIXED, Points, TABLES, fixed};
                let loads = LoadCase::of(&parameters).loads(&parameters);
                let fixed = fixed(&parameters, &loads, parameters.crack_edge.factor());
                results.points::<Points, FIXED, TABLES>(&fixed, &self.tables)
            }
            Stages::Place => self.along_places(parameters, values, results),
            Stages::All => self.at_every_point(row, values, results),
        }
    }

    /// Whether the numbers of a point are the widths of regions that exist.
    pub(super) fn is_open(&self, point: usize) -> bool {
        self.open.get(point).copied().unwrap_or(false)
    }

    /// Whether they are at every point.
    pub(super) fn all_are_open(&self) -> bool {
        self.open.iter().all(|open| *open)
    }

    /// The row with values for the inputs of the axis that are allowed, whatever the others are.
    fn without_axis(&self, row: &RotorParameters) -> RotorParameters {
        let mut parameters = *row;
        for input in &self.inputs {
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

    /// Finds the points of plain values at which there is a combination region, beta < 2; whether there are any.
    fn find_open(&mut self, row: &RotorParameters, values: &[Vec<f64>]) -> bool {
        self.open.clone_from(&self.plain);
        let varied = |name| {
            let position = self.inputs.iter().position(|input| input.name == name);
            position.and_then(|position| values.get(position))
        };
        let (polar, diametral) = (
            varied("disk_polar_inertia"),
            varied("disk_diametral_inertia"),
        );
        if polar.is_none() && diametral.is_none() {
            return row.disk_polar_inertia < 2.0 * row.disk_diametral_inertia;
        }
        for (point, open) in self.open.iter_mut().enumerate() {
            let at = |list: Option<&Vec<f64>>, fixed| list.map_or(fixed, |list| list[point]);
            let polar = at(polar, row.disk_polar_inertia);
            *open &= polar < 2.0 * at(diametral, row.disk_diametral_inertia);
        }
        self.open.contains(&true)
    }

    fn along_coefficients(
        &mut self,
        rotor: &Rotor,
        row: &RotorParameters,
        values: &[Vec<f64>],
        results: Results<'_>,
    ) -> bool {
        let (Ok(k), Ok(c)) = (rotor.stiffness(), rotor.coefficients()) else {
            return false;
        };
        match self.stages {
            Stages::Angle => {
                use both_widths::along_crack_angle::{FIXED, Points, TABLES, fixed};
                results.points::<Points, FIXED, TABLES>(&fixed(&c), &self.tables)
            }
            Stages::Asymmetry => {
                use both_widths::along_disk_asymmetry::{FIXED, Points, TABLES, fixed};
                results.points::<Points, FIXED, TABLES>(&fixed(&c), &self.tables)
            }
            _ => {
                use both_widths::along_beta_and_gamma_and_delta::{
                    Along, FIXED, Points, TABLES, fixed,
                };
                let mut parameters = *row;
                let mut columns = [(); 3].map(|()| Vec::with_capacity(self.plain.len()));
                for point in 0..self.plain.len() {
                    self.set(&mut parameters, values, point);
                    let c = equations::coefficients::value(&parameters, &k);
                    for (column, value) in columns.iter_mut().zip([c.beta, c.gamma, c.delta]) {
                        column.push(value);
                    }
                }
                tabulate::<Along, 3, TABLES>(
                    columns.each_ref().map(Vec::as_slice),
                    &mut self.tables,
                );
                results.points::<Points, FIXED, TABLES>(&fixed(&c), &self.tables)
            }
        }
    }

    fn along_places(
        &mut self,
        mut parameters: RotorParameters,
        values: &[Vec<f64>],
        results: Results<'_>,
    ) -> bool {
        use widths::along_moment_of_force_and_shear_of_force_and_moment_of_couple_and_shear_of_couple::{
            Along, FIXED, Points, TABLES, fixed,
        };
        let loads = LoadCase::of(&parameters).loads(&parameters);
        let fixed = fixed(&parameters, &loads, parameters.crack_edge.factor());
        let mut columns = [(); 4].map(|()| Vec::with_capacity(self.plain.len()));
        for point in 0..self.plain.len() {
            self.set(&mut parameters, values, point);
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
        tabulate::<Along, 4, TABLES>(columns.each_ref().map(Vec::as_slice), &mut self.tables);
        results.points::<Points, FIXED, TABLES>(&fixed, &self.tables)
    }

    fn at_every_point(
        &mut self,
        parameters: &RotorParameters,
        values: &[Vec<f64>],
        results: Results<'_>,
    ) -> bool {
        let length = self.plain.len();
        self.tables.resize_with(INPUTS.len(), Vec::new);
        for (table, input) in self.tables.iter_mut().zip(&INPUTS) {
            let mut varied = self.inputs.iter().zip(values);
            table.clear();
            match varied.find(|(varied, _)| varied.name == input.name) {
                Some((_, values)) => table.extend_from_slice(values),
                None => table.resize(length, (input.get)(parameters)),
            }
        }
        let edge_factors = vec![parameters.crack_edge.factor(); length];
        let mut at_point = *parameters;
        let cases = (0..length).map(|point| {
            self.set(&mut at_point, values, point);
            LoadCase::of(&at_point)
        });
        let cases: Vec<LoadCase> = cases.collect();
        let mut slices = results.slices;
        // With the crack on both sides of the disk two formulas hold, each at its points.
        for case in LoadCase::ALL {
            if !cases.contains(&case) {
                continue;
            }
            let mut computed = [(); 2].map(|()| vec![0.0; length]);
            if !columns(case, &self.tables, &edge_factors, &mut computed) {
                return false;
            }
            for (slice, computed) in slices.iter_mut().zip(&computed) {
                let there = slice.iter_mut().zip(computed).zip(&cases);
                for ((result, value), _) in there.filter(|(_, there)| **there == case) {
                    *result = *value;
                }
            }
        }
        true
    }

    /// Sets the inputs of the axis as they are at a point.
    fn set(&self, parameters: &mut RotorParameters, values: &[Vec<f64>], point: usize) {
        for (input, values) in self.inputs.iter().zip(values) {
            (input.set)(parameters, values[point]);
        }
    }
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

    /// The last stage: the loop over the points. Whether it could be done.
    fn points<P, const FIXED: usize, const TABLES: usize>(
        self,
        fixed: &[f64; FIXED],
        tables: &[Vec<f64>],
    ) -> bool
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
        stored.is_ok()
    }
}

/// The first so many columns; those that are missing are empty.
fn columns_of<const COLUMNS: usize>(columns: &[Vec<f64>]) -> [&[f64]; COLUMNS] {
    std::array::from_fn(|column| columns.get(column).map_or(&[][..], Vec::as_slice))
}

/// The stage along the axis: its numbers for each value. Without any, where it cannot be done.
fn tabulate<A, const INNER: usize, const TABLES: usize>(
    inner: [&[f64]; INNER],
    tables: &mut Vec<Vec<f64>>,
) where
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

/// Both widths at every point from the inputs in the order of [`INPUTS`]. Whether that could be done.
fn columns(
    case: LoadCase,
    inputs: &[Vec<f64>],
    edge_factor: &[f64],
    results: &mut [Vec<f64>; 2],
) -> bool {
    let [
        p_disk_mass,
        p_disk_diametral_inertia,
        p_disk_polar_inertia,
        p_disk_asymmetry,
        p_disk_position_ratio,
        p_shaft_length,
        p_shaft_radius,
        p_shaft_youngs_modulus,
        p_shaft_poissons_ratio,
        p_crack_depth_ratio,
        p_crack_position_ratio,
        p_crack_angle,
    ] = columns_of(inputs);
    macro_rules! in_model {
        ($model:ident) => {{
            let inputs = $model::Columns {
                p_disk_mass,
                p_disk_diametral_inertia,
                p_disk_polar_inertia,
                p_disk_asymmetry,
                p_disk_position_ratio,
                p_shaft_length,
                p_shaft_radius,
                p_shaft_youngs_modulus,
                p_shaft_poissons_ratio,
                p_crack_depth_ratio,
                p_crack_position_ratio,
                p_crack_angle,
                edge_factor,
            };
            $model::columns(&inputs, results.each_mut().map(Vec::as_mut_slice)).is_ok()
        }};
    }
    match case {
        LoadCase::SupportArm => in_model!(widths_support_arm),
        LoadCase::MidspanArm => in_model!(widths_midspan_arm),
        LoadCase::SimplySupportedLeft => in_model!(widths_simply_supported_left),
        LoadCase::SimplySupportedRight => in_model!(widths_simply_supported_right),
    }
}

/// Whether an allowed input is of a size with which nothing leaves the range of numbers on the way to a width: from a
/// tenth of a millimetre, or a gramme in a billion, to a thousand times what there is.
fn is_plain(input: &NumericInput, value: f64) -> bool {
    const LARGEST: f64 = 1e12;
    let size = value.abs();
    match input.name {
        "crack_angle" | "shaft_poissons_ratio" => true,
        "crack_depth_ratio" | "disk_asymmetry" => size == 0.0 || size > 1e-9,
        "disk_position_ratio" | "crack_position_ratio" => size > 1e-4 && size < 1.0 - 1e-4,
        name if INERTIA.contains(&name) => size > 1e-12 && size < LARGEST,
        _ => size > 1e-4 && size < LARGEST,
    }
}
