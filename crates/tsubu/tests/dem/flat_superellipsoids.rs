//! Superellipsoids that stay in the plane: each moves as it would in space, where nothing pushes it out of its plane.

use super::{open_text, same_for_all};
use tsubu::engine::Engine;
use tsubu::partner::Hosts;
use tsubu_frame::{Frame, Kind};
use tsubu_scene::Scene;

/// Four bodies that fly at each other in a box; what the plane says otherwise than space is put in by [`scene`].
const BOX: &str = r#"
dimension = DIM
duration = "0.1 s"
gravity = 0
[materials.glass]
young-modulus = "20 MPa"
poisson-ratio = 0.3
density = "2500 kg/m^3"
restitution = RESTITUTION
friction = FRICTION
[contact]
normal.hertz = {}
[dem]
time-step = "2 us"
[particles.seeds]
material = "glass"
diameter = "8 mm"
shape.superellipsoid = { semi-axes = AXES, exponents = EXPONENTS, orientation = "as-drawn" }
start.at = { position = PLACES, velocity = VELOCITIES, spin = SPINS }
[walls.box]
material = "glass"
shape.box = SIZE
"#;

const PLACES: [[f64; 2]; 4] = [[-0.008, 0.006], [0.009, 0.007], [-0.005, 0.021], [0.008, 0.022]];
const VELOCITIES: [[f64; 2]; 4] = [[1.0, 0.3], [-0.9, 0.1], [0.2, -1.0], [-0.5, -0.8]];
const SPINS: [f64; 4] = [40.0, -90.0, 20.0, 0.0];
const ELLIPSES: &str = "[2, 2]";
/// Round along y: of a side that is flat there, too, the place of contact is not unique in space.
const BRICKS: &str = "[6, 2]";

/// In the plane, or in space with a depth over the shorter semi-axis.
fn scene(depth: Option<f64>, exponents: &str) -> String {
    let vectors = |list: [[f64; 2]; 4]| {
        let one = |[x, z]: [f64; 2]| if depth.is_some() { format!("[{x}, 0, {z}]") } else { format!("[{x}, {z}]") };
        format!("[{}]", list.map(one).join(", "))
    };
    let spins = SPINS.map(|spin| if depth.is_some() { format!("[0, {spin}, 0]") } else { spin.to_string() });
    let axes = depth.map_or("[1.5, 1]".to_owned(), |depth| format!("[1.5, {depth}, 1]"));
    let size =
        if depth.is_some() { "{ width = 0.03, depth = 1, height = 0.03 }" } else { "{ width = 0.03, height = 0.03 }" };
    BOX.replace("DIM", if depth.is_some() { "3" } else { "2" })
        .replace("AXES", &axes)
        .replace("EXPONENTS", exponents)
        .replace("PLACES", &vectors(PLACES))
        .replace("VELOCITIES", &vectors(VELOCITIES))
        .replace("SPINS", &format!("[{}]", spins.join(", ")))
        .replace("SIZE", size)
}

/// Of real glass beads, which lose and rub.
fn lossy(text: &str) -> String {
    text.replace("RESTITUTION", "0.6").replace("FRICTION", "0.4")
}

fn frame(engine: &dyn Engine) -> Frame {
    engine.frame(&Hosts::default())
}

fn vectors(engine: &dyn Engine, name: &str) -> Vec<[f64; 3]> {
    frame(engine).vectors(Kind::Grain, name).to_vec()
}

/// After some impacts, of bodies as deep as their shorter semi-axis is long, places and spins are those in space; a body half as deep again has
/// another mass and roundness, and goes elsewhere.
#[test]
fn a_body_moves_as_it_would_in_space() {
    let end = |depth: Option<f64>, exponents: &str| {
        let (mut engine, mut hosts, mut ledger) = open_text(&lossy(&scene(depth, exponents)), &[]);
        engine.advance(6_000, &mut hosts, &mut ledger).unwrap();
        (vectors(&*engine, "position"), vectors(&*engine, "spin"))
    };
    let far = |a: &[[f64; 3]], b: &[[f64; 3]]| {
        a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    for exponents in [ELLIPSES, BRICKS] {
        let plane = end(None, exponents);
        let away: Vec<[f64; 3]> =
            PLACES.iter().zip(VELOCITIES).map(|([x, z], [u, w])| [x + 0.012 * u, 0.0, z + 0.012 * w]).collect();
        assert!(far(&plane.0, &away) > 1e-3, "they have met");
        let space = end(Some(1.0), exponents);
        assert!(
            far(&plane.0, &space.0) < 1e-8 && far(&plane.1, &space.1) < 1e-4,
            "{exponents} {}",
            far(&plane.0, &space.0)
        );
        let deeper = end(Some(1.5), exponents);
        assert!(far(&plane.0, &deeper.0) > 1e-5, "{exponents} {}", far(&plane.0, &deeper.0));
    }
}

/// Nothing comes out of the plane, to the bit, and bodies that lose nothing keep their energy, those with flat sides as well as in space; a step
/// twenty times as long does not.
#[test]
fn nothing_leaves_the_plane_and_energy_is_kept() {
    let text = |exponents| scene(None, exponents).replace("RESTITUTION", "1").replace("FRICTION", "0");
    for (exponents, most) in [(ELLIPSES, 1e-4), (BRICKS, 1e-3)] {
        let lost = |change: &[&str], steps| {
            let (mut engine, mut hosts, mut ledger) = open_text(&text(exponents), change);
            let energy = |engine: &dyn Engine| {
                let energies = engine.grain_energies();
                energies.kinetic + energies.rotational + energies.elastic
            };
            let begun = energy(&*engine);
            engine.advance(steps, &mut hosts, &mut ledger).unwrap();
            for name in ["position", "velocity"] {
                assert!(vectors(&*engine, name).iter().all(|v| v[1] == 0.0), "{name}");
            }
            assert!(vectors(&*engine, "spin").iter().all(|v| v[0] == 0.0 && v[2] == 0.0));
            (energy(&*engine) / begun - 1.0).abs()
        };
        let [right, wrong] = [lost(&[], 50_000), lost(&["dem.time-step='40 us'"], 2_500)];
        assert!(right < most && wrong > most, "{exponents}: {right} {wrong}");
    }
}

/// The bits of a heap of both kinds are those of any number of threads, and of a run that was resumed.
#[test]
fn a_planar_heap_has_the_same_bits() {
    let text = lossy(&scene(None, BRICKS)).replace(
        "[walls.box]",
        "[particles.more]\nmaterial = \"glass\"\ncount = 40\ndiameter = \"2 mm\"\nshape.superellipsoid = { semi-axes = [2, 1] }\n\
         start.random.region = { low = [-0.013, 0.002], high = [0.013, 0.028] }\n[walls.box]",
    );
    let open = || open_text(&text, &["gravity=9.8"]);
    same_for_all(open, [[1_000, 1_000], [300, 1_700]]);
}

/// A depth of 0 is no word of space, and no semi-axis of the plane may be 0.
#[test]
fn a_body_without_thickness_is_refused() {
    for text in [lossy(&scene(Some(0.0), ELLIPSES)), lossy(&scene(None, ELLIPSES)).replace("[1.5, 1]", "[1.5, 0]")] {
        let complaints = Scene::parse("test", &text, std::path::Path::new("."), &[]).expect_err("no thickness");
        assert!(complaints.to_string().contains("has no thickness"), "{complaints}");
    }
}
