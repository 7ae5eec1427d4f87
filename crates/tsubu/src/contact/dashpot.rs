//! Dashpots told by their strength, whatever the restitution.

use super::chunk::{Chunk, ROWS};
use super::pair::Pair;
use super::part::{About, Part, Stage};
use super::root::{least, most};
use multiversion::multiversion;

pub(super) const RATE: About = About {
    key: "contact.damping.rate",
    formula: "f = c d', c = rate m*; with Hooke e = exp(-rate t_c / 2), t_c the damped contact time, if attraction is allowed",
    symbols: "d' overlap rate [m/s], m* effective mass [kg], rate [1/s], c [N.s/m]",
    limits: "the restitution is what comes out of it; the force jumps at first touch",
    reference: "the damping `mass_velocity` of LAMMPS; Silbert et al. 2001",
};

pub(super) const VISCOELASTIC: About = About {
    key: "contact.damping.viscoelastic",
    formula: "f = c a m* d', a = sqrt(R* d)",
    symbols: "d overlap [m], d' overlap rate [m/s], a radius of the contact disc [m], m* effective mass [kg], c [1/(m.s)]",
    limits: "the restitution is what comes out of it, and falls slowly with the impact speed",
    reference: "Brilliantov, Spahn, Hertzsch, Poeschel 1996; the damping `viscoelastic` of LAMMPS, Silbert et al. 2001",
};

pub(super) const DASHPOT: About = About {
    key: "contact.damping.dashpot",
    formula: "f = c d'",
    symbols: "d' overlap rate [m/s], c [N.s/m]",
    limits: "the restitution is what comes out of it and differs between sizes; the force jumps at first touch",
    reference: "Cundall and Strack 1979; Osada 2004, eq. (1)",
};

#[derive(Clone, Copy, Debug)]
pub(super) enum Dashpot {
    /// c over m* [1/s].
    Rate(f64),
    /// c over m* and the radius of the contact disc [1/(m.s)].
    Disc(f64),
    /// c [N.s/m].
    Constant(f64),
}

impl Dashpot {
    /// The text about it.
    const fn about(self) -> &'static About {
        match self {
            Self::Rate(_) => &RATE,
            Self::Disc(_) => &VISCOELASTIC,
            Self::Constant(_) => &DASHPOT,
        }
    }
}

#[derive(Debug)]
pub(super) struct Told {
    pub dashpot: Dashpot,
    /// Whether the damping may make the total normal force pull.
    pub attraction: bool,
    /// Exponent of the overlap in the elastic force.
    pub exponent: f64,
}

impl Part for Told {
    fn about(&self) -> &'static About {
        self.dashpot.about()
    }

    fn stage(&self) -> Stage {
        Stage::Damping
    }

    fn judge(&self, pair: &mut Pair) {
        (pair.damping, pair.damping_exponent) = match self.dashpot {
            Dashpot::Rate(rate) => (rate * pair.mass, 0.0),
            Dashpot::Disc(coefficient) => (coefficient * pair.mass * pair.radius.sqrt(), 0.5),
            Dashpot::Constant(coefficient) => (coefficient, 0.0),
        };
    }

    fn apply(&self, chunk: &mut Chunk, _at: usize, _dt: f64) {
        rows(chunk, self.dashpot, self.attraction, self.exponent);
    }
}

#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk, dashpot: Dashpot, attraction: bool, exponent: f64) {
    let at_once = |_: f64| 1.0;
    match dashpot {
        Dashpot::Rate(rate) => damp(chunk, attraction, exponent, |c, i| rate * c.effective_mass[i], at_once),
        Dashpot::Disc(coefficient) => {
            let of_disc = |c: &Chunk, i: usize| coefficient * c.effective_mass[i] * c.contact_radius[i];
            damp(chunk, attraction, exponent, of_disc, root_onset);
        }
        Dashpot::Constant(coefficient) => damp(chunk, attraction, exponent, |_, _| coefficient, at_once),
    }
}

