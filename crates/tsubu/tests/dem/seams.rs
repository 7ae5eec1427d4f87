//! Meshes are as good as the surfaces they stand for: seams are not felt, and a box of triangles is a box.

use super::run_text;
use std::fmt::Write as _;
use tsubu::engine;
use tsubu_frame::{Kind, Values};

const SCENE: &str = r#"
title = "seams"
dimension = 3
duration = "1 s"
speed-scale = "1 m/s"
[materials.glass]
young-modulus = "50 MPa"
restitution = RESTITUTION
friction = 0.5
density = "2500 kg/m^3"
[particles.ball]
material = "glass"
diameter = "10 mm"
start.at = START
[walls.floor]
material = "glass"
shape.SHAPE
"#;

fn scene(restitution: f64, start: &str, shape: &str) -> String {
    SCENE.replace("RESTITUTION", &restitution.to_string()).replace("START", start).replace("SHAPE", shape)
}

pub fn stl(triangles: &[[[f64; 3]; 3]]) -> String {
    let mut text = "solid s\n".to_owned();
    for t in triangles {
        text.push_str("facet normal 0 0 0\nouter loop\n");
        for [x, y, z] in t {
            writeln!(text, "vertex {x:.17e} {y:.17e} {z:.17e}").unwrap();
        }
        text.push_str("endloop\nendfacet\n");
    }
    text + "endsolid s\n"
}

/// A floor of narrow, slanted, unequal triangles over 0..0.3 m by -0.05..0.05 m.
fn patchwork() -> Vec<[[f64; 3]; 3]> {
    let (nx, ny) = (61, 9);
    let point = |i: usize, j: usize| {
        let inside = i > 0 && i < nx && j > 0 && j < ny;
        let shake = |k: usize| if inside { ((i * 7919 + j * 104_729 + k * 31) % 97) as f64 / 97.0 - 0.5 } else { 0.0 };
        [0.3 * (i as f64 + 0.7 * shake(1)) / nx as f64, 0.1 * (j as f64 + 0.7 * shake(2)) / ny as f64 - 0.05, 0.0]
    };
    let mut triangles = Vec::new();
    for i in 0..nx {
        for j in 0..ny {
            let (a, b, c, d) = (point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
            triangles.extend(if (i + j) % 3 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] });
        }
    }
    triangles
}

/// Twelve triangles of a closed box.
pub fn crate_of(low: [f64; 3], high: [f64; 3]) -> Vec<[[f64; 3]; 3]> {
    let corner = |k: usize| std::array::from_fn(|axis| if k >> axis & 1 == 0 { low[axis] } else { high[axis] });
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let halves = |[a, b, c, d]: [usize; 4]| [[a, b, c], [a, c, d]];
    faces.into_iter().flat_map(halves).map(|t| t.map(corner)).collect()
}

/// Position and velocity of the ball after `seconds`, and the greatest change of the total energy on the way, in shares of
/// the kinetic energy at the start.
fn run(text: &str, triangles: &[[[f64; 3]; 3]], seconds: f64) -> ([f64; 3], [f64; 3], f64) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("mesh.stl"), stl(triangles)).unwrap();
    let (mut engine, mut hosts, mut ledger) = run_text(text, folder.path(), &[]);
    let opening = engine::energies(&*engine, &hosts);
    let steps = (seconds / engine.time_step()) as u64;
    let mut worst: f64 = 0.0;
    for _ in 0..steps / 10 {
        engine.advance(10, &mut hosts, &mut ledger).unwrap();
        let now = engine::energies(&*engine, &hosts).total();
        worst = worst.max((now - opening.total()).abs() / opening.kinetic);
    }
    let frame = engine.frame(&hosts);
    let vector = |name: &str| match &frame.column(Kind::Grain, name).unwrap().values {
        Values::Vector(v) => v[0],
        _ => panic!("{name} is not a vector"),
    };
    (vector("position"), vector("velocity"), worst)
}

/// A ball that rolls 0.25 m over some 160 seams goes straight and keeps its energy to 1e-6, as on a plane. It begins at the
/// depth where Hertz carries it: d = (m g / k)^(2/3), k = (4/3) E* sqrt(R), E* = E / (2 (1 - s^2)) for equal materials.
#[test]
fn a_ball_rolls_over_seams_as_over_a_plane() {
    let mass = 2500.0 * std::f64::consts::PI / 6.0 * 1e-6;
    let stiffness = 4.0 / 3.0 * 50e6 / (2.0 * (1.0 - 0.09)) * 0.005f64.sqrt();
    let depth = (mass * 9.8 / stiffness).powf(2.0 / 3.0);
    let arm = 0.005 - 0.5 * depth;
    let start = format!(
        "{{ position = [[0.02, 0.0013, {:.17e}]], velocity = [[0.5, 0, 0]], spin = [[0, {:.17e}, 0]] }}",
        0.005 - depth,
        0.5 / arm
    );
    let (position, velocity, change) = run(&scene(1.0, &start, "mesh.path = \"mesh.stl\""), &patchwork(), 0.5);
    let plane = run(&scene(1.0, &start, "plane = {}"), &[], 0.5).0;
    assert!(
        (position[0] - plane[0]).abs() < 1e-6 && (position[1] - 0.0013).abs() < 1e-6 * 0.25,
        "{position:?} {plane:?}"
    );
    assert!((plane[0] - 0.27).abs() < 1e-4, "{plane:?}");
    assert!((velocity[0] / 0.5 - 1.0).abs() < 1e-6 && velocity[1].abs() < 0.5e-6, "{velocity:?}");
    assert!(change < 1e-6, "{change:e}");
    // The control: a floor that falls by 10 um over one row of triangles is felt by the same gate.
    let mut stepped = patchwork();
    for corner in stepped.iter_mut().flatten().filter(|c| c[0] > 0.1) {
        corner[2] -= 1e-5;
    }
    let (_, velocity, _) = run(&scene(1.0, &start, "mesh.path = \"mesh.stl\""), &stepped, 0.5);
    assert!((velocity[0] / 0.5 - 1.0).abs() > 1e-6, "{velocity:?}");
}

/// A spinning ball thrown into a box of planes and into a box of triangles ends in the same place to 1e-6 after some 30
/// impacts on faces and in edges.
#[test]
fn a_mesh_box_is_a_plane_box() {
    let start = "{ position = [[0.01, 0.004, 0.02]], velocity = [[0.9, 0.55, -0.4]], spin = [[40, -30, 90]] }";
    let planes = "box = { width = 0.06, depth = 0.05, height = 0.07 }";
    let (low, high) = ([-0.03, -0.025, 0.0], [0.03, 0.025, 0.07]);
    let by_planes = run(&scene(0.8, start, planes), &[], 0.6);
    let by_triangles = run(&scene(0.8, start, "mesh.path = \"mesh.stl\""), &crate_of(low, high), 0.6);
    let apart = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt();
    assert!(apart(by_planes.0, by_triangles.0) < 1e-6, "{:?} {:?}", by_planes.0, by_triangles.0);
    assert!(apart(by_planes.1, by_triangles.1) < 1e-6, "{:?} {:?}", by_planes.1, by_triangles.1);
    // The control: a box one thousandth wider is another box.
    let wider = crate_of([-0.030_03, -0.025, 0.0], [0.030_03, 0.025, 0.07]);
    let other = run(&scene(0.8, start, "mesh.path = \"mesh.stl\""), &wider, 0.6);
    assert!(apart(by_planes.0, other.0) > 1e-6);
}
