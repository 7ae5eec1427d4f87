//! Damping in proportion to mass and stiffness (Rayleigh 1877).

use super::Derive;
use crate::complaint::Complaint;
use std::f64::consts::TAU;
use toml::{Table, Value};

/// What to write where no damping is told.
pub(super) const HINT: &str =
    "or `rayleigh`: C = alpha M + beta K, for example { alpha = \"0.5 1/s\", beta = \"20 us\" }";

/// C = alpha M + beta K.
#[derive(Clone, Copy)]
pub(super) struct Rayleigh {
    alpha: f64,
    beta: f64,
}

impl Rayleigh {
    pub(super) fn of(table: &Table) -> Self {
        let number = |key: &str| table.get(key).and_then(Value::as_float).unwrap_or_default();
        Self { alpha: number("alpha"), beta: number("beta") }
    }

    /// Damping over critical damping of a mode of this frequency [Hz].
    pub(super) fn ratio(self, frequency: f64) -> f64 {
        let w = TAU * frequency;
        0.5 * (self.alpha / w + self.beta * w)
    }
}

impl Derive<'_> {
    /// The damping matrix of typed matrices.
    pub(super) fn rayleigh(&mut self, name: &str, host: &mut Table) {
        let matrices = host.get_mut("structure").and_then(|structure| structure.get_mut("matrices"));
        let Some(matrices) = matrices.and_then(Value::as_table_mut) else { return };
        let path = ["hosts", name, "structure", "matrices"];
        let Some(rayleigh) = matrices.remove("rayleigh") else {
            // As many complaints as there are mistakes: none here where the damping is there and wrong. What files gave is not typed.
            let typed = |key| self.typed(&[&path[..], &[key]].concat());
            if typed("mass") && !typed("damping") && !typed("rayleigh") {
                self.complain(
                    Complaint::new(format!("missing key `damping` in [{}]", path.join(".")))
                        .at(&self.root.locate(&path), "needs `damping` or `rayleigh`")
                        .hint("`damping`: C, row by row")
                        .hint(HINT),
                );
            }
            return;
        };
        let (Some(rayleigh), Some(mass), Some(stiffness)) =
            (rayleigh.as_table().map(Rayleigh::of), rows(matrices.get("mass")), rows(matrices.get("stiffness")))
        else {
            return;
        };
        let row = |(mass, stiffness): (&Vec<f64>, &Vec<f64>)| -> Value {
            let sums = mass.iter().zip(stiffness).map(|(m, k)| rayleigh.alpha * m + rayleigh.beta * k);
            Value::Array(sums.map(Value::Float).collect())
        };
        matrices.insert("damping".into(), Value::Array(mass.iter().zip(&stiffness).map(row).collect()));
    }
}

fn rows(matrix: Option<&Value>) -> Option<Vec<Vec<f64>>> {
    let numbers = |row: &Value| -> Option<Vec<f64>> { row.as_array()?.iter().map(Value::as_float).collect() };
    matrix?.as_array()?.iter().map(numbers).collect()
}
