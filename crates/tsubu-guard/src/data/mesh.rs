//! Meshes in OBJ and STL: a hilly ground.

use super::{File, Format, lines};
use crate::draw::Draw;
use crate::reading::Expect;
use std::fmt::Write as _;

/// Numbers that single precision keeps.
type Corner = [f32; 3];

const SCENE: &str = "duration = 1\ndimension = 3\n[materials.a]\nyoung-modulus = 1e7\n[walls.ground]\nmaterial = \"a\"\n\
                     shape.mesh = { path = \"FILE\", scale = 0.5 }\n";

/// A mesh.
pub fn draw(draw: &mut Draw) -> File {
    let (columns, rows) = (2 + draw.below(4), 2 + draw.below(4));
    let mut corners: Vec<Corner> = Vec::new();
    for index in 0..columns * rows {
        let height = draw.below(64) as f32 / 64.0;
        corners.push([(index % columns) as f32, (index / columns) as f32, height]);
    }
    // The corners of every cell, as they go round.
    let cells: Vec<[usize; 4]> = (0..(columns - 1) * (rows - 1))
        .map(|cell| cell / (columns - 1) * columns + cell % (columns - 1))
        .map(|at| [at, at + 1, at + columns + 1, at + columns])
        .collect();
    let triangles: Vec<[Corner; 3]> = cells
        .iter()
        .flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]])
        .map(|face| face.map(|at| corners[at]))
        .collect();
    let plain = String::from_utf8_lossy(&stl(draw, &triangles, true)).into_owned();
    let (format, name, bytes) = match draw.below(3) {
        0 => (Format::Obj, "ground.obj", obj(draw, &corners, &cells)),
        1 => (Format::Stl, "ground.stl", stl(draw, &triangles, false)),
        _ => (Format::BinaryStl, "ground.stl", binary(draw, &triangles)),
    };
    File {
        format,
        name,
        bytes,
        scene: SCENE.to_owned(),
        plain: ("plain.stl", plain),
        expect: Expect::Same,
        change: "a style",
    }
}

fn obj(draw: &mut Draw, corners: &[Corner], cells: &[[usize; 4]]) -> Vec<u8> {
    let mut rows = Vec::new();
    if draw.one_in(2) {
        rows.extend(["mtllib ground.mtl", "o ground", "g hills"].map(String::from));
    }
    rows.extend(corners.iter().map(|[x, y, z]| format!("v {x} {y} {z}")));
    let mut slashes = "";
    if draw.one_in(2) {
        rows.extend(["vn 0 0 1", "vt 0 0", "usemtl grass", "s off"].map(String::from));
        slashes = *draw.pick(&["", "/1", "//1", "/1/1"]);
    }
    let (quads, back) = (draw.one_in(2), draw.one_in(4));
    let index = |at: &usize| {
        let index = if back { *at as i64 - corners.len() as i64 } else { *at as i64 + 1 };
        format!("{index}{slashes}")
    };
    let face = |corners: &[usize]| format!("f {}", corners.iter().map(index).collect::<Vec<_>>().join(" "));
    for [a, b, c, d] in cells {
        if quads {
            rows.push(face(&[*a, *b, *c, *d]));
        } else {
            rows.extend([face(&[*a, *b, *c]), face(&[*a, *c, *d])]);
        }
    }
    lines(draw, rows, Some('#'))
}

fn stl(draw: &mut Draw, triangles: &[[Corner; 3]], plain: bool) -> Vec<u8> {
    let mut text = "solid ground\n".to_owned();
    for triangle in triangles {
        text.push_str("  facet normal 0 0 1\n    outer loop\n");
        for [x, y, z] in triangle {
            let _ = writeln!(text, "      vertex {x:?} {y:e} {z}");
        }
        text.push_str("    endloop\n  endfacet\n");
    }
    text.push_str("endsolid ground\n");
    if !plain && draw.one_in(3) {
        text = text.to_uppercase();
    }
    if !plain && draw.one_in(3) {
        text = text.replace('\n', "\r\n");
    }
    text.into_bytes()
}

fn binary(draw: &mut Draw, triangles: &[[Corner; 3]]) -> Vec<u8> {
    let mut bytes = if draw.one_in(2) { b"solid ground".to_vec() } else { Vec::new() };
    bytes.resize(80, 0);
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flatten().flat_map(|number| number.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}
