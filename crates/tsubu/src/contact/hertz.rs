//! Elastic spheres: Hertz.

use super::chunk::Chunk;
use super::part::{About, Part, Stage};
use super::table::Pair;

const ABOUT: About = About {
    name: "hertz",
    models: "elastic contact of smooth spheres, or of a sphere and a plane",
    formula: "f_n = k d^(3/2), k = (4/3) E* sqrt(R*); stored (2/5) k d^(5/2)",
    symbols: "d overlap [m], E* reduced modulus [Pa], R* reduced radius [m], k [N/m^1.5]",
    limits: "small overlaps (d below about 1 % of the diameter), no adhesion, no plasticity",
    reference: "Hertz 1882; Komatsuzaki 2003, eqs. (3), (5), (6)",
};

#[derive(Debug)]
pub(super) struct Hertz;

impl Part for Hertz {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn stage(&self) -> Stage {
        Stage::Normal
    }

    fn prepare(&self, pair: &mut Pair) {
        pair.exponent = 1.5;
        pair.stiffness = 4.0 / 3.0 * pair.young * pair.radius.sqrt();
    }

    fn apply(&self, chunk: &mut Chunk, _dt: f64) {
        for i in 0..chunk.len {
            let force = chunk.stiffness[i] * chunk.overlap[i] * chunk.root[i];
            chunk.normal_force[i] += force;
            chunk.stored[i] += 0.4 * force * chunk.overlap[i];
        }
    }
}
