//! Adhesion of soft spheres: Johnson, Kendall, Roberts.
//!
//! With a0^3 = pi gamma R^2 / (4 E) and the radius of contact a = a0 x^2, JKR's two equations become
//!
//! d = (a0^2/R) (x^4 - 4 x),  f = pi gamma R (x^6/3 - 2 x^3),  U = pi gamma a0^2 (2/15 x^10 - 4/3 x^7 + 2 x^4),
//!
//! dU/dd = f, U = 0 without contact. The force is least at x^3 = 3, -3 pi gamma R at d = -3^(1/3) a0^2/R: there the bodies part.

use super::chunk::{Chunk, Column};
use super::hertz::secant;
use super::pair::Pair;
use super::part::{About, Part, Slot, Stage};
use super::root::{cube_root, most};
use multiversion::multiversion;
use std::f64::consts::PI;

pub(super) const ABOUT: About = About {
    key: "contact.cohesion.jkr",
    formula: "f = 4 E* a^3 / (3 R*) - 4 sqrt(pi gamma E* a^3), d = a^2/R* - 2 sqrt(pi gamma a / E*); parts at f = -3 pi gamma R*",
    symbols: "d overlap, negative while it holds on [m], a radius of contact [m], gamma surface energy of one face [J/m^2]",
    limits: "replaces Hertz; friction sees f_n + 6 pi gamma R*; the energy set free by snapping together is lost normally",
    reference: "Johnson, Kendall, Roberts 1971; friction as Thornton 1991",
};

/// 3^(1/3): minus the overlap at which the bodies part, in units of a0^2/R.
const LIMIT: f64 = 1.442_249_570_307_408_4;
/// What the energy at parting lacks to zero, in units of pi gamma a0^2: 12/5 3^(1/3). Energies are counted from there, so
/// that nothing is left to account for when the bodies part.
const PARTED: f64 = 2.4 * LIMIT;
/// Energy set free by snapping together, in the same units: 24/5 4^(1/3) less that.
const SNAP: f64 = 4.8 * 1.587_401_051_968_199_4 - PARTED;

/// a0 [m].
#[inline(always)]
fn scale(surface_energy: f64, radius: f64, effective_modulus: f64) -> f64 {
    cube_root(PI * surface_energy * (radius * radius) / (4.0 * effective_modulus))
}

/// The larger x with x^4 - 4 x = `depth`, for depths from -1.45 up: Newton's steps, from a start 3 % off at most.
#[inline(always)]
fn solve(depth: f64) -> f64 {
    let newton = |x: f64| {
        let cube = x * x * x;
        x - (x * cube - 4.0 * x - depth) / (4.0 * cube - 4.0)
    };
    newton(newton(newton(newton((depth + 6.35).sqrt().sqrt()))))
}

#[derive(Debug)]
pub(super) struct Jkr;

impl Part for Jkr {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn stage(&self) -> Stage {
        Stage::Cohesion
    }

    /// Whether the faces hold each other (1 or 0), and the energy they store [J].
    fn history(&self) -> &'static [Slot] {
        &[Slot::Even, Slot::Even]
    }

    fn reach(&self, pair: &Pair) -> f64 {
        let c = &pair.constants;
        let a0 = scale(c.surface_energy, pair.radius, c.effective_modulus);
        if c.surface_energy > 0.0 { LIMIT * a0 * a0 / pair.radius } else { 0.0 }
    }

    fn apply(&self, chunk: &mut Chunk, at: usize, dt: f64) {
        chunk.with_history(at, |chunk, history| rows(chunk, history, dt));
    }

    fn held(&self, history: &[f64]) -> f64 {
        history.get(1).copied().unwrap_or_default()
    }
}

#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk, [held, energy]: &mut [Column; 2], dt: f64) {
    for i in 0..chunk.rows() {
        let (radius, effective_modulus, surface_energy) =
            (chunk.effective_radius[i], chunk.effective_modulus[i], chunk.surface_energy[i]);
        let a0 = scale(surface_energy, radius, effective_modulus);
        let pull = PI * surface_energy * radius;
        let length = a0 * a0 / radius;
        let depth = chunk.overlap[i] / length;
        let (held_before, energy_before) = (held[i], energy[i]);
        let reach = if held_before > 0.0 { -LIMIT } else { 0.0 };
        let holds = depth >= reach && pull > 0.0;

        let x = solve(most(depth, -LIMIT));
        let cube = x * x * x;
        let force = pull * cube * (cube / 3.0 - 2.0);
        let stored = pull * length * (x * cube * (2.0 / 15.0 * (cube * cube) - 4.0 / 3.0 * cube + 2.0) + PARTED);
        let disc = a0 * (x * x);

        // Without surface energy, and where nothing holds, the row stays as Hertz left it, to the bit.
        chunk.normal_force[i] = if holds { force } else { chunk.normal_force[i] };
        chunk.stored[i] = if holds { stored } else { chunk.stored[i] };
        chunk.contact_radius[i] = if holds { disc } else { chunk.contact_radius[i] };
        chunk.secant_stiffness[i] = if holds { secant(effective_modulus, disc) } else { chunk.secant_stiffness[i] };
        chunk.pull_off[i] = if holds { 6.0 * pull } else { 0.0 };
        let snap = if held_before > 0.0 { 0.0 } else { SNAP * pull * length };
        chunk.lost_normal[i] += if holds { snap } else { energy_before } / dt;
        held[i] = if holds { 1.0 } else { 0.0 };
        energy[i] = if holds { stored } else { 0.0 };
    }
}
