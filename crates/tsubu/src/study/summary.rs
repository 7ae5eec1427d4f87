//! What the summaries of all studies of many runs have in common.

use crate::partner::Hosts;
use crate::trial::unsettled;
use crate::{check, methods, run};
use tsubu_frame::{FileError, RunFolder, Status, Summary};
use tsubu_scene::Plan;

/// The summary of a study of this plan, before anything has come of it.
pub(super) fn begun(plan: &Plan, status: Status, wall_seconds: f64) -> Summary {
    Summary {
        tsubu_version: crate::VERSION.to_owned(),
        status,
        method: plan.method.name().to_owned(),
        dimension: u32::from(plan.dimension),
        wall_seconds,
        threads: rayon::current_num_threads() as u32,
        ..Summary::default()
    }
}

/// Writes `check.txt`, and puts into the summary what the method says of a plan, whether the books of the runs close, and the claims.
pub(super) fn judge(folder: &RunFolder, plan: &Plan, summary: &mut Summary) -> Result<(), FileError> {
    let (residual, tolerance) = (summary.energy.residual_relative, plan.dem.energy_tolerance);
    if residual > tolerance {
        summary.warnings.push(format!(
            "the energy residual of some run is {residual:.2e} of the energy turned over, more than `dem.energy-tolerance` = {tolerance:e}: shorten the time step"
        ));
    }
    let hosts = Hosts::new(&plan.hosts);
    // Nothing of this depends on where grains lie.
    if let Ok(engine) = methods::open(&unsettled(plan), &hosts) {
        summary.time_step = engine.time_step();
        summary.warnings.extend(engine.notes().iter().map(|note| format!("{}: {}", note.key, note.text)));
        folder.write("check.txt", check::verdict(plan, &hosts, &*engine).to_string().as_bytes())?;
    }
    if summary.status == Status::Finished {
        run::judge(plan, summary);
    }
    Ok(())
}
