//! How grains are turned, where a scene asks for it.

use super::engine::DemEngine;
use glam::{DQuat, DVec3};
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;

/// Orientations by the ids of grains, so that sorting does not touch them; empty where nobody asks.
#[derive(Clone, Debug, Default)]
pub(super) struct Orientation {
    wanted: bool,
    turned: Vec<DQuat>,
}

impl Orientation {
    /// All grains as they were made.
    pub fn new(wanted: bool) -> Self {
        Self { wanted, turned: Vec::new() }
    }

    /// Whether somebody asks.
    pub fn is_wanted(&self) -> bool {
        self.wanted
    }

    /// Of a grain; `None` where nobody asks.
    pub fn of(&self, id: u32) -> Option<DQuat> {
        self.wanted.then(|| self.turned.get(id as usize).copied().unwrap_or(DQuat::IDENTITY))
    }

    /// Writes it into a checkpoint.
    pub fn save(&self, state: &mut State) {
        if self.wanted {
            state.put_real("dem.orientation", self.turned.iter().flat_map(DQuat::to_array).collect::<Vec<_>>());
        }
    }

    /// Takes it back.
    pub fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        if self.wanted {
            let flat = state.real("dem.orientation")?;
            self.turned = flat.as_chunks::<4>().0.iter().map(|q| DQuat::from_array(*q)).collect();
        }
        Ok(())
    }
}

impl DemEngine {
    /// Turns every grain by its spin in the middle of the step, between the two half steps.
    pub(super) fn rotate(&mut self) {
        if !self.integration.orientation.wanted || self.clock.settling {
            return;
        }
        let grains = &self.grains;
        let turned = &mut self.integration.orientation.turned;
        let ids = grains.id.iter().max().map_or(0, |id| *id as usize + 1);
        if turned.len() < ids {
            turned.resize(ids, DQuat::IDENTITY);
        }
        for ((id, spin), rate) in grains.id.iter().zip(&grains.spin).zip(&grains.angular_acceleration) {
            let spin: DVec3 = *spin - *rate * (0.5 * self.clock.dt);
            let q = &mut turned[*id as usize];
            *q = (DQuat::from_scaled_axis(spin * self.clock.dt) * *q).normalize();
        }
    }
}
