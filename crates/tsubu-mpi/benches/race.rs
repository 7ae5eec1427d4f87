//! Steps per second of a scene, steps alone: no files, no report.
//! `cargo bench --package tsubu-mpi --bench race -- SCENE WARM STEPS THREADS [KEY=VALUE]...`
//!
//! With the feature `mpi`, `mpirun -np 2` before it times two ranks.
//!
//! A scene with `start-from` begins at the checkpoint in that folder, from the folder of the scene.
//!
//! Prints one line of JSON: what was timed and, for a comparison of physics, what came out. `cargo xtask race` runs it
//! against other codes.

use std::path::Path;
use std::sync::Arc;
use std::time::Instant;
use tsubu::engine;
use tsubu::ledger::Ledger;
use tsubu::methods;
use tsubu::partner::Hosts;
use tsubu::ranks::Communicator;
use tsubu::threads::alone;
use tsubu_frame::{Frame, Kind, Values, checkpoint};
use tsubu_mpi::Ranks;
use tsubu_scene::Scene;
use tsubu_scene::plan::{GrainMotion, Plan};

fn main() {
    // Cargo adds `--bench`.
    let words: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let [scene, warm, steps, threads, changes @ ..] = words.as_slice() else {
        println!("race: SCENE WARM STEPS THREADS [KEY=VALUE]..., for example: race chute.toml 100 400 1 dem.skin=0.2");
        return;
    };
    let number = |text: &str| text.parse::<u64>().unwrap_or_else(|e| panic!("{text}: {e}"));
    let (warm, steps) = (number(warm), number(steps));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(number(threads) as usize).build();
    let ranks = Ranks::join().unwrap_or_else(|e| panic!("{e}; {}", tsubu_mpi::HOW_TO_BUILD));
    let ranks = ranks.as_ref().map(Ranks::communicator);
    let pool = pool.unwrap_or_else(|e| panic!("{e}"));
    pool.install(|| alone(|| race(Path::new(scene), changes, [warm, steps], ranks)));
}

fn race(path: &Path, changes: &[String], [warm, steps]: [u64; 2], ranks: Option<&Arc<dyn Communicator>>) {
    let scene = Scene::read(path, changes).unwrap_or_else(|c| panic!("{c}"));
    let mut hosts = Hosts::new(&scene.plan().hosts);
    let mut engine = methods::open_on_ranks(scene.plan(), &hosts, ranks.cloned()).unwrap_or_else(|e| panic!("{e}"));
    if let Some(folder) = &scene.plan().start_from {
        let (_, mut state) = checkpoint::read(&checkpoint::path(Path::new(folder))).unwrap_or_else(|e| panic!("{e}"));
        engine.load(&mut state).unwrap_or_else(|e| panic!("{e}"));
    }
    let mut ledger = Ledger::open(engine::energies(&*engine, &hosts), engine.momentum());
    let mut go = |steps: u64| {
        let begun = Instant::now();
        engine.advance(steps, &mut hosts, &mut ledger).unwrap_or_else(|e| panic!("{e}"));
        begun.elapsed().as_secs_f64()
    };
    go(warm);
    let seconds = go(steps);
    // Before the picture of the end, which a run without output does not take.
    let memory = peak_memory();
    let energies = engine::energies(&*engine, &hosts);
    let frame = engine.frame(&hosts);
    // The first rank has the frame, and tells.
    if ranks.is_some_and(|all| all.rank() > 0) {
        return;
    }
    let end = End::of(&frame, scene.plan());
    let result = serde_json::json!({
        "grains": engine.grains(),
        "threads": rayon::current_num_threads(),
        "ranks": ranks.map_or(1, |all| all.size()),
        "steps": steps,
        "seconds": seconds,
        "million particle-steps per second": engine.grains() as f64 * steps as f64 / seconds * 1e-6,
        "kinetic": energies.kinetic,
        "rotational": energies.rotational,
        "contacts": engine.contacts(),
        "contacts per grain": end.coordination,
        "highest grain": end.highest,
        "peak memory [kB]": memory,
        "energy residual": ledger.residual_relative(&energies),
    });
    println!("{result}");
}

/// What the grains look like at the end.
struct End {
    /// Grain contacts of a grain that is free to move, in the mean.
    coordination: f64,
    /// Height of the highest centre [m].
    highest: f64,
}

impl End {
    fn of(frame: &Frame, plan: &Plan) -> Self {
        let free: Vec<bool> = plan.particles.values().map(|p| matches!(p.motion, GrainMotion::Free {})).collect();
        let group = whole(frame, Kind::Grain, "group");
        let id = whole(frame, Kind::Grain, "id");
        let is_free = |grain: i64| id.binary_search(&grain).is_ok_and(|i| free[group[i] as usize]);
        let pairs = whole(frame, Kind::Contact, "first").iter().zip(whole(frame, Kind::Contact, "second"));
        // Walls have numbers below 0.
        let pairs = pairs.filter(|(_, second)| **second >= 0);
        let ends: usize = pairs.map(|(a, b)| usize::from(is_free(*a)) + usize::from(is_free(*b))).sum();
        let moved = id.iter().filter(|grain| is_free(**grain)).count();
        let highest = match frame.column(Kind::Grain, "position").map(|c| &c.values) {
            Some(Values::Vector(rows)) => rows.iter().map(|p| p[2]).fold(f64::NEG_INFINITY, f64::max),
            _ => f64::NAN,
        };
        Self { coordination: ends as f64 / moved as f64, highest }
    }
}

fn whole<'a>(frame: &'a Frame, kind: Kind, name: &str) -> &'a [i64] {
    match frame.column(kind, name).map(|column| &column.values) {
        Some(Values::Integer(rows)) => rows,
        _ => &[],
    }
}

/// The most memory this process has held [kB]; `None` where the system does not tell.
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix("kB")?.trim().parse().ok()
}
