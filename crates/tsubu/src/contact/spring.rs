//! Linear tangential spring with history, for Hooke's normal spring.

use super::chunk::Chunk;
use super::mindlin::tangential;
use super::pair::Constants;
use super::part::{About, Part, Slot, Stage};
use super::slider::{self, Held, Strength};
use multiversion::multiversion;

pub(super) const ABOUT: About = About {
    key: "contact.tangential.spring",
    formula: "e_s = -k_t s, |e_s| <= mu f_n + c; f_t = e_s - c_t v_t within the same limit; k_t = ratio k, c_t = damping c_n",
    symbols: "s slip [m], v_t slip velocity [m/s], k, k_t [N/m], c_n, c_t dashpots [N.s/m], mu [-], c cohesion [N]",
    limits: "contacts that turn about their normal do not turn e_s; with Luding's spring k is k1",
    reference: "Cundall and Strack 1979; Osada 2004, eqs. (B2) to (B4), the dashpot dropped where it slides",
};

#[derive(Debug)]
pub(super) struct Spring {
    /// k_t over the elastic stiffness [-].
    pub ratio: f64,
    /// Tangential over normal dashpot [-].
    pub damping: f64,
    /// What the tangential force may reach beyond mu f_n [N].
    pub cohesion: f64,
}

impl Part for Spring {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn stage(&self) -> Stage {
        Stage::Tangential
    }

    fn history(&self) -> &'static [Slot] {
        slider::SPRING
    }

    fn prepare(&self, constants: &mut Constants) {
        constants.shear_damping = self.damping;
    }

    fn apply(&self, chunk: &mut Chunk, at: usize, dt: f64) {
        chunk.with_history(at, |chunk, held| rows(chunk, held, dt, self.ratio, self.cohesion));
    }

    fn held(&self, history: &[f64]) -> f64 {
        slider::held(history)
    }
}

#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk, held: &mut Held, dt: f64, ratio: f64, cohesion: f64) {
    tangential(chunk, held, dt, |c, i| Strength {
        stiffness: ratio * c.secant_stiffness[i],
        dashpot: c.damping_coefficient[i] * c.shear_damping[i],
        cap: if c.contact_radius[i] > 0.0 { c.friction[i] * c.load[i] + cohesion } else { 0.0 },
        growth: 1.0,
        onset: 1.0,
    });
}
