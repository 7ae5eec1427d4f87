//! Going on from a checkpoint: what it must agree with.

use super::{HISTORY, Run, RunError};
use crate::ledger::Ledger;
use std::fmt::Write as _;
use std::path::Path;
use tsubu_frame::state::MissingSection;
use tsubu_frame::{Header, Mark, checkpoint};
use tsubu_scene::{Difference, Scene};

/// The scene as the run in `folder` goes on with it: intervals that nobody tells stay as they were there.
pub(super) fn scene(scene: &Scene, folder: &Path) -> Scene {
    // A folder without a scene is refused later, for its checkpoint's sake.
    let earlier = std::fs::read_to_string(folder.join("scene.toml")).unwrap_or_default();
    scene.going_on(&earlier).unwrap_or_else(|_| scene.clone())
}

impl Run<'_> {
    /// Takes the state of the checkpoint, and gives how far the history was then.
    pub(super) fn resume(&mut self, scene: &Scene, folder: &Path) -> Result<Mark, RunError> {
        let (header, mut state) = checkpoint::read(&checkpoint::path(folder))?;
        let refuse =
            |text: String| Err(RunError::NotThisScene(format!("the checkpoint in {} {text}", folder.display())));
        if let Some(why) = of_another_version(&header) {
            return refuse(why);
        }
        if header.scene_hash != self.scene_hash {
            return refuse(format!("belongs to another scene{}", differences(scene, folder)));
        }
        self.enter_stage(&state)?;
        let dt = self.engine.time_step();
        self.engine.load(&mut state)?;
        self.place_stage()?;
        if self.engine.time() != header.time {
            let before = header.time / header.step as f64;
            return refuse(format!("was made with a time step of {before} s, not {dt} s: set `dem.time-step`"));
        }
        if self.engine.steps() > self.last {
            let (time, end) = (header.time, self.plan.duration);
            return refuse(format!("is of t = {time} s, behind the end: raise `duration` = {end} s"));
        }
        self.hosts.load(&state)?;
        self.ledger = Ledger::load(&state)?;
        self.measured.load(&state)?;
        self.lost.load(&state)?;
        self.watches.load(&state)?;
        self.wall_before = state.real("run.wall-seconds")?.first().copied().unwrap_or(0.0);
        let missing = || MissingSection { name: HISTORY.to_owned(), kind: "integer" };
        Ok(Mark::from_numbers(state.integer(HISTORY)?).ok_or_else(missing)?)
    }
}

/// Why this program cannot read a checkpoint, where another version wrote it.
pub(super) fn of_another_version(header: &Header) -> Option<String> {
    let (found, this) = (&header.tsubu_version, crate::VERSION);
    (found != this).then(|| format!("was written by tsubu {found}, this is tsubu {this}: go on with the other"))
}

/// Differences that a message names.
const NAMED: usize = 8;

/// What differs from the scene of the folder, a line a key.
fn differences(scene: &Scene, folder: &Path) -> String {
    let earlier = std::fs::read_to_string(folder.join("scene.toml")).unwrap_or_default();
    what_differs(&scene.differences(&earlier))
}

/// The end of a sentence about another scene.
pub(crate) fn what_differs(all: &[Difference]) -> String {
    if all.is_empty() {
        return ", and the scene.toml beside it does not tell which".to_owned();
    }
    format!("; what differs:{}", lines(all))
}

/// A line for each of the first differences.
pub(super) fn lines(all: &[Difference]) -> String {
    let mut text = String::new();
    for difference in all.iter().take(NAMED) {
        let [before, now] = [&difference.before, &difference.now].map(|value| value.as_deref().unwrap_or("nothing"));
        let _ = write!(text, "\n  `{}` was {before}, is {now}", difference.key);
    }
    if all.len() > NAMED {
        let _ = write!(text, "\n  and {} more", all.len() - NAMED);
    }
    text
}
