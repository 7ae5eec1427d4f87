//! Lift by shear.

use super::{Parcel, Part, WorkKind};
use crate::about::About;
use multiversion::multiversion;
use tsubu_scene::plan;

pub(super) const SAFFMAN: About = About {
    key: "water.lift.saffman",
    formula: "F = 1.615 rho sqrt(nu) d^2 sqrt(|W|) (U - u) x W/|W|",
    symbols: "U velocity of the water [m/s], u of the grain [m/s], W vorticity of the water [1/s] (dU/dz about y), d diameter [m], \
rho density [kg/m^3], nu viscosity [m^2/s]",
    limits: "Re = |U - u| d/nu well below sqrt(|W| d^2/nu), and that below 1; without the effect of a bed nearby. A grain of \
sand in a river is far outside: there it is too strong, see `saffman-mei`.",
    reference: "Saffman (1965), with the corrected factor of Saffman (1968)",
};

pub(super) const SAFFMAN_MEI: About = About {
    key: "water.lift.saffman-mei",
    formula: "F = K F_saffman; K = exp(-Re/10) + 0.3314 sqrt(b) (1 - exp(-Re/10)) up to Re = 40, 0.0524 sqrt(b Re) above; \
b = |W| d/(2 |U - u|), Re = |U - u| d/nu",
    symbols: "U velocity of the water [m/s], u of the grain [m/s], W vorticity of the water [1/s], d diameter [m], nu viscosity [m^2/s]",
    limits: "Fitted for Re from 0.1 to 100 and b from 0.005 to 0.4, used beyond; K jumps at Re = 40, by 14 % at b = 0.1. \
Without the effect of a bed nearby.",
    reference: "Mei (1992), after calculations of Dandy and Dwyer (1990)",
};

/// Saffman's 6.46 for the square of the radius is a quarter of it for that of the diameter.
const SAFFMAN_FACTOR: f64 = 1.615;
/// Re where Mei's formula changes.
const MEI_CHANGES: f64 = 40.0;

/// Lift by shear.
#[derive(Debug)]
pub(super) struct Saffman {
    mei: bool,
    density: f64,
    viscosity: f64,
}

impl Saffman {
    pub fn new(plan: &plan::Water, mei: bool) -> Self {
        Self { mei, density: plan.density, viscosity: plan.viscosity }
    }
}

impl Part for Saffman {
    fn about(&self) -> &'static About {
        if self.mei { &SAFFMAN_MEI } else { &SAFFMAN }
    }

    fn kind(&self) -> WorkKind {
        WorkKind::Relative
    }

    fn rotates(&self) -> bool {
        true
    }

    fn apply(&self, parcel: &mut Parcel) {
        lift(parcel, self.density, self.viscosity);
        if self.mei {
            correct(parcel, self.viscosity);
        }
    }
}

#[multiversion(targets = "simd")]
fn lift(p: &mut Parcel, density: f64, viscosity: f64) {
    for i in 0..p.rows() {
        let [x, y, z] = [0, 1, 2].map(|k| 2.0 * p.flow_spin[k][i]);
        let size = (x * x + y * y + z * z).sqrt();
        let d = 2.0 * p.radius[i];
        let strength = SAFFMAN_FACTOR * density * viscosity.sqrt() * (d * d) * p.wet[i];
        // Without shear there is no direction, and no force.
        let factor = if size > 0.0 { strength / size.sqrt() } else { 0.0 };
        let [u, v, w] = [0, 1, 2].map(|k| p.slip[k][i]);
        p.force[0][i] = factor * (v * z - w * y);
        p.force[1][i] = factor * (w * x - u * z);
        p.force[2][i] = factor * (u * y - v * x);
    }
}

fn correct(p: &mut Parcel, viscosity: f64) {
    for i in 0..p.rows() {
        let vorticity = 2.0 * [0, 1, 2].map(|k| p.flow_spin[k][i].powi(2)).iter().sum::<f64>().sqrt();
        let d = 2.0 * p.radius[i];
        // A grain that goes along with the water has no lift that could be corrected.
        let speed = p.speed[i].max(f64::MIN_POSITIVE);
        let reynolds = speed * d / viscosity;
        let shear = 0.5 * vorticity * d / speed;
        let slow = (-0.1 * reynolds).exp();
        let factor = if reynolds <= MEI_CHANGES {
            slow + 0.3314 * shear.sqrt() * (1.0 - slow)
        } else {
            0.0524 * (shear * reynolds).sqrt()
        };
        for force in &mut p.force {
            force[i] *= factor;
        }
    }
}
