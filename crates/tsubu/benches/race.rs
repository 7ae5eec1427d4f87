//! Steps per second of a scene, steps alone: no files, no report. `cargo bench --bench race -- SCENE WARM STEPS THREADS`
//!
//! Prints one line of JSON: what was timed and, for a comparison of physics, what came out.

use std::path::Path;
use std::time::Instant;
use tsubu::engine;
use tsubu::ledger::Ledger;
use tsubu::partner::Hosts;
use tsubu_scene::Scene;

fn main() {
    // Cargo adds `--bench`.
    let words: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let [scene, warm, steps, threads] = words.as_slice() else {
        println!("race: SCENE WARM STEPS THREADS, for example: race benches/race/chute.toml 100 1000 1");
        return;
    };
    let number = |text: &str| text.parse::<u64>().unwrap_or_else(|e| panic!("{text}: {e}"));
    let (warm, steps) = (number(warm), number(steps));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(number(threads) as usize).build();
    pool.unwrap_or_else(|e| panic!("{e}")).install(|| race(Path::new(scene), warm, steps));
}

fn race(path: &Path, warm: u64, steps: u64) {
    let scene = Scene::read(path, &[]).unwrap_or_else(|c| panic!("{c}"));
    let mut hosts = Hosts::new(&scene.plan().hosts);
    let mut engine = engine::open(scene.plan(), &hosts).unwrap_or_else(|e| panic!("{e}"));
    let mut ledger = Ledger::open(engine::stocks(&*engine, &hosts), engine.momentum());
    let mut go = |steps: u64| {
        let begun = Instant::now();
        engine.advance(steps, &mut hosts, &mut ledger).unwrap_or_else(|e| panic!("{e}"));
        begun.elapsed().as_secs_f64()
    };
    go(warm);
    let seconds = go(steps);
    let stocks = engine::stocks(&*engine, &hosts);
    let result = serde_json::json!({
        "grains": engine.grains(),
        "threads": rayon::current_num_threads(),
        "steps": steps,
        "seconds": seconds,
        "million particle-steps per second": engine.grains() as f64 * steps as f64 / seconds * 1e-6,
        "kinetic": stocks.kinetic,
        "rotational": stocks.rotational,
        "contacts": engine.contacts(),
        "energy residual": ledger.residual_relative(&stocks),
    });
    println!("{result}");
}
