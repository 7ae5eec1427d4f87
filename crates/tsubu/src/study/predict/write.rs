//! The files of a prediction.

use super::checks::{Check, Checks};
use super::{Curve, Task};
use crate::study::summary::begun;
use std::collections::BTreeSet;
use std::f64::consts::SQRT_2;
use tsubu_frame::{Cell, FileError, RunFolder, Status, Summary, Table};
use tsubu_scene::Scene;

const CURVES: [&str; 11] = [
    "frequency [Hz]",
    "frequency ratio [-]",
    "motion [-]",
    "stable [-]",
    "rms displacement [m]",
    "rms spread low [m]",
    "rms spread high [m]",
    "acceleration of the cavity [m/s^2]",
    "within the atlas [-]",
    "particles [-]",
    "case [text]",
];

const CASES: [&str; 10] = [
    "case [text]",
    "particles [-]",
    "peak frequency ratio [-]",
    "peak rms [m]",
    "peak spread low [m]",
    "peak spread high [m]",
    "simulated rms [m]",
    "error of the peak [-]",
    "largest error [-]",
    "wall seconds [s]",
];

/// Writes `prediction.csv`, `cases.csv` and `summary.json`; `took`: computing time of the prediction alone, and with its checks [s].
pub(super) fn write(
    folder: &RunFolder,
    scene: &Scene,
    task: &Task<'_>,
    curves: &[Curve],
    checks: &Checks,
    status: Status,
    took: [f64; 2],
) -> Result<Summary, FileError> {
    let plan = scene.plan();
    let mut summary = begun(plan, status, took[1]);
    summary.particles = task.plans.iter().map(|plan| plan.grains() as u64).max().unwrap_or_default();
    let lost: BTreeSet<&String> = task.cavities.iter().flatten().filter_map(|cavity| cavity.lost.as_ref()).collect();
    summary.warnings = lost.into_iter().chain(&checks.failures).cloned().collect();
    summary.give("seconds of the prediction alone".to_owned(), "s", took[0]);
    let (mut rows, mut cases) = (Table::new(CURVES), Table::new(CASES));
    for (case, curve) in curves.iter().enumerate() {
        let grains = task.plans[case].grains() as f64;
        let plain = task.cases[case].name.is_empty();
        let name = if plain { "scene".to_owned() } else { task.cases[case].name.clone() };
        let suffix = if plain { String::new() } else { format!(" {name}") };
        let inside = |a: f64| curve.known.is_none_or(|[low, high]| (low..=high).contains(&a));
        for row in &curve.rows {
            for (number, motion) in row.motions.iter().enumerate() {
                let spread = if Some(*motion) == row.largest() { row.within } else { [f64::NAN; 2] };
                let numbers = [
                    row.frequency,
                    row.ratio,
                    (number + 1) as f64,
                    f64::from(u8::from(motion.stable)),
                    motion.amplitude / SQRT_2,
                    spread[0] / SQRT_2,
                    spread[1] / SQRT_2,
                    motion.acceleration,
                    f64::from(u8::from(inside(motion.acceleration))),
                    grains,
                ];
                rows.push(numbers.map(Cell::Number).into_iter().chain([Cell::Text(name.clone())]));
            }
        }
        let Some((ratio, rms)) = curve.peak() else { continue };
        let top = |end: usize| curve.peak_of_end(end).map_or(f64::NAN, |(_, rms)| rms);
        let own: Vec<&Check> = checks.done.iter().filter(|check| check.case == case).collect();
        let error = |check: &Check| check.predicted / check.point.rms - 1.0;
        let simulated = own.first().map_or(f64::NAN, |check| check.point.rms);
        let of_peak = own.first().map_or(f64::NAN, |check| error(check));
        let largest =
            own.iter().map(|check| error(check)).fold(f64::NAN, |a: f64, b| if a.abs() > b.abs() { a } else { b });
        let wall = own.iter().map(|check| check.point.wall).sum::<f64>();
        let numbers = [grains, ratio, rms, top(0), top(1), simulated, of_peak, largest, wall];
        cases.push(std::iter::once(Cell::Text(name.clone())).chain(numbers.map(Cell::Number)));
        for (label, unit, value) in [
            ("peak frequency ratio", "-", ratio),
            ("peak rms", "m", rms),
            ("peak spread low", "m", top(0)),
            ("peak spread high", "m", top(1)),
        ] {
            summary.give(format!("{label}{suffix}"), unit, value);
        }
        if !own.is_empty() {
            summary.give(format!("simulated rms{suffix}"), "m", simulated);
            summary.give(format!("error of the peak{suffix}"), "-", of_peak);
        }
        let fastest = curve.rows.iter().filter_map(super::Row::largest).map(|m| m.acceleration).fold(0.0, f64::max);
        if !inside(fastest) && curve.known.is_some_and(|[_, high]| fastest > high) {
            summary.warnings.push(format!(
                "case `{name}`: the cavity reaches {fastest:.3} m/s^2, beyond the atlas, which is taken as at its edge there: a larger `atlas.acceleration` knows more"
            ));
        }
        let ends = task.cavities[case].map(|cavity| cavity.frequency);
        let reached = curve.rows.first().zip(curve.rows.last()).map(|(a, b)| [a.frequency, b.frequency]);
        if let (Some([low, high]), Some([from, to])) = (ends, reached)
            && (from < low || to > high)
        {
            summary.warnings.push(format!(
                "case `{name}`: frequencies from {from:.3} to {to:.3} Hz are asked for, the atlas knows {low} to {high} Hz, and is taken as at its edge beyond"
            ));
        }
    }
    for check in &checks.done {
        let off = check.predicted / check.point.rms - 1.0;
        if off.abs() > 0.1 {
            let name = &task.cases[check.case].name;
            summary.warnings.push(format!(
                "case `{name}`: at the frequency ratio {:.4} the simulation has {:.4e} m rms, the prediction {:.4e} m",
                check.ratio, check.point.rms, check.predicted
            ));
        }
    }
    folder.write("prediction.csv", rows.to_csv().as_bytes())?;
    folder.write("cases.csv", cases.to_csv().as_bytes())?;
    folder.write_json("summary.json", &summary)?;
    folder.sync()?;
    Ok(summary)
}
