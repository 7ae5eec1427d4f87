//! A ball in a smooth tube that turns as it is told: what the walls do to it is what centrifugal and Coriolis forces do in the frame that
//! turns. Along the tube r'' = r w^2 - g sin(a) for an angle a and its rate w; across it the wall pushes with m (2 w r' + r w').

use tsubu::engine;
use tsubu::ledger::{Account, Ledger};
use tsubu::partner::Hosts;
use tsubu_scene::Scene;

/// Mass of the ball [kg].
const MASS: f64 = 0.5;

/// Where the ball is along x and z, the work that its walls have done, and the residual of the books, after so long.
fn flung(gravity: f64, velocity: [f64; 2], rotation: &str, duration: f64) -> ([f64; 2], f64, f64) {
    let text = format!(
        r#"
dimension = 3
gravity = {gravity}
duration = "1 s"
speed-scale = "1 m/s"
dem.time-step = "20 us"
[materials.steel]
young-modulus = "1 GPa"
restitution = 0.5
friction = 0
[particles.ball]
material = "steel"
diameter = "10 mm"
mass = {MASS}
start.at = {{ position = [[0.1, 0, 0]], velocity = [[{}, 0, {}]] }}
[walls.tube]
material = "steel"
shape.box = {{ width = "2 m", height = "10.001 mm", depth = "10.001 mm", floor-centre = [0, 0, "-5.0005 mm"] }}
{rotation}
"#,
        velocity[0], velocity[1]
    );
    let scene =
        Scene::parse("scene.toml", &text, std::path::Path::new("."), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    let mut hosts = Hosts::default();
    let mut engine = tsubu::methods::open(scene.plan(), &hosts).unwrap();
    let mut ledger = Ledger::open(engine::energies(&*engine, &hosts), engine.momentum());
    engine.advance((duration / engine.time_step()).round() as u64, &mut hosts, &mut ledger).unwrap();
    let [x, _, z] = engine.centre_of_mass();
    ([x, z], ledger.flow(Account::WallWork), ledger.residual_relative(&engine::energies(&*engine, &hosts)))
}

/// At a steady rate r = r0 cosh(w t), and the walls do the work m r'^2: half of it makes the ball quicker along the tube, half across. Control: a
/// tube that stands, and a ball that nothing flings.
#[test]
fn a_steady_tube_flings_a_ball() {
    let (rate, time) = (4.0, 0.4);
    let turning = format!("rotation.signal.steady.rate = {rate}");
    // About y: x turns to -z.
    let ([x, z], work, residual) = flung(0.0, [0.0, -0.1 * rate], &turning, time);
    let (r, quick) = (0.1 * (rate * time).cosh(), 0.1 * rate * (rate * time).sinh());
    assert!((x.hypot(z) / r - 1.0).abs() < 2e-3, "{x} {z} {r}");
    assert!(((-z).atan2(x) - rate * time).abs() < 2e-3, "{x} {z}");
    assert!((work / (MASS * quick * quick) - 1.0).abs() < 5e-3, "{work}");
    assert!(residual.abs() < 1e-3, "{residual}");
    let (still, ..) = flung(0.0, [0.0, 0.0], "", time);
    assert!((still[0] / r - 1.0).abs() > 0.5, "{still:?}");
}

/// A tube that tilts to and fro: the ball goes down it, and outwards by the centrifugal force. Control: the path without that force.
#[test]
fn a_tilting_tube_lets_a_ball_run() {
    let (amplitude, frequency, time) = (0.3, 1.5, 0.35);
    let rotation = format!("rotation.signal.sine = {{ amplitude = {amplitude}, frequency = {frequency} }}");
    let turns = std::f64::consts::TAU * frequency;
    let angle = |t: f64| amplitude * (turns * t).sin();
    let rate = |t: f64| amplitude * turns * (turns * t).cos();
    // Runge-Kutta 4 at a tiny step; the angle turns x down.
    let run = |centrifugal: f64| {
        let law = |t: f64, r: f64| centrifugal * r * rate(t).powi(2) + 9.8 * angle(t).sin();
        let (mut r, mut v, dt) = (0.1, 0.0, 1e-5);
        for step in 0..(time / dt) as usize {
            let t = step as f64 * dt;
            let (k1, l1) = (v, law(t, r));
            let (k2, l2) = (v + 0.5 * dt * l1, law(t + 0.5 * dt, r + 0.5 * dt * k1));
            let (k3, l3) = (v + 0.5 * dt * l2, law(t + 0.5 * dt, r + 0.5 * dt * k2));
            let (k4, l4) = (v + dt * l3, law(t + dt, r + dt * k3));
            r += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
            v += dt / 6.0 * (l1 + 2.0 * l2 + 2.0 * l3 + l4);
        }
        r
    };
    let ([x, z], _, residual) = flung(9.8, [0.0, -0.1 * rate(0.0)], &rotation, time);
    let r = x * angle(time).cos() - z * angle(time).sin();
    assert!((r / run(1.0) - 1.0).abs() < 2e-3, "{r} {}", run(1.0));
    assert!((r / run(0.0) - 1.0).abs() > 0.02, "{r} {}", run(0.0));
    assert!(residual.abs() < 1e-3, "{residual}");
}
