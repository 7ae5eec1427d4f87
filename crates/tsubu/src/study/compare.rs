//! One scene by several methods, or by variants of them: what differs, and what each cost.

use super::kept;
use super::variant::Variant;
use crate::engine::OpenError;
use crate::interrupt::Watcher;
use crate::methods;
use crate::partner::Hosts;
use crate::run::{self, RunError};
use crate::scene_files;
use crate::trial;
use serde::Serialize;
use std::collections::BTreeSet;
use std::fmt;
use std::path::Path;
use tsubu_frame::{Cell, Existing, FileError, ResultValue, RunFolder, Status, Summary, Table};
use tsubu_scene::{Complaints, Scene};

/// Why there is no comparison.
#[derive(Debug, thiserror::Error)]
pub enum CompareError {
    /// The scene is wrong under one of the methods.
    #[error("{0}")]
    Scene(Complaints),
    /// None of the methods can run the scene.
    #[error("none of these methods can run the scene\n{}", .0.iter().map(ToString::to_string).collect::<String>().trim_end())]
    Nobody(Vec<Refused>),
    /// What is in the folder is of another scene.
    #[error("{0}")]
    NotThisScene(String),
    /// A run went wrong.
    #[error("method `{method}`: {error}")]
    Run {
        /// Its name.
        method: String,
        /// What went wrong.
        error: RunError,
    },
    /// A file or folder.
    #[error(transparent)]
    File(#[from] FileError),
}

/// A comparison that came to its end, or was interrupted: then the last summary says so.
#[derive(Debug, Default)]
pub struct Comparison {
    /// Who ran, with what came of it.
    pub done: Vec<(Variant, Summary)>,
    /// Who cannot run the scene.
    pub refused: Vec<Refused>,
}

/// A method that cannot run the scene.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Refused {
    /// Its name.
    pub method: String,
    /// Key of the scene and why not, for each that it refuses.
    pub because: Vec<(String, String)>,
}

impl fmt::Display for Refused {
    /// A line a reason.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.because.iter().try_for_each(|(key, why)| writeln!(f, "{} cannot run it: {key}: {why}", self.method))
    }
}

/// What tells who is compared, and that a folder is one of a comparison.
const FILE: &str = "compare.json";

/// Runs the scene by each variant into a folder of its own below `folder`; writes `compare.csv`, `compare.json`. In a folder where a comparison
/// was begun finished runs are kept, and one that was cut goes on from its checkpoint.
pub fn compare(
    scene: &Scene,
    variants: &[Variant],
    folder: &Path,
    overwrite: bool,
    watcher: &Watcher,
) -> Result<Comparison, CompareError> {
    // A method that cannot run the scene must say so before the others have spent an hour on it.
    let (scenes, refused) = scenes(scene, variants)?;
    if scenes.is_empty() {
        return Err(CompareError::Nobody(refused));
    }
    let existing = match folder.join(FILE).is_file() {
        _ if overwrite => Existing::Overwrite,
        true => Existing::Resume,
        false => Existing::Refuse,
    };
    if existing == Existing::Resume {
        let of_all = kept::begun_by_another(scene, folder, |_| false);
        let of_one = || scenes.iter().find_map(|(one, scene)| kept::of_another(scene, &folder.join(&one.name)));
        if let Some(why) = of_all.or_else(of_one) {
            return Err(CompareError::NotThisScene(why));
        }
    }
    let own = ["compare.csv", FILE].into_iter().map(str::to_owned);
    let runs = scenes.iter().map(|(variant, _)| format!("{}/", variant.name));
    let names: Vec<String> = scene_files::names(scene).into_iter().chain(own).chain(runs).collect();
    let folder = RunFolder::create(folder, existing, &names)?;
    folder.claim(&names)?;
    scene_files::write(&folder, scene)?;
    let names: Vec<&str> = scenes.iter().map(|(variant, _)| variant.name.as_str()).collect();
    let told = serde_json::json!({ "methods": names, "refused": refused, "tsubu_version": crate::VERSION });
    folder.write_json(FILE, &told)?;
    folder.sync()?;
    let share = 1.0 / scenes.len() as f64;
    let mut done: Vec<(Variant, Summary)> = Vec::new();
    for (index, (variant, scene)) in scenes.into_iter().enumerate() {
        let progress = |done: f64| (watcher.progress)((index as f64 + done) * share);
        let watcher = Watcher { interrupt: watcher.interrupt, progress: &progress };
        let into = folder.path().join(&variant.name);
        let summary = kept::go_on(&scene, &into, &|existing| run::run(&scene, &into, existing, &watcher))
            .map_err(|error| CompareError::Run { method: variant.name.clone(), error })?;
        let finished = summary.status == Status::Finished;
        done.push((variant, summary));
        // Whatever comes next, what is there is told.
        folder.write("compare.csv", table(&done).to_csv().as_bytes())?;
        if !finished {
            break;
        }
    }
    folder.sync()?;
    Ok(Comparison { done, refused })
}

