//! A chunk: up to 128 touching pairs as plain columns, small enough to stay in the cache.

use super::pair::Constants;
use glam::DVec3;

/// Rows of a chunk.
pub const ROWS: usize = 128;

/// One column. It begins on a line of the cache, which the widest vectors fill: across two lines Hertz with Mindlin takes 15 %
/// longer. The 8 entries beyond the rows keep columns from starting a multiple of 1 KiB apart, where they would share few sets
/// of the first-level cache and throw each other out (measured: 5 % of a damper run).
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Column(pub [f64; ROWS + 8]);

impl std::ops::Deref for Column {
    type Target = [f64; ROWS + 8];

    #[inline(always)]
    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl std::ops::DerefMut for Column {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.0
    }
}

/// An empty column.
pub const ZERO: Column = Column([0.0; ROWS + 8]);

const VECTOR: [Column; 3] = [ZERO; 3];

/// Touching pairs. The engine fills geometry and constants, the parts the results.
#[derive(Clone, Debug)]
pub struct Chunk {
    /// Rows in use; read it with [`Chunk::rows`].
    pub len: usize,

    /// Overlap d [m]; negative only under laws that reach beyond it.
    pub overlap: Column,
    /// Overlap rate d' [m/s], positive when approaching.
    pub closing: Column,
    /// Unit normal from the first to the second body.
    pub normal: [Column; 3],
    /// Velocity of the first body's surface relative to the second's, in the tangent plane [m/s].
    pub slip: [Column; 3],
    /// Relative spin without its part along the normal [rad/s].
    pub roll: [Column; 3],
    /// Relative spin along the normal [rad/s].
    pub twist: Column,
    /// How long the velocities above go with the forces of the last step until those of this one take their place [s]: half a
    /// step of velocity Verlet, 0 where velocities are complete.
    pub completion: f64,
    /// Whether the bodies turn.
    pub rotation: bool,
    /// Whether this is a moment and no step: springs are looked at and not stretched.
    pub moment: bool,
    /// Effective radius R* = 1/(1/R1 + 1/R2) [m].
    pub effective_radius: Column,
    /// Effective mass m* = 1/(1/m1 + 1/m2) [kg].
    pub effective_mass: Column,

    /// Constant: effective modulus E* [Pa].
    pub effective_modulus: Column,
    /// Constant: effective shear modulus G* [Pa].
    pub shear_modulus: Column,
    /// Constant: number of the damping part.
    pub damping: Column,
    /// Constant: tangential over normal dashpot [-].
    pub shear_damping: Column,
    /// Constant: friction coefficient [-].
    pub friction: Column,
    /// Constant: rolling friction coefficient [-].
    pub rolling: Column,
    /// Constant: twisting friction coefficient [-].
    pub twisting: Column,
    /// Constant: surface energy of one face [J/m^2].
    pub surface_energy: Column,
    /// Constant: cohesion, in the unit of its part.
    pub cohesion: Column,

    /// Contact history, one column a slot; parts know where theirs begins.
    pub history: Vec<Column>,

    /// Between parts: radius of the contact area [m]; zero where the bodies do not hold each other.
    pub contact_radius: Column,
    /// Between parts: elastic stiffness f/d [N/m], the secant of the elastic force.
    pub secant_stiffness: Column,
    /// Between parts: tangential stiffness at this overlap [N/m].
    pub tangential_stiffness: Column,
    /// Between parts: coefficient of the normal damping at this overlap [N.s/m], for tangential dashpots.
    pub damping_coefficient: Column,
    /// Between parts: what attraction adds to the normal force before friction multiplies it [N], added to.
    pub pull_off: Column,
    /// Between parts: what friction multiplies [N]: normal force and pull-off, never below zero.
    pub load: Column,

    /// Result: normal force [N], positive pushes the bodies apart. Set by the normal part, changed by cohesion and damping.
    pub normal_force: Column,
    /// Result: the part of the normal force that damps [N].
    pub damping_force: Column,
    /// Result: tangential force on the first body [N].
    pub tangential_force: [Column; 3],
    /// Result: rolling and twisting torque on the first body [N.m], added to; the second gets the opposite.
    pub torque: [Column; 3],
    /// Result: energy stored [J]. Set by the normal part, added to by the others.
    pub stored: Column,
    /// Result: power lost in normal damping, in yielding, and in contacts that snap together or part [W], added to.
    pub lost_normal: Column,
    /// Result: power lost in sliding [W].
    pub lost_sliding: Column,
    /// Result: power lost in rolling and twisting [W], added to.
    pub lost_rolling: Column,
}

