//! Every feature at once: 20,000 grains in space, the same bits for any number of threads and after a resume, and books
//! that close.

use super::run_text;

/// A world that repeats along x and y: a rough frozen floor, two kinds of grains of distributed sizes that stick, roll and
/// twist with resistance, a driven row, a turning paddle of triangles, a ball that falls freely, a lid that presses, a
/// stream of grains that comes, a region where grains go, and a stream of water with a surface.
pub const EVERYTHING: &str = r#"
title = "everything"
dimension = 3
gravity = [5, 0, -98]
duration = "1 s"
speed-scale = "2 m/s"
[materials.glass]
young-modulus = "5 MPa"
restitution = 0.7
friction = 0.5
rolling-friction = 0.1
twisting-friction = 0.05
surface-energy = 0.01
density = "2500 kg/m^3"
[materials.wood]
young-modulus = "4 MPa"
restitution = 0.5
friction = 0.4
rolling-friction = 0.05
density = "700 kg/m^3"
[[material-pair]]
between = ["glass", "wood"]
friction = 0.3
[periodic]
x = ["0 mm", "64 mm"]
y = ["0 mm", "64 mm"]
[particles.a-base]
material = "wood"
count = 1024
diameter = "2 mm"
motion.frozen = {}
start.rows = { spacing = 1.0, jitter = 0, region = { low = [0, 0, 0], high = ["64 mm", "64 mm", "2 mm"] } }
[particles.b-fine]
material = "glass"
count = 15000
size.uniform = { smallest = "1.6 mm", largest = "2.2 mm" }
start.rows = { spacing = 1.01, jitter = 1, speed = 0.3, region = { low = [0, 0, "2.2 mm"], high = ["64 mm", "64 mm", "60 mm"] } }
[particles.c-coarse]
material = "wood"
count = 40
diameter = "6 mm"
start.random = { region = { low = [0, 0, "52 mm"], high = ["64 mm", "64 mm", "90 mm"] }, velocity = [0, 0, -0.5] }
[particles.d-row]
material = "wood"
count = 8
diameter = "3 mm"
motion.driven = { direction = "y", signal.sine = { amplitude = "2 mm", frequency = "40 Hz" } }
start.rows = { spacing = 1.0, jitter = 0, region = { low = ["10 mm", "32 mm", "92 mm"], high = ["40 mm", "35 mm", "96 mm"] } }
[particles.e-rain]
material = "glass"
count = 4000
size.normal = { mean = "2 mm", deviation = "0.1 mm" }
start.stream = { region = { low = [0, 0, "100 mm"], high = ["64 mm", "64 mm", "110 mm"] }, rate = "300000 1/s", velocity = [0, 0, -0.4] }
[walls.paddle]
material = "wood"
shape.mesh = { path = "paddle.stl" }
rotation = { centre = ["32 mm", "32 mm", "48 mm"], axis = "z", signal.steady.rate = "20 rad/s" }
[walls.ball]
material = "wood"
shape.sphere = { centre = ["20 mm", "20 mm", "116 mm"], radius = "5 mm" }
body = { mass = "0.4 g", inertia = [4e-9, 4e-9, 4e-9], centre = ["20 mm", "20 mm", "116 mm"] }
[walls.lid]
material = "wood"
shape.plane = { point = [0, 0, "125 mm"], normal = "-z" }
servo = { direction = "-z", force = "1 N", mass = "50 g", damping = "1 N s/m" }
[removal.side.inside]
region = { low = ["60 mm", 0, "10 mm"], high = ["64 mm", "4 mm", "20 mm"] }
[water]
density = "50 kg/m^3"
viscosity = "2e-5 m^2/s"
drag.abraham = {}
torque.finite-reynolds = {}
lift = ["saffman-mei", "magnus-oesterle-dinh"]
hindrance.di-felice = {}
flow.coupled = { bottom = 0, top = "70 mm", shear-velocity = "0.2 m/s" }
[contact]
normal.hertz = {}
damping.quarter = {}
cohesion.dmt = {}
film.lubrication = { reach = "0.05 mm" }
tangential.mindlin = {}
rolling.epsd = {}
twisting.spring = {}
[dem]
time-step = "1e-5 s"
"#;

/// A thin block of 12 triangles, 40 mm long.
pub fn paddle(folder: &std::path::Path) {
    let (low, high) = ([0.012, 0.030, 0.046], [0.052, 0.034, 0.050]);
    let corner = |k: usize| {
        let pick = |axis: usize| if k >> axis & 1 == 0 { low[axis] } else { high[axis] };
        format!("vertex {} {} {}", pick(0), pick(1), pick(2))
    };
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let mut text = "solid paddle\n".to_owned();
    for [a, b, c, d] in faces {
        for triangle in [[a, b, c], [a, c, d]] {
            text += "facet normal 0 0 0\nouter loop\n";
            for k in triangle {
                text.push_str(&corner(k));
                text.push('\n');
            }
            text += "endloop\nendfacet\n";
        }
    }
    std::fs::write(folder.join("paddle.stl"), text + "endsolid paddle\n").unwrap();
}

fn hash(threads: usize, resume: bool) -> (String, f64) {
    let folder = tempfile::tempdir().unwrap();
    paddle(folder.path());
    let open = || run_text(EVERYTHING, folder.path(), &[]);
    super::hash(open, [900, 600], threads, resume, |engine, hosts, ledger| {
        assert!(engine.grains() > 19_500 && engine.contacts() > 15_000, "{} {}", engine.grains(), engine.contacts());
        super::missing(engine, hosts, ledger)
    })
}

mod patient {
    use super::hash;

    #[test]
    #[ignore = "half a minute: cargo xtask patient"]
    fn everything_at_once_has_the_same_bits() {
        let (one, residual) = hash(1, false);
        assert!(residual < 1e-3, "{residual:e}");
        assert_eq!(one, hash(7, false).0);
        assert_eq!(one, hash(2, true).0);
    }
}
