//! Drag.

use super::{Kind, Parcel, Part, hindrance};
use crate::contact::part::About;
use multiversion::multiversion;
use std::f64::consts::PI;
use tsubu_scene::plan;

static ABOUT: About = About {
    name: "drag",
    models: "Resistance of the water to a sphere that moves through it steadily.",
    formula: "F = C rho/2 (pi/4) d^2 |U - u| (U - u), Re = |U - u| d/nu; \
constant: C; stokes-newton: C + 24/Re; schiller-naumann: 24/Re (1 + 0.15 Re^0.687), 0.44 above Re = 1000; \
abraham: (0.63 + 4.8/sqrt(Re))^2; with neighbours times what `hindrance` says; gidaspow: Ergun's bed, Wen and Yu's suspension",
    symbols: "U velocity of the water [m/s], u of the grain [m/s], d diameter [m], rho density [kg/m^3], nu viscosity [m^2/s]",
    limits: "A sphere alone, far from walls, below the drag crisis (Re < 2e5); without the history force. A grain that is partly \
above the surface has the share of its volume that is below.",
    reference: "Osada, Shimizu and Wakai (2004), equations 10 and 11; Schiller and Naumann (1935); Dalla Valle (1948); Abraham (1970); \
Di Felice (1994); Richardson and Zaki (1954); Gidaspow (1994)",
};

/// Re above which Schiller and Naumann's sphere has 0.44.
const NEWTON: f64 = 1000.0;

/// Drag with one of the coefficients.
#[derive(Debug)]
pub(super) struct Drag {
    law: plan::Drag,
    hindrance: plan::Hindrance,
    density: f64,
    viscosity: f64,
}

impl Drag {
    pub fn new(plan: &plan::Water) -> Self {
        Self { law: plan.drag, hindrance: plan.hindrance, density: plan.density, viscosity: plan.viscosity }
    }
}

impl Part for Drag {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn kind(&self) -> Kind {
        Kind::Relative
    }

    fn apply(&self, parcel: &mut Parcel) {
        hindrance::before(&self.hindrance, parcel);
        match self.law {
            plan::Drag::None {} => two_terms(parcel, self.density, 0.0, 0.0),
            plan::Drag::Constant { coefficient } => two_terms(parcel, self.density, coefficient, 0.0),
            plan::Drag::StokesNewton { coefficient } => {
                two_terms(parcel, self.density, coefficient, 24.0 * self.viscosity);
            }
            plan::Drag::SchillerNaumann {} => schiller_naumann(parcel, self.density, self.viscosity),
            plan::Drag::Abraham {} => abraham(parcel, self.density, self.viscosity),
            plan::Drag::Gidaspow {} => hindrance::gidaspow(parcel, self.density, self.viscosity),
        }
        hindrance::after(&self.hindrance, parcel, self.viscosity);
    }
}

/// C |U - u| of C = newton + stokes/(d |U - u|): without a division by a speed that may be zero.
#[multiversion(targets = "simd")]
fn two_terms(p: &mut Parcel, density: f64, newton: f64, stokes: f64) {
    for i in 0..p.rows() {
        let r = p.radius[i];
        let area = 0.5 * density * PI * r * r * p.wet[i];
        let factor = area * (newton * p.speed[i] + stokes / (2.0 * r));
        p.force[0][i] = factor * p.slip[0][i];
        p.force[1][i] = factor * p.slip[1][i];
        p.force[2][i] = factor * p.slip[2][i];
    }
}

/// C |U - u| = (0.63 sqrt(|U - u|) + 4.8 sqrt(nu/d))^2.
#[multiversion(targets = "simd")]
fn abraham(p: &mut Parcel, density: f64, viscosity: f64) {
    for i in 0..p.rows() {
        let r = p.radius[i];
        let area = 0.5 * density * PI * r * r * p.wet[i];
        let root = 0.63 * p.speed[i].sqrt() + 4.8 * (viscosity / (2.0 * r)).sqrt();
        let factor = area * root * root;
        p.force[0][i] = factor * p.slip[0][i];
        p.force[1][i] = factor * p.slip[1][i];
        p.force[2][i] = factor * p.slip[2][i];
    }
}

fn schiller_naumann(p: &mut Parcel, density: f64, viscosity: f64) {
    for i in 0..p.rows() {
        let (r, speed) = (p.radius[i], p.speed[i]);
        let reynolds = speed * 2.0 * r / viscosity;
        let stokes = 24.0 * viscosity / (2.0 * r);
        let with_speed = if reynolds > NEWTON { 0.44 * speed } else { stokes * (1.0 + 0.15 * reynolds.powf(0.687)) };
        let factor = 0.5 * density * PI * r * r * p.wet[i] * with_speed;
        p.force[0][i] = factor * p.slip[0][i];
        p.force[1][i] = factor * p.slip[1][i];
        p.force[2][i] = factor * p.slip[2][i];
    }
}
