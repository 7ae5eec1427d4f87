//! Rolling resistance of constant torque.

use super::chunk::Chunk;
use super::part::{About, Needs, Part, Stage};
use super::table::Pair;

const ABOUT: About = About {
    name: "constant",
    models: "rolling resistance proportional to the normal force, fading below a small rolling speed",
    formula: "M = -mu_r R* f_n w / max(|w|, v_eps / R*)",
    symbols: "w relative spin without its normal part [rad/s], R* reduced radius [m], mu_r [-], v_eps [m/s]",
    limits: "does not hold a slope at rest: below v_eps the grain creeps",
    reference: "model A of Ai, Chen, Rotter, Ooi 2011",
};

#[derive(Debug)]
pub(super) struct RollingConstant {
    pub smoothing_speed: f64,
}

impl Part for RollingConstant {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn stage(&self) -> Stage {
        Stage::Rolling
    }

    fn needs(&self) -> Needs {
        Needs { history: false, roll: true }
    }

    fn prepare(&self, _pair: &mut Pair) {}

    fn apply(&self, chunk: &mut Chunk, _dt: f64) {
        let [wx, wy, wz] = &chunk.roll;
        let [mx, my, mz] = &mut chunk.torque;
        for i in 0..chunk.len {
            let squared = wx[i] * wx[i] + wy[i] * wy[i] + wz[i] * wz[i];
            let slow = self.smoothing_speed / chunk.radius[i];
            let factor = chunk.rolling[i] * chunk.normal_force[i].max(0.0) / squared.sqrt().max(slow);
            mx[i] -= factor * wx[i];
            my[i] -= factor * wy[i];
            mz[i] -= factor * wz[i];
            chunk.lost_rolling[i] += factor * squared;
        }
    }
}
