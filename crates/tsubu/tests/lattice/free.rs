//! Single balls and the moving box: closed forms.

use super::plans::{Run, at, plan, shaken};
use tsubu::engine::Engine;
use tsubu::lattice::direction::Direction;
use tsubu_scene::plan::*;

const G: f64 = 10.0;
const DT: f64 = 1e-4;
const CELL: f64 = 6e-3;

/// A point above the floor in the middle of an even column (no half-cell shift), `cells` up.
fn above_floor(cells: f64) -> Vector {
    let x = (6.0 - 5.5) * CELL * 0.75_f64.sqrt();
    [x, 0.0, CELL * (cells + 0.5)]
}

/// Apexes in cells, their times and the impact times of a ball that falls 15 cells with restitution `e`.
fn drop_test(e: f64) -> (Vec<i64>, Vec<f64>, Vec<f64>) {
    let mut plan = at(plan(1, LatticeMode::Extended), vec![above_floor(15.0)], vec![]);
    plan.materials.get_mut("acrylic").expect("it is there").restitution = e;
    let mut run = Run::new(&plan);
    let (mut apexes, mut times, mut impacts) = (Vec::new(), Vec::new(), Vec::new());
    let mut highest = 0;
    let mut was = Direction::S;
    for step in 1..9391 {
        run.advance(1).expect("nothing can go wrong");
        let damper = run.engine.damper();
        let velocity = damper.velocity(0).k;
        let now = if velocity > 0 { Direction::N } else { Direction::S };
        highest = if now == Direction::N { highest.max(damper.seat(0).1) } else { highest };
        if (was, now) == (Direction::S, Direction::N) {
            impacts.push(f64::from(step) * DT);
            highest = 0;
        }
        if (was, now) == (Direction::N, Direction::S) {
            apexes.push(highest);
            times.push(f64::from(step) * DT);
        }
        was = now;
    }
    (apexes, times, impacts)
}

/// Komatsuzaki 2003, fig. 8.
fn drop_test_passes(e: f64) -> bool {
    let (apexes, times, impacts) = drop_test(e);
    let near = |a: f64, b: f64| (a / b - 1.0).abs() < 0.02;
    let apex_times = [0.23479, 0.41088, 0.54295, 0.64198, 0.71628];
    let impact_times = [0.13416, 0.33541, 0.48634, 0.59955, 0.68445, 0.74812];
    apexes.len() >= 5
        && apexes[..5] == [8, 4, 2, 1, 0]
        && times.iter().zip(apex_times).all(|(a, b)| near(*a, b))
        && impacts.iter().zip(impact_times).all(|(a, b)| near(*a, b))
}

#[test]
fn drop_test_has_the_apexes_of_theory() {
    assert!(drop_test_passes(0.75), "{:?}", drop_test(0.75));
    assert!(!drop_test_passes(0.72), "the gate must notice a wrong restitution");
}

/// After n steps a ball has fallen g dt^2 n (n + 1) / 2, exactly.
#[test]
fn free_fall_is_exact() {
    let plan = at(plan(1, LatticeMode::Literal), vec![above_floor(15.0)], vec![]);
    let mut run = Run::new(&plan);
    let damper = run.engine.damper();
    let cell = damper.scale.cell;
    for n in 1..1300_i64 {
        run.advance(1).expect("nothing can go wrong");
        let damper = run.engine.damper();
        let fallen = (15 - damper.seat(0).1) * cell - damper.offset(0).k / 2;
        assert_eq!(fallen, 1024 * n * (n + 1) / 2, "step {n}");
        assert_ne!(fallen, 1024 * n * n / 2, "the gate must notice a wrong scheme");
    }
    assert!((run.engine.damper().scale.distance * 1024.0 / (G * DT * DT) - 1.0).abs() < 1e-12);
}

/// Two balls head on without gravity: momentum is conserved to the last bit by `pairwise`, not by `literal`.
#[test]
fn head_on_collision_conserves_momentum() {
    let change = |collision: Collision| {
        let places = vec![above_floor(2.0), above_floor(9.0)];
        let mut plan = at(plan(2, LatticeMode::Extended), places, vec![[0.0, 0.0, 0.5], [0.0, 0.0, -0.2]]);
        plan.gravity = [0.0; 3];
        plan.lattice.collision = collision;
        plan.lattice.rebound_scatter = false;
        // The lower ball alone sees the upper one when that is slow; let it run away so that one-sidedness shows.
        if let Some(Start::At { velocity, .. }) = plan.particles.get_mut("balls").map(|b| &mut b.start) {
            velocity[1] = [0.0, 0.0, 0.2];
        }
        let mut run = Run::new(&plan);
        let before = run.engine.damper().momentum();
        let mut met = false;
        for _ in 0..1350 {
            run.advance(1).expect("nothing can go wrong");
            met |= run.engine.damper().tally.collision != 0 || run.engine.damper().tally.rule.k != 0;
        }
        assert!(met, "the balls never met");
        let after = run.engine.damper().momentum();
        let v: Vec<f64> = (0..2).map(|i| 0.5 * run.engine.damper().velocity(i).k as f64).collect();
        (after.h - before.h, after.k - before.k, (v[1] - v[0]) * run.engine.damper().scale.speed)
    };
    let (h, k, separation) = change(Collision::Pairwise);
    assert_eq!((h, k), (0, 0));
    assert!((separation - 0.75 * 0.3).abs() < 1e-5, "restitution: {separation}");
    let (_, k, _) = change(Collision::Literal);
    assert_ne!(k, 0, "the gate must notice one-sided collisions");
}

/// an amplitude of 4 cells and a period of 1667 steps.
#[test]
fn box_level_changes_at_the_steps_of_theory() {
    let mut changes = Vec::new();
    let plan = shaken(plan(1, LatticeMode::Literal), 4.0 * CELL, 1.0 / (1667.0 * DT));
    let mut run = Run::new(&plan);
    let mut level = 0;
    for step in 1..=416 {
        run.advance(1).expect("there is room");
        if run.engine.damper().place.level != level {
            level = run.engine.damper().place.level;
            changes.push(step);
        }
    }
    // The first whole step at or after 33.3, 102.0, 179.1 and 282.7.
    assert_eq!(changes, [34, 102, 180, 283]);
    assert_ne!(changes, [34, 103, 180, 283], "the gate must notice one step too many");
}

/// The outline and the balls of a frame are where the automaton has them.
#[test]
fn frame_shows_the_box_and_the_balls() {
    let plan = shaken(plan(20, LatticeMode::Extended), 4.0 * CELL, 6.0);
    let mut run = Run::new(&plan);
    run.advance(300).expect("there is room");
    let frame = run.engine.frame(&run.hosts);
    let tsubu_frame::Values::Vector(outline) =
        &frame.column(tsubu_frame::Kind::Surface, "position").expect("drawn").values
    else {
        panic!("the outline is made of vectors")
    };
    let level = run.engine.damper().place.level as f64;
    assert!((outline[0][2] - level * CELL).abs() < 1e-12 && outline.len() == 4);
    let tsubu_frame::Values::Vector(position) =
        &frame.column(tsubu_frame::Kind::Grain, "position").expect("there").values
    else {
        panic!("positions are vectors")
    };
    assert_eq!(position.len(), 20);
    for p in position {
        assert!(p[0].abs() < outline[1][0] && p[2] > outline[0][2] - CELL && p[2] < outline[2][2] + CELL, "{p:?}");
    }
}
