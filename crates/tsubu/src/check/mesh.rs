//! The verdict on the meshes of walls: what is wrong with one, or at least worth knowing.

use super::{Verdict, length, opening};
use tsubu_scene::mesh::{Diagnosis, diagnose};
use tsubu_scene::plan::{Plan, Shape, Vector};

/// Openings of a mesh that is meant to be open: a hopper has two, a manifold some more.
const MOST_OPENINGS: usize = 8;
/// Size of a mesh over the largest grain, and size [m], above both of which a unit is rather wrong than the mesh large.
const HUGE: (f64, f64) = (1000.0, 10.0);

/// Judges every wall that is a mesh.
pub(super) fn meshes(verdict: &mut Verdict, plan: &Plan) {
    let grains = plan.particles.values().map(tsubu_scene::plan::Particles::largest_diameter).reduce(f64::max);
    for (name, wall) in &plan.walls {
        let Shape::Mesh { triangles, scale, .. } = &wall.shape else { continue };
        let found = diagnose(triangles);
        let label = format!("wall `{name}`");
        let [x, y, z] = found.extent.map(length);
        verdict.say(format!("{label}: {} triangles, {} corners, {x} x {y} x {z}", found.triangles, found.corners));
        if let Some(diameter) = grains.filter(|diameter| is_huge(found.extent, *diameter)) {
            let size = length(found.extent.into_iter().fold(0.0, f64::max));
            verdict.judge(false, format!("{label}: {size} wide, with grains of {}", length(diameter)), || {
                let thousandth = 0.001 * scale;
                format!("`walls.{name}.shape.mesh.scale = {thousandth}`, if the file is in millimetres")
            });
        }
        rims(verdict, &found, &label);
        if let Some(width) = found.narrowest {
            opening::judge(verdict, plan, name, width);
        }
        for (what, found, advice) in [
            (
                "edges where the normal changes sides",
                &found.flipped_edges,
                "turn the triangles in the mesh file; grains touch both sides all the same",
            ),
            (
                "triangles that are there twice",
                &found.duplicated,
                "remove them from the mesh file; they are touched as one",
            ),
            (
                "edges that more than two triangles share",
                &found.crowded_edges,
                "part the mesh into one wall a sheet, unless the sheets are meant to meet there",
            ),
        ] {
            if !found.is_empty() {
                verdict.judge(false, format!("{label}: {what}: {found}"), || advice.to_owned());
            }
        }
    }
}

/// An open hopper is worth a note, a mesh with holes a warning.
fn rims(verdict: &mut Verdict, found: &Diagnosis, label: &str) {
    if found.open_edges.is_empty() {
        return;
    }
    let meant = found.openings == found.rims && found.rims <= MOST_OPENINGS;
    let rims = if found.rims == 1 { "1 rim".to_owned() } else { format!("{} rims", found.rims) };
    if meant {
        verdict.say(format!("{label}: open along {rims}, each a closed line"));
    } else {
        let text = format!("{label}: {rims} of open edges, where grains may pass: {}", found.open_edges);
        verdict
            .judge(false, text, || "close them in the mesh file, unless the wall is meant to be open there".to_owned());
    }
}

/// Whether the mesh is out of all proportion to the grains.
fn is_huge(extent: Vector, diameter: f64) -> bool {
    let size = extent.into_iter().fold(0.0, f64::max);
    size > HUGE.0 * diameter && size > HUGE.1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hopper drawn in millimetres was 80 m wide without a word, if nobody thought of `scale`.
    #[test]
    fn millimetres_read_as_metres_are_told_from_large_meshes() {
        let hopper = [80.0, 80.0, 120.0];
        assert!(is_huge(hopper, 0.003));
        assert!(!is_huge(hopper.map(|x| 1e-3 * x), 0.003));
        // Stones on a hillside, and fine sand in a tank.
        assert!(!is_huge([300.0, 100.0, 80.0], 0.5));
        assert!(!is_huge([8.0, 1.0, 2.0], 0.000_2));
    }
}
