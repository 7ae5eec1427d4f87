//! Attraction between bodies in contact.

use crate::key::variants;

variants! {
    /// Attraction between bodies in contact.
    Cohesion {
        None "none" "No attraction" {}

        Dmt "dmt"
        "Adhesion of stiff spheres: Hertz under a constant pull (Derjaguin, Muller, Toporov 1975); with `normal.hertz`" {}

        Jkr "jkr"
        "Adhesion of soft spheres, in place of Hertz: holds on beyond the overlap until pull-off (Johnson, Kendall, Roberts 1971); with `normal.hertz`" {}

        Sjkr "sjkr"
        "Attraction by the materials' `cohesion`, an energy density, times the area in which the spheres overlap" {}

        Constant "constant"
        "One attraction in every contact, whatever the sizes: the materials' `cohesion`, a force" {}
    }
}

/// What of the materials a kind of cohesion reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strength {
    /// `surface-energy`; such a kind is a theory of elastic spheres, and goes with Hertz alone.
    SurfaceEnergy,
    /// `cohesion`, a force.
    Force,
    /// `cohesion`, an energy density.
    EnergyDensity,
}

impl Cohesion {
    /// What of the materials it reads.
    pub const fn strength(&self) -> Option<Strength> {
        match self {
            Self::None {} => None,
            Self::Dmt {} | Self::Jkr {} => Some(Strength::SurfaceEnergy),
            Self::Sjkr {} => Some(Strength::EnergyDensity),
            Self::Constant {} => Some(Strength::Force),
        }
    }
}

/// Names of the kinds that read `cohesion` as a force.
pub(crate) const READ_A_FORCE: &[&str] = &["constant"];
/// Names of those that read it as an energy density.
pub(crate) const READ_A_DENSITY: &[&str] = &["sjkr"];
