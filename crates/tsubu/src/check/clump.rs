//! The verdict on clumps in place of meshes, and on bodies in place of cells: how well they stand for them.

use super::Verdict;
use crate::engine::digits;
use tsubu_scene::plan::{GrainShape, Plan};

/// Volume that the spheres lack over that of the mesh, above which the clump is rather another body.
const MOST_MISSING: f64 = 0.25;

/// Judges every packing.
pub(super) fn packings(verdict: &mut Verdict, plan: &Plan) {
    for (name, group) in &plan.particles {
        let GrainShape::ClumpMesh { packing, spheres, .. } = &group.shape else { continue };
        let Some(error) = packing.error() else { continue };
        let [volume, inertia, surface] = [
            error.volume,
            error.inertia.into_iter().fold(0.0, |worst: f64, next| if next.abs() > worst.abs() { next } else { worst }),
            error.surface,
        ]
        .map(percent);
        let [mean, widest] = packing.gap.map(|gap| 100.0 * gap);
        let count = packing.spheres.len();
        let full = if count < *spheres { " (there is no room for more)" } else { "" };
        verdict.judge(
            error.volume > -MOST_MISSING,
            format!(
                "grains `{name}`: {count} spheres{full} within a mesh of {} triangles: volume {volume}, moments of inertia {inertia} at most, \
                 surface {surface}; it lies {mean:.2} % of the diameter outside them on average, {widest:.2} % at most",
                packing.triangles,
            ),
            || format!("`particles.{name}.shape.clump-mesh.spheres` to more than {count}"),
        );
        verdict.say(format!(
            "grains `{name}`: mass and moments of inertia are those of the mesh; as it is drawn its diameter is {} of its units",
            digits(2.0 * packing.reach)
        ));
    }
}

/// Says what stands for cells in DEM.
pub(super) fn cells(verdict: &mut Verdict, plan: &Plan) {
    for (name, group) in &plan.particles {
        let Some(error) = group.shape.cell_error() else { continue };
        let body =
            error.discs.map_or_else(|| "a rounded polygon".to_owned(), |discs| format!("{discs} discs at its rim"));
        verdict.say(format!(
            "grains `{name}`: by DEM {body} for the outline of the cells, with an area {} and a moment of inertia {} off theirs; mass and moment of inertia of \
             the grains are those of the cells",
            percent(error.area),
            percent(error.inertia),
        ));
    }
}

fn percent(part: f64) -> String {
    format!("{:+.1} %", 100.0 * part)
}
