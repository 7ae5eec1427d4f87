//! Turbulent fluctuation of the water that a grain sees.
//!
//! A velocity that wanders, without a state: every grain draws normal numbers at the ends of intervals, and in between
//!
//! g(t) = a cos(pi s/2) + b sin(pi s/2),  s = 0 .. 1 from a's end of the interval to b's.
//!
//! The sum of the squares is 1, so the variance is that of the numbers at all times. The intervals of each grain begin at a moment
//! of its own, so over many grains the correlation depends on the lag only: (1 - x/2) cos(pi x/2) + sin(pi x/2)/pi, x = lag over
//! interval, up to x = 2. Its integral is 8/pi^2 intervals, the Lagrangian time, which with the variance is all that dispersion
//! over longer times depends on (Taylor 1921).

use crate::about::About;
use crate::random::{Purpose, unit, words};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use tsubu_scene::plan;

/// Text on it.
pub(super) const ABOUT: About = About {
    key: "water.fluctuation",
    formula: "U' = min(strength U*, |U|) g, g normal, correlated over the Lagrangian time T, with variances 1 in each direction or, as \
a `stream` has them, 1.66, 0.83 and 0.51 along, across and up; \
independent draws every pi^2/8 T, between them a cos(pi s/2) + b sin(pi s/2)",
    symbols: "U* shear velocity, in a coupled stream that of the turbulent stress at the height of the grain [m/s], U mean velocity at the grain [m/s], T [s], s share of the interval that has passed [-]",
    limits: "Neighbours see independent water; no correlation between directions; the same T at all heights; what falls through \
eddies keeps their time all the same (no crossing trajectories). Correlations end after 2.5 T and do not decay as exp(-t/T).",
    reference: "Taylor (1921); Nezu and Nakagawa (1993) for strengths: 2.3, 1.6 and 1.3 along, across and up at a bed, less above",
};

/// Which numbers the water around each grain goes between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fluctuation {
    /// Root-mean-square over the shear velocity, mean of the squares of the directions [-].
    pub strength: f64,
    /// Strengths of the directions over that [-].
    pub shares: [f64; 3],
    /// Time between two draws [s].
    interval: f64,
    pub(super) seed: u64,
    pub(super) in_space: bool,
}

/// What was drawn for a grain: memory of what can be drawn again at any time, so it is no state.
#[derive(Clone, Copy, Debug)]
pub struct Gust {
    id: u32,
    interval: u64,
    begun: f64,
    ends: [[f64; 3]; 2],
}

impl Default for Gust {
    fn default() -> Self {
        Self { id: u32::MAX, interval: u64::MAX, begun: 0.0, ends: [[0.0; 3]; 2] }
    }
}

impl Fluctuation {
    /// The fluctuation of a plan.
    pub fn new(plan: &plan::Fluctuation) -> Self {
        Self {
            strength: plan.strength,
            shares: plan.directions.shares(),
            interval: PI * PI / 8.0 * plan.time,
            seed: 0,
            in_space: true,
        }
    }

    /// Numbers of variance 1 for grain `id` at a time [s].
    #[inline]
    pub fn at(&self, gust: &mut Gust, id: u32, time: f64) -> [f64; 3] {
        let now = time / self.interval;
        if gust.id != id {
            let w = words(self.seed, Purpose::Fluctuation, id, u64::MAX);
            *gust = Gust { id, begun: unit(w[0], w[1]), ..Gust::default() };
        }
        let now = now + gust.begun;
        let interval = now as u64;
        if gust.interval != interval {
            gust.interval = interval;
            gust.ends = [interval, interval + 1].map(|end| self.draw(id, end));
        }
        let (late, early) = (FRAC_PI_2 * (now - interval as f64)).sin_cos();
        let [a, b] = gust.ends;
        std::array::from_fn(|k| a[k] * early + b[k] * late)
    }

    /// Three normal numbers (Box and Muller 1958); in the plane none across.
    fn draw(&self, id: u32, end: u64) -> [f64; 3] {
        let pair = |part: u64| {
            let w = words(self.seed, Purpose::Fluctuation, id, 2 * end + part);
            let size = (-2.0 * (1.0 - unit(w[0], w[1])).ln()).sqrt();
            let (sin, cos) = (TAU * unit(w[2], w[3])).sin_cos();
            [size * cos, size * sin]
        };
        let [x, z] = pair(0);
        let y = if self.in_space { pair(1)[0] } else { 0.0 };
        [x, y, z]
    }
}
