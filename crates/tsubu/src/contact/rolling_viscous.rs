//! Rolling resistance in proportion to the rolling speed.

use super::chunk::Chunk;
use super::part::{About, Plain, Stage};
use super::root::least;
use super::slider::inertia;
use multiversion::multiversion;

pub(super) const ABOUT: About = About {
    key: "contact.rolling.viscous",
    formula: "M = -min(C mu_r R* f_n R*, I / (2 dt)) w, I = 2/5 m* R*^2",
    symbols: "w relative spin without its normal part [rad/s], C [s/m], mu_r [-], R* effective radius [m], m* [kg]",
    limits: "holds no slope at rest; the second limit keeps a step from turning the rolling",
    reference: "model B of Ai, Chen, Rotter, Ooi 2011",
};

/// `coefficient` is C [s/m].
pub(super) const fn part(coefficient: f64) -> Plain {
    Plain { about: &ABOUT, stage: Stage::Rolling, rows, number: coefficient }
}

#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk, dt: f64, coefficient: f64) {
    for i in 0..chunk.rows() {
        let roll = Chunk::vector(&chunk.roll, i);
        let arm = chunk.effective_radius[i];
        let told = coefficient * chunk.rolling[i] * arm * chunk.load[i] * arm;
        let factor = least(told, inertia(chunk, i) / (2.0 * dt));
        let torque = Chunk::vector(&chunk.torque, i) - roll * factor;
        Chunk::set(&mut chunk.torque, i, torque);
        chunk.lost_rolling[i] += factor * roll.length_squared();
    }
}
