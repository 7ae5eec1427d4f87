//! Hosts by files of matrices: kept as they are with a damping matrix, by their modes with a damping ratio.

use super::Derive;
use super::hosts::{taken, vector};
use super::rayleigh::{self, Rayleigh};
use crate::complaint::{Complaint, Source};
use crate::resolve::matrices::{self, Coordinate, Matrix, Role, Units};
use crate::symmetric::asymmetry;
use std::collections::{BTreeMap, BTreeSet};
use toml::{Table, Value};

/// Frequencies below this part of the highest are those of motion without stiffness: squared, no more than rounding.
const FREE: f64 = 1e-7;

/// Modes that are kept where nobody says how many.
const MODES: usize = 10;

/// What became of the coordinates of the files.
struct Kept {
    /// The structure, as a scene says it.
    structure: Table,
    /// What a unit of each coordinate that is kept moves of those in the files.
    shapes: Vec<Vec<f64>>,
}

impl Derive<'_> {
    pub(super) fn matrix_files(&mut self, name: &str, host: &mut Table) {
        let Some(files) = taken(host, "matrix-files") else { return };
        let nodes = nodes(host);
        let path = ["hosts", name, "structure", "matrix-files"];
        let direction = host.get("direction").and_then(vector);
        let units = files.get("units").and_then(Value::as_str).and_then(Units::named);
        let (Some(direction), Some(units)) = (direction, units) else { return };
        let Some((coordinates, read)) = self.matrices(&files, &path) else { return };
        let rows = |role| read.get(&role).map(|matrix| matrix.rows(&coordinates, units));
        let (Some(mass), Some(stiffness)) = (rows(Role::Mass), rows(Role::Stiffness)) else { return };
        let weightless = (0..coordinates.len()).find(|index| mass[*index][*index] == 0.0);
        if let Some(index) = weightless {
            return self.complain(
                Complaint::new(format!(
                    "the host `{name}` has a coordinate without mass: {}",
                    told(coordinates[index])
                ))
                .at(&self.root.locate(&[&path[..], &["mass"]].concat()), "0 on the diagonal, or no entry")
                .hint("condense it out where the structure is reduced"),
            );
        }
        let base = base(&coordinates, direction);
        let kept = match rows(Role::Damping) {
            Some(damping) => Some(whole(&files, &mass, &damping, &stiffness, &base)),
            None => self.by_modes(&files, &path, &mass, &stiffness, &base),
        };
        let Some(kept) = kept else { return };
        self.places(name, host, &nodes, &coordinates, &kept.shapes);
        host.insert("structure".into(), Value::Table(kept.structure));
    }

    /// The matrices, by role, and all of their coordinates. `None` where something is wrong, which is complained about.
    fn matrices(&mut self, files: &Table, path: &[&str; 4]) -> Option<(Vec<Coordinate>, BTreeMap<Role, Matrix>)> {
        let names = match files.get("nodes").and_then(Value::as_str) {
            Some(file) => Some(self.read(file, &[&path[..], &["nodes"]].concat(), matrices::names)?),
            None => None,
        };
        let mut read = BTreeMap::new();
        for role in [Role::Mass, Role::Stiffness, Role::Damping] {
            let Some(file) = files.get(role.key()).and_then(Value::as_str) else { continue };
            let place = [&path[..], &[role.key()]].concat();
            let matrix =
                self.read(file, &place, |text, source| matrices::read(text, source, role, names.as_deref()))?;
            read.insert(role, matrix);
        }
        if !["damping", "damping-ratio", "rayleigh"].iter().any(|key| files.contains_key(*key)) {
            self.complain(
                Complaint::new(format!("missing key `damping-ratio` in [{}]", path.join(".")))
                    .at(&self.root.locate(path), "needs `damping-ratio`, `rayleigh` or `damping`")
                    .hint("`damping-ratio`: of each mode, for example 0.01")
                    .hint(rayleigh::HINT)
                    .hint("or `damping`: the file of C"),
            );
            return None;
        }
        let coordinates: BTreeSet<Coordinate> =
            read.values().flat_map(|matrix| matrix.coordinates.iter().copied()).collect();
        Some((coordinates.into_iter().collect(), read))
    }

    /// A file by its reader.
    fn read<T>(
        &mut self,
        file: &str,
        path: &[&str],
        read: impl FnOnce(&str, usize) -> Result<T, Complaint>,
    ) -> Option<T> {
        let text = match self.files.text(file, self.sources) {
            Ok(text) => text,
            Err(wrong) => {
                self.file_is_wrong(wrong, path);
                return None;
            }
        };
        match read(&text, self.sources.len()) {
            Ok(found) => Some(found),
            Err(wrong) => {
                self.sources.push(Source { name: file.to_owned(), text, numbered: true });
                self.file_is_wrong(vec![wrong], path);
                None
            }
        }
    }

    /// The lowest modes, with a damping ratio.
    fn by_modes(
        &mut self,
        files: &Table,
        path: &[&str; 4],
        mass: &[Vec<f64>],
        stiffness: &[Vec<f64>],
        base: &[f64],
    ) -> Option<Kept> {
        let mut refuse = |key: &str, what: &str, label: String, hint: &str| {
            let place = self.root.locate(&[&path[..], &[key]].concat());
            self.complain(
                Complaint::new(format!("`{key}` of the host `{}` {what}", path[1])).at(&place, label).hint(hint),
            );
        };
        for (key, matrix) in [("mass", mass), ("stiffness", stiffness)] {
            if let Some((i, j)) = asymmetry(matrix) {
                let label = format!("row {}, column {}: {}, mirrored {}", i + 1, j + 1, matrix[i][j], matrix[j][i]);
                refuse(key, "is not symmetric", label, "was another file meant?");
                return None;
            }
        }
        let Some(all) = matrices::modes(mass, stiffness) else {
            let hint = "every motion needs inertia: condense out what has none";
            refuse("mass", "is not positive definite", "some motion would have no or negative energy".into(), hint);
            return None;
        };
        let highest = all.last().map_or(0.0, |mode| mode.frequency);
        let free = all.iter().filter(|mode| mode.frequency <= FREE * highest).count();
        if free > 0 {
            let hint = "hold the structure where it is mounted, before its matrices are written";
            refuse("stiffness", "lets it move freely", format!("motions without stiffness: {free}"), hint);
            return None;
        }
        let number = |key: &str| files.get(key).and_then(Value::as_integer).map(|number| number as usize);
        let kept = number("modes").unwrap_or(all.len().min(MODES));
        if kept > all.len() {
            refuse("modes", "asks for too many", format!("it has {}", all.len()), "each coordinate gives one");
            return None;
        }
        let rayleigh = files.get("rayleigh").and_then(Value::as_table).map(Rayleigh::of);
        let typed = files.get("damping-ratio").and_then(Value::as_float);
        let coordinate = number("coordinate").unwrap_or_default();
        let pushed: Vec<f64> = mass.iter().map(|row| sum(row, base)).collect();
        let mut modes = Vec::new();
        for mode in &all[..kept] {
            let Some(shape) = mode.shape.get(coordinate) else {
                refuse(
                    "coordinate",
                    "is not there",
                    format!("coordinates here: 0 to {}", all.len() - 1),
                    "count from 0",
                );
                return None;
            };
            let keys = [
                ("frequency", mode.frequency),
                ("damping-ratio", rayleigh.map_or(typed, |rayleigh| Some(rayleigh.ratio(mode.frequency)))?),
                ("mass", 1.0),
                ("shape", *shape),
                ("participation", sum(&mode.shape, &pushed)),
            ];
            modes.push(Value::Table(
                keys.map(|(key, value)| (key.to_owned(), Value::Float(value))).into_iter().collect(),
            ));
        }
        let list = Table::from_iter([("mode".to_owned(), Value::Array(modes))]);
        let shapes = all.into_iter().take(kept).map(|mode| mode.shape).collect();
        Some(Kept { structure: Table::from_iter([("modes".to_owned(), list.into())]), shapes })
    }

    /// How the interfaces move: as their nodes do, or as is typed for each coordinate of the files.
    fn places(
        &mut self,
        name: &str,
        host: &mut Table,
        nodes: &BTreeMap<String, u64>,
        coordinates: &[Coordinate],
        shapes: &[Vec<f64>],
    ) {
        let Some(interfaces) = host.get_mut("interface").and_then(Value::as_table_mut) else { return };
        for (interface, table) in interfaces.iter_mut().filter_map(|(key, value)| Some((key, value.as_table_mut()?))) {
            let path = ["hosts", name, "interface", interface.as_str()];
            let kept = |moves: &[[f64; 3]]| -> Value {
                let of = |shape: &Vec<f64>| [0, 1, 2].map(|k| shape.iter().zip(moves).map(|(s, m)| s * m[k]).sum());
                Value::Array(shapes.iter().map(|shape| super::hosts::array(of(shape))).collect())
            };
            let Some(node) = nodes.get(interface) else {
                for key in ["translation", "rotation"] {
                    let typed: Option<Vec<[f64; 3]>> =
                        table.get(key).and_then(Value::as_array).map(|list| list.iter().filter_map(vector).collect());
                    // Another number of vectors is complained about where all hosts are.
                    if let Some(typed) = typed.filter(|typed| typed.len() == coordinates.len()) {
                        table.insert(key.to_owned(), kept(&typed));
                    }
                }
                continue;
            };
            if !coordinates.iter().any(|coordinate| coordinate.node == *node && coordinate.direction > 0) {
                let known: BTreeSet<u64> = coordinates.iter().filter(|c| c.direction > 0).map(|c| c.node).collect();
                let hint = if known.is_empty() {
                    "the files only number their coordinates: type `translation`, or give `nodes`, the file `.dof` of CalculiX".into()
                } else {
                    let first: Vec<String> = known.iter().take(12).map(u64::to_string).collect();
                    format!("nodes here: {}{}", first.join(", "), if known.len() > 12 { ", and more" } else { "" })
                };
                self.complaints.push(
                    Complaint::new(format!("the matrices of the host `{name}` have no node {node}"))
                        .at(&self.root.locate(&[&path[..], &["node"]].concat()), "not one that moves")
                        .hint(hint),
                );
            }
            for (key, first) in [("translation", 1), ("rotation", 4)] {
                let moves: Vec<[f64; 3]> = coordinates
                    .iter()
                    .map(|c| [0, 1, 2].map(|k| f64::from(u8::from(c.node == *node && c.direction == first + k))))
                    .collect();
                table.insert(key.to_owned(), kept(&moves));
            }
        }
    }
}

