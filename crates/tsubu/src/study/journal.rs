//! What a study of many runs has done: every finished run is a line in `progress.jsonl`, so that one that was stopped goes on where
//! it was.

use crate::run::scene_hash;
use crate::scene_files;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use tsubu_frame::{Existing, FileError, RunFolder};
use tsubu_scene::Scene;

/// A number that is told from others exactly, so that it can be part of a key.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Exact(pub f64);

impl Ord for Exact {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl PartialOrd for Exact {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Exact {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Exact {}

/// First line of the journal: which scene it belongs to.
fn mark(resolved: &str) -> String {
    serde_json::json!({ "scene": scene_hash(resolved), "version": crate::VERSION }).to_string()
}

/// What an interrupted study of the same scene has done in the folder; `None` where a new one is to begin.
pub(super) fn earlier<K: Ord + DeserializeOwned, P: DeserializeOwned>(
    path: &Path,
    scene: &Scene,
    overwrite: bool,
) -> Result<Option<BTreeMap<K, P>>, FileError> {
    if overwrite {
        return Ok(None);
    }
    let text = std::fs::read_to_string(path.join("progress.jsonl")).unwrap_or_default();
    if text.lines().next() == Some(mark(&scene.resolved_toml()).as_str()) {
        // The last line may be cut in half; it is computed again.
        return Ok(Some(text.lines().skip(1).filter_map(|line| serde_json::from_str::<(K, P)>(line).ok()).collect()));
    }
    let occupied = std::fs::read_dir(path).is_ok_and(|mut entries| entries.next().is_some());
    if occupied { Err(FileError::NotEmpty { path: path.to_owned() }) } else { Ok(None) }
}

/// Makes the folder, or takes the one that an earlier study has begun. `tables` are the study's own files; those of its page come later.
pub(super) fn open_folder(
    path: &Path,
    begun: bool,
    scene: &Scene,
    overwrite: bool,
    tables: &[&str],
) -> Result<RunFolder, FileError> {
    let names = || -> Vec<String> {
        let own = tables.iter().chain(&["check.txt", "summary.json", "progress.jsonl"]);
        scene_files::names(scene).into_iter().chain(own.map(|name| (*name).to_owned())).collect()
    };
    if begun {
        return RunFolder::create(path, Existing::Resume, names());
    }
    let existing = if overwrite { Existing::Overwrite } else { Existing::Refuse };
    let folder = RunFolder::create(path, existing, names())?;
    scene_files::write(&folder, scene)?;
    folder.claim(names())?;
    folder.write("progress.jsonl", format!("{}\n", mark(&scene.resolved_toml())).as_bytes())?;
    Ok(folder)
}

/// The journal, to be written on.
pub(super) struct Journal {
    path: PathBuf,
    file: Mutex<File>,
}

impl Journal {
    /// Goes on with the journal of a folder.
    pub fn append(folder: &RunFolder) -> Result<Self, FileError> {
        let path = folder.file("progress.jsonl");
        let mut file = OpenOptions::new().append(true).open(&path).map_err(FileError::write(&path))?;
        // A line cut short by a kill must not swallow the next one.
        writeln!(file).map_err(FileError::write(&path))?;
        Ok(Self { path, file: Mutex::new(file) })
    }

    /// Writes a finished run down.
    pub fn record<K: Serialize, P: Serialize>(&self, key: &K, point: &P) -> Result<(), FileError> {
        if let Ok(mut file) = self.file.lock() {
            let line = serde_json::to_string(&(key, point)).unwrap_or_default();
            writeln!(file, "{line}").map_err(FileError::write(&self.path))?;
        }
        Ok(())
    }
}
