//! The last stage: from what the points of a block have to each quantity, in packs, to wherever it goes.

use lanes::{ALL, Kernel, Level, store};

use crate::batch::extremes::Itself;
use crate::equations::{
    Coefficients, both_widths, both_widths_squared, cir_start, cir_width, cir_zup_asymmetry,
    reference_speed, sir_start, sir_width, sir_zup_asymmetry, widths,
};
use crate::jeffcott::region::RegionKind;
use crate::quantity::Quantity;

use super::chain::{Chain, Needs};
use super::destination::{Columns, Destination, Finite, Kind, Partial, Positive};
use super::iteration::{Ends, GrowthRate, coefficients, number_of};
use super::list::{List, columns};
use super::stage::{self, Inputs};

use both_widths::along_beta_and_gamma_and_delta_and_epsilon_1_and_epsilon_12_and_epsilon_2 as along_coefficients;
use both_widths::{along_crack_angle, along_disk_asymmetry};
use widths::along_c11_and_c22_and_c33_and_c44 as along_compliance;

/// The columns of the first so many coefficients, or of other numbers, as an equation takes them.
macro_rules! slices {
    ($equation:ident, 3) => {
        slices!($equation, 3, c_beta, c_gamma, c_delta)
    };
    ($equation:ident, 6) => {
        slices!(
            $equation, 6, c_beta, c_gamma, c_delta, c_epsilon_1, c_epsilon_12, c_epsilon_2
        )
    };
    ($equation:ident, 8) => {
        slices!(
            $equation, 8, c_beta, c_gamma, c_delta, c_epsilon_1, c_epsilon_12, c_epsilon_2,
            c_disk_asymmetry, c_crack_angle
        )
    };
    ($equation:ident, $count:literal $(, $field:ident)*) => {{
        fn slices([$($field),*]: [&[f64]; $count]) -> [&[f64]; $count] {
            $equation::Columns { $($field),* }.slices()
        }
        slices
    }};
}

/// What quantities need of the chain, if widths are computed so.
pub(super) fn needs(quantities: &[Quantity], widths: Option<Widths>) -> Needs {
    let mut needs = Needs::default();
    for quantity in quantities {
        match quantity {
            Quantity::C11 | Quantity::C22 | Quantity::C33 | Quantity::C44 => {}
            Quantity::ReferenceSpeed => needs.stiffness = true,
            Quantity::SirWidth | Quantity::CirWidth if widths == Some(Widths::FromCompliance) => {}
            _ => (needs.stiffness, needs.coefficients) = (true, true),
        }
        needs.iteration |= matches!(
            quantity,
            Quantity::SirExactLower
                | Quantity::SirExactUpper
                | Quantity::CirExactLower
                | Quantity::CirExactUpper
                | Quantity::GrowthRate
        );
        needs.combination |= matches!(
            quantity,
            Quantity::CirStart
                | Quantity::CirWidth
                | Quantity::CirZupAsymmetry
                | Quantity::CirExactLower
                | Quantity::CirExactUpper
        );
    }
    needs
}

/// How the widths among quantities are best computed where these inputs vary within a block, and from one row to the next
/// those of the next axis, if there is one.
pub(super) fn widths_along(
    quantities: &[Quantity],
    varied: Inputs,
    next: Option<Inputs>,
) -> Widths {
    let is_width = |quantity| matches!(quantity, &Quantity::SirWidth | &Quantity::CirWidth);
    let of_compliance = varied != 0 && varied & !stage::inputs_of_compliance_alone() == 0;
    let others = next.is_none_or(|next| next & stage::inputs_of_coefficients() != 0);
    if of_compliance && others && quantities.iter().all(is_width) {
        Widths::FromCompliance
    } else {
        Widths::FromCoefficients
    }
}

/// What both widths have of each of these angles or asymmetries, whatever the coefficients: their tables along the only
/// input that varies.
#[derive(Clone, Debug)]
pub(super) enum AxisTables {
    Angle([Vec<f64>; along_crack_angle::TABLES]),
    Asymmetry([Vec<f64>; along_disk_asymmetry::TABLES]),
    /// Another input varies too, or instead.
    None,
}

