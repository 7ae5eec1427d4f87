//! Dashpots told by their strength, whatever the restitution.

use super::chunk::Chunk;
use super::part::{About, Part, Stage};
use super::root::{least, most};
use super::table::Pair;
use multiversion::multiversion;

pub(super) const RATE: About = About {
    key: "contact.damping.rate",
    formula: "f = c d', c = rate m*; with Hooke e = exp(-rate t_c / 2), t_c the damped contact time, if attraction is allowed",
    symbols: "d' overlap rate [m/s], m* effective mass [kg], rate [1/s], c [N.s/m]",
    limits: "the restitution is what comes out of it; the force jumps at first touch",
    reference: "the damping `mass_velocity` of LAMMPS; Silbert et al. 2001",
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
    /// c [N.s/m].
    Constant(f64),
}

impl Dashpot {
    /// c [N.s/m].
    #[inline(always)]
    fn coefficient(self, mass: f64) -> f64 {
        match self {
            Self::Rate(rate) => rate * mass,
            Self::Constant(coefficient) => coefficient,
        }
    }
}

#[derive(Debug)]
pub(super) struct Told {
    pub dashpot: Dashpot,
    /// Whether the damping may make the total normal force pull.
    pub attraction: bool,
}

impl Part for Told {
    fn about(&self) -> &'static About {
        match self.dashpot {
            Dashpot::Rate(_) => &RATE,
            Dashpot::Constant(_) => &DASHPOT,
        }
    }

    fn stage(&self) -> Stage {
        Stage::Damping
    }

    fn judge(&self, pair: &mut Pair) {
        pair.damping_exponent = 0.0;
        pair.damping = self.dashpot.coefficient(pair.mass);
    }

    fn apply(&self, chunk: &mut Chunk, _at: usize, _dt: f64) {
        rows(chunk, self.dashpot, self.attraction);
    }
}

#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk, dashpot: Dashpot, attraction: bool) {
    damp(chunk, attraction, |c, i| dashpot.coefficient(c.effective_mass[i]));
}

/// Adds a dashpot of the local coefficient `local` [N.s/m] to the normal force. Where `attraction` is not allowed the
/// damping may not pull: it takes the force to zero, or leaves it where cohesion already has it below.
#[inline(always)]
pub(super) fn damp(chunk: &mut Chunk, attraction: bool, local: impl Fn(&Chunk, usize) -> f64) {
    let ceiling = if attraction { f64::NEG_INFINITY } else { 0.0 };
    for i in 0..chunk.rows() {
        let dashpot = if chunk.contact_radius[i] > 0.0 { local(chunk, i) } else { 0.0 };
        let elastic = chunk.normal_force[i];
        let total = most(elastic + dashpot * chunk.closing[i], least(elastic, ceiling));
        chunk.damping_coefficient[i] = dashpot;
        chunk.normal_force[i] = total;
        chunk.damping_force[i] = total - elastic;
        // What is lost is whatever the contact takes from the motion beyond what it stores.
        chunk.lost_normal[i] += (total - elastic) * chunk.closing[i];
    }
}
