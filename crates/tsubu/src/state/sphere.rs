//! Spheres, and spheres that a plane cuts.

#![allow(clippy::inline_always, reason = "a call inside a row would end the vector code of its loop")]

use std::f64::consts::PI;

/// Volume of a sphere [m^3] of a radius [m].
#[inline(always)]
pub fn volume(radius: f64) -> f64 {
    4.0 / 3.0 * PI * (radius * radius * radius)
}

/// Share of a sphere's volume below a plane at `t` radii above its centre.
#[inline(always)]
pub(crate) fn below(t: f64) -> f64 {
    let t = t.clamp(-1.0, 1.0);
    0.5 + 0.75 * t - 0.25 * t * t * t
}
