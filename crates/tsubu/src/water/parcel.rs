//! A parcel: up to 128 grains in water as plain columns.

use super::part::WorkKind;
use crate::contact::chunk::{Column, ROWS, ZERO};
use crate::state::sphere;
use glam::DVec3;
use multiversion::multiversion;

const VECTOR: [Column; 3] = [ZERO; 3];

/// Grains in water. The engine fills in what they are and how they move, the water how it moves there, the parts their
/// forces.
#[derive(Clone, Debug)]
pub struct Parcel {
    /// Rows in use; read it with [`Parcel::rows`].
    pub len: usize,

    /// Height z of the centre [m].
    pub height: Column,
    /// Radius; of a body that is no sphere that of the sphere of its volume [m].
    pub radius: Column,
    /// Surface of that sphere over that of the grain [-]; 1 in rows that nobody fills in.
    pub sphericity: Column,
    /// Velocity [m/s].
    pub velocity: [Column; 3],
    /// Spin [rad/s].
    pub spin: [Column; 3],

    /// Fluctuation of the water, where there is one: in units of its root-mean-square [-], and once it powers in m/s.
    pub fluctuation: [Column; 3],
    /// Shear velocity of the turbulence around the grain [m/s]; where there is a fluctuation.
    pub turbulence: Column,

    /// Share of the grain that is under water [-].
    pub wet: Column,
    /// Volume under water [m^3].
    pub volume: Column,
    /// The layer whose middle is below the centre; this and the next only where the water has layers.
    pub layer: [i32; ROWS],
    /// What the layer above counts for, of 1 [-].
    pub share: Column,
    /// Share of the volume that the grains around leave to the water [-].
    pub porosity: Column,
    /// Velocity of the water at the centre, as it would be without the grain [m/s].
    pub flow: [Column; 3],
    /// Velocity of the water relative to the grain [m/s].
    pub slip: [Column; 3],
    /// Its size [m/s].
    pub speed: Column,
    /// Spin of the water at the centre, half its vorticity [rad/s]; this and the next two only where a part asks for spins.
    pub flow_spin: [Column; 3],
    /// Spin of the water relative to the grain [rad/s].
    pub turn: [Column; 3],
    /// Its size [rad/s].
    pub turning: Column,

    /// Result: force of the part that acts [N].
    pub force: [Column; 3],
    /// Result: force of all parts so far [N].
    pub total: [Column; 3],
    /// Result: torque of the part that acts [N.m].
    pub torque: [Column; 3],
    /// Result: torque of all parts so far [N.m].
    pub total_torque: [Column; 3],
}

/// What a layer gives to the grains between its middle and the next one [N]: all, and of that the next layer's part. Rows with
/// even numbers, and those with odd ones: neighbours are in the same layers, and one sum would have to wait for the last.
pub(crate) type LayerReaction = [[f64; 2]; 2];

/// What the water does to grains, summed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WaterPowers {
    /// Power of the pressure on the grains [W].
    pub pressure: f64,
    /// Power of the pressure with the velocity of the water: what a stream that is part of the system loses by it [W].
    pub carried: f64,
    /// Power of the stream: forces times its velocity [W].
    pub stream: f64,
    /// Power of its spin: torques times it [W]. No stream is charged with it: what turns grains is below what layers know.
    pub spin_work: f64,
    /// Power of the fluctuation in a stream that is part of the system: forces times it [W]. Turbulence has it from what the
    /// stream loses in its stress.
    pub fluctuation: f64,
    /// Power lost: forces and torques times the motion of the water relative to the grains [W].
    pub lost: f64,
    /// Power that goes to those who hold or drive grains which forces do not move [W].
    pub held: f64,
    /// Force on the grains [N].
    pub force: DVec3,
}

impl WaterPowers {
    /// All of them as numbers.
    pub(crate) fn numbers(&self) -> [f64; 10] {
        let Self { pressure, carried, stream, spin_work, fluctuation, lost, held, force } = *self;
        [pressure, carried, stream, spin_work, fluctuation, lost, held, force.x, force.y, force.z]
    }

