//! V-48: the two checks of a single contact in the comparison of open-source codes by Dosta et al. 2024.

use super::bench::{Rig, near, plan, within};
use crate::case::Judged;
use crate::origin::{closed_form, printed};
use glam::DVec3;

const REBOUND: &str = include_str!("../../../studies/open-dem-benchmark/rebound.toml");
const ROLL: &str = include_str!("../../../studies/open-dem-benchmark/roll.toml");

/// An M1 sphere strikes steel at 1 m/s and comes back with the restitution of the pair, at the source's time step: 58
/// steps per contact, good for 1 %.
pub(super) fn rebound(perturbation: f64) -> Judged {
    let mut plan = plan(REBOUND)?;
    for pair in &mut plan.material_pair {
        pair.restitution = pair.restitution.map(|e| e * perturbation);
    }
    let mut rig = Rig::of(plan, perturbation)?;
    rig.impact()?;
    let speed = rig.vector("velocity", 0).z;
    let books = rig.residual();
    Ok(vec![
        near("rebound of M1 on steel m/s", speed, 0.4, 0.01, printed("Dosta et al. 2024, restitution of the pair")),
        within("rebound of M1 on steel: energy residual", books, 0.0, 1e-3, closed_form("conservation of energy")),
    ])
}

/// A steel sphere on a slope of 45 degrees, below atan(7/2 mu): it rolls from the beginning, at 5/7 of the pull.
pub(super) fn roll(perturbation: f64) -> Judged {
    let mut plan = plan(ROLL)?;
    let pull = plan.gravity[0];
    // What rolls without slip knows no constant of the law.
    plan.gravity = plan.gravity.map(|g| g * perturbation);
    let radius = 0.5 * plan.particles.values().map(|group| group.diameter).sum::<f64>();
    let mut rig = Rig::of(plan, perturbation)?;
    rig.until(rig.plan.duration)?;
    let (time, speed) = (rig.engine.time(), rig.speed());
    // Right-handed about y, which points into the picture: rolling to the right turns about +y.
    let surface = (DVec3::X * speed + rig.vector("spin", 0).cross(DVec3::NEG_Z * radius)).x;
    let source = closed_form("closed form 5/7 g sin");
    Ok(vec![
        near("start of rolling: acceleration m/s^2", speed / time, 5.0 / 7.0 * pull, 1e-3, source),
        within("start of rolling: slip over speed", surface / speed, 0.0, 1e-3, source),
        within("start of rolling: energy residual", rig.residual(), 0.0, 1e-3, closed_form("conservation of energy")),
    ])
}
