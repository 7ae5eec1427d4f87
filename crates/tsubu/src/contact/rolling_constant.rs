//! Rolling resistance of constant torque.

use super::chunk::Chunk;
use super::part::{About, Plain, Stage};
use super::slider::resist;
use crate::mutation::{Mutation, mutated};
use multiversion::multiversion;

pub(super) const ABOUT: About = About {
    key: "contact.rolling.constant",
    formula: "M = -mu_r R* f_n w / max(|w|, v_eps / R*, w_dt), w_dt = 5 mu_r f_n dt / (m* R*)",
    symbols: "w relative spin without its normal part [rad/s], R* effective radius [m], mu_r [-], v_eps [m/s], m* [kg]",
    limits: "does not hold a slope at rest: below v_eps the grain creeps; w_dt keeps a step from turning the rolling",
    reference: "model A of Ai, Chen, Rotter, Ooi 2011",
};

/// `smoothing_speed` is v_eps [m/s].
pub(super) const fn part(smoothing_speed: f64) -> Plain {
    Plain { about: &ABOUT, stage: Stage::Rolling, rows, number: smoothing_speed }
}

#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk, dt: f64, slow: f64) {
    resist(chunk, slow, dt, |c, i| c.rolling[i] * mutated(Mutation::RollingArm, c.effective_radius[i]) * c.load[i]);
}
