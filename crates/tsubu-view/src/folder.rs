//! A run folder that is shown, and nothing beside it.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use tsubu_frame::{FileError, Frame, Kind, Snapshot, Summary, snapshots, vtp, vtp_read};

use crate::ViewError;
use crate::embedded::groups;

/// A run folder.
pub struct Folder {
    /// As the user named it.
    name: String,
    /// Without links and `..`.
    path: PathBuf,
}

impl Folder {
    /// A folder with a run that can be looked at.
    pub fn open(path: &Path) -> Result<Self, ViewError> {
        if !path.is_dir() {
            return Err(ViewError::NoFolder { path: path.to_owned() });
        }
        if !["summary.json", "history.csv", "frames"].iter().any(|name| path.join(name).exists()) {
            return Err(ViewError::NoRun { path: path.to_owned() });
        }
        let real = path.canonicalize().map_err(FileError::read(path))?;
        let folder = Self { name: path.display().to_string(), path: real };
        if folder.snapshots()?.is_empty() {
            return Err(ViewError::NoFrames { path: path.to_owned() });
        }
        Ok(folder)
    }

    /// What there is, as JSON: name, times of frames, the summary where the run has written one.
    pub fn about(&self) -> Result<Value, ViewError> {
        let times: Vec<f64> = self.snapshots()?.iter().map(|snapshot| snapshot.time).collect();
        let summary = self.existing("summary.json")?.map(|path| Summary::read(&path)).transpose()?;
        let verdict = self.existing("check.txt")?.map(|path| fs::read_to_string(&path).map_err(FileError::read(&path)));
        let stages = summary.iter().flat_map(|summary| &summary.stages);
        Ok(json!({
            "name": self.name,
            "times": times,
            "status": summary.as_ref().map_or("running", |summary| summary.status.word()),
            "dimension": summary.as_ref().map(|summary| summary.dimension),
            "method": summary.as_ref().map(|summary| summary.method.clone()),
            "claims": summary.as_ref().map(|summary| &summary.claims),
            "stages": stages.map(|stage| &stage.name).collect::<Vec<_>>(),
            "groups": self.groups()?,
            "verdict": verdict.transpose()?.unwrap_or_default(),
        }))
    }

    /// Names of the groups of grains, by the scene that was run; none where it cannot be told.
    fn groups(&self) -> Result<Vec<String>, ViewError> {
        let Some(path) = self.existing("scene.toml")? else { return Ok(Vec::new()) };
        Ok(groups(&fs::read_to_string(&path).map_err(FileError::read(&path))?))
    }

    /// The table of the history; nothing if there is none.
    pub fn history(&self) -> Result<Option<Vec<u8>>, ViewError> {
        let Some(path) = self.existing("history.csv")? else { return Ok(None) };
        Ok(Some(fs::read(&path).map_err(FileError::read(&path))?))
    }

    /// The frames that are there by now.
    pub fn snapshots(&self) -> Result<Vec<Snapshot>, ViewError> {
        if self.existing("frames")?.is_none() || self.existing("frames/grains.pvd")?.is_none() {
            return Ok(Vec::new());
        }
        Ok(snapshots(&self.path)?)
    }

    /// A frame by its number: grains with all columns, and those of the other kinds that are wanted.
    pub fn frame(&self, number: usize, kinds: &[Kind]) -> Result<Option<Frame>, ViewError> {
        let Some(snapshot) = self.snapshots()?.into_iter().nth(number) else { return Ok(None) };
        let grains = snapshot.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let mut frame = Frame::default();
        for (kind, stem) in vtp::STEMS {
            if kind != Kind::Grain && !kinds.contains(&kind) {
                continue;
            }
            let name = grains.replacen("grains", stem, 1);
            match self.existing(&format!("frames/{name}"))? {
                Some(path) => {
                    let bytes = fs::read(&path).map_err(FileError::read(&path))?;
                    vtp_read::parse(&bytes, kind, &mut frame).map_err(|reason| FileError::content(&path, reason))?;
                }
                None if kind == Kind::Grain => return Ok(None),
                None => {}
            }
        }
        Ok(Some(frame))
    }

    /// A file of the folder, if it is there; one that a link puts elsewhere is refused.
    fn existing(&self, name: &str) -> Result<Option<PathBuf>, ViewError> {
        let path = self.path.join(name);
        match path.canonicalize() {
            Ok(real) if real.starts_with(&self.path) => Ok(Some(real)),
            Ok(_) => Err(ViewError::Outside { path }),
            Err(_) => Ok(None),
        }
    }
}
