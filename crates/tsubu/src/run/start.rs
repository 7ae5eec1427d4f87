//! How a run begins: as its scene says, or where another run has ended.

use super::stages::{self, stage_of};
use super::{RunError, resume};
use crate::engine::{Engine, energies};
use crate::ledger::{Account, Ledger};
use crate::methods;
use crate::partner::Hosts;
use crate::ranks::Communicator;
use std::path::Path;
use std::sync::Arc;
use tsubu_frame::{State, checkpoint};
use tsubu_scene::Scene;

/// What a run begins with.
pub(super) struct Start {
    pub engine: Box<dyn Engine>,
    pub hosts: Hosts,
    pub ledger: Ledger,
}

impl Start {
    /// The begin of the first stage of a scene, on one of several ranks if there is a communicator.
    pub(super) fn of(scene: &Scene, communicator: Option<&Arc<dyn Communicator>>) -> Result<Self, RunError> {
        let plan = scene.plan();
        if let Some(folder) = &plan.start_from {
            return Self::from(scene, Path::new(folder), communicator);
        }
        let hosts = Hosts::new(&plan.hosts);
        let engine = methods::open_on_ranks(plan, &hosts, communicator.cloned())?;
        let ledger = Ledger::open(energies(&*engine, &hosts), engine.momentum());
        Ok(Self { engine, hosts, ledger })
    }

    /// A scene where the checkpoint of such a state left it, and the stage that this is.
    pub(super) fn at(
        scene: &Scene,
        state: &mut State,
        communicator: Option<&Arc<dyn Communicator>>,
    ) -> Result<(Self, usize), RunError> {
        let Self { mut engine, mut hosts, .. } = Self::of(scene, communicator)?;
        let at = stage_of(state, scene.plans())?;
        for pair in scene.plans()[..=at].windows(2) {
            stages::change(&mut *engine, &mut hosts, [&pair[0], &pair[1]])?;
        }
        engine.load(state)?;
        hosts.load(state)?;
        engine.follow_hosts(&hosts);
        Ok((Self { engine, hosts, ledger: Ledger::load(state)? }, at))
    }

    /// Where the run in a folder stood at its last checkpoint, under the plan of the first stage.
    fn from(scene: &Scene, folder: &Path, communicator: Option<&Arc<dyn Communicator>>) -> Result<Self, RunError> {
        let refuse = |why: String| RunError::Start(format!("cannot start from {}: {why}", folder.display()));
        let text = std::fs::read_to_string(folder.join("scene.toml")).map_err(|error| refuse(error.to_string()))?;
        let obstacles = scene.obstacles(&text);
        if !obstacles.is_empty() {
            return Err(refuse(format!("what no stage may change differs:{}", resume::lines(&obstacles))));
        }
        let (header, mut state) = checkpoint::read(&checkpoint::path(folder))?;
        if let Some(why) = resume::of_another_version(&header) {
            return Err(refuse(format!("its checkpoint {why}")));
        }
        let earlier = Scene::read(&folder.join("scene.toml"), &[])
            .map_err(|complaints| refuse(complaints.titles().collect::<Vec<_>>().join("; ")))?;
        let plans = earlier.plans();
        let (Self { mut engine, mut hosts, mut ledger }, at) = Self::at(&earlier, &mut state, communicator)?;
        if scene.plan().start_at_zero == Some(true) {
            hosts.begin_anew();
            engine.restart_clock(&plans[at], &hosts)?;
            stages::change(&mut *engine, &mut hosts, [&plans[at], scene.plan()])?;
            let ledger = Ledger::open(energies(&*engine, &hosts), engine.momentum());
            return Ok(Self { engine, hosts, ledger });
        }
        let stored = stages::change(&mut *engine, &mut hosts, [&plans[at], scene.plan()])?;
        ledger.post(Account::Stages, stored);
        Ok(Self { engine, hosts, ledger })
    }
}
