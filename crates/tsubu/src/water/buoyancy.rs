//! Buoyancy.

use super::{Kind, Parcel, Part};
use crate::contact::part::About;
use glam::DVec3;
use multiversion::multiversion;
use tsubu_scene::plan;

static ABOUT: About = About {
    name: "buoyancy",
    models: "What the stress in the water does to the place that a grain takes: the weight of the water that was there.",
    formula: "F = - rho V g; `normal`: without the part of g along x",
    symbols: "rho density of the water [kg/m^3], V volume of the grain under water [m^3], g gravity [m/s^2]",
    limits: "Hydrostatic pressure and the shear stress of a steady uniform stream. A grain's weight never includes its added mass: \
read with it, as Osada et al. print it, a grain would be lighter by C rho V g.",
    reference: "Osada, Shimizu and Wakai (2004), equations 10 and 11, with (sigma - rho) V g for (m - rho V) g",
};

/// Buoyancy.
#[derive(Debug)]
pub(super) struct Buoyancy {
    /// Force on a volume of water [N/m^3].
    lift: DVec3,
}

impl Buoyancy {
    pub fn new(plan: &plan::Water, gravity: DVec3) -> Self {
        let carried = match plan.buoyancy {
            plan::Buoyancy::Vertical => gravity,
            plan::Buoyancy::Normal => DVec3 { x: 0.0, ..gravity },
        };
        Self { lift: -plan.density * carried }
    }
}

impl Part for Buoyancy {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn kind(&self) -> Kind {
        Kind::Pressure
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
