//! Grains that are polyhedra or polygons.

use super::clumps::in_folder;
use std::f64::consts::PI;
use std::fmt::Write as _;
use tsubu_scene::Scene;
use tsubu_scene::plan::{Clump, Polyhedron, Vector};

const CUBE: &str =
    "[[-1, -1, -1], [1, -1, -1], [-1, 1, -1], [1, 1, -1], [-1, -1, 1], [1, -1, 1], [-1, 1, 1], [1, 1, 1]]";
const TETRAHEDRON: &str = "[[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]";

fn read(shape: &str, changes: &[&str]) -> Result<Scene, String> {
    let space: &[&str] = if changes.iter().any(|c| c.starts_with("dimension")) { &[] } else { &["dimension=3"] };
    in_folder(&[], shape, &[space, changes].concat())
}

fn body(corners: &str, rounding: f64) -> Clump {
    let shape =
        format!("shape.polyhedron = {{ corners = {corners}, rounding = {rounding:?}, orientation = \"as-drawn\" }}");
    let scene = read(&shape, &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    let group = &scene.plan().particles["rods"];
    let body = group.shape.clump().expect("a body");
    assert!((group.mass / (2500.0 * body.volume * 0.004_f64.powi(3)) - 1.0).abs() < 1e-12);
    let again = Scene::parse("scene.toml", &scene.resolved_toml(), std::path::Path::new("."), &[]);
    assert_eq!(again.expect("the same scene").plan().particles["rods"], *group);
    body
}

fn near(found: f64, told: f64, within: f64) {
    assert!((found / told - 1.0).abs() < within, "{found} {told}");
}

/// Sharp bodies have their text-book volumes and moments: a cube of edge 2 has 8 and 2/3, a regular tetrahedron of edge a has a^3 / (6 sqrt 2) and a^2 / 20, a brick (b^2 + c^2) / 12.
#[test]
fn sharp_bodies_have_their_closed_forms() {
    let tiny = 1e-7;
    let cube = body(CUBE, tiny);
    let unit = 0.5 / 3.0_f64.sqrt();
    near(cube.volume, 8.0 * unit.powi(3), 1e-6);
    cube.moments.iter().for_each(|moment| near(*moment, 4.0 / 6.0 * unit * unit, 1e-6));
    let (tetrahedron, a2) = (body(TETRAHEDRON, tiny), 8.0);
    near(tetrahedron.volume, a2 * 8.0_f64.sqrt() / (6.0 * 2.0_f64.sqrt()) * unit.powi(3), 1e-6);
    tetrahedron.moments.iter().for_each(|moment| near(*moment, a2 / 20.0 * unit * unit, 1e-6));
    // Out of its centre, along other axes.
    let brick = "[[10, 20, 11], [12, 20, 11], [10, 30, 11], [12, 30, 11], [10, 20, 16], [12, 20, 16], [10, 30, 16], [12, 30, 16]]";
    let brick = body(brick, tiny);
    let sides = [2.0, 10.0, 5.0].map(|side: f64| side * side);
    let unit = 0.5 / (0.5 * sides.iter().sum::<f64>().sqrt());
    near(brick.volume, 100.0 * unit.powi(3), 1e-6);
    // The longest side is along the axis of the smallest moment.
    for (k, others) in [(0, 29.0), (1, 104.0), (2, 125.0)] {
        near(brick.moments[k], others / 12.0 * unit * unit, 1e-6);
    }
}

/// A cube with rounded edges is a smaller one with plates on its faces, quarters of cylinders on its edges and eighths of a ball on its corners (Steiner): its volume in closed form, its moment by the parts.
#[test]
fn a_rounded_cube_is_the_sum_of_its_parts() {
    let r: f64 = 0.3;
    let a = 2.0 - 2.0 * r;
    let cube = body(CUBE, r);
    let unit = 0.5 / (0.5 * a * 3.0_f64.sqrt() + r);
    let volume = a.powi(3) + 6.0 * a * a * r + 3.0 * PI * a * r * r + 4.0 / 3.0 * PI * r.powi(3);
    near(cube.volume, volume * unit.powi(3), 1e-12);
    // Integral of x^2: of the core and the plates, of the cylinders and of the ball, each about the planes x = a/2.
    let half = 0.5 * a;
    let plates =
        a.powi(5) / 12.0 + 4.0 * a.powi(4) / 12.0 * r + 2.0 * a * a * ((half + r).powi(3) - half.powi(3)) / 3.0;
    // Over half a disc right of a line: area, first and second moment.
    let [area, first, second] = [PI * r * r / 2.0, 2.0 * r.powi(3) / 3.0, PI * r.powi(4) / 8.0];
    let along = PI * r * r * a.powi(3) / 12.0;
    let across = 2.0 * 2.0 * a * (half * half * area + 2.0 * half * first + second);
    let [area, first, second] = [2.0 * PI * r.powi(3) / 3.0, PI * r.powi(4) / 4.0, 2.0 * PI * r.powi(5) / 15.0];
    let ball = 2.0 * (half * half * area + 2.0 * half * first + second);
    let moment = 2.0 * (plates + along + across + ball) / volume;
    cube.moments.iter().for_each(|found| near(*found, moment * unit * unit, 1e-12));
    // So is its surface, to which that of the sphere of its volume is compared.
    let surface = (6.0 * a * a + 6.0 * PI * a * r + 4.0 * PI * r * r) * unit * unit;
    near(cube.sphericity(), (36.0 * PI * cube.volume.powi(2)).cbrt() / surface, 1e-12);
    near(body(CUBE, 1e-7).sphericity(), (PI / 6.0).cbrt(), 1e-6);
    near(body(TETRAHEDRON, 1e-7).sphericity(), (PI / 6.0 / 3.0_f64.sqrt()).cbrt(), 1e-6);
    // Taken for sharp it would be heavier by a tenth.
    assert!(8.0 / volume > 1.05);
}

/// Whether a point is within the body: nearer to its core than the rounding radius, by going from plane to plane (Dykstra).
fn within(body: &Polyhedron, point: Vector) -> bool {
    let (mut at, mut left) = (point, vec![[0.0; 3]; body.faces.len()]);
    for _ in 0..60 {
        for (face, left) in body.faces.iter().zip(&mut left) {
            let before = [0, 1, 2].map(|k| at[k] + left[k]);
            let above = ((0..3).map(|k| before[k] * face.normal[k]).sum::<f64>() - face.offset).max(0.0);
            at = [0, 1, 2].map(|k| before[k] - above * face.normal[k]);
            *left = [0, 1, 2].map(|k| before[k] - at[k]);
        }
    }
    (0..3).map(|k| (point[k] - at[k]).powi(2)).sum::<f64>() < body.rounding.powi(2)
}

/// Of an odd body a sum over cells says how much there is and how it is spread; its centre of mass is where it says, its axes are principal.
#[test]
fn an_odd_body_is_what_cells_say() {
    let odd = body("[[0, 0, 0], [3, 0.2, 0], [0.5, 2, 0.3], [1, 0.4, 1.7], [2.2, 1.5, 1]]", 0.2);
    let shape = odd.polyhedron.as_ref().expect("a polyhedron");
    let (cells, mut sums, mut reach) = (72_usize, [0.0_f64; 10], 0.0_f64);
    for k in 0..cells.pow(3) {
        let at = |k: usize| (k as f64 + 0.5) / cells as f64 - 0.5;
        let [x, y, z] = [at(k % cells), at(k / cells % cells), at(k / cells / cells)];
        if within(shape, [x, y, z]) {
            let more = [1.0, x, y, z, y * y + z * z, x * x + z * z, x * x + y * y, x * y, y * z, z * x];
            (0..10).for_each(|i| sums[i] += more[i]);
            reach = reach.max(x * x + y * y + z * z);
        }
    }
    near(odd.volume, sums[0] / (cells as f64).powi(3), 4e-3);
    (1..4).for_each(|k| assert!((sums[k] / sums[0]).abs() < 1e-3, "{sums:?}"));
    (0..3).for_each(|k| near(odd.moments[k], sums[4 + k] / sums[0], 6e-3));
    (7..10).for_each(|k| assert!((sums[k] / sums[0]).abs() < 2e-4, "{sums:?}"));
    near(reach.sqrt(), 0.5, 0.03);
    assert!(odd.moments[2] / odd.moments[0] > 1.3, "the wrong order would be seen: {:?}", odd.moments);
}

/// A square with rounded corners: area and moment about y in closed form; a mass follows from a thickness.
#[test]
fn a_polygon_has_the_mass_of_its_area() {
    let r: f64 = 0.2;
    let plane = ["dimension=2", "particles.rods.start.random.region={low=[0,0],high=[1,1]}"];
    let shape = "shape.polygon = { corners = [[1, 1], [-1, 1], [-1, -1], [1, -1]], rounding = 0.2, thickness = 0.01 }";
    let scene = read(shape, &plane).unwrap_or_else(|wrong| panic!("{wrong}"));
    let group = &scene.plan().particles["rods"];
    let body = group.shape.clump().expect("a polygon");
    let a = 2.0 - 2.0 * r;
    let half = 0.5 * a;
    let unit = 0.5 / (half * 2.0_f64.sqrt() + r);
    let area = a * a + 4.0 * a * r + PI * r * r;
    near(body.volume, area * unit * unit, 1e-12);
    near(group.mass, 2500.0 * 0.01 * area * unit * unit * 0.004 * 0.004, 1e-12);
    let strips = a.powi(4) / 12.0 + 2.0 * a.powi(3) / 12.0 * r + 2.0 * a * ((half + r).powi(3) - half.powi(3)) / 3.0;
    let corners = 2.0 * (half * half * PI * r * r / 2.0 + 2.0 * half * 2.0 * r.powi(3) / 3.0 + PI * r.powi(4) / 8.0);
    near(body.moments[1], 2.0 * (strips + corners) / area * unit * unit, 1e-12);
}

/// A cube whose sides are cut from corner to corner.
fn cube_file() -> String {
    let mut text = String::new();
    for i in 0..8 {
        let [x, y, z] = [i & 1, i >> 1 & 1, i >> 2 & 1].map(|bit| 2 * bit - 1);
        writeln!(text, "v {x} {y} {z}").expect("text");
    }
    for [a, b, c, d] in [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]] {
        writeln!(text, "f {a} {b} {c}\nf {a} {c} {d}").expect("text");
    }
    text
}

