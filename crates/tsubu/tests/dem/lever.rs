//! The arm of the tangential force.

use super::open_text;
use tsubu_frame::Kind;

const SCENE: &str = r#"
dimension = 3
duration = "1 s"
gravity = 0
[materials.soft]
young-modulus = "2 MPa"
poisson-ratio = 0.25
density = "2500 kg/m^3"
restitution = 1
friction = 0.1
[particles.ball]
material = "soft"
diameter = "20 mm"
start.at = { position = [[0, 0, "10.01 mm"]], velocity = [["5 m/s", 0, "-1 m/s"]] }
[walls.floor]
material = "soft"
shape.plane = { point = [0, 0, 0], normal = [0, 0, 1] }
[contact]
damping.none = {}
"#;

/// Spin over loss of speed after an impact that slides all the way: the sum of arm times force over that of force, and I = 2/5 m R^2.
fn arm(lever: &str) -> f64 {
    let (mut engine, mut hosts, mut ledger) = open_text(SCENE, &[&format!("contact.slip-lever={lever}")]);
    engine.advance((20e-3 / engine.time_step()) as u64, &mut hosts, &mut ledger).unwrap();
    let frame = engine.frame(&hosts);
    let (velocity, spin) = (frame.vectors(Kind::Grain, "velocity")[0], frame.vectors(Kind::Grain, "spin")[0]);
    assert!(velocity[2] > 0.9, "it has left the floor: {velocity:?}");
    0.4 * 0.01 * 0.01 * spin[1] / (5.0 - velocity[0])
}

/// By the radius R the torque is R times the force, to the last digits. By the middle of the overlap it is less by half of the overlap,
/// in the mean over the force: of Hertz, with x = (d / d_max)^(5/2), that of d / d_max is half of the integral of x^(2/5) / sqrt(1 - x)
/// from 0 to 1, 0.8176.
#[test]
fn the_arm_is_the_one_asked_for() {
    let [radius, middle] = ["radius", "middle"].map(arm);
    assert!((radius / 0.01 - 1.0).abs() < 1e-12, "{radius}");
    let mass = 2500.0 * 4.0 / 3.0 * std::f64::consts::PI * 1e-6;
    let stiffness = 4.0 / 3.0 * 2e6 / (2.0 * (1.0 - 0.0625)) * 0.1;
    let deepest = (5.0 * mass / (4.0 * stiffness)).powf(0.4);
    let expected = 0.01 - 0.5 * 0.8176 * deepest;
    assert!((middle / expected - 1.0).abs() < 2e-4, "{middle} {expected}");
    assert!((radius / expected - 1.0).abs() > 0.05, "the other arm is noticed");
}
