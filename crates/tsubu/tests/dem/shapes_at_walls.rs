//! Polyhedra and superellipsoids at meshes, drums and other walls that are no planes.

use super::seams::{crate_of, stl};
use super::{missing, run_text, same_for_all};
use std::fmt::Write as _;
use tsubu::engine::Engine;
use tsubu::partner::Hosts;
use tsubu_frame::Kind;
use tsubu_scene::{Scene, TEMPLATES};

/// Bodies that lose nothing, without gravity.
const SCENE: &str = r#"
dimension = 3
duration = "1 s"
gravity = 0
[dem]
largest-overlap = 1
[materials.wood]
young-modulus = "200 MPa"
poisson-ratio = 0.3
density = "1000 kg/m^3"
restitution = 1
friction = 0
[contact]
normal.hertz = {}
[particles.bodies]
material = "wood"
diameter = "8 mm"
"#;

const CUBE: &str = "polyhedron = { corners = [[-1, -1, -1], [1, -1, -1], [-1, 1.2, -1], [1, 1.2, -1], [-1, -1, 1], [1, -1, 1], [-1, 1.2, 1], [1, 1.2, 1]], rounding = 0.2 }";
const EGG: &str = "superellipsoid = { semi-axes = [3, 2, 1.5] }";
const TIN: &str = "superellipsoid = { semi-axes = [2, 2, 2.5], exponents = [4, 3] }";

const PAIR: &str = "clump = { centre = [[-1, 0, 0], [1, 0, 0]], diameter = [2, 2] }";

type Triangles = Vec<[[f64; 3]; 3]>;

fn walls(all: &[&str]) -> String {
    all.iter().enumerate().fold(String::new(), |mut text, (k, wall)| {
        let _ = write!(text, "[walls.w{k}]\nmaterial = \"wood\"\n{wall}\n");
        text
    })
}

fn crowd(shape: &str, count: usize, region: &str, all: &[&str]) -> String {
    format!(
        "{SCENE}count = {count}\nshape.{shape}\nstart.random = {{ region = {region}, speed = 0.6 }}\n{}",
        walls(all)
    )
}

/// A mesh of two cuts along each edge.
fn finer(triangles: &Triangles) -> Triangles {
    let middle = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|k| 0.5 * (a[k] + b[k]));
    let cut = |[a, b, c]: &[[f64; 3]; 3]| {
        let [d, e, f] = [middle(*a, *b), middle(*b, *c), middle(*c, *a)];
        [[*a, d, f], [d, *b, e], [f, e, *c], [d, e, f]]
    };
    triangles.iter().flat_map(cut).collect()
}

/// A roof with its ridge along y, on a floor.
fn roof() -> Triangles {
    let [a, b, c, d] = [[-0.008, -0.012, 0.004], [0.008, -0.012, 0.004], [0.008, 0.012, 0.004], [-0.008, 0.012, 0.004]];
    let [e, f] = [[0.0, -0.009, 0.014], [0.0, 0.009, 0.014]];
    vec![[a, b, e], [b, c, f], [b, f, e], [c, d, f], [d, a, e], [d, e, f], [a, c, b], [a, d, c]]
}

fn run<R>(
    text: &str,
    mesh: &Triangles,
    changes: &[&str],
    seconds: f64,
    look: impl Fn(&dyn Engine) -> R,
) -> (R, [f64; 4]) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("mesh.stl"), stl(mesh)).unwrap();
    let (mut engine, mut hosts, mut ledger) = run_text(text, folder.path(), changes);
    let before = engine.grain_energies().kinetic;
    engine.advance((seconds / engine.time_step()) as u64, &mut hosts, &mut ledger).unwrap();
    let after = engine.grain_energies();
    let held = (after.kinetic + after.rotational + after.elastic) / before - 1.0;
    (look(&*engine), [held, after.rotational / before, missing(&*engine, &hosts, &ledger), engine.time_step()])
}

fn place(engine: &dyn Engine) -> Vec<f64> {
    let frame = engine.frame(&Hosts::default());
    ["position", "velocity", "spin"].iter().flat_map(|name| frame.vectors(Kind::Grain, name)[0]).collect()
}

