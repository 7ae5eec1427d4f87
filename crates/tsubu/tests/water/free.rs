//! Streams whose surface finds its level.

use super::coupled::{FLUME, stream};
use crate::dem::open_text;
use std::f64::consts::PI;
use tsubu::engine;
use tsubu::view::Wants;

/// The sand begins above the water.
const CHANGES: [&str; 2] = [
    "water.flow.coupled={bottom=0,top='15 mm',lid='free'}",
    "particles.sand.start.rows.region={low=[0,'16 mm'],high=['48 mm','30 mm']}",
];

/// Volume of the spheres below a height over the plan area of the flume [m].
fn sunk(engine: &dyn engine::Engine, level: f64) -> f64 {
    let view = engine.view(Wants::GRAINS);
    let part = |z: f64, r: f64| {
        let deep = (level - z + r).clamp(0.0, 2.0 * r);
        PI * deep * deep * (r - deep / 3.0)
    };
    let all = view.grains.position.iter().zip(view.grains.radius.iter());
    all.map(|(p, r)| part(p.z, *r)).sum::<f64>() / (48e-3 * 2e-3)
}

/// Grains that fall into a stream of 15 mm raise its surface by their volume over the plan area, to round-off. The momentum of the
/// stream closes to 1e-12, energy to 1e-3. Below a lid the surface stays.
#[test]
fn grains_that_fall_in_raise_the_surface() {
    let (mut engine, mut hosts, mut ledger) = open_text(FLUME, &CHANGES);
    let begin = stream(&*engine);
    assert!((begin.layers.top() - 15e-3).abs() < 1e-15);
    let before = sunk(&*engine, 15e-3);
    engine.advance(4000, &mut hosts, &mut ledger).unwrap();
    let now = stream(&*engine);
    let level = now.layers.top();
    let rise = sunk(&*engine, level) - before;
    assert!(rise > 1.5e-3 && (level - 15e-3 - rise).abs() < 1e-12, "{level} {rise}");
    assert!((now.layers.volume() / begin.layers.volume() - 1.0).abs() < 1e-12);
    assert!((engine.view(Wants::GRAINS).water.unwrap().surface() - level).abs() < 1e-15);

    let [drive, bottom, grains] = now.impulses;
    let missing = now.momentum() - begin.momentum() - drive - bottom + grains;
    assert!(missing.abs() < 1e-12 * now.momentum(), "{missing:e}");
    assert!(grains > 1e-3 * now.momentum());
    let missing = ledger.momentum_residual(engine.momentum());
    assert!(missing.iter().all(|missing| missing.abs() < 1e-12 * now.momentum()), "{missing:?}");
    let missing = ledger.residual_relative(&engine::energies(&*engine, &hosts)).abs();
    assert!(missing < 1e-3, "{missing:e}");

    let lid = CHANGES.map(|change| change.replace("free", "rigid"));
    let (mut engine, mut hosts, mut ledger) = open_text(FLUME, &lid.each_ref().map(String::as_str));
    engine.advance(4000, &mut hosts, &mut ledger).unwrap();
    assert!((stream(&*engine).layers.top() - 15e-3).abs() < 1e-15);
}

/// What grains pick up as added mass on their way through the surface, the stream loses: where all grains are free the impulse that it
/// gave is in every step the one that they had from the water, and energy closes to 1e-3. A row that is held has its part of it,
/// and would be refused.
#[test]
fn what_grains_pick_up_the_stream_loses() {
    let missing = |text: &str| {
        let (mut engine, mut hosts, mut ledger) = open_text(text, &CHANGES);
        let (mut most, mut before) = (0.0f64, 0.0);
        for _ in 0..2000 {
            engine.advance(1, &mut hosts, &mut ledger).unwrap();
            let missing = stream(&*engine).impulses[2] - ledger.water_impulse[0];
            most = most.max((missing - before).abs());
            before = missing;
        }
        let books = ledger.residual_relative(&engine::energies(&*engine, &hosts)).abs();
        (most / stream(&*engine).momentum(), books)
    };
    let (most, books) = missing(&FLUME.replace("motion.frozen = {}\n", ""));
    assert!(most < 1e-12 && books < 1e-3, "{most:e} {books:e}");
    assert!(missing(FLUME).0 > 1e-6);
}
