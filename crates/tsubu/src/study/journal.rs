//! What a study of many runs has done: every finished run is a line in `progress.jsonl`, so that one that was stopped goes on where
//! it was.
//!
//! Runs that are done apart, by processes of their own, are lines of files of their own in `progress/`, for files that several
//! machines lengthen are not whole on every disk. There a run that failed is a line too.

use super::cases::CasesError;
use crate::run::{scene_hash, what_differs};
use crate::scene_files;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, TryLockError};
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

/// First line of the journal: which scene it belongs to, and who wrote it.
#[derive(Serialize, Deserialize)]
struct Mark {
    scene: String,
    version: String,
}

fn mark(resolved: &str) -> String {
    let mark = Mark { scene: scene_hash(resolved), version: crate::VERSION.to_owned() };
    // Two texts make JSON in any case.
    serde_json::to_string(&mark).unwrap_or_default()
}

/// The folder of what is done apart.
const PARTS: &str = "progress";

/// The lines behind the first that say this of a run.
fn lines<K: DeserializeOwned, P: DeserializeOwned>(text: &str) -> Vec<(K, P)> {
    text.lines().skip(1).filter_map(|line| serde_json::from_str(line).ok()).collect()
}

/// The files of what was done apart of the scene with this mark, and their texts.
fn parts(path: &Path, mark: &str) -> Vec<(PathBuf, String)> {
    let entries = std::fs::read_dir(path.join(PARTS)).into_iter().flatten().flatten();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    files.sort();
    let texts = files.into_iter().filter_map(|file| std::fs::read_to_string(&file).ok().map(|text| (file, text)));
    texts.filter(|(_, text)| text.lines().next() == Some(mark)).collect()
}

/// What runs that were done apart and failed have said.
pub(super) fn lost<K: Ord + DeserializeOwned>(path: &Path, scene: &Scene) -> BTreeMap<K, String> {
    let texts = parts(path, &mark(&scene.resolved_toml()));
    texts.iter().flat_map(|(_, text)| lines::<K, Lost>(text)).map(|(key, lost)| (key, lost.failed)).collect()
}

/// Puts what was done apart of this scene into the one journal, and forgets what failed: it is to be tried again.
pub(super) fn collect<K, P>(folder: &RunFolder, scene: &Scene) -> Result<(), FileError>
where
    K: Serialize + DeserializeOwned,
    P: Serialize + DeserializeOwned,
{
    let journal = Journal::append(folder)?;
    for (file, _) in parts(folder.path(), &mark(&scene.resolved_toml())) {
        let part = OpenOptions::new().read(true).append(true).open(&file).map_err(FileError::write(&file))?;
        // A worker that its cluster has given up may still be writing: what it leaves is read where it stands.
        if let Err(TryLockError::WouldBlock) = part.try_lock() {
            continue;
        }
        let text = std::fs::read_to_string(&file).map_err(FileError::read(&file))?;
        for (key, point) in lines::<K, P>(&text) {
            journal.record(&key, &point)?;
        }
        std::fs::remove_file(&file).map_err(FileError::write(&file))?;
    }
    Ok(())
}

/// Why a run has no point.
#[derive(Serialize, Deserialize)]
struct Lost {
    failed: String,
}

/// What an interrupted study of the same scene has done in the folder; `None` where a new one is to begin.
pub(super) fn earlier<K: Ord + DeserializeOwned, P: DeserializeOwned>(
    path: &Path,
    scene: &Scene,
    overwrite: bool,
) -> Result<Option<BTreeMap<K, P>>, CasesError> {
    if overwrite {
        return Ok(None);
    }
    let text = std::fs::read_to_string(path.join("progress.jsonl")).unwrap_or_default();
    let mark = mark(&scene.resolved_toml());
    if text.lines().next() == Some(mark.as_str()) {
        // The last line may be cut in half; it is computed again.
        let of_all = [text].into_iter().chain(parts(path, &mark).into_iter().map(|(_, text)| text));
        return Ok(Some(of_all.flat_map(|text| lines(&text)).collect()));
    }
    if let Some(Ok(mark)) = text.lines().next().map(serde_json::from_str::<Mark>) {
        return Err(of_another(path, scene, &mark));
    }
    let occupied = std::fs::read_dir(path).is_ok_and(|mut entries| entries.next().is_some());
    if occupied { Err(FileError::NotEmpty { path: path.to_owned() }.into()) } else { Ok(None) }
}

/// Why a study cannot go on in a folder with the journal of another.
fn of_another(path: &Path, scene: &Scene, mark: &Mark) -> CasesError {
    let why = if mark.version == crate::VERSION {
        let earlier = std::fs::read_to_string(path.join("scene.toml")).unwrap_or_default();
        format!("belong to another scene{}", what_differs(&scene.all_differences(&earlier)))
    } else {
        format!("were written by tsubu {}, this is tsubu {}: go on with the other", mark.version, crate::VERSION)
    };
    CasesError::NotThisScene(format!("the results in {} {why}", path.display()))
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
    for (file, _) in parts(path, &mark(&scene.resolved_toml())) {
        std::fs::remove_file(&file).map_err(FileError::write(&file))?;
    }
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

    /// The journal of runs that are done apart, of the process that begins with the run `name`; nobody else writes it while this lives.
    pub fn apart(folder: &Path, name: &str, scene: &Scene) -> Result<Self, FileError> {
        let path = folder.join(PARTS).join(format!("{name}.jsonl"));
        let parts = folder.join(PARTS);
        std::fs::create_dir_all(&parts).map_err(FileError::write(&parts))?;
        let open = OpenOptions::new().create(true).read(true).append(true).open(&path);
        let mut file = open.map_err(FileError::write(&path))?;
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            return Err(FileError::Locked { path });
        }
        let mark = mark(&scene.resolved_toml());
        let known = std::fs::read_to_string(&path).is_ok_and(|text| text.lines().next() == Some(mark.as_str()));
        let head = if known { Ok(()) } else { file.set_len(0).and_then(|()| write!(file, "{mark}")) };
        head.and_then(|()| writeln!(file)).map_err(FileError::write(&path))?;
        Ok(Self { path, file: Mutex::new(file) })
    }

    /// Writes down why a run has no point.
    pub fn lose<K: Serialize>(&self, key: &K, failed: &str) -> Result<(), FileError> {
        self.record(key, &Lost { failed: failed.to_owned() })
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
