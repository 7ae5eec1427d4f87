//! What a response has done: every finished run is a line in `progress.jsonl`, so that one that was stopped goes on where it was.

use super::tasks::Point;
use crate::run::scene_hash;
use crate::scene_files;
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use tsubu_frame::{Existing, FileError, RunFolder};
use tsubu_scene::Scene;

/// One run of the response.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) struct Key {
    pub case: usize,
    pub seed: u32,
    pub ratio: Ratio,
}

/// A frequency over the natural frequency.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Ratio(pub f64);

impl Ord for Ratio {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl PartialOrd for Ratio {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Ratio {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Ratio {}

/// All that is measured.
pub(super) type Done = BTreeMap<Key, Point>;

/// First line of the journal: which scene it belongs to.
fn mark(resolved: &str) -> String {
    serde_json::json!({ "scene": scene_hash(resolved), "version": crate::VERSION }).to_string()
}

/// What an interrupted response of the same scene has done in the folder; `None` where a new one is to begin.
pub(super) fn earlier(path: &Path, resolved: &str, overwrite: bool) -> Result<Option<Done>, FileError> {
    if overwrite {
        return Ok(None);
    }
    let text = std::fs::read_to_string(path.join("progress.jsonl")).unwrap_or_default();
    if text.lines().next() == Some(mark(resolved).as_str()) {
        // The last line may be cut in half; it is computed again.
        return Ok(Some(text.lines().skip(1).filter_map(|l| serde_json::from_str::<(Key, Point)>(l).ok()).collect()));
    }
    let occupied = std::fs::read_dir(path).is_ok_and(|mut entries| entries.next().is_some());
    if occupied { Err(FileError::NotEmpty { path: path.to_owned() }) } else { Ok(None) }
}

/// Makes the folder, or takes the one that an earlier response has begun.
pub(super) fn open_folder(path: &Path, begun: bool, scene: &Scene, overwrite: bool) -> Result<RunFolder, FileError> {
    if begun {
        return RunFolder::create(path, Existing::Resume, names(scene));
    }
    let existing = if overwrite { Existing::Overwrite } else { Existing::Refuse };
    let folder = RunFolder::create(path, existing, names(scene))?;
    scene_files::write(&folder, scene)?;
    folder.claim(names(scene))?;
    folder.write("progress.jsonl", format!("{}\n", mark(&scene.resolved_toml())).as_bytes())?;
    Ok(folder)
}

/// The files of a response; those of its page come later.
fn names(scene: &Scene) -> Vec<String> {
    let tables = ["response.csv", "cases.csv", "energy_by_cause.csv"];
    let own = tables.into_iter().chain(["check.txt", "summary.json", "progress.jsonl", "frames/"]);
    scene_files::names(scene).into_iter().chain(own.map(str::to_owned)).collect()
}

/// The journal, to be written on.
pub(super) fn append(folder: &RunFolder) -> Result<File, FileError> {
    let path: PathBuf = folder.file("progress.jsonl");
    let mut file = OpenOptions::new().append(true).open(&path).map_err(FileError::write(&path))?;
    // A line cut short by a kill must not swallow the next one.
    writeln!(file).map_err(FileError::write(&path))?;
    Ok(file)
}
