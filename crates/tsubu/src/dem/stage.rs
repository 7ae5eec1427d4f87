//! Stages of a run: the grains stay, with all that their contacts remember; what acts on them changes.

use super::contact_forces::ContactLaws;
use super::engine::DemEngine;
use crate::check;
use crate::contact::{Law, Table};
use crate::engine::{Note, OpenError, Refusal, Verdict};
use crate::partner::Hosts;
use crate::wall::{Faces, Mover};
use glam::DVec3;
use tsubu_scene::Plan;
use tsubu_scene::plan::{GrainMotion, Particles};

fn refuse(key: &str, text: String) -> OpenError {
    let notes = vec![Note { key: key.to_owned(), verdict: Verdict::Refused, text }];
    Refusal { method: "dem", notes }.into()
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

    /// Goes over from one stage to the next at this moment.
    pub(super) fn change_plan(&mut self, [earlier, now]: [&Plan; 2], hosts: &Hosts) -> Result<(), OpenError> {
        let time = self.clock.time();
        let table = Table::new(now);
        let dt = check::time_step(now, &table, hosts);
        let gravity = DVec3::from_array(now.gravity);
        if now.water.is_some() && now.gravity != earlier.gravity {
            return Err(refuse("gravity", "in water gravity stays as it is from stage to stage".to_owned()));
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
