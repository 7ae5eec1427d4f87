//! Damping of the normal motion: c d^q d' with q = 1/2, 1/4 or 0.

use super::calibrate;
use super::chunk::Chunk;
use super::dashpot::{damp, root_onset};
use super::hertz::secant;
use super::pair::{Constants, Pair};
use super::part::{About, Part, Stage};
use super::root::fifth_root;
use crate::mutation::{Mutation, mutated};
use multiversion::multiversion;

pub(super) const SQRT: About = About {
    key: "contact.damping.sqrt",
    formula: "f = c d^(1/2) d'; c such that the restitution is the asked one at the reference speed",
    symbols: "d overlap [m], d' overlap rate [m/s], c [N.s/m^1.5]",
    limits: "the restitution is the asked one at one speed only",
    reference: "Kuwabara and Kono 1987; Komatsuzaki 2003, eq. (3)",
};

pub(super) const QUARTER: About = About {
    key: "contact.damping.quarter",
    formula: "f = a sqrt(m* k) d^(1/4) d', a = -sqrt(5) ln e / sqrt(pi^2 + ln^2 e) when attraction is allowed",
    symbols: "d overlap [m], d' overlap rate [m/s], m* effective mass [kg], k [N/m^1.5]",
    limits: "with attraction cut, a is found numerically so that e comes back; with Hooke e is met at 1 m/s only",
    reference: "Tsuji, Tanaka, Ishida 1992; Antypov and Elliott 2011",
};

pub(super) const LINEAR: About = About {
    key: "contact.damping.linear",
    formula: "f = c d'; with Hooke c = 2 z sqrt(m* k), z = -ln e / sqrt(pi^2 + ln^2 e) when attraction is allowed",
    symbols: "d' overlap rate [m/s], m* effective mass [kg], k [N/m], c [N.s/m]",
    limits: "the force jumps at first touch; with Hertz the restitution is met at the reference speed only",
    reference: "Cundall and Strack 1979",
};

/// Which power of the overlap multiplies the dashpot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    Sqrt,
    Quarter,
    Linear,
}

#[derive(Debug)]
pub(super) struct Viscous {
    pub form: Form,
    /// Whether the elastic force is Hertz's, not Hooke's.
    pub hertz: bool,
    /// Whether the damping may make the total normal force pull.
    pub attraction: bool,
    /// Impact speed at which the restitution is met [m/s].
    pub reference_speed: f64,
}

/// A coefficient c from damping number beta, m*, k and the reference speed: c = beta m v / d0^(q+1) with the overlap scale
/// d0 = (m v^2 / k)^(1/(p+1)), see `calibrate`; below for every p and q, with the powers multiplied out.
type Coefficient = [f64; 4];

#[inline(always)]
fn hertz_sqrt([beta, m, k, v]: Coefficient) -> f64 {
    beta * fifth_root(k * k * k * (m * m) / v)
}

#[inline(always)]
fn hertz_linear([beta, m, k, v]: Coefficient) -> f64 {
    beta * fifth_root(m * m * m * (k * k) * v)
}

/// Hertz quarter and Hooke linear, which do not know the speed.
#[inline(always)]
fn speedless([beta, m, k, _]: Coefficient) -> f64 {
    beta * (m * k).sqrt()
}

#[inline(always)]
fn hooke_sqrt([beta, m, k, v]: Coefficient) -> f64 {
    beta * ((m * k).sqrt() * k / v).sqrt()
}

#[inline(always)]
fn hooke_quarter([beta, m, k, v]: Coefficient) -> f64 {
    beta * (m * k * (k / m).sqrt().sqrt() / v.sqrt()).sqrt()
}

impl Part for Viscous {
    fn about(&self) -> &'static About {
        match self.form {
            Form::Sqrt => &SQRT,
            Form::Quarter => &QUARTER,
            Form::Linear => &LINEAR,
        }
    }

    fn stage(&self) -> Stage {
        Stage::Damping
    }

    fn prepare(&self, constants: &mut Constants) {
        let q = self.exponent();
        let coefficient = calibrate::coefficient(constants.restitution, constants.exponent, q, self.attraction);
        constants.damping = mutated(Mutation::Damping, coefficient);
    }

    fn judge(&self, pair: &mut Pair) {
        let numbers = [pair.constants.damping, pair.mass, pair.stiffness, self.reference_speed];
        pair.damping_exponent = self.exponent();
        pair.damping = match (self.form, self.hertz) {
            (Form::Sqrt, true) => hertz_sqrt(numbers),
            (Form::Linear, true) => hertz_linear(numbers),
            (Form::Quarter, true) | (Form::Linear, false) => speedless(numbers),
            (Form::Sqrt, false) => hooke_sqrt(numbers),
            (Form::Quarter, false) => hooke_quarter(numbers),
        };
    }

    fn apply(&self, chunk: &mut Chunk, _at: usize, _dt: f64) {
        rows(chunk, self.form, self.hertz, self.attraction, self.reference_speed);
    }
}

#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk, form: Form, hertz: bool, attraction: bool, v: f64) {
    let p = if hertz { 1.5 } else { 1.0 };
    // Everything is told in terms of the contact disc, which laws of adhesion keep open where the overlap has ended: under
    // Hertz, sqrt(d) is a / sqrt(R*), and the quarter's d^(1/4) stands in the secant stiffness k sqrt(d).
    let row = |c: &Chunk, i: usize| [c.damping[i], c.effective_mass[i], c.secant_stiffness[i], v];
    let full = |c: &Chunk, i: usize| {
        [c.damping[i], c.effective_mass[i], secant(c.effective_modulus[i], c.effective_radius[i].sqrt()), v]
    };
    let root = |c: &Chunk, i: usize| c.contact_radius[i] / c.effective_radius[i].sqrt();
    let quarter = |u: f64| (1.0 + u).sqrt().sqrt() / 1.25;
    let whole = |_: f64| 1.0;
    match (form, hertz) {
        (Form::Sqrt, true) => damp(chunk, attraction, p, |c, i| hertz_sqrt(full(c, i)) * root(c, i), root_onset),
        (Form::Linear, true) => damp(chunk, attraction, p, |c, i| hertz_linear(full(c, i)), whole),
        (Form::Quarter, true) => damp(chunk, attraction, p, |c, i| speedless(row(c, i)), quarter),
        (Form::Linear, false) => damp(chunk, attraction, p, |c, i| speedless(row(c, i)), whole),
        (Form::Sqrt, false) => damp(chunk, attraction, p, |c, i| hooke_sqrt(row(c, i)) * root(c, i), root_onset),
        (Form::Quarter, false) => {
            damp(chunk, attraction, p, |c, i| hooke_quarter(row(c, i)) * root(c, i).sqrt(), quarter);
        }
    }
}

impl Viscous {
    fn exponent(&self) -> f64 {
        match self.form {
            Form::Sqrt => 0.5,
            Form::Quarter => 0.25,
            Form::Linear => 0.0,
        }
    }
}
