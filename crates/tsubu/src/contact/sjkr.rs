//! Attraction in proportion to the area of the overlap (the simplified JKR of other codes).

use super::chunk::Chunk;
use super::part::{About, Plain, Stage};
use multiversion::multiversion;
use std::f64::consts::PI;

pub(super) const ABOUT: About = About {
    key: "contact.cohesion.sjkr",
    formula: "f_n = f_elastic - C A, A = 2 pi R* d; friction sees f_n + C A; stored less C pi R* d^2",
    symbols: "C the materials' cohesion [Pa], R* effective radius [m], d overlap [m]",
    limits: "no theory of adhesion: the same C binds a softer material more strongly, as d is larger; nothing at d = 0",
    reference: "the cohesion model sjkr of LIGGGHTS, for overlaps small against the radii; its sjkr2 takes twice the area",
};

pub(super) const fn part() -> Plain {
    Plain { about: &ABOUT, stage: Stage::Cohesion, rows: |chunk, _, _| rows(chunk), number: 0.0 }
}

#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk) {
    for i in 0..chunk.rows() {
        // R* d is the square of the disc's radius, and zero where nothing touches.
        let force = 2.0 * PI * chunk.cohesion[i] * (chunk.contact_radius[i] * chunk.contact_radius[i]);
        chunk.normal_force[i] -= force;
        chunk.stored[i] -= 0.5 * force * chunk.overlap[i];
        chunk.pull_off[i] += force;
    }
}
