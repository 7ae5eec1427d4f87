//! Lift by spin.

use super::{Parcel, Part, WorkKind};
use crate::about::About;
use multiversion::multiversion;
use std::f64::consts::PI;
use tsubu_scene::plan;

pub(super) const MAGNUS: About = About {
    key: "water.lift.magnus",
    formula: "F = pi rho r^3 (w - Omega) x (u - U)",
    symbols: "w spin of the grain [rad/s], Omega of the water, half its vorticity [rad/s], u velocity of the grain [m/s], U of the \
water [m/s], r radius [m], rho density [kg/m^3]",
    limits: "Re = |U - u| d/nu below 1. At Re = 100 and r |w - Omega| = |U - u| it is three times too strong, see \
`magnus-oesterle-dinh`.",
    reference: "Rubinow and Keller (1961)",
};

pub(super) const OESTERLE_DINH: About = About {
    key: "water.lift.magnus-oesterle-dinh",
    formula: "F = K F_magnus; K = E + 0.45 (1 - E)/q, E = exp(-0.05684 Re_w^0.4 Re^0.3), q = Re_w/Re; \
Re_w = |w - Omega| d^2/nu, Re = |U - u| d/nu",
    symbols: "w spin of the grain [rad/s], Omega of the water, half its vorticity [rad/s], u velocity of the grain [m/s], U of the \
water [m/s], d diameter [m], nu viscosity [m^2/s]",
    limits: "Fitted for Re from 10 to 140 and q from 2 to 12, used beyond. Slow spin in fast flow lifts as fast spin does: there K \
is above 1 and doubtful. Without the drag crisis, which turns the lift.",
    reference: "Oesterle and Dinh (1998)",
};

/// Lift by spin.
#[derive(Debug)]
pub(super) struct Magnus {
    oesterle_dinh: bool,
    density: f64,
    viscosity: f64,
}

impl Magnus {
    pub fn new(plan: &plan::Water, oesterle_dinh: bool) -> Self {
        Self { oesterle_dinh, density: plan.density, viscosity: plan.viscosity }
    }
}

impl Part for Magnus {
    fn about(&self) -> &'static About {
        if self.oesterle_dinh { &OESTERLE_DINH } else { &MAGNUS }
    }

    fn kind(&self) -> WorkKind {
        WorkKind::Relative
    }

    fn rotates(&self) -> bool {
        true
    }

    fn apply(&self, parcel: &mut Parcel) {
        lift(parcel, self.density);
        if self.oesterle_dinh {
            correct(parcel, self.viscosity);
        }
    }
}

/// Both differences are taken the other way round than in the formula: the product is the same.
#[multiversion(targets = "simd")]
fn lift(p: &mut Parcel, density: f64) {
    for i in 0..p.rows() {
        let r = p.radius[i];
        let factor = PI * density * (r * r * r) * p.wet[i];
        let [a, b, c] = [0, 1, 2].map(|k| p.turn[k][i]);
        let [u, v, w] = [0, 1, 2].map(|k| p.slip[k][i]);
        p.force[0][i] = factor * (b * w - c * v);
        p.force[1][i] = factor * (c * u - a * w);
        p.force[2][i] = factor * (a * v - b * u);
    }
}

fn correct(p: &mut Parcel, viscosity: f64) {
    for i in 0..p.rows() {
        let d = 2.0 * p.radius[i];
        // Without spin or without motion there is no lift that could be corrected.
        let [spin, speed] = [p.turning[i], p.speed[i]].map(|size| size.max(f64::MIN_POSITIVE));
        let (turning, moving) = (spin * d * d / viscosity, speed * d / viscosity);
        let slow = (-0.05684 * turning.powf(0.4) * moving.powf(0.3)).exp();
        let factor = slow + 0.45 * (1.0 - slow) * moving / turning;
        for force in &mut p.force {
            force[i] *= factor;
        }
    }
}
