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

/// First line of the journal: which study of which scene it belongs to, and who wrote it.
#[derive(Serialize, Deserialize)]
struct Mark {
    study: String,
    scene: String,
    version: String,
}

/// The folder of what is done apart.
const PARTS: &str = "progress";

/// The lines behind the first that say this of a run.
fn lines<K: DeserializeOwned, P: DeserializeOwned>(text: &str) -> Vec<(K, P)> {
    text.lines().skip(1).filter_map(|line| serde_json::from_str(line).ok()).collect()
}

/// Why a run has no point.
#[derive(Serialize, Deserialize)]
struct Lost {
    failed: String,
}

/// Where a study of a scene keeps its journal.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    /// The command that does it.
    pub study: &'static str,
    pub scene: &'a Scene,
    pub folder: &'a Path,
}

impl Place<'_> {
    fn mark(self) -> String {
        let scene = scene_hash(&self.scene.resolved_toml());
        let mark = Mark { study: self.study.to_owned(), scene, version: crate::VERSION.to_owned() };
        // Three texts make JSON in any case.
        serde_json::to_string(&mark).unwrap_or_default()
    }

    /// The files of what was done apart, and their texts.
    fn parts(self) -> Vec<(PathBuf, String)> {
        let mark = self.mark();
        let entries = std::fs::read_dir(self.folder.join(PARTS)).into_iter().flatten().flatten();
        let mut files: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
        files.sort();
        let texts = files.into_iter().filter_map(|file| std::fs::read_to_string(&file).ok().map(|text| (file, text)));
        texts.filter(|(_, text)| text.lines().next() == Some(&mark)).collect()
    }

    /// What an interrupted study has done in the folder; `None` where a new one is to begin.
    pub fn earlier<K: Ord + DeserializeOwned, P: DeserializeOwned>(
        self,
        overwrite: bool,
    ) -> Result<Option<BTreeMap<K, P>>, CasesError> {
        if overwrite {
            return Ok(None);
        }
        let bytes = std::fs::read(self.folder.join("progress.jsonl")).unwrap_or_default();
        // A line that is damaged is computed again.
        let text = String::from_utf8_lossy(&bytes).into_owned();
        if text.lines().next() == Some(self.mark().as_str()) {
            // The last line may be cut in half; it is computed again.
            let of_all = [text].into_iter().chain(self.parts().into_iter().map(|(_, text)| text));
            return Ok(Some(of_all.flat_map(|text| lines(&text)).collect()));
        }
        if let Some(Ok(mark)) = text.lines().next().map(serde_json::from_str::<Mark>) {
            return Err(self.of_another(&mark));
        }
        let occupied = std::fs::read_dir(self.folder).is_ok_and(|mut entries| entries.next().is_some());
        if occupied { Err(FileError::NotEmpty { path: self.folder.to_owned() }.into()) } else { Ok(None) }
    }

    /// Why the study cannot go on in a folder with the journal of another.
    fn of_another(self, mark: &Mark) -> CasesError {
        let why = if mark.study != self.study {
            format!("are of `tsubu {}`", mark.study)
        } else if mark.version == crate::VERSION {
            let earlier = std::fs::read_to_string(self.folder.join("scene.toml")).unwrap_or_default();
            format!("belong to another scene{}", what_differs(&self.scene.all_differences(&earlier)))
        } else {
            format!("were written by tsubu {}, this is tsubu {}: go on with the other", mark.version, crate::VERSION)
        };
        CasesError::NotThisScene(format!("the results in {} {why}", self.folder.display()))
    }

    /// What runs that were done apart and failed have said.
    pub fn lost<K: Ord + DeserializeOwned>(self) -> BTreeMap<K, String> {
        let texts = self.parts();
        texts.iter().flat_map(|(_, text)| lines::<K, Lost>(text)).map(|(key, lost)| (key, lost.failed)).collect()
    }

    /// Makes the folder, or takes the one that an earlier study has begun. `tables` are the study's own files; those of its page come later.
    pub fn open(self, begun: bool, overwrite: bool, tables: &[&str]) -> Result<RunFolder, FileError> {
        let names = || -> Vec<String> {
            let own = tables.iter().chain(&["check.txt", "summary.json", "progress.jsonl"]);
            scene_files::names(self.scene).into_iter().chain(own.map(|name| (*name).to_owned())).collect()
        };
        if begun {
            return RunFolder::create(self.folder, Existing::Resume, names());
        }
        let existing = if overwrite { Existing::Overwrite } else { Existing::Refuse };
        let folder = RunFolder::create(self.folder, existing, names())?;
        scene_files::write(&folder, self.scene)?;
        folder.claim(names())?;
        for (file, _) in self.parts() {
            std::fs::remove_file(&file).map_err(FileError::write(&file))?;
        }
        folder.write("progress.jsonl", format!("{}\n", self.mark()).as_bytes())?;
        Ok(folder)
    }

    /// Puts what was done apart into the one journal, and forgets what failed: it is to be tried again.
    pub fn collect<K, P>(self, folder: &RunFolder) -> Result<(), FileError>
    where
        K: Serialize + DeserializeOwned,
        P: Serialize + DeserializeOwned,
    {
        let journal = Journal::append(folder)?;
        for (file, _) in self.parts() {
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

    /// The journal of runs that are done apart, of the process that does the run `name`; nobody else writes it while this lives.
    pub fn apart(self, name: &str) -> Result<Journal, FileError> {
        let parts = self.folder.join(PARTS);
        let path = parts.join(format!("{name}.jsonl"));
        std::fs::create_dir_all(&parts).map_err(FileError::write(&parts))?;
        let open = OpenOptions::new().create(true).read(true).append(true).open(&path);
        let mut file = open.map_err(FileError::write(&path))?;
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            return Err(FileError::Locked { path });
        }
        let mark = self.mark();
        let known = std::fs::read_to_string(&path).is_ok_and(|text| text.lines().next() == Some(mark.as_str()));
        let head = if known { Ok(()) } else { file.set_len(0).and_then(|()| write!(file, "{mark}")) };
        head.and_then(|()| writeln!(file)).map_err(FileError::write(&path))?;
        Ok(Journal { path, file: Mutex::new(file) })
    }
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
