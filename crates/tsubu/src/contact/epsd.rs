//! Rolling resistance as an elastic-plastic spring with a dashpot (EPSD), and its variant EPSD2.

use super::chunk::Chunk;
use super::part::{About, Part, Slot, Stage};
use super::slider::{self, Held, Strength, roll};
use crate::mutation::{Mutation, mutated};
use multiversion::multiversion;

pub(super) const EPSD: About = About {
    key: "contact.rolling.epsd",
    formula: "dM = -k_r w dt, |M| <= mu_r R* f_n, k_r = ratio k_n (mu_r R*)^2; dashpot 2 z sqrt(I k_r), I = 7/5 m* R*^2",
    symbols: "w relative spin without its normal part [rad/s], k_n = f/d [N/m], mu_r, z, ratio [-], R* [m], m* [kg]",
    limits: "k_n is the secant stiffness under Hertz; I is right for a ball on a wall, a quarter of that of two equal balls; the dashpot is cut at 0.02 m* R*^2/dt, at the default step from z mu_r of about 0.036 on",
    reference: "model C of Ai, Chen, Rotter, Ooi 2011; Iwashita and Oda 1998",
};

pub(super) const EPSD2: About = About {
    key: "contact.rolling.epsd2",
    formula: "dM = -k_r w dt, |M| <= mu_r R* f_n, k_r = k_t R*^2",
    symbols: "w relative spin without its normal part [rad/s], k_t tangential stiffness [N/m], mu_r [-], R* [m]",
    limits: "needs a tangential law with a stiffness; nothing but friction elsewhere ends a swing within the limit",
    reference: "Iwashita and Oda 1998; the model epsd2 of LIGGGHTS",
};

#[derive(Debug)]
pub(super) struct Epsd {
    /// k_r over k_n (mu_r R*)^2, and the damping ratio of the rolling spring [-]; `None`: EPSD2.
    pub told: Option<[f64; 2]>,
}

impl Part for Epsd {
    fn about(&self) -> &'static About {
        if self.told.is_some() { &EPSD } else { &EPSD2 }
    }

    fn stage(&self) -> Stage {
        Stage::Rolling
    }

    fn history(&self) -> &'static [Slot] {
        slider::SPRING
    }

    fn apply(&self, chunk: &mut Chunk, at: usize, dt: f64) {
        chunk.with_history(at, |chunk, held| match self.told {
            Some([ratio, damping]) => epsd(chunk, held, dt, ratio, damping),
            None => epsd2(chunk, held, dt),
        });
    }

    fn held(&self, history: &[f64]) -> f64 {
        slider::held(history)
    }
}

#[multiversion(targets = "simd")]
fn epsd(chunk: &mut Chunk, held: &mut Held, dt: f64, ratio: f64, damping: f64) {
    roll(chunk, held, dt, |c, i| {
        let arm = c.rolling[i] * mutated(Mutation::RollingArm, c.effective_radius[i]);
        let stiffness = ratio * c.secant_stiffness[i] * (arm * arm);
        let inertia = 3.5 * slider::inertia(c, i);
        let dashpot = 2.0 * damping * (inertia * stiffness).sqrt();
        Strength { stiffness, dashpot, cap: arm * c.load[i], growth: 1.0, onset: 1.0 }
    });
}

#[multiversion(targets = "simd")]
fn epsd2(chunk: &mut Chunk, held: &mut Held, dt: f64) {
    roll(chunk, held, dt, |c, i| {
        let stiffness = c.tangential_stiffness[i] * (c.effective_radius[i] * c.effective_radius[i]);
        Strength {
            stiffness,
            dashpot: 0.0,
            cap: c.rolling[i] * c.effective_radius[i] * c.load[i],
            growth: 1.0,
            onset: 1.0,
        }
    });
}
