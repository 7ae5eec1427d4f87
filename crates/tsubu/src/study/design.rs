//! A design: which of many candidates gives the lowest response, within limits.
//!
//! Candidates are searched with few runs each ([`Answer`]) where a Gaussian process expects them to be better than the best (Jones,
//! Schonlau and Welch 1998), then far from all that were measured. The best and its neighbours are confirmed with several seeds, until the
//! best is none of its neighbours and nowhere on its whole curve higher. A design that was stopped goes on where it was.

mod answer;
mod apart;
mod candidates;
mod cheap;
mod continuous;
mod known;
mod limits;
mod search;
mod space;
mod work;
mod write;

pub use answer::Answer;
pub use apart::runs;

use super::cases::CasesError;
use super::journal::{Exact, Journal, Place};
use super::journaled;
use super::response::{Point, tasks};
use crate::interrupt::{Interrupt, Watcher};
use crate::methods;
use crate::partner::Hosts;
use crate::trial::unsettled;
use candidates::{Candidates, MOST};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;
use std::time::Instant;
use tsubu_frame::{Status, Summary};
use tsubu_scene::plan::{self, Method};
use tsubu_scene::{Plan, Scene};
use work::Work;

/// What a design writes beside what every study writes.
const FILES: [&str; 4] = ["design.csv", "steps.csv", "curves.csv", "best.toml"];

/// What is measured of a candidate: its answer at one level of the drive, or a point of its curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
struct Key {
    /// Which candidate; one after the last is the scene as it is written.
    candidate: usize,
    /// Which level of the drive.
    level: usize,
    seed: u32,
    /// Of a point of a curve, its frequency over the natural frequency.
    ratio: Option<Exact>,
    /// Whether it is measured by the cheap method.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    cheap: bool,
}

impl Key {
    /// The bed it begins from.
    fn bed(&self) -> Self {
        Self { ratio: None, ..*self }
    }
}

/// What came of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum Measured {
    Answer(Answer),
    Point(Box<Point>),
}

impl Measured {
    fn rms(&self) -> f64 {
        match self {
            Self::Answer(answer) => answer.rms,
            Self::Point(point) => point.rms,
        }
    }

    /// Largest displacement [m].
    fn stroke(&self) -> f64 {
        match self {
            Self::Answer(answer) => answer.stroke,
            Self::Point(point) => point.peak,
        }
    }

    /// Computing time of a run in the mean [s].
    fn wall_of_run(&self) -> f64 {
        match self {
            Self::Answer(answer) => answer.wall / f64::from(answer.runs.max(1)),
            Self::Point(point) => point.wall,
        }
    }

    /// Runs that it took.
    fn runs(&self) -> u32 {
        match self {
            Self::Answer(answer) => answer.runs,
            Self::Point(_) => 1,
        }
    }

    /// Largest energy residual [-].
    fn residual(&self) -> f64 {
        match self {
            Self::Answer(answer) => answer.residual,
            Self::Point(point) => point.residual.abs(),
        }
    }
}

/// All that is measured.
type Done = BTreeMap<Key, Measured>;

/// Designs within `folder`. An existing folder of the same scene is gone on with.
pub fn design(scene: &Scene, folder: &Path, overwrite: bool, watcher: &Watcher) -> Result<Summary, CasesError> {
    let begun = Instant::now();
    let task = Task::new(scene)?;
    let place = Place { study: "design", scene, folder };
    let earlier: Option<Done> = place.earlier(overwrite)?;
    let before = earlier.as_ref().and_then(|_| Summary::read(&folder.join("summary.json")).ok());
    let before = before.map_or(0.0, |summary| summary.wall_seconds);
    // A scene that its method refuses leaves nothing behind.
    methods::open(&unsettled(scene.plan()), &Hosts::new(&scene.plan().hosts))?;
    let folder = place.open(earlier.is_some(), overwrite, &FILES)?;
    let journal = Journal::append(&folder)?;
    let record = |key: &Key, measured: &Measured| journal.record(key, measured);
    let mut work = Work::new(&task, earlier.unwrap_or_default(), &record, watcher);
    let found = work.design()?;
    let status = match &found {
        _ if watcher.interrupt.asked() => Status::Interrupted,
        Some(_) => Status::Finished,
        None => Status::Failed,
    };
    let _held = watcher.interrupt.hold();
    let took = before + begun.elapsed().as_secs_f64();
    Ok(write::write(&folder, scene, &work, found.as_ref(), status, took)?)
}

/// The best of a scene's candidates with what it does, without any file.
pub fn best(scene: &Scene) -> Result<Option<(String, Standing)>, CasesError> {
    let task = Task::new(scene)?;
    let watcher = Watcher { interrupt: &Interrupt::new(), progress: &|_| {} };
    let mut work = Work::new(&task, Done::new(), &|_, _| Ok(()), &watcher);
    let found = work.design()?;
    Ok(found.and_then(|found| Some((task.name(found.best), work.standing(found.best)?))))
}

