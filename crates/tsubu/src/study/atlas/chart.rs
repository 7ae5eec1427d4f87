//! The file of an atlas: written, read again, and asked for what lies between its points.

use super::Done;
use super::shown::{Column, Shown, at, between};
use crate::study::cases::{Case, CasesError, case_plans, cases};
use crate::study::journal::Exact;
use nalgebra::Complex;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use tsubu_frame::{Cell, FileError, ResultValue, Status, Summary, Table};
use tsubu_scene::{Plan, Scene, plan};

/// Its name in the folder.
pub(super) const FILE: &str = "atlas.csv";

const HEADER: [&str; 15] = [
    "case [text]",
    "particles [-]",
    "grain mass [kg]",
    "frequency [Hz]",
    "acceleration [m/s^2]",
    "seed [-]",
    "effective mass [kg]",
    "lossy mass [kg]",
    "error [kg]",
    "higher harmonics [kg]",
    "loss factor [-]",
    "lost mass [kg]",
    "energy residual [-]",
    "periods discarded [-]",
    "periods measured [-]",
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

/// What the cases are called in tables.
pub(super) fn names(cases: &[Case]) -> Vec<String> {
    cases.iter().map(|case| if case.name.is_empty() { "scene".to_owned() } else { case.name.clone() }).collect()
}

/// The table of all points.
pub(super) fn table(names: &[String], plans: &[Plan], points: &Done) -> Table {
    let mut table = Table::new(HEADER);
    for (key, point) in points {
        let mass = plans[key.case].grain_mass();
        let numbers = [
            plans[key.case].grains() as f64,
            mass,
            key.frequency.0,
            key.acceleration.0,
            f64::from(key.seed),
            point.mass,
            point.lossy_mass,
            point.error.unwrap_or(f64::NAN),
            point.harmonics,
            point.lossy_mass / mass,
            point.lost_mass,
            point.residual,
            f64::from(point.discarded),
            f64::from(point.measured),
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
    /// What is missing in the atlas, where some of its runs failed.
    pub lost: Option<String>,
}

impl Cavity {
    /// A cavity from its points: seed, [frequency [Hz], acceleration [m/s^2]], and what was shown there.
    pub(super) fn new(
        name: String,
        plan: Plan,
        wanted: &plan::Atlas,
        points: impl IntoIterator<Item = (u32, [f64; 2], Shown)>,
    ) -> Self {
        let mut seeds: BTreeMap<u32, Vec<([f64; 2], Shown)>> = BTreeMap::new();
        for (seed, place, shown) in points {
            seeds.entry(seed).or_default().push((place, shown));
        }
        let charts = seeds.into_values().map(Chart::new).collect();
        let (host, frequency, acceleration) = (wanted.host.clone(), wanted.frequency, wanted.acceleration);
        Self { name, plan, host, frequency, acceleration, charts, lost: None }
    }
}

/// What one bed showed over frequency and acceleration.
#[derive(Clone, Debug, Default)]
pub struct Chart {
    /// Columns by frequency [Hz], rising.
    columns: Vec<(f64, Column)>,
}

impl Chart {
    /// A chart of points, each [frequency [Hz], acceleration [m/s^2]], with their standard errors [kg]. The error becomes twice that, for
    /// 95 %, with what the straight lines leave out: about a quarter of what a point lies off the line between its neighbours.
    pub fn new(points: impl IntoIterator<Item = ([f64; 2], Shown)>) -> Self {
        let mut columns: BTreeMap<Exact, BTreeMap<Exact, Shown>> = BTreeMap::new();
        for ([frequency, acceleration], shown) in points {
            columns.entry(Exact(frequency)).or_default().insert(Exact(acceleration), shown);
        }
        let column = |points: BTreeMap<Exact, Shown>| points.into_iter().map(|(a, shown)| (a.0, shown)).collect();
        let plain: Vec<(f64, Column)> = columns.into_iter().map(|(f, points)| (f.0, column(points))).collect();
        let mut chart = Self { columns: plain.clone() };
        for (index, (frequency, points)) in chart.columns.iter_mut().enumerate() {
            for (row, (acceleration, shown)) in points.iter_mut().enumerate() {
                let along = row.checked_sub(1).and_then(|before| {
                    let (low, high) = (plain[index].1.get(before)?, plain[index].1.get(row + 1)?);
                    Some(between([low.0, high.0], [low.1, high.1], *acceleration))
                });
                let across = index.checked_sub(1).and_then(|before| {
                    let (low, high) = (plain.get(before)?, plain.get(index + 1)?);
                    let values = [&low.1, &high.1].map(|column| at(column, *acceleration));
                    Some(between([low.0, high.0], values, *frequency))
                });
                let off = [along, across].into_iter().flatten().map(|line| (shown.mass - line.mass).norm());
                shown.error = 2.0 * shown.error + 0.25 * off.sum::<f64>();
            }
        }
        chart
    }

    /// What is shown at a frequency [Hz] and acceleration [m/s^2]: on straight lines over their logarithms, and what the edge shows
    /// beyond it.
    pub fn at(&self, frequency: f64, acceleration: f64) -> Shown {
        let after = self.columns.partition_point(|(own, _)| *own < frequency);
        let of = |column: usize| self.columns.get(column).map(|(own, points)| (*own, at(points, acceleration)));
        match (after.checked_sub(1).and_then(of), of(after)) {
            (Some((low, below)), Some((high, above))) => between([low, high], [below, above], frequency),
            (Some((_, edge)), None) | (None, Some((_, edge))) => edge,
            (None, None) => Shown::default(),
        }
    }
}

/// Reads a finished atlas from its folder.
pub fn read(folder: &Path) -> Result<Vec<Cavity>, AtlasError> {
    let unusable = |what: &str| AtlasError::Unusable { path: folder.to_owned(), what: what.to_owned() };
    let file = folder.join(FILE);
    if !file.is_file() {
        return Err(unusable("not an atlas: there is no atlas.csv in it; `tsubu atlas SCENE` makes one"));
    }
    let summary = Summary::read(&folder.join("summary.json"))?;
    if summary.status == Status::Interrupted {
        return Err(unusable("the atlas is not finished: the same `tsubu atlas` again goes on with it"));
    }
    let scene = Scene::read(&folder.join("scene.toml"), &[]).map_err(|error| unusable(&error.to_string()))?;
    let wanted = scene.plan().atlas.clone().ok_or_else(|| unusable("its scene has no `[atlas]`"))?;
    let cases = cases(&wanted.vary);
    let plans = case_plans(&scene, &cases).map_err(|error: CasesError| unusable(&error.to_string()))?;
    let table = Table::read(&file)?;
    let column = |name: &str| table.numbers(name).ok_or_else(|| unusable(&format!("atlas.csv has no `{name}`")));
    let of_rows = table.texts("case").ok_or_else(|| unusable("atlas.csv has no `case`"))?;
    let [frequency, acceleration, seed, mass, lossy, error, harmonics] =
        ["frequency", "acceleration", "seed", "effective mass", "lossy mass", "error", "higher harmonics"].map(column);
    let (frequency, acceleration, seed, error) = (frequency?, acceleration?, seed?, error?);
    let (mass, lossy, harmonics) = (mass?, lossy?, harmonics?);
    let failed = summary.warnings.first().filter(|_| summary.status == Status::Failed);
    let lost = failed.map(|first| format!("the atlas in {} is not whole: {first}", folder.display()));
    let known = names(&cases);
    if let Some(other) = of_rows.iter().find(|name| !known.contains(name)) {
        return Err(unusable(&format!("atlas.csv has a case `{other}`, which its scene has not")));
    }
    let mut cavities = Vec::new();
    for ((plan, case), name) in plans.into_iter().zip(&cases).zip(known) {
        let mut rows = Vec::new();
        for row in (0..of_rows.len()).filter(|row| of_rows[*row] == name) {
            let numbers = [frequency[row], acceleration[row], mass[row], lossy[row], harmonics[row]];
            if !numbers.iter().all(|number| number.is_finite()) || frequency[row] <= 0.0 || acceleration[row] <= 0.0 {
                return Err(unusable(&format!("line {} of atlas.csv says no numbers that can be", row + 2)));
            }
            // Of a single block no error is known.
            let error = if error[row].is_finite() { error[row] } else { 0.0 };
            let shown = Shown { mass: Complex::new(mass[row], -lossy[row]), error, harmonics: harmonics[row] };
            rows.push((seed[row] as u32, [frequency[row], acceleration[row]], shown));
        }
        if plan.grain_mass() > 0.0 && rows.is_empty() {
            return Err(unusable(&format!(
                "it has no point of the case `{name}`: its runs failed, or atlas.csv was cut; `tsubu atlas` tries again"
            )));
        }
        let places: BTreeSet<[Exact; 2]> = rows.iter().map(|(_, place, _)| place.map(Exact)).collect();
        let suffix = if case.name.is_empty() { String::new() } else { format!(" {name}") };
        let told = summary.results.get(&format!("points{suffix}"));
        if let Some(ResultValue::Number(told)) = told
            && *told != places.len() as f64
        {
            let number = places.len();
            return Err(unusable(&format!("atlas.csv has {number} points of the case `{name}`, its summary {told}")));
        }
        let cavity = Cavity::new(name, plan, &wanted, rows);
        cavities.push(Cavity { lost: lost.clone(), ..cavity });
    }
    Ok(cavities)
}
