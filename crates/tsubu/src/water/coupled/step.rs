//! One step of the stream: the stresses between layers, turbulent or viscous, and the momentum that they carry, solved at the end of
//! the step.

use super::{Coupled, Top, Turnover};
use crate::water::log_law::karman;

/// Solid fraction at which nothing mixes any more.
const PACKED: f64 = 0.61;

/// Share left to the water below which nothing mixes in a layer and in those under it. Beds are packed looser than [`PACKED`], in
/// the plane above all: what is missing, layer by layer, would add up to eddies as long as the bed is deep.
const DENSE: f64 = 0.5;

impl Coupled {
    /// Moves the stream by `dt` [s], in which the force on the grains has gone from what it was to `taken` [N] and grains have picked
    /// up water with the momentum `picked` along x [N.s], by layers.
    pub fn step(&mut self, taken: &[f64], picked: &[f64], dt: f64) -> Turnover {
        self.stiffness();
        let n = self.layers.len();
        let area = self.layers.area;
        let bottom = self.density * self.bottom_factor() * self.velocity[0].abs();
        // Thomas's algorithm from the bottom up; the matrix is diagonally dominant.
        let mut before = 0.0;
        for k in 0..n {
            let mass = self.mass(k);
            let given = -(0.5 * dt * (self.taken[k] + taken[k]) + picked[k]) / area;
            let (low, high) =
                (if k > 0 { self.stiff[k - 1] } else { 0.0 }, if k + 1 < n { self.stiff[k] } else { 0.0 });
            let ground = if k == 0 { bottom } else { 0.0 };
            let diagonal = mass + dt * (low + high + ground);
            let right = mass * (self.velocity[k] + dt * self.drive) + given;
            let (upper, next) = if k > 0 { (self.upper[k - 1], before) } else { (0.0, 0.0) };
            let pivot = diagonal - dt * low * upper;
            self.upper[k] = dt * high / pivot;
            before = (right + dt * low * next) / pivot;
            self.next[k] = before;
        }
        for k in (0..n - 1).rev() {
            self.next[k] += self.upper[k] * self.next[k + 1];
        }
        let held = self.hold();
        let mut turnover = Turnover::default();
        let mut given = 0.0;
        for k in 0..n {
            let (old, new) = (self.velocity[k], self.next[k]);
            let (mass, middle) = (self.mass(k), 0.5 * (old + new));
            let force = 0.5 * dt * (self.taken[k] + taken[k]) + picked[k];
            let drive = area * mass * (dt * self.drive + held);
            // What is left of the change of momentum is stress.
            let stress = area * mass * (new - old) - drive + force;
            turnover.work += middle * drive;
            turnover.lost -= middle * stress;
            turnover.picked += middle * picked[k];
            self.impulses[0] += drive;
            given += force;
        }
        self.impulses[1] -= area * dt * bottom * (self.next[0] - held);
        self.impulses[2] += given;
        for (ahead, (new, old)) in self.ahead.iter_mut().zip(self.next.iter().zip(&self.velocity)) {
            *ahead = 2.0 * new - old;
        }
        std::mem::swap(&mut self.velocity, &mut self.next);
        self.taken.copy_from_slice(taken);
        self.feel_turbulence();
        turnover
    }

    /// Adds what the held discharge misses to all layers alike [m/s].
    fn hold(&mut self) -> f64 {
        let Top::Lid { discharge: Some(wanted) } = self.top else { return 0.0 };
        let now: f64 = self.next.iter().enumerate().map(|(k, u)| u * self.layers.water(k)).sum();
        let missing = (wanted - now) / self.layers.volume();
        for u in &mut self.next {
            *u += missing;
        }
        missing
    }

    /// Stress over the difference of velocities at the upper face of every layer [kg/(m^2 s)].
    pub(super) fn stiffness(&mut self) {
        let n = self.layers.len();
        let h = self.layers.thickness;
        let bed = self.above(DENSE);
        let mixing = |porosity: f64| (1.0 - (1.0 - porosity) / PACKED).max(0.0) * h;
        let depth: f64 = self.layers.porosity[bed..].iter().map(|porosity| mixing(*porosity)).sum();
        let mut below = 0.0;
        let mut last = 0.0;
        for k in 0..n {
            let here = if k < bed { 0.0 } else { mixing(self.layers.porosity[k]) };
            let length = karman() * (below + 0.5 * here);
            if k > 0 {
                let surface = 1.0 - below / depth;
                let slope = logarithmic_mean(last, length) / h;
                let shear = (self.velocity[k] - self.velocity[k - 1]).abs();
                self.stiff[k - 1] = self.density * (self.viscosity / h).max(surface * slope * slope * shear);
            }
            below += here;
            last = length;
        }
    }

    /// U* of the turbulent stress in every layer, the mean of those at its faces. Where viscosity has the stress, as among grains
    /// of a bed, there is no turbulence.
    pub(super) fn feel_turbulence(&mut self) {
        let n = self.layers.len();
        let viscous = self.density * self.viscosity / self.layers.thickness;
        let mut below = self.bottom_shear_velocity();
        for k in 0..n {
            let above = if k + 1 < n && self.stiff[k] > viscous {
                (self.stiff[k] / self.density * (self.velocity[k + 1] - self.velocity[k]).abs()).sqrt()
            } else {
                0.0
            };
            self.turbulent[k] = 0.5 * (below + above);
            below = above;
        }
    }
}

/// (b - a) / ln(b/a): what an even growth from a to b has in place of a mean; 0 where one of them is.
pub(super) fn logarithmic_mean(a: f64, b: f64) -> f64 {
    if a <= 0.0 || b <= 0.0 {
        return 0.0;
    }
    let ratio = b / a;
    if (ratio - 1.0).abs() < 1e-6 { 0.5 * (a + b) } else { (b - a) / ratio.ln() }
}
