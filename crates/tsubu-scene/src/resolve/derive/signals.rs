//! Signals given as tables: read from files, or typed.

use super::table::OF_TIME;
use super::{Derive, list, table, tables_in};
use crate::complaint::Complaint;
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

/// What a table signal has.
const COLUMNS: [&str; 2] = ["time", "value"];

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
        let columns = self.filed(file, path, |text, source| table::read(text, source, &OF_TIME, &[dimension]));
        for (key, column) in COLUMNS.into_iter().zip(columns.into_iter().flatten()) {
            table.insert(key.into(), list(column));
        }
    }

    fn typed_table(&mut self, table: &toml::Table, path: &[&str]) {
        let nothing = Complaint::new(format!("[{}] has no table", path.join(".")))
            .at(&self.root.locate(path), "needs `file`, or `time` and `value`")
            .hint("file = \"motion.csv\"")
            .hint("or time = [0, 0.1, 0.2] and value = [0, 0.001, 0]");
        self.typed_columns(table, (path, COLUMNS), &OF_TIME, nothing);
    }
}
