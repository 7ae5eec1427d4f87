//! The run folder, and files that are whole or not there.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::FileError;

/// What a run, sweep or study writes into its folder. `--overwrite` removes these and nothing else, so that a slip
/// in `-o` costs nobody their home directory.
const OURS: &[&str] = &[
    "scene.toml",
    "summary.json",
    "history.csv",
    "response.csv",
    "cases.csv",
    "energy_by_cause.csv",
    "sweep.csv",
    "cases",
    "compare.csv",
    "compare.json",
    "verify.json",
    "check.txt",
    "bench.json",
    "report.html",
    "frames",
    "figures",
    "checkpoint",
    "watch",
    "progress.jsonl",
];

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
            for name in OURS {
                remove(&path.join(name))?;
            }
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

fn remove(path: &Path) -> Result<(), FileError> {
    let gone = match fs::symlink_metadata(path) {
        Ok(about) if about.is_dir() => fs::remove_dir_all(path),
        Ok(_) => fs::remove_file(path),
        Err(_) => return Ok(()),
    };
    gone.map_err(FileError::write(path))
}

/// Writes a file so that it is never seen half-written: to `.NAME.tmp` beside it, to the disk, then renamed.
///
/// Folders on the way are made. After an error the temporary file is gone and an older file of that name is untouched.
pub fn write_atomically(path: &Path, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), FileError> {
    let name = path.file_name().ok_or_else(|| FileError::content(path, "it has no file name"))?;
    let folder = match path.parent() {
        Some(p) if !p.as_os_str().is_empty() => p,
        _ => Path::new("."),
    };
    fs::create_dir_all(folder).map_err(FileError::write(path))?;
    let mut hidden = std::ffi::OsString::from(".");
    hidden.push(name);
    hidden.push(".tmp");
    let temporary = folder.join(hidden);
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
