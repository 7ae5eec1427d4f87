//! Forces from outside join those of the contacts; their work and their impulse are posted.

use super::books::Powers;
use super::contact_forces::{BlockContacts, ContactForces};
use super::engine::DemEngine;
use crate::engine::Refusal;
use crate::neighbours::block::BLOCK;
use crate::outside::{Action, Heed, Moment, Push};
use crate::state::Grains;
use crate::wall::Velocity;
use glam::DVec3;
use std::fmt;

/// Somebody who acts on the grains, and the forces that hold until the next word.
pub(super) struct Acting {
    action: Box<dyn Action>,
    every: u64,
    asked: bool,
    stop: bool,
    /// What holds, a row a grain of `ids`; nothing where there are no forces or no torques.
    held: Push,
    /// Numbers of the grains in the order of the rows.
    ids: Vec<u32>,
    /// Room for the next word.
    next: Push,
}

impl fmt::Debug for Acting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Acting").field("every", &self.every).finish_non_exhaustive()
    }
}

/// All who act, and what they do at a time level.
#[derive(Debug, Default)]
pub(super) struct Outside {
    acting: Vec<Acting>,
    /// Power of all forces and torques on the grains [W].
    pub power: f64,
    /// Sum of all forces [N].
    pub force: DVec3,
}

impl Acting {
    fn ask(&mut self, time: f64, step: u64, grains: &mut Grains) {
        if self.asked && !step.is_multiple_of(self.every) {
            return;
        }
        self.asked = true;
        self.next.force.clear();
        self.next.torque.clear();
        if self.action.act(Moment { time, step, grains }, &mut self.next) == Heed::Stop {
            self.stop = true;
            return;
        }
        std::mem::swap(&mut self.held, &mut self.next);
        self.ids.clone_from(&grains.id);
        for column in self.held.columns() {
            // What is held in its place feels nothing.
            for (value, inverse_mass) in column.iter_mut().zip(&grains.inverse_mass) {
                if *inverse_mass == 0.0 {
                    *value = DVec3::ZERO;
                }
            }
        }
    }

    /// Puts the rows into the order that the grains have now. Who has come since the last word feels nothing until the next.
    fn follow(&mut self, grains: &Grains) {
        if self.ids == grains.id {
            return;
        }
        let numbers = self.ids.iter().max().map_or(0, |id| *id as usize + 1);
        let mut rows = vec![None; numbers];
        for (row, id) in self.ids.iter().enumerate() {
            rows[*id as usize] = Some(row);
        }
        for column in self.held.columns().into_iter().filter(|column| !column.is_empty()) {
            let of = |id: &u32| rows.get(*id as usize).copied().flatten().map_or(DVec3::ZERO, |row| column[row]);
            *column = grains.id.iter().map(of).collect();
        }
        self.ids.clone_from(&grains.id);
    }
}

impl Push {
    fn columns(&mut self) -> [&mut Vec<DVec3>; 2] {
        [&mut self.force, &mut self.torque]
    }
}

impl Outside {
    /// Whether somebody acts.
    pub fn acts(&self) -> bool {
        !self.acting.is_empty()
    }

    /// Asks those whose turn it is what they do at this moment.
    pub fn ask(&mut self, time: f64, step: u64, grains: &mut Grains) {
        self.acting.iter_mut().for_each(|acting| acting.ask(time, step, grains));
    }

    /// Adds the forces that hold to what contacts do to the grains of each block.
    pub fn add(&mut self, grains: &Grains, blocks: &mut [BlockContacts]) {
        for acting in &mut self.acting {
            acting.follow(grains);
            let Push { force, torque } = &acting.held;
            for (block, force) in blocks.iter_mut().zip(force.chunks(BLOCK)) {
                block.loads.iter_mut().zip(force).for_each(|(load, force)| load.force += *force);
            }
            for (block, torque) in blocks.iter_mut().zip(torque.chunks(BLOCK)) {
                block.loads.iter_mut().zip(torque).for_each(|(load, torque)| load.torque += *torque);
            }
        }
    }

    /// Power of all torques with the spins as they are now [W].
    pub fn torque_power(&self, grains: &Grains) -> f64 {
        let torques = self.acting.iter().flat_map(|acting| acting.held.torque.iter().zip(&grains.spin));
        torques.map(|(torque, spin)| torque.dot(*spin)).sum()
    }

    /// What the forces do at this time level, with velocities completed.
    pub fn measure(&mut self, grains: &Grains) {
        (self.power, self.force) = (self.torque_power(grains), DVec3::ZERO);
        for (force, velocity) in self.acting.iter().flat_map(|acting| acting.held.force.iter().zip(&grains.velocity)) {
            self.power += force.dot(*velocity);
            self.force += force;
        }
    }

    /// Force on the grain in row `i` [N].
    pub fn on(&self, i: usize) -> DVec3 {
        self.acting.iter().filter_map(|acting| acting.held.force.get(i)).sum()
    }

    /// Whether somebody wants the run to stop; the wish is forgotten by that.
    pub fn wants_stop(&mut self) -> bool {
        let mut stop = false;
        for acting in &mut self.acting {
            stop |= std::mem::take(&mut acting.stop);
        }
        stop
    }
}

impl ContactForces {
    /// Adds the forces from outside, where there are any.
    pub fn add_outside(&mut self, grains: &Grains) {
        let Self { outside, blocks, .. } = self;
        outside.add(grains, blocks);
    }
}

impl DemEngine {
    /// Asks those who act from outside what they do at this moment.
    pub(super) fn ask_outside(&mut self) {
        if self.contacts.outside.acts() && !self.clock.settling {
            self.contacts.outside.ask(self.clock.time(), self.clock.step, &mut self.grains);
        }
    }

    /// Whether accelerations hold forces from outside: of those who act, or of those who did in the last step.
    pub(super) fn pushed_from_outside(&self) -> bool {
        self.contacts.outside.acts() || self.books.last.outside_force != DVec3::ZERO
    }

    /// A wall moves as somebody tells it from now on.
    pub(super) fn steer_wall(&mut self, name: &str, velocity: Velocity) -> Result<(), Refusal> {
        let time = self.clock.time();
        let steered = match self.walls.iter_mut().find(|wall| wall.name == name) {
            Some(wall) => wall.steer(time, velocity),
            None => Err("there is no such wall".to_owned()),
        };
        steered.map_err(|text| Refusal::of("dem", format!("walls.{name}.motion"), text))?;
        // The step that begins now begins with the new velocity: its work is that of the mean of both its ends.
        let lost = self.books.last.lost;
        self.books.last = Powers { lost, ..self.powers() };
        Ok(())
    }

    /// Somebody acts from now on.
    pub(super) fn act_from_outside(&mut self, every: u64, action: Box<dyn Action>) {
        let (held, ids, next) = (Push::default(), Vec::new(), Push::default());
        let acting = Acting { action, every: every.max(1), asked: false, stop: false, held, ids, next };
        self.contacts.outside.acting.push(acting);
    }

    /// Nobody acts any more. What they did in the last step is still to be posted with the next.
    pub(super) fn leave_alone(&mut self) {
        self.contacts.outside = Outside::default();
    }
}
