//! Buoyancy.

use super::{Parcel, Part, WorkKind};
use crate::about::About;
use crate::mutation::{Mutation, mutated};
use glam::DVec3;
use multiversion::multiversion;
use tsubu_scene::plan;

pub(super) const VERTICAL: About = About {
    key: "water.buoyancy.vertical",
    formula: "F = - rho V g",
    symbols: "rho density of the water [kg/m^3], V volume of the grain under water [m^3], g gravity [m/s^2]",
    limits: "Hydrostatic pressure and the shear stress of a steady uniform stream. A grain's weight never includes its added mass: \
read with it, as Osada et al. print it, a grain would be lighter by C rho V g.",
    reference: "Osada, Shimizu and Wakai (2004), equations 10 and 11, with (sigma - rho) V g for (m - rho V) g",
};

pub(super) const NORMAL: About = About {
    key: "water.buoyancy.normal",
    formula: "F = - rho V (g - g_x), g_x the part of g along x",
    symbols: "rho density of the water [kg/m^3], V volume of the grain under water [m^3], g gravity [m/s^2]",
    limits: "Pressure alone, as below a surface parallel to x: what the shear stress of the stream adds along x is left out.",
    reference: "Hydrostatics",
};

/// Buoyancy.
#[derive(Debug)]
pub(super) struct Buoyancy {
    /// Force on a volume of water [N/m^3].
    lift: DVec3,
    about: &'static About,
}

impl Buoyancy {
    pub fn new(plan: &plan::Water, gravity: DVec3) -> Self {
        let (carried, about) = match plan.buoyancy {
            plan::Buoyancy::Vertical => (gravity, &VERTICAL),
            plan::Buoyancy::Normal => (DVec3 { x: 0.0, ..gravity }, &NORMAL),
        };
        Self { lift: -mutated(Mutation::Buoyancy, plan.density) * carried, about }
    }
}

impl Part for Buoyancy {
    fn about(&self) -> &'static About {
        self.about
    }

    fn kind(&self) -> WorkKind {
        WorkKind::Pressure
    }

    fn apply(&self, parcel: &mut Parcel) {
        lift(parcel, self.lift.to_array());
    }
}

#[multiversion(targets = "simd")]
fn lift(p: &mut Parcel, lift: [f64; 3]) {
    let n = p.rows();
    for (force, lift) in p.force.iter_mut().zip(lift) {
        for i in 0..n {
            force[i] = lift * p.volume[i];
        }
    }
}
