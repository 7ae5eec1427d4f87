//! Meshes from files.

use super::files::{SCENE, in_folder};
use tsubu_scene::plan::*;
use tsubu_scene::{Complaints, Scene};

const MESH: &str =
    "[walls.hopper]\nmaterial = \"steel\"\nshape.mesh = { path = \"a.obj\", scale = 0.001, shift = [0, 0, 1] }\n";

pub(super) const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

pub(super) fn with_mesh(name: &str, content: &[u8], more: &str) -> Result<Scene, Complaints> {
    let (head, _) = SCENE.split_once("[particles").expect("grains");
    in_folder(&[(name, content)], &format!("{head}{}", MESH.replace("a.obj\"", &format!("{name}\"{more}"))))
}

#[test]
fn a_mesh_is_scaled_and_shifted() {
    let scene = with_mesh("a.obj", TRIANGLE.as_bytes(), "").unwrap_or_else(|wrong| panic!("{wrong}"));
    let Shape::Mesh { path, triangles, .. } = &scene.plan().walls["hopper"].shape else { panic!("a mesh") };
    assert_eq!(path, "walls-hopper.obj");
    assert_eq!(triangles.as_slice(), [[[0.0, 0.0, 1.0], [0.001, 0.0, 1.0], [0.0, 0.001, 1.0]]]);
    assert_eq!(scene.companions(), [("walls-hopper.obj".to_string(), TRIANGLE.as_bytes().to_vec())]);
}

#[test]
fn meshes_that_cannot_be_used() {
    let flat = format!("{TRIANGLE}v 2 0 0\nf 1 2 4\nf 1 1 2\n");
    let all = [
        with_mesh("a.obj", flat.as_bytes(), ""),
        with_mesh("a.obj", b"v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", ""),
        with_mesh("a.obj", b"v 0 0 0\nv 1 0 0\nf 1 2 3\nf 1 2\nv 1 x 2\n", ""),
        with_mesh("a.stl", b"\0\0\0\xff", ""),
        with_mesh("a.stl", b"solid\nfacet\nvertex 0 0 0\n", ""),
        with_mesh("a.stl", b"solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\n", ""),
        with_mesh("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nF 1 3 4\n", ""),
        with_mesh("a.ply", b"ply\n", ""),
        with_mesh("a.obj", TRIANGLE.as_bytes(), ", fingerprint = \"12345678\""),
    ];
    insta::assert_snapshot!(all.map(|wrong| wrong.expect_err("a bad mesh").to_string()).join("\n\n"));
}
