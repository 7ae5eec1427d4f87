//! A batch of contacts: from touching pairs to rows of a chunk, and from the results of the law to forces and torques.

use super::narrow_phase::{Spheres, TouchingPair};
use crate::contact::Table;
use crate::contact::chunk::{Chunk, Column, ROWS, ZERO};
use crate::neighbours::block::BlockList;
use crate::state::Grains;
use glam::DVec3;
use multiversion::multiversion;

/// One chunk at work: what the law sees, and what it need not see (bodies, branch vectors, lever arms, forces and torques).
#[derive(Clone, Debug)]
pub(super) struct ContactBatch {
    pub chunk: Chunk,
    /// Local index of the first body.
    pub first: [u32; ROWS],
    /// Local index of the second body, or number of the wall.
    pub second: [u32; ROWS],
    /// Branch vector: centre of the second body from that of the first [m]; the geometry pass reads it.
    pub branch: [Column; 3],
    /// Radii [m].
    pub radius: [Column; 2],
    /// Sum of inverse masses [1/kg].
    pub inverse_mass: Column,
    /// Relative velocity of the centres [m/s].
    pub relative_velocity: [Column; 3],
    /// Spins [rad/s].
    pub spin: [[Column; 3]; 2],
    /// Whether some rows are of bodies that are no spheres.
    pub shifted: bool,
    /// Where the spheres that stand for both bodies have their centres, from those of the bodies [m]; looked at where rows are shifted.
    shifts: [[Column; 3]; 2],
    /// Lever arms [m].
    pub lever_arm: [Column; 2],
    /// Result: force on the first body [N].
    pub force: [Column; 3],
    /// Result: the part of it that takes energy away [N].
    pub dissipative: [Column; 3],
    /// Result: torque on both bodies [N.m].
    pub torque: [[Column; 3]; 2],
    /// Which pair of materials all rows of the chunk are filled with.
    filled_with: Option<u32>,
    /// Pair of materials of each row.
    pub material_pair: [u32; ROWS],
}

impl ContactBatch {
    pub fn new(history: usize) -> Self {
        const V: [Column; 3] = [ZERO; 3];
        Self {
            chunk: Chunk::new(history),
            first: [0; ROWS],
            second: [0; ROWS],
            branch: V,
            radius: [ZERO; 2],
            inverse_mass: ZERO,
            relative_velocity: V,
            spin: [V; 2],
            shifted: false,
            shifts: [V; 2],
            lever_arm: [ZERO; 2],
            force: V,
            dissipative: V,
            torque: [V; 2],
            filled_with: None,
            material_pair: [0; ROWS],
        }
    }

    /// Takes pairs of touching grains: what the geometry pass reads.
    pub fn gather(
        &mut self,
        touching: &[TouchingPair],
        grains: &Grains,
        list: &BlockList,
        spheres: &Spheres,
        table: &Table,
        rotation: bool,
    ) {
        gather(self, touching, grains, list, spheres, table, rotation);
    }

    /// Fills the constants of the materials; nothing to do where all rows are of the pair that is already there.
    pub fn constants(&mut self, table: &Table) {
        let n = self.chunk.rows();
        let Some(&first) = self.material_pair[..n].first() else { return };
        // To look at all of them is faster than to stop at the first that differs.
        if self.material_pair[..n].iter().fold(0, |others, &m| others | (m ^ first)) == 0 {
            if self.filled_with != Some(first) {
                self.chunk.set_constants(0..ROWS, table.constants(first));
                self.filled_with = Some(first);
            }
            return;
        }
        self.filled_with = None;
        for i in 0..n {
            self.chunk.set_constants(i..i + 1, table.constants(self.material_pair[i]));
        }
    }

    /// Geometry of two spheres, from `branch`, `radius`, `relative_velocity` and `spin` into the columns of the chunk.
    pub fn sphere_geometry(&mut self, rotation: bool, lever_share: f64) {
        sphere_geometry(self, lever_share);
        self.relative_motion(rotation);
    }

    /// Relative motion at the point of contact, from normals, lever arms, `relative_velocity` and `spin`.
    pub fn relative_motion(&mut self, rotation: bool) {
        if rotation {
            surface_velocity(self);
        }
        split_velocity(self);
    }

    /// Relative spin, split into rolling and twisting.
    pub fn relative_spin(&mut self) {
        split_spin(self);
    }

