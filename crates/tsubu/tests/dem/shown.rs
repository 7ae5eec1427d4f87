//! Forces that frames tell of contacts.

use super::open_text;
use glam::DVec3;
use tsubu_frame::{Frame, Kind, Values};

/// A ball that comes down askew on a floor that holds it, with dashpots so strong that a step cannot bear them along the faces
/// (decision 0014).
const SCENE: &str = r#"
duration = "1 s"
gravity = 0
[materials.soft]
young-modulus = "2 MPa"
density = "2500 kg/m^3"
restitution = 0.1
friction = 1
[particles.ball]
material = "soft"
diameter = "20 mm"
start.at = { position = [[0, 0, "10.01 mm"]], velocity = [["0.3 m/s", 0, "-1 m/s"]] }
[walls.floor]
material = "soft"
shape.plane = { point = [0, 0, 0], normal = [0, 0, 1] }
[contact]
damping.linear = {}
"#;

/// Momentum of the ball [N.s].
fn momentum(frame: &Frame) -> DVec3 {
    let Some(Values::Scalar(mass)) = frame.column(Kind::Grain, "mass").map(|column| &column.values) else { panic!() };
    DVec3::from(frame.vectors(Kind::Grain, "velocity")[0]) * mass[0]
}

/// The friction that frames tell, added up over all steps of an impact, is the momentum along the floor that the ball gets from it. Told
/// without the bound that the step sets to dashpots it was two thirds too much. Along the normal it is told as the law has it at this
/// moment, where in the step of first touch the dashpot acts for a part of the time.
#[test]
fn told_friction_is_what_moves_the_grain() {
    let (mut engine, mut hosts, mut ledger) = open_text(SCENE, &[]);
    let begin = momentum(&engine.frame(&hosts));
    let mut given = 0.0;
    for _ in 0..(20e-3 / engine.time_step()) as u64 {
        engine.advance(1, &mut hosts, &mut ledger).unwrap();
        let told: f64 = engine.frame(&hosts).vectors(Kind::Contact, "force").iter().map(|force| force[0]).sum();
        given += told * engine.time_step();
    }
    assert_eq!(engine.contacts(), 0);
    let got = (momentum(&engine.frame(&hosts)) - begin).x;
    assert!((given / got - 1.0).abs() < 5e-3, "{given:e} {got:e}");
}