/// Who can run a scene, and the scene as each of them runs it.
pub type Runners = Vec<(Variant, Scene)>;

/// The scene as each variant runs it, and who cannot.
pub fn scenes(scene: &Scene, variants: &[Variant]) -> Result<(Runners, Vec<Refused>), CompareError> {
    let mut scenes = Vec::new();
    let mut refused = Vec::new();
    for variant in variants {
        let method = [format!("method={}", variant.method.name())];
        let scene = scene.changed(method.iter().chain(&variant.changes)).map_err(CompareError::Scene)?;
        let plan = trial::unsettled(scene.plan());
        match methods::open(&plan, &Hosts::new(&plan.hosts)) {
            Ok(engine) => {
                run::steps(&plan, &*engine)
                    .map_err(|error| CompareError::Run { method: variant.name.clone(), error })?;
                scenes.push((variant.clone(), scene));
            }
            Err(OpenError::Refused(refusal)) if variant.may_refuse => {
                let because = refusal.notes.into_iter().map(|note| (note.key, note.text)).collect();
                refused.push(Refused { method: variant.name.clone(), because });
            }
            Err(error) => return Err(CompareError::Run { method: variant.name.clone(), error: error.into() }),
        }
    }
    Ok((scenes, refused))
}

/// One row a quantity with its unit, one column a method.
fn table(done: &[(Variant, Summary)]) -> Table {
    let summaries: Vec<&Summary> = done.iter().map(|(_, summary)| summary).collect();
    let names = done.iter().map(|(variant, _)| variant.name.clone());
    let header = ["quantity [text]", "unit [text]"].map(str::to_owned).into_iter().chain(names);
    let mut table = Table::new(header);
    let mut row = |name: &str, unit: &str, value: &dyn Fn(&Summary) -> f64| {
        let values = summaries.iter().map(|summary| Cell::Number(value(summary)));
        table.push([name, unit].map(|text| Cell::Text(text.to_owned())).into_iter().chain(values));
    };
    row("computing time", "s", &|s| s.wall_seconds);
    row("time step", "s", &|s| s.time_step);
    row("steps", "-", &|s| s.steps as f64);
    row("particle-steps per second", "1/s", &|s| s.particle_steps_per_second);
    row("mean contacts", "-", &|s| s.contacts_mean);
    let mut seen = BTreeSet::new();
    for summary in &summaries {
        for (name, _) in summary.results.iter().filter(|(name, _)| seen.insert((*name).to_owned())) {
            row(name, summary.unit(name), &|s| match s.results.get(name) {
                Some(ResultValue::Number(value)) => *value,
                _ => f64::NAN,
            });
        }
    }
    for (term, _) in summaries.first().iter().flat_map(|summary| summary.energy.terms.iter()) {
        row(term, "J", &|s| s.energy.terms.get(term).map_or(f64::NAN, |joule| joule.0));
    }
    row("energy residual, relative", "-", &|s| s.energy.residual_relative);
    table
}
