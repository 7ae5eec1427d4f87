//! Signals given as tables: read from files, or typed.

use super::table::OF_TIME;
use super::{Derive, join, list, table, tables_in};
use crate::complaint::{Complaint, Source};
use crate::units::{ANGLE, Dimension, FORCE, LENGTH};
use std::f64::consts::TAU;
use toml::Value;

/// Where a scene has signals, and what they are.
static PLACES: &[(&str, &[&str], &Dimension)] = &[
    ("particles", &["motion", "driven", "signal"], &LENGTH),
    ("walls", &["motion", "signal"], &LENGTH),
    ("walls", &["rotation", "signal"], &ANGLE),
    ("hosts", &["base"], &LENGTH),
    ("hosts", &["force"], &FORCE),
];

impl Derive<'_> {
    /// Reads the files of all table signals and checks the tables that were typed.
    pub(super) fn signals(&mut self, resolved: &mut toml::Table) {
        let seed = resolved.get("seed").and_then(Value::as_integer).unwrap_or_default();
        for (family, keys, dimension) in PLACES {
            for (name, owner) in tables_in(resolved, family) {
                let mut path = vec![*family, name.as_str()];
                let mut signal = Some(owner);
                for key in *keys {
                    path.push(key);
                    signal = signal.and_then(|table| table.get_mut(*key)).and_then(Value::as_table_mut);
                }
                let Some(signal) = signal else { continue };
                for (kind, frequency) in [("sine", "frequency"), ("sine-sweep", "from")] {
                    if let (true, Some(sine)) =
                        (**dimension == LENGTH, signal.get_mut(kind).and_then(Value::as_table_mut))
                    {
                        self.shaken(sine, frequency, &[&path[..], &[kind]].concat());
                    }
                }
                self.random(signal, seed, dimension, &path);
                self.sines(signal, &path);
                let Some(table) = signal.get_mut("table").and_then(Value::as_table_mut) else { continue };
                path.push("table");
                match table.remove("file") {
                    Some(Value::String(file)) => self.filed_table(table, &file, dimension, &path),
                    _ => self.typed_table(table, &path),
                }
            }
        }
    }

    /// The amplitude of a sine that is given by its velocity or acceleration; a sweep keeps what it is given by.
    fn shaken(&mut self, sine: &mut toml::Table, frequency: &str, path: &[&str]) {
        let sweeps = frequency == "from";
        let frequency = sine.get(frequency).and_then(Value::as_float);
        let mut given = None;
        for (key, power) in [("velocity", 1), ("acceleration", 2)] {
            let rate = sine.remove(key).and_then(|value| value.as_float());
            if let (Some(rate), Some(frequency)) = (rate, frequency) {
                sine.insert("amplitude".into(), Value::Float(rate / (TAU * frequency).powi(power)));
            }
            given = given.or(self.typed(&[path, &[key]].concat()).then_some(key));
        }
        if sweeps && !self.typed(&[path, &["keep"]].concat()) {
            sine.insert("keep".into(), given.unwrap_or("displacement").into());
        }
        if given.is_none() && !self.typed(&[path, &["amplitude"]].concat()) {
            self.complain(
                Complaint::new(format!("missing key `amplitude` in [{}]", path.join(".")))
                    .at(&self.root.locate(path), "needs `amplitude`, `velocity` or `acceleration`")
                    .hint("`amplitude`: for example \"0.5 mm\"")
                    .hint("or `acceleration`: its amplitude (2 pi frequency)^2, for example \"2 g\""),
            );
        }
    }

    fn filed_table(&mut self, table: &mut toml::Table, file: &str, dimension: &Dimension, path: &[&str]) {
        let path: Vec<&str> = path.iter().copied().chain(["file"]).collect();
        let text = match self.files.text(file, self.sources) {
            Ok(text) => text,
            Err(wrong) => return self.file_is_wrong(wrong, &path),
        };
        match table::read(&text, self.sources.len(), &OF_TIME, &[dimension]) {
            Ok(columns) => {
                for (key, column) in ["time", "value"].into_iter().zip(columns) {
                    table.insert(key.into(), list(column));
                }
            }
            Err(wrong) => {
                self.sources.push(Source { name: file.to_string(), text, numbered: true });
                self.file_is_wrong(wrong, &path);
            }
        }
    }

    fn typed_table(&mut self, table: &toml::Table, path: &[&str]) {
        let root = self.root;
        let typed = |key: &str| root.find(&[path, &[key]].concat()).is_some();
        if !typed("time") || !typed("value") {
            if !typed("file") {
                self.complain(
                    Complaint::new(format!("[{}] has no table", path.join(".")))
                        .at(&root.locate(path), "needs `file`, or `time` and `value`")
                        .hint("file = \"motion.csv\"")
                        .hint("or time = [0, 0.1, 0.2] and value = [0, 0.001, 0]"),
                );
            }
            return;
        }
        let numbers = |key: &str| -> Option<Vec<f64>> {
            table.get(key)?.as_array().map(|list| list.iter().filter_map(Value::as_float).collect())
        };
        let (Some(time), Some(value)) = (numbers("time"), numbers("value")) else { return };
        if time.is_empty() || time.len() != value.len() {
            self.complain(
                Complaint::new(format!("`{}` needs as many values as times", join(&path.join("."), "value"))).at(
                    &root.locate(&[path, &["value"]].concat()),
                    format!("{} values for {} times", value.len(), time.len()),
                ),
            );
        }
        if let Some(index) = time.windows(2).position(|pair| pair[0] >= pair[1]) {
            let item = (index + 1).to_string();
            let place = root.locate(&[path, &["time", &item]].concat());
            self.complain(OF_TIME.falls(time[index + 1], time[index]).at(&place, "must be later than the one before"));
        }
    }
}
