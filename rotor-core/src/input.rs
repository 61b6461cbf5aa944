//! What a rotor is described by: its inputs in SI units, and the one table of them.
//!
//! [`RotorParameters`] is plain data, [`INPUTS`] the table of its numeric fields with what each allows. Validation, files, columns
//! and help texts all read this table.
//!
//! ```
//! use rotor_core::input::{INPUTS, NumericInput, RotorParameters};
//!
//! let depth = NumericInput::find("crack.depth_ratio").ok_or("no such input")?;
//! let mut parameters = RotorParameters::PAPER;
//! (depth.set)(&mut parameters, 0.1);
//! assert_eq!((depth.get)(&parameters), 0.1);
//! for input in &INPUTS {
//!     println!("{} [{}]: {}; {}", input.name, input.unit, input.description, input.allowed);
//! }
//! # Ok::<(), &str>(())
//! ```

use std::f64::consts::TAU;
use std::fmt;
use std::ops::RangeInclusive;

mod choice;
pub mod name;
#[cfg(test)]
mod tests;
mod variable;

pub use choice::{CrackEdge, CrackModel, UnknownChoice};
pub use variable::Variable;

/// The inputs of a rotor in SI units, not yet validated: see [`Rotor::new`](crate::jeffcott::rotor::Rotor::new) and [`INPUTS`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RotorParameters {
    /// Mass $m_d$ of the disk, kg.
    pub disk_mass: f64,
    /// Mean diametral inertia $I_d = (I_{dx}+I_{dy})/2$ of the disk, kg m².
    pub disk_diametral_inertia: f64,
    /// Polar inertia $I_p$ of the disk, kg m².
    pub disk_polar_inertia: f64,
    /// Relative inertia asymmetry $\Delta_d = (I_{dx}-I_{dy})/(2I_d)$ of the disk.
    pub disk_asymmetry: f64,
    /// Position $l_d/L$ of the disk, from the left support.
    pub disk_position_ratio: f64,
    /// Length $L$ of the shaft between its supports, m.
    pub shaft_length: f64,
    /// Radius $R$ of the shaft, m.
    pub shaft_radius: f64,
    /// Young's modulus $E$ of the shaft, Pa.
    pub shaft_youngs_modulus: f64,
    /// Poisson's ratio $\nu$ of the shaft.
    pub shaft_poissons_ratio: f64,
    /// Depth $\sigma = a/R$ of the crack.
    pub crack_depth_ratio: f64,
    /// Position $l_c/L$ of the crack, from the left support.
    pub crack_position_ratio: f64,
    /// Angle $\phi$ between the crack and the disk's major axis, rad.
    pub crack_angle: f64,
    /// How the crack enters the flexibility, E3.
    pub crack_model: CrackModel,
    /// How much of the crack's edge opens, E6.
    pub crack_edge: CrackEdge,
}

impl RotorParameters {
    /// The rotor of the paper's Section 4.
    pub const PAPER: Self = Self {
        disk_mass: 10.43,
        disk_diametral_inertia: 0.1397,
        disk_polar_inertia: 0.2096,
        disk_asymmetry: 0.2,
        disk_position_ratio: 0.25,
        shaft_length: 0.5045,
        shaft_radius: 0.011_88,
        shaft_youngs_modulus: 2.0e11,
        shaft_poissons_ratio: 0.3,
        crack_depth_ratio: 0.2,
        crack_position_ratio: 0.5,
        crack_angle: 0.0,
        crack_model: CrackModel::SupportArm,
        crack_edge: CrackEdge::Half,
    };

    /// $\beta = I_p/I_d$.
    pub fn inertia_ratio(&self) -> f64 {
        self.disk_polar_inertia / self.disk_diametral_inertia
    }

    /// Whether the moments of inertia are those of no rigid body: $2|\Delta_d| > \beta$ breaks the triangle inequality.
    pub fn exceeds_rigid_body(&self) -> bool {
        2.0 * self.disk_asymmetry.abs() > self.inertia_ratio()
    }
}

/// One end of an allowed range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// The end itself is allowed.
    Included(f64),
    /// The end itself is not allowed.
    Excluded(f64),
    /// Any finite number on this side.
    Finite,
}

/// The values an input allows. NaN and the infinities never are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Allowed {
    /// The lower end.
    pub lower: Bound,
    /// The upper end.
    pub upper: Bound,
}

