//! Bodies that come in streams and go: clumps as a whole, superellipsoids and polyhedra.

use super::{hash, missing, open_text};
use std::collections::BTreeMap;
use tsubu::engine::Engine;
use tsubu::partner::Hosts;
use tsubu_frame::Kind;

const HEAD: &str = r#"
dimension = 3
duration = "1 s"
[materials.glass]
young-modulus = "100 MPa"
poisson-ratio = 0.3
density = "2500 kg/m^3"
restitution = 0.6
friction = 0.4
"#;

/// Rods that come in above frozen balls, bounce through between them, in a world that repeats itself, and are taken away below; balls come with them.
const SHOWER: &str = r#"
[periodic]
x = ["-10 mm", "10 mm"]
y = ["-10 mm", "10 mm"]
[particles.balls]
material = "glass"
count = 40
diameter = "2 mm"
start.stream = { region = { low = [-0.01, -0.01, 0.01], high = [0.01, 0.01, 0.02] }, rate = 2000, velocity = [0, 0, -1] }
[particles.held]
material = "glass"
diameter = "4 mm"
start.at.position = [[-0.005, -0.005, 0], [0.005, -0.005, 0], [-0.005, 0.005, 0], [0.005, 0.005, 0]]
motion.frozen = {}
[particles.rods]
material = "glass"
count = 60
size.uniform = { smallest = "3 mm", largest = "5 mm" }
shape.clump = { centre = [[-2, 0, 0], [0, 0, 0], [2, 0, 0.3]], diameter = [2, 2, 3] }
start.stream = { region = { low = [-0.01, -0.01, 0.01], high = [0.01, 0.01, 0.02] }, rate = 3000, velocity = [0.3, 0, -1], speed = 0.2 }
[particles.some]
material = "glass"
count = 5
diameter = "4 mm"
shape.clump = { centre = [[-1, 0, 0], [1, 0, 0]], diameter = [2, 2] }
start.random = { region = { low = [-0.01, -0.01, 0.003], high = [0.01, 0.01, 0.009] }, velocity = [0, 0, -1] }
[removal.below.behind]
point = [0, 0, -0.006]
normal = [0, 0, 1]
"#;

/// The same with ellipsoids and cubes in the place of clumps.
const SHAPES: &str = r#"
[periodic]
x = ["-10 mm", "10 mm"]
y = ["-10 mm", "10 mm"]
[particles.cubes]
material = "glass"
count = 40
diameter = "2.5 mm"
shape.polyhedron = { corners = [[-1, -1, -1], [1, -1, -1], [-1, 1, -1], [1, 1, -1], [-1, -1, 1], [1, -1, 1], [-1, 1, 1], [1, 1, 1]], rounding = 0.4 }
start.stream = { region = { low = [-0.01, -0.01, 0.01], high = [0.01, 0.01, 0.02] }, rate = 2000, velocity = [0, 0, -1] }
[particles.eggs]
material = "glass"
count = 60
size.uniform = { smallest = "2 mm", largest = "3 mm" }
shape.superellipsoid.semi-axes = [3, 2, 1.5]
start.stream = { region = { low = [-0.01, -0.01, 0.01], high = [0.01, 0.01, 0.02] }, rate = 3000, velocity = [0.3, 0, -1], speed = 0.2 }
[particles.held]
material = "glass"
diameter = "4 mm"
start.at.position = [[-0.005, -0.005, 0], [0.005, 0.005, 0]]
motion.frozen = {}
[removal.below.behind]
point = [0, 0, -0.006]
normal = [0, 0, 1]
"#;

/// Pieces of every body that is there.
fn bodies(engine: &dyn Engine) -> BTreeMap<i64, usize> {
    let mut bodies = BTreeMap::new();
    for body in engine.frame(&Hosts::default()).integers(Kind::Grain, "body") {
        *bodies.entry(*body).or_insert(0) += 1;
    }
    bodies
}

