//! A parameter sweep: every case is a run of its own.

use super::cases::{Case, CasesError, cases, value_text};
use crate::interrupt::Watcher;
use crate::methods;
use crate::partner::Hosts;
use crate::run::{self, RunError};
use crate::scene_files;
use crate::trial;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;
use tsubu_frame::summary::read_json;
use tsubu_frame::{Advise, Cell, Existing, ResultValue, RunFolder, Status, Summary, Table};
use tsubu_scene::Scene;

/// What a sweep took as a whole, interruptions left out: its cases run side by side, their times add up to more.
#[derive(Debug, Serialize, Deserialize)]
struct Took {
    /// By the clock on the wall [s].
    wall_seconds: f64,
    /// Cases that ran side by side.
    jobs: usize,
}

/// Runs every case of the scene's `[sweep]` into a folder of its own below `folder/cases`; finished cases are kept, cut
/// ones go on from their checkpoint; one that goes wrong says so in its row. Writes `sweep.csv`, and `sweep.json` with what
/// it took.
pub fn sweep(scene: &Scene, folder: &Path, overwrite: bool, watcher: &Watcher) -> Result<Vec<Summary>, CasesError> {
    let wanted = scene.plan().sweep.as_ref().ok_or_else(|| {
        CasesError::Scene("the scene has no `[sweep]`: say what varies, for example `vary = { \"particles.balls.count\" = [10, 20] }`".to_owned())
    })?;
    let list = cases(&wanted.vary);
    // A case that its method refuses must say so before the others have run, and leave nothing behind.
    for case in &list {
        let scene = case.scene(scene).map_err(CasesError::Complaints)?;
        let plan = trial::unsettled(scene.plan());
        let open = methods::open(&plan, &Hosts::new(&plan.hosts)).map_err(RunError::from);
        open.and_then(|engine| run::steps(&plan, &*engine))
            .map_err(|error| CasesError::Run { case: case.name.clone(), error })?;
    }
    let existing = match folder.join("cases").is_dir() {
        _ if overwrite => Existing::Overwrite,
        true => Existing::Resume,
        false => Existing::Refuse,
    };
    let names = scene_files::names(scene).into_iter().chain(["sweep.csv", "sweep.json", CASES].map(str::to_owned));
    let names: Vec<String> = names.collect();
    let folder = RunFolder::create(folder, existing, &names)?;
    folder.claim(&names)?;
    scene_files::write(&folder, scene)?;
    let begun = Instant::now();
    let finished = AtomicUsize::new(0);
    let summaries: Vec<Option<Summary>> = list
        .par_iter()
        .enumerate()
        .map(|(index, case)| {
            if watcher.interrupt.asked() {
                return Ok(None);
            }
            let summary = one(scene, case, &folder.file(CASES).join(format!("{index:04}")), watcher)?;
            let done = finished.fetch_add(1, Ordering::Relaxed) + 1;
            (watcher.progress)(done as f64 / list.len() as f64);
            Ok(Some(summary))
        })
        .collect::<Result<_, CasesError>>()?;
    let done: Vec<(&Case, &Summary)> =
        list.iter().zip(&summaries).filter_map(|(c, s)| Some((c, s.as_ref()?))).collect();
    folder.write("sweep.csv", table(&done).to_csv().as_bytes())?;
    let earlier = read_json::<Took>(&folder.file("sweep.json")).map_or(0.0, |took| took.wall_seconds);
    let wall_seconds = earlier + begun.elapsed().as_secs_f64();
    folder.write_json("sweep.json", &Took { wall_seconds, jobs: rayon::current_num_threads() })?;
    folder.sync()?;
    Ok(summaries.into_iter().flatten().collect())
}

/// The folder of the cases' folders.
const CASES: &str = "cases/";

/// Runs a case into a folder of its own; one that is finished is kept, one that was cut goes on.
pub(super) fn one(scene: &Scene, case: &Case, folder: &Path, watcher: &Watcher) -> Result<Summary, CasesError> {
    let scene = case.scene(scene).map_err(CasesError::Complaints)?;
    let same = std::fs::read_to_string(folder.join("scene.toml")).is_ok_and(|text| text == scene.resolved_toml());
    let earlier = Summary::read(&folder.join("summary.json")).ok().filter(|_| same);
    if let Some(summary) = earlier.filter(|s| s.status == Status::Finished) {
        return Ok(summary);
    }
    let cut = same && tsubu_frame::checkpoint::path(folder).exists();
    let existing = if cut { Existing::Resume } else { Existing::Overwrite };
    let quiet = Watcher { interrupt: watcher.interrupt, progress: &|_| {} };
    match run::run_with(&scene, folder, existing, false, &quiet) {
        Ok(summary) => Ok(summary),
        // One case that goes wrong leaves the others their results.
        Err(RunError::Fault(fault)) => Ok(failed(folder, &fault.told())),
        Err(error) => Err(CasesError::Run { case: case.name.clone(), error }),
    }
}

/// What a case that went wrong has left; one whose grains would not settle leaves nothing.
fn failed(folder: &Path, fault: &str) -> Summary {
    let left = Summary::read(&folder.join("summary.json")).ok();
    let of_this = |s: &Summary| s.status == Status::Failed && s.warnings.last().is_some_and(|last| last == fault);
    left.filter(of_this).unwrap_or_else(|| Summary {
        status: Status::Failed,
        warnings: vec![fault.to_owned()],
        ..Summary::default()
    })
}

/// One row a case: what varied, how it ended, what it cost, what came out, what is to be noted of it alone.
fn table(done: &[(&Case, &Summary)]) -> Table {
    let mut results: Vec<(&str, &str)> = Vec::new();
    for (_, summary) in done {
        for (name, value) in summary.results_in_order() {
            if matches!(value, ResultValue::Number(_)) && !results.iter().any(|(known, _)| *known == name) {
                results.push((name, summary.unit(name)));
            }
        }
    }
    let keys: Vec<&str> =
        done.first().map_or_else(Vec::new, |(case, _)| case.values.iter().map(|(k, _)| k.as_str()).collect());
    let header = ["case [text]".to_owned()]
        .into_iter()
        .chain(keys.iter().map(|k| format!("{k} [text]")))
        .chain(["status [text]", "wall seconds [s]", "energy residual [-]"].map(str::to_owned))
        .chain(results.iter().map(|(name, unit)| format!("{name} [{unit}]")))
        .chain(["remark [text]".to_owned()]);
    let mut table = Table::new(header);
    for (case, summary) in done {
        let mut row = vec![Cell::Text(case.name.clone())];
        row.extend(case.values.iter().map(|(_, v)| Cell::Text(value_text(v))));
        row.push(summary.status.word().into());
        row.extend([Cell::Number(summary.wall_seconds), Cell::Number(summary.energy.residual_relative)]);
        row.extend(results.iter().map(|(name, _)| match summary.results.get(name) {
            Some(ResultValue::Number(value)) => Cell::Number(*value),
            _ => Cell::Number(f64::NAN),
        }));
        row.push(Cell::Text(remark(summary, done)));
        table.push(row);
    }
    table
}

/// Warnings of a case that not every case has: what the method says of the scene belongs to all of them.
fn remark(summary: &Summary, done: &[(&Case, &Summary)]) -> String {
    let common = |warning: &String| done.len() > 1 && done.iter().all(|(_, other)| other.warnings.contains(warning));
    let own = summary.warnings.iter().filter(|warning| !common(warning));
    own.filter_map(|warning| warning.lines().next()).collect::<Vec<_>>().join("; ")
}
