//! Files that a scene names, read once.

use crate::complaint::{Complaint, Source};
use crate::grain_file::{self, GrainFile, How};
use crate::mesh_file;
use crate::plan::Vector;
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The files beside a scene. A sweep resolves its scene many times; every case must see the same bytes even if someone
/// edits the file meanwhile, and a million grains are read from text only once.
#[derive(Clone, Debug)]
pub(crate) struct Files {
    folder: PathBuf,
    bytes: BTreeMap<String, Result<Arc<[u8]>, String>>,
    grains: BTreeMap<(String, How), Arc<GrainFile>>,
    meshes: BTreeMap<String, Arc<Vec<[Vector; 3]>>>,
}

impl Files {
    pub fn new(folder: &Path) -> Self {
        let folder = folder.to_path_buf();
        Self { folder, bytes: BTreeMap::new(), grains: BTreeMap::new(), meshes: BTreeMap::new() }
    }

    /// The bytes of the file, or why it cannot be read.
    pub fn bytes(&mut self, name: &str) -> Result<Arc<[u8]>, String> {
        let folder = &self.folder;
        self.bytes.entry(name.to_string()).or_insert_with(|| read_bytes(&folder.join(name)).map(Arc::from)).clone()
    }

    /// The text of the file, or why it cannot be read.
    pub fn text(&mut self, name: &str) -> Result<String, String> {
        text(self.bytes(name)?.to_vec())
    }

    /// The grains in the file. A file that is wrong becomes a source, so that the complaints can point into it.
    pub fn grains(
        &mut self,
        name: &str,
        how: How,
        sources: &mut Vec<Source>,
    ) -> Result<Arc<GrainFile>, Vec<Complaint>> {
        let key = (name.to_string(), how);
        if let Some(known) = self.grains.get(&key) {
            return Ok(Arc::clone(known));
        }
        grain_file::known(name).map_err(|complaint| vec![complaint])?;
        let text = self.text(name).map_err(|reason| vec![unreadable(name, &reason)])?;
        match grain_file::read(name, &text, sources.len(), how) {
            Ok(file) => {
                let file = Arc::new(file);
                self.grains.insert(key, Arc::clone(&file));
                Ok(file)
            }
            Err(complaints) => {
                sources.push(Source { name: name.to_string(), text, numbered: true });
                Err(complaints)
            }
        }
    }

    /// The triangles in the file, as they stand there.
    pub fn mesh(&mut self, name: &str, sources: &mut Vec<Source>) -> Result<Arc<Vec<[Vector; 3]>>, Vec<Complaint>> {
        if let Some(known) = self.meshes.get(name) {
            return Ok(Arc::clone(known));
        }
        mesh_file::known(name).map_err(|complaint| vec![complaint])?;
        let bytes = self.bytes(name).map_err(|reason| vec![unreadable(name, &reason)])?;
        match mesh_file::read(name, &bytes, sources.len()) {
            Ok(triangles) => {
                let triangles = Arc::new(triangles);
                self.meshes.insert(name.to_string(), Arc::clone(&triangles));
                Ok(triangles)
            }
            Err(complaints) => {
                let text = String::from_utf8_lossy(&bytes).into_owned();
                sources.push(Source { name: name.to_string(), text, numbered: true });
                Err(complaints)
            }
        }
    }

    /// What tells the file from another: CRC-32 of its bytes, in hex.
    pub fn fingerprint(&mut self, name: &str) -> Option<String> {
        Some(format!("{:08x}", crc32fast::hash(&self.bytes(name).ok()?)))
    }

    /// The bytes of a file that was read.
    pub fn known_bytes(&self, name: &str) -> Option<Arc<[u8]>> {
        self.bytes.get(name).and_then(|read| read.as_ref().ok()).cloned()
    }

    /// The grains of a file that was read.
    pub fn known_grains(&self, name: &str, how: How) -> Option<&GrainFile> {
        self.grains.get(&(name.to_string(), how)).map(AsRef::as_ref)
    }

    /// The largest diameter in a file that was read.
    pub fn largest_diameter(&self, name: &str, how: How) -> Option<f64> {
        self.known_grains(name, how)?.grains.diameter.iter().copied().reduce(f64::max)
    }

    /// The triangles of a file that was read.
    pub fn known_mesh(&self, name: &str) -> Option<&[[Vector; 3]]> {
        self.meshes.get(name).map(|triangles| triangles.as_slice())
    }
}

/// The complaint about a file that is not there; it has yet to be placed.
pub(crate) fn unreadable(name: &str, reason: &str) -> Complaint {
    Complaint::new(format!("cannot read `{name}`: {reason}")).hint("the path starts at the folder of the scene file")
}

/// Reads a text file; the error says why not, in words that do not depend on the system.
pub(crate) fn read_text(path: &Path) -> Result<String, String> {
    text(read_bytes(path)?)
}

fn read_bytes(path: &Path) -> Result<Vec<u8>, String> {
    if path.is_dir() {
        return Err("it is a folder".to_string());
    }
    std::fs::read(path).map_err(|error| match error.kind() {
        ErrorKind::NotFound => "there is no such file".to_string(),
        ErrorKind::PermissionDenied => "permission is denied".to_string(),
        _ => error.to_string(),
    })
}

fn text(bytes: Vec<u8>) -> Result<String, String> {
    String::from_utf8(bytes).map_err(|error| {
        let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = valid.split(|byte| *byte == b'\n').count();
        format!("it is not UTF-8 text (line {line})")
    })
}
