//! What a plan takes from files beside the scene, and under which names the run folder gets copies of them.

use crate::files::Files;
use crate::grain_file::{How, ending};
use crate::mesh_file;
use crate::plan::{GrainShape, Particles, Plan, Shape, Start, Wall};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// A file for the run folder: its name there, and its bytes.
pub(crate) type Companion = (String, Arc<[u8]>);

/// Puts the grains of files that were read, and the spheres of clumps, where the plan has room for them.
pub(crate) fn grains(particles: &mut BTreeMap<String, Particles>, files: &Files, space: bool) {
    for group in particles.values_mut() {
        shape(&mut group.shape, files, space);
        if let Start::File { path, kind, grains, .. } = &mut group.start
            && let Some(file) = files.known_grains(path, How { space, kind: *kind })
        {
            *grains = Arc::clone(&file.grains);
        }
    }
}

/// The same for the spheres of one shape.
pub(crate) fn shape(shape: &mut GrainShape, files: &Files, space: bool) {
    match shape {
        GrainShape::ClumpFile { path, spheres, .. } => {
            if let Some(known) = files.known_clump(path, space) {
                *spheres = known;
            }
        }
        GrainShape::ClumpMesh { path, spheres, packing, .. } => {
            if let Some(known) = files.known_packing(path, *spheres) {
                *packing = known;
            }
        }
        GrainShape::PolyhedronMesh { path, faces, .. } => {
            if let Some(known) = files.known_faces(path) {
                *faces = known;
            }
        }
        GrainShape::Sphere {}
        | GrainShape::Disc { .. }
        | GrainShape::Clump { .. }
        | GrainShape::Superellipsoid { .. }
        | GrainShape::Polyhedron { .. }
        | GrainShape::Polygon { .. }
        | GrainShape::Cells { .. } => {}
    }
}

/// The same for the triangles of walls.
pub(crate) fn meshes(walls: &mut BTreeMap<String, Wall>, files: &Files) {
    for wall in walls.values_mut() {
        if let Shape::Mesh { path, scale, shift, triangles, .. } = &mut wall.shape
            && let Some(mesh) = files.known_mesh(path)
        {
            *triangles = Arc::new(mesh_file::placed(mesh, *scale, *shift));
        }
    }
}

/// Renames the files of a plan to their copies in the run folder, and gives the copies. Read again from there, the
/// scene gives the same plan.
pub(crate) fn companions(plan: &mut Plan, files: &Files) -> Vec<Companion> {
    let mut copies = Copies { files, names: BTreeMap::new(), taken: BTreeSet::new(), list: Vec::new() };
    for (name, group) in &mut plan.particles {
        if let Start::File { path, .. } = &mut group.start {
            copies.take(path, "particles", name);
        }
        match &mut group.shape {
            GrainShape::ClumpFile { path, .. } | GrainShape::ClumpMesh { path, .. } => {
                copies.take(path, "clumps", name);
            }
            GrainShape::PolyhedronMesh { path, .. } => copies.take(path, "polyhedra", name),
            _ => {}
        }
    }
    for (name, wall) in &mut plan.walls {
        if let Shape::Mesh { path, .. } = &mut wall.shape {
            copies.take(path, "walls", name);
        }
    }
    copies.list
}

struct Copies<'a> {
    files: &'a Files,
    /// From the path in the scene to the name of the copy: a file that two groups read is copied once.
    names: BTreeMap<String, String>,
    taken: BTreeSet<String>,
    list: Vec<Companion>,
}

impl Copies<'_> {
    fn take(&mut self, path: &mut String, family: &str, owner: &str) {
        if let Some(name) = self.names.get(path) {
            path.clone_from(name);
            return;
        }
        let Some(bytes) = self.files.known_bytes(path) else { return };
        // Names of groups can be anything; names of files had better not be.
        let plain = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' };
        let stem: String = owner.chars().take(60).map(plain).collect();
        let ending = ending(path);
        let mut name = format!("{family}-{stem}.{ending}");
        let mut number = 2;
        // Some file systems do not tell A from a.
        while !self.taken.insert(name.to_ascii_lowercase()) {
            name = format!("{family}-{stem}-{number}.{ending}");
            number += 1;
        }
        self.names.insert(path.clone(), name.clone());
        self.list.push((name.clone(), bytes));
        *path = name;
    }
}
