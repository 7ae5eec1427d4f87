//! Rolling friction from the width of contact.

use super::chunk::Chunk;
use super::part::{About, Plain, Stage};
use super::slider::resist;
use crate::mutation::{Mutation, mutated};
use multiversion::multiversion;

pub(super) const ABOUT: About = About {
    key: "contact.rolling.contact-width",
    formula: "M = -f' b f_n w / max(|w|, v_eps / R*, w_dt), b = 2 sqrt(2 R* d), which for equal spheres is 2 sqrt(r d)",
    symbols: "w relative spin without its normal part [rad/s], f' [-], b width of the overlap [m], r radius, d overlap [m]",
    limits: "f' = 1/2 puts the arm at the rim of the overlap; b grows as the material gets softer; below v_eps it creeps",
    reference: "Osada 2004, eq. (B13), turned against the rolling instead of the moment of the tangential forces",
};

/// `smoothing_speed` is v_eps [m/s].
pub(super) const fn part(smoothing_speed: f64) -> Plain {
    Plain { about: &ABOUT, stage: Stage::Rolling, rows, number: smoothing_speed }
}

#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk, dt: f64, slow: f64) {
    // The disc has the radius sqrt(R* d); the overlap of undeformed spheres is sqrt(2) times as wide.
    let width = 2.0 * std::f64::consts::SQRT_2;
    resist(chunk, slow, dt, |c, i| {
        c.rolling[i] * mutated(Mutation::RollingArm, width * c.contact_radius[i]) * c.load[i]
    });
}
