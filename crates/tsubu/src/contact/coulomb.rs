//! Sliding friction without a spring: Coulomb.

use super::chunk::Chunk;
use super::part::{About, Plain, Stage};
use super::root::most;
use super::slider::TINY;
use multiversion::multiversion;

pub(super) const ABOUT: About = About {
    key: "contact.tangential.coulomb",
    formula: "f_t = -mu f_n v_t / max(|v_t|, v_eps, 2 mu f_n dt / m*)",
    symbols: "mu friction coefficient [-], f_n normal force [N], v_t slip velocity [m/s], v_eps [m/s], m* [kg]",
    limits: "no static friction: a heap creeps at speeds below v_eps",
    reference: "Komatsuzaki 2003, eq. (4), sign fixed",
};

/// `smoothing_speed` is v_eps [m/s].
pub(super) const fn part(smoothing_speed: f64) -> Plain {
    Plain { about: &ABOUT, stage: Stage::Tangential, rows, number: smoothing_speed }
}

#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk, dt: f64, slow: f64) {
    for i in 0..chunk.rows() {
        let slip = Chunk::vector(&chunk.slip, i);
        let squared = slip.length_squared();
        let limit = chunk.friction[i] * chunk.load[i];
        // Friction may stop a slip within a step and never turn it: taken literally at long steps it would chatter, and chatter
        // makes energy. The factor 2 leaves room for the several contacts of a grain. Gone as dt -> 0.
        let turning = 2.0 * limit * dt / chunk.effective_mass[i];
        let factor = limit / most(most(squared.sqrt(), slow), most(turning, TINY));
        Chunk::set(&mut chunk.tangential_force, i, slip * -factor);
        chunk.lost_sliding[i] = factor * squared;
    }
}
