//! The `frames/` folder: numbered snapshots and the `.pvd` indices that tell `ParaView` their times.

use std::borrow::Borrow;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use crate::frame::{Frame, Kind};
use crate::vtp::{self, STEMS};
use crate::whole::{sync, write_beside};
use crate::{FileError, lammps, xyz};

/// One snapshot in the folder.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// Simulated time [s].
    pub time: f64,
    /// The grains' file; contacts and walls stand beside it under the same number.
    pub path: PathBuf,
}

/// What is written beside the grains and walls as VTK.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Formats {
    /// Contacts, as VTK.
    pub contacts: bool,
    /// Extended XYZ.
    pub xyz: bool,
    /// LAMMPS dump files.
    pub lammps: bool,
}

impl Default for Formats {
    fn default() -> Self {
        Self { contacts: true, xyz: false, lammps: false }
    }
}

/// Writes snapshots one after the other.
///
/// An index is written whole, so that it is never seen half-written: when it has grown by a tenth, and by [`Self::sync`]. After
/// every snapshot, the writing of indices would take most of the time of a run of many.
#[derive(Debug)]
pub struct FrameWriter {
    folder: PathBuf,
    formats: Formats,
    next: usize,
    indices: [Index; 4],
    /// Written, but perhaps not on the disk yet.
    unsynced: Vec<PathBuf>,
}

/// The entries of a `.pvd`, and how many of them are not as they are in the file.
#[derive(Debug, Default)]
struct Index {
    entries: Vec<(f64, String)>,
    stale: usize,
}

impl FrameWriter {
    /// Starts `frames/` in the run folder, with its first snapshot.
    pub fn create(run_folder: &Path, formats: Formats) -> Self {
        let folder = run_folder.join("frames");
        Self { folder, formats, next: 0, indices: Default::default(), unsynced: Vec::new() }
    }

    /// Goes on behind the snapshots at or before `time`. Later ones are computed again under the same numbers; [`Self::cut`] them
    /// before the first.
    pub fn resume(run_folder: &Path, formats: Formats, time: f64) -> Result<Self, FileError> {
        let mut writer = Self::create(run_folder, formats);
        for ((_, stem), index) in STEMS.into_iter().zip(&mut writer.indices) {
            let pvd = writer.folder.join(format!("{stem}.pvd"));
            if !pvd.exists() {
                continue;
            }
            index.entries = read_pvd(&pvd)?.into_iter().filter(|(t, _)| *t <= time).collect();
            let last = index.entries.iter().filter_map(|(_, name)| number_of(name)).max();
            writer.next = writer.next.max(last.map_or(0, |n| n + 1));
        }
        Ok(writer)
    }

    /// Removes the snapshots that are to be computed again.
    pub fn cut(&mut self) -> Result<(), FileError> {
        for ((_, stem), index) in STEMS.into_iter().zip(&mut self.indices) {
            index.stale = usize::from(self.folder.join(format!("{stem}.pvd")).exists());
        }
        self.renew(false)?;
        self.remove_later();
        Ok(())
    }

    /// Removes the files of snapshots that are still to come.
    fn remove_later(&self) {
        let entries = fs::read_dir(&self.folder).into_iter().flatten().flatten();
        for name in entries.filter_map(|entry| entry.file_name().into_string().ok()).filter(|name| is_snapshot(name)) {
            if number_of(&name).is_some_and(|number| number >= self.next) {
                // An index that no longer names a file matters more than the file; leftovers are overwritten.
                let _ = fs::remove_file(self.folder.join(&name));
            }
        }
    }

    /// What is written beside the grains and walls from now on.
    pub fn set_formats(&mut self, formats: Formats) {
        self.formats = formats;
    }

    /// Number of snapshots so far.
    pub fn count(&self) -> usize {
        self.next
    }

    /// Writes one snapshot, or nothing of it: a disk that is full has room then for what is said of it.
    pub fn write(&mut self, frame: &Frame) -> Result<(), FileError> {
        self.write_parts([frame])
    }

    /// The same of a snapshot that comes in parts, each of which has all columns of its kinds: a large one is never whole in memory.
    pub fn write_parts(&mut self, parts: impl IntoIterator<Item = impl Borrow<Frame>>) -> Result<(), FileError> {
        let written = parts.into_iter().try_for_each(|part| self.write_files(part.borrow()));
        if let Err(error) = written {
            for index in &mut self.indices {
                index.entries.retain(|(_, name)| number_of(name) != Some(self.next));
            }
            self.remove_later();
            self.unsynced.retain(|path| path.exists());
            return Err(error);
        }
        self.next += 1;
        self.renew(true)
    }