/// One body that flies about in a box of planes and in boxes of triangles goes the same way; in a box that is 0.1 % wider it does not.
#[test]
fn a_box_of_triangles_is_a_box_of_planes() {
    let (low, high) = ([-0.011, -0.011, 0.0], [0.011, 0.011, 0.022]);
    for shape in [CUBE, EGG, TIN] {
        let start =
            "start.at = { position = [[0, 0.001, 0.01]], velocity = [[0.7, 0.5, -0.3]], spin = [[40, -30, 90]] }";
        let text = |wall: &str| format!("{SCENE}shape.{shape}\n{start}\n{}", walls(&[wall]));
        let changes = ["materials.wood.restitution=0.8", "materials.wood.friction=0.3"];
        let end = |wall: &str, mesh: &Triangles| run(&text(wall), mesh, &changes, 0.08, place).0;
        let planes = end("shape.box = { width = 0.022, depth = 0.022, height = 0.022 }", &vec![]);
        let far = |mesh: &Triangles| {
            let other = end("shape.mesh.path = \"mesh.stl\"", mesh);
            let size = planes.iter().map(|x| x * x).sum::<f64>();
            (planes.iter().zip(&other).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / size).sqrt()
        };
        let whole = crate_of(low, high);
        for mesh in [&whole, &finer(&finer(&whole))] {
            assert!(far(mesh) < 1e-6, "{shape}: {:e}", far(mesh));
        }
        let wider = crate_of([-0.011_022, -0.011, 0.0], high);
        assert!(far(&wider) > 1e-4, "{shape}: {:e}", far(&wider));
    }
}

/// Bodies that lose nothing keep their energy among sharp edges and corners of a mesh, in a drum, about a roller, a globe and the rims of a pipe; at a step five times as long they do not.
#[test]
fn bodies_that_lose_nothing_keep_their_energy() {
    let region = "{ low = [-0.02, -0.02, 0.015], high = [0.02, 0.02, 0.055] }";
    let outer = "shape.box = { width = 0.042, depth = 0.042, height = 0.06 }";
    let roof_mesh = "shape.mesh.path = \"mesh.stl\"";
    let drum = [
        "shape.cylinder = { point = [0, -0.02, 0.03], axis = [0, 1, 0], radius = 0.026, length = 0.04 }",
        "shape.plane = { point = [0, -0.02, 0], normal = [0, 1, 0] }",
        "shape.plane = { point = [0, 0.02, 0], normal = [0, -1, 0] }",
    ];
    let roller = "shape.cylinder = { point = [0, 0, 0], axis = [0, 1, 0], radius = 0.012 }";
    let funnel = [
        "shape.cone = { point = [0, 0, 0], axis = [0, 0, 1], radius = 0.01, end-radius = 0.03, length = 0.06 }",
        "shape.plane = { point = [0, 0, 0], normal = [0, 0, 1] }",
        "shape.plane = { point = [0, 0, 0.06], normal = [0, 0, -1] }",
    ];
    let globe = "shape.sphere = { centre = [0, 0, 0.0], radius = 0.012 }";
    let in_drum = "{ low = [-0.015, -0.015, 0.018], high = [0.015, 0.015, 0.042] }";
    let in_funnel = "{ low = [-0.014, -0.014, 0.035], high = [0.014, 0.014, 0.055] }";
    let pipe = "shape.cylinder = { point = [0, 0, 0.004], axis = [0.2, 0, 0.8], radius = 0.009, length = 0.01 }";
    let open = "shape.cylinder = { point = [0, 0, -0.01], axis = [0, 0, 1], radius = 0.02, length = 0.08 }";
    let mut cases = vec![(CUBE, region, vec![outer, globe], 14), (EGG, region, vec![outer, globe], 14)];
    for shape in [CUBE, EGG, TIN] {
        cases.extend([
            (shape, region, vec![outer, roof_mesh], 14),
            (shape, in_drum, drum.to_vec(), 10),
            (shape, region, vec![outer, roller], 14),
            (shape, region, vec![outer, pipe], 14),
            (shape, "{ low = [-0.012, -0.012, 0.01], high = [0.012, 0.012, 0.055] }", vec![outer, open], 10),
            (shape, in_funnel, funnel.to_vec(), 8),
        ]);
    }
    for (shape, region, walls, count) in cases {
        let text = crowd(shape, count, region, &walls);
        let ((), [off, turning, books, step]) = run(&text, &roof(), &[], 0.1, |_| ());
        assert!(turning > 0.05, "they turn: {turning}");
        assert!(off.abs() < 1e-3 && books < 1e-3, "{shape} {walls:?}: {off:e} {books:e}");
        let longer = format!("dem.time-step={}", 5.0 * step);
        let ((), [wrong, ..]) = run(&text, &roof(), &[&longer], 0.1, |_| ());
        assert!(wrong.abs() > off.abs(), "{shape} {walls:?}: {wrong:e}");
    }
}

