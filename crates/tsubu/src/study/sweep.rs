//! A parameter sweep: every case is a run of its own.

use super::cases::{Case, CasesError, cases};
use crate::engine;
use crate::partner::Hosts;
use crate::run::{self, Watcher};
use crate::scene_files;
use rayon::prelude::*;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use tsubu_frame::{Cell, Existing, ResultValue, RunFolder, Status, Summary, Table};
use tsubu_scene::Scene;

/// Runs every case of the scene's `[sweep]` into a folder of its own below `folder/cases`; finished cases are kept, cut
/// ones go on from their checkpoint. Writes `sweep.csv`.
pub fn sweep(scene: &Scene, folder: &Path, watcher: &Watcher) -> Result<Vec<Summary>, CasesError> {
    let wanted = scene.plan().sweep.as_ref().ok_or_else(|| {
        CasesError::Scene("the scene has no `[sweep]`: say what varies, for example `vary = { \"particles.balls.count\" = [10, 20] }`".to_owned())
    })?;
    let list = cases(&wanted.vary);
    // A case that its method refuses must say so before the others have run, and leave nothing behind.
    for case in &list {
        let scene = case.scene(scene).map_err(|c| CasesError::Scene(c.to_string()))?;
        let plan = super::unsettled(scene.plan());
        engine::open(&plan, &Hosts::new(&plan.hosts))
            .map_err(|error| CasesError::Run { case: case.name.clone(), error: error.into() })?;
    }
    let existing = if folder.join("cases").is_dir() { Existing::Resume } else { Existing::Refuse };
    let folder = RunFolder::create(folder, existing)?;
    scene_files::write(&folder, scene)?;
    let finished = AtomicUsize::new(0);
    let summaries: Vec<Option<Summary>> = list
        .par_iter()
        .enumerate()
        .map(|(index, case)| {
            if watcher.interrupted.load(Ordering::Relaxed) {
                return Ok(None);
            }
            let summary = one(scene, case, &folder.path().join("cases").join(format!("{index:04}")), watcher)?;
            let done = finished.fetch_add(1, Ordering::Relaxed) + 1;
            (watcher.progress)(done as f64 / list.len() as f64);
            Ok(Some(summary))
        })
        .collect::<Result<_, CasesError>>()?;
    let done: Vec<(&Case, &Summary)> =
        list.iter().zip(&summaries).filter_map(|(c, s)| Some((c, s.as_ref()?))).collect();
    table(&done).write(&folder.file("sweep.csv"))?;
    Ok(summaries.into_iter().flatten().collect())
}

fn one(scene: &Scene, case: &Case, folder: &Path, watcher: &Watcher) -> Result<Summary, CasesError> {
    let scene = case.scene(scene).map_err(|c| CasesError::Scene(c.to_string()))?;
    let same = std::fs::read_to_string(folder.join("scene.toml")).is_ok_and(|text| text == scene.resolved_toml());
    let earlier = Summary::read(&folder.join("summary.json")).ok().filter(|_| same);
    if let Some(summary) = earlier.filter(|s| s.status == Status::Finished) {
        return Ok(summary);
    }
    let cut = same && tsubu_frame::checkpoint::path(folder).exists();
    let existing = if cut { Existing::Resume } else { Existing::Overwrite };
    let quiet = Watcher { interrupted: watcher.interrupted, progress: &|_| {} };
    run::run(&scene, folder, existing, &quiet).map_err(|error| CasesError::Run { case: case.name.clone(), error })
}

/// One row a case: what varied, what it cost, what came out.
fn table(done: &[(&Case, &Summary)]) -> Table {
    let mut results: Vec<&str> = Vec::new();
    for (_, summary) in done {
        for (name, value) in summary.results.iter() {
            if matches!(value, ResultValue::Number(_)) && !results.contains(&name) {
                results.push(name);
            }
        }
    }
    let keys: Vec<&str> =
        done.first().map_or_else(Vec::new, |(case, _)| case.values.iter().map(|(k, _)| k.as_str()).collect());
    let header = ["case [text]".to_owned()]
        .into_iter()
        .chain(keys.iter().map(|k| format!("{k} [text]")))
        .chain(["wall seconds [s]".to_owned(), "energy residual [-]".to_owned()])
        .chain(results.iter().map(|r| format!("{r} [SI]")));
    let mut table = Table::new(header);
    for (case, summary) in done {
        let mut row = vec![Cell::Text(case.name.clone())];
        row.extend(
            case.values.iter().map(|(_, v)| Cell::Text(v.as_str().map_or_else(|| v.to_string(), str::to_owned))),
        );
        row.extend([Cell::Number(summary.wall_seconds), Cell::Number(summary.energy.residual_relative)]);
        row.extend(results.iter().map(|name| match summary.results.get(name) {
            Some(ResultValue::Number(value)) => Cell::Number(*value),
            _ => Cell::Number(f64::NAN),
        }));
        table.push(row);
    }
    table
}