    /// Force on the first body and torques on both, of every row.
    pub fn forces_and_torques(&mut self, rotation: bool) {
        forces(self);
        if rotation {
            torques(self);
        }
    }

    /// Point of contact of row `i`, from the centre of the first body [m].
    pub fn contact_point(&self, i: usize) -> DVec3 {
        let point = Chunk::vector(&self.chunk.normal, i) * self.lever_arm[0][i];
        if self.shifted { point + self.shift(0, i) } else { point }
    }

    /// From the centre of the first body of row `i` to that of the second [m].
    pub fn between_centres(&self, i: usize) -> DVec3 {
        let branch = Chunk::vector(&self.branch, i);
        if self.shifted { branch + self.shift(0, i) - self.shift(1, i) } else { branch }
    }

    /// From the centre of a body of row `i` to that of the sphere that stands for it [m].
    #[inline]
    pub fn shift(&self, body: usize, i: usize) -> DVec3 {
        if self.shifted { Chunk::vector(&self.shifts[body], i) } else { DVec3::ZERO }
    }

    /// Puts the centre of the sphere that stands for a body of row `i` beside that of the body.
    pub fn set_shift(&mut self, body: usize, i: usize, shift: DVec3) {
        Chunk::set(&mut self.shifts[body], i, shift);
    }
}

#[multiversion(targets = "simd")]
fn gather(
    batch: &mut ContactBatch,
    touching: &[TouchingPair],
    grains: &Grains,
    list: &BlockList,
    spheres: &Spheres,
    table: &Table,
    rotation: bool,
) {
    batch.chunk.len = touching.len().min(ROWS);
    for (r, pair) in touching.iter().enumerate().take(ROWS) {
        let second = list.pairs[pair.pair as usize].second;
        batch.first[r] = pair.first;
        batch.second[r] = second;
        let (a, b) = (spheres.at(pair.first), spheres.at(second));
        for k in 0..3 {
            batch.branch[k][r] = b[k] - a[k];
        }
        batch.radius[0][r] = a[3];
        batch.radius[1][r] = b[3];
        let (i, j) = (list.first + pair.first as usize, list.grain_at[second as usize] as usize);
        let relative = grains.velocity[i] - grains.velocity[j];
        Chunk::set(&mut batch.relative_velocity, r, relative);
        batch.inverse_mass[r] = grains.inverse_mass[i] + grains.inverse_mass[j];
        batch.material_pair[r] = table.index(grains.material[i], grains.material[j]);
        if rotation {
            Chunk::set(&mut batch.spin[0], r, grains.spin[i]);
            Chunk::set(&mut batch.spin[1], r, grains.spin[j]);
        }
    }
}

#[multiversion(targets = "simd")]
fn sphere_geometry(batch: &mut ContactBatch, lever_share: f64) {
    let n = batch.chunk.rows();
    let c = &mut batch.chunk;
    let [bx, by, bz] = &batch.branch;
    let [r1, r2] = &batch.radius;
    let [nx, ny, nz] = &mut c.normal;
    for i in 0..n {
        let squared = bx[i] * bx[i] + by[i] * by[i] + bz[i] * bz[i];
        let distance = squared.sqrt();
        // Two centres in one place have no normal; the overlap limit stops the run.
        let inverse = 1.0 / (distance + f64::MIN_POSITIVE);
        nx[i] = bx[i] * inverse;
        ny[i] = by[i] * inverse;
        nz[i] = bz[i] * inverse;
        let sum = r1[i] + r2[i];
        let overlap = sum - distance;
        c.overlap[i] = overlap;
        c.effective_radius[i] = r1[i] * r2[i] / sum;
        c.effective_mass[i] = 1.0 / batch.inverse_mass[i];
        batch.lever_arm[0][i] = r1[i] - lever_share * overlap;
        batch.lever_arm[1][i] = r2[i] - lever_share * overlap;
    }
}

/// Adds what spin gives to the relative velocity at the point of contact: (w1 a1 + w2 a2) x n.
#[multiversion(targets = "simd")]
fn surface_velocity(batch: &mut ContactBatch) {
    let n = batch.chunk.rows();
    let [nx, ny, nz] = &batch.chunk.normal;
    let [[px, py, pz], [qx, qy, qz]] = &batch.spin;
    let [vx, vy, vz] = &mut batch.relative_velocity;
    let [a, b] = &batch.lever_arm;
    for i in 0..n {
        let wx = px[i] * a[i] + qx[i] * b[i];
        let wy = py[i] * a[i] + qy[i] * b[i];
        let wz = pz[i] * a[i] + qz[i] * b[i];
        vx[i] += wy * nz[i] - wz * ny[i];
        vy[i] += wz * nx[i] - wx * nz[i];
        vz[i] += wx * ny[i] - wy * nx[i];
    }
}