/// Cubes, eggs, tins, clumps and spheres that lose nothing keep their energy among each other, and the momentum of two that meet; at a step five times as long they do not.
#[test]
fn all_shapes_side_by_side_keep_their_energy() {
    let region = "{ low = [-0.02, -0.02, 0.002], high = [0.02, 0.02, 0.055] }";
    let outer = "shape.box = { width = 0.042, depth = 0.042, height = 0.06 }";
    let more = [("egg", EGG), ("tin", TIN), ("ball", "sphere = {}"), ("pair", PAIR)];
    let groups = more.iter().fold(String::new(), |mut text, (name, shape)| {
        let _ = write!(
            text,
            "[particles.{name}]\nmaterial = \"wood\"\ndiameter = \"7 mm\"\ncount = 6\nshape.{shape}\nstart.random = {{ region = {region}, speed = 0.6 }}\n"
        );
        text
    });
    let text = crowd(CUBE, 10, region, &[outer]) + &groups;
    let ((), [off, turning, books, step]) = run(&text, &roof(), &[], 0.1, |_| ());
    assert!(turning > 0.05, "they turn: {turning}");
    assert!(off.abs() < 1e-3 && books < 1e-3, "{off:e} {books:e}");
    let longer = format!("dem.time-step={}", 5.0 * step);
    let ((), [wrong, ..]) = run(&text, &roof(), &[&longer], 0.1, |_| ());
    assert!(wrong.abs() > 1e-3, "{wrong:e}");
}

/// Polygons in the plane: about a disc, in a drum, about the ends of a funnel, and over the corner of a section of a mesh.
#[test]
fn polygons_keep_their_energy() {
    let shape =
        "polygon = { corners = [[1, 0.9], [-1, 1.1], [-0.8, -1], [1, -0.7]], rounding = 0.2, thickness = 0.01 }";
    let outer = "shape.box = { width = 0.042, height = 0.06 }";
    let region = "{ low = [-0.02, 0.015], high = [0.02, 0.055] }";
    let disc = "shape.cylinder = { point = [0, 0], axis = [0, 1, 0], radius = 0.012 }";
    let drum = "shape.cylinder = { point = [0, 0.03], axis = [0, 1, 0], radius = 0.03 }";
    let funnel =
        "shape.cone = { point = [0, 0.004], axis = [0, 1], radius = 0.004, end-radius = 0.012, length = 0.008 }";
    for walls in [vec![outer, disc], vec![drum], vec![outer, funnel], vec![outer, "shape.mesh.path = \"mesh.stl\""]] {
        let region = if walls.len() == 1 { "{ low = [-0.015, 0.015], high = [0.015, 0.045] }" } else { region };
        let text = crowd(shape, 6, region, &walls);
        let ((), [off, turning, books, step]) = run(&text, &roof(), &["dimension=2"], 0.2, |_| ());
        assert!(turning > 0.02, "they turn: {turning}");
        assert!(off.abs() < 1e-3 && books < 1e-3, "{walls:?}: {off:e} {books:e}");
        let longer = format!("dem.time-step={}", 8.0 * step);
        let ((), [wrong, ..]) = run(&text, &roof(), &["dimension=2", &longer], 0.2, |_| ());
        assert!(wrong.abs() > off.abs(), "{walls:?}: {wrong:e}");
    }
}

