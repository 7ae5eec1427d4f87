//! Signals that are sums of sines: typed, or realised from a power spectral density.

use super::table::{self, OF_FREQUENCY};
use super::{Derive, join, list};
use crate::complaint::Complaint;
use crate::resolve::spectrum::{Sines, Spectrum};
use crate::units::{ACCELERATION_DENSITY, Dimension, FORCE, FORCE_DENSITY};
use std::f64::consts::TAU;
use toml::{Table, Value};

/// A spectral density as a table gives it.
struct Columns {
    frequency: Vec<f64>,
    density: Vec<f64>,
}

impl Derive<'_> {
    /// Replaces a random vibration by the sines that it is: of displacements by those whose acceleration has the density. It begins at 0.
    pub(super) fn random(&mut self, signal: &mut Table, scene_seed: i64, dimension: &Dimension, path: &[&str]) {
        let Some(Value::Table(mut random)) = signal.remove("random") else { return };
        let path = [path, &["random"]].concat();
        let force = *dimension == FORCE;
        let columns = match random.remove("file") {
            Some(Value::String(file)) => {
                self.filed_spectrum(&file, if force { &FORCE_DENSITY } else { &ACCELERATION_DENSITY }, &path)
            }
            _ => self.typed_spectrum(&random, &path),
        };
        let whole = |key: &str| random.get(key).and_then(Value::as_integer);
        let (Some(Columns { frequency, density }), Some(lines)) = (columns, whole("lines")) else {
            return;
        };
        let lines = u32::try_from(lines).unwrap_or_default();
        let spectrum = Spectrum { frequency: &frequency, density: &density };
        let Sines { mut amplitude, frequency, phase } =
            spectrum.sines(lines, whole("seed").unwrap_or(scene_seed).cast_unsigned());
        if !force {
            for (amplitude, frequency) in amplitude.iter_mut().zip(&frequency) {
                *amplitude /= (TAU * frequency).powi(2);
            }
        }
        // A displacement that jumps at time 0 would tear walls from where they were drawn; a force may.
        let begin: f64 = amplitude.iter().zip(&phase).map(|(amplitude, phase)| amplitude * phase.sin()).sum();
        let offset = if force { 0.0 } else { -begin };
        let sines = [("amplitude", amplitude), ("frequency", frequency), ("phase", phase)];
        let mut table: Table = sines.into_iter().map(|(key, numbers)| (key.to_owned(), list(numbers))).collect();
        table.insert("offset".into(), Value::Float(offset));
        signal.insert("sines".into(), Value::Table(table));
    }

    fn filed_spectrum(&mut self, file: &str, dimension: &Dimension, path: &[&str]) -> Option<Columns> {
        self.filed(file, path, |text, source| {
            let columns = table::read(text, source, &OF_FREQUENCY, &[dimension])?;
            let [frequency, density] = columns.try_into().unwrap_or_default();
            let columns = Columns { frequency, density };
            unfit(&columns).map_or(Ok(columns), |what| Err(vec![Complaint::new(what)]))
        })
    }

    fn typed_spectrum(&mut self, random: &Table, path: &[&str]) -> Option<Columns> {
        let nothing = Complaint::new(format!("[{}] has no spectral density", path.join(".")))
            .at(&self.root.locate(path), "needs `file`, or `frequency` and `psd`")
            .hint("frequency = [\"20 Hz\", \"200 Hz\"] and psd = [\"0.04 g^2/Hz\", \"0.04 g^2/Hz\"]")
            .hint("or file = \"spectrum.csv\"");
        let columns = self.typed_columns(random, (path, ["frequency", "psd"]), &OF_FREQUENCY, nothing)?;
        let [frequency, density] = columns;
        let columns = Columns { frequency, density };
        if let Some(what) = unfit(&columns) {
            self.complain(
                Complaint::new(what).at(&self.root.locate(&[path, &["frequency"]].concat()), "a band has two ends"),
            );
            return None;
        }
        Some(columns)
    }

    /// Typed sines have as many of each; their phases may be left out.
    pub(super) fn sines(&mut self, signal: &mut Table, path: &[&str]) {
        let path = [path, &["sines"]].concat();
        if !self.typed(&path) {
            return;
        }
        let Some(sines) = signal.get_mut("sines").and_then(Value::as_table_mut) else { return };
        let Some(count) = sines.get("amplitude").and_then(Value::as_array).map(Vec::len) else { return };
        if !self.typed(&[&path[..], &["phase"]].concat()) {
            sines.insert("phase".into(), list(vec![0.0; count]));
        }
        for key in ["frequency", "phase"] {
            let Some(found) = sines.get(key).and_then(Value::as_array).map(Vec::len) else { continue };
            if found != count {
                let place = self.root.locate(&[&path[..], &[key]].concat());
                self.complain(
                    Complaint::new(format!("`{}` needs one for each amplitude", join(&path.join("."), key)))
                        .at(&place, format!("{found} for {count} amplitudes")),
                );
            }
        }
    }
}

/// What is wrong with a spectrum whose frequencies rise.
fn unfit(columns: &Columns) -> Option<&'static str> {
    let positive = |numbers: &[f64]| numbers.iter().all(|x| *x > 0.0);
    match (columns.frequency.len(), positive(&columns.frequency), positive(&columns.density)) {
        (0 | 1, ..) => Some("a spectral density needs two frequencies or more"),
        (_, false, _) => Some("a spectral density needs frequencies above 0"),
        (.., false) => Some("a spectral density that is straight in logarithms is above 0"),
        _ => None,
    }
}
