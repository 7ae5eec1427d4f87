//! The same attraction in every contact.

use super::chunk::Chunk;
use super::dmt::pull;
use super::part::{About, Plain, Stage};
use multiversion::multiversion;

pub(super) const ABOUT: About = About {
    key: "contact.cohesion.constant",
    formula: "f_n = f_elastic - F; friction sees f_n + F; stored less F d",
    symbols: "F the materials' cohesion [N], d overlap [m]",
    limits: "a model force; it ends with the overlap",
    reference: "in general use; Rognon et al. 2008 for flows of such grains",
};

pub(super) const fn part() -> Plain {
    Plain { about: &ABOUT, stage: Stage::Cohesion, rows: |chunk, _, _| rows(chunk), number: 0.0 }
}

#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk) {
    pull(chunk, 1.0, |c, i| c.cohesion[i]);
}
