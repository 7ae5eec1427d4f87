//! A study whose runs are done apart: each by a process of its own, here or on another machine of a cluster.
//!
//! Whoever shares the runs out ([`Apart::missing`]) and whoever does one ([`Apart::run`]) meet in the folder alone. A run that
//! is finished is kept, so each may be asked for as often as a cluster likes. The last one gathers.

use super::cases::CasesError;
use crate::interrupt::{Interrupt, Watcher};
use crate::methods;
use crate::partner::Hosts;
use crate::{memory, trial};
use std::path::Path;
use std::time::{Duration, Instant};
use tsubu_frame::{Status, Summary};
use tsubu_scene::Plan;

/// A study whose runs can be done apart.
pub trait Apart {
    /// Makes the folder with the scene in it, or takes the one that was begun.
    fn begin(&mut self, overwrite: bool) -> Result<(), CasesError>;

    /// Names of the runs that are to be done: letters, digits and `-._=,+` alone.
    fn missing(&mut self) -> Result<Vec<String>, CasesError>;

    /// Does one of them; how it ended stands in the folder too.
    fn run(&mut self, name: &str, watcher: &Watcher) -> Result<Status, CasesError>;

    /// What each run is of, with the time that is simulated in it [s].
    fn plans(&self) -> Result<Vec<(Plan, f64)>, CasesError>;
}

/// A study whose results are files and a summary, whatever its runs are.
pub trait Gathered: Apart {
    /// Makes them of what is there, and runs nothing. `why` tells of a run, by its name, why it has no result.
    fn gather(&mut self, why: &dyn Fn(&str) -> String) -> Result<Summary, CasesError>;
}

/// The runs of some study of a scene, and the folder that they are in.
pub type StudyRuns<'a> = Box<dyn Gathered + Send + 'a>;

/// Why nothing can be done in a folder.
pub(super) fn not_begun(study: &str, folder: &Path) -> CasesError {
    CasesError::Scene(format!(
        "nothing of `tsubu {study}` is begun in {}: `tsubu {study} SCENE -o DIR --gather` makes a new folder",
        folder.display()
    ))
}

/// What a run needs.
#[derive(Clone, Copy, Debug)]
pub struct Need {
    /// Computing time on one thread of this machine [s].
    pub seconds: f64,
    /// Memory [bytes].
    pub bytes: f64,
}

/// What the longest of these runs needs, as `tsubu check` estimates it: by the grains and the simulated time the longest is
/// chosen, settled, and moved for a moment.
pub fn need(plans: &[(Plan, f64)]) -> Option<Need> {
    let work = |(plan, seconds): &&(Plan, f64)| (plan.grains() + 1) as f64 * seconds;
    let (plan, seconds) = plans.iter().max_by(|a, b| work(a).total_cmp(&work(b)))?;
    let begun = Instant::now();
    let engine = methods::open(plan, &Hosts::new(&plan.hosts)).ok()?;
    let before = begun.elapsed().as_secs_f64();
    let step = trial::step_cost(plan)?;
    Some(Need { seconds: before + seconds / engine.time_step() * step, bytes: memory::of(plan, engine.places()) })
}

/// How long to wait between two looks at a folder that somebody else holds.
const LOOK: Duration = Duration::from_millis(500);

/// Does what needs a folder as soon as nobody else holds it, unless that is interrupted; `locked` tells of an error whether somebody does.
pub fn unlocked<T, E>(
    interrupt: &Interrupt,
    locked: impl Fn(&E) -> bool,
    mut work: impl FnMut() -> Result<T, E>,
) -> Result<T, E> {
    loop {
        match work() {
            Err(error) if locked(&error) && !interrupt.asked() => std::thread::sleep(LOOK),
            done => return done,
        }
    }
}
