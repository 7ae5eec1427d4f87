//! Grains as columns.

use super::columns::columns;
use crate::ledger::Energies;
use glam::DVec3;

columns! {
    /// Grains, one row each, kept in the order of space. In the plane the y parts of vectors, and the x and z parts of
    /// spins, are exact zeros.
    Grains of Grain {
        /// Centre [m].
        position: DVec3,
        /// Velocity of the centre [m/s].
        velocity: DVec3,
        /// Acceleration of the centre at the last time level [m/s^2].
        acceleration: DVec3,
        /// Spin [rad/s].
        spin: DVec3,
        /// Rate of spin at the last time level [rad/s^2].
        angular_acceleration: DVec3,
        /// What periodic boundaries have taken from the position so far [m].
        unwrap_offset: DVec3,
        /// Radius [m].
        radius: f64,
        /// Mass [kg].
        mass: f64,
        /// One over the mass that others feel [1/kg]; 0 for grains that forces do not move.
        inverse_mass: f64,
        /// Moment of inertia [kg.m^2]; 0 for a piece of a body, which moves and turns with it.
        inertia: f64,
        /// Number of the material in the contact table.
        material: u32,
        /// Number of the group in the scene.
        group: u32,
        /// Number of the grain, kept through sorting.
        id: u32,
    }
}

/// Columns of motion that ranks may know of their own grains alone.
macro_rules! apart {
    ($($column:ident),+) => {
        impl Grains {
            /// Their names.
            pub const APART: &[&str] = &[$(stringify!($column)),+];

            /// They themselves.
            pub fn apart(&mut self) -> [&mut Vec<DVec3>; Self::APART.len()] {
                [$(&mut self.$column),+]
            }
        }
    };
}
apart!(velocity, acceleration, spin, angular_acceleration);

impl Grains {
    /// Number of grains.
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// Whether a grain moves and turns by itself; what is held or driven does, too.
    fn single(&self, i: usize) -> bool {
        self.inertia[i] != 0.0
    }

    /// Kinetic, rotational and potential energy under `gravity` [m/s^2] of the grains that forces move, but for pieces of bodies.
    pub fn energies(&self, gravity: DVec3) -> Energies {
        let mut energies = Energies::default();
        for i in 0..self.len() {
            if self.inverse_mass[i] == 0.0 || !self.single(i) {
                continue;
            }
            let squared = self.velocity[i].length_squared();
            energies.kinetic += 0.5 * self.mass[i] * squared;
            energies.added_mass += 0.5 * self.added_mass(i) * squared;
            energies.rotational += 0.5 * self.inertia[i] * self.spin[i].length_squared();
            energies.potential -= self.mass[i] * gravity.dot(self.position[i] + self.unwrap_offset[i]);
        }
        energies
    }

    /// Mass of the water that moves along with a grain that forces move [kg]; without water an exact zero.
    pub fn added_mass(&self, i: usize) -> f64 {
        moved_along(self.mass[i], self.inverse_mass[i])
    }

    /// Total momentum [N.s] of the grains that forces move, and of the water that moves along with them, but for pieces of bodies.
    pub fn momentum(&self) -> DVec3 {
        let moved = (0..self.len()).filter(|&i| self.inverse_mass[i] != 0.0 && self.single(i));
        moved.map(|i| (self.mass[i] + self.added_mass(i)) * self.velocity[i]).sum()
    }

    /// Sum of mass times unwrapped centre [kg.m] of the grains that forces move, but for pieces of bodies.
    pub fn moment_of_mass(&self) -> DVec3 {
        let moved = (0..self.len()).filter(|&i| self.inverse_mass[i] != 0.0 && self.single(i));
        moved.map(|i| self.mass[i] * (self.position[i] + self.unwrap_offset[i])).sum()
    }

    /// Total mass of the grains that forces move [kg].
    pub fn moved_mass(&self) -> f64 {
        (0..self.len()).filter(|&i| self.inverse_mass[i] != 0.0).map(|i| self.mass[i]).sum()
    }

    /// Place of every grain by id.
    pub fn by_id(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.len()).collect();
        order.sort_unstable_by_key(|&i| self.id[i]);
        order
    }
}

/// Mass of the water that moves along with a mass [kg], of one over both [1/kg]; without water an exact zero.
pub fn moved_along(mass: f64, inverse_mass: f64) -> f64 {
    // The mass is one over its inverse only up to rounding.
    let added = 1.0 / inverse_mass - mass;
    if added > 1e-12 * mass { added } else { 0.0 }
}
