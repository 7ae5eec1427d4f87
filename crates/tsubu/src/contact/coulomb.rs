//! Sliding friction without a spring: Coulomb.

use super::chunk::Chunk;
use super::part::{About, Part, Stage};
use super::table::Pair;

const ABOUT: About = About {
    name: "coulomb",
    models: "sliding friction, fading below a small speed instead of sticking",
    formula: "f_t = -mu f_n v_t / max(|v_t|, v_eps, 2 mu f_n dt / m*)",
    symbols: "mu friction coefficient [-], f_n normal force [N], v_t slip velocity [m/s], v_eps [m/s], m* [kg]",
    limits: "no static friction: a heap creeps at speeds below v_eps",
    reference: "Komatsuzaki 2003, eq. (4), sign fixed",
};

#[derive(Debug)]
pub(super) struct Coulomb {
    pub smoothing_speed: f64,
}

impl Part for Coulomb {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn stage(&self) -> Stage {
        Stage::Tangential
    }

    fn prepare(&self, _pair: &mut Pair) {}

    fn apply(&self, chunk: &mut Chunk, dt: f64) {
        let [sx, sy, sz] = &chunk.slip;
        let [fx, fy, fz] = &mut chunk.tangential_force;
        for i in 0..chunk.len {
            let squared = sx[i] * sx[i] + sy[i] * sy[i] + sz[i] * sz[i];
            // An attracting normal force carries no friction; it would push the bodies along their motion.
            let limit = chunk.friction[i] * chunk.normal_force[i].max(0.0);
            // Friction may stop a slip within a step and never turn it: taken literally at long steps it would chatter, and
            // chatter makes energy. The factor 2 leaves room for the several contacts of a grain. Gone as dt -> 0.
            let turning = 2.0 * limit * dt / chunk.mass[i];
            let factor = limit / squared.sqrt().max(self.smoothing_speed).max(turning);
            fx[i] -= factor * sx[i];
            fy[i] -= factor * sy[i];
            fz[i] -= factor * sz[i];
            chunk.lost_sliding[i] += factor * squared;
        }
    }
}
