//! The kinds of instability regions.

use std::fmt;

/// The unstable regions a rotor can have on isotropic rigid supports.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum RegionKind {
    /// The simple region (SIR) where $\omega_2 = \Omega$, Eq. (15).
    Simple,
    /// The second simple region, where $\omega_1 = \Omega$; only for $\beta < 1$ (E9).
    UpperSimple,
    /// The combination region (CIR) where $\omega_1 + \omega_2 = 2\Omega$, Eq. (16); only for
    /// $\beta < 2$.
    Combination,
}

impl RegionKind {
    /// Every kind.
    pub const ALL: [Self; 3] = [Self::Simple, Self::UpperSimple, Self::Combination];

    /// The name in texts, such as `simple instability region`.
    pub const fn description(self) -> &'static str {
        match self {
            Self::Simple => "simple instability region",
            Self::UpperSimple => "upper simple instability region",
            Self::Combination => "combination instability region",
        }
    }

    /// The short name in the names of quantities: `sir`, `upper_sir`, `cir`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Simple => "sir",
            Self::UpperSimple => "upper_sir",
            Self::Combination => "cir",
        }
    }

    /// What keeps the whirl frequencies from the region's condition where $\beta$ is too large.
    pub(crate) const fn why_none(self) -> &'static str {
        match self {
            Self::Simple | Self::UpperSimple => "the forward whirl is faster than the rotor",
            Self::Combination => "the forward whirl is faster than twice the rotor",
        }
    }

    /// The region exists only for $\beta$ below this.
    pub(crate) const fn inertia_ratio_limit(self) -> Option<f64> {
        match self {
            Self::Simple => None,
            Self::UpperSimple => Some(1.0),
            Self::Combination => Some(2.0),
        }
    }
}

impl fmt::Display for RegionKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
