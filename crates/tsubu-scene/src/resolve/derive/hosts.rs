//! Hosts that are given otherwise than by matrices or modes: beams, tables of modes, files of matrices, pendulums.

use super::{Derive, tables_in};
use crate::complaint::Complaint;
use crate::resolve::{beam, modal_table};
use crate::suggest;
use toml::{Table, Value};

impl Derive<'_> {
    pub(super) fn hosts(&mut self, resolved: &mut Table) {
        self.oscillators(resolved);
        let gravity = resolved.get("gravity").and_then(vector).unwrap_or_default();
        for (name, host) in tables_in(resolved, "hosts") {
            self.modal_table(&name, host);
            self.matrix_files(&name, host);
            self.rayleigh(&name, host);
            participation(host);
            self.beam(&name, host);
            self.pendulum(&name, host, gravity);
            self.interfaces(&name, host);
            if let Some(dwell) = host.get_mut("dwell").and_then(Value::as_table_mut)
                && !self.typed(&["hosts", &name, "dwell", "keep"])
            {
                dwell.insert("keep".into(), self.kept(&name));
            }
        }
    }

    fn oscillators(&mut self, resolved: &mut toml::Table) {
        for (name, host) in tables_in(resolved, "hosts") {
            let path = ["hosts", &name, "structure", "oscillator"];
            let Some(oscillator) =
                host.get_mut("structure").and_then(|s| s.get_mut("oscillator")).and_then(Value::as_table_mut)
            else {
                continue;
            };
            let ratio = oscillator.remove("damping-ratio").and_then(|ratio| ratio.as_float());
            let number = |key: &str| oscillator.get(key).and_then(Value::as_float);
            if let (Some(ratio), Some(mass), Some(stiffness)) = (ratio, number("mass"), number("stiffness")) {
                oscillator.insert("damping".into(), Value::Float(2.0 * ratio * (stiffness * mass).sqrt()));
            }
            let typed = |key| self.typed(&[path[0], path[1], path[2], path[3], key]);
            if !typed("damping") && !typed("damping-ratio") {
                self.complain(
                    Complaint::new(format!("missing key `damping` in [hosts.{name}.structure.oscillator]"))
                        .at(&self.root.locate(&path), "needs `damping` or `damping-ratio`")
                        .hint("`damping`: C, for example \"0.08 N s/m\"")
                        .hint("or `damping-ratio`: C over its critical value, for example 0.01"),
                );
            }
        }
    }

    fn modal_table(&mut self, name: &str, host: &mut Table) {
        let Some(file) = taken(host, "modal-table").and_then(|table| table.get("file")?.as_str().map(str::to_owned))
        else {
            return;
        };
        let path = ["hosts", name, "structure", "modal-table", "file"];
        let text = match self.files.text(&file, self.sources) {
            Ok(text) => text,
            Err(wrong) => return self.file_is_wrong(wrong, &path),
        };
        match modal_table::read(&text, self.sources.len()) {
            Ok(found) => {
                let modes = Table::from_iter([("mode".to_owned(), Value::Array(found.modes))]);
                host.insert("structure".into(), Value::Table(Table::from_iter([("modes".to_owned(), modes.into())])));
                for (interface, [translation, rotation]) in found.interfaces {
                    let place = self.root.locate(&["hosts", name, "interface"]);
                    match host
                        .get_mut("interface")
                        .and_then(|all| all.get_mut(&interface))
                        .and_then(Value::as_table_mut)
                    {
                        Some(table) => {
                            table.entry("translation").or_insert(translation);
                            table.entry("rotation").or_insert(rotation);
                        }
                        None => self.complain(
                            Complaint::new(format!(
                                "`{file}` has an interface `{interface}` that the host `{name}` has not"
                            ))
                            .at(&place, "its place is not known")
                            .hint(format!("add `interface.{interface}.point = [x, y, z]`, where it is as drawn")),
                        ),
                    }
                }
            }
            Err(wrong) => {
                self.sources.push(crate::complaint::Source { name: file, text, numbered: true });
                self.file_is_wrong(wrong, &path);
            }
        }
    }

    fn beam(&mut self, name: &str, host: &mut Table) {
        let direction = host.get("direction").and_then(vector);
        let Some(beam) = taken(host, "beam") else { return };
        let number = |table: &Table, key: &str| table.get(key).and_then(Value::as_float);
        let section = beam.get("section").and_then(Value::as_table).and_then(|section| {
            let of = |shape: &str| section.get(shape).and_then(Value::as_table);
            if let Some(rectangle) = of("rectangle") {
                return Some(beam::rectangle(number(rectangle, "width")?, number(rectangle, "height")?));
            }
            Some(beam::round(number(of("round")?, "diameter")?))
        });
        let (Some(section), Some(length), Some(modulus), Some(density), Some(ratio), Some(count)) = (
            section,
            number(&beam, "length"),
            number(&beam, "young-modulus"),
            number(&beam, "density"),
            number(&beam, "damping-ratio"),
            beam.get("modes").and_then(Value::as_integer),
        ) else {
            return;
        };
        let (Some(root), Some(axis), Some(direction)) =
            (beam.get("root").and_then(vector), beam.get("axis").and_then(vector), direction)
        else {
            return;
        };
        if dot(axis, direction).abs() > 1e-6 {
            self.complain(
                Complaint::new(format!("the beam `{name}` would bend along its own axis"))
                    .at(
                        &self.root.locate(&["hosts", name, "structure", "beam"]),
                        "`axis` is not across the host's `direction`",
                    )
                    .hint("a beam along x that bends up and down has `axis = \"x\"` and `direction = \"z\"`"),
            );
        }
        let modes: Vec<beam::Mode> =
            (1..=count as usize).map(|number| beam::Mode::new(number, length, section, modulus, density)).collect();
        let mode = |mode: &beam::Mode| {
            let keys = [
                ("frequency", mode.frequency),
                ("damping-ratio", ratio),
                ("mass", mode.mass),
                ("shape", mode.at(1.0).0),
                ("participation", mode.participation),
            ];
            Value::Table(keys.into_iter().map(|(key, value)| (key.to_owned(), Value::Float(value))).collect())
        };
        let list = Table::from_iter([("mode".to_owned(), Value::Array(modes.iter().map(mode).collect()))]);
        host.insert("structure".into(), Value::Table(Table::from_iter([("modes".to_owned(), list.into())])));
        let Some(interfaces) = host.get_mut("interface").and_then(Value::as_table_mut) else { return };
        for (interface, table) in interfaces.iter_mut().filter_map(|(key, value)| Some((key, value.as_table_mut()?))) {
            let path = ["hosts", name, "interface", interface.as_str()];
            let Some(along) = table.remove("along").and_then(|along| along.as_float()) else {
                self.complaints.push(
                    Complaint::new(format!("missing key `along` in [{}]", path.join(".")))
                        .at(&self.root.locate(&path), "on a beam it needs `along`")
                        .hint("the distance from the root, for example \"0.2 m\""),
                );
                continue;
            };
            if along > length {
                self.complaints.push(
                    Complaint::new(format!("the interface `{interface}` lies beyond the beam"))
                        .at(&self.root.locate(&[&path[..], &["along"]].concat()), format!("{along} m from the root"))
                        .hint(format!("the beam is {length} m long")),
                );
            }
            // A slope in the plane of axis and direction turns about what stands across both.
            let about = cross(axis, direction);
            let shapes: Vec<(f64, f64)> = modes.iter().map(|mode| mode.at(along / length)).collect();
            let list = |scaled: &dyn Fn(&(f64, f64)) -> [f64; 3]| {
                Value::Array(shapes.iter().map(|shape| array(scaled(shape))).collect())
            };
            table.insert("translation".into(), list(&|shape| direction.map(|d| d * shape.0)));
            table.insert("rotation".into(), list(&|shape| about.map(|a| a * shape.1)));
            table.entry("point").or_insert_with(|| array([0, 1, 2].map(|k| root[k] + axis[k] * along)));
        }
    }

    fn pendulum(&mut self, name: &str, host: &mut Table, gravity: [f64; 3]) {
        let pendulum = host.get_mut("structure").and_then(|structure| structure.get_mut("pendulum"));
        let Some(pendulum) = pendulum.and_then(Value::as_table_mut) else { return };
        let mut number = |key: &str| pendulum.remove(key).and_then(|value| value.as_float());
        let (mass, centre) = (number("mass"), number("centre"));
        let (Some(mass), Some(centre), Some(axis)) = (mass, centre, pendulum.get("axis").and_then(vector)) else {
            return;
        };
        let across = cross(axis, gravity);
        let pull = dot(across, across).sqrt();
        pendulum.insert("moment".into(), Value::Float(mass * centre * pull));
        if pendulum
            .get("inertia")
            .and_then(Value::as_float)
            .is_some_and(|inertia| inertia < mass * centre * centre * (1.0 - 1e-9))
        {
            self.complain(
                Complaint::new(format!("the pendulum `{name}` has less inertia than its mass at one point"))
                    .at(&self.root.locate(&["hosts", name, "structure", "pendulum", "inertia"]), "about the axis")
                    .hint(format!("it has at least mass x centre^2 = {:e} kg m^2", mass * centre * centre)),
            );
        }
    }

    /// What is told where nobody says it: the only interface.
    fn interfaces(&mut self, name: &str, host: &mut Table) {
        // What a file or a beam did not give has been complained about.
        let read = host.get("structure").and_then(Value::as_table).is_some_and(|structure| !structure.is_empty());
        let read = read && !self.typed(&["hosts", name, "structure", "beam"]);
        let Some(interfaces) = host.get_mut("interface").and_then(Value::as_table_mut) else { return };
        let names: Vec<String> = interfaces.keys().cloned().collect();
        for (interface, table) in interfaces.iter_mut().filter_map(|(key, value)| Some((key, value.as_table_mut()?))) {
            let path = ["hosts", name, "interface", interface.as_str()];
            for (key, hint) in [
                ("point", "where it is as drawn, for example [\"0.3 m\", 0, 0]"),
                ("translation", "a vector for each coordinate, for example [[0, 0, 1]]"),
            ] {
                if read && !table.contains_key(key) && !self.typed(&[&path[..], &[key]].concat()) {
                    self.complaints.push(
                        Complaint::new(format!("missing key `{key}` in [{}]", path.join(".")))
                            .at(&self.root.locate(&path), format!("needs `{key}`"))
                            .hint(hint),
                    );
                }
            }
            table.entry("rotation").or_insert_with(|| Value::Array(Vec::new()));
            for (key, what, label) in [
                ("along", "a place on a beam", "the structure is no beam"),
                ("node", "a node of `matrix-files`", "the structure has no such files"),
            ] {
                if table.remove(key).is_some() {
                    self.complaints.push(
                        Complaint::new(format!("`{key}` in [{}] is {what}", path.join(".")))
                            .at(&self.root.locate(&[&path[..], &[key]].concat()), label),
                    );
                }
            }
        }
        match (host.get("at").and_then(Value::as_str), names.as_slice()) {
            (None, [only]) => {
                host.insert("at".into(), Value::String(only.clone()));
            }
            (None, []) => {}
            (None, many) => self.complain(
                Complaint::new(format!("missing key `at` in [hosts.{name}]"))
                    .at(&self.root.locate(&["hosts", name]), "has several interfaces")
                    .hint(format!(
                        "say whose displacement is told: {}",
                        suggest::list(many.iter().map(String::as_str))
                    )),
            ),
            (Some(at), _) if names.iter().any(|name| name == at) => {}
            (Some(at), _) => self.complain(
                Complaint::new(format!("the host `{name}` has no interface `{at}`"))
                    .at(&self.root.locate(&["hosts", name, "at"]), "not an interface")
                    .hint(format!("interfaces here: {}", suggest::list(names.iter().map(String::as_str)))),
            ),
        }
    }
}

/// The base drives all coordinates of matrices alike, where nobody says otherwise.
fn participation(host: &mut Table) {
    let matrices = host.get_mut("structure").and_then(|structure| structure.get_mut("matrices"));
    let Some(matrices) = matrices.and_then(Value::as_table_mut) else { return };
    let n = matrices.get("mass").and_then(Value::as_array).map_or(0, Vec::len);
    matrices.entry("participation").or_insert_with(|| Value::Array(vec![Value::Float(1.0); n]));
}

/// Takes the table of a structure of this kind away, to be replaced.
pub(super) fn taken(host: &mut Table, kind: &str) -> Option<Table> {
    match host.get_mut("structure")?.as_table_mut()?.remove(kind)? {
        Value::Table(table) => Some(table),
        _ => None,
    }
}

pub(super) fn vector(value: &Value) -> Option<[f64; 3]> {
    let list: Vec<f64> = value.as_array()?.iter().filter_map(Value::as_float).collect();
    list.try_into().ok()
}

pub(super) fn array(vector: [f64; 3]) -> Value {
    Value::Array(vector.into_iter().map(Value::Float).collect())
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
