//! Resistance against spin about the normal, with a spring on the angle of twist.

use super::chunk::{Chunk, Column};
use super::part::{About, Part, Slot, Stage};
use super::root::{least, most};
use super::slider::{bearable, inertia, inverse, touched};
use super::twisting_sliding::limit;
use multiversion::multiversion;

pub(super) const ABOUT: About = About {
    key: "contact.twisting.spring",
    formula: "dM = -k_w w dt, k_w = k_t a^2 / 2; dashpot c_n a^2 / 2; |M| <= (2/3) mu_t a f_n",
    symbols: "w relative spin about the normal [rad/s], a radius of the disc [m], k_t [N/m], c_n normal dashpot [N.s/m]",
    limits: "even pressure over the disc; needs a tangential law with a stiffness",
    reference: "Marshall 2009, eqs. (32), (33); the twisting model `marshall` of LAMMPS",
};

#[derive(Debug)]
pub(super) struct TwistingSpring;

impl Part for TwistingSpring {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn stage(&self) -> Stage {
        Stage::Twisting
    }

    /// What the spring holds, one over its stiffness, and how fast it was being twisted. A torque about the normal from the first to the second body is the same number
    /// when the bodies change places.
    fn history(&self) -> &'static [Slot] {
        &[Slot::Even, Slot::Even, Slot::Even]
    }

    fn apply(&self, chunk: &mut Chunk, at: usize, dt: f64) {
        chunk.with_history(at, |chunk, history| rows(chunk, history, dt));
    }

    fn held(&self, history: &[f64]) -> f64 {
        match *history {
            [torque, compliance, ..] => 0.5 * torque * torque * compliance,
            _ => 0.0,
        }
    }
}

/// The step of `slider::slide` along one direction that never turns.
#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk, [held, was, rate]: &mut [Column; 3], dt: f64) {
    let (passing, rates) = (chunk.passing(dt), 1.0 / dt);
    for i in 0..chunk.rows() {
        let (twist, cap) = (chunk.twist[i], limit(chunk, i));
        let half = 0.5 * (chunk.contact_radius[i] * chunk.contact_radius[i]);
        let (stiffness, dashpot) = (
            chunk.tangential_stiffness[i] * half,
            bearable(chunk.damping_coefficient[i] * half, inertia(chunk, i), dt),
        );
        let before = 0.5 * held[i] * held[i] * was[i];
        let within = |torque: f64| most(least(torque, cap), -cap);
        let stiffened = stiffness * was[i];
        let followed = least(stiffened, 1.0);
        let share = if stiffened > 0.0 { 0.5 + 0.5 * followed / stiffened } else { 1.0 };
        let past = if was[i] > 0.0 { 0.5 } else { 0.0 };
        let turned = (rate[i] * past + twist * (1.0 - past)) * touched(chunk, i, was[i], passing);
        let spring = within(held[i] * followed - turned * (share * stiffness));
        let total = within(spring - twist * dashpot);
        let compliance = inverse(stiffness);
        let stored = 0.5 * spring * spring * compliance;
        (held[i], was[i], rate[i]) = (spring, compliance, twist);
        let torque = Chunk::vector(&chunk.torque, i) + Chunk::vector(&chunk.normal, i) * total;
        Chunk::set(&mut chunk.torque, i, torque);
        chunk.stored[i] += stored;
        chunk.lost_rolling[i] += -total * twist - (stored - before) * rates;
    }
}
