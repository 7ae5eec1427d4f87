//! Drag.

use super::{Parcel, Part, WorkKind, hindrance};
use crate::about::About;
use crate::mutation::{Mutation, mutated};
use multiversion::multiversion;
use std::f64::consts::PI;
use tsubu_scene::plan;

const SYMBOLS: &str = "U velocity of the water [m/s], u of the grain [m/s], d diameter [m], rho density [kg/m^3], nu viscosity [m^2/s], Re [-]";
const ALONE: &str = "A sphere alone, far from walls, below the drag crisis (Re < 2e5); without the history force. A grain that is \
partly above the surface has the share of its volume that is below.";

/// A drag law of a sphere by its coefficient.
const fn by_coefficient(key: &'static str, formula: &'static str, reference: &'static str) -> About {
    About { key, formula, symbols: SYMBOLS, limits: ALONE, reference }
}

pub(super) const CONSTANT: About = by_coefficient(
    "water.drag.constant",
    "F = C rho/2 (pi/4) d^2 |U - u| (U - u), C = coefficient",
    "Newton 1687; C = 0.4 to 0.5 for a sphere at Re from 1000 to 2e5",
);
pub(super) const STOKES_NEWTON: About = by_coefficient(
    "water.drag.stokes-newton",
    "F = C rho/2 (pi/4) d^2 |U - u| (U - u), C = coefficient + 24/Re, Re = |U - u| d/nu",
    "Osada, Shimizu and Wakai (2004), equations 10 and 11; Stokes (1851)",
);
pub(super) const SCHILLER_NAUMANN: About = by_coefficient(
    "water.drag.schiller-naumann",
    "F = C rho/2 (pi/4) d^2 |U - u| (U - u), C = 24/Re (1 + 0.15 Re^0.687) up to Re = |U - u| d/nu = 1000, 0.44 above",
    "Schiller and Naumann (1935)",
);
pub(super) const ABRAHAM: About = by_coefficient(
    "water.drag.abraham",
    "F = C rho/2 (pi/4) d^2 |U - u| (U - u), C = (0.63 + 4.8/sqrt(Re))^2, Re = |U - u| d/nu",
    "Dalla Valle (1948); Abraham (1970)",
);
pub(super) const HAIDER_LEVENSPIEL: About = About {
    key: "water.drag.haider-levenspiel",
    formula: "F = C rho/2 (pi/4) d^2 |U - u| (U - u), C = 24/Re (1 + A Re^B) + C1/(1 + D/Re), Re = |U - u| d/nu\n\
A = exp(2.3288 - 6.4581 s + 2.4486 s^2), B = 0.0964 + 0.5565 s\n\
C1 = exp(4.905 - 13.8944 s + 18.4222 s^2 - 10.2599 s^3), D = exp(1.4681 + 12.2584 s - 20.7322 s^2 + 15.8855 s^3)",
    symbols: "s sphericity: surface of the sphere of the same volume over that of the grain [-], d diameter of that sphere [m], U velocity of the \
water [m/s], u of the grain [m/s], rho density [kg/m^3], nu viscosity [m^2/s], Re [-]",
    limits: "A grain alone, of any orientation: what it turns to the flow does not count. Measured for isometric bodies (cubes, octahedra, tetrahedra) \
of s from 0.67 and discs of s from 0.026, Re < 2.6e5; of spheres (s = 1) within a few per cent of `schiller-naumann`.",
    reference: "Haider and Levenspiel (1989), equations 5 and 10",
};
pub(super) const GIDASPOW: About = About {
    key: "water.drag.gidaspow",
    formula: "e < 0.8: F = V/e (150 mu (1 - e)/(e d^2) + 1.75 rho |U - u|/d) (U - u)\n\
else:    F = (3/4) C V rho |U - u|/d e^-2.65 (U - u), C of Schiller and Naumann at Re = e |U - u| d/nu",
    symbols: "e share of the volume that grains leave to the water [-], V volume of the grain [m^3], U velocity of the \
water [m/s], u of the grain [m/s], d diameter [m], rho density [kg/m^3], mu = rho nu viscosity [Pa.s]",
    limits: "Needs a flow with layers, which know e. The force jumps where e passes 0.8. All of it is beside hydrostatic buoyancy.",
    reference: "Gidaspow (1994); Ergun (1952); Wen and Yu (1966)",
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
        match self.law {
            // Without drag there is no such part.
            plan::Drag::None {} | plan::Drag::Constant { .. } => &CONSTANT,
            plan::Drag::StokesNewton { .. } => &STOKES_NEWTON,
            plan::Drag::SchillerNaumann {} => &SCHILLER_NAUMANN,
            plan::Drag::Abraham {} => &ABRAHAM,
            plan::Drag::HaiderLevenspiel {} => &HAIDER_LEVENSPIEL,
            plan::Drag::Gidaspow {} => &GIDASPOW,
        }
    }

    fn kind(&self) -> WorkKind {
        WorkKind::Relative
    }

    fn apply(&self, parcel: &mut Parcel) {
        hindrance::before(&self.hindrance, parcel);
        let density = mutated(Mutation::Drag, self.density);
        match self.law {
            plan::Drag::None {} => two_terms(parcel, density, 0.0, 0.0),
            plan::Drag::Constant { coefficient } => two_terms(parcel, density, coefficient, 0.0),
            plan::Drag::StokesNewton { coefficient } => {
                two_terms(parcel, density, coefficient, 24.0 * self.viscosity);
            }
            plan::Drag::SchillerNaumann {} => schiller_naumann(parcel, density, self.viscosity),
            plan::Drag::Abraham {} => abraham(parcel, density, self.viscosity),
            plan::Drag::HaiderLevenspiel {} => haider_levenspiel(parcel, density, self.viscosity),
            plan::Drag::Gidaspow {} => hindrance::gidaspow(parcel, density, self.viscosity),
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

/// Coefficients of Haider and Levenspiel: A, B, C1 and D.
fn by_sphericity(s: f64) -> [f64; 4] {
    [
        (2.3288 + s * (-6.4581 + s * 2.4486)).exp(),
        0.0964 + 0.5565 * s,
        (4.905 + s * (-13.8944 + s * (18.4222 - s * 10.2599))).exp(),
        (1.4681 + s * (12.2584 + s * (-20.7322 + s * 15.8855))).exp(),
    ]
}

/// C |U - u| = 24 nu/d (1 + A Re^B) + C1 |U - u| Re/(Re + D).
fn haider_levenspiel(p: &mut Parcel, density: f64, viscosity: f64) {
    // Grains of one kind follow one another.
    let mut known = (f64::NAN, [0.0; 4]);
    for i in 0..p.rows() {
        let (r, speed, sphericity) = (p.radius[i], p.speed[i], p.sphericity[i]);
        if sphericity != known.0 {
            known = (sphericity, by_sphericity(sphericity));
        }
        let [a, b, newton, late] = known.1;
        let reynolds = speed * 2.0 * r / viscosity;
        let with_speed =
            24.0 * viscosity / (2.0 * r) * (1.0 + a * reynolds.powf(b)) + newton * speed * reynolds / (reynolds + late);
        let factor = 0.5 * density * PI * r * r * p.wet[i] * with_speed;
        p.force[0][i] = factor * p.slip[0][i];
        p.force[1][i] = factor * p.slip[1][i];
        p.force[2][i] = factor * p.slip[2][i];
    }
}
