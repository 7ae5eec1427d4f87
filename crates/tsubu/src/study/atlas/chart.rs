//! The file of an atlas: written, read again, and asked for what lies between its points.

use super::{Done, refine};
use crate::study::cases::{CasesError, cases};
use crate::study::response::case_plans;
use nalgebra::Complex;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use tsubu_frame::{Cell, FileError, Status, Summary, Table};
use tsubu_scene::{Plan, Scene};

/// Its name in the folder.
pub(super) const FILE: &str = "atlas.csv";

const HEADER: [&str; 13] = [
    "case [text]",
    "particles [-]",
    "grain mass [kg]",
    "frequency [Hz]",
    "acceleration [m/s^2]",
    "seed [-]",
    "effective mass [kg]",
    "lossy mass [kg]",
    "error [kg]",
    "loss factor [-]",
    "lost mass [kg]",
    "energy residual [-]",
    "periods discarded [-]",
];

/// Why a folder is no atlas that can be used.
#[derive(Debug, thiserror::Error)]
pub enum AtlasError {
    /// A file that is not there, or says something else.
    #[error(transparent)]
    File(#[from] FileError),
    /// Not an atlas, or an unfinished one.
    #[error("{}: {what}", path.display())]
    Unusable {
        /// The folder.
        path: PathBuf,
        /// What is wrong with it.
        what: String,
    },
}

/// The table of all points.
pub(super) fn table(names: &[String], plans: &[Plan], points: &Done) -> Table {
    let mut table = Table::new(HEADER);
    for (key, point) in points {
        let mass = super::mass(&plans[key.case]);
        let numbers = [
            plans[key.case].grains() as f64,
            mass,
            key.frequency.0,
            key.acceleration.0,
            f64::from(key.seed),
            point.mass,
            point.lossy_mass,
            point.error.unwrap_or(f64::NAN),
            point.lossy_mass / mass,
            point.lost_mass,
            point.residual,
            f64::from(point.discarded),
        ];
        let name = Cell::Text(names[key.case].clone());
        table.push(std::iter::once(name).chain(numbers.map(Cell::Number)));
    }
    table
}

/// A cavity of an atlas.
#[derive(Clone, Debug)]
pub struct Cavity {
    /// The case.
    pub name: String,
    /// What is in it and about it, as the scene of the atlas has it.
    pub plan: Plan,
    /// The host that was a shaker.
    pub host: String,
    /// Frequencies that were measured, first and last [Hz].
    pub frequency: [f64; 2],
    /// Accelerations [m/s^2].
    pub acceleration: [f64; 2],
    /// What was measured: a chart for each seed.
    pub charts: Vec<Chart>,
}

/// Points at one frequency [Hz]: acceleration [m/s^2], mass and error [kg].
type Column = (f64, Vec<(f64, Complex<f64>, f64)>);

/// The complex mass of one bed over frequency and acceleration.
#[derive(Clone, Debug, Default)]
pub struct Chart {
    /// Columns by frequency: acceleration, mass, error.
    columns: Vec<Column>,
}

/// What a cavity shows.
#[derive(Clone, Copy, Debug)]
pub struct Shown {
    /// The mass m - i m' [kg].
    pub mass: Complex<f64>,
    /// How far off it may be: twice the standard error of the measurement, and what the straight lines leave out [kg].
    pub error: f64,
}

impl Chart {
    /// What is shown at a frequency [Hz] and acceleration [m/s^2]: on straight lines over their logarithms, and that of the edge
    /// beyond it.
    pub fn at(&self, frequency: f64, acceleration: f64) -> Shown {
        let after = self.columns.partition_point(|(own, _)| *own < frequency);
        let of = |column: usize| {
            let (f, points) = self.columns.get(column)?;
            Some((*f, refine::at(points, acceleration)))
        };
        let (mass, error) = match (after.checked_sub(1).and_then(of), of(after)) {
            (Some((low, below)), Some((high, above))) => {
                let share = (frequency / low).ln() / (high / low).ln();
                (below.0 * (1.0 - share) + above.0 * share, below.1.max(above.1))
            }
            (Some((_, edge)), None) | (None, Some((_, edge))) => edge,
            (None, None) => (Complex::default(), 0.0),
        };
        Shown { mass, error }
    }

