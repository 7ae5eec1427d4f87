//! A stream in layers that gives to the grains and takes from them.
//!
//! The momentum of the water in a layer of thickness h, averaged over the plan area A, e the share that grains leave to it:
//!
//! rho e h dU/dt = rho e h a + t(upper face) - t(lower face) - R/A
//!
//! a: what drives the stream along x (gravity on the slope, or what holds a shear velocity); R: what the grains of the layer
//! get from the water, all of it: what they gain the water loses. What a grain picks up as added mass on its way through the
//! surface, with its velocity, the stream loses as well. The stress at a face is turbulent or, where
//! that is less, viscous,
//!
//! t = rho max(nu, l^2 |dU/dz|) dU/dz,      l = 0.40 s sqrt(1 - s/S),  s = integral of (1 - (1-e)/0.61) dZ
//!
//! with Prandtl's mixing length l, which grains shorten (Li and Sawamoto 1995) and the surface, where s = S, ends: without grains
//! the log law over the whole depth. The integral begins above the highest layer that grains fill by half: in a bed nothing mixes,
//! however loose and deep it is (the stream in YADE, of Maurin et al. 2015, does likewise below the highest layer of 0.61). Between two middles l grows nearly evenly, so the difference of U is dU/dz times h over the
//! logarithmic mean of l: with it the discrete stream has the log law without error. The bottom drags with
//! rho (0.40 / ln(Z0/z0))^2 U0^2 at the lowest middle Z0, z0 = k exp(-8.5 x 0.40) (Nikuradse 1933). The top, a lid or
//! a free surface, has no stress. Stresses are taken at the end of the step, with the viscosity of its begin. Over a rough bottom the log law
//! has the viscosity in it already, so the two kinds of stress are not added.
//!
//! Grains read the velocity that the last two steps foretell for the end of the present one: with the old one the books of
//! energy would be of first order in the step.

mod level;
mod step;

pub use level::Top;

use super::Layers;
use super::log_law::{CONSTANT, karman};
use crate::about::About;
use glam::DVec3;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;

pub(super) const ABOUT: About = About {
    key: "water.flow.coupled",
    formula: "rho e h dU/dt = rho e h a + t(upper face) - t(lower face) - R/A, for a layer of thickness h\n\
t = rho max(nu, l^2 |dU/dz|) dU/dz\n\
l = 0.40 s sqrt(1 - s/S), s = integral of (1 - (1-e)/0.61) dZ from above the highest layer that grains fill by half, S is s at the top",
    symbols: "U velocity along x [m/s], e share of a layer that grains leave to the water [-], a drive [m/s^2], t stress [Pa], R what the \
water does to the grains of the layer along x [N], A plan area [m^2], l mixing length [m], rho density [kg/m^3], nu viscosity [m^2/s]",
    limits: "The same all along x: no waves. Shares are measured every 50 steps. Without grains it is the log law.",
    reference: "Prandtl's mixing length, shortened by grains as in Li and Sawamoto (1995), ended in the bed as in Maurin et al. (2015); \
bottom as Nikuradse (1933)",
};

/// Share left to the water below which a layer belongs to the bed when the stream begins.
const FILLED: f64 = 0.8;

/// Share left to the water below which a layer belongs to the bed that the stream moves over.
const BED: f64 = 0.7;

/// Steps between two looks at where the grains are.
pub(crate) const EVERY: u64 = 50;

/// What moved energy into or out of the stream.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Turnover {
    /// Work of what drives it [J].
    pub work: f64,
    /// Lost in its own stress, at the bottom and in mixing [J].
    pub lost: f64,
    /// Given to what grains have picked up [J].
    pub picked: f64,
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
    /// U* of the turbulent stress in every layer [m/s].
    turbulent: Vec<f64>,
    /// What ends it above.
    top: Top,
    /// Volume of water over the plan area that a free surface keeps [m].
    volume: f64,
    density: f64,
    viscosity: f64,
    /// Height above the bottom where the log law is zero [m].
    rough: f64,
    /// What drives it [m/s^2].
    drive: f64,
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
    /// What ends it above.
    pub top: Top,
    /// Whether it begins at rest.
    pub still: bool,
}