    fn write_files(&mut self, frame: &Frame) -> Result<(), FileError> {
        let number = self.next;
        for ((kind, stem), index) in STEMS.into_iter().zip(&mut self.indices) {
            let name = format!("{stem}_{number:06}.vtp");
            let path = self.folder.join(&name);
            let wanted = kind != Kind::Contact || self.formats.contacts;
            if wanted && vtp::write(&path, frame, kind)? {
                index.entries.push((frame.time, name));
                index.stale += 1;
                self.unsynced.push(path);
            }
        }
        // These files are of grains alone.
        let grains = frame.column(Kind::Grain, "position").is_some();
        if grains && self.formats.xyz {
            let path = self.folder.join(format!("grains_{number:06}.xyz"));
            xyz::write(&path, frame)?;
            self.unsynced.push(path);
        }
        if grains && self.formats.lammps {
            let path = self.folder.join(format!("grains_{number:06}.lammpstrj"));
            lammps::write(&path, frame)?;
            self.unsynced.push(path);
        }
        Ok(())
    }

    /// Waits until all snapshots, and indices that name them, are on the disk. To be called before a checkpoint is written.
    pub fn sync(&mut self) -> Result<(), FileError> {
        self.flush()?;
        sync(&std::mem::take(&mut self.unsynced))
    }

    /// Writes indices that name all snapshots so far.
    pub fn flush(&mut self) -> Result<(), FileError> {
        self.renew(false)
    }

    /// Writes the indices that have grown; with `now_and_then` those alone that have grown by a tenth.
    fn renew(&mut self, now_and_then: bool) -> Result<(), FileError> {
        for ((_, stem), index) in STEMS.into_iter().zip(&mut self.indices) {
            if index.stale == 0 || (now_and_then && 10 * index.stale < index.entries.len()) {
                continue;
            }
            let path = self.folder.join(format!("{stem}.pvd"));
            write_pvd(&path, &index.entries)?;
            index.stale = 0;
            if !self.unsynced.contains(&path) {
                self.unsynced.push(path);
            }
        }
        Ok(())
    }
}

impl Drop for FrameWriter {
    fn drop(&mut self) {
        // A run that stops on an error keeps its last snapshots; a second error cannot be told from here.
        let _ = self.renew(false);
    }
}

/// The snapshots of a run folder, in order of time. No `frames/` is no error: there are none.
pub fn snapshots(run_folder: &Path) -> Result<Vec<Snapshot>, FileError> {
    let folder = run_folder.join("frames");
    let pvd = folder.join("grains.pvd");
    if !pvd.exists() {
        return Ok(Vec::new());
    }
    let entries = read_pvd(&pvd)?;
    Ok(entries.into_iter().map(|(time, name)| Snapshot { time, path: folder.join(name) }).collect())
}

/// Whether a file in `frames/` has a name that a [`FrameWriter`] gives.
pub(crate) fn is_snapshot(name: &str) -> bool {
    let (stem, ending) = name.rsplit_once('.').unwrap_or((name, ""));
    let kind = |name: &str| STEMS.iter().any(|(_, stem)| *stem == name);
    let numbered = |number: &str| number.len() >= 6 && number.bytes().all(|c| c.is_ascii_digit());
    match ending {
        "pvd" => kind(stem),
        "vtp" | "xyz" | "lammpstrj" => {
            stem.rsplit_once('_').is_some_and(|(stem, number)| kind(stem) && numbered(number))
        }
        _ => false,
    }
}

fn number_of(name: &str) -> Option<usize> {
    name.rsplit_once('.')?.0.rsplit_once('_')?.1.parse().ok()
}

fn write_pvd(path: &Path, entries: &[(f64, String)]) -> Result<(), FileError> {
    write_beside(path, |out| {
        out.write_all(
            b"<?xml version=\"1.0\"?>\n\
              <VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n",
        )?;
        for (time, name) in entries {
            writeln!(out, "<DataSet timestep=\"{time:?}\" part=\"0\" file=\"{name}\"/>")?;
        }
        out.write_all(b"</Collection>\n</VTKFile>\n")
    })
}

fn read_pvd(path: &Path) -> Result<Vec<(f64, String)>, FileError> {
    let text = fs::read_to_string(path).map_err(FileError::read(path))?;
    let value = |line: &str, key: &str| {
        let (_, after) = line.split_once(&format!("{key}=\""))?;
        after.split_once('"').map(|(v, _)| v.to_owned())
    };
    text.lines()
        .filter(|line| line.starts_with("<DataSet"))
        .map(|line| {
            let time = value(line, "timestep")?.parse().ok()?;
            // A plain name keeps an altered index from reaching outside the folder.
            let name = value(line, "file").filter(|n| !n.contains(['/', '\\']))?;
            Some((time, name))
        })
        .collect::<Option<_>>()
        .ok_or_else(|| FileError::content(path, "an entry has no time or file"))
}
