//! The verdict on openings of walls that are narrower than grains are long.

use super::{Verdict, length};
use tsubu_scene::plan::{Plan, Shape};

/// An opening of a cone that is smaller than this share of a grain is rather a tip that nothing is to pass.
const TIP: f64 = 0.2;

/// Judges the narrow end of every cone; that of a mesh is judged where the mesh is.
pub(super) fn cones(verdict: &mut Verdict, plan: &Plan) {
    for (name, wall) in &plan.walls {
        let Shape::Cone { radius, end_radius, .. } = wall.shape else { continue };
        let width = 2.0 * radius.min(end_radius);
        if plan.particles.values().all(|group| width > TIP * group.largest_diameter()) {
            judge(verdict, plan, name, width);
        }
    }
}

/// Grains that are longer than an opening is wide may block it; those that are thicker cannot pass.
pub(super) fn judge(verdict: &mut Verdict, plan: &Plan, wall: &str, width: f64) {
    for (name, group) in plan.particles.iter().filter(|(_, group)| group.largest_diameter() > width) {
        let (width, long) = (length(width), length(group.largest_diameter()));
        verdict.judge(
            false,
            format!(
                "wall `{wall}`: its narrowest opening is {width} wide, and grains `{name}` are up to {long} long: they may block it"
            ),
            || format!("the opening of `walls.{wall}.shape`, or the size of `particles.{name}`"),
        );
    }
}
