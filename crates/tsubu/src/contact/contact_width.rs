//! Rolling friction from the width of contact.

use super::chunk::Chunk;
use super::part::{About, Needs, Part, Stage};
use super::slider::resist;
use multiversion::multiversion;

const ABOUT: About = About {
    name: "contact-width",
    models: "rolling friction from a bump ahead of the contact: the arm of the normal force is a part f' of the contact's width",
    formula: "M = -f' b f_n w / max(|w|, v_eps / R*, w_dt), b = 2 sqrt(2 R* d), which for equal spheres is 2 sqrt(r d)",
    symbols: "w relative spin without its normal part [rad/s], f' [-], b width of the overlap [m], r radius, d overlap [m]",
    limits: "f' = 1/2 puts the arm at the rim of the overlap; b grows as the material gets softer; below v_eps it creeps",
    reference: "Osada 2004, eq. (B13), turned against the rolling instead of the moment of the tangential forces",
};

#[derive(Debug)]
pub(super) struct ContactWidth {
    /// v_eps [m/s].
    pub smoothing_speed: f64,
}

impl Part for ContactWidth {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn stage(&self) -> Stage {
        Stage::Rolling
    }

    fn needs(&self) -> Needs {
        Needs { roll: true, twist: false }
    }

    fn apply(&self, chunk: &mut Chunk, _at: usize, dt: f64) {
        rows(chunk, dt, self.smoothing_speed);
    }
}

#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk, dt: f64, slow: f64) {
    // The disc has the radius sqrt(R* d); the overlap of undeformed spheres is sqrt(2) times as wide.
    let width = 2.0 * std::f64::consts::SQRT_2;
    resist(chunk, slow, dt, |c, i| c.rolling[i] * (width * c.disc[i]) * c.load[i]);
}