    /// Takes them back.
    pub(crate) fn of_numbers(
        [pressure, carried, stream, spin_work, fluctuation, lost, held, x, y, z]: [f64; 10],
    ) -> Self {
        Self { pressure, carried, stream, spin_work, fluctuation, lost, held, force: DVec3::new(x, y, z) }
    }

    /// Adds other powers.
    pub fn add(&mut self, other: &Self) {
        self.pressure += other.pressure;
        self.carried += other.carried;
        self.stream += other.stream;
        self.spin_work += other.spin_work;
        self.fluctuation += other.fluctuation;
        self.lost += other.lost;
        self.held += other.held;
        self.force += other.force;
    }

    /// Adds what the water does to grains that forces do not move: what it loses by them, and what their holders get.
    pub(crate) fn add_fixed(&mut self, other: &Self) {
        self.carried += other.carried;
        self.spin_work += other.spin_work;
        self.fluctuation += other.fluctuation;
        self.lost += other.lost;
        self.held += other.pressure + other.stream + other.spin_work - other.lost;
    }
}

impl Default for Parcel {
    fn default() -> Self {
        Self {
            len: 0,
            height: ZERO,
            radius: ZERO,
            sphericity: Column([1.0; ROWS + 8]),
            velocity: VECTOR,
            spin: VECTOR,
            fluctuation: VECTOR,
            turbulence: ZERO,
            wet: ZERO,
            volume: ZERO,
            layer: [0; ROWS],
            share: ZERO,
            porosity: ZERO,
            flow: VECTOR,
            slip: VECTOR,
            speed: ZERO,
            flow_spin: VECTOR,
            turn: VECTOR,
            turning: ZERO,
            force: VECTOR,
            total: VECTOR,
            torque: VECTOR,
            total_torque: VECTOR,
        }
    }
}

impl Parcel {
    /// Rows in use. The bound is said again for the compiler: loops up to it index columns without checks.
    #[inline(always)]
    pub fn rows(&self) -> usize {
        self.len.min(ROWS)
    }

    /// A column of layers read at row `i`.
    #[inline(always)]
    pub(super) fn read(&self, column: &[f64], i: usize) -> f64 {
        let (k, share) = (self.layer[i] as usize, self.share[i]);
        let pair = &column[k..k + 2];
        pair[0] * (1.0 - share) + pair[1] * share
    }

    /// Adds the forces along x [N] to what layers give, with the shares that the layers are read with.
    pub(crate) fn react(&self, column: &mut [LayerReaction]) {
        for i in 0..self.rows() {
            let (force, given) = (self.total[0][i], &mut column[self.layer[i] as usize][i % 2]);
            given[0] += force;
            given[1] += force * self.share[i];
        }
    }

    /// Force of all parts on row `i` [N].
    #[inline(always)]
    pub fn total(&self, i: usize) -> DVec3 {
        DVec3::new(self.total[0][i], self.total[1][i], self.total[2][i])
    }

    /// Torque of all parts on row `i` [N.m].
    #[inline(always)]
    pub fn total_torque(&self, i: usize) -> DVec3 {
        DVec3::new(self.total_torque[0][i], self.total_torque[1][i], self.total_torque[2][i])
    }

    /// What is under water; still water and no force yet.
    pub(super) fn begin(&mut self, surface: f64) {
        begin(self, surface);
    }

    /// Adds the fluctuation to a stream along x, with the strengths of the directions over its own. It is not stronger than the
    /// stream itself: among the grains of a bed, where the stream ends, it ends too.
    pub(super) fn fluctuate(&mut self, strength: f64, shares: [f64; 3]) {
        for i in 0..self.rows() {
            let rms = (strength * self.turbulence[i]).min(self.flow[0][i].abs());
            for ((flow, gust), share) in self.flow.iter_mut().zip(&mut self.fluctuation).zip(shares) {
                gust[i] *= share * rms;
                flow[i] += gust[i];
            }
        }
    }

    /// Power of the fluctuation: all forces times it [W].
    pub(crate) fn fluctuation_power(&self) -> f64 {
        let row = |i: usize| (0..3).map(|k| self.total[k][i] * self.fluctuation[k][i]).sum::<f64>();
        (0..self.rows()).map(row).sum()
    }