impl AxisTables {
    pub(super) fn along(varied: &[&str], values: &[&[f64]]) -> Self {
        match (varied, values) {
            (["crack_angle"], [angles]) => {
                tabulated::<along_crack_angle::Along, _>(angles).map_or(Self::None, Self::Angle)
            }
            (["disk_asymmetry"], [asymmetries]) => {
                tabulated::<along_disk_asymmetry::Along, _>(asymmetries)
                    .map_or(Self::None, Self::Asymmetry)
            }
            _ => Self::None,
        }
    }
}

fn tabulated<A, const TABLES: usize>(values: &[f64]) -> Option<[Vec<f64>; TABLES]>
where
    A: Kernel<0, 1, TABLES>,
{
    let mut tables = [(); TABLES].map(|()| vec![f64::NAN; values.len()]);
    let slices = tables.each_mut().map(Vec::as_mut_slice);
    store::<A, ALL, 0, 1, TABLES>(Level::best(), &[], [values], slices).ok()?;
    Some(tables)
}

/// How both widths are computed together, in stages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Widths {
    /// From the coefficients, of which some may vary; the next row may well have the same coefficients.
    FromCoefficients,
    /// From the crack's compliance, which alone varies, in one loop; the next row has other coefficients.
    FromCompliance,
}

/// A block of a row: what its points have.
pub(super) struct Row<'a> {
    pub(super) chain: &'a mut Chain,
    pub(super) tables: &'a AxisTables,
    /// The disk's asymmetry, the crack's angle and the speed.
    pub(super) asymmetry: &'a mut List,
    pub(super) angle: &'a mut List,
    pub(super) speed: &'a mut List,
    /// Any column of the points.
    pub(super) any: &'a [f64],
}