impl Chunk {
    /// An empty chunk for a law with `history` columns of history.
    pub fn new(history: usize) -> Self {
        Self {
            len: 0,
            overlap: ZERO,
            closing: ZERO,
            normal: VECTOR,
            slip: VECTOR,
            roll: VECTOR,
            twist: ZERO,
            completion: 0.0,
            rotation: true,
            moment: false,
            effective_radius: ZERO,
            effective_mass: ZERO,
            effective_modulus: ZERO,
            shear_modulus: ZERO,
            damping: ZERO,
            shear_damping: ZERO,
            friction: ZERO,
            rolling: ZERO,
            twisting: ZERO,
            surface_energy: ZERO,
            cohesion: ZERO,
            history: vec![ZERO; history],
            contact_radius: ZERO,
            secant_stiffness: ZERO,
            tangential_stiffness: ZERO,
            damping_coefficient: ZERO,
            pull_off: ZERO,
            load: ZERO,
            normal_force: ZERO,
            damping_force: ZERO,
            tangential_force: VECTOR,
            torque: VECTOR,
            stored: ZERO,
            lost_normal: ZERO,
            lost_sliding: ZERO,
            lost_rolling: ZERO,
        }
    }

    /// Rows in use. The bound is said again for the compiler: loops up to it index columns without checks.
    #[inline(always)]
    pub fn rows(&self) -> usize {
        self.len.min(ROWS)
    }

    /// How much time passes for springs in a step `dt` [s]. Asked for once before a loop: in it the loop would not go by vectors.
    #[inline(always)]
    pub fn passing(&self, dt: f64) -> f64 {
        if self.moment { 0.0 } else { dt }
    }

    /// Sets to zero what several parts add to. Everything else is set, not added to, by the one part that acts on it; columns
    /// that no part of a law sets stay zero. (Clearing them all took 0.5 ns a row, as long as Hertz.)
    pub fn clear_results(&mut self) {
        let n = self.rows();
        let columns = [&mut self.pull_off, &mut self.lost_normal, &mut self.lost_rolling];
        for column in columns.into_iter().chain(&mut self.torque) {
            column[..n].fill(0.0);
        }
    }

    /// Writes the constants of a pair of materials into the rows `range`.
    pub fn set_constants(&mut self, range: std::ops::Range<usize>, c: &Constants) {
        for (column, value) in [
            (&mut self.effective_modulus, c.effective_modulus),
            (&mut self.shear_modulus, c.shear_modulus),
            (&mut self.damping, c.damping),
            (&mut self.shear_damping, c.shear_damping),
            (&mut self.friction, c.friction),
            (&mut self.rolling, c.rolling),
            (&mut self.twisting, c.twisting),
            (&mut self.surface_energy, c.surface_energy),
            (&mut self.cohesion, c.cohesion),
        ] {
            column[range.clone()].fill(value);
        }
    }

    /// Calls `act` with the N columns of history from `at` on, beside the chunk: two arguments that the compiler knows to be
    /// apart, so that the loop of a part needs no proof of it.
    pub fn with_history<const N: usize>(&mut self, at: usize, act: impl FnOnce(&mut Self, &mut [Column; N])) {
        let mut history = std::mem::take(&mut self.history);
        if let Some(columns) = history[at..].first_chunk_mut() {
            act(self, columns);
        }
        self.history = history;
    }

    /// Row `i` of a vector column.
    #[inline(always)]
    pub fn vector(column: &[Column; 3], i: usize) -> DVec3 {
        DVec3::new(column[0][i], column[1][i], column[2][i])
    }

    /// Sets row `i` of a vector column.
    #[inline(always)]
    pub fn set(column: &mut [Column; 3], i: usize, v: DVec3) {
        column[0][i] = v.x;
        column[1][i] = v.y;
        column[2][i] = v.z;
    }
}
