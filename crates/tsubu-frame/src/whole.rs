//! Files that are whole or not there.
//!
//! A file is written beside its place as `.NAME.tmp` and then renamed, so that a killed program leaves the old one or the new one.
//! A power cut is another matter: it takes what the system has not put on the disk yet. Waiting for the disk takes a
//! millisecond a file, a tenth of it where many are waited for at once; so what comes in numbers is written with [`write_beside`]
//! and waited for with [`sync`], before a checkpoint names it.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};
use std::thread;

use crate::FileError;

/// Files that the disk is waited for at once.
const AT_ONCE: usize = 8;

/// The name under which a file is written before it is whole.
pub(crate) fn temporary(path: &Path) -> Option<PathBuf> {
    let mut hidden = std::ffi::OsString::from(".");
    hidden.push(path.file_name()?);
    hidden.push(".tmp");
    Some(path.with_file_name(hidden))
}

/// Writes a file that is never seen half-written, and waits until it is on the disk.
///
/// Folders on the way are made. After an error the temporary file is gone and an older file of that name is untouched.
pub fn write_atomically(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<(), FileError> {
    replace(path, fill, true)?;
    sync_folder(folder_of(path));
    Ok(())
}

/// The same without waiting for the disk: after a power cut the file may be empty, unless [`sync`] was called.
pub fn write_beside(path: &Path, fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> Result<(), FileError> {
    replace(path, fill, false)
}

/// Waits until files, and their names in their folders, are on the disk.
pub fn sync(files: &[PathBuf]) -> Result<(), FileError> {
    let wait = |path: &PathBuf| File::open(path).and_then(|file| file.sync_all()).map_err(FileError::write(path));
    let share = files.len().div_ceil(AT_ONCE).max(1);
    thread::scope(|scope| {
        let all = files.chunks(share).map(|some| scope.spawn(move || some.iter().try_for_each(wait)));
        let all: Vec<_> = all.collect();
        // A thread that only waits does not panic.
        all.into_iter().try_for_each(|one| one.join().unwrap_or(Ok(())))
    })?;
    files.iter().map(|file| folder_of(file)).collect::<BTreeSet<_>>().into_iter().for_each(sync_folder);
    Ok(())
}

fn replace(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    wait: bool,
) -> Result<(), FileError> {
    let temporary = temporary(path).ok_or_else(|| FileError::content(path, "it has no file name"))?;
    let written = write_to(&temporary, fill, wait);
    let done = written.and_then(|()| fs::rename(&temporary, path));
    done.map_err(|source| {
        // The first error is the one worth telling; this clean-up may fail for the same cause.
        let _ = fs::remove_file(&temporary);
        FileError::Write { path: path.to_owned(), source }
    })
}

fn write_to(path: &Path, fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>, wait: bool) -> io::Result<()> {
    let file = match File::create(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            fs::create_dir_all(folder_of(path))?;
            File::create(path)?
        }
        other => other?,
    };
    let mut out = BufWriter::with_capacity(1 << 16, file);
    fill(&mut out)?;
    let file = out.into_inner().map_err(io::IntoInnerError::into_error)?;
    if wait { file.sync_all() } else { Ok(()) }
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// A rename lasts through a power cut only once its folder is on the disk. Some file systems refuse to sync a folder;
/// the file itself is safe by then, so that is not an error.
fn sync_folder(folder: &Path) {
    if let Ok(handle) = File::open(folder) {
        let _ = handle.sync_all();
    }
}
