//! The verdict on the meshes of walls: what is wrong with one, or at least worth knowing.

use super::Verdict;
use tsubu_scene::mesh::diagnose;
use tsubu_scene::plan::{Plan, Shape};

/// Judges every wall that is a mesh.
pub(super) fn meshes(verdict: &mut Verdict, plan: &Plan) {
    for (name, wall) in &plan.walls {
        let Shape::Mesh { triangles, .. } = &wall.shape else { continue };
        let found = diagnose(triangles);
        let label = format!("wall `{name}`");
        verdict.say(format!("{label}: {} triangles, {} corners", found.triangles, found.corners));
        let rims = if found.rims == 1 { "1 rim".to_owned() } else { format!("{} rims", found.rims) };
        for (what, found, advice) in [
            (
                format!("{rims} of open edges, where grains may pass"),
                &found.open_edges,
                "close them in the mesh file, unless the wall is meant to be open there",
            ),
            (
                "edges where the normal changes sides".to_owned(),
                &found.flipped_edges,
                "turn the triangles in the mesh file; grains touch both sides all the same",
            ),
            (
                "triangles that are there twice".to_owned(),
                &found.duplicated,
                "remove them from the mesh file; they are touched as one",
            ),
            (
                "edges that more than two triangles share".to_owned(),
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