impl Coupled {
    /// A stream without grains.
    pub fn new(layers: Layers, setting: &Setting) -> Self {
        let n = layers.len();
        let depth = n as f64 * layers.thickness;
        // What holds a discharge is found step by step; the slope, if there is one, drives as well.
        let drive = setting.shear_velocity.map_or(setting.gravity, |shear| shear * shear / depth);
        let rough = setting.roughness * (-CONSTANT * karman()).exp();
        let mut stream = Self {
            velocity: vec![0.0; n],
            ahead: vec![0.0; n],
            taken: vec![0.0; n],
            turbulent: vec![0.0; n],
            top: setting.top,
            volume: layers.volume(),
            density: setting.density,
            viscosity: setting.viscosity,
            rough,
            drive,
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

    /// Goes on where an earlier stream with the same layers has come to.
    pub(super) fn go_on_from(&mut self, earlier: Self) {
        let Self { layers, velocity, ahead, taken, turbulent, volume, impulses, .. } = earlier;
        *self = Self { layers, velocity, ahead, taken, turbulent, volume, impulses, ..self.clone() };
    }

    /// Sets the log law that the drive holds over the highest layer which grains fill by more than a fifth; the water below
    /// stands. Begun within a bed it would be torn down by the grains at once.
    fn begin(&mut self) {
        let (n, h) = (self.layers.len(), self.layers.thickness);
        let bed = self.layers.porosity.iter().rposition(|porosity| *porosity < FILLED).map_or(0, |k| k + 1);
        let law = |k: usize| {
            let z = (k as f64 + 0.5 - bed as f64) * h;
            if k < bed { 0.0 } else { ((z / self.rough).ln() / karman()).max(0.0) }
        };
        let shape: Vec<f64> = (0..n).map(law).collect();
        let through: f64 = shape.iter().zip(&self.layers.porosity).map(|(u, e)| u * e * h).sum();
        let scale = match self.top.discharge() {
            Some(discharge) if through > 0.0 => discharge / through,
            _ => (self.drive.max(0.0) * (n - bed) as f64 * h).sqrt(),
        };
        for (velocity, u) in self.velocity.iter_mut().zip(shape) {
            *velocity = scale * u;
        }
        self.ahead.copy_from_slice(&self.velocity);
        self.stiffness();
        self.feel_turbulence();
    }

    /// Makes room for grains before anything moves.
    pub fn init_porosity(&mut self, position: &[DVec3], radius: &[f64]) {
        self.layers.porosity = self.layers.measure(position, radius);
        self.volume = self.layers.volume();
        if self.velocity.iter().any(|u| *u != 0.0) {
            self.begin();
        }
    }

    /// Mass of the water in layer `k` over the plan area [kg/m^2].
    fn mass(&self, k: usize) -> f64 {
        self.density * self.layers.water(k)
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
        self.velocity.iter().enumerate().map(|(k, u)| u * self.layers.water(k)).sum()
    }

    /// Shear stress of the water at the faces of the layers, from the bottom to the top [Pa]: one more than there are layers.
    pub fn stresses(&self) -> Vec<f64> {
        let mut now = self.clone();
        now.stiffness();
        let bottom = self.density * self.bottom_factor() * self.velocity[0] * self.velocity[0].abs();
        let between = self.velocity.windows(2).zip(&now.stiff).map(|(u, stiff)| stiff * (u[1] - u[0]));
        [bottom].into_iter().chain(between).chain([0.0]).collect()
    }

    /// The first layer over the highest one that leaves less than this share to the water.
    fn above(&self, share: f64) -> usize {
        self.layers.porosity.iter().rposition(|porosity| *porosity < share).map_or(0, |k| k + 1)
    }

    /// The first layer over the bed, which ends with the highest layer that grains fill by three tenths, half of what a packing has.
    fn bed(&self) -> usize {
        self.above(BED)
    }

    /// Height z at which the bed ends [m].
    pub fn bed_top(&self) -> f64 {
        self.layers.top() - (self.layers.len() - self.bed()) as f64 * self.layers.thickness
    }

    /// Volume of water over the bed over the plan area [m].
    pub fn over_bed(&self) -> f64 {
        (self.bed()..self.layers.len()).map(|k| self.layers.water(k)).sum()
    }

    /// What the water brings to the bed over its area [Pa]: its stress at the top of the bed, and all that it gives to grains above.
    pub fn bed_stress(&self) -> f64 {
        let bed = self.bed();
        self.stresses()[bed] + self.taken[bed..].iter().sum::<f64>() / self.layers.area
    }

    /// U* at the bottom, from its stress [m/s].
    pub fn bottom_shear_velocity(&self) -> f64 {
        self.bottom_factor().sqrt() * self.velocity[0].abs()
    }

    /// U* of the turbulent stress in every layer: what its fluctuation is measured by [m/s].
    pub fn turbulence(&self) -> &[f64] {
        &self.turbulent
    }

    /// Largest of it [m/s].
    pub fn most_turbulent(&self) -> f64 {
        self.turbulent.iter().copied().fold(0.0, f64::max)
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

    pub(super) fn save(&self, state: &mut State) {
        let mut values = self.velocity.clone();
        values.extend(&self.ahead);
        values.extend(&self.layers.porosity);
        values.extend(&self.taken);
        values.extend(&self.turbulent);
        values.extend(self.impulses);
        values.extend([self.layers.thickness, self.volume]);
        state.put_real("water.stream", values);
    }

    pub(super) fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        let values = state.real("water.stream")?;
        let n = self.layers.len();
        if values.len() != 5 * n + 5 {
            return Err(MissingSection { name: "water.stream".to_owned(), kind: "real" });
        }
        let (layers, rest) = values.split_at(5 * n);
        let columns =
            [&mut self.velocity, &mut self.ahead, &mut self.layers.porosity, &mut self.taken, &mut self.turbulent];
        for (column, values) in columns.into_iter().zip(layers.chunks_exact(n)) {
            column.copy_from_slice(values);
        }
        self.impulses.copy_from_slice(&rest[..3]);
        (self.layers.thickness, self.volume) = (rest[3], rest[4]);
        Ok(())
    }
}

#[cfg(test)]
mod tests;
