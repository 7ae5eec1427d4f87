//! How a run begins: as its scene says, or where another run has ended.

use super::RunError;
use super::stages::{self, stage_of};
use crate::engine::{Engine, energies};
use crate::ledger::Ledger;
use crate::methods;
use crate::partner::Hosts;
use std::fmt::Write as _;
use std::path::Path;
use tsubu_frame::checkpoint;
use tsubu_scene::Scene;

/// What a run begins with.
pub(super) struct Start {
    pub engine: Box<dyn Engine>,
    pub hosts: Hosts,
    pub ledger: Ledger,
}

impl Start {
    /// The begin of the first stage of a scene.
    pub(super) fn of(scene: &Scene) -> Result<Self, RunError> {
        let plan = scene.plan();
        if let Some(folder) = &plan.start_from {
            return Self::from(scene, Path::new(folder));
        }
        let hosts = Hosts::new(&plan.hosts);
        let engine = methods::open(plan, &hosts)?;
        let ledger = Ledger::open(energies(&*engine, &hosts), engine.momentum());
        Ok(Self { engine, hosts, ledger })
    }

    /// Where the run in a folder stood at its last checkpoint, under the plan of the first stage.
    fn from(scene: &Scene, folder: &Path) -> Result<Self, RunError> {
        let refuse = |why: String| RunError::Start(format!("cannot start from {}: {why}", folder.display()));
        let text = std::fs::read_to_string(folder.join("scene.toml")).map_err(|error| refuse(error.to_string()))?;
        let obstacles = scene.obstacles(&text);
        if !obstacles.is_empty() {
            let tell = |text: String, found: &tsubu_scene::Difference| {
                let [before, now] = [&found.before, &found.now].map(|value| value.as_deref().unwrap_or("nothing"));
                let mut text = text;
                let _ = write!(text, "\n  `{}` was {before}, is {now}", found.key);
                text
            };
            return Err(refuse(obstacles.iter().fold("what no stage may change differs:".to_owned(), tell)));
        }
        let (header, state) = checkpoint::read(&checkpoint::path(folder))?;
        if header.tsubu_version != crate::VERSION {
            return Err(refuse(format!(
                "it was run by tsubu {}, this is tsubu {}",
                header.tsubu_version,
                crate::VERSION
            )));
        }
        let earlier = Scene::read(&folder.join("scene.toml"), &[])
            .map_err(|complaints| refuse(complaints.titles().collect::<Vec<_>>().join("; ")))?;
        let plans = earlier.plans();
        let Self { mut engine, mut hosts, .. } = Self::of(&earlier)?;
        let at = stage_of(&state, plans)?;
        for pair in plans[..=at].windows(2) {
            stages::change(&mut *engine, &mut hosts, [&pair[0], &pair[1]])?;
        }
        engine.load(&state)?;
        hosts.load(&state)?;
        if scene.plan().start_at_zero == Some(true) {
            hosts.begin_anew();
            engine.restart_clock(&plans[at], &hosts)?;
            stages::change(&mut *engine, &mut hosts, [&plans[at], scene.plan()])?;
            let ledger = Ledger::open(energies(&*engine, &hosts), engine.momentum());
            return Ok(Self { engine, hosts, ledger });
        }
        let mut ledger = Ledger::load(&state)?;
        let stored = stages::change(&mut *engine, &mut hosts, [&plans[at], scene.plan()])?;
        ledger.post(crate::ledger::Account::Stages, stored);
        Ok(Self { engine, hosts, ledger })
    }
}
