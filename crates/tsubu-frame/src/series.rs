//! The `frames/` folder: numbered snapshots and the `.pvd` indices that tell `ParaView` their times.

use std::fs;
use std::path::{Path, PathBuf};

use crate::folder::write_atomically;
use crate::frame::{Frame, Kind};
use crate::vtp::{self, stem};
use crate::{FileError, lammps, xyz};

const KINDS: [Kind; 4] = [Kind::Grain, Kind::Contact, Kind::Cell, Kind::Surface];

/// One snapshot in the folder.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// Simulated time [s].
    pub time: f64,
    /// The grains' file; contacts and walls stand beside it under the same number.
    pub path: PathBuf,
}

/// Formats that are written beside VTK.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Formats {
    /// Extended XYZ.
    pub xyz: bool,
    /// LAMMPS dump files.
    pub lammps: bool,
}

/// Writes snapshots one after the other.
#[derive(Debug)]
pub struct FrameWriter {
    folder: PathBuf,
    formats: Formats,
    next: usize,
    indices: [Vec<(f64, String)>; 4],
}

impl FrameWriter {
    /// Starts `frames/` in the run folder; `formats` adds a file each per snapshot.
    pub fn create(run_folder: &Path, formats: Formats) -> Result<Self, FileError> {
        let folder = run_folder.join("frames");
        fs::create_dir_all(&folder).map_err(FileError::write(&folder))?;
        Ok(Self { folder, formats, next: 0, indices: Default::default() })
    }

    /// Goes on behind the snapshots at or before `time`; later ones are computed again under the same numbers.
    pub fn resume(run_folder: &Path, formats: Formats, time: f64) -> Result<Self, FileError> {
        let mut writer = Self::create(run_folder, formats)?;
        for (kind, index) in KINDS.into_iter().zip(&mut writer.indices) {
            let Some(stem) = stem(kind) else { continue };
            let pvd = writer.folder.join(format!("{stem}.pvd"));
            if !pvd.exists() {
                continue;
            }
            for (t, name) in read_pvd(&pvd)? {
                if t <= time {
                    let after = number_of(&name).map_or(0, |n| n + 1);
                    writer.next = writer.next.max(after);
                    index.push((t, name));
                } else {
                    // An index that no longer names a file matters more than the file; leftovers are overwritten.
                    let _ = fs::remove_file(writer.folder.join(&name));
                }
            }
            write_pvd(&pvd, index)?;
        }
        Ok(writer)
    }

    /// Number of snapshots so far.
    pub fn count(&self) -> usize {
        self.next
    }

    /// Writes one snapshot and renews the indices.
    pub fn write(&mut self, frame: &Frame) -> Result<(), FileError> {
        let number = self.next;
        for (kind, index) in KINDS.into_iter().zip(&mut self.indices) {
            let Some(stem) = stem(kind) else { continue };
            let name = format!("{stem}_{number:06}.vtp");
            if vtp::write(&self.folder.join(&name), frame, kind)? {
                index.push((frame.time, name));
                write_pvd(&self.folder.join(format!("{stem}.pvd")), index)?;
            }
        }
        if self.formats.xyz {
            xyz::write(&self.folder.join(format!("grains_{number:06}.xyz")), frame)?;
        }
        if self.formats.lammps {
            lammps::write(&self.folder.join(format!("grains_{number:06}.lammpstrj")), frame)?;
        }
        self.next += 1;
        Ok(())
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
    let kind = |name: &str| KINDS.into_iter().any(|kind| vtp::stem(kind) == Some(name));
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
    name.strip_suffix(".vtp")?.rsplit_once('_')?.1.parse().ok()
}

fn write_pvd(path: &Path, entries: &[(f64, String)]) -> Result<(), FileError> {
    write_atomically(path, |out| {
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