/// Heavy bodies with friction and losses on a mesh that turns and one that shakes: the books close, and the bits are the same whoever computes and after a resume.
#[test]
fn a_stirred_heap_gives_the_same_bits_for_all() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("mesh.stl"), stl(&roof())).unwrap();
    let outer = "shape.box = { width = 0.042, depth = 0.042, height = 0.06 }";
    let turning = "shape.mesh.path = \"mesh.stl\"\nrotation = { centre = [0, 0, 0.008], axis = [0, 0, 1], signal.steady.rate = \"25 rad/s\" }";
    let shaking = "shape.mesh = { path = \"mesh.stl\", shift = [0, 0, 0.02] }\nmotion = { direction = [0, 0, 1], signal.sine = { amplitude = \"1 mm\", frequency = \"40 Hz\" } }";
    for shape in [CUBE, EGG] {
        let region = "{ low = [-0.02, -0.02, 0.036], high = [0.02, 0.02, 0.06] }";
        let text = crowd(shape, 12, region, &[outer, turning, shaking]);
        let changes = ["gravity=150", "materials.wood.restitution=0.6", "materials.wood.friction=0.4"];
        let open = || run_text(&text, folder.path(), &changes);
        let contacts = same_for_all(open, [[6000, 8000], [7100, 6900]]);
        assert!(contacts > 0, "{shape} {contacts}");
    }
}

/// The template with all shapes in a drum, and beside it in a folder its blade.
pub fn mixed(folder: &std::path::Path) -> &'static str {
    let mixed = TEMPLATES.iter().find(|template| template.name == "mixed").unwrap();
    for (name, text) in mixed.files() {
        std::fs::write(folder.join(name), text).unwrap();
    }
    mixed.text
}

/// All shapes side by side in a drum with a blade: the books close, and the bits are the same whoever computes and after a resume.
#[test]
fn the_mixed_drum_gives_the_same_bits_for_all() {
    let folder = tempfile::tempdir().unwrap();
    let mixed = mixed(folder.path());
    let open = || run_text(mixed, folder.path(), &["gravity=80", "dem.largest-overlap=1"]);
    let contacts = same_for_all(open, [[5000, 5060], [6100, 3960]]);
    assert!(contacts > 30, "{contacts}");
}

/// Open ends, and spheres for superellipsoids, are touched as meshes, and that is told; closed ends and no ends are what they are.
#[test]
fn what_is_touched_as_a_mesh_is_told() {
    let told = |shape: &str, all: &[&str]| {
        let start = "start.at = { position = [[0, 0, 0.02]] }";
        let mut text = format!("{SCENE}shape.{shape}\n{start}\n{}", walls(all));
        if text.contains("[[stage]]") {
            text = text.replace("duration = \"1 s\"\n", "");
        }
        let scene = Scene::parse("bodies", &text, std::path::Path::new("."), &[]).unwrap_or_else(|c| panic!("{c}"));
        let engine = tsubu::methods::open(scene.plan(), &Hosts::default()).unwrap();
        engine.notes().iter().map(|note| format!("{}: {}", note.key, note.text)).collect::<Vec<_>>().join("\n")
    };
    let pipe = "shape.cylinder = { point = [0, 0, 0], axis = [0, 0, 1], radius = 0.02, length = 0.05 }";
    let floor = "shape.plane = { point = [0, 0, 0], normal = [0, 0, 1] }";
    let lid = "shape.plane = { point = [0, 0, 0.05], normal = [0, 0, -1] }";
    let gate = format!("{lid}\nuntil = \"1 s\"");
    // A lid that a later stage lifts, as one that goes by itself.
    let lifted = format!(
        "{lid}\n[[stage]]\nname = \"rest\"\nduration = \"1 ms\"\n[[stage]]\nname = \"lift\"\nduration = \"1 ms\"\nset.walls.w2.until = \"0.5 ms\""
    );
    let endless = "shape.cylinder = { point = [0, 0, 0], axis = [0, 0, 1], radius = 0.02 }";
    let shell = "shape.sphere = { centre = [0, 0, 0.02], radius = 0.02 }";
    for shape in [CUBE, EGG] {
        for open in [vec![pipe], vec![pipe, floor], vec![pipe, floor, &gate], vec![pipe, floor, &lifted]] {
            // Half of R (1 - cos(pi/n)), of R = 20 mm, is just below 20 um, 0.5 % of the radius of 4 mm, from n = 50 on.
            let told = told(shape, &open);
            assert!(
                told.contains("walls.w0.shape: grains touch it as a mesh of 50 facets") && told.contains("19.73 um"),
                "{told}"
            );
        }
        assert_eq!(told(shape, &[pipe, floor, lid]), "");
        assert_eq!(told(shape, &[endless]), "");
    }
    assert_eq!(told(CUBE, &[shell]), "");
    assert!(told(EGG, &[shell]).contains("walls.w0.shape"));
    assert_eq!(told("sphere = {}", &[pipe]), "");
}

