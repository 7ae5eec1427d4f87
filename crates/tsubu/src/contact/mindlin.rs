//! Tangential spring with history: Mindlin.

use super::chunk::Chunk;
use super::pair::Constants;
use super::part::{About, Part, Slot, Stage};
use super::slider::{self, Held, Strength, bearable, slide, touched};
use crate::mutation::{Mutation, left_out};
use glam::DVec3;
use multiversion::multiversion;
use tsubu_scene::plan::MindlinForm;

pub(super) const INCREMENTAL: About = About {
    key: "contact.tangential.mindlin",
    formula: "dF = -k_t v_t dt, F scaled down with k_t on unloading, |F| <= mu f_n; f_t = F + F_dashpot within the same limit; k_t = 8 G* a",
    symbols: "F spring force [N], v_t slip velocity [m/s], G* effective shear modulus [Pa], a contact radius [m], mu [-]",
    limits: "no micro-slip inside the contact disc; contacts that turn about their normal do not turn F",
    reference: "Mindlin and Deresiewicz 1953; Thornton, Cummins, Cleary 2013",
};

pub(super) const SECANT: About = About {
    key: "contact.tangential.mindlin.form.secant",
    formula: "F = -k_t(d) x, x the slip since first touch, cut so that |F| <= mu f_n; f_t = F + F_dashpot within the same limit; k_t = 8 G* a",
    symbols: "x slip [m], d overlap [m], G* effective shear modulus [Pa], a contact radius [m], mu [-]",
    limits: "pressing a sheared contact makes energy out of nothing; for comparison with codes that use it",
    reference: "the form behind the curves of Chung and Ooi 2011",
};

#[derive(Debug)]
pub(super) struct Mindlin {
    pub form: MindlinForm,
    /// Tangential over normal dashpot [-]; `None`: equal damping ratios.
    pub damping: Option<f64>,
}

impl Part for Mindlin {
    fn about(&self) -> &'static About {
        match self.form {
            MindlinForm::Incremental => &INCREMENTAL,
            MindlinForm::Secant => &SECANT,
        }
    }

    fn stage(&self) -> Stage {
        Stage::Tangential
    }

    fn history(&self) -> &'static [Slot] {
        slider::SPRING
    }

    fn prepare(&self, constants: &mut Constants) {
        // Equal damping ratios: the dashpots stand as the roots of the two tangent stiffnesses, 8 G* a and 2 E* a.
        let equal = 2.0 * (constants.shear_modulus / constants.effective_modulus).sqrt();
        constants.shear_damping = self.damping.unwrap_or(equal);
    }

    fn apply(&self, chunk: &mut Chunk, at: usize, dt: f64) {
        let growth = match self.form {
            MindlinForm::Incremental => 1.0,
            MindlinForm::Secant => f64::INFINITY,
        };
        chunk.with_history(at, |chunk, held| rows(chunk, held, dt, growth));
    }

    fn held(&self, history: &[f64]) -> f64 {
        slider::held(history)
    }
}

#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk, held: &mut Held, dt: f64, growth: f64) {
    tangential(chunk, held, dt, |c, i| Strength {
        stiffness: 8.0 * c.shear_modulus[i] * c.contact_radius[i],
        dashpot: c.damping_coefficient[i] * c.shear_damping[i],
        cap: c.friction[i] * c.load[i],
        growth,
        // A force grows with sqrt(d); the secant form has the whole slip at the present stiffness.
        onset: if growth == 1.0 { 2.0 / 3.0 } else { 1.0 },
    });
}

/// A step of a tangential spring in all rows.
#[inline(always)]
pub(super) fn tangential(
    chunk: &mut Chunk,
    [x, y, z, c, u, v, w]: &mut Held,
    dt: f64,
    strength: impl Fn(&Chunk, usize) -> Strength,
) {
    // A force at the surface of a solid sphere moves that by 1 + R^2 m/I = 7/2 as much as the centre.
    let push = chunk.completion * if chunk.rotation { 3.5 } else { 1.0 };
    let passing = chunk.passing(dt);
    for i in 0..chunk.rows() {
        let mut s = strength(chunk, i);
        if left_out(Mutation::UnloadingRescale) && c[i] > 0.0 {
            c[i] = slider::inverse(s.stiffness);
        }
        s.dashpot = bearable(s.dashpot, chunk.effective_mass[i], dt);
        let (normal, slip) = (Chunk::vector(&chunk.normal, i), Chunk::vector(&chunk.slip, i));
        let rates = [DVec3::new(u[i], v[i], w[i]), slip];
        let times = [touched(chunk, i, c[i], passing), 1.0 / dt];
        let slid = slide((DVec3::new(x[i], y[i], z[i]), c[i]), normal, rates, s, push / chunk.effective_mass[i], times);
        (x[i], y[i], z[i], c[i]) = (slid.spring.x, slid.spring.y, slid.spring.z, slid.compliance);
        (u[i], v[i], w[i]) = (slid.rate.x, slid.rate.y, slid.rate.z);
        Chunk::set(&mut chunk.tangential_force, i, slid.total);
        chunk.tangential_stiffness[i] = s.stiffness;
        chunk.stored[i] += slid.stored;
        chunk.lost_sliding[i] = slid.lost;
    }
}
