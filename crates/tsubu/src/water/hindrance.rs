//! What the neighbours of a grain add to its drag.
//!
//! e is the share of the volume that grains leave to the water. Forces here are all that the water does to a grain beside
//! hydrostatic buoyancy: what drives the water through the crowd is not counted again in the pressure.

use super::Parcel;
use crate::about::About;
use multiversion::multiversion;
use tsubu_scene::plan::Hindrance;

pub(super) const DI_FELICE: About = About {
    key: "water.hindrance.di-felice",
    formula: "drag of a grain alone at Re = e |U - u| d/nu, times e^(1 - b), b = 3.7 - 0.65 exp(-(1.5 - log10 Re)^2/2)",
    symbols: "e share of the volume that grains leave to the water [-], U velocity of the water [m/s], u of the grain [m/s], \
d diameter [m], nu viscosity [m^2/s]",
    limits: "Needs a flow with layers, which know e. His e^(2 - b) is the drag beside the gradient of all pressure, which carries a \
grain's share of the crowd; all that is beside hydrostatic buoyancy is that over e.",
    reference: "Di Felice (1994)",
};

pub(super) const RICHARDSON_ZAKI: About = About {
    key: "water.hindrance.richardson-zaki",
    formula: "drag of a grain alone, times e^-exponent",
    symbols: "e share of the volume that grains leave to the water [-], exponent [-]",
    limits: "Needs a flow with layers, which know e. The exponent depends on Re; 3.1 is that of large grains.",
    reference: "Richardson and Zaki (1954)",
};

/// Before the drag of a grain alone: Di Felice's speed is the superficial one, e |U - u|.
pub(super) fn before(kind: &Hindrance, p: &mut Parcel) {
    if matches!(kind, Hindrance::DiFelice {}) {
        for i in 0..p.rows() {
            p.speed[i] *= p.porosity[i];
        }
    }
}

/// After it.
pub(super) fn after(kind: &Hindrance, p: &mut Parcel, viscosity: f64) {
    match kind {
        Hindrance::None {} => {}
        Hindrance::DiFelice {} => {
            for i in 0..p.rows() {
                let e = p.porosity[i];
                // Creeping flow has no logarithm; b is 3.7 to four digits from there on.
                let reynolds = (p.speed[i] * 2.0 * p.radius[i] / viscosity).max(1e-6);
                let b = 3.7 - 0.65 * (-0.5 * (1.5 - reynolds.log10()).powi(2)).exp();
                // One factor e is in the drag by its speed already; one goes for the gradient of the pressure.
                let factor = e.powf(-b);
                p.speed[i] /= e;
                scale(p, i, factor);
            }
        }
        Hindrance::RichardsonZaki { exponent } => {
            for i in 0..p.rows() {
                let factor = p.porosity[i].powf(-exponent);
                scale(p, i, factor);
            }
        }
    }
}

fn scale(p: &mut Parcel, i: usize, factor: f64) {
    for force in &mut p.force {
        force[i] *= factor;
    }
}

/// Ergun (1952) below e = 0.8: V/(e (1-e)) (150 mu (1-e)^2/(e d^2) + 1.75 rho (1-e) |U-u|/d) (U-u); Wen and Yu (1966)
/// above: C rho/2 (pi/4) d^2 |U-u| (U-u) e^-2.65, C of Schiller and Naumann with Re = e |U-u| d/nu.
#[multiversion(targets = "simd")]
pub(super) fn gidaspow(p: &mut Parcel, density: f64, viscosity: f64) {
    for i in 0..p.rows() {
        let (d, e, speed) = (2.0 * p.radius[i], p.porosity[i], p.speed[i]);
        let factor = if e < 0.8 {
            let mu = density * viscosity;
            p.volume[i] / e * (150.0 * mu * (1.0 - e) / (e * d * d) + 1.75 * density * speed / d)
        } else {
            let reynolds = e * speed * d / viscosity;
            let stokes = 24.0 * viscosity / (e * d);
            let drag = if reynolds > 1000.0 { 0.44 * speed } else { stokes * (1.0 + 0.15 * reynolds.powf(0.687)) };
            0.75 * p.volume[i] / d * density * drag * e.powf(-2.65)
        };
        p.force[0][i] = factor * p.slip[0][i];
        p.force[1][i] = factor * p.slip[1][i];
        p.force[2][i] = factor * p.slip[2][i];
    }
}