/// Bodies fall on the mouth of a pipe and stay there: a round one, of radius r, as deep in it as a sphere on a ring of radius R, sqrt(r^2 - R^2) above it; a cube that is wider than
/// the pipe flat on it. On a pipe that is 5 % wider the round one lies lower than the gate allows.
#[test]
fn bodies_rest_on_a_rim() {
    let round = "superellipsoid = { semi-axes = [1, 1, 1] }";
    let cube = "polyhedron = { corners = [[-1, -1, -1], [1, -1, -1], [-1, 1, -1], [1, 1, -1], [-1, -1, 1], [1, -1, 1], [-1, 1, 1], [1, 1, 1]], rounding = 0.2, orientation = \"as-drawn\" }";
    let height = |shape: &str, radius: f64| {
        let pipe =
            format!("shape.cylinder = {{ point = [0, 0, -0.03], axis = [0, 0, 1], radius = {radius}, length = 0.03 }}");
        let start = "start.at = { position = [[0, 0, 0.0042]] }";
        let text = format!("{SCENE}shape.{shape}\n{start}\n{}", walls(&[&pipe]));
        let changes = ["gravity=10", "materials.wood.restitution=0.3", "materials.wood.friction=0.3"];
        run(&text, &vec![], &changes, 0.15, |engine| place(engine)[2]).0
    };
    let (r, ring) = (0.004_f64, 0.002_f64);
    let closed = (r * r - ring * ring).sqrt();
    let lies = |radius: f64| (height(round, radius) - closed).abs() < 0.01 * r;
    assert!(lies(ring), "{} of {closed}", height(round, ring));
    assert!(!lies(1.05 * ring));
    // The rounded cube just fits its sphere: half of the side is r less the rounding over sqrt(3), and the rounding.
    let side = r / (0.8 * 3_f64.sqrt() + 0.2);
    assert!((height(cube, ring) - side).abs() < 0.01 * r, "{} of {side}", height(cube, ring));
}

/// Cubes and eggs leave a funnel by its open end, over a rim that is narrower than the heap is wide; those that are gone are below it, none is elsewhere, and the books close. With the end closed all stay.
#[test]
fn bodies_leave_a_funnel() {
    let funnel =
        "shape.cone = { point = [0, 0, 0], axis = [0, 0, 1], radius = 0.012, end-radius = 0.04, length = 0.05 }";
    let floor = "shape.plane = { point = [0, 0, -0.03], normal = [0, 0, 1] }";
    let gate = "shape.plane = { point = [0, 0, 0], normal = [0, 0, 1] }";
    let region = "{ low = [-0.018, -0.018, 0.008], high = [0.018, 0.018, 0.06] }";
    let below = |all: &[&str]| {
        let eggs = format!(
            "[particles.eggs]\nmaterial = \"wood\"\ndiameter = \"7 mm\"\ncount = 8\nshape.{EGG}\nstart.random = {{ region = {region} }}\n"
        );
        let text = crowd(CUBE, 10, region, all) + &eggs;
        let changes = [
            "gravity=10",
            "materials.wood.restitution=0.5",
            "materials.wood.friction=0.3",
            "materials.wood.young-modulus=2e6",
        ];
        let (below, [_, _, books, _]) = run(&text, &vec![], &changes, 0.4, |engine| {
            let frame = engine.frame(&Hosts::default());
            frame.vectors(Kind::Grain, "position").iter().filter(|at| at[2] < -0.004).count()
        });
        assert!(books < 1e-3, "{books}");
        below
    };
    let gone = below(&[funnel, floor]);
    assert!(gone >= 14, "{gone}");
    assert_eq!(below(&[funnel, floor, gate]), 0);
}