/// Takes away what interfaces say of nodes.
fn nodes(host: &mut Table) -> BTreeMap<String, u64> {
    let interfaces = host.get_mut("interface").and_then(Value::as_table_mut).into_iter().flatten();
    let node = |table: &mut Value| table.as_table_mut()?.remove("node")?.as_integer().map(|node| node as u64);
    interfaces.filter_map(|(name, table)| Some((name.clone(), node(table)?))).collect()
}

/// The matrices as they are.
fn whole(files: &Table, mass: &[Vec<f64>], damping: &[Vec<f64>], stiffness: &[Vec<f64>], base: &[f64]) -> Kept {
    let list = |row: &[f64]| Value::Array(row.iter().copied().map(Value::Float).collect());
    let rows = |matrix: &[Vec<f64>]| Value::Array(matrix.iter().map(|row| list(row)).collect());
    let mut matrices = Table::new();
    for (key, matrix) in [("mass", mass), ("damping", damping), ("stiffness", stiffness)] {
        matrices.insert(key.to_owned(), rows(matrix));
    }
    matrices.insert("coordinate".into(), files.get("coordinate").cloned().unwrap_or(Value::Integer(0)));
    matrices.insert("participation".into(), list(base));
    let n = mass.len();
    let shapes = (0..n).map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect()).collect();
    Kept { structure: Table::from_iter([("matrices".to_owned(), matrices.into())]), shapes }
}

/// How the base moves each coordinate as it shifts the structure along a direction; coordinates that are only numbered move with it.
fn base(coordinates: &[Coordinate], direction: [f64; 3]) -> Vec<f64> {
    let numbered = coordinates.iter().all(|coordinate| coordinate.direction == 0);
    let along = |coordinate: &Coordinate| match coordinate.direction {
        1..=3 => direction[usize::from(coordinate.direction) - 1],
        _ => f64::from(u8::from(numbered)),
    };
    coordinates.iter().map(along).collect()
}

fn told(coordinate: Coordinate) -> String {
    match coordinate.direction {
        0 => format!("number {}", coordinate.node),
        direction => format!("node {}, direction {direction}", coordinate.node),
    }
}

fn sum(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