    /// A chart of columns whose points carry standard errors: each gets what it lies off the lines between its neighbours as well, of
    /// which about a quarter is left out halfway between points.
    fn new(mut columns: Vec<Column>) -> Self {
        let plain = columns.clone();
        for (index, (frequency, points)) in columns.iter_mut().enumerate() {
            for (row, (acceleration, mass, error)) in points.iter_mut().enumerate() {
                let along = row.checked_sub(1).and_then(|before| {
                    let (low, high) = (plain[index].1.get(before)?, plain[index].1.get(row + 1)?);
                    Some(refine::between([low.0, high.0], [low.1, high.1], *acceleration))
                });
                let across = index.checked_sub(1).and_then(|before| {
                    let (low, high) = (plain.get(before)?, plain.get(index + 1)?);
                    let values = [&low.1, &high.1].map(|column| refine::at(column, *acceleration).0);
                    Some(refine::between([low.0, high.0], values, *frequency))
                });
                let off = [along, across].into_iter().flatten().map(|line| (*mass - line).norm());
                *error = 2.0 * if error.is_finite() { *error } else { 0.0 } + 0.25 * off.sum::<f64>();
            }
        }
        Self { columns }
    }
}

/// Reads a finished atlas from its folder.
pub fn read(folder: &Path) -> Result<Vec<Cavity>, AtlasError> {
    let unusable = |what: &str| AtlasError::Unusable { path: folder.to_owned(), what: what.to_owned() };
    let file = folder.join(FILE);
    if !file.is_file() {
        return Err(unusable("not an atlas: there is no atlas.csv in it; `tsubu atlas SCENE` makes one"));
    }
    if Summary::read(&folder.join("summary.json"))?.status == Status::Interrupted {
        return Err(unusable("the atlas is not finished: the same `tsubu atlas` again goes on with it"));
    }
    let scene = Scene::read(&folder.join("scene.toml"), &[]).map_err(|error| unusable(&error.to_string()))?;
    let wanted = scene.plan().atlas.clone().ok_or_else(|| unusable("its scene has no `[atlas]`"))?;
    let cases = cases(&wanted.vary);
    let plans = case_plans(&scene, &cases).map_err(|error: CasesError| unusable(&error.to_string()))?;
    let table = Table::read(&file)?;
    let column = |name: &str| table.numbers(name).ok_or_else(|| unusable(&format!("atlas.csv has no `{name}`")));
    let names = table.texts("case").ok_or_else(|| unusable("atlas.csv has no `case`"))?;
    let [frequency, acceleration, seed, mass, lossy, error] =
        ["frequency", "acceleration", "seed", "effective mass", "lossy mass", "error"].map(column);
    let (frequency, acceleration, seed) = (frequency?, acceleration?, seed?);
    let (mass, lossy, error) = (mass?, lossy?, error?);
    let named = super::write::names(&cases);
    let mut cavities = Vec::new();
    for (plan, name) in plans.into_iter().zip(named) {
        let mut seeds: BTreeMap<u64, BTreeMap<u64, Vec<(f64, Complex<f64>, f64)>>> = BTreeMap::new();
        let rows = (0..names.len()).filter(|row| names[*row] == name);
        for row in rows {
            let values = [frequency[row], acceleration[row], mass[row], lossy[row]];
            if !values.iter().all(|value| value.is_finite()) || frequency[row] <= 0.0 || acceleration[row] <= 0.0 {
                return Err(unusable(&format!("line {} of atlas.csv says no numbers that can be", row + 2)));
            }
            let chart = seeds.entry(seed[row].to_bits()).or_default();
            let point = (acceleration[row], Complex::new(mass[row], -lossy[row]), error[row]);
            // Positive numbers are in the order of their bits.
            chart.entry(frequency[row].to_bits()).or_default().push(point);
        }
        let chart = |columns: BTreeMap<u64, Vec<(f64, Complex<f64>, f64)>>| {
            let column = |(frequency, mut points): (u64, Vec<(f64, Complex<f64>, f64)>)| {
                points.sort_by(|a, b| a.0.total_cmp(&b.0));
                (f64::from_bits(frequency), points)
            };
            Chart::new(columns.into_iter().map(column).collect())
        };
        cavities.push(Cavity {
            name,
            plan,
            host: wanted.host.clone(),
            frequency: wanted.frequency,
            acceleration: wanted.acceleration,
            charts: seeds.into_values().map(chart).collect(),
        });
    }
    Ok(cavities)
}