    /// The motion of the water relative to the grains.
    pub(super) fn slip(&mut self) {
        relative(self.rows(), &self.flow, &self.velocity, &mut self.slip, &mut self.speed);
    }

    /// Water that does not turn, and no torque yet.
    pub(super) fn begin_turning(&mut self) {
        let n = self.rows();
        for column in self.flow_spin.iter_mut().chain(&mut self.total_torque) {
            column[..n].fill(0.0);
        }
    }

    /// The spin of the water relative to the grains.
    pub(super) fn turn(&mut self) {
        relative(self.rows(), &self.flow_spin, &self.spin, &mut self.turn, &mut self.turning);
    }

    /// Adds the force or torque of a part to the total, and its work to the powers.
    pub(super) fn post(&mut self, kind: WorkKind, powers: &mut WaterPowers) {
        let n = self.rows();
        let [x, y, z, with_grain, with_flow] = match kind {
            WorkKind::Pressure | WorkKind::Relative => {
                post(n, &self.force, &mut self.total, [&self.velocity, &self.flow])
            }
            WorkKind::Turning => post(n, &self.torque, &mut self.total_torque, [&self.spin, &self.flow_spin]),
        };
        match kind {
            WorkKind::Pressure => {
                powers.pressure += with_grain;
                powers.carried += with_flow;
            }
            WorkKind::Relative | WorkKind::Turning => {
                let stream = if kind == WorkKind::Turning { &mut powers.spin_work } else { &mut powers.stream };
                *stream += with_flow;
                powers.lost += with_flow - with_grain;
            }
        }
        if kind != WorkKind::Turning {
            powers.force += DVec3::new(x, y, z);
        }
    }
}

#[multiversion(targets = "simd")]
fn begin(p: &mut Parcel, surface: f64) {
    let n = p.rows();
    for i in 0..n {
        let r = p.radius[i];
        p.wet[i] = sphere::below((surface - p.height[i]) / r);
        p.volume[i] = p.wet[i] * sphere::volume(r);
    }
    p.porosity[..n].fill(1.0);
    for k in 0..3 {
        p.flow[k][..n].fill(0.0);
        p.total[k][..n].fill(0.0);
    }
}

/// The motion of the water relative to the grains, and its size.
#[multiversion(targets = "simd")]
fn relative(n: usize, water: &[Column; 3], grain: &[Column; 3], relative: &mut [Column; 3], size: &mut Column) {
    for i in 0..n.min(ROWS) {
        let [x, y, z] = [0, 1, 2].map(|k| water[k][i] - grain[k][i]);
        relative[0][i] = x;
        relative[1][i] = y;
        relative[2][i] = z;
        size[i] = (x * x + y * y + z * z).sqrt();
    }
}

/// Sums of the force (or torque), of its power with the grains' motion, and with that of the water.
#[multiversion(targets = "simd")]
fn post(n: usize, force: &[Column; 3], total: &mut [Column; 3], [grain, water]: [&[Column; 3]; 2]) -> [f64; 5] {
    let n = n.min(ROWS);
    let mut sums = [0.0; 5];
    for k in 0..3 {
        let (force, total) = (&force[k], &mut total[k]);
        for i in 0..n {
            total[i] += force[i];
        }
        sums[k] = sum(n, |i| force[i]);
        sums[3] += sum(n, |i| force[i] * grain[k][i]);
        sums[4] += sum(n, |i| force[i] * water[k][i]);
    }
    sums
}

/// Sum over rows in eight parts, so that additions need not wait for one another. Three sums in one loop would be shuffled
/// among one another instead of standing in a vector each.
#[inline(always)]
fn sum(n: usize, term: impl Fn(usize) -> f64) -> f64 {
    let mut parts = [0.0; 8];
    let mut i = 0;
    while i + 8 <= n {
        for (j, part) in parts.iter_mut().enumerate() {
            *part += term(i + j);
        }
        i += 8;
    }
    while i < n {
        parts[0] += term(i);
        i += 1;
    }
    parts.iter().sum()
}
