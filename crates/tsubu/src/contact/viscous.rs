//! Damping of the normal motion: c d^q d' with q = 1/2, 1/4 or 0.

use super::calibrate;
use super::chunk::Chunk;
use super::part::{About, Part, Stage};
use super::table::Pair;

const SQRT: About = About {
    name: "sqrt",
    models: "visco-elastic spheres: restitution falls slowly with impact speed, as 1 - O(v^(1/5))",
    formula: "f = c d^(1/2) d'; c such that the restitution is the asked one at the reference speed",
    symbols: "d overlap [m], d' overlap rate [m/s], c [N.s/m^1.5]",
    limits: "the restitution is the asked one at one speed only",
    reference: "Kuwabara and Kono 1987; Komatsuzaki 2003, eq. (3)",
};

const QUARTER: About = About {
    name: "quarter",
    models: "damping of a Hertz contact with the same restitution at every impact speed",
    formula: "f = a sqrt(m* k) d^(1/4) d', a = -sqrt(5) ln e / sqrt(pi^2 + ln^2 e) when attraction is allowed",
    symbols: "d overlap [m], d' overlap rate [m/s], m* reduced mass [kg], k [N/m^1.5]",
    limits: "with attraction cut, a is found numerically so that e comes back",
    reference: "Tsuji, Tanaka, Ishida 1992; Antypov and Elliott 2011",
};

const LINEAR: About = About {
    name: "linear",
    models: "a dashpot of constant strength",
    formula: "f = c d'; with Hooke c = 2 z sqrt(m* k), z = -ln e / sqrt(pi^2 + ln^2 e) when attraction is allowed",
    symbols: "d' overlap rate [m/s], m* reduced mass [kg], k [N/m], c [N.s/m]",
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
    /// Whether the total normal force may pull.
    pub attraction: bool,
    /// Impact speed at which the restitution is met [m/s].
    pub reference_speed: f64,
}

impl Viscous {
    fn power(&self) -> f64 {
        match self.form {
            Form::Sqrt => 0.5,
            Form::Quarter => 0.25,
            Form::Linear => 0.0,
        }
    }
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

    fn prepare(&self, pair: &mut Pair) {
        let beta = calibrate::coefficient(pair.restitution, pair.exponent, self.power(), self.attraction);
        pair.damping_exponent = self.power();
        // beta = c d0^(q+1) / (m v) with d0 = (m v^2 / k)^(1/(p+1)), the scale of the overlap.
        let v = self.reference_speed;
        let scale = (pair.mass * v * v / pair.stiffness).powf(1.0 / (pair.exponent + 1.0));
        pair.damping = beta * pair.mass * v / scale.powf(self.power() + 1.0);
    }

    fn apply(&self, chunk: &mut Chunk, _dt: f64) {
        let n = chunk.len;
        match self.form {
            Form::Sqrt => (0..n).for_each(|i| chunk.dashpot[i] = chunk.damping[i] * chunk.root[i]),
            Form::Quarter => (0..n).for_each(|i| chunk.dashpot[i] = chunk.damping[i] * chunk.root[i].sqrt()),
            Form::Linear => chunk.dashpot[..n].copy_from_slice(&chunk.damping[..n]),
        }
        let floor = if self.attraction { f64::NEG_INFINITY } else { 0.0 };
        for i in 0..n {
            let elastic = chunk.normal_force[i];
            let total = (elastic + chunk.dashpot[i] * chunk.closing[i]).max(floor);
            chunk.normal_force[i] = total;
            chunk.damping_force[i] = total - elastic;
            // What is lost is whatever the contact takes from the motion beyond what it stores.
            chunk.lost_normal[i] = (total - elastic) * chunk.closing[i];
        }
    }
}