#[multiversion(targets = "simd")]
fn split_velocity(batch: &mut ContactBatch) {
    let n = batch.chunk.rows();
    let c = &mut batch.chunk;
    let [nx, ny, nz] = &c.normal;
    let [vx, vy, vz] = &batch.relative_velocity;
    let [sx, sy, sz] = &mut c.slip;
    for i in 0..n {
        let closing = vx[i] * nx[i] + vy[i] * ny[i] + vz[i] * nz[i];
        c.closing[i] = closing;
        sx[i] = vx[i] - closing * nx[i];
        sy[i] = vy[i] - closing * ny[i];
        sz[i] = vz[i] - closing * nz[i];
    }
}

#[multiversion(targets = "simd")]
fn split_spin(batch: &mut ContactBatch) {
    let n = batch.chunk.rows();
    let c = &mut batch.chunk;
    let [[px, py, pz], [qx, qy, qz]] = &batch.spin;
    let [nx, ny, nz] = &c.normal;
    let [rx, ry, rz] = &mut c.roll;
    for i in 0..n {
        let (x, y, z) = (px[i] - qx[i], py[i] - qy[i], pz[i] - qz[i]);
        let twist = x * nx[i] + y * ny[i] + z * nz[i];
        c.twist[i] = twist;
        rx[i] = x - twist * nx[i];
        ry[i] = y - twist * ny[i];
        rz[i] = z - twist * nz[i];
    }
}

#[multiversion(targets = "simd")]
fn forces(batch: &mut ContactBatch) {
    let c = &batch.chunk;
    let n = c.rows();
    for k in 0..3 {
        let (normal, tangential) = (&c.normal[k], &c.tangential_force[k]);
        let (force, dissipative) = (&mut batch.force[k], &mut batch.dissipative[k]);
        for i in 0..n {
            force[i] = tangential[i] - normal[i] * c.normal_force[i];
            dissipative[i] = tangential[i] - normal[i] * c.damping_force[i];
        }
    }
}

/// n x f_t at each arm, and the torques that the law has given.
#[multiversion(targets = "simd")]
fn torques(batch: &mut ContactBatch) {
    let c = &batch.chunk;
    let n = c.rows();
    let [a, b] = &batch.lever_arm;
    for k in 0..3 {
        let (u, v) = ((k + 1) % 3, (k + 2) % 3);
        let (nu, nv) = (&c.normal[u], &c.normal[v]);
        let (tu, tv) = (&c.tangential_force[u], &c.tangential_force[v]);
        let torque = &c.torque[k];
        let [first, second] = &mut batch.torque;
        let (first, second) = (&mut first[k], &mut second[k]);
        for i in 0..n {
            let moment = nu[i] * tv[i] - nv[i] * tu[i];
            first[i] = moment * a[i] + torque[i];
            second[i] = moment * b[i] - torque[i];
        }
    }
}

/// Sums of the stored energy and of the three losses over all rows, and the deepest overlap.
///
/// Eight partial sums each, so that additions need not wait for one another.
#[multiversion(targets = "simd")]
pub(super) fn sums(c: &Chunk) -> ([f64; 4], f64) {
    let n = c.rows();
    let mut deepest = [0.0f64; 8];
    let (lumps, rest) = c.overlap[..n].as_chunks::<8>();
    for lump in lumps {
        for (part, value) in deepest.iter_mut().zip(lump) {
            *part = if *value > *part { *value } else { *part };
        }
    }
    let sums = [&c.stored, &c.lost_normal, &c.lost_sliding, &c.lost_rolling].map(|column| {
        let mut parts = [0.0; 8];
        let (lumps, rest) = column[..n].as_chunks::<8>();
        for lump in lumps {
            for (part, value) in parts.iter_mut().zip(lump) {
                *part += value;
            }
        }
        parts.iter().sum::<f64>() + rest.iter().sum::<f64>()
    });
    (sums, deepest.iter().chain(rest).copied().fold(0.0, f64::max))
}
