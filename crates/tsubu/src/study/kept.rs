//! Runs of a study, each in a folder of its own: what is finished is kept, what was cut short goes on, what another scene has left is not
//! touched.

use super::cases::{Case, CasesError};
use crate::engine::OpenError;
use crate::interrupt::Watcher;
use crate::run::{self, RunError, what_differs};
use crate::scene_files;
use std::path::Path;
use tsubu_frame::{Advise, Existing, FileError, RunFolder, Status, Summary, checkpoint};
use tsubu_scene::Scene;

/// What an earlier run of this scene has left in its folder.
pub(super) fn summary(scene: &Scene, folder: &Path) -> Option<Summary> {
    Summary::read(&folder.join("summary.json")).ok().filter(|_| is_of(scene, folder))
}

/// Whether the folder is of this scene. What else is varied in the sweep is nothing to a case.
pub(super) fn is_of(scene: &Scene, folder: &Path) -> bool {
    let alone = |text: &str| {
        let mut table: toml::Table = toml::from_str(text).ok()?;
        table.remove("sweep");
        Some(table)
    };
    let (there, here) = (std::fs::read_to_string(folder.join("scene.toml")), scene.resolved_toml());
    there.is_ok_and(|there| there == here || alone(&there).is_some_and(|there| Some(there) == alone(&here)))
}

/// Why a study of this scene cannot go on in a folder: what was begun there is of another. Keys that are `free` may differ.
pub(super) fn begun_by_another(scene: &Scene, folder: &Path, free: impl Fn(&str) -> bool) -> Option<String> {
    if is_of(scene, folder) {
        return None;
    }
    let there = std::fs::read_to_string(folder.join("scene.toml")).unwrap_or_default();
    let mut differences = scene.all_differences(&there);
    let any = !differences.is_empty();
    differences.retain(|difference| !difference.key.starts_with("sweep.") && !free(&difference.key));
    let told = || format!("the results in {} belong to another scene{}", folder.display(), what_differs(&differences));
    // Where nothing can be told of it, it is not ours.
    (!any || !differences.is_empty()).then(told)
}

/// Why this scene cannot be run into a folder: another has results there, or the checkpoint that it was cut at, or another version has.
pub(super) fn of_another(scene: &Scene, folder: &Path) -> Option<String> {
    let summary = Summary::read(&folder.join("summary.json")).ok();
    if !folder.join("summary.json").exists() && !checkpoint::path(folder).exists() {
        return None;
    }
    begun_by_another(scene, folder, |_| false).or_else(|| {
        let version = summary.map(|summary| summary.tsubu_version).filter(|version| version != crate::VERSION)?;
        let path = folder.display();
        Some(format!(
            "the results in {path} were written by tsubu {version}, this is tsubu {}: go on with the other",
            crate::VERSION
        ))
    })
}

/// Makes the run of a scene in its folder; one that is finished is kept, one that was cut goes on from its checkpoint. The folder of another
/// scene is not touched.
pub(super) fn go_on(
    scene: &Scene,
    folder: &Path,
    run: &dyn Fn(Existing) -> Result<Summary, RunError>,
) -> Result<Summary, RunError> {
    if let Some(why) = of_another(scene, folder) {
        return Err(RunError::NotThisScene(why));
    }
    let finished = || summary(scene, folder).filter(|summary| summary.status == Status::Finished);
    if let Some(summary) = finished() {
        return Ok(summary);
    }
    let existing = if checkpoint::path(folder).exists() { Existing::Resume } else { Existing::Overwrite };
    // Whoever worked at it may have ended, and taken its checkpoint away, between the look above and the run.
    run(existing).or_else(|error| finished().ok_or(error))
}

/// What an earlier run of this case has left in its folder.
pub(super) fn of_case(scene: &Scene, case: &Case, folder: &Path) -> Result<Option<Summary>, CasesError> {
    Ok(summary(&case.scene(scene).map_err(CasesError::Complaints)?, folder))
}

/// Runs a case into a folder of its own; one that is finished is kept, one that was cut goes on.
pub(super) fn one(scene: &Scene, case: &Case, folder: &Path, watcher: &Watcher) -> Result<Summary, CasesError> {
    let quiet = watcher.quiet();
    made(scene, case, folder, &|scene, folder, existing| run::one_of_many(scene, folder, existing, None, &quiet))
}

/// The same by those who make the run.
pub(super) fn made(
    scene: &Scene,
    case: &Case,
    folder: &Path,
    run: &dyn Fn(&Scene, &Path, Existing) -> Result<Summary, RunError>,
) -> Result<Summary, CasesError> {
    let scene = case.scene(scene).map_err(CasesError::Complaints)?;
    match go_on(&scene, folder, &|existing| run(&scene, folder, existing)) {
        Ok(summary) => Ok(summary),
        // One case that goes wrong leaves the others their results.
        Err(RunError::Fault(fault) | RunError::Open(OpenError::Settling(fault))) => {
            Ok(failed(&scene, folder, &fault.told())?)
        }
        Err(error) => Err(CasesError::Run { case: case.name.clone(), error }),
    }
}

/// What a case that went wrong has left; one whose grains would not settle has left nothing, and is written down here.
pub(super) fn failed(scene: &Scene, folder: &Path, fault: &str) -> Result<Summary, FileError> {
    let left = Summary::read(&folder.join("summary.json")).ok();
    let of_this = |s: &Summary| s.status == Status::Failed && s.warnings.last().is_some_and(|last| last == fault);
    if let Some(summary) = left.filter(of_this) {
        return Ok(summary);
    }
    let (status, warnings) = (Status::Failed, vec![fault.to_owned()]);
    let summary = Summary { tsubu_version: crate::VERSION.to_owned(), status, warnings, ..Summary::default() };
    let names: Vec<String> = scene_files::names(scene).into_iter().chain(["summary.json".to_owned()]).collect();
    let folder = RunFolder::create(folder, Existing::Overwrite, &names)?;
    scene_files::write(&folder, scene)?;
    folder.write_json("summary.json", &summary)?;
    folder.sync()?;
    Ok(summary)
}