impl Allowed {
    const POSITIVE: Self = Self {
        lower: Bound::Excluded(0.0),
        upper: Bound::Finite,
    };
    const INSIDE_SPAN: Self = Self {
        lower: Bound::Excluded(0.0),
        upper: Bound::Excluded(1.0),
    };
    const FINITE: Self = Self {
        lower: Bound::Finite,
        upper: Bound::Finite,
    };

    /// The least and the greatest value that are allowed.
    pub const fn range(&self) -> RangeInclusive<f64> {
        let least = match self.lower {
            Bound::Included(end) => end,
            Bound::Excluded(end) => end.next_up(),
            Bound::Finite => f64::MIN,
        };
        let greatest = match self.upper {
            Bound::Included(end) => end,
            Bound::Excluded(end) => end.next_down(),
            Bound::Finite => f64::MAX,
        };
        least..=greatest
    }

    /// Whether `value` is allowed.
    pub fn contains(&self, value: f64) -> bool {
        self.range().contains(&value)
    }
}

/// `> 0`, `> -1 and <= 0.5`, `finite`.
impl fmt::Display for Allowed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lower = match self.lower {
            Bound::Included(end) => Some(format!(">= {end}")),
            Bound::Excluded(end) => Some(format!("> {end}")),
            Bound::Finite => None,
        };
        let upper = match self.upper {
            Bound::Included(end) => Some(format!("<= {end}")),
            Bound::Excluded(end) => Some(format!("< {end}")),
            Bound::Finite => None,
        };
        match (lower, upper) {
            (Some(lower), Some(upper)) => f.pad(&format!("{lower} and {upper}")),
            (Some(end), None) | (None, Some(end)) => f.pad(&end),
            (None, None) => f.pad("finite"),
        }
    }
}

/// Sizes of numbers, of machines as there are: with others numbers may leave the range of doubles on the way to a quantity. They
/// reach from a tenth of a millimetre, or a gramme in a billion, to a thousand times what there is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sizes {
    above: f64,
    below: f64,
}

impl Sizes {
    const fn between(above: f64, below: f64) -> Self {
        Self { above, below }
    }

    /// Lengths and stiffnesses.
    const MEASURE: Self = Self::between(1e-4, 1e12);
    const INERTIA: Self = Self::between(1e-12, 1e12);
    const INSIDE_SPAN: Self = Self::between(1e-4, 1.0 - 1e-4);
    const ANY: Self = Self::between(0.0, f64::INFINITY);

    /// Whether a value has such a size, or is zero; without branches, so that a list is looked through in packs.
    #[inline]
    pub(crate) fn contain(&self, value: f64) -> bool {
        let size = value.abs();
        ((size > self.above) & (size < self.below)) | (size == 0.0)
    }
}

/// One numeric input of a rotor: its names, its unit, what it allows, and where it is kept.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct NumericInput {
    /// The one name, such as `disk_mass`: column, Python argument, field of [`RotorParameters`].
    pub name: &'static str,
    /// The section of a TOML file, such as `disk`.
    pub section: &'static str,
    /// The key in that section, such as `mass`; `section.key` on the command line.
    pub key: &'static str,
    /// The symbol in the paper, such as `m_d`.
    pub symbol: &'static str,
    /// The SI unit, empty where the input has no dimension.
    pub unit: &'static str,
    /// What it is, in a few words.
    pub description: &'static str,
    /// The values it allows.
    pub allowed: Allowed,
    /// The sizes that it has in machines as there are.
    pub(crate) sizes: Sizes,
    /// The greatest size that it has in machines; what is greater is more likely in another unit.
    pub(crate) greatest: f64,
    /// Reads it.
    pub get: fn(&RotorParameters) -> f64,
    /// Writes it.
    pub set: fn(&mut RotorParameters, f64),
}

macro_rules! input {
    ($field:ident, $section:literal, $key:literal, $symbol:literal, $unit:literal, $allowed:expr, $sizes:expr, $description:literal) => {
        NumericInput {
            name: stringify!($field),
            section: $section,
            key: $key,
            symbol: $symbol,
            unit: $unit,
            description: $description,
            allowed: $allowed,
            sizes: $sizes,
            greatest: f64::INFINITY,
            get: |parameters| parameters.$field,
            set: |parameters, value| parameters.$field = value,
        }
    };
}

impl NumericInput {
    /// The row of an input that no machine has in a greater size.
    const fn at_most(self, greatest: f64) -> Self {
        Self { greatest, ..self }
    }
}

