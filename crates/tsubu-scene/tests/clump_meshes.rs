//! Clumps in place of closed meshes.

use super::clumps::in_folder;
use std::f64::consts::PI;
use std::fmt::Write as _;
use tsubu_scene::Scene;
use tsubu_scene::plan::{Clump, Packing, Vector};

type Triangles = Vec<[Vector; 3]>;

/// A box between two corners, all normals outwards.
fn cuboid(low: Vector, high: Vector) -> Triangles {
    let corner = |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 0 { low[k] } else { high[k] });
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).map(|side| side.map(corner)).collect()
}

/// An octahedron whose triangles are cut in four so many times, its corners put onto an ellipsoid of those half axes.
fn ellipsoid(half: Vector, cuts: usize) -> Triangles {
    let unit = |v: Vector| v.map(|x| x / v.iter().map(|x| x * x).sum::<f64>().sqrt());
    let middle = |a: Vector, b: Vector| unit([0, 1, 2].map(|k| a[k] + b[k]));
    let mut triangles: Triangles = (0..8)
        .map(|i| {
            let sign = [0, 1, 2].map(|k| if i >> k & 1 == 0 { 1.0 } else { -1.0 });
            let [x, y, z] = [[sign[0], 0.0, 0.0], [0.0, sign[1], 0.0], [0.0, 0.0, sign[2]]];
            if sign[0] * sign[1] * sign[2] > 0.0 { [x, y, z] } else { [x, z, y] }
        })
        .collect();
    for _ in 0..cuts {
        let four = |[a, b, c]: [Vector; 3]| {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        triangles = triangles.into_iter().flat_map(four).collect();
    }
    triangles.into_iter().map(|t| t.map(|corner| [0, 1, 2].map(|k| half[k] * corner[k]))).collect()
}

fn stl(triangles: &Triangles) -> String {
    let mut text = "solid body\n".to_owned();
    for triangle in triangles {
        text.push_str("facet normal 0 0 0\nouter loop\n");
        for [x, y, z] in triangle {
            writeln!(text, "vertex {x:?} {y:?} {z:?}").expect("text");
        }
        text.push_str("endloop\nendfacet\n");
    }
    text + "endsolid body\n"
}

fn scene(triangles: &Triangles, spheres: usize, changes: &[&str]) -> Result<Scene, String> {
    let shape =
        format!("shape.clump-mesh = {{ path = \"body.stl\", spheres = {spheres}, orientation = \"as-drawn\" }}");
    in_folder(&[("body.stl", &stl(triangles))], &shape, &[&["dimension=3"], changes].concat())
}

fn packed(triangles: &Triangles, spheres: usize) -> (Clump, Packing) {
    let scene = scene(triangles, spheres, &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    let group = &scene.plan().particles["rods"];
    let clump = group.shape.clump().expect("a clump");
    // The diameter holds the mesh: density times its volume, scaled.
    assert!((group.mass / (2500.0 * clump.volume * 0.004_f64.powi(3)) - 1.0).abs() < 1e-12);
    (clump, group.shape.packing().expect("a packing").clone())
}

fn near(found: f64, expected: f64, within: f64) {
    assert!((found / expected - 1.0).abs() < within, "{found} {expected}");
}

/// A box a x b x c: volume a b c, moments over the mass (b^2 + c^2) / 12 and so on, half of the diameter is half of its diagonal; wherever it is
/// drawn. Its spheres alone have moments that are too small by some percent: the same gate refuses them.
#[test]
fn a_box_has_its_mass_and_moments() {
    let [a, b, c] = [3.0, 2.0, 1.0_f64];
    for at in [0.0, 1000.0] {
        let (clump, packing) = packed(&cuboid([at; 3], [at + a, at + b, at + c]), 40);
        let within = if at == 0.0 { 1e-12 } else { 1e-9 };
        let unit = 1.0 / (a * a + b * b + c * c).sqrt();
        near(clump.volume, a * b * c * unit.powi(3), within);
        let moments = [b * b + c * c, a * a + c * c, a * a + b * b].map(|sum| sum / 12.0 * unit * unit);
        for (found, expected) in clump.moments.iter().zip(moments) {
            near(*found, expected, within);
        }
        near(packing.surface, 2.0 * (a * b + b * c + c * a), within);
        let error = packing.error().expect("spheres");
        assert!(error.inertia.iter().all(|error| *error < -0.01), "{error:?}");
    }
}

/// Polyhedra in a sphere and in an ellipsoid come near to 4/3 pi a b c and (b^2 + c^2) / 5 with the square of their edges, so that a third of the
/// difference between two, one cut once more, takes off what is missing. Without that the coarser one is refused.
#[test]
fn a_sphere_and_an_ellipsoid_have_theirs() {
    for half in [[1.0; 3], [1.0, 0.7, 0.4]] {
        let [a, b, c] = half;
        let scale = |packing: &Packing| 2.0 * packing.reach;
        let of = |cuts: usize| {
            let (clump, packing) = packed(&ellipsoid(half, cuts), 5);
            let size = scale(&packing);
            near(packing.reach, 1.0, 1e-12);
            [clump.volume * size.powi(3)].into_iter().chain(clump.moments.map(|moment| moment * size * size)).collect()
        };
        let (coarse, fine): (Vec<f64>, Vec<f64>) = (of(3), of(4));
        let expected =
            [4.0 / 3.0 * PI * a * b * c, (b * b + c * c) / 5.0, (a * a + c * c) / 5.0, (a * a + b * b) / 5.0];
        for ((coarse, fine), expected) in coarse.iter().zip(&fine).zip(expected) {
            near(fine + (fine - coarse) / 3.0, expected, 2e-4);
            assert!((coarse / expected - 1.0).abs() > 2e-3, "{coarse} {expected}");
        }
    }
}

/// One sphere in a cube is the inscribed one: pi/6 of its volume, (2/5 pi/6 (1/2)^2) / (1/6) of its moments, pi / 6 of its surface; the corners are
/// (sqrt 3 - 1) / 2 away, over the diameter sqrt 3.
#[test]
fn one_sphere_in_a_cube_is_the_inscribed_one() {
    let (_, packing) = packed(&cuboid([0.0; 3], [1.0; 3]), 1);
    let error = packing.error().expect("a sphere");
    near(1.0 + error.volume, PI / 6.0, 2e-3);
    error.inertia.iter().for_each(|error| near(1.0 + error, PI / 10.0, 3e-3));
    near(1.0 + error.surface, PI / 6.0, 2e-3);
    near(packing.gap[1], 0.5 * (1.0 - 1.0 / 3.0_f64.sqrt()), 0.03);
}

/// The volume of spheres by a fine grid of points.
fn counted(spheres: &[(Vector, f64)], low: Vector, high: Vector) -> f64 {
    const N: usize = 120;
    let inside = |p: Vector| spheres.iter().any(|(c, r)| (0..3).map(|k| (p[k] - c[k]).powi(2)).sum::<f64>() < r * r);
    let at = |k: usize, i: usize| low[k] + (i as f64 + 0.5) / N as f64 * (high[k] - low[k]);
    let count = (0..N * N * N).filter(|i| inside([at(0, i / N / N), at(1, i / N % N), at(2, i % N)])).count();
    let whole: f64 = (0..3).map(|k| high[k] - low[k]).product();
    whole * count as f64 / (N * N * N) as f64
}

#[test]
fn meshes_that_are_no_body() {
    let cube = || cuboid([0.0; 3], [1.0; 3]);
    let with = |change: &dyn Fn(&mut Triangles)| {
        let mut triangles = cube();
        change(&mut triangles);
        scene(&triangles, 10, &[])
    };
    // A pair of corners pushed through the opposite face: closed, of positive volume, with all neighbours turned alike.
    let mut through = cube();
    for corner in through.iter_mut().flatten().filter(|corner| corner[2] == 1.0 && corner[0] == 1.0) {
        corner[2] = -0.5;
    }
    let wrong = [
        with(&|triangles| triangles.truncate(11)),
        with(&|triangles| triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1))),
        with(&|triangles| triangles[3].swap(0, 1)),
        scene(&[cube(), cuboid([0.5; 3], [1.5; 3])].concat(), 10, &[]),
        scene(&[cube(), cuboid([0.25; 3], [0.75; 3])].concat(), 10, &[]),
        scene(&through, 10, &[]),
        scene(&cuboid([0.0; 3], [1.0, 1.0, 1e-7]), 10, &[]),
        scene(&Vec::new(), 10, &[]),
        with(&|triangles| triangles.push([[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]])),
        scene(&cube(), 0, &[]),
        scene(&cube(), 10, &["dimension=2", "particles.rods.start.random.region={low=[0,0],high=[1,1]}"]),
    ];
    insta::assert_snapshot!(crate::refusals(wrong));
    // A hollow body is one: the inner surface turned towards the hole.
    let mut hole = cuboid([0.25; 3], [0.75; 3]);
    for triangle in &mut hole {
        triangle.swap(0, 1);
    }
    let (clump, packing) = packed(&[cube(), hole].concat(), 30);
    near(clump.volume * (2.0 * packing.reach).powi(3), 1.0 - 0.125, 1e-12);
    assert!(packing.spheres.iter().all(|(_, radius)| *radius < 0.2), "none in the hole");
}

