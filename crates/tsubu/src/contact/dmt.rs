//! Attraction of stiff, small spheres: Derjaguin, Muller, Toporov.

use super::chunk::Chunk;
use super::part::{About, Plain, Stage};
use multiversion::multiversion;
use std::f64::consts::PI;

pub(super) const ABOUT: About = About {
    key: "contact.cohesion.dmt",
    formula: "f_n = f_Hertz - F_c, F_c = 4 pi gamma R*; friction sees f_n + 2 F_c; stored less F_c d",
    symbols: "gamma surface energy of one face [J/m^2] (work of adhesion 2 gamma), R* effective radius [m], d overlap [m]",
    limits: "no attraction before touch and after parting; for R* gamma^2 / (E*^2 z^3) well below 1, z the range of the forces",
    reference: "Derjaguin, Muller, Toporov 1975; friction as Thornton 1991",
};

/// A constant attraction [N] while the bodies touch.
#[inline(always)]
pub(super) fn pull(chunk: &mut Chunk, held: f64, force: impl Fn(&Chunk, usize) -> f64) {
    for i in 0..chunk.rows() {
        let force = if chunk.contact_radius[i] > 0.0 { force(chunk, i) } else { 0.0 };
        chunk.normal_force[i] -= force;
        chunk.stored[i] -= force * chunk.overlap[i];
        chunk.pull_off[i] += held * force;
    }
}

pub(super) const fn part() -> Plain {
    Plain { about: &ABOUT, stage: Stage::Cohesion, rows: |chunk, _, _| rows(chunk), number: 0.0 }
}

#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk) {
    pull(chunk, 2.0, |c, i| 4.0 * PI * c.surface_energy[i] * c.effective_radius[i]);
}