/// The onset of a dashpot that grows with the root of the overlap, see [`damp`].
#[inline(always)]
pub(super) fn root_onset(u: f64) -> f64 {
    (1.0 + u).sqrt() / 1.5
}

/// Adds a dashpot of the local coefficient `local` [N.s/m] to the normal force. Where `attraction` is not allowed the
/// damping may not pull: it takes the force to zero, or leaves it where cohesion already has it below.
///
/// The overlap rate at hand is predicted with the forces of the last step. By how much this contact's own force has grown since then,
/// `exponent` times the secant stiffness times the way of a step, takes off the rate what is known: then a collision is the
/// trapezoidal rule to the second order in time.
///
/// A step that begins or ends apart has the dashpot for less than its length. What Verlet should add from first touch to the middle of
/// the next step is the integral of c(d) dd from 0 to d + h, h the way of half a step: (1 + u)^(q+1) / (2 (q+1) u) times what
/// a whole step at d adds, u = h/d; and the same on the way out, where the bodies may pull. `onset` is (1 + u)^q / (q + 1).
#[expect(clippy::needless_range_loop, reason = "all columns of a row are indexed alike")]
#[inline(always)]
pub(super) fn damp(
    chunk: &mut Chunk,
    attraction: bool,
    exponent: f64,
    local: impl Fn(&Chunk, usize) -> f64,
    onset: impl Fn(f64) -> f64,
) {
    let ceiling = if attraction { f64::NEG_INFINITY } else { 0.0 };
    let completion = chunk.completion;
    let mut ratios = [0.0; ROWS];
    let mut near_touch = 0;
    for i in 0..chunk.rows() {
        let coefficient = if chunk.contact_radius[i] > 0.0 { local(chunk, i) } else { 0.0 };
        let (elastic, closing) = (chunk.normal_force[i], chunk.closing[i]);
        let share = completion / chunk.effective_mass[i];
        let rate = closing * (1.0 - 2.0 * exponent * completion * share * chunk.secant_stiffness[i]);
        let total = most(elastic + coefficient * rate, least(elastic, ceiling));
        // The speed of the half step of first touch, or, where bodies that part may pull, of the one that leads on from here, against the
        // overlap a^2/R* of the disc of contact: it is not the overlap where adhesion keeps bodies together.
        let leaving = if attraction { 2.0 * share * total - rate } else { 0.0 };
        let disc = chunk.contact_radius[i] * chunk.contact_radius[i];
        ratios[i] = most(closing, leaving) * completion * chunk.effective_radius[i] / most(disc, f64::MIN_POSITIVE);
        near_touch += u64::from(ratios[i] > 0.5);
        chunk.damping_coefficient[i] = coefficient;
        chunk.normal_force[i] = total;
        chunk.damping_force[i] = total - elastic;
    }
    // Rows within a step of touch are few, in most chunks none: they come after the others, one by one.
    let rows = if near_touch > 0 { chunk.rows() } else { 0 };
    for (i, ratio) in ratios.iter().enumerate().take(rows).filter(|(_, ratio)| **ratio > 0.5) {
        let elastic = chunk.normal_force[i] - chunk.damping_force[i];
        let ratio = least(*ratio, 1e12);
        let share = completion / chunk.effective_mass[i];
        let coefficient = chunk.damping_coefficient[i] * (0.5 * onset(ratio) * (1.0 + 1.0 / ratio));
        let closing = chunk.closing[i];
        let wanted = if closing > 0.0 {
            // No force has acted yet.
            (elastic + coefficient * closing) / (1.0 + coefficient * share)
        } else {
            elastic + coefficient * closing
        };
        let total = most(wanted, least(elastic, ceiling));
        chunk.normal_force[i] = total;
        chunk.damping_force[i] = total - elastic;
    }
    for i in 0..chunk.rows() {
        // What is lost is whatever the contact takes from the motion beyond what it stores.
        chunk.lost_normal[i] += chunk.damping_force[i] * chunk.closing[i];
    }
}
