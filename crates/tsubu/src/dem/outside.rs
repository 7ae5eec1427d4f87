//! Forces from outside join those of the contacts; their work and their impulse are posted.

use super::books::Powers;
use super::contact_forces::{BlockContacts, ContactForces};
use super::engine::DemEngine;
use crate::engine::{Note, Refusal, Verdict};
use crate::neighbours::lists::BLOCK;
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
    push: Push,
    /// By the number of the grain: grains are sorted between two words.
    held: Vec<[DVec3; 2]>,
    turns: bool,
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
        self.push.force.clear();
        self.push.torque.clear();
        match self.action.act(Moment { time, step, grains }, &mut self.push) {
            Heed::Stop => self.stop = true,
            Heed::Act => self.hold(grains),
        }
    }

    fn hold(&mut self, grains: &Grains) {
        let Self { push: Push { force, torque }, held, .. } = self;
        held.fill([DVec3::ZERO; 2]);
        self.turns = !torque.is_empty();
        if force.is_empty() && torque.is_empty() {
            held.clear();
            return;
        }
        let numbers = grains.id.iter().max().map_or(0, |id| *id as usize + 1);
        held.resize(numbers, [DVec3::ZERO; 2]);
        for (i, id) in grains.id.iter().enumerate() {
            // What is held in its place feels nothing.
            if grains.inverse_mass[i] != 0.0 {
                let of = |column: &[DVec3]| column.get(i).copied().unwrap_or_default();
                held[*id as usize] = [of(force), of(torque)];
            }
        }
    }

    fn on(&self, id: u32) -> [DVec3; 2] {
        self.held.get(id as usize).copied().unwrap_or_default()
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
    pub fn add(&self, grains: &Grains, blocks: &mut [BlockContacts]) {
        for acting in self.acting.iter().filter(|acting| !acting.held.is_empty()) {
            for (block, ids) in blocks.iter_mut().zip(grains.id.chunks(BLOCK)) {
                for (load, id) in block.loads.iter_mut().zip(ids) {
                    let [force, torque] = acting.on(*id);
                    load.force += force;
                    load.torque += torque;
                }
            }
        }
    }

    /// Power of all torques with the spins as they are now [W].
    pub fn torque_power(&self, grains: &Grains) -> f64 {
        let turning = self.acting.iter().filter(|acting| acting.turns);
        let of = |acting: &Acting| -> f64 {
            grains.id.iter().zip(&grains.spin).map(|(id, spin)| acting.on(*id)[1].dot(*spin)).sum()
        };
        turning.map(of).sum()
    }

    /// What the forces do at this time level, with velocities completed.
    pub fn measure(&mut self, grains: &Grains) {
        (self.power, self.force) = (self.torque_power(grains), DVec3::ZERO);
        for acting in self.acting.iter().filter(|acting| !acting.held.is_empty()) {
            for (id, velocity) in grains.id.iter().zip(&grains.velocity) {
                let [force, _] = acting.on(*id);
                self.power += force.dot(*velocity);
                self.force += force;
            }
        }
    }

    /// Force on a grain [N].
    pub fn on(&self, id: u32) -> DVec3 {
        self.acting.iter().map(|acting| acting.on(id)[0]).sum()
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
        if self.contacts.outside.acts() && !self.settling {
            self.contacts.outside.ask(self.clock.time(), self.clock.step, &mut self.grains);
        }
    }

    /// A wall moves as somebody tells it from now on.
    pub(super) fn steer_wall(&mut self, name: &str, velocity: Velocity) -> Result<(), Refusal> {
        let time = self.clock.time();
        let steered = match self.walls.iter_mut().find(|wall| wall.name == name) {
            Some(wall) => wall.steer(time, velocity),
            None => Err("there is no such wall".to_owned()),
        };
        let refuse = |text| {
            let notes = vec![Note { key: format!("walls.{name}.motion"), verdict: Verdict::Refused, text }];
            Refusal { method: "dem", notes }
        };
        steered.map_err(refuse)?;
        // The step that begins now begins with the new velocity: its work is that of the mean of both its ends.
        let lost = self.books.last.lost;
        self.books.last = Powers { lost, ..self.powers() };
        Ok(())
    }

    /// Somebody acts from now on.
    pub(super) fn act_from_outside(&mut self, every: u64, action: Box<dyn Action>) {
        let (push, held) = (Push::default(), Vec::new());
        let acting = Acting { action, every: every.max(1), asked: false, stop: false, push, held, turns: false };
        self.contacts.outside.acting.push(acting);
    }

    /// Nobody acts any more. What they did in the last step is still to be posted with the next.
    pub(super) fn leave_alone(&mut self) {
        self.contacts.outside = super::outside::Outside::default();
    }
}
