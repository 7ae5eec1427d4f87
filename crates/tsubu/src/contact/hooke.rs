//! Linear spring: Hooke.

use super::chunk::Chunk;
use super::part::{About, Part, Stage};
use super::table::Pair;

const ABOUT: About = About {
    name: "hooke",
    models: "contact as a linear spring; its contact time does not depend on the impact speed",
    formula: "f_n = k d; stored (1/2) k d^2; contact time pi sqrt(m*/k)",
    symbols: "d overlap [m], k [N/m], m* reduced mass [kg]",
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

    fn prepare(&self, pair: &mut Pair) {
        pair.exponent = 1.0;
        pair.stiffness = self.stiffness;
    }

    fn apply(&self, chunk: &mut Chunk, _dt: f64) {
        for i in 0..chunk.len {
            let force = chunk.stiffness[i] * chunk.overlap[i];
            chunk.normal_force[i] += force;
            chunk.stored[i] += 0.5 * force * chunk.overlap[i];
        }
    }
}
