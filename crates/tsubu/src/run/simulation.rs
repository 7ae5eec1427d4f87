//! A scene opened to be moved by hand: engine, hosts and books without a folder.

use super::stages::{self, AT};
use super::start::Start;
use super::{RunError, resume, scene_hash, step_of};
use crate::engine::{self, Engine, Fault};
use crate::ledger::{Account, Energies, Ledger};
use crate::partner::Hosts;
use crate::scene_files;
use std::path::Path;
use tsubu_frame::{Existing, FileError, Header, RunFolder, State, checkpoint};
use tsubu_scene::{Plan, Scene};

/// A scene that somebody moves step by step. It computes what [`run`](super::run()) does, with the same bits; it writes nothing, watches
/// nothing and ends no stage by itself.
pub struct Simulation {
    scene: Scene,
    /// Its grains, under the laws of its method.
    pub engine: Box<dyn Engine>,
    /// Its structures.
    pub hosts: Hosts,
    /// Its books.
    pub ledger: Ledger,
    stage: usize,
}

impl std::fmt::Debug for Simulation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Simulation").field("steps", &self.engine.steps()).finish_non_exhaustive()
    }
}

impl Simulation {
    /// Opens a scene at its begin.
    pub fn open(scene: &Scene) -> Result<Self, RunError> {
        let Start { engine, hosts, ledger } = Start::of(scene, None)?;
        Ok(Self { scene: scene.clone(), engine, hosts, ledger, stage: 0 })
    }

    /// Opens a scene where the checkpoint in `folder` left it: one of this scene, from a run or from a simulation.
    pub fn resume(scene: &Scene, folder: &Path) -> Result<Self, RunError> {
        let (header, mut state) = checkpoint::read(&checkpoint::path(folder))?;
        let refuse = |text: &str| RunError::NotThisScene(format!("the checkpoint in {} {text}", folder.display()));
        if let Some(why) = resume::of_another_version(&header) {
            return Err(refuse(&why));
        }
        if header.scene_hash != scene_hash(&scene.steps_toml()) {
            return Err(refuse("belongs to another scene"));
        }
        let (Start { engine, hosts, ledger }, stage) = Start::at(scene, &mut state, None)?;
        Ok(Self { scene: scene.clone(), engine, hosts, ledger, stage })
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// What the scene means in the present stage.
    pub fn plan(&self) -> &Plan {
        &self.scene.plans()[self.stage]
    }

    /// The name of the present stage, where the scene has stages.
    pub fn stage(&self) -> Option<&str> {
        self.plan().stage.get(self.stage).map(|stage| stage.name.as_str())
    }

    /// Moves everything by so many steps; fewer where somebody who acts from outside stops it.
    pub fn advance(&mut self, steps: u64) -> Result<(), Fault> {
        self.engine.advance(steps, &mut self.hosts, &mut self.ledger)
    }

    /// Number of steps from now to the one that ends nearest to a time [s]; none where that is past.
    pub fn steps_to(&self, time: f64) -> u64 {
        let (first, begin) = self.engine.stage_begin();
        (first + step_of((time - begin).max(0.0), self.engine.time_step())).saturating_sub(self.engine.steps())
    }

    /// Number of steps of the present stage that are left [-].
    pub fn steps_left(&self) -> u64 {
        let (_, begin) = self.engine.stage_begin();
        self.steps_to(begin + self.plan().duration)
    }

    /// Goes over to the next stage at this moment, whatever the present one waits for; says whether there is one.
    pub fn next_stage(&mut self) -> Result<bool, RunError> {
        if self.stage + 1 == self.scene.plans().len() {
            return Ok(false);
        }
        let [earlier, now] = [0, 1].map(|ahead| &self.scene.plans()[self.stage + ahead]);
        let stored = stages::change(&mut *self.engine, &mut self.hosts, [earlier, now])?;
        self.ledger.post(Account::Stages, stored);
        self.stage += 1;
        Ok(true)
    }

    /// What grains and hosts hold now.
    pub fn energies(&self) -> Energies {
        engine::energies(&*self.engine, &self.hosts)
    }

    /// Everything that the next step depends on, as the summary of a run hashes it.
    pub fn state(&self) -> State<'_> {
        let mut state = State::default();
        self.engine.save(&mut state);
        self.hosts.save(&mut state);
        self.ledger.save(&mut state);
        state
    }

    /// Writes scene and state into a folder: [`Simulation::resume`] goes on from there, and a scene that starts from it.
    pub fn checkpoint(&self, folder: &Path) -> Result<(), FileError> {
        let mut names = scene_files::names(&self.scene);
        names.push("checkpoint/state.tsubu".to_owned());
        let filled = folder.read_dir().is_ok_and(|mut entries| entries.next().is_some());
        let existing = if filled { Existing::Resume } else { Existing::Refuse };
        let written = RunFolder::create(folder, existing, &names)?;
        written.claim(&names)?;
        scene_files::write(&written, &self.scene)?;
        let mut state = self.state();
        if self.scene.plans().len() > 1 {
            state.put_integer(AT, vec![self.stage as i64]);
        }
        let header = Header {
            tsubu_version: crate::VERSION.to_owned(),
            scene_hash: scene_hash(&self.scene.steps_toml()),
            step: self.engine.steps(),
            time: self.engine.time(),
        };
        written.sync()?;
        checkpoint::write(folder, &state, &header)
    }
}
