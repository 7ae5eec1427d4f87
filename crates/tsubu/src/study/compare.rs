//! One scene by several methods: what differs, and what each cost.

use crate::run::{self, RunError, Watcher};
use crate::scene_files;
use std::path::Path;
use tsubu_frame::{Cell, Existing, FileError, ResultValue, RunFolder, Status, Summary, Table, summary::write_json};
use tsubu_scene::plan::Method;
use tsubu_scene::{Complaints, Scene};

/// Why there is no comparison.
#[derive(Debug, thiserror::Error)]
pub enum CompareError {
    /// The scene is wrong under one of the methods.
    #[error("{0}")]
    Scene(Complaints),
    /// A run went wrong.
    #[error("method `{method}`: {error}")]
    Run {
        /// The method.
        method: &'static str,
        /// What went wrong.
        error: RunError,
    },
    /// A file or folder.
    #[error(transparent)]
    File(#[from] FileError),
}

/// Runs the scene by each method into a folder of its own below `folder`; writes `compare.csv`, `compare.json`.
pub fn compare(
    scene: &Scene,
    methods: &[Method],
    folder: &Path,
    existing: Existing,
    watcher: &Watcher,
) -> Result<Vec<Summary>, CompareError> {
    let mut scenes = Vec::new();
    for method in methods {
        let value = toml::Value::String(method.name().to_owned());
        scenes.push(scene.with(&[("method", &value)]).map_err(CompareError::Scene)?);
    }
    // A method that cannot run the scene must say so before the others have spent an hour on it.
    for (method, scene) in methods.iter().zip(&scenes) {
        let hosts = crate::partner::Hosts::new(&scene.plan().hosts);
        crate::engine::open(scene.plan(), &hosts)
            .map_err(|error| CompareError::Run { method: method.name(), error: error.into() })?;
    }
    let folder = RunFolder::create(folder, existing)?;
    let share = 1.0 / methods.len() as f64;
    let mut summaries = Vec::new();
    for (index, (method, scene)) in methods.iter().zip(&scenes).enumerate() {
        let progress = |done: f64| (watcher.progress)((index as f64 + done) * share);
        let watcher = Watcher { interrupted: watcher.interrupted, progress: &progress };
        let into = folder.path().join(method.name());
        let summary = run::run(scene, &into, Existing::Overwrite, &watcher)
            .map_err(|error| CompareError::Run { method: method.name(), error })?;
        if summary.status != Status::Finished {
            return Ok(vec![summary]);
        }
        summaries.push(summary);
    }
    scene_files::write(&folder, scene)?;
    table(methods, &summaries).write(&folder.file("compare.csv"))?;
    let names: Vec<&str> = methods.iter().map(|m| m.name()).collect();
    write_json(
        &folder.file("compare.json"),
        &serde_json::json!({ "methods": names, "tsubu_version": crate::VERSION }),
    )?;
    Ok(summaries)
}

/// One row a quantity, one column a method.
fn table(methods: &[Method], summaries: &[Summary]) -> Table {
    let header = ["quantity [text]".to_owned()].into_iter().chain(methods.iter().map(|m| format!("{} [SI]", m.name())));
    let mut table = Table::new(header);
    let mut row = |name: &str, values: &mut dyn Iterator<Item = f64>| {
        table.push([Cell::Text(name.to_owned())].into_iter().chain(values.map(Cell::Number)));
    };
    row("computing time s", &mut summaries.iter().map(|s| s.wall_seconds));
    row("time step s", &mut summaries.iter().map(|s| s.time_step));
    row("steps", &mut summaries.iter().map(|s| s.steps as f64));
    row("particle-steps per second", &mut summaries.iter().map(|s| s.particle_steps_per_second));
    row("mean contacts", &mut summaries.iter().map(|s| s.contacts_mean));
    let mut names: Vec<&str> = Vec::new();
    for summary in summaries {
        names.extend(summary.results.iter().map(|(name, _)| name));
    }
    names.dedup();
    let mut seen = Vec::new();
    for name in names {
        if seen.contains(&name) {
            continue;
        }
        seen.push(name);
        row(
            name,
            &mut summaries.iter().map(|s| match s.results.get(name) {
                Some(ResultValue::Number(value)) => *value,
                _ => f64::NAN,
            }),
        );
    }
    for (term, _) in summaries.first().map(|s| s.energy.terms.iter().collect::<Vec<_>>()).unwrap_or_default() {
        row(&format!("{term} J"), &mut summaries.iter().map(|s| s.energy.terms.get(term).map_or(f64::NAN, |j| j.0)));
    }
    row("energy residual, relative", &mut summaries.iter().map(|s| s.energy.residual_relative));
    table
}