impl Row<'_> {
    /// Evaluates these quantities, the widths in stages. None where that cannot be done.
    pub(super) fn evaluate<D: Destination>(
        &mut self,
        quantities: &[Quantity],
        widths: Widths,
        to: &mut D,
    ) -> Option<()> {
        for places in pairs(quantities, [Quantity::SirWidth, Quantity::CirWidth]) {
            if widths == Widths::FromCompliance {
                self.widths_from_compliance(places, to)?;
            } else {
                self.widths_from_coefficients(places, to)?;
            }
        }
        self.others(quantities, to)
    }

    /// The same with the digits that a rotor has alone.
    pub(super) fn evaluate_alone(
        &mut self,
        quantities: &[Quantity],
        to: &mut Columns<'_, '_>,
    ) -> Option<()> {
        let any = self.any;
        for (place, quantity) in quantities.iter().enumerate() {
            match quantity {
                Quantity::SirWidth => {
                    let (lists, slices) = (self.coefficients()?, slices!(sir_width, 8));
                    along::<sir_width::Rows, Positive, _, 8>(place, lists, slices, any, to)?;
                }
                Quantity::CirWidth => {
                    let (lists, slices) = (self.coefficients()?, slices!(cir_width, 8));
                    along::<cir_width::Rows, Positive, _, 8>(place, lists, slices, any, to)?;
                }
                _ => {}
            }
        }
        self.others(quantities, to)
    }

    /// Evaluates all but the widths.
    fn others<D: Destination>(&mut self, quantities: &[Quantity], to: &mut D) -> Option<()> {
        use Quantity::{CirExactLower, CirExactUpper, SirExactLower, SirExactUpper};
        for (region, ends) in [
            (RegionKind::Simple, [SirExactLower, SirExactUpper]),
            (RegionKind::Combination, [CirExactLower, CirExactUpper]),
        ] {
            for places in pairs(quantities, ends) {
                let (region, any) = ([number_of(region)], self.any);
                let lists = self.coefficients()?;
                both::<Ends, Partial, D, 1, 8>(places, &region, lists, |columns| columns, any, to)?;
            }
        }
        for (place, quantity) in quantities.iter().enumerate() {
            self.single(place, *quantity, to)?;
        }
        Some(())
    }

    /// Evaluates a quantity that does not come in a pair.
    fn single<D: Destination>(
        &mut self,
        place: usize,
        quantity: Quantity,
        to: &mut D,
    ) -> Option<()> {
        let any = self.any;
        let number = quantity as usize;
        // The equations take the first three or six of the coefficients.
        macro_rules! of_coefficients {
            ($equation:ident, $kind:ty, $count:tt) => {{
                let lists = self.chain.coefficients()?.first_chunk_mut::<$count>()?;
                let slices = slices!($equation, $count);
                along::<$equation::Rows, $kind, D, $count>(place, lists.each_mut(), slices, any, to)
            }};
        }
        match quantity {
            Quantity::C11 | Quantity::C22 | Quantity::C33 | Quantity::C44 => {
                let list = &mut self.chain.compliance()?[number - Quantity::C11 as usize];
                along::<Itself, Finite, D, 1>(place, [list], |columns| columns, any, to)
            }
            Quantity::Beta
            | Quantity::Gamma
            | Quantity::Delta
            | Quantity::Epsilon1
            | Quantity::Epsilon12
            | Quantity::Epsilon2 => {
                let list = &mut self.chain.coefficients()?[number - Quantity::Beta as usize];
                along::<Itself, Finite, D, 1>(place, [list], |columns| columns, any, to)
            }
            Quantity::ReferenceSpeed => {
                let lists = self.chain.mass_and_stiffness()?;
                let slices = slices!(reference_speed, 2, p_disk_mass, k_k_tt);
                along::<reference_speed::Rows, Positive, D, 2>(place, lists, slices, any, to)
            }
            Quantity::SirStart => of_coefficients!(sir_start, Positive, 3),
            Quantity::CirStart => of_coefficients!(cir_start, Positive, 3),
            Quantity::SirZupAsymmetry => of_coefficients!(sir_zup_asymmetry, Finite, 6),
            Quantity::CirZupAsymmetry => of_coefficients!(cir_zup_asymmetry, Finite, 6),
            Quantity::GrowthRate => {
                let lists = self.coefficients_and_speed()?;
                along::<GrowthRate, Partial, D, 9>(place, lists, |columns| columns, any, to)
            }
            // These come in pairs.
            Quantity::SirWidth
            | Quantity::CirWidth
            | Quantity::SirExactLower
            | Quantity::SirExactUpper
            | Quantity::CirExactLower
            | Quantity::CirExactUpper => Some(()),
        }
    }

    /// The coefficients of all points.
    fn coefficients(&mut self) -> Option<[&mut List; 8]> {
        let [coefficients @ .., _] = self.coefficients_and_speed()?;
        Some(coefficients)
    }

    fn coefficients_and_speed(&mut self) -> Option<[&mut List; 9]> {
        let [beta, gamma, delta, epsilon_1, epsilon_12, epsilon_2] =
            self.chain.coefficients()?.each_mut();
        let (asymmetry, angle) = (&mut *self.asymmetry, &mut *self.angle);
        let speed = &mut *self.speed;
        Some([
            beta, gamma, delta, epsilon_1, epsilon_12, epsilon_2, asymmetry, angle, speed,
        ])
    }

    fn widths_from_coefficients<D: Destination>(
        &mut self,
        places: [Option<usize>; 2],
        to: &mut D,
    ) -> Option<()> {
        let first = self.first()?;
        if self.chain.coefficients_are_same() {
            match self.tables {
                AxisTables::Angle(tables) => {
                    use along_crack_angle::{FIXED, Points, TABLES, fixed};
                    use both_widths_squared::along_crack_angle as squares;
                    let tables = tables.each_ref().map(Vec::as_slice);
                    let squared = squares::fixed(&first);
                    // The widths' squares have the tables of the widths.
                    if to.squares::<squares::Points, { squares::FIXED }, TABLES>(
                        places, &squared, tables,
                    )? {
                        return Some(());
                    }
                    return to.pair::<Points, Positive, FIXED, TABLES>(
                        places,
                        &fixed(&first),
                        tables,
                    );
                }
                AxisTables::Asymmetry(tables) => {
                    use along_disk_asymmetry::{FIXED, Points, TABLES, fixed};
                    let tables = tables.each_ref().map(Vec::as_slice);
                    return to.pair::<Points, Positive, FIXED, TABLES>(
                        places,
                        &fixed(&first),
                        tables,
                    );
                }
                AxisTables::None => {}
            }
        } else if self.asymmetry.is_same() && self.angle.is_same() {
            use along_coefficients::{FIXED, Points, TABLES, fixed};
            let tables = columns(self.chain.regions()?, self.any.len());
            return to.pair::<Points, Positive, FIXED, TABLES>(places, &fixed(&first), tables);
        }
        let any = self.any;
        both::<both_widths::Rows, Positive, D, 0, 8>(
            places,
            &[],
            self.coefficients()?,
            slices!(both_widths, 8),
            any,
            to,
        )
    }

    fn widths_from_compliance<D: Destination>(
        &mut self,
        places: [Option<usize>; 2],
        to: &mut D,
    ) -> Option<()> {
        use along_compliance::{FIXED, Points, TABLES};
        let points = self.any.len();
        let (fixed, lists) = self.chain.crack()?;
        to.pair::<Points, Positive, FIXED, TABLES>(places, &fixed, columns(lists, points))
    }

    /// The coefficients of the first point.
    fn first(&mut self) -> Option<Coefficients> {
        let numbers = self.coefficients()?.map(|list| list.number());
        Some(coefficients(&numbers))
    }
}

