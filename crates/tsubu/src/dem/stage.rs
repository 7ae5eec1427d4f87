//! Stages of a run: the grains stay, with all that their contacts remember; what acts on them changes.

use super::contact_forces::ContactLaws;
use super::engine::DemEngine;
use super::immersion::Immersion;
use crate::check;
use crate::contact::{Law, Table};
use crate::engine::{OpenError, Refusal};
use crate::partner::Hosts;
use crate::wall::{Faces, Mover};
use glam::DVec3;
use tsubu_scene::Plan;
use tsubu_scene::plan::{Flow, GrainMotion, Particles, Water};

fn refuse(key: &str, text: String) -> OpenError {
    Refusal::of("dem", key, text).into()
}

/// What of the water, or of the gravity that grains have in it, is part of their state and yet told anew: the key, and why it stays.
fn stays_in_water(earlier: &Plan, now: &Plan) -> Option<(&'static str, &'static str)> {
    let (before, after) = match (&earlier.water, &now.water) {
        (None, None) => return None,
        (Some(before), Some(after)) => (before, after),
        _ => return Some(("water", "water is there from the first stage on, or never; it may flow by `still` first")),
    };
    let layers = |flow: &Flow| match *flow {
        Flow::Coupled { bottom, top, layers, area, lid, reach, .. } => {
            Some((bottom, top, layers, area, Some((lid, reach))))
        }
        Flow::Column { bottom, top, layers, area, .. } => Some((bottom, top, layers, area, None)),
        Flow::Still {} | Flow::LogLaw { .. } | Flow::Table { .. } => None,
    };
    let fluctuates = |water: &Water| water.fluctuation.map(|fluctuation| (fluctuation.directions, fluctuation.time));
    if now.gravity != earlier.gravity {
        Some(("gravity", "in water gravity stays as it is from stage to stage"))
    } else if layers(&before.flow) != layers(&after.flow) {
        Some(("water.flow", "a stream in layers goes on with the same layers; what drives it may change"))
    } else if before.surface != after.surface {
        Some(("water.surface", "the mass of water that moves with grains hangs on it"))
    } else if fluctuates(before) != fluctuates(after) {
        Some((
            "water.fluctuation",
            "grains remember what was drawn for the water around them; its `strength` may change",
        ))
    } else {
        None
    }
}

impl DemEngine {
    /// Turns the clock back to 0, with walls where they are.
    pub(super) fn turn_clock_back(&mut self, plan: &Plan, hosts: &Hosts) -> Result<(), OpenError> {
        let driven = |group: &Particles| matches!(group.motion, GrainMotion::Driven { .. });
        if let Some((name, _)) = plan.particles.iter().find(|(_, group)| driven(group)) {
            let text = "a signal moves these grains from where they were at time 0: go on with the clock".to_owned();
            return Err(refuse(&format!("particles.{name}.motion"), text));
        }
        if plan.water.is_some() {
            return Err(refuse("water", "the water goes with the clock: go on with it".to_owned()));
        }
        (self.clock.step, self.clock.grain_steps, self.clock.begin) = (0, 0, (0, 0.0));
        for (wall, plan) in self.walls.iter_mut().zip(plan.walls.values()) {
            wall.begin_anew(plan, hosts);
        }
        self.sources.begin_anew();
        Ok(())
    }

    /// Walls on hosts take their place and motion of this moment: within a step they have those from before the forces on the hosts.
    pub(super) fn walls_follow(&mut self, hosts: &Hosts) {
        let time = self.clock.time();
        for wall in self.walls.iter_mut().filter(|wall| wall.host().is_some()) {
            wall.follow(time, hosts);
        }
    }

    /// Goes over from one stage to the next at this moment.
    pub(super) fn change_plan(&mut self, [earlier, now]: [&Plan; 2], hosts: &Hosts) -> Result<(), OpenError> {
        self.walls_follow(hosts);
        let time = self.clock.time();
        let table = Table::new(now);
        let dt = check::time_step(now, &table, hosts);
        let gravity = DVec3::from_array(now.gravity);
        if let Some((key, text)) = stays_in_water(earlier, now) {
            return Err(refuse(key, text.to_owned()));
        }
        let laws = ContactLaws::new(now, table, hosts);
        let parts = |laws: &[Law]| -> Vec<Vec<&'static str>> {
            laws.iter().map(|law| law.parts().iter().map(|part| part.about().key).collect()).collect()
        };
        if parts(laws.all()) != parts(self.laws.all()) {
            let text = "the constants of a contact law may change from stage to stage, its parts may not".to_owned();
            return Err(refuse("contact", text));
        }
        for (wall, (name, plan)) in self.walls.iter_mut().zip(&now.walls) {
            let Some(before) = earlier.walls.get(name) else { continue };
            let changed = wall.change([before, plan], now.dimension, hosts, gravity, time);
            changed.map_err(|text| refuse(&format!("walls.{name}.rotation"), text))?;
            if let Mover::Body(body) = &mut wall.mover {
                body.pull(gravity);
            }
        }
        self.faces = Faces::new(now);
        if let (Some(immersion), Some(water)) = (self.immersion.take(), &now.water) {
            self.immersion = Some(Immersion::new(immersion.water.changed(water, gravity)));
        }
        self.neighbours.search.reach = laws.reach();
        self.laws = laws;
        self.contacts.forget_laws();
        self.integration.gravity = gravity;
        self.limits.largest_overlap = now.dem.largest_overlap;
        self.sources.change(now, &self.walls, time);
        self.clock.begin_stage(dt);
        self.place_gates();
        self.start();
        Ok(())
    }
}
