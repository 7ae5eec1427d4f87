//! The files of an atlas.

use super::{Done, Task, chart};
use crate::study::summary::{begun, judge};
use tsubu_frame::{FileError, RunFolder, Status, Summary};

/// Writes `atlas.csv`, `check.txt` and `summary.json`.
pub(super) fn write(
    folder: &RunFolder,
    task: &Task,
    points: &Done,
    status: Status,
    failures: Vec<String>,
    wall_seconds: f64,
) -> Result<Summary, FileError> {
    let plan = &task.plans[0];
    let mut summary = begun(plan, status, wall_seconds);
    summary.particles = task.plans.iter().map(|plan| plan.grains() as u64).max().unwrap_or_default();
    summary.warnings = failures;
    let names = chart::names(&task.cases);
    for (case, name) in names.iter().enumerate() {
        let found = task.found(points, case);
        let Some((place, best)) = found.iter().min_by(|a, b| a.1.mass.im.total_cmp(&b.1.mass.im)) else { continue };
        let suffix = if task.cases[case].name.is_empty() { String::new() } else { format!(" {name}") };
        summary.give(format!("largest loss factor{suffix}"), "-", -best.mass.im);
        summary.give(format!("its frequency{suffix}"), "Hz", place.0.0);
        summary.give(format!("its acceleration{suffix}"), "m/s^2", place.1.0);
        summary.give(format!("points{suffix}"), "-", found.len() as f64);
        let left = super::refine::next(&found, task.wanted.within, 1);
        if status == Status::Finished && found.len() >= task.wanted.at_most as usize && !left.is_empty() {
            summary.warnings.push(format!(
                "case `{name}`: {} points are not enough to know the mass within {} of the grains' between them; a larger `atlas.at-most` is",
                found.len(),
                task.wanted.within
            ));
        }
    }
    summary.energy.residual_relative = points.values().map(|point| point.residual.abs()).fold(0.0, f64::max);
    judge(folder, plan, &mut summary)?;
    folder.write(chart::FILE, chart::table(&names, &task.plans, points).to_csv().as_bytes())?;
    folder.write_json("summary.json", &summary)?;
    folder.sync()?;
    Ok(summary)
}
