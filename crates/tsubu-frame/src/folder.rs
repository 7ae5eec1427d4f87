//! The run folder: what in it is tsubu's, and who may write.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use serde::Serialize;

use crate::FileError;
use crate::marker::{self, Marker, hash};
use crate::series::is_snapshot;
use crate::whole::{sync, temporary, write_beside};

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

/// A folder of results that nobody else writes into while this lives.
#[derive(Debug)]
pub struct RunFolder {
    path: PathBuf,
    inner: Mutex<Inner>,
}

#[derive(Debug)]
struct Inner {
    marker: Marker,
    /// Written, but perhaps not on the disk yet.
    unsynced: Vec<PathBuf>,
}

impl RunFolder {
    /// Makes the folder, or takes an existing one as `existing` says. `names` are the files that are going to be written, with a
    /// slash behind folders of snapshots and of runs: where something else stands in their place nothing is touched.
    pub fn create<S: AsRef<str>>(
        path: impl Into<PathBuf>,
        existing: Existing,
        names: impl IntoIterator<Item = S>,
    ) -> Result<Self, FileError> {
        let path = path.into();
        if !path.is_dir() {
            if existing == Existing::Resume {
                return Err(FileError::NothingToResume { path });
            }
            fs::create_dir_all(&path).map_err(FileError::write(&path))?;
            let marker = Marker::make(&path)?;
            return Ok(Self::new(path, marker));
        }
        let marker = Marker::find(&path)?;
        if existing == Existing::Refuse && entries(&path)?.iter().any(|name| name != marker::NAME) {
            return Err(FileError::NotEmpty { path });
        }
        if existing == Existing::Resume && marker.is_none() {
            return Err(FileError::Unmarked { path });
        }
        for name in names {
            free(&path, marker.as_ref(), name.as_ref())?;
        }
        let marker = match marker {
            Some(mut marker) => {
                if existing == Existing::Overwrite {
                    let mut ours = Ours::default();
                    ours.find(&path, &marker)?;
                    ours.remove()?;
                    marker.clear()?;
                }
                marker
            }
            None => Marker::make(&path)?,
        };
        Ok(Self::new(path, marker))
    }

    /// A folder of results that is there, whoever made it, to add files to; `names` as for [`Self::create`].
    pub fn open<S: AsRef<str>>(
        path: impl Into<PathBuf>,
        names: impl IntoIterator<Item = S>,
    ) -> Result<Self, FileError> {
        let path = path.into();
        let marker = Marker::find(&path)?;
        for name in names {
            free(&path, marker.as_ref(), name.as_ref())?;
        }
        let marker = marker.map_or_else(|| Marker::make(&path), Ok)?;
        Ok(Self::new(path, marker))
    }

