//! What the automaton cannot do, it says: all at once, with the key and a way out.

use super::plans::{at, casing, coupled, plan};
use tsubu::engine::Engine;
use tsubu::lattice::engine::LatticeEngine;
use tsubu::partner::Hosts;
use tsubu_frame::{Advise, State};
use tsubu_scene::plan::*;

fn message(plan: &Plan) -> String {
    let hosts = Hosts::new(&plan.hosts);
    LatticeEngine::new(plan, &hosts).err().map_or_else(|| "it was accepted".to_owned(), |e| e.to_string())
}

#[test]
fn bad_plans_are_refused_with_all_reasons() {
    let good = || plan(50, LatticeMode::Extended);
    let mut bad = good();
    bad.dimension = 3;
    bad.gravity = [1.0, 0.0, -9.8];
    let mut other = bad.particles["balls"].clone();
    other.diameter = 5e-3;
    bad.particles.insert("dust".into(), other);
    let text = message(&bad);
    for key in ["dimension: ", "gravity: ", "particles.dust.diameter: "] {
        assert!(text.contains(key), "{text}");
    }
    assert_eq!(
        message(&plan(161, LatticeMode::Extended)),
        "method `lattice` cannot run this scene:\n  particles: 161 balls do not fit into 10 columns of 16 cells; the automaton's box holds 160"
    );
    let hexagons = |radius: usize, count: usize| {
        let mut plan = plan(count, LatticeMode::Extended);
        plan.lattice.ball_radius = radius;
        plan
    };
    assert_eq!(message(&hexagons(2, 120)), "it was accepted");
    // There is area for 184, and some of it is lost at the sides and between the balls.
    for count in [180, 200] {
        assert!(
            message(&hexagons(2, count))
                .contains(&format!("particles: {count} balls do not fit into 50 columns of 70 cells"))
        );
    }
    let mut bad = hexagons(2, 1);
    casing(&mut bad).shape = Shape::Box { width: 5e-3, height: 96e-3, depth: 6e-3, floor_centre: [0.0; 3] };
    assert!(message(&bad).contains("walls.casing.shape.box: it is smaller than one ball"), "{}", message(&bad));
    let bad = at(hexagons(2, 2), vec![[0.0, 0.0, 0.02], [0.0, 0.0, 0.023]], vec![]);
    assert!(message(&bad).contains("particles.balls.start.at.position[1]: "), "{}", message(&bad));
    let mut bad = good();
    casing(&mut bad).shape = Shape::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] };
    assert!(message(&bad).contains("walls.casing.shape.plane: "), "{}", message(&bad));
    let mut bad = good();
    casing(&mut bad).until = Some(0.5);
    assert!(message(&bad).contains("walls.casing.until: "), "{}", message(&bad));
    let bad = at(good(), vec![[0.0, 0.0, 0.02], [0.0, 0.0, 0.0201]], vec![]);
    assert!(message(&bad).contains("particles.balls.start.at.position[1]: "), "{}", message(&bad));
    let mut bad = coupled(good(), 1e-3, 1.0);
    bad.hosts.get_mut("spring").expect("coupled").direction = [1.0, 0.0, 0.0];
    assert!(message(&bad).contains("hosts.spring.direction: "), "{}", message(&bad));
    let mut bad = coupled(good(), 1e-3, 1.0);
    bad.hosts.get_mut("spring").expect("coupled").structure =
        Structure::Oscillator { mass: 9e-3, stiffness: 12.0, damping: 0.0, cubic_stiffness: 0.0 };
    assert!(message(&bad).contains("lattice.resting-impulses: "), "{}", message(&bad));
    let mut bad = good();
    bad.lattice.time_step = 0.1;
    assert!(message(&bad).contains("lattice.time-step: "), "{}", message(&bad));
    assert_eq!(message(&good()), "it was accepted");
}

/// A ball that began at 1 km/s, or a step of 1 ns, gave energies beyond whole numbers: a panic where overflow is looked for,
/// and wrong books where it is not.
#[test]
fn what_whole_numbers_cannot_hold_is_refused() {
    let fast = at(plan(1, LatticeMode::Extended), vec![[0.0, 0.0, 0.02]], vec![[0.0, 0.0, 1000.0]]);
    assert!(message(&fast).contains("particles: a ball begins faster than 60"), "{}", message(&fast));
    let mut fine = plan(50, LatticeMode::Extended);
    fine.lattice.time_step = 1e-9;
    assert!(message(&fine).contains("lattice.time-step: "), "{}", message(&fine));
}

