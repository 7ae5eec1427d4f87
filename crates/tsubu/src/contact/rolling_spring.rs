//! Rolling resistance as spring, dashpot and slider on the rolling displacement.

use super::chunk::Chunk;
use super::part::{About, Part, Slot, Stage};
use super::slider::{self, Held, Strength, roll};
use crate::mutation::{Mutation, mutated};
use multiversion::multiversion;

pub(super) const ABOUT: About = About {
    key: "contact.rolling.spring",
    formula: "F = -(k x + c v), |F| <= mu_r f_n; v = -R* (w_1 - w_2) x n, x its integral; torque on the first -R* n x F",
    symbols: "v rolling velocity [m/s], x [m], k [N/m], c [N.s/m], mu_r [-], n normal from the first to the second body",
    limits: "where it slides the spring stays at the limit (LAMMPS shifts it by c v, which can load it without work)",
    reference: "Luding 2008; Wang et al. 2015; the rolling model `sds` of LAMMPS",
};

#[derive(Debug)]
pub(super) struct RollingSpring {
    /// k [N/m].
    pub stiffness: f64,
    /// c [N.s/m].
    pub damping: f64,
}

impl Part for RollingSpring {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn stage(&self) -> Stage {
        Stage::Rolling
    }

    fn history(&self) -> &'static [Slot] {
        slider::SPRING
    }

    fn apply(&self, chunk: &mut Chunk, at: usize, dt: f64) {
        chunk.with_history(at, |chunk, held| rows(chunk, held, dt, self.stiffness, self.damping));
    }

    fn held(&self, history: &[f64]) -> f64 {
        slider::held(history)
    }
}

#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk, held: &mut Held, dt: f64, stiffness: f64, damping: f64) {
    // As a torque on the angle of rolling: with v = -R* w x n and M = -R* n x F, F = -k x is M = -k R*^2 times the angle.
    roll(chunk, held, dt, |c, i| {
        let arm = mutated(Mutation::RollingArm, c.effective_radius[i]);
        Strength {
            stiffness: stiffness * (arm * arm),
            dashpot: damping * (arm * arm),
            cap: c.rolling[i] * arm * c.load[i],
            growth: 1.0,
            onset: 1.0,
        }
    });
}
