//! The step.

use super::engine::DemEngine;
use super::integrate::{self, Motion};
use super::keep::Kept;
use super::touch::Scene;
use super::wet::Wet;
use crate::engine::{Engine, Fault};
use crate::ledger::{Account, Ledger};
use crate::partner::Hosts;
use crate::view::Contact;
use crate::wall::{Mover, Wall};
use glam::DVec3;
use tsubu_scene::plan::Integrator;

impl DemEngine {
    /// Moves everything by one time step. With `go_on` the grains have begun the next step when it ends: the first half of
    /// that step is done together with the second half of this one.
    pub(super) fn step(&mut self, hosts: &mut Hosts, ledger: &mut Ledger, go_on: bool) -> Result<(), Fault> {
        // Grains come and go, and gates open, between steps; a step before that is done to its end.
        let (looks, opens) = (self.looks(self.step + 1), self.opens(self.step + 1));
        let go_on = go_on && !looks && !opens;
        if !std::mem::replace(&mut self.begun, go_on) {
            let motion = self.motion(self.dt);
            integrate::before(&mut self.grains, &mut self.candidates, &mut self.reports, &motion);
        }
        self.step += 1;
        self.grain_steps += self.grains.len() as u64;
        self.turn();
        let time = self.time();
        hosts.before(self.dt);
        self.move_walls(time, hosts);
        self.drive(time);
        self.sink(ledger);
        if self.candidates.stale(&self.grains, &self.walls, self.search.skin) {
            self.check_finite()?;
            self.find();
        }
        self.touch_all();
        self.check_overlap()?;
        // Before positions may go on to the next step: the stream looks where the grains are now.
        self.flow_on(ledger);
        self.finish(self.dt, go_on);
        self.reactions(hosts, ledger);
        hosts.after(time, self.dt, &self.host_forces, ledger);
        self.close_books(ledger);
        if looks {
            self.come_and_go(ledger);
        }
        if opens {
            self.open_gates(ledger);
        }
        Ok(())
    }

    pub(super) fn move_walls(&mut self, time: f64, hosts: &Hosts) {
        if self.walls_held {
            return;
        }
        for wall in &mut self.walls {
            wall.before(self.dt);
            wall.follow(time, hosts);
        }
    }

    /// Sorts the grains and makes the candidate list again; contact history follows its pair.
    pub(super) fn find(&mut self) {
        let kept = self.kept();
        self.find_with(kept);
    }

    /// The same with contacts that were remembered before grains came or went.
    pub(super) fn find_with(&mut self, kept: Kept) {
        self.candidates.sort(&mut self.grains, &self.search);
        self.candidates.search(&self.grains, &self.walls, &self.search);
        self.fit();
        self.released += self.restore(kept);
    }

    /// Prepares the touch phase for new candidates.
    pub(super) fn fit(&mut self) {
        let mut touch = std::mem::take(&mut self.touch);
        touch.fit(&self.scene());
        for (list, block) in self.candidates.lists.iter_mut().zip(&touch.blocks) {
            list.expect(block.sums.contacts);
        }
        self.touch = touch;
    }

    pub(super) fn touch_all(&mut self) {
        let mut touch = std::mem::take(&mut self.touch);
        let mut sums = touch.forces(&self.scene());
        self.touch = touch;
        sums.lost[1] += std::mem::take(&mut self.released) / self.dt;
        self.sums = sums;
        self.soak();
    }

    /// Forces, stocks and powers of a moment that no step has led to: at time 0, and after grains or walls have gone.
    pub(super) fn stand(&mut self) {
        // Without time, bodies that adhere take hold of each other and springs stay as they are. Powers have no meaning then:
        // what snapping together sets free has gone before the books open.
        let mut touch = std::mem::take(&mut self.touch);
        let stored = touch.forces(&Scene { dt: 0.0, bath: None, ..self.scene() }).stored;
        self.touch = touch;
        let kept = self.kept();
        self.touch_all();
        self.restore(kept);
        self.sums.stored = stored;
        self.still_stream();
        self.finish(0.0, false);
        self.sum_wall_loads();
        for (wall, load) in self.walls.iter_mut().zip(&self.wall_loads) {
            wall.start(load.force, load.torque);
        }
        self.last_flows = self.flows();
    }