/// The cell that the verdict tells is the lattice's: a ball of 19 cells had been taken for one.
#[test]
fn the_verdict_tells_the_lattices_own_cell() {
    let cell = |radius: usize| {
        let mut plan = plan(20, LatticeMode::Extended);
        plan.lattice.ball_radius = radius;
        let verdict = tsubu::trial::check(&plan, tsubu::trial::Target::default(), &mut |_, _| {}).unwrap();
        verdict.lines.iter().map(|line| line.text.clone()).find(|text| text.starts_with("lattice: cell")).unwrap()
    };
    assert!(cell(0).starts_with("lattice: cell 6.000 mm"), "{}", cell(0));
    assert!(cell(2).starts_with("lattice: cell 1.376 mm"), "{}", cell(2));
}

/// Checkpoints with right checksums and made-up numbers: speeds beyond whole numbers, two balls in a cell, a ball that rests
/// on nothing. They were gone on from.
#[test]
fn states_that_no_run_comes_to_are_refused() {
    for radius in [0, 2] {
        let mut plan = plan(20, LatticeMode::Extended);
        plan.lattice.ball_radius = radius;
        refuse_states(&plan);
    }
}

fn refuse_states(plan: &Plan) {
    let mut run = super::plans::Run::new(plan);
    let mut whole = State::default();
    run.engine.save(&mut whole);
    let whole = whole.into_owned();
    run.engine.load(&mut whole.clone()).expect("its own state");
    for (name, value) in
        [("lattice.speed", i64::MAX), ("lattice.stored", i64::MIN), ("lattice.cell", 0), ("lattice.resting", 1)]
    {
        let mut forged = whole.clone();
        let mut numbers = whole.integer(name).expect("a section").to_vec();
        let last = numbers.len() - 1;
        numbers[last] = value;
        forged.put_integer(name, numbers);
        assert!(run.engine.load(&mut forged).is_err(), "{name}");
    }
}

/// What is only approximated is noted with its size.
#[test]
fn approximations_are_noted() {
    let plan = plan(50, LatticeMode::Extended);
    let engine = LatticeEngine::new(&plan, &Hosts::default()).expect("a good plan");
    let width = engine.notes().iter().find(|n| n.key == "walls.casing.shape.box.width").expect("the width is noted");
    assert!(width.text.contains("10 columns") && width.text.contains("52.0 mm instead of 60.0 mm"), "{}", width.text);
}

/// Of the law of a pair only what the scene's law does not have is noted again.
#[test]
fn laws_of_pairs_are_noted() {
    let mut plan = plan(50, LatticeMode::Extended);
    let material = plan.materials.keys().next().expect("a material").clone();
    let own = Contact { cohesion: Cohesion::Jkr {}, ..plan.contact.clone() };
    plan.material_pair = vec![MaterialPair {
        between: [material.clone(), material],
        restitution: None,
        friction: None,
        rolling_friction: None,
        twisting_friction: None,
        surface_energy: None,
        cohesion: None,
        contact: Some(own),
    }];
    let engine = LatticeEngine::new(&plan, &Hosts::default()).expect("a good plan");
    let keys: Vec<&str> = engine.notes().iter().map(|n| n.key.as_str()).filter(|k| k.contains("pair")).collect();
    assert_eq!(keys, ["material-pair.0.contact.cohesion"]);
}

/// The automaton knows restitution alone: a law that yields and holds on would have been read as Hooke's without a word.
#[test]
fn a_law_that_yields_is_noted() {
    let mut plan = plan(50, LatticeMode::Extended);
    let noted = |plan: &Plan| {
        let engine = LatticeEngine::new(plan, &Hosts::default()).expect("a good plan");
        engine.notes().iter().any(|note| note.key == "contact.normal")
    };
    plan.contact.normal = Normal::Hooke { stiffness: 1e4 };
    assert!(!noted(&plan));
    let (stiffness, unloading_ratio, adhesion_ratio, plasticity_depth) = (1e4, 5.0, 0.0, 0.05);
    plan.contact.normal = Normal::Luding { stiffness, unloading_ratio, adhesion_ratio, plasticity_depth };
    assert!(noted(&plan));
}

/// A box that leaves its grid stops the run and says which key to change.
#[test]
fn head_room_is_named() {
    let plan = coupled(plan(10, LatticeMode::Extended), 3e-3, 1.0);
    let mut run = super::plans::Run::new(&plan);
    let fault = run.advance(100_000).expect_err("the box swings further than 5 cells");
    let hints = fault.hints();
    assert!(hints.iter().any(|hint| hint.to_string().contains("lattice.head-room")), "{hints:?}");
}
