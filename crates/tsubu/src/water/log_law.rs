//! The log law of rough streams, U = U* (8.5 + 5.75 log10(Z/k)) (Nikuradse 1933).

use super::logarithm::ln;
use std::f64::consts::LN_10;

/// Its constant and its slope.
pub(super) const CONSTANT: f64 = 8.5;
pub(super) const PER_DECADE: f64 = 5.75;

/// Karman's constant, of that slope.
pub(super) fn karman() -> f64 {
    LN_10 / PER_DECADE
}

/// U at a height above its zero level; `per_roughness` is 1/k.
#[inline(always)]
pub(super) fn log_law(height: f64, shear_velocity: f64, per_roughness: f64) -> f64 {
    // A height below zero has no logarithm; the velocity is zero well above it already.
    let depth = (height * per_roughness).max(1e-3);
    (shear_velocity * (CONSTANT + PER_DECADE / LN_10 * ln(depth))).max(0.0)
}
