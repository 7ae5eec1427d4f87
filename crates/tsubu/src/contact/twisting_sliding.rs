//! Resistance against spin about the normal, as of a sliding disc.

use super::chunk::Chunk;
use super::part::{About, Plain, Stage};
use super::root::most;
use super::slider::{TINY, turning};
use multiversion::multiversion;

pub(super) const ABOUT: About = About {
    key: "contact.twisting.sliding",
    formula: "M = -(2/3) mu_t a f_n w / max(|w|, w_eps, w_dt), w_dt = 2 |M| dt / (2/5 m* R*^2)",
    symbols: "w relative spin about the normal [rad/s], a radius of the contact disc [m], mu_t [-], w_eps [rad/s]",
    limits: "even pressure over the disc; no static resistance: below w_eps it creeps",
    reference: "Marshall 2009, eq. (33)",
};

/// `smoothing_spin` is w_eps [rad/s].
pub(super) const fn part(smoothing_spin: f64) -> Plain {
    Plain { about: &ABOUT, stage: Stage::Twisting, rows, number: smoothing_spin }
}

/// Largest torque of a row [N.m].
#[inline(always)]
pub(super) fn limit(chunk: &Chunk, i: usize) -> f64 {
    2.0 / 3.0 * chunk.twisting[i] * chunk.contact_radius[i] * chunk.load[i]
}

#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk, dt: f64, slow: f64) {
    for i in 0..chunk.rows() {
        let (twist, limit) = (chunk.twist[i], limit(chunk, i));
        let slow = most(most(slow, turning(chunk, i, limit, dt)), TINY);
        let factor = limit / most(twist.abs(), slow);
        let torque = Chunk::vector(&chunk.torque, i) - Chunk::vector(&chunk.normal, i) * (factor * twist);
        Chunk::set(&mut chunk.torque, i, torque);
        chunk.lost_rolling[i] += factor * (twist * twist);
    }
}
