//! The same attraction in every contact.

use super::chunk::Chunk;
use super::dmt::pull;
use super::part::{About, Part, Stage};
use multiversion::multiversion;

const ABOUT: About = About {
    name: "constant",
    models: "one attraction in every contact of two materials, whatever the sizes",
    formula: "f_n = f_elastic - F; friction sees f_n + F; stored less F d",
    symbols: "F the materials' cohesion [N], d overlap [m]",
    limits: "a model force; it ends with the overlap",
    reference: "in general use; Rognon et al. 2008 for flows of such grains",
};

#[derive(Debug)]
pub(super) struct CohesionConstant;

impl Part for CohesionConstant {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn stage(&self) -> Stage {
        Stage::Cohesion
    }

    fn apply(&self, chunk: &mut Chunk, _at: usize, _dt: f64) {
        rows(chunk);
    }
}

#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk) {
    pull(chunk, 1.0, |c, i| c.cohesion[i]);
}