/// The places of two quantities among others, of which each may come more than once.
fn pairs(
    quantities: &[Quantity],
    pair: [Quantity; 2],
) -> impl Iterator<Item = [Option<usize>; 2]> + use<'_> {
    let [mut first, mut second] = pair.map(|wanted| {
        let places = quantities.iter().enumerate();
        places.filter_map(move |(place, quantity)| (*quantity == wanted).then_some(place))
    });
    std::iter::from_fn(move || {
        let places = [first.next(), second.next()];
        places.iter().any(Option::is_some).then_some(places)
    })
}

/// A quantity by an equation along lists, which it takes in an order of its own; or once where these are the same at all
/// points, of which there is `any` column.
fn along<K, T, D, const COUNT: usize>(
    place: usize,
    lists: [&mut List; COUNT],
    slices: fn([&[f64]; COUNT]) -> [&[f64]; COUNT],
    any: &[f64],
    to: &mut D,
) -> Option<()>
where
    K: Kernel<0, COUNT, 1>,
    T: Kind,
    D: Destination,
{
    if !lists.iter().all(|list| list.is_same()) {
        let columns = slices(lists.map(|list| list.spread(any.len())));
        return to.single::<K, T, 0, COUNT>(place, &[], columns);
    }
    let [mut number] = [f64::NAN];
    let result = [std::slice::from_mut(&mut number)];
    let columns = slices(lists.map(|list| list.spread(1)));
    store::<K, ALL, 0, COUNT, 1>(Level::best(), &[], columns, result).ok()?;
    to.same::<T>(place, number, any)
}

/// The same for two quantities of one equation.
fn both<K, T, D, const FIXED: usize, const COUNT: usize>(
    places: [Option<usize>; 2],
    fixed: &[f64; FIXED],
    lists: [&mut List; COUNT],
    slices: fn([&[f64]; COUNT]) -> [&[f64]; COUNT],
    any: &[f64],
    to: &mut D,
) -> Option<()>
where
    K: Kernel<FIXED, COUNT, 2>,
    T: Kind,
    D: Destination,
{
    if !lists.iter().all(|list| list.is_same()) {
        let columns = slices(lists.map(|list| list.spread(any.len())));
        return to.pair::<K, T, FIXED, COUNT>(places, fixed, columns);
    }
    let mut numbers = [f64::NAN; 2];
    let results = numbers.each_mut().map(std::slice::from_mut);
    let columns = slices(lists.map(|list| list.spread(1)));
    store::<K, ALL, FIXED, COUNT, 2>(Level::best(), fixed, columns, results).ok()?;
    for (place, number) in places.into_iter().zip(numbers) {
        if let Some(place) = place {
            to.same::<T>(place, number, any)?;
        }
    }
    Some(())
}
