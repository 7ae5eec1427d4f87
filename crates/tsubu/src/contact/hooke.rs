//! Linear spring: Hooke.

use super::chunk::Chunk;
use super::pair::{Constants, Pair};
use super::part::{About, Part, Stage};
use super::root::most;
use multiversion::multiversion;

pub(super) const ABOUT: About = About {
    key: "contact.normal.hooke",
    formula: "f_n = k d; radius of contact a = sqrt(R* d); stored (1/2) k d^2; contact time pi sqrt(m*/k)",
    symbols: "d overlap [m], k [N/m], m* effective mass [kg], R* effective radius [m], a [m]",
    limits: "k is a choice, not a material constant",
    reference: "Cundall and Strack 1979; Osada 2004, eq. (1)",
};

#[derive(Debug)]
pub(super) struct Hooke {
    pub stiffness: f64,
}

impl Part for Hooke {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn stage(&self) -> Stage {
        Stage::Normal
    }

    fn prepare(&self, constants: &mut Constants) {
        constants.exponent = 1.0;
    }

    fn judge(&self, pair: &mut Pair) {
        pair.stiffness = self.stiffness;
    }

    fn apply(&self, chunk: &mut Chunk, _at: usize, _dt: f64) {
        rows(chunk, self.stiffness);
    }
}

#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk, stiffness: f64) {
    for i in 0..chunk.rows() {
        let overlap = most(chunk.overlap[i], 0.0);
        let force = stiffness * overlap;
        chunk.contact_radius[i] = (chunk.effective_radius[i] * overlap).sqrt();
        chunk.secant_stiffness[i] = stiffness;
        chunk.normal_force[i] = force;
        chunk.stored[i] = 0.5 * force * overlap;
    }
}
