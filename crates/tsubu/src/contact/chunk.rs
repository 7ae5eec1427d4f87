//! A chunk: up to 256 touching pairs as plain columns, small enough to stay in the cache.

use glam::DVec3;

/// Rows of a chunk.
pub const ROWS: usize = 256;

/// Width of the history of a contact: tangential spring force (3) and its stiffness at the last step.
pub const HISTORY: usize = 4;

/// One column. The 8 entries beyond the rows keep columns from starting a multiple of 2 KiB apart: forty of them would
/// share two sets of the first-level cache and throw each other out (measured: 5 % of a damper run).
pub type Column = [f64; ROWS + 8];

/// Touching pairs. The contact table fills the coefficients, the engine the geometry, the parts the results.
#[derive(Clone, Debug)]
pub struct Chunk {
    /// Rows in use.
    pub len: usize,
    /// Overlap d [m], positive.
    pub overlap: Column,
    /// sqrt(d) [m^(1/2)].
    pub root: Column,
    /// Overlap rate d' [m/s], positive when approaching.
    pub closing: Column,
    /// Unit normal from the first to the second body.
    pub normal: [Column; 3],
    /// Velocity of the first body's surface relative to the second's, in the tangent plane [m/s].
    pub slip: [Column; 3],
    /// Relative spin without its part along the normal [rad/s].
    pub roll: [Column; 3],
    /// Elastic coefficient: k of Hertz [N/m^1.5] or Hooke [N/m].
    pub stiffness: Column,
    /// Damping coefficient of the damping part.
    pub damping: Column,
    /// Tangential coefficient 8 G* sqrt(R*) [N/m^1.5].
    pub shear: Column,
    /// Tangential over normal dashpot [-].
    pub shear_damping: Column,
    /// Friction coefficient [-].
    pub friction: Column,
    /// Rolling friction coefficient times reduced radius [m].
    pub rolling: Column,
    /// Reduced radius [m].
    pub radius: Column,
    /// Reduced mass [kg].
    pub mass: Column,
    /// Contact history, read and written by the parts that need one.
    pub history: [Column; HISTORY],
    /// Result: normal force [N], positive pushes the bodies apart.
    pub normal_force: Column,
    /// Result: the part of the normal force that damps [N].
    pub damping_force: Column,
    /// Result: local viscous coefficient of the normal damping [N.s/m], for tangential dashpots.
    pub dashpot: Column,
    /// Result: tangential force on the first body [N].
    pub tangential_force: [Column; 3],
    /// Result: rolling torque on the first body [N.m]; the second gets the opposite.
    pub torque: [Column; 3],
    /// Result: energy stored [J].
    pub stored: Column,
    /// Result: power lost in normal damping [W].
    pub lost_normal: Column,
    /// Result: power lost in sliding [W].
    pub lost_sliding: Column,
    /// Result: power lost in rolling [W].
    pub lost_rolling: Column,
}

impl Default for Chunk {
    fn default() -> Self {
        const ZERO: Column = [0.0; ROWS + 8];
        const VECTOR: [Column; 3] = [ZERO; 3];
        Self {
            len: 0,
            overlap: ZERO,
            root: ZERO,
            closing: ZERO,
            normal: VECTOR,
            slip: VECTOR,
            roll: VECTOR,
            stiffness: ZERO,
            damping: ZERO,
            shear: ZERO,
            shear_damping: ZERO,
            friction: ZERO,
            rolling: ZERO,
            radius: ZERO,
            mass: ZERO,
            history: [ZERO; HISTORY],
            normal_force: ZERO,
            damping_force: ZERO,
            dashpot: ZERO,
            tangential_force: VECTOR,
            torque: VECTOR,
            stored: ZERO,
            lost_normal: ZERO,
            lost_sliding: ZERO,
            lost_rolling: ZERO,
        }
    }
}

impl Chunk {
    /// Sets the results of all rows to zero.
    pub fn clear_results(&mut self) {
        let n = self.len;
        for column in [&mut self.normal_force, &mut self.damping_force, &mut self.dashpot, &mut self.stored]
            .into_iter()
            .chain([&mut self.lost_normal, &mut self.lost_sliding, &mut self.lost_rolling])
            .chain(&mut self.tangential_force)
            .chain(&mut self.torque)
        {
            column[..n].fill(0.0);
        }
    }

    /// Row `i` of a vector column.
    #[inline]
    pub fn vector(column: &[Column; 3], i: usize) -> DVec3 {
        DVec3::new(column[0][i], column[1][i], column[2][i])
    }

    /// Sets row `i` of a vector column.
    #[inline]
    pub fn set(column: &mut [Column; 3], i: usize, v: DVec3) {
        column[0][i] = v.x;
        column[1][i] = v.y;
        column[2][i] = v.z;
    }
}
