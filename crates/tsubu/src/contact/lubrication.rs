//! The film of liquid between two bodies that are near.
//!
//! Near the axis the gap is H = h + r^2/(2 R*). Bodies that close at v push the liquid out through the ring 2 pi r H, and
//! Reynolds's equation has the pressure p = 3 mu R* v/H^2. With dH = r dr/R* its sum over the faces is
//!
//! F = integral of 2 pi r p dr = 6 pi mu R*^2 v integral of dH/H^2 = 6 pi mu R*^2 v/h:
//!
//! 6 pi mu r^2 v/h for a sphere at a wall, a quarter of it, (3/2) pi mu r^2 v/h, for two equal spheres. On the way from a gap h_0 to
//! one h_1 that takes 6 pi mu R*^2 ln(h_0/h_1) of the momentum, however fast the way.

use super::chunk::Chunk;
use super::pair::Pair;
use super::part::{About, Part, Stage};
use std::f64::consts::PI;

pub(super) const ABOUT: About = About {
    key: "contact.film.lubrication",
    formula: "f_n = 6 pi mu R*^2 h'/max(h, h_r) for 0 < h < reach, its mean over a time step",
    symbols: "h gap, -h' the rate at which it grows [m, m/s], h_r roughness [m], R* effective radius [m], mu viscosity [Pa.s]",
    limits: "h small against R*; no cavity on parting, no shear of the film, no give of the faces (elastohydrodynamics); ends at touch, \
as contacts softer than nature's would last too long in it; friction does not see it; it is there above a surface too",
    reference: "Reynolds 1886; Jeffrey and Onishi 1984; roughness as Joseph, Zenit, Hunt, Rosenwinkel 2001, Izard et al. 2014",
};

/// Half the way of a step over the gap, below which the mean of 1/h over the step needs no logarithm: the error is a
/// fifth of its fourth power.
const SHORT: f64 = 0.1;

#[derive(Debug)]
pub(super) struct Lubrication {
    /// h_r [m].
    pub roughness: f64,
    /// [m]
    pub reach: f64,
    /// mu [Pa.s].
    pub viscosity: f64,
    /// Whether it goes on while the bodies touch.
    pub in_contact: bool,
    /// Whether another part has set the damping force.
    pub beside_damping: bool,
}

impl Part for Lubrication {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn stage(&self) -> Stage {
        Stage::Film
    }

    fn reach(&self, _pair: &Pair) -> f64 {
        self.reach
    }

    fn judge(&self, pair: &mut Pair) {
        let strength = self.strength(pair.radius);
        pair.film = strength / self.roughness;
        pair.film_takes = strength * self.over(self.reach, 0.0);
    }

    fn apply(&self, chunk: &mut Chunk, _at: usize, dt: f64) {
        for i in 0..chunk.rows() {
            let closing = chunk.closing[i];
            let gap = -chunk.overlap[i];
            let half = 0.5 * closing * dt;
            // The film is there in a part of the step, at least. Laws of adhesion hold on beyond the overlap: there the faces still touch.
            let apart = gap + half.abs() > 0.0 && !(gap > 0.0 && chunk.contact_radius[i] > 0.0);
            let acts = gap < self.reach && (apart || self.in_contact);
            let dashpot = if acts { self.strength(chunk.effective_radius[i]) * self.mean(gap, half) } else { 0.0 };
            let force = dashpot * closing;
            let damping = if self.beside_damping { chunk.damping_force[i] } else { 0.0 };
            chunk.damping_force[i] = damping + force;
            chunk.normal_force[i] += force;
            chunk.lost_normal[i] += force * closing;
        }
    }
}

impl Lubrication {
    /// The coefficient of h'/h [N.s].
    fn strength(&self, radius: f64) -> f64 {
        6.0 * PI * self.viscosity * radius * radius
    }

    /// Mean of 1/h over a way from `gap` + `half` to `gap` - `half` [1/m]. With that of the gap alone, a step that jumps over the film
    /// would feel all of it or nothing.
    fn mean(&self, gap: f64, half: f64) -> f64 {
        let size = half.abs();
        if size < SHORT * gap && gap - size > self.roughness && gap + size < self.reach {
            let share = half / gap;
            return (1.0 + share * share / 3.0) / gap;
        }
        if size < 1e-6 * self.roughness {
            return 1.0 / gap.max(self.roughness);
        }
        self.over(gap + size, gap - size) / (2.0 * size)
    }

    /// Integral of 1/h from the gap `near` to the gap `far` [-].
    fn over(&self, far: f64, near: f64) -> f64 {
        let sum = |gap: f64| {
            let within = (gap.min(self.reach) / self.roughness).max(1.0).ln();
            let below = (gap / self.roughness).min(1.0) - 1.0;
            within + if self.in_contact { below } else { below.max(-1.0) }
        };
        sum(far) - sum(near)
    }
}
