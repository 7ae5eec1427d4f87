//! Who acts from outside: forces and motions do what they say, their work is in the books, and nothing changes where nobody acts.

use glam::DVec3;
use std::path::Path;
use tsubu::ledger::Account;
use tsubu::outside::{Action, Heed, Moment, Push};
use tsubu::run::Simulation;
use tsubu::view::Wants;
use tsubu::wall::Velocity;
use tsubu_scene::Scene;

const BALLS: &str = r#"
seed = 2
duration = "50 ms"
materials.glass = { density = 2500, young-modulus = "5 MPa", restitution = 0.6, friction = 0.4 }
contact = { normal.hertz = {}, tangential.mindlin = {} }
dem.largest-overlap = 0.3
[particles.balls]
material = "glass"
count = 60
diameter = "4 mm"
start.rows.region = { low = [-0.02, 0.01], high = [0.02, 0.08] }
[walls]
floor = { material = "glass", shape.plane = {} }
left = { material = "glass", shape.plane = { point = [-0.025, 0], normal = "x" } }
lid = { material = "glass", shape.plane = { point = [0, 0.12], normal = "-z" } }
right = { material = "glass", shape.plane = { point = [0.025, 0], normal = "-x" } }
"#;

fn opened() -> Simulation {
    let scene = Scene::parse("scene.toml", BALLS, Path::new(""), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    Simulation::open(&scene).unwrap_or_else(|error| panic!("{error}"))
}

fn go(simulation: &mut Simulation, steps: u64) {
    simulation.advance(steps).unwrap_or_else(|fault| panic!("{fault}"));
}

/// Pushes along x and turns, as strong as the time says; nothing of it where `strength` is zero.
struct Wind {
    strength: f64,
    stop_at: u64,
}

impl Action for Wind {
    fn act(&mut self, moment: Moment<'_>, push: &mut Push) -> Heed {
        if self.strength != 0.0 {
            let force = |v: &DVec3| DVec3::X * self.strength * (1.0 - v.x + (200.0 * moment.time).sin());
            push.force.extend(moment.grains.velocity.iter().map(force));
            push.torque.resize(moment.grains.len(), DVec3::Y * 1e-4 * self.strength);
        }
        if moment.step == self.stop_at { Heed::Stop } else { Heed::Act }
    }
}

fn blown(strength: f64, every: u64) -> Simulation {
    let mut simulation = opened();
    let acts = simulation.engine.act(every, Box::new(Wind { strength, stop_at: 0 }));
    assert!(acts.is_ok());
    let steps = simulation.steps_left();
    go(&mut simulation, steps);
    simulation
}

#[test]
fn work_from_outside_is_in_the_books() {
    for every in [1, 7] {
        let simulation = blown(2e-4, every);
        let (energies, ledger) = (simulation.energies(), &simulation.ledger);
        let work = ledger.flow(Account::Outside);
        assert!(work > 0.1 * energies.kinetic, "{work} J");
        assert!(ledger.residual_relative(&energies).abs() < 1e-3, "{}", ledger.residual_relative(&energies));
        let lost = DVec3::from_array(ledger.momentum_residual(simulation.engine.momentum()));
        assert!(lost.length() < 1e-10, "{lost}");
        // What is wrong on purpose: books without the account, which the same gate refuses.
        assert!((ledger.residual(&energies) + work).abs() > 1e-2 * work);
    }
}

#[test]
fn nobody_who_does_nothing_changes_bits() {
    let mut alone = opened();
    let steps = alone.steps_left();
    go(&mut alone, steps);
    assert_eq!(blown(0.0, 1).state().hash(), alone.state().hash());
    assert_ne!(blown(1e-6, 1).state().hash(), alone.state().hash());
}

#[test]
fn who_wants_a_stop_gets_it_after_a_whole_step() {
    let mut simulation = opened();
    assert!(simulation.engine.act(1, Box::new(Wind { strength: 0.0, stop_at: 33 })).is_ok());
    go(&mut simulation, 100);
    assert_eq!(simulation.engine.steps(), 33);
    simulation.engine.leave();
    let mut other = opened();
    go(&mut other, 33);
    assert_eq!(simulation.state().hash(), other.state().hash());
}

#[test]
fn a_steered_wall_works_on_the_grains_and_is_kept() {
    let mut simulation = opened();
    go(&mut simulation, 500);
    let down = Velocity { linear: DVec3::NEG_Z, spin: DVec3::ZERO };
    assert!(simulation.engine.steer("lid", down).is_ok());
    let refused = simulation.engine.steer("roof", down).map_err(|refusal| refusal.to_string());
    assert!(refused.is_err_and(|text| text.contains("no such wall")));
    let askew = simulation.engine.steer("lid", Velocity { linear: DVec3::Y, spin: DVec3::ZERO });
    assert!(askew.is_err_and(|refusal| refusal.to_string().contains("in the plane")));
    let begun = simulation.engine.time();
    let pushed =
        |simulation: &Simulation| simulation.engine.view(Wants::WALLS).walls.iter().any(|lid| lid.force.z > 0.0);
    while !pushed(&simulation) && simulation.engine.time() < 0.2 {
        go(&mut simulation, 5);
    }
    go(&mut simulation, 5);
    let lid = simulation.engine.walls().iter().find(|wall| wall.name == "lid").map(|wall| wall.pose.offset.z);
    assert!(lid.is_some_and(|z| (z + simulation.engine.time() - begun).abs() < 1e-12), "{lid:?}");
    let energies = simulation.energies();
    assert!(simulation.ledger.flow(Account::Outside) > 0.0 && simulation.ledger.flow(Account::WallWork) == 0.0);
    assert!(simulation.ledger.residual_relative(&energies).abs() < 1e-3);

    let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
    let kept = simulation.checkpoint(&folder.path().join("kept"));
    assert!(kept.is_ok(), "{kept:?}");
    let again = Simulation::resume(simulation.scene(), &folder.path().join("kept"));
    let mut again = again.unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(again.state().hash(), simulation.state().hash());
    go(&mut again, 40);
    go(&mut simulation, 40);
    assert_eq!(again.state().hash(), simulation.state().hash());
}

#[test]
fn memory_that_is_given_away_keeps_its_numbers() {
    let mut simulation = opened();
    go(&mut simulation, 10);
    let before = simulation.engine.view(Wants::GRAINS).grains.position.into_owned();
    let kept = simulation.engine.renew("position").and_then(|memory| memory.downcast::<Vec<DVec3>>().ok());
    go(&mut simulation, 10);
    assert_eq!(kept.map(|kept| *kept), Some(before));
    assert!(simulation.engine.renew("colour").is_none());
}