/// What `look` sees at the end of a scene, and what has come and gone: the same bits for any number of threads and after a resume in the midst
/// of it, the books closed.
fn traffic<T: Send>(scene: &str, look: fn(&dyn Engine) -> T) -> (T, BTreeMap<String, u64>) {
    let text = format!("{HEAD}{scene}");
    let run = |threads, resume| {
        hash(
            || open_text(&text, &[]),
            [9000, 11_000],
            threads,
            resume,
            |engine, hosts, ledger| {
                let traffic: BTreeMap<String, u64> = engine.traffic().into_iter().collect();
                (missing(engine, hosts, ledger), look(engine), traffic)
            },
        )
    };
    let (alone, (residual, seen, traffic)) = run(1, false);
    assert!(residual < 1e-3, "{residual}");
    assert_eq!(alone, run(2, false).0);
    assert_eq!(alone, run(7, true).0);
    (seen, traffic)
}

/// Bodies are there with all of their pieces.
#[test]
fn clumps_come_and_go() {
    let (bodies, traffic) = traffic(SHOWER, bodies);
    let (rods, balls, gone) =
        (traffic["stream rods grains"], traffic["stream balls grains"], traffic["removal below grains"]);
    assert!(rods > 40 && gone > 20, "{traffic:?}");
    let there = bodies.iter().filter(|(body, _)| **body >= 0).count() as u64;
    let alone_there = bodies[&-1] as u64 - 4;
    assert_eq!(5 + rods + balls, there + alone_there + gone, "{traffic:?}");
    // The five that begin have numbers 0 to 4 and two pieces, the rods three.
    assert!(bodies.iter().all(|(body, pieces)| *body < 0 || *pieces == if *body < 5 { 2 } else { 3 }), "{bodies:?}");
}

/// A clump of a large and a small sphere falls freely through a plane: it goes at the first look after its centre of mass has passed, at
/// sqrt(2 h / g), wherever its pieces are. Its small sphere is through long before: a look at pieces would have taken them one by one.
#[test]
fn a_clump_goes_with_its_centre_of_mass() {
    let height = 0.01_f64;
    let text = format!(
        r#"{HEAD}
[particles.one]
material = "glass"
diameter = "8 mm"
shape.clump = {{ centre = [[0, 0, 0], [0, 0, -5]], diameter = [4, 2], orientation = "as-drawn" }}
start.at.position = [[0, 0, {height}]]
[removal.below.behind]
point = [0, 0, 0]
normal = [0, 0, 1]
"#
    );
    let (mut engine, mut hosts, mut ledger) = open_text(&text, &["gravity=9.81", "dem.time-step=1e-5"]);
    let due = ((2.0 * height / 9.81).sqrt() / engine.time_step() / 50.0).ceil() as u64 * 50;
    engine.advance(due - 1, &mut hosts, &mut ledger).unwrap();
    assert_eq!(engine.grains(), 2, "not before");
    let frame = engine.frame(&hosts);
    assert!(frame.vectors(Kind::Grain, "position")[1][2] < -2e-3, "the small sphere is through");
    engine.advance(1, &mut hosts, &mut ledger).unwrap();
    assert_eq!(engine.grains(), 0);
    assert!(missing(&*engine, &hosts, &ledger) < 1e-3);
    assert!(engine.grain_energies().total().abs() < 1e-15);
}

mod patient {
    use super::*;

    /// What comes and has not gone is there, whatever its shape.
    #[test]
    #[ignore = "8 s: cargo xtask patient"]
    fn ellipsoids_and_cubes_come_and_go() {
        let (there, traffic) = traffic(SHAPES, |engine| engine.grains() as u64);
        let (eggs, cubes, gone) =
            (traffic["stream eggs grains"], traffic["stream cubes grains"], traffic["removal below grains"]);
        assert!(eggs > 40 && cubes > 25 && gone > 20, "{traffic:?}");
        assert_eq!(2 + eggs + cubes, there + gone, "{traffic:?}");
    }
}
