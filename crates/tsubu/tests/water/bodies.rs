//! Bodies that are no spheres, in water.

use super::after;
use crate::dem::{hash, open_text};
use glam::DVec3;
use std::f64::consts::PI;
use std::fmt::Write as _;
use tsubu::engine::{self, Engine};
use tsubu::view::Wants;

/// One body of quartz in space, at rest, in still water.
fn alone(shape: &str) -> String {
    format!(
        r#"
dimension = 3
gravity = "9.81 m/s^2"
duration = "10 s"
speed-scale = "1 m/s"
[materials.quartz]
young-modulus = "5 MPa"
density = "2650 kg/m^3"
[particles.body]
material = "quartz"
diameter = "17.3205 mm"
start.at = {{ position = [[0, 0, 0]] }}
shape.{shape}
[water]
density = "1000 kg/m^3"
viscosity = "1e-6 m^2/s"
"#
    )
}

const CUBE: &str = "polyhedron = { corners = [[-1, -1, -1], [1, -1, -1], [-1, 1, -1], [1, 1, -1], [-1, -1, 1], [1, -1, 1], [-1, 1, 1], [1, 1, 1]], rounding = 0.001 }";
/// Two spheres that overlap, a small one well away from the centre of mass, and one across.
const ODD: &str = "clump = { centre = [[0, 0, 0], [1.5, 0, 0], [0.4, 1, 0.3]], diameter = [2, 1.4, 1] }";

/// Mass and velocity of the one body there is, and the greatest spin of its pieces.
fn body(engine: &dyn Engine) -> (f64, DVec3, f64) {
    let view = engine.view(Wants::GRAINS);
    let g = &view.grains;
    let mass: f64 = g.mass.iter().sum();
    let velocity = g.mass.iter().zip(&*g.velocity).map(|(m, v)| *m * *v).sum::<DVec3>() / mass;
    (mass, velocity, g.spin.iter().map(|spin| spin.length()).fold(0.0, f64::max))
}

/// A cube of 10 mm sinks, at a Reynolds number of 5500, with the drag that Pettyjohn and Christiansen (1948) measured of isometric bodies
/// there, C = 5.31 - 4.88 s with the sphericity s = (pi/6)^(1/3) of a cube, on the sphere of its volume. Its drag taken for that of a sphere, 0.44,
/// it would be 1.77 times as fast.
#[test]
fn a_cube_sinks_as_measured() {
    let sink = |change: &str| {
        let (engine, _, missing) = after(&alone(CUBE), &[change], 2.0);
        assert!(missing < 1e-3, "{missing:e}");
        body(&*engine).1
    };
    let sphericity = (PI / 6.0).cbrt();
    let diameter = 0.01 * (6.0 / PI).cbrt();
    let measured = (4.0 / 3.0 * 1.65 * 9.81 * diameter / (5.31 - 4.88 * sphericity)).sqrt();
    let found = sink("water.drag.haider-levenspiel={}");
    assert!((-found.z / measured - 1.0).abs() < 0.03, "{found} {measured}");
    let round = sink("water.drag.constant.coefficient=0.44");
    assert!((-round.z / measured - 1.0).abs() > 0.5, "{round} {measured}");
}

/// Without drag a body of any shape gains (m - rho V) g / (m + C rho V), and does not turn: pressure and the water that moves along act at its
/// centre of mass. Where each sphere of a clump had its own buoyancy, what overlaps would count twice: 1 % more volume is refused.
#[test]
fn a_body_begins_to_sink_with_its_own_volume() {
    for (shape, coefficient) in
        [(ODD, 0.5), (CUBE, 0.5), (ODD, 0.0), ("superellipsoid = { semi-axes = [3, 2, 1] }", 0.5)]
    {
        let added = format!("water.added-mass={coefficient:?}");
        let (engine, ledger, missing) = after(&alone(shape), &["water.drag.none={}", &added], 0.2);
        let (mass, velocity, spin) = body(&*engine);
        let gains = |displaced: f64| (mass - displaced) * 9.81 / (mass + coefficient * displaced);
        let (displaced, time) = (mass / 2.65, engine.time());
        assert!((-velocity.z / time / gains(displaced) - 1.0).abs() < 1e-12, "{shape} {velocity}");
        assert!((-velocity.z / time / gains(1.01 * displaced) - 1.0).abs() > 1e-3);
        assert!(spin < 1e-9, "{shape} {spin}");
        assert!(missing < 1e-12, "{missing:e}");
        let momentum = ledger.momentum_residual(engine.momentum());
        assert!(momentum.iter().all(|p| p.abs() < 1e-13), "{momentum:?}");
    }
}

