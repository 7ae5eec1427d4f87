//! Seconds of computing per simulated period of the granular damper, by DEM and by the automaton in one run, against the
//! number of balls (Komatsuzaki 2003, figure 12). Same host, same base motion near resonance, same balls.
//!
//! `cargo bench -p tsubu --bench damper`; results are kept in `benches/results/`.
//!
//! What was tried for DEM, and what it gave (50 balls, law of the paper, 2e-5 s; ratios of one run to the other):
//!
//! - all pairs instead of a grid below 96 grains when the list is made: the list costs nothing that can be seen;
//! - chunk columns 264 long instead of 256, so that forty columns do not share two sets of the cache: 1.05;
//! - Mindlin with the dashpot ratio from the table and one square root less: 1.03;
//! - skin of 0.3 d instead of 0.1 d: lists last three times longer; further growth gives nothing.
//!
//! The profile of the extended law: 26 % Mindlin, 16 % geometry of the candidates, 13 % scatter, 11 % filling the chunk,
//! 5 % each for accelerations, integration and the test whether the list is stale. No single thing is left to remove; the
//! next step is wider vectors, picked at run time.

#![allow(missing_docs, reason = "criterion's macros make undocumented items")]

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use std::path::Path;
use std::time::Duration;
use tsubu::engine;
use tsubu::ledger::Ledger;
use tsubu::methods;
use tsubu::partner::Hosts;
use tsubu_scene::Scene;

const DEM: &str = include_str!("../../../studies/damper-2003/fig3-dem.toml");
const EXTENDED: &str = include_str!("../../../scenes/damper.toml");
const AUTOMATON: &str = include_str!("../../../studies/damper-2003/fig11-automaton.toml");

fn period(c: &mut Criterion) {
    let mut group = c.benchmark_group("damper period");
    group.measurement_time(Duration::from_secs(2)).warm_up_time(Duration::from_millis(300)).sample_size(15);
    let cases: [(&str, &str, &[&str]); 5] = [
        ("dem, law of the paper, 2e-5 s", DEM, &[]),
        ("dem, extended law, default step", EXTENDED, &[]),
        ("lattice, extended, 1e-4 s", AUTOMATON, &["lattice.mode=extended"]),
        ("lattice, extended, 2e-5 s", AUTOMATON, &["lattice.mode=extended", "lattice.time-step=20 us"]),
        ("lattice, literal, 1e-4 s", AUTOMATON, &["lattice.mode=literal"]),
    ];
    for (name, text, changes) in cases {
        for count in [10, 20, 30, 40, 50] {
            let mut changes: Vec<String> = changes.iter().map(|c| (*c).to_owned()).collect();
            changes.push(format!("particles.balls.count={count}"));
            let scene = Scene::parse("benchmark", text, Path::new("."), &changes).expect("the scene is right");
            let mut hosts = Hosts::new(&scene.plan().hosts);
            let mut engine = methods::open(scene.plan(), &hosts).expect("the method can run it");
            let mut ledger = Ledger::open(engine::energies(&*engine, &hosts), engine.momentum());
            let steps = (1.0 / 6.0 / engine.time_step()).round() as u64;
            engine.advance(10 * steps, &mut hosts, &mut ledger).expect("it runs");
            group.bench_function(BenchmarkId::new(name, count), |b| {
                b.iter(|| engine.advance(steps, &mut hosts, &mut ledger).expect("it runs"));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, period);
criterion_main!(benches);