/// A sweep over the number of spheres, and the run folder.
#[test]
fn the_mesh_stands_in_the_run_folder() {
    let varied = ["sweep.vary={\"particles.rods.shape.clump-mesh.spheres\"=[5, 9]}"];
    let scene = scene(&cuboid([0.0; 3], [3.0, 2.0, 1.0]), 5, &varied).unwrap_or_else(|wrong| panic!("{wrong}"));
    let run = tempfile::tempdir().expect("a folder of its own");
    for (name, bytes) in scene.companions() {
        assert_eq!(name, "clumps-rods.stl");
        std::fs::write(run.path().join(name), bytes).expect("a folder of its own");
    }
    let text = scene.resolved_toml();
    let again = Scene::parse("scene.toml", &text, run.path(), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    assert_eq!((again.plan(), again.resolved_toml()), (scene.plan(), text));
    let more = again.with(&[("particles.rods.shape.clump-mesh.spheres", &9.into())]).expect("a case");
    assert_eq!(more.plan().particles["rods"].shape.packing().expect("a packing").spheres.len(), 9);
}

mod patient {
    use super::*;

    /// What is said of the packing is what is there, no sphere leaves the mesh, and the more spheres the less is missing; the spheres of a smaller packing
    /// are the first of a larger one. With its largest sphere left out a packing is not what is said of it.
    #[test]
    #[ignore = "6 s: cargo xtask patient"]
    fn more_spheres_come_nearer_and_the_error_is_told() {
        let half = [1.0, 0.7, 0.4];
        let bodies = [
            (cuboid([0.0; 3], [3.0, 2.0, 1.0]), [0.0; 3], [3.0, 2.0, 1.0]),
            (ellipsoid(half, 3), half.map(|x| -x), half),
        ];
        for (triangles, low, high) in bodies {
            let mut before: Option<(Packing, f64)> = None;
            for count in [3, 10, 40, 150] {
                let (_, packing) = packed(&triangles, count);
                assert_eq!(packing.spheres.len(), count);
                let error = packing.error().expect("spheres");
                let missing = |spheres: &[(Vector, f64)]| counted(spheres, low, high) / packing.solid.volume - 1.0;
                assert!(count > 40 || (missing(&packing.spheres) - error.volume).abs() < 2e-3, "{count}: {error:?}");
                assert!(count > 10 || (missing(&packing.spheres[1..]) - error.volume).abs() > 5e-3, "{count}");
                for (centre, radius) in &packing.spheres {
                    assert!(
                        (0..3).all(|k| centre[k] - radius >= low[k] - 1e-9 && centre[k] + radius <= high[k] + 1e-9)
                    );
                }
                if let Some((fewer, volume)) = before {
                    assert_eq!(fewer.spheres, packing.spheres[..fewer.spheres.len()]);
                    assert!(error.volume > volume && error.volume < 0.0, "{volume} {error:?}");
                    assert!(packing.gap[0] < fewer.gap[0] && packing.gap[1] <= fewer.gap[1]);
                }
                before = Some((packing, error.volume));
            }
            let (packing, volume) = before.expect("packings");
            assert!(volume > -0.1 && packing.gap[0] < 0.015, "{volume} {:?}", packing.gap);
        }
    }
}
