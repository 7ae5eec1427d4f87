//! Files that a scene names, read once.

use crate::complaint::{Complaint, Complaints, Source};
use crate::grain_file::{self, GrainFile, How, clump};
use crate::lines;
use crate::mesh_file;
use crate::packing;
use crate::plan::{Packing, Vector};
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
    clumps: BTreeMap<(String, bool), Spheres>,
    packings: BTreeMap<(String, usize), Arc<Packing>>,
    faces: BTreeMap<String, Faces>,
}

/// The faces of a convex body: unit normal, and distance from the origin.
type Faces = Arc<Vec<(Vector, f64)>>;

/// The spheres of a clump: centre and radius.
type Spheres = Arc<Vec<(Vector, f64)>>;

impl Files {
    pub fn new(folder: &Path) -> Self {
        Self {
            folder: folder.to_path_buf(),
            bytes: BTreeMap::new(),
            grains: BTreeMap::new(),
            meshes: BTreeMap::new(),
            clumps: BTreeMap::new(),
            packings: BTreeMap::new(),
            faces: BTreeMap::new(),
        }
    }

    /// The whole path of something that the scene names.
    pub fn absolute(&self, name: &str) -> PathBuf {
        let path = self.folder.join(name);
        std::path::absolute(&path).unwrap_or(path)
    }

    /// The bytes of the file, or why it cannot be read.
    pub fn bytes(&mut self, name: &str) -> Result<Arc<[u8]>, String> {
        let folder = &self.folder;
        self.bytes
            .entry(name.to_string())
            .or_insert_with(|| read_bytes(&folder.join(name), LARGEST_FILE).map(Arc::from))
            .clone()
    }

    /// The text of the file. One that is no text becomes a source, so that the complaint can point into it.
    pub fn text(&mut self, name: &str, sources: &mut Vec<Source>) -> Result<String, Vec<Complaint>> {
        let bytes = self.bytes(name).map_err(|reason| vec![unreadable(name, &reason)])?;
        text(name, &bytes, sources).map_err(|complaint| vec![complaint])
    }

    /// The text of a file of grains: of one that is no text, its grains in rows.
    fn rows(&mut self, name: &str, sources: &mut Vec<Source>) -> Result<String, Vec<Complaint>> {
        let bytes = self.bytes(name).map_err(|reason| vec![unreadable(name, &reason)])?;
        match grain_file::as_text(name, &bytes) {
            Some(read) => read.map_err(|complaint| vec![complaint]),
            None => text(name, &bytes, sources).map_err(|complaint| vec![complaint]),
        }
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
        let text = self.rows(name, sources)?;
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
                sources.push(lossy(name, &bytes));
                Err(complaints)
            }
        }
    }

    /// The spheres of the clump in the file, in space or in the plane.
    pub fn clump(&mut self, name: &str, space: bool, sources: &mut Vec<Source>) -> Result<(), Vec<Complaint>> {
        let key = (name.to_string(), space);
        if self.clumps.contains_key(&key) {
            return Ok(());
        }
        let text = self.text(name, sources)?;
        match clump::read(&text, sources.len(), space) {
            Ok(spheres) => {
                self.clumps.insert(key, Arc::new(spheres));
                Ok(())
            }
            Err(complaints) => {
                sources.push(Source { name: name.to_string(), text, numbered: true });
                Err(complaints)
            }
        }
    }

    /// At most so many spheres in the mesh in the file.
    pub fn packing(&mut self, name: &str, most: usize, sources: &mut Vec<Source>) -> Result<(), Vec<Complaint>> {
        let key = (name.to_string(), most);
        if !self.packings.contains_key(&key) {
            let packing = packing::pack(&self.mesh(name, sources)?, most).map_err(|complaint| vec![complaint])?;
            self.packings.insert(key, Arc::new(packing));
        }
        Ok(())
    }

    /// The faces of the convex body that the mesh in the file encloses.
    pub fn faces(&mut self, name: &str, sources: &mut Vec<Source>) -> Result<(), Vec<Complaint>> {
        if !self.faces.contains_key(name) {
            let faces = packing::faces(&self.mesh(name, sources)?).map_err(|complaint| vec![complaint])?;
            self.faces.insert(name.to_string(), Arc::new(faces));
        }
        Ok(())
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

    /// The spheres of a clump whose file was read.
    pub fn known_clump(&self, name: &str, space: bool) -> Option<Spheres> {
        self.clumps.get(&(name.to_string(), space)).cloned()
    }

    /// The spheres in a mesh whose file was read.
    pub fn known_packing(&self, name: &str, most: usize) -> Option<Arc<Packing>> {
        self.packings.get(&(name.to_string(), most)).cloned()
    }

    /// The faces of a convex body whose file was read.
    pub fn known_faces(&self, name: &str) -> Option<Faces> {
        self.faces.get(name).cloned()
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

/// Reads a scene: its text, or what is wrong with it.
pub(crate) fn read_scene(name: &str, path: &Path) -> Result<String, Complaints> {
    let mut sources = Vec::new();
    let read = read_bytes(path, LARGEST_SCENE).map_err(|reason| {
        let complaint = Complaint::new(format!("cannot read the scene `{name}`: {reason}"));
        if path.exists() { complaint } else { complaint.hint("`tsubu new --list` shows scenes to begin with") }
    });
    read.and_then(|bytes| text(name, &bytes, &mut sources)).map_err(|wrong| Complaints::new(sources, vec![wrong]))
}

/// More than any scene has [bytes]; a file that was named by mistake is not looked at.
const LARGEST_SCENE: u64 = 100 << 20;
/// The same for what a scene names: a hundred million grains in text.
const LARGEST_FILE: u64 = 16 << 30;

/// The bytes of a file; the error says why not, in words that do not depend on the system.
fn read_bytes(path: &Path, largest: u64) -> Result<Vec<u8>, String> {
    let told = |error: std::io::Error| match error.kind() {
        ErrorKind::NotFound => "there is no such file".to_string(),
        ErrorKind::PermissionDenied => "permission is denied".to_string(),
        _ => error.to_string(),
    };
    let about = std::fs::metadata(path).map_err(told)?;
    // To open a pipe that nobody writes to would wait for ever, and devices have no end.
    if about.is_dir() {
        return Err("it is a folder".to_string());
    }
    if !about.is_file() {
        return Err("it is a pipe or a device, not a file".to_string());
    }
    if about.len() > largest {
        return Err(format!("it has {} bytes, more than the {largest} that are read", about.len()));
    }
    std::fs::read(path).map_err(told)
}

/// A file as a source, with what is no text in it replaced.
fn lossy(name: &str, bytes: &[u8]) -> Source {
    Source { name: name.to_string(), text: String::from_utf8_lossy(bytes).into_owned(), numbered: true }
}

fn text(name: &str, bytes: &[u8], sources: &mut Vec<Source>) -> Result<String, Complaint> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(text.to_string()),
        Err(error) => {
            let complaint = lines::no_text(bytes, &error, sources.len());
            sources.push(lossy(name, bytes));
            Err(complaint)
        }
    }
}
