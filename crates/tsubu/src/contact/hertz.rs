//! Elastic spheres: Hertz.

use super::chunk::{Chunk, Column};
use super::pair::{Constants, Pair};
use super::part::{About, Part, Stage};
use super::root::most;
use multiversion::multiversion;

pub(super) const ABOUT: About = About {
    key: "contact.normal.hertz",
    formula: "f_n = k d^(3/2), k = (4/3) E* sqrt(R*); radius of contact a = sqrt(R* d); stored (2/5) k d^(5/2)",
    symbols: "d overlap [m], E* effective modulus [Pa], R* effective radius [m], k [N/m^1.5], a [m]",
    limits: "small overlaps (d below about 1 % of the diameter), no adhesion, no plasticity",
    reference: "Hertz 1882; Komatsuzaki 2003, eqs. (3), (5), (6)",
};

/// Secant stiffness f/d [N/m] of a contact disc of radius `disc` [m]; with sqrt(R*) for the disc, k [N/m^1.5].
#[inline(always)]
pub(super) fn secant(effective_modulus: f64, disc: f64) -> f64 {
    4.0 / 3.0 * effective_modulus * disc
}

#[derive(Debug)]
pub(super) struct Hertz;

impl Part for Hertz {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn stage(&self) -> Stage {
        Stage::Normal
    }

    fn prepare(&self, constants: &mut Constants) {
        constants.exponent = 1.5;
    }

    fn judge(&self, pair: &mut Pair) {
        pair.stiffness = secant(pair.constants.effective_modulus, pair.radius.sqrt());
    }

    fn apply(&self, chunk: &mut Chunk, _at: usize, _dt: f64) {
        rows(chunk);
    }

    /// The energy goes with the root of the radius.
    fn energy_slopes(&self, chunk: &Chunk, slopes: &mut Column) {
        for i in 0..chunk.rows() {
            slopes[i] += 0.2 * chunk.secant_stiffness[i] * chunk.overlap[i].powi(2) / chunk.effective_radius[i];
        }
    }
}

#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk) {
    for i in 0..chunk.rows() {
        let overlap = most(chunk.overlap[i], 0.0);
        let disc = (chunk.effective_radius[i] * overlap).sqrt();
        let secant = secant(chunk.effective_modulus[i], disc);
        let force = secant * overlap;
        chunk.contact_radius[i] = disc;
        chunk.secant_stiffness[i] = secant;
        chunk.normal_force[i] = force;
        chunk.stored[i] = 0.4 * force * overlap;
    }
}
