//! A stream in layers that gives to the grains and takes from them.
//!
//! The momentum of the water in a layer of thickness h, averaged over the plan area A, e the share that grains leave to it:
//!
//! rho e h dU/dt = rho e h a + t(upper face) - t(lower face) - R/A
//!
//! a: what drives the stream along x (gravity on the slope, or what holds a shear velocity); R: what the grains of the layer
//! get from the water, all of it: what they gain the water loses. The stress at a face is turbulent or, where
//! that is less, viscous,
//!
//! t = rho max(nu, l^2 |dU/dz|) dU/dz,      l = 0.40 s sqrt(1 - s/S),  s = integral of (1 - (1-e)/0.61) dZ
//!
//! with Prandtl's mixing length l, which grains shorten (Li and Sawamoto 1995) and the surface, where s = S, ends: without grains
//! the log law over the whole depth. Between two middles l grows nearly evenly, so the difference of U is dU/dz times h over the
//! logarithmic mean of l: with it the discrete stream has the log law without error. The bottom drags with
//! rho (0.40 / ln(Z0/z0))^2 U0^2 at the lowest middle Z0, z0 = k exp(-8.5 x 0.40) (Nikuradse 1933). The top is a lid
//! without stress. Stresses are taken at the end of the step, with the viscosity of its begin. Over a rough bottom the log law
//! has the viscosity in it already, so the two kinds of stress are not added.
//!
//! Grains read the velocity that the last two steps foretell for the end of the present one: with the old one the books of
//! energy would be of first order in the step.

use super::Layers;
use super::stream::{CONSTANT, PER_DECADE};
use glam::DVec3;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;

/// Solid fraction at which nothing mixes any more.
const PACKED: f64 = 0.61;

/// Share left to the water below which a layer belongs to the bed when the stream begins.
const FILLED: f64 = 0.8;

/// Steps between two looks at where the grains are.
pub(crate) const EVERY: u64 = 50;

/// What moved energy into or out of the stream.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Turnover {
    /// Work of what drives it [J].
    pub work: f64,
    /// Lost in its own stress and at the bottom [J].
    pub lost: f64,
}

/// A stream in layers.
#[derive(Clone, Debug)]
pub struct Coupled {
    /// Where the layers are.
    pub layers: Layers,
    /// Velocity of every layer along x [m/s].
    pub velocity: Vec<f64>,
    /// What it will be at the end of the next step, by the last one [m/s].
    ahead: Vec<f64>,
    /// Force of the water on the grains of every layer at the last time level, along x [N].
    taken: Vec<f64>,
    density: f64,
    viscosity: f64,
    /// Height above the bottom where the log law is zero [m].
    rough: f64,
    /// What drives it [m/s^2].
    drive: f64,
    discharge: Option<f64>,
    /// Impulses since time 0 [N.s]: of the drive, of the bottom, on the grains.
    pub impulses: [f64; 3],
    // Scratch.
    next: Vec<f64>,
    upper: Vec<f64>,
    stiff: Vec<f64>,
}

/// How a stream is built.
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    /// Density [kg/m^3].
    pub density: f64,
    /// Kinematic viscosity [m^2/s].
    pub viscosity: f64,
    /// Equivalent roughness of the bottom [m].
    pub roughness: f64,
    /// Gravity along x [m/s^2].
    pub gravity: f64,
    /// U* that the drive would hold without grains [m/s].
    pub shear_velocity: Option<f64>,
    /// Discharge per width that is held [m^2/s].
    pub discharge: Option<f64>,
    /// Whether it begins at rest.
    pub still: bool,
}

/// Karman's constant in the log law 8.5 + 5.75 log10(Z/k).
fn karman() -> f64 {
    std::f64::consts::LN_10 / PER_DECADE
}