/// In m: the shafts of the largest turbines have 70 m.
const LONGEST_SHAFT: f64 = 100.0;
/// In m: the radii of the largest shafts are about 1 m.
const THICKEST_SHAFT: f64 = 2.0;

const DISK_ASYMMETRY: Allowed = Allowed {
    lower: Bound::Excluded(-1.0),
    upper: Bound::Excluded(1.0),
};
const POISSONS_RATIO: Allowed = Allowed {
    lower: Bound::Excluded(-1.0),
    upper: Bound::Included(0.5),
};
const CRACK_DEPTH: Allowed = Allowed {
    lower: Bound::Included(0.0),
    upper: Bound::Included(1.0),
};

/// The numeric inputs in the order of the documentation, one row each. Validation, files, columns
/// and help texts all read this table.
#[rustfmt::skip]
pub static INPUTS: [NumericInput; TABLE.len()] = TABLE;

#[rustfmt::skip]
const TABLE: [NumericInput; 12] = [
    input!(disk_mass, "disk", "mass", "m_d", "kg", Allowed::POSITIVE, Sizes::INERTIA, "mass of the disk"),
    input!(disk_diametral_inertia, "disk", "diametral_inertia", "I_d", "kg m²", Allowed::POSITIVE, Sizes::INERTIA, "mean diametral inertia of the disk"),
    input!(disk_polar_inertia, "disk", "polar_inertia", "I_p", "kg m²", Allowed::POSITIVE, Sizes::INERTIA, "polar inertia of the disk"),
    input!(disk_asymmetry, "disk", "asymmetry", "Δ_d", "", DISK_ASYMMETRY, Sizes::ANY, "relative inertia asymmetry of the disk"),
    input!(disk_position_ratio, "disk", "position_ratio", "l_d/L", "", Allowed::INSIDE_SPAN, Sizes::INSIDE_SPAN, "position of the disk over the shaft's length"),
    input!(shaft_length, "shaft", "length", "L", "m", Allowed::POSITIVE, Sizes::MEASURE, "length of the shaft between its supports").at_most(LONGEST_SHAFT),
    input!(shaft_radius, "shaft", "radius", "R", "m", Allowed::POSITIVE, Sizes::MEASURE, "radius of the shaft").at_most(THICKEST_SHAFT),
    input!(shaft_youngs_modulus, "shaft", "youngs_modulus", "E", "Pa", Allowed::POSITIVE, Sizes::MEASURE, "Young's modulus of the shaft"),
    input!(shaft_poissons_ratio, "shaft", "poissons_ratio", "ν", "", POISSONS_RATIO, Sizes::ANY, "Poisson's ratio of the shaft"),
    input!(crack_depth_ratio, "crack", "depth_ratio", "σ", "", CRACK_DEPTH, Sizes::ANY, "depth of the crack over the shaft's radius"),
    input!(crack_position_ratio, "crack", "position_ratio", "l_c/L", "", Allowed::INSIDE_SPAN, Sizes::INSIDE_SPAN, "position of the crack over the shaft's length"),
    input!(crack_angle, "crack", "angle", "φ", "rad", Allowed::FINITE, Sizes::ANY, "angle between the crack and the disk's major axis").at_most(TAU),
];

impl NumericInput {
    /// Whether a value is allowed, and of a size that machines have.
    #[inline]
    pub(crate) fn is_of_a_machine(&self, value: f64) -> bool {
        self.sizes.contain(value) & self.allowed.range().contains(&value)
    }

    /// The row of a name such as `disk_mass` or `disk.mass`.
    pub fn find(name: &str) -> Option<&'static Self> {
        INPUTS.iter().find(|input| {
            input.name == name
                || name
                    .split_once('.')
                    .is_some_and(|(section, key)| input.section == section && input.key == key)
        })
    }
}

/// The place in [`INPUTS`] of the input of a name, found while the crate is built.
pub(crate) const fn place_of(name: &str) -> Option<usize> {
    let mut place = 0;
    while place < TABLE.len() {
        if is_same(TABLE[place].name, name) {
            return Some(place);
        }
        place += 1;
    }
    None
}

/// Whether two names are one; `==` is not to be had in constants.
pub(crate) const fn is_same(one: &str, other: &str) -> bool {
    let (one, other) = (one.as_bytes(), other.as_bytes());
    let mut place = 0;
    while place < one.len() && place < other.len() && one[place] == other[place] {
        place += 1;
    }
    place == one.len() && place == other.len()
}

impl PartialEq for NumericInput {
    /// Rows of [`INPUTS`] are told apart by their name.
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}