/// Hears of everything that is measured.
type Record<'a> = journaled::Record<'a, Key, Measured>;

/// What is to be designed.
struct Task<'a> {
    wanted: plan::Design,
    reference: f64,
    candidates: Candidates,
    /// As it is written.
    scene: &'a Scene,
}

impl<'a> Task<'a> {
    fn new(scene: &'a Scene) -> Result<Self, CasesError> {
        let plan = scene.plan();
        let (Some(mut wanted), Some(response)) = (plan.design.clone(), &plan.response) else {
            return Err(CasesError::Scene(
                "the scene has no `[design]`: say what may vary, for example `vary = { \"particles.balls.count\" = [10, 30, 50] }`"
                    .to_owned(),
            ));
        };
        if scene.plans().len() > 1 {
            return Err(CasesError::Scene("a design is of a scene of one stage: leave `[[stage]]` out".to_owned()));
        }
        let reference = tasks::reference_frequency(plan, &response.host).map_err(CasesError::Scene)?;
        let strides = continuous::lay_out(&mut wanted.vary).map_err(CasesError::Scene)?;
        let number: usize = wanted.vary.values().map(Vec::len).product();
        if number < 2 {
            return Err(CasesError::Scene(
                "`design.vary` leaves nothing to choose from: list two values of a key, or more".to_owned(),
            ));
        }
        if number > MOST {
            return Err(CasesError::Scene(format!(
                "`design.vary` has {number} combinations, more than the {MOST} that are looked through: list fewer values"
            )));
        }
        let candidates = Candidates::new(scene, &wanted, strides);
        if candidates.list.is_empty() {
            return Err(CasesError::Scene(candidates.none(number)));
        }
        let task = Self { wanted, reference, candidates, scene };
        task.check_cheap()?;
        Ok(task)
    }

    /// The cheap method is another one than the scene's, and can run the scene.
    fn check_cheap(&self) -> Result<(), CasesError> {
        let Some(method) = self.wanted.cheap else { return Ok(()) };
        let name = method.name();
        if self.scene.plan().method == method {
            return Err(CasesError::Scene(format!(
                "`design.cheap` = \"{name}\" is the method of the scene itself: leave it out, or set `method = \"dem\"`"
            )));
        }
        let plan = self.cheap_plan(self.as_written(), method);
        match methods::open(&unsettled(&plan), &Hosts::new(&plan.hosts)) {
            Ok(_) => Ok(()),
            Err(error) => Err(CasesError::Scene(format!(
                "`design.cheap` = \"{name}\" cannot run this scene, and tells nothing of it: {}; leave it out",
                error.to_string().trim_end()
            ))),
        }
    }

    fn plan(&self, candidate: usize) -> &Plan {
        self.candidates.list.get(candidate).map_or_else(|| self.scene.plan(), |one| &one.plan)
    }

    /// A candidate by the cheap method; as it is where that does not read it, which the method is then told.
    fn cheap_plan(&self, candidate: usize, method: Method) -> Plan {
        let method = toml::Value::from(method.name());
        let values = self.candidates.list.get(candidate).map_or(&[][..], |one| &one.case.values);
        let changes = values.iter().map(|(key, value)| (key.as_str(), value)).chain([("method", &method)]);
        let scene = self.scene.with(&changes.collect::<Vec<_>>());
        scene.map_or_else(|_| self.plan(candidate).clone(), |scene| scene.plan().clone())
    }

    /// The plan that a key is measured with, its drive as strong as the level says.
    fn driven(&self, key: &Key) -> Plan {
        let mut plan = match self.wanted.cheap {
            Some(method) if key.cheap => self.cheap_plan(key.candidate, method),
            _ => self.plan(key.candidate).clone(),
        };
        let host = plan.response.as_ref().and_then(|response| plan.hosts.get_mut(&response.host));
        let signals = host.into_iter().flat_map(|host| [&mut host.base, &mut host.force]);
        for signal in signals.flatten() {
            if let plan::Signal::Sine { amplitude, .. } = signal {
                *amplitude *= self.wanted.levels[key.level];
            }
        }
        plan
    }

    fn name(&self, candidate: usize) -> String {
        self.candidates.list.get(candidate).map_or_else(|| "as written".to_owned(), |one| one.case.name.clone())
    }

    fn as_written(&self) -> usize {
        self.candidates.list.len()
    }
}

/// What is known of a candidate, over its seeds.
#[derive(Clone, Debug, PartialEq)]
pub struct Standing {
    /// What is to be low [m]: the mean over the seeds.
    pub rms: f64,
    /// 95 % interval of that mean [m]; nothing with one seed, or where all seeds give the same.
    pub interval: Option<[f64; 2]>,
    /// Largest displacement over levels and seeds [m].
    pub stroke: f64,
    /// Where its peak is, over the natural frequency, in the mean over levels and seeds [-].
    pub ratio: f64,
    /// Seeds.
    pub seeds: usize,
    /// Runs that it took.
    pub runs: u32,
    /// Whether its peak was found in all of them.
    pub found: bool,
}