impl Coupled {
    /// A stream without grains.
    pub fn new(layers: Layers, setting: &Setting) -> Self {
        let n = layers.len();
        let depth = n as f64 * layers.thickness;
        let drive = setting.shear_velocity.map_or(setting.gravity, |shear| shear * shear / depth);
        let rough = setting.roughness * (-CONSTANT * karman()).exp();
        // What holds a discharge is found step by step; the slope, if there is one, drives as well.
        let drive = if setting.discharge.is_some() { setting.gravity } else { drive };
        let mut stream = Self {
            velocity: vec![0.0; n],
            ahead: vec![0.0; n],
            taken: vec![0.0; n],
            density: setting.density,
            viscosity: setting.viscosity,
            rough,
            drive,
            discharge: setting.discharge,
            impulses: [0.0; 3],
            next: vec![0.0; n],
            upper: vec![0.0; n],
            stiff: vec![0.0; n],
            layers,
        };
        if !setting.still {
            stream.begin();
        }
        stream
    }

    /// Sets the log law that the drive holds over the highest layer which grains fill by more than a fifth; the water below
    /// stands. Begun within a bed it would be torn down by the grains at once.
    fn begin(&mut self) {
        let (n, h) = (self.layers.len(), self.layers.thickness);
        let bed = self.layers.open.iter().rposition(|open| *open < FILLED).map_or(0, |k| k + 1);
        let law = |k: usize| {
            let z = (k as f64 + 0.5 - bed as f64) * h;
            if k < bed { 0.0 } else { ((z / self.rough).ln() / karman()).max(0.0) }
        };
        let shape: Vec<f64> = (0..n).map(law).collect();
        let through: f64 = shape.iter().zip(&self.layers.open).map(|(u, e)| u * e * h).sum();
        let scale = match self.discharge {
            Some(discharge) if through > 0.0 => discharge / through,
            _ => (self.drive.max(0.0) * (n - bed) as f64 * h).sqrt(),
        };
        for (velocity, u) in self.velocity.iter_mut().zip(shape) {
            *velocity = scale * u;
        }
        self.ahead.copy_from_slice(&self.velocity);
    }

    /// Makes room for grains before anything moves.
    pub fn make_room(&mut self, position: &[DVec3], radius: &[f64]) {
        self.layers.open = self.layers.measure(position, radius);
        if self.velocity.iter().any(|u| *u != 0.0) {
            self.begin();
        }
    }

    /// Mass of the water in layer `k` over the plan area [kg/m^2].
    fn mass(&self, k: usize) -> f64 {
        self.density * self.layers.open[k] * self.layers.thickness
    }

    /// Momentum of the stream along x [N.s].
    pub fn momentum(&self) -> f64 {
        self.layers.area * (0..self.layers.len()).map(|k| self.mass(k) * self.velocity[k]).sum::<f64>()
    }

    /// Velocity of every layer that grains meet in the next step [m/s].
    pub fn ahead(&self) -> &[f64] {
        &self.ahead
    }

    /// Kinetic energy of the stream [J].
    pub fn energy(&self) -> f64 {
        let squares = (0..self.layers.len()).map(|k| 0.5 * self.mass(k) * self.velocity[k].powi(2));
        self.layers.area * squares.sum::<f64>()
    }

    /// Discharge of water per width [m^2/s].
    pub fn discharge(&self) -> f64 {
        let parts = self.velocity.iter().zip(&self.layers.open).map(|(u, e)| u * e * self.layers.thickness);
        parts.sum()
    }

    /// U* at the bottom, from its stress [m/s].
    pub fn bottom_shear_velocity(&self) -> f64 {
        self.bottom_factor().sqrt() * self.velocity[0].abs()
    }

    /// (0.40 / ln(Z0/z0))^2 of the lowest middle; a bottom rougher than the layer is thick is as rough as that.
    fn bottom_factor(&self) -> f64 {
        let ratio = (0.5 * self.layers.thickness / self.rough).max(1.5);
        (karman() / ratio.ln()).powi(2)
    }

    /// Forces on the grains by layers at a moment that no step has led to [N].
    pub fn stand(&mut self, taken: &[f64]) {
        self.taken.copy_from_slice(taken);
    }