    /// What the touch phase reads.
    fn scene(&self) -> Scene<'_> {
        let Self { grains, walls, candidates, table, reaches, search, rotation, dt, .. } = self;
        let (reach, rotation, dt, bath) = (search.reach, *rotation, *dt, self.bath());
        Scene { grains, walls, candidates, table, reaches, reach, rotation, dt, bath }
    }

    /// The contacts of this moment.
    pub(super) fn contact_list(&self) -> Vec<Contact> {
        self.touch.contacts(&self.scene())
    }

    /// The same without forces, for those who look at every step.
    pub(super) fn touches(&self) -> Vec<Contact> {
        super::touches::touches(&self.scene())
    }

    /// Accelerations from contact forces and gravity; completes the velocities for a step `dt` (0: leaves them).
    pub(super) fn finish(&mut self, dt: f64, go_on: bool) {
        let motion = self.motion(dt);
        let report = integrate::after(
            &mut self.grains,
            &self.touch.blocks,
            &mut self.candidates,
            &mut self.reports,
            &motion,
            go_on,
        );
        self.sums.correct(report.correction);
        self.fixed = (report.fixed_force, report.driven_power);
    }

    pub(super) fn motion(&self, dt: f64) -> Motion {
        let integrator = if dt > 0.0 { self.integrator } else { Integrator::SymplecticEuler };
        Motion { integrator, gravity: self.gravity, rotation: self.rotation, dt }
    }

    /// What grains did to the walls goes to those who move them.
    fn reactions(&mut self, hosts: &Hosts, ledger: &mut Ledger) {
        self.sum_wall_loads();
        self.host_forces.clear();
        self.host_forces.resize(hosts.list.len(), 0.0);
        if self.walls_held {
            return;
        }
        for (wall, load) in self.walls.iter_mut().zip(&self.wall_loads) {
            if let Some((index, direction)) = wall.host() {
                self.host_forces[index] += load.force.dot(direction);
            }
            let exchange = wall.after(load.force, load.torque, self.dt);
            ledger.post(Account::ForceWork, exchange.work);
            ledger.post(Account::HostDamping, exchange.lost);
        }
    }

    pub(super) fn sum_wall_loads(&mut self) {
        for (k, load) in self.wall_loads.iter_mut().enumerate() {
            *load = self.touch.wall_load(k);
        }
    }

    /// Posts the work and the losses of the step by the trapezoidal rule.
    fn close_books(&mut self, ledger: &mut Ledger) {
        let now = self.flows();
        let half = 0.5 * self.dt;
        let accounts = [Account::NormalDamping, Account::Sliding, Account::Rolling, Account::WallWork];
        for (account, (old, new)) in accounts.into_iter().zip(self.last_flows.powers.into_iter().zip(now.powers)) {
            ledger.post(account, half * (old + new));
        }
        let (old, new) = (self.last_flows.water, now.water);
        ledger.post(Account::Buoyancy, half * (old.pressure + new.pressure));
        ledger.post(Account::StreamWork, half * (old.spun + new.spun));
        ledger.post(Account::WallWork, -half * (old.held + new.held));
        if self.wet.as_ref().is_some_and(Wet::has_stream) {
            // What the stream gives stays in the system. The pressure takes from it what it gives to grains along it.
            ledger.post(Account::Buoyancy, -half * (old.carried + new.carried));
            ledger.post(Account::StreamFriction, -half * (old.gust + new.gust));
        } else {
            ledger.post(Account::StreamWork, half * (old.stream + new.stream));
        }
        ledger.post(Account::Drag, half * (old.lost + new.lost));
        for axis in 0..3 {
            ledger.water_impulse[axis] += half * (old.force + new.force)[axis];
            ledger.wall_impulse[axis] += half * (self.last_flows.wall_force + now.wall_force)[axis];
            ledger.gravity_impulse[axis] += self.dt * self.total_mass * self.gravity[axis];
        }
        self.last_flows = now;
    }

    /// Powers and wall force of this time level.
    pub(super) fn flows(&self) -> Flows {
        let mut flows = Flows { water: self.water_flows, ..Flows::default() };
        flows.powers[..3].copy_from_slice(&self.sums.lost);
        for (wall, load) in self.walls.iter().zip(&self.wall_loads) {
            flows.wall_force -= load.force;
            flows.powers[3] -= wall.prescribed_power(load.force, load.torque);
        }
        flows.wall_force -= self.fixed.0;
        flows.powers[3] += self.fixed.1;
        flows
    }

    fn check_finite(&self) -> Result<(), Fault> {
        let bad = |column: &[DVec3]| column.iter().position(|p| !p.is_finite());
        for (what, column) in [("position", &self.grains.position), ("velocity", &self.grains.velocity)] {
            if let Some(i) = bad(column) {
                return Err(Fault::NotFinite {
                    step: self.step,
                    time: self.time(),
                    grain: self.grains.id[i] as usize,
                    what,
                });
            }
        }
        Ok(())
    }

    fn check_overlap(&self) -> Result<(), Fault> {
        if self.sums.deepest <= self.largest_overlap * self.smallest_diameter {
            return Ok(());
        }
        let ratios = self.contact_list().into_iter().map(|contact| (self.overlap_ratio(&contact), contact));
        let Some((ratio, contact)) = ratios.max_by(|a, b| a.0.total_cmp(&b.0)) else { return Ok(()) };
        if ratio <= self.largest_overlap {
            return Ok(());
        }
        let held = |i: usize| self.grains.inverse_mass[i] == 0.0;
        let driven = |wall: &Wall| matches!(wall.mover, Mover::Motion(..)) || wall.turning.is_some();
        let second = contact.second;
        Err(Fault::Overlap {
            step: self.step,
            time: self.time(),
            grain: self.grains.id[contact.first] as usize,
            other: self.named(&contact),
            ratio,
            limit: self.largest_overlap,
            crushed: held(contact.first) || if contact.wall { driven(&self.walls[second]) } else { held(second) },
        })
    }
}

/// Powers (normal damping, sliding, rolling, work of walls and driven grains) [W] and force of walls and fixed grains on
/// the others [N] at a time level.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Flows {
    pub powers: [f64; 4],
    pub wall_force: DVec3,
    pub water: crate::water::Flows,
}
