//! The step.

use super::engine::DemEngine;
use super::integrate;
use super::touch::{Contact, Scene};
use crate::engine::{Engine, Fault};
use crate::find::Candidates;
use crate::ledger::{Account, Ledger};
use crate::partner::Hosts;
use crate::wall::Carrier;
use glam::DVec3;
use std::collections::BTreeMap;

impl DemEngine {
    /// Moves everything by one time step.
    pub(super) fn step(&mut self, hosts: &mut Hosts, ledger: &mut Ledger) -> Result<(), Fault> {
        integrate::before(&mut self.grains, &mut self.halves, self.integrator, self.dt);
        self.step += 1;
        let time = self.time();
        hosts.before(self.dt);
        self.move_walls(time, hosts);
        if self.candidates.stale(&self.grains, &self.planes, self.skin) {
            self.check_finite()?;
            self.find();
        }
        self.touch_all();
        self.check_overlap()?;
        self.accelerate();
        let correction = integrate::after(
            &mut self.grains,
            &self.halves,
            self.integrator,
            self.dt,
            &self.forces.lossy,
            &self.forces.torque,
        );
        self.forces.sums.correct(correction);
        self.reactions(hosts);
        hosts.after(time, self.dt, &self.host_forces, ledger);
        self.close_books(ledger);
        Ok(())
    }

    pub(super) fn move_walls(&mut self, time: f64, hosts: &Hosts) {
        if self.walls_held {
            return;
        }
        for plane in &mut self.planes {
            plane.follow(time, hosts);
        }
    }

    /// Puts the grains in the order of their cells and makes the candidate list again; contact history follows its pair.
    pub(super) fn find(&mut self) {
        let held = self.held_history();
        if Candidates::sorts(&self.grains) {
            let order = self.candidates.order(&self.grains, self.reach).to_vec();
            self.grains.permute(&order);
        }
        self.candidates.search(&self.grains, &self.planes, self.skin, self.reach);
        self.restore_history(&held);
    }

    /// Contact history by the ids of the two bodies, with the first body's id first. Planes follow the grains.
    pub(super) fn held_history(&self) -> BTreeMap<(u32, u32), [f64; 4]> {
        let mut held = BTreeMap::new();
        if self.law.needs.history {
            let id = &self.grains.id;
            let pairs = self.candidates.pairs.iter().map(|p| (id[p[0] as usize], id[p[1] as usize]));
            let walls = self.candidates.walls.iter().map(|p| (id[p[0] as usize], self.grains.len() as u32 + p[1]));
            let history = self.touch.pair_history.iter().chain(&self.touch.wall_history);
            held.extend(pairs.chain(walls).zip(history).filter(|(_, h)| h[3] != 0.0).map(|(k, h)| (k, *h)));
        }
        held
    }

    /// Gives every candidate the history it had; a pair whose bodies have changed places gets it with the sign turned.
    pub(super) fn restore_history(&mut self, held: &BTreeMap<(u32, u32), [f64; 4]>) {
        let id = &self.grains.id;
        let look = |a: u32, b: u32| -> [f64; 4] {
            if held.is_empty() {
                return [0.0; 4];
            }
            held.get(&(a, b))
                .copied()
                .or_else(|| held.get(&(b, a)).map(|h| [-h[0], -h[1], -h[2], h[3]]))
                .unwrap_or([0.0; 4])
        };
        let touch = &mut self.touch;
        touch.pair_history.clear();
        touch.pair_history.extend(self.candidates.pairs.iter().map(|p| look(id[p[0] as usize], id[p[1] as usize])));
        let grains = id.len() as u32;
        touch.wall_history.clear();
        touch.wall_history.extend(self.candidates.walls.iter().map(|p| look(id[p[0] as usize], grains + p[1])));
        touch.reset();
    }

    pub(super) fn touch_all(&mut self) {
        let Self { grains, planes, candidates, law, table, rotation, dt, touch, forces, .. } = self;
        let scene = Scene { grains, planes, candidates, law, table, rotation: *rotation, dt: *dt };
        touch.forces(&scene, forces);
    }

    /// The contacts of this moment.
    pub(super) fn contact_list(&self) -> Vec<Contact> {
        let Self { grains, planes, candidates, law, table, rotation, dt, touch, .. } = self;
        touch.contacts(&Scene { grains, planes, candidates, law, table, rotation: *rotation, dt: *dt })
    }

    /// Accelerations from contact forces and gravity.
    pub(super) fn accelerate(&mut self) {
        let grains = &mut self.grains;
        for i in 0..grains.id.len() {
            grains.acceleration[i] = self.forces.force[i] * (1.0 / grains.mass[i]) + self.gravity;
        }
        if self.rotation {
            for i in 0..grains.id.len() {
                grains.spin_rate[i] = self.forces.torque[i] * (1.0 / grains.inertia[i]);
            }
        }
    }

    /// Sums the forces on the planes for their hosts.
    fn reactions(&mut self, hosts: &Hosts) {
        self.host_forces.clear();
        self.host_forces.resize(hosts.list.len(), 0.0);
        if hosts.list.is_empty() {
            return;
        }
        for (plane, force) in self.planes.iter().zip(&self.forces.plane_force) {
            if let Carrier::Host(index, direction) = &plane.carrier {
                self.host_forces[*index] += force.dot(*direction);
            }
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
        for axis in 0..3 {
            ledger.wall_impulse[axis] += half * (self.last_flows.wall_force + now.wall_force)[axis];
            ledger.gravity_impulse[axis] += self.dt * self.total_mass * self.gravity[axis];
        }
        self.last_flows = now;
    }

    /// Powers and wall force of this time level.
    pub(super) fn flows(&self) -> Flows {
        let mut flows = Flows::default();
        flows.powers[..3].copy_from_slice(&self.forces.sums.lost);
        for (plane, force) in self.planes.iter().zip(&self.forces.plane_force) {
            flows.wall_force -= *force;
            if let Carrier::Motion(..) = plane.carrier {
                flows.powers[3] -= force.dot(plane.velocity);
            }
        }
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
        if self.forces.sums.deepest <= self.largest_overlap * self.smallest_diameter {
            return Ok(());
        }
        let grains = &self.grains;
        let pairs = self.candidates.pairs.iter().map(|p| {
            let [i, j] = p.map(|i| i as usize);
            let overlap = grains.radius[i] + grains.radius[j] - grains.position[i].distance(grains.position[j]);
            (overlap / (2.0 * grains.radius[i].min(grains.radius[j])), i)
        });
        let walls = self.candidates.walls.iter().map(|p| {
            let i = p[0] as usize;
            let gap = self.planes[p[1] as usize].distance(grains.position[i]);
            ((grains.radius[i] - gap) / (2.0 * grains.radius[i]), i)
        });
        let (ratio, i) = pairs.chain(walls).fold((0.0, 0), |a, b| if b.0 > a.0 { b } else { a });
        if ratio <= self.largest_overlap {
            return Ok(());
        }
        let grain = grains.id[i] as usize;
        Err(Fault::Overlap { step: self.step, time: self.time(), grain, ratio, limit: self.largest_overlap })
    }
}

/// Powers (normal damping, sliding, rolling, walls' work) [W] and force of the walls on the grains [N] at a time level.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Flows {
    pub powers: [f64; 4],
    pub wall_force: DVec3,
}