    fn new(path: PathBuf, marker: Marker) -> Self {
        let unsynced = vec![marker.path().to_owned()];
        Self { path, inner: Mutex::new(Inner { marker, unsynced }) }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The path of a file in it.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Says that these files (with a slash behind them folders of snapshots and of runs) are going to be written by tsubu.
    pub fn claim<S: AsRef<str>>(&self, names: impl IntoIterator<Item = S>) -> Result<(), FileError> {
        names.into_iter().try_for_each(|name| self.add(name.as_ref(), None))
    }

    /// Writes a whole file; it appears under its name complete or not at all.
    pub fn write(&self, name: &str, content: &[u8]) -> Result<(), FileError> {
        self.put(name, None, content)
    }

    /// Writes a file that people edit: an edited one is not overwritten.
    pub fn write_editable(&self, name: &str, content: &[u8]) -> Result<(), FileError> {
        self.put(name, Some(&hash(content)), content)
    }

    /// Writes any value as indented JSON.
    pub fn write_json(&self, name: &str, value: &impl Serialize) -> Result<(), FileError> {
        self.write(name, crate::summary::json(&self.file(name), value)?.as_bytes())
    }

    /// Waits until all that was written with the methods above is on the disk.
    pub fn sync(&self) -> Result<(), FileError> {
        let files = std::mem::take(&mut self.inner().unsynced);
        sync(&files)
    }

    fn put(&self, name: &str, hash: Option<&str>, content: &[u8]) -> Result<(), FileError> {
        self.add(name, hash)?;
        let path = self.path.join(name);
        write_beside(&path, |out| out.write_all(content))?;
        self.inner().unsynced.push(path);
        Ok(())
    }

    fn add(&self, name: &str, hash: Option<&str>) -> Result<(), FileError> {
        let inner = &mut *self.inner();
        free(&self.path, Some(&inner.marker), name)?;
        inner.marker.add(name, hash)
    }

    fn inner(&self) -> MutexGuard<'_, Inner> {
        // Whoever panicked has left a marker that names more than there is, never less.
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Whether a file of this name may be written: nothing stands there, or what tsubu has written; no way there leads through a link.
fn free(folder: &Path, marker: Option<&Marker>, name: &str) -> Result<(), FileError> {
    way(folder, name)?;
    let inner = name.ends_with('/');
    let path = folder.join(name.trim_end_matches('/'));
    match path.metadata() {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        Ok(about) if about.is_dir() != inner => return Err(FileError::Foreign { path }),
        _ => {}
    }
    match marker.and_then(|marker| marker.names().find(|(known, _)| *known == name)) {
        Some((_, hashes)) => unedited(&path, hashes),
        None if inner && entries(&path)?.is_empty() => Ok(()),
        None => Err(FileError::Foreign { path }),
    }
}

/// Refuses a name that leads through a link, for what is behind it is somewhere else, or through a file.
fn way(folder: &Path, name: &str) -> Result<(), FileError> {
    let mut path = folder.to_owned();
    for part in Path::new(name) {
        if path.is_file() {
            return Err(FileError::Foreign { path });
        }
        path.push(part);
        if path.is_symlink() {
            return Err(FileError::Link { path });
        }
    }
    Ok(())
}

/// Refuses a file that has none of the contents that tsubu gave it.
fn unedited(path: &Path, hashes: &[String]) -> Result<(), FileError> {
    if hashes.is_empty() {
        return Ok(());
    }
    match fs::read(path) {
        Ok(content) if hashes.contains(&hash(&content)) => Ok(()),
        Ok(_) => Err(FileError::Edited { path: path.to_owned() }),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        Err(error) => Err(FileError::read(path)(error)),
    }
}

/// What tsubu has written into a folder and the folders in it.
#[derive(Default)]
struct Ours {
    files: Vec<PathBuf>,
    folders: Vec<PathBuf>,
    /// Held, so that nobody begins to write there.
    markers: Vec<Marker>,
}

impl Ours {
    fn find(&mut self, folder: &Path, marker: &Marker) -> Result<(), FileError> {
        for (name, hashes) in marker.names() {
            way(folder, name)?;
            let path = folder.join(name);
            self.folders.extend(path.ancestors().skip(1).take_while(|above| *above != folder).map(Path::to_owned));
            if name.ends_with('/') {
                self.find_inside(&path)?;
            } else {
                unedited(&path, hashes)?;
                self.files.push(path);
            }
        }
        Ok(())
    }

    /// The same in a folder of snapshots or of runs.
    fn find_inside(&mut self, folder: &Path) -> Result<(), FileError> {
        if !folder.is_dir() {
            return Ok(());
        }
        self.folders.push(folder.to_owned());
        if let Some(marker) = Marker::find(folder)? {
            self.find(folder, &marker)?;
            self.files.push(marker.path().to_owned());
            self.markers.push(marker);
            return Ok(());
        }
        for name in entries(folder)? {
            let path = folder.join(&name);
            let whole = name.strip_prefix('.').and_then(|name| name.strip_suffix(".tmp")).unwrap_or(&name);
            if is_snapshot(whole) {
                self.files.push(folder.join(whole));
            } else if path.join(marker::NAME).exists() && !path.is_symlink() {
                self.find_inside(&path)?;
            }
        }
        Ok(())
    }

    fn remove(mut self) -> Result<(), FileError> {
        for file in &self.files {
            remove(file)?;
        }
        // The innermost first; where something is left in one, that is not ours.
        self.folders.sort_by_key(|folder| std::cmp::Reverse(folder.components().count()));
        for folder in &self.folders {
            let _ = fs::remove_dir(folder);
        }
        Ok(())
    }
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

/// Names of what is in a folder, as far as they are text.
fn entries(folder: &Path) -> Result<Vec<String>, FileError> {
    let entries = fs::read_dir(folder).map_err(FileError::read(folder))?;
    Ok(entries.filter_map(|entry| Some(entry.ok()?.file_name().to_string_lossy().into_owned())).collect())
}
