//! What is computed together for the points of a block, and the inputs that it depends on.

use std::sync::LazyLock;

use crate::input::INPUTS;

/// A set of inputs, bit 0 for the first of [`INPUTS`].
pub(super) type Inputs = u16;

/// The inputs that the loads at the crack's section depend on.
const PLACES: [&str; 3] = [
    "disk_position_ratio",
    "shaft_length",
    "crack_position_ratio",
];

/// Those that the crack's compliance depends on.
const CRACK: [&str; 4] = [
    "shaft_radius",
    "shaft_youngs_modulus",
    "shaft_poissons_ratio",
    "crack_depth_ratio",
];

/// The disk's mass and those that beta is the ratio of.
pub(super) const MASS: &str = "disk_mass";
pub(super) const INERTIA: [&str; 2] = ["disk_diametral_inertia", "disk_polar_inertia"];

/// The inputs of these names.
pub(super) fn inputs(names: &[&str]) -> Inputs {
    let places = (0..INPUTS.len()).filter(|place| names.contains(&INPUTS[*place].name));
    places.fold(0, |set, place| set | 1 << place)
}

/// The inputs that change the crack's compliance and nothing else.
pub(super) fn inputs_of_compliance_alone() -> Inputs {
    inputs(&["shaft_poissons_ratio", "crack_depth_ratio"])
}

/// The inputs that the coefficients depend on, but for the two that are coefficients themselves.
pub(super) fn inputs_of_coefficients() -> Inputs {
    DEPENDS[Stage::Coefficients as usize]
}

/// What each stage depends on: found once, for there may be many small tables.
pub(super) static DEPENDS: LazyLock<[Inputs; Stage::ALL.len()]> =
    LazyLock::new(|| Stage::ALL.map(Stage::inputs));

/// What is computed together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stage {
    Loads,
    Compliance,
    Inertia,
    Crack,
    Stiffness,
    Coefficients,
    Regions,
}

impl Stage {
    pub(super) const ALL: [Self; 7] = [
        Self::Loads,
        Self::Compliance,
        Self::Inertia,
        Self::Crack,
        Self::Stiffness,
        Self::Coefficients,
        Self::Regions,
    ];

    /// The inputs that it depends on.
    fn inputs(self) -> Inputs {
        let of_stiffness = inputs(&PLACES) | inputs(&CRACK);
        match self {
            Self::Loads => inputs(&PLACES),
            Self::Compliance | Self::Crack => inputs(&CRACK),
            Self::Inertia => inputs(&INERTIA),
            Self::Stiffness => of_stiffness,
            Self::Coefficients | Self::Regions => of_stiffness | inputs(&INERTIA) | inputs(&[MASS]),
        }
    }
}
