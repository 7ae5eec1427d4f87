//! What a step posts to the ledger, and the reactions of the grains on those who hold and move them.

use super::contact_forces::{ContactForces, ContactLosses};
use super::engine::DemEngine;
use super::immersion::Immersion;
use crate::ledger::{Account, Ledger};
use crate::sections::Named;
use crate::view::WallLoad;
use crate::water::WaterPowers;
use glam::DVec3;
use std::slice::from_mut;

/// Powers and forces at a time level.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Powers {
    /// Lost in contacts [W].
    pub lost: ContactLosses,
    /// Lost in the damping of bonds [W].
    pub bonds: f64,
    /// Work of walls and of driven grains [W].
    pub walls: f64,
    /// Work of whoever acts on grains and moves walls from outside [W].
    pub outside: f64,
    /// Force of those who act on grains from outside [N].
    pub outside_force: DVec3,
    /// Force of walls and of fixed grains on the others [N].
    pub wall_force: DVec3,
    pub water: WaterPowers,
}

impl Powers {
    /// Everything, each under its name, for a checkpoint.
    pub fn named(&mut self) -> Named<'_> {
        let Self { lost, bonds, walls, outside, outside_force, wall_force, water } = self;
        let WaterPowers { pressure, carried, stream, spin_work, fluctuation, lost: drag, held, force } = water;
        vec![
            ("normal damping", from_mut(&mut lost.normal)),
            ("sliding", from_mut(&mut lost.sliding)),
            ("rolling", from_mut(&mut lost.rolling)),
            ("bond damping", from_mut(bonds)),
            ("walls", from_mut(walls)),
            ("wall force", wall_force.as_mut()),
            ("water pressure", from_mut(pressure)),
            ("water pressure on stream", from_mut(carried)),
            ("water stream", from_mut(stream)),
            ("water spin", from_mut(spin_work)),
            ("water fluctuation", from_mut(fluctuation)),
            ("water drag", from_mut(drag)),
            ("water on held grains", from_mut(held)),
            ("water force", force.as_mut()),
            ("outside", from_mut(outside)),
            ("outside force", outside_force.as_mut()),
        ]
    }
}

/// What the ledger needs from step to step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Books {
    /// Of the last time level.
    pub last: Powers,
    /// Mass of the grains that forces move [kg].
    pub moved_mass: f64,
}

/// What the grains did to those who hold and move them in the last step.
#[derive(Debug, Default)]
pub(super) struct Reactions {
    /// Of each wall.
    pub wall_loads: Vec<WallLoad>,
    /// Contact force on grains that forces do not move [N].
    pub on_fixed: DVec3,
    /// Power that driven grains give [W].
    pub driven_power: f64,
}

impl Reactions {
    /// Sums the loads of all blocks on every wall.
    pub fn sum_wall_loads(&mut self, contacts: &ContactForces) {
        for (k, load) in self.wall_loads.iter_mut().enumerate() {
            *load = contacts.wall_load(k);
        }
    }
}

impl DemEngine {
    /// Powers of this time level.
    pub(super) fn powers(&self) -> Powers {
        let water = self.immersion.as_ref().map_or_else(WaterPowers::default, |immersion| immersion.powers);
        let mut powers =
            Powers { lost: self.contacts.sums.lost, bonds: self.contacts.bonds.lost, water, ..Powers::default() };
        for (wall, load) in self.walls.iter().zip(&self.reactions.wall_loads) {
            powers.wall_force -= load.force;
            let power = wall.prescribed_power(load.force, load.torque);
            *(if wall.steered() { &mut powers.outside } else { &mut powers.walls }) -= power;
        }
        powers.outside += self.contacts.outside.power;
        powers.outside_force = self.contacts.outside.force;
        powers.wall_force -= self.reactions.on_fixed;
        powers.walls += self.reactions.driven_power;
        powers
    }

    /// Posts the work and the losses of the step by the trapezoidal rule.
    pub(super) fn post_powers(&mut self, ledger: &mut Ledger) {
        let (now, last) = (self.powers(), self.books.last);
        let half = 0.5 * self.clock.dt;
        let mut post = |account, power: fn(&Powers) -> f64| ledger.post(account, half * (power(&last) + power(&now)));
        post(Account::NormalDamping, |p| p.lost.normal);
        post(Account::Sliding, |p| p.lost.sliding);
        post(Account::Rolling, |p| p.lost.rolling);
        post(Account::BondDamping, |p| p.bonds);
        post(Account::WallWork, |p| p.walls);
        post(Account::Outside, |p| p.outside);
        post(Account::Buoyancy, |p| p.water.pressure);
        post(Account::StreamWork, |p| p.water.spin_work);
        post(Account::WallWork, |p| -p.water.held);
        if self.immersion.as_ref().is_some_and(Immersion::has_stream) {
            // What the stream gives stays in the system. The pressure takes from it what it gives to grains along it.
            post(Account::Buoyancy, |p| -p.water.carried);
            post(Account::StreamFriction, |p| -p.water.fluctuation);
        } else {
            post(Account::StreamWork, |p| p.water.stream);
        }
        post(Account::Drag, |p| p.water.lost);
        for axis in 0..3 {
            ledger.water_impulse[axis] += half * (last.water.force + now.water.force)[axis];
            ledger.outside_impulse[axis] += half * (last.outside_force + now.outside_force)[axis];
            ledger.wall_impulse[axis] += half * (last.wall_force + now.wall_force)[axis];
            ledger.gravity_impulse[axis] += self.clock.dt * self.books.moved_mass * self.integration.gravity[axis];
        }
        self.books.last = now;
    }
}