/// Balls, pairs, ellipsoids and cubes fall through a surface onto a floor, with drag and a torque on their spin.
pub fn splash(count: u32) -> String {
    let mut text = r#"
dimension = 3
duration = "1 s"
speed-scale = "1 m/s"
[materials.stone]
density = "2650 kg/m^3"
young-modulus = "100 MPa"
restitution = 0.5
friction = 0.4
[walls.floor]
material = "stone"
shape.plane = {}
[periodic]
x = [0, "60 mm"]
y = [0, "60 mm"]
[water]
density = "1000 kg/m^3"
viscosity = "1e-6 m^2/s"
surface = "60 mm"
drag.haider-levenspiel = {}
torque.finite-reynolds = {}
"#
    .to_owned();
    let shapes = [
        ("balls", "sphere = {}"),
        ("pairs", "clump = { centre = [[-1, 0, 0], [1, 0, 0]], diameter = [2.4, 2.4] }"),
        ("odd", ODD),
        ("seeds", "superellipsoid = { semi-axes = [3, 2, 1.5] }"),
        ("cubes", &CUBE.replace("0.001", "0.2")),
    ];
    for (name, shape) in shapes {
        let _ = write!(
            text,
            "[particles.{name}]\nmaterial = \"stone\"\ncount = {count}\ndiameter = \"9 mm\"\nshape.{shape}\nstart.random.region = {{ low = [0, 0, \"6 mm\"], high = [\"60 mm\", \"60 mm\", \"160 mm\"] }}\n"
        );
    }
    text
}

/// Books close through the surface, and momentum is what gravity, the water and the floor gave.
#[test]
fn bodies_of_all_shapes_fall_into_water() {
    let (mut engine, mut hosts, mut ledger) = open_text(&splash(12), &[]);
    let steps = (0.25 / engine.time_step()).round() as u64;
    engine.advance(steps, &mut hosts, &mut ledger).unwrap();
    let missing = ledger.residual_relative(&engine::energies(&*engine, &hosts)).abs();
    assert!(missing < 1e-3, "{missing:e}");
    let turned = ledger.water_impulse[2];
    assert!(turned > 0.0, "water carries: {turned}");
    let momentum = ledger.momentum_residual(engine.momentum());
    assert!(momentum.iter().all(|p| p.abs() < 1e-3 * turned), "{momentum:?} {turned}");
}

#[test]
fn bodies_in_water_have_the_same_bits() {
    let text = splash(40);
    let bits = |threads, resume| hash(|| open_text(&text, &[]), [1500, 700], threads, resume, |_, _, _| ()).0;
    let one = bits(1, false);
    assert_eq!(one, bits(2, false));
    assert_eq!(one, bits(7, true));
}

/// What bodies leave to the layers of a stream is all but their volumes, and what they gain from it, it loses.
#[test]
fn a_stream_counts_bodies_once() {
    let text = splash(12).replace(
        "surface = \"60 mm\"\n",
        "flow.coupled = { bottom = 0, top = \"180 mm\", area = \"3600 mm^2\", shear-velocity = \"0.1 m/s\" }\n",
    );
    let (mut engine, mut hosts, mut ledger) = open_text(&text, &[]);
    let of = |engine: &dyn Engine| super::coupled::stream(engine);
    let before = of(&*engine);
    let volume: f64 = engine.view(Wants::GRAINS).grains.mass.iter().sum::<f64>() / 2650.0;
    let room = before.layers.top() * before.layers.area;
    let left = before.layers.volume() * before.layers.area;
    assert!(((room - left) / volume - 1.0).abs() < 1e-9, "{} {volume}", room - left);
    let begin = before.momentum();
    engine.advance(1500, &mut hosts, &mut ledger).unwrap();
    let after = of(&*engine);
    let [drive, bottom, grains] = after.impulses;
    let missing = after.momentum() - begin - drive - bottom + grains;
    assert!(missing.abs() < 1e-12 * after.momentum(), "{missing:e}");
    assert!((ledger.water_impulse[0] / grains - 1.0).abs() < 1e-9, "{} {grains}", ledger.water_impulse[0]);
    let coarse = ledger.residual_relative(&engine::energies(&*engine, &hosts)).abs();
    assert!(coarse < 1e-3, "{coarse:e}");
}
