//! The run folder, and files that are whole or not there.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Component, Path, PathBuf};

use crate::FileError;
use crate::series::is_snapshot;

/// What a run, sweep or study writes into its folder under names that are always the same. `--overwrite` removes these,
/// snapshots, and the files in the list [`LIST`], and nothing else, so that a slip in `-o` costs nobody their home directory.
const OURS: &[&str] = &[
    "scene.toml",
    "summary.json",
    "history.csv",
    "response.csv",
    "cases.csv",
    "energy_by_cause.csv",
    "sweep.csv",
    "sweep.json",
    "compare.csv",
    "compare.json",
    "verify.json",
    "check.txt",
    "bench.json",
    "report.html",
    "progress.jsonl",
    "watch/index.json",
    "checkpoint/state.tsubu",
];

/// Paths of the files in a folder whose names depend on the scene, one a line; folders of runs with a slash behind.
const LIST: &str = "files.txt";

/// What to do with a folder that has something in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// Stop with a message that names the two flags.
    Refuse,
    /// Remove what an earlier run wrote; other files stay.
    Overwrite,
    /// Keep everything and go on from the checkpoint.
    Resume,
}

/// The folder of one run.
#[derive(Clone, Debug)]
pub struct RunFolder {
    path: PathBuf,
}

impl RunFolder {
    /// Makes the folder, or takes an existing one as `existing` says.
    pub fn create(path: impl Into<PathBuf>, existing: Existing) -> Result<Self, FileError> {
        let path = path.into();
        if existing == Existing::Resume {
            if !path.is_dir() {
                return Err(FileError::NothingToResume { path });
            }
            return Ok(Self { path });
        }
        fs::create_dir_all(&path).map_err(FileError::write(&path))?;
        let mut entries = fs::read_dir(&path).map_err(FileError::read(&path))?;
        if entries.next().is_some() {
            if existing == Existing::Refuse {
                return Err(FileError::NotEmpty { path });
            }
            clear(&path)?;
        }
        Ok(Self { path })
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The path of a file in it.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Writes a whole file; it appears under its name complete or not at all.
    pub fn write(&self, name: &str, content: &[u8]) -> Result<(), FileError> {
        write_atomically(&self.path.join(name), |out| out.write_all(content))
    }
}

/// Adds files to the list of a folder, and with a slash behind their names folders of runs, before they are written: a
/// killed run may leave them, but never unlisted.
pub fn list<S: Into<String>>(folder: &Path, names: impl IntoIterator<Item = S>) -> Result<(), FileError> {
    let mut all = listed(folder)?;
    let before = all.len();
    all.extend(names.into_iter().map(Into::into));
    if all.len() == before {
        return Ok(());
    }
    let text = all.into_iter().map(|name| name + "\n").collect::<String>();
    write_atomically(&folder.join(LIST), |out| out.write_all(text.as_bytes()))
}

fn listed(folder: &Path) -> Result<BTreeSet<String>, FileError> {
    let path = folder.join(LIST);
    match fs::read_to_string(&path) {
        Ok(text) => Ok(text.lines().map(str::to_owned).collect()),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(BTreeSet::new()),
        Err(error) => Err(FileError::read(&path)(error)),
    }
}

/// Removes what tsubu wrote into a folder, and those folders in it that are empty then.
fn clear(folder: &Path) -> Result<(), FileError> {
    let mut inner = Vec::new();
    for name in listed(folder)? {
        // An altered list must not reach outside the folder.
        if !Path::new(&name).components().all(|part| matches!(part, Component::Normal(_))) {
            continue;
        }
        match name.strip_suffix('/') {
            Some(name) => inner.push(folder.join(name)),
            None => remove(&folder.join(name))?,
        }
    }
    for name in OURS.iter().chain(&[LIST]) {
        remove(&folder.join(name))?;
    }
    let frames = folder.join("frames");
    for name in names(&frames)? {
        let whole = name.strip_prefix('.').and_then(|name| name.strip_suffix(".tmp")).unwrap_or(&name);
        if is_snapshot(whole) {
            remove(&frames.join(whole))?;
        }
    }
    // Cases of a sweep, and what the list has with a slash behind it, are folders like this one.
    let cases = folder.join("cases");
    let numbers = names(&cases)?.into_iter().filter(|name| name.bytes().all(|c| c.is_ascii_digit()));
    for inner in numbers.map(|name| cases.join(name)).chain(inner) {
        if inner.is_dir() {
            clear(&inner)?;
            prune(&inner);
        }
    }
    for name in ["frames", "figures", "watch", "checkpoint", "cases"] {
        prune(&folder.join(name));
    }
    Ok(())
}

/// Names of what is in a folder; none where there is no such folder.
fn names(folder: &Path) -> Result<Vec<String>, FileError> {
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let entries = fs::read_dir(folder).map_err(FileError::read(folder))?;
    Ok(entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok()).collect())
}

/// Removes a file of ours, and what a killed run has left of it under the name it is written as.
fn remove(path: &Path) -> Result<(), FileError> {
    for path in [Some(path.to_owned()), temporary(path)].into_iter().flatten() {
        match fs::symlink_metadata(&path) {
            Ok(about) if !about.is_dir() => fs::remove_file(&path).map_err(FileError::write(&path))?,
            _ => {}
        }
    }
    Ok(())
}

/// Removes a folder if nothing is left in it.
fn prune(folder: &Path) {
    // Where something is, it is not ours.
    let _ = fs::remove_dir(folder);
}

/// The name under which a file is written before it is whole.
fn temporary(path: &Path) -> Option<PathBuf> {
    let mut hidden = std::ffi::OsString::from(".");
    hidden.push(path.file_name()?);
    hidden.push(".tmp");
    Some(path.with_file_name(hidden))
}

/// Writes a file so that it is never seen half-written: to `.NAME.tmp` beside it, to the disk, then renamed.
///
/// Folders on the way are made. After an error the temporary file is gone and an older file of that name is untouched.
pub fn write_atomically(path: &Path, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), FileError> {
    let temporary = temporary(path).ok_or_else(|| FileError::content(path, "it has no file name"))?;
    let folder = match path.parent() {
        Some(p) if !p.as_os_str().is_empty() => p,
        _ => Path::new("."),
    };
    fs::create_dir_all(folder).map_err(FileError::write(path))?;
    let done = fill_and_sync(&temporary, fill).and_then(|()| fs::rename(&temporary, path));
    if let Err(source) = done {
        // The first error is the one worth telling; this clean-up may fail for the same cause.
        let _ = fs::remove_file(&temporary);
        return Err(FileError::Write { path: path.to_owned(), source });
    }
    sync_folder(folder);
    Ok(())
}

fn fill_and_sync(path: &Path, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut out = BufWriter::with_capacity(1 << 16, File::create(path)?);
    fill(&mut out)?;
    out.into_inner().map_err(io::IntoInnerError::into_error)?.sync_all()
}

/// A rename lasts through a power cut only once its folder is on the disk. Some file systems refuse to sync a folder;
/// the file itself is safe by then, so that is not an error.
fn sync_folder(folder: &Path) {
    if let Ok(handle) = File::open(folder) {
        let _ = handle.sync_all();
    }
}
