//! Grains as columns.

use super::columns::columns;
use crate::ledger::Stocks;
use glam::DVec3;

columns! {
    /// Spheres, one row each. In the plane the y parts of vectors, and the x and z parts of spins, are exact zeros.
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
        spin_rate: DVec3,
        /// Radius [m].
        radius: f64,
        /// Mass [kg].
        mass: f64,
        /// Moment of inertia [kg.m^2].
        inertia: f64,
        /// Index into the contact table: grains of one kind share material, radius and mass.
        species: u32,
        /// Number of the grain, kept through sorting.
        id: u32,
    }
}

impl Grains {
    /// Number of grains.
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// Kinetic, rotational and potential energy under `gravity` [m/s^2].
    pub fn stocks(&self, gravity: DVec3) -> Stocks {
        let mut stocks = Stocks::default();
        for i in 0..self.len() {
            stocks.kinetic += 0.5 * self.mass[i] * self.velocity[i].length_squared();
            stocks.rotational += 0.5 * self.inertia[i] * self.spin[i].length_squared();
            stocks.potential -= self.mass[i] * gravity.dot(self.position[i]);
        }
        stocks
    }

    /// Total momentum [N.s].
    pub fn momentum(&self) -> DVec3 {
        (0..self.len()).map(|i| self.mass[i] * self.velocity[i]).sum()
    }

    /// Place of every grain by id.
    pub fn by_id(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.len()).collect();
        order.sort_unstable_by_key(|&i| self.id[i]);
        order
    }
}
