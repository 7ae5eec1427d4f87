//! Torque on spin.

use super::{Parcel, Part, WorkKind};
use crate::about::About;
use multiversion::multiversion;
use std::f64::consts::PI;
use tsubu_scene::plan;

pub(super) const STOKES: About = About {
    key: "water.torque.stokes",
    formula: "T = 8 pi mu r^3 (Omega - w)",
    symbols: "Omega spin of the water, half its vorticity [rad/s], w of the grain [rad/s], r radius [m], mu = rho nu [Pa.s]",
    limits: "Re = |Omega - w| d^2/nu below about 10; a sphere alone, far from walls. A leaping grain of sand has thousands: there \
it is several times too weak.",
    reference: "Stokes (1845); Lamb, Hydrodynamics, section 334",
};

pub(super) const FINITE_REYNOLDS: About = About {
    key: "water.torque.finite-reynolds",
    formula: "T = C rho/2 r^5 |Omega - w| (Omega - w), C the larger of 64 pi/Re and 12.9/sqrt(Re) + 128.4/Re, \
Re = |Omega - w| d^2/nu",
    symbols: "Omega spin of the water, half its vorticity [rad/s], w of the grain [rad/s], r radius, d diameter [m], \
rho density [kg/m^3], nu viscosity [m^2/s]",
    limits: "The two meet at Re = 32, the first is Stokes's; fitted up to Re = 4000, where the 12.9/sqrt(Re) of a boundary layer leads. \
A sphere that does not move through the water, alone, far from walls. With r^2 in Re instead of d^2 the same numbers are not \
continuous at 32 and give twice the boundary layer's torque.",
    reference: "Dennis, Singh and Ingham (1980), with r^2 in Re 6.45/sqrt(Re) + 32.1/Re; Crowe et al. (1998), Multiphase Flows \
with Droplets and Particles",
};

/// Torque on spin.
#[derive(Debug)]
pub(super) struct Torque {
    law: plan::Torque,
    density: f64,
    viscosity: f64,
}

impl Torque {
    pub fn new(plan: &plan::Water) -> Self {
        Self { law: plan.torque, density: plan.density, viscosity: plan.viscosity }
    }
}

impl Part for Torque {
    fn about(&self) -> &'static About {
        match self.law {
            plan::Torque::None {} | plan::Torque::Stokes {} => &STOKES,
            plan::Torque::FiniteReynolds {} => &FINITE_REYNOLDS,
        }
    }

    fn kind(&self) -> WorkKind {
        WorkKind::Turning
    }

    fn apply(&self, parcel: &mut Parcel) {
        // C Re of the two formulas, and C sqrt(Re) of the second.
        let stokes = 64.0 * PI;
        let numbers = match self.law {
            plan::Torque::None {} => [0.0, 0.0, 0.0],
            plan::Torque::Stokes {} => [stokes, 0.0, 0.0],
            plan::Torque::FiniteReynolds {} => [stokes, 128.4, 12.9],
        };
        turn(parcel, self.density, self.viscosity, numbers);
    }
}

/// C |Omega - w| without a division by a spin that may be zero: nu/d^2 times C Re.
#[multiversion(targets = "simd")]
fn turn(p: &mut Parcel, density: f64, viscosity: f64, [slow, steady, fast]: [f64; 3]) {
    for i in 0..p.rows() {
        let r = p.radius[i];
        let square = r * r;
        let rate = viscosity / (4.0 * square);
        let (slow, fast) = (slow * rate, steady * rate + fast * (p.turning[i] * rate).sqrt());
        let with_spin = if fast > slow { fast } else { slow };
        let factor = 0.5 * density * (square * square * r) * p.wet[i] * with_spin;
        p.torque[0][i] = factor * p.turn[0][i];
        p.torque[1][i] = factor * p.turn[1][i];
        p.torque[2][i] = factor * p.turn[2][i];
    }
}
