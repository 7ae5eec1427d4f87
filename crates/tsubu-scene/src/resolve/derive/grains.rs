//! Groups of grains: counts, diameters, masses.

use super::{Derive, explained, is_space, table_at, tables_in};
use crate::attach;
use crate::complaint::Complaint;
use crate::grain_file::{GrainFile, How};
use crate::keys;
use crate::plan::{GrainShape, Size};
use std::sync::Arc;
use toml::Value;

/// Two ways to the same number may differ in the last digits.
const SAME: f64 = 1e-9;

/// Whether places come from a file.
enum File {
    None,
    /// It is wrong, and complained about.
    Wrong,
    Read(Arc<GrainFile>),
}

impl Derive<'_> {
    pub(super) fn particles(&mut self, resolved: &mut toml::Table) {
        let materials = table_at(resolved, "materials").cloned().unwrap_or_default();
        let space = is_space(resolved);
        for (name, group) in tables_in(resolved, "particles") {
            let file = self.file(group, &name, space);
            let shape = self.shape(group, &name, space);
            self.count(group, &name, &file);
            self.diameter(group, &name, &file, shape.as_ref());
            self.mass(group, &name, &materials, shape.as_ref());
        }
    }

    /// What the grains are, with what files say of it; nothing where that is wrong.
    fn shape(&mut self, group: &mut toml::Table, name: &str, space: bool) -> Option<GrainShape> {
        let shape = group.get_mut("shape")?;
        for key in ["clump-file", "clump-mesh", "polyhedron-mesh"] {
            let Some(file) = shape.get_mut(key).and_then(Value::as_table_mut) else { continue };
            let here = ["particles", name, "shape", key];
            let path = file.get("path")?.as_str()?.to_string();
            let read = if key == "clump-file" {
                self.files.clump(&path, space, self.sources)
            } else if key == "polyhedron-mesh" && space {
                self.files.faces(&path, self.sources)
            } else if space {
                let most = usize::try_from(file.get("spheres")?.as_integer()?).ok()?;
                self.files.packing(&path, most, self.sources)
            } else {
                let wrong = Complaint::new("a mesh is a body in space, but the scene has dimension 2");
                Err(vec![wrong.hint("set dimension = 3")])
            };
            if let Err(wrong) = read {
                self.file_is_wrong(wrong, &[&here[..], &["path"]].concat());
                return None;
            }
            self.fingerprint(file, &here, &path);
        }
        let mut shape = shape.clone().try_into().ok()?;
        attach::shape(&mut shape, self.files, space);
        Some(shape)
    }

    fn file(&mut self, group: &mut toml::Table, name: &str, space: bool) -> File {
        let Some(start) = group.get_mut("start") else { return File::None };
        if self.typed(&["particles", name, "start", "file"]) && start.get("file").is_none() {
            return File::Wrong;
        }
        let Some(file) = start.get_mut("file").and_then(Value::as_table_mut) else { return File::None };
        let Some(path) = file.get("path").and_then(Value::as_str).map(str::to_string) else { return File::Wrong };
        let kind = file.get("kind").and_then(Value::as_integer).and_then(|kind| u32::try_from(kind).ok());
        let here = ["particles", name, "start", "file"];
        if kind.is_some() && !["data", "lammpstrj", "vtp"].contains(&crate::grain_file::ending(&path).as_str()) {
            self.complain(
                Complaint::new(format!(
                    "`kind` chooses an atom type, but `{path}` is neither a LAMMPS file nor VTK PolyData"
                ))
                .at(&self.root.locate(&[&here[..], &["kind"]].concat()), "not for this file")
                .hint("leave it out"),
            );
        }
        match self.files.grains(&path, How { space, kind }, self.sources) {
            Ok(read) => {
                self.fingerprint(file, &here, &path);
                File::Read(read)
            }
            Err(wrong) => {
                self.file_is_wrong(wrong, &[&here[..], &["path"]].concat());
                File::Wrong
            }
        }
    }

    fn count(&mut self, group: &mut toml::Table, name: &str, file: &File) {
        let Some(start) = group.get("start") else { return };
        let typed = self.typed(&["particles", name, "count"]);
        let (places, from) = match (file, start.get("at")) {
            (File::Read(read), _) => (read.grains.position.len(), "start.file"),
            (File::Wrong, _) => return,
            (File::None, Some(at)) => match at.get("position").and_then(Value::as_array) {
                Some(positions) => (positions.len(), "start.at"),
                None => return,
            },
            (File::None, None) => {
                if !typed {
                    self.complain(
                        Complaint::new(format!("missing key `count` in [particles.{name}]"))
                            .at(&self.root.locate(&["particles", name]), "needs `count`")
                            .hint("`count`: Number of grains; only `start.at` and `start.file` can do without"),
                    );
                }
                return;
            }
        };
        let (title, label) = if from == "start.at" {
            (format!("there are {places} positions"), format!("{places} in `start.at.position`"))
        } else {
            (format!("there are {places} grains in the file"), format!("{places} in `start.file`"))
        };
        match group.get("count").and_then(Value::as_integer) {
            Some(count) if usize::try_from(count) != Ok(places) => self.complain(
                Complaint::new(format!("`count` is {count}, but {title}"))
                    .at(&self.root.locate(&["particles", name, "count"]), label)
                    .hint(format!("leave `count` out: with `{from}` it is the number of positions")),
            ),
            None if !typed => {
                group.insert("count".into(), Value::Integer(places as i64));
            }
            _ => {}
        }
    }

    /// The mean of a distribution or of a file; a resolved scene carries it, a typed one may.
    fn diameter(&mut self, group: &mut toml::Table, name: &str, file: &File, shape: Option<&GrainShape>) {
        let in_file = match file {
            File::Read(read) => read.grains.mean_diameter(),
            File::Wrong | File::None => None,
        };
        let size: Option<Size> = group.get("size").and_then(|size| size.clone().try_into().ok());
        let equal = size == Some(Size::Equal {});
        let sized = size.as_ref().is_some_and(|size| *size != Size::Equal {});
        let own = shape.and_then(GrainShape::own_diameter);
        let mean = if own.is_some() {
            own
        } else if sized {
            if !self.size_is_right(size.as_ref(), name) {
                return;
            }
            size.zip(shape).and_then(|(size, shape)| size.mean(shape))
        } else {
            in_file
        };
        let typed = self.typed(&["particles", name, "diameter"]);
        match (group.get("diameter").and_then(Value::as_float), mean) {
            (Some(diameter), Some(mean)) if (diameter - mean).abs() > SAME * mean => {
                let (of, what) = if own.is_some() {
                    ("that of the circle that holds `shape.cells`", "that of its cells")
                } else if sized {
                    ("the mean of `size`", "the mean")
                } else {
                    ("the mean in the file", "the mean")
                };
                self.complain(
                    Complaint::new(format!("`diameter` is {diameter} m, but {of} is {mean} m"))
                        .at(&self.root.locate(&["particles", name, "diameter"]), format!("not {what}"))
                        .hint(format!("leave `diameter` out: it is {what}")),
                );
            }
            (_, Some(mean)) => {
                group.insert("diameter".into(), Value::Float(mean));
            }
            // Where size or file are wrong they may be what would have told.
            (None, None)
                if !typed
                    && equal
                    && !matches!(file, File::Wrong)
                    && !self.typed(&["particles", name, "shape", "cells"]) =>
            {
                let in_a_file = matches!(file, File::Read(_))
                    .then(|| "or put a column of diameters or radii into the file".to_string());
                self.complain(
                    Complaint::new(format!("missing key `diameter` in [particles.{name}]"))
                        .at(&self.root.locate(&["particles", name]), "needs `diameter`")
                        .hint(explained(keys::PARTICLES, "diameter"))
                        .hints(in_a_file),
                );
            }
            _ => {}
        }
    }

    fn size_is_right(&mut self, size: Option<&Size>, name: &str) -> bool {
        let before = self.complaints.len();
        let root = self.root;
        let at = |keys: &[&str]| root.locate(&[&["particles", name, "size"], keys].concat());
        match size {
            Some(Size::Uniform { smallest, largest }) if smallest >= largest => self.complain(
                Complaint::new(format!("the largest diameter of `{name}` is not above the smallest"))
                    .at(&at(&["uniform", "largest"]), format!("{largest} m, but `smallest` is {smallest} m")),
            ),
            Some(Size::Normal { mean, deviation, cut }) if mean - cut * deviation <= 0.0 => self.complain(
                Complaint::new(format!("`{name}` would have grains without a size"))
                    .at(&at(&["normal"]), format!("`mean` less {cut} deviations is not above 0"))
                    .hint(format!("take `cut` below {:.4}, or a smaller `deviation`", mean / deviation))
                    .hint("wide distributions are better told by `size.log-normal` or `size.sieve`"),
            ),
            Some(Size::Sieve { diameter, passing }) => self.sieve(diameter, passing, name),
            _ => {}
        }
        self.complaints.len() == before
    }

    fn sieve(&mut self, diameter: &[f64], passing: &[f64], name: &str) {
        let root = self.root;
        let at = |keys: &[&str]| root.locate(&[&["particles", name, "size", "sieve"], keys].concat());
        if diameter.len() != passing.len() || diameter.len() < 2 {
            self.complain(
                Complaint::new(format!("the sieve curve of `{name}` needs two sieves or more, and a share for each"))
                    .at(&at(&["passing"]), format!("{} shares for {} sieves", passing.len(), diameter.len())),
            );
            return;
        }
        if let Some(index) = diameter.windows(2).position(|pair| pair[0] >= pair[1]) {
            let [first, second] = [diameter[index], diameter[index + 1]];
            self.complain(
                Complaint::new(format!("the sieves do not rise: {second} m after {first} m"))
                    .at(&at(&["diameter", &(index + 1).to_string()]), "must be wider than the one before"),
            );
        }
        if let Some(index) = passing.windows(2).position(|pair| pair[0] > pair[1]) {
            let [first, second] = [passing[index], passing[index + 1]];
            self.complain(
                Complaint::new(format!("the shares fall: {second} after {first}"))
                    .at(&at(&["passing", &(index + 1).to_string()]), "a wider sieve lets at least as much pass"),
            );
        }
        for (index, needs) in [(0, 0.0), (passing.len() - 1, 1.0)] {
            if passing[index] != needs {
                let which = if index == 0 { "narrowest" } else { "widest" };
                self.complain(
                    Complaint::new(format!("the share that passes the {which} sieve must be {needs}"))
                        .at(&at(&["passing", &index.to_string()]), format!("is {}", passing[index]))
                        .hint("add the sieve that lets nothing pass, or the one that lets everything pass"),
                );
            }
        }
    }

    fn mass(&mut self, group: &mut toml::Table, name: &str, materials: &toml::Table, shape: Option<&GrainShape>) {
        if group.contains_key("mass") || self.typed(&["particles", name, "mass"]) {
            return;
        }
        let Some(material) = group.get("material").and_then(Value::as_str) else { return };
        let density = materials.get(material).and_then(|material| material.get("density")).and_then(Value::as_float);
        match (density, group.get("diameter").and_then(Value::as_float), shape) {
            (Some(density), Some(diameter), Some(shape)) => {
                group.insert("mass".into(), Value::Float(shape.mass(density, diameter)));
            }
            (None, ..) if !self.typed(&["materials", material, "density"]) => self.complain(
                Complaint::new(format!("the mass of `{name}` is not known"))
                    .at(&self.root.locate(&["particles", name]), "has no `mass`")
                    .hint("give `mass` here, for example \"0.2 g\"")
                    .hint(format!("or give [materials.{material}] a `density`, for example \"1190 kg/m^3\"")),
            ),
            _ => {}
        }
    }
}