/// A mesh says what its corners say, however its faces are cut; its copy stands in the run folder.
#[test]
fn a_mesh_says_what_its_corners_say() {
    let named = "shape.polyhedron-mesh = { path = \"cube.obj\", rounding = 0.1, orientation = \"as-drawn\" }";
    let scene =
        in_folder(&[("cube.obj", &cube_file())], named, &["dimension=3"]).unwrap_or_else(|wrong| panic!("{wrong}"));
    let (found, told) = (scene.plan().particles["rods"].shape.clump().expect("a body"), body(CUBE, 0.1));
    near(found.volume, told.volume, 1e-9);
    (0..3).for_each(|k| near(found.moments[k], told.moments[k], 1e-9));
    let shape = found.polyhedron.expect("a polyhedron");
    assert_eq!((shape.corners.len(), shape.faces.len(), shape.edges.len()), (8, 6, 12));
    assert_eq!(scene.companions()[0].0, "polyhedra-rods.obj");
}

#[test]
fn polyhedra_that_cannot_be() {
    let cube = format!("shape.polyhedron = {{ corners = {CUBE}, rounding = 0.1 }}");
    let with = |corners: &str| format!("shape.polyhedron = {{ corners = {corners}, rounding = 0.1 }}");
    let square = "shape.polygon = { corners = [[1, 1], [-1, 1], [-1, -1], [1, -1]], rounding = 0.2, thickness = 0.01 }";
    let plane = ["dimension=2", "particles.rods.start.random.region={low=[0,0],high=[1,1]}"];
    let mesh = "shape.polyhedron-mesh = { path = \"rock.obj\", rounding = 0.1 }";
    let from = |text: &str| in_folder(&[("rock.obj", text)], mesh, &["dimension=3"]);
    let closed = cube_file();
    let mut open: Vec<&str> = closed.lines().collect();
    open.pop();
    // A roof inside out: the middle of the top face of a cube is pushed in.
    let dented = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nv 0 0 0.5\nf 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 9\nf 6 7 9\nf 7 8 9\nf 8 5 9\n";
    let crossing = dented.replace("0 0 0.5", "0 0 -3");
    let wrong = [
        read(&with("[[0, 0, 0], [1, 0, 0], [0, 1, 0]]"), &[]),
        read(&with("[[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]"), &[]),
        read(&with(&CUBE.replace("]]", "], [0, 0, 0.3]]")), &[]),
        read(&with(&CUBE.replace("]]", "], [1, 1, 0]]")), &[]),
        read(&with(&CUBE.replace("]]", "], [-1, 1, -1]]")), &[]),
        read(&cube.replace("0.1 }", "1 }"), &[]),
        read(&cube.replace("0.1 }", "0 }"), &[]),
        read(&with("[[1, 1], [-1, 1], [-1, -1], [1, -1]]"), &plane),
        read(&cube.replace("polyhedron", "polygon").replace("0.1 }", "0.1, thickness = 0.01 }"), &[]),
        read(&square.replace("[-1, 1], [-1, -1]", "[-1, -1], [-1, 1]"), &plane),
        read(&square.replace("[1, -1]]", "[0, 0.2]]"), &plane),
        read(&square.replace("0.2,", "1.2,"), &plane),
        read(&format!("{cube}\nmotion.frozen = {{}}"), &[]),
        read(&cube, &["water.density=1000", "water.viscosity=1e-3"]),
        in_folder(&[], mesh, &["dimension=3"]),
        from(&open.join("\n")),
        from(dented),
        from(&crossing),
        in_folder(&[("rock.obj", &closed)], &mesh.replace("0.1", "1.5"), &["dimension=3"]),
    ];
    insta::assert_snapshot!(crate::refusals(wrong));
}