    /// Moves the stream by `dt` [s], in which the force on the grains has gone from what it was to `taken` [N], by layers.
    #[expect(clippy::needless_range_loop, reason = "a grid: all columns at the same index")]
    pub fn step(&mut self, taken: &[f64], dt: f64) -> Turnover {
        self.stiffness();
        let n = self.layers.len();
        let area = self.layers.area;
        let bottom = self.density * self.bottom_factor() * self.velocity[0].abs();
        // Thomas's algorithm from the bottom up; the matrix is diagonally dominant.
        let mut before = 0.0;
        for k in 0..n {
            let mass = self.mass(k);
            let given = -0.5 * dt * (self.taken[k] + taken[k]) / area;
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
            let force = 0.5 * dt * (self.taken[k] + taken[k]);
            let drive = area * mass * (dt * self.drive + held);
            // What is left of the change of momentum is stress.
            let stress = area * mass * (new - old) - drive + force;
            turnover.work += middle * drive;
            turnover.lost -= middle * stress;
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
        turnover
    }

    /// Adds what the held discharge misses to all layers alike [m/s].
    fn hold(&mut self) -> f64 {
        let Some(wanted) = self.discharge else { return 0.0 };
        let (h, open) = (self.layers.thickness, &self.layers.open);
        let now: f64 = self.next.iter().zip(open).map(|(u, e)| u * e * h).sum();
        let missing = (wanted - now) / (h * open.iter().sum::<f64>());
        for u in &mut self.next {
            *u += missing;
        }
        missing
    }

    /// Stress over the difference of velocities at the upper face of every layer [kg/(m^2 s)].
    fn stiffness(&mut self) {
        let n = self.layers.len();
        let h = self.layers.thickness;
        let mixing = |open: f64| (1.0 - (1.0 - open) / PACKED).max(0.0) * h;
        let depth: f64 = self.layers.open.iter().map(|open| mixing(*open)).sum();
        let mut below = 0.0;
        let mut last = 0.0;
        for k in 0..n {
            let here = mixing(self.layers.open[k]);
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

    /// Looks where the grains are. Water makes way for them along z and takes its momentum with it.
    #[expect(clippy::needless_range_loop, reason = "a grid: all columns at the same index")]
    pub fn look(&mut self, position: &[DVec3], radius: &[f64]) -> Turnover {
        let open = self.layers.measure(position, radius);
        let before = self.energy();
        let scale = self.density * self.layers.thickness;
        let mut momentum: Vec<f64> = (0..open.len()).map(|k| self.mass(k) * self.velocity[k]).collect();
        // Volume over area and thickness that goes up through the upper face of each layer.
        let mut up = 0.0;
        for k in 0..open.len() {
            up += self.layers.open[k] - open[k];
            if k + 1 < open.len() {
                let carried = scale * up * self.velocity[if up > 0.0 { k } else { k + 1 }];
                momentum[k] -= carried;
                momentum[k + 1] += carried;
            } else {
                // Grains that came or went have moved the lid's water: it goes with the velocity of the top.
                let carried = scale * up * self.velocity[k];
                momentum[k] -= carried;
                self.impulses[0] -= carried * self.layers.area;
            }
        }
        self.layers.open = open;
        for k in 0..momentum.len() {
            let now = momentum[k] / self.mass(k);
            self.ahead[k] += now - self.velocity[k];
            self.velocity[k] = now;
        }
        Turnover { work: 0.0, lost: before - self.energy() }
    }

    pub(super) fn save(&self, state: &mut State) {
        let mut values = self.velocity.clone();
        values.extend(&self.ahead);
        values.extend(&self.layers.open);
        values.extend(&self.taken);
        values.extend(self.impulses);
        state.put_real("water.stream", values);
    }

    pub(super) fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        let values = state.real("water.stream")?;
        let n = self.layers.len();
        if values.len() != 4 * n + 3 {
            return Err(MissingSection { name: "water.stream".to_owned(), kind: "real" });
        }
        self.velocity.copy_from_slice(&values[..n]);
        self.ahead.copy_from_slice(&values[n..2 * n]);
        self.layers.open.copy_from_slice(&values[2 * n..3 * n]);
        self.taken.copy_from_slice(&values[3 * n..4 * n]);
        self.impulses.copy_from_slice(&values[4 * n..]);
        Ok(())
    }
}

/// (b - a) / ln(b/a): what an even growth from a to b has in place of a mean; 0 where one of them is.
fn logarithmic_mean(a: f64, b: f64) -> f64 {
    if a <= 0.0 || b <= 0.0 {
        return 0.0;
    }
    let ratio = b / a;
    if (ratio - 1.0).abs() < 1e-6 { 0.5 * (a + b) } else { (b - a) / ratio.ln() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stream(layers: usize, still: bool) -> Coupled {
        let setting = Setting {
            density: 1000.0,
            viscosity: 1e-6,
            roughness: 2e-3,
            gravity: 0.49,
            shear_velocity: None,
            discharge: None,
            still,
        };
        Coupled::new(Layers::new(0.0, 0.02, layers, 1e-3), &setting)
    }

    /// Begun at rest, the empty stream becomes the log law of U* = sqrt(a H), within 1 % in every layer, for any layers: what
    /// viscosity takes near the bottom is in that. With the plain mean of the mixing lengths it would miss more.
    #[test]
    fn the_empty_stream_is_the_log_law() {
        for layers in [5, 20, 80] {
            let mut stream = stream(layers, true);
            let none = vec![0.0; layers];
            for _ in 0..40_000 {
                stream.step(&none, 1e-3);
            }
            let shear = (0.49f64 * 0.02).sqrt();
            for k in 0..layers {
                let z = stream.layers.middle(k);
                let law = shear * (8.5 + 5.75 * (z / 2e-3).log10());
                assert!((stream.velocity[k] / law - 1.0).abs() < 0.01, "{layers} {k}: {} {law}", stream.velocity[k]);
            }
            assert!((stream.bottom_shear_velocity() / shear - 1.0).abs() < 1e-3);
        }
        assert!((0.5 * (1.0 + 3.0) / logarithmic_mean(1.0, 3.0) - 1.0).abs() > 0.05);
    }

    /// Momentum of the water: what the drive gave less what the bottom and the grains took, to round-off, also while grains
    /// that take from it sink through it; energy: what the drive did less what is lost and given.
    #[test]
    fn momentum_and_energy_close() {
        let mut stream = stream(20, false);
        let (momentum, energy) = (stream.momentum(), stream.energy());
        let (mut books, mut given) = (Turnover::default(), 0.0);
        let dt = 1e-4;
        for step in 0..2000 {
            let z = 0.018 - 1e-5 * f64::from(step);
            if step % 10 == 0 {
                let turned = stream.look(&[DVec3::new(0.0, 0.0, z.max(2e-3))], &[1.5e-3]);
                books.lost += turned.lost;
            }
            let mut taken = vec![0.0; 20];
            taken[8] = 1e-4 * (f64::from(step) * 0.01).sin().abs();
            let old = stream.velocity[8];
            let before = stream.taken[8];
            let turned = stream.step(&taken, dt);
            given += 0.5 * dt * (before + taken[8]) * 0.5 * (old + stream.velocity[8]);
            books.work += turned.work;
            books.lost += turned.lost;
        }
        let [drive, bottom, grains] = stream.impulses;
        let missing = stream.momentum() - momentum - drive - bottom + grains;
        assert!(missing.abs() < 1e-12 * stream.momentum(), "{missing:e}");
        let missing = stream.energy() - energy - books.work + books.lost + given;
        assert!(missing.abs() < 1e-10 * stream.energy(), "{missing:e}");
        assert!(grains > 0.0 && bottom < 0.0 && books.lost > 0.0);
    }

    /// A held discharge is held, also from rest.
    #[test]
    fn a_discharge_is_held() {
        let setting = Setting {
            density: 1000.0,
            viscosity: 1e-6,
            roughness: 2e-3,
            gravity: 0.0,
            shear_velocity: None,
            discharge: Some(0.02),
            still: true,
        };
        let mut stream = Coupled::new(Layers::new(0.0, 0.02, 20, 1e-3), &setting);
        for _ in 0..10_000 {
            stream.step(&[0.0; 20], 1e-3);
        }
        assert!((stream.discharge() - 0.02).abs() < 1e-12);
        let shape = stream.velocity[19] / stream.velocity[0];
        let law = |z: f64| 8.5 + 5.75 * (z / 2e-3).log10();
        assert!((shape / (law(0.0195) / law(0.0005)) - 1.0).abs() < 0.01, "{shape}");
    }
}
