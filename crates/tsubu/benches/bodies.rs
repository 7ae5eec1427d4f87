//! Bodies a second, and their pieces, in a bed that has settled, on one thread: `cubes`, `clumps`, `ellipsoids` or `spheres` of `benches/race`.
//!
//! `cargo bench -p tsubu --bench bodies -- NAME [FOLDER] [STEPS]`
//!
//! The bed settles first, which takes minutes; with a folder its state is kept there, and taken from there the next time. Steps are timed in lots of `STEPS` by the time that the
//! thread has had, where the system tells it: others on the machine then count for little. The median of the lots is told, with the slowest and the fastest.

use std::path::Path;
use std::time::Instant;
use tsubu::engine::{self, Engine};
use tsubu::ledger::Ledger;
use tsubu::methods;
use tsubu::partner::Hosts;
use tsubu::threads::alone;
use tsubu_frame::State;
use tsubu_frame::checkpoint;
use tsubu_scene::Scene;
use tsubu_scene::plan::GrainShape;

const SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../benches/race");
/// Lots that are timed.
const LOTS: usize = 9;

fn main() {
    // Cargo adds `--bench`.
    let words: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let Some(name) = words.first() else {
        println!("say which: cubes, clumps, ellipsoids or spheres");
        return;
    };
    let folder = words.get(1).map(Path::new);
    let steps = words.get(2).map_or(500, |word| word.parse().unwrap_or_else(|e| panic!("{word}: {e}")));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap_or_else(|e| panic!("{e}"));
    pool.install(|| alone(|| bed(name, folder, steps)));
}

fn bed(name: &str, folder: Option<&Path>, steps: u64) {
    let scene = Scene::read(&Path::new(SCENES).join(format!("{name}.toml")), &[]).unwrap_or_else(|c| panic!("{c}"));
    let mut hosts = Hosts::new(&scene.plan().hosts);
    let mut engine = methods::open(scene.plan(), &hosts).unwrap_or_else(|e| panic!("{e}"));
    let begun = seconds();
    let kept = folder.and_then(|folder| checkpoint::read(&checkpoint::path(folder)).ok());
    if let Some((_, state)) = &kept {
        engine.load(&mut state.clone()).unwrap_or_else(|e| panic!("{e}"));
    }
    let mut ledger = Ledger::open(engine::energies(&*engine, &hosts), engine.momentum());
    if kept.is_none() {
        let settling = (scene.plan().duration / engine.time_step()).ceil() as u64;
        engine.advance(settling, &mut hosts, &mut ledger).unwrap_or_else(|e| panic!("{e}"));
        println!("settled in {settling} steps, {:.0} s", seconds() - begun);
        if let Some(folder) = folder {
            keep(&*engine, folder);
        }
    }
    let mut rates: Vec<f64> = (0..=LOTS)
        .map(|_| {
            let begun = seconds();
            engine.advance(steps, &mut hosts, &mut ledger).unwrap_or_else(|e| panic!("{e}"));
            engine.grains() as f64 * steps as f64 / (seconds() - begun) * 1e-6
        })
        .skip(1)
        .collect();
    rates.sort_by(f64::total_cmp);
    let kinetic = engine.grain_energies().kinetic;
    let (pieces, contacts) = (engine.grains(), engine.contacts());
    println!("{pieces} pieces of {name}, {contacts} contacts, kinetic energy {kinetic:.2e} J");
    println!("{:.3} million piece-steps a second ({:.3} to {:.3})", rates[LOTS / 2], rates[0], rates[LOTS - 1]);
    let each = scene.plan().particles.values().map(|group| match &group.shape {
        GrainShape::Clump { centre, .. } => centre.len(),
        _ => 1,
    });
    println!("{:.3} million body-steps a second", rates[LOTS / 2] / each.max().unwrap_or(1) as f64);
    let mut state = State::default();
    engine.save(&mut state);
    println!("state {}", state.hash());
}

fn keep(engine: &dyn Engine, folder: &Path) {
    let mut state = State::default();
    engine.save(&mut state);
    std::fs::create_dir_all(folder).unwrap_or_else(|e| panic!("{e}"));
    let header = checkpoint::Header {
        tsubu_version: String::new(),
        scene_hash: String::new(),
        step: engine.steps(),
        time: engine.time(),
    };
    checkpoint::write(folder, &state, &header).unwrap_or_else(|e| panic!("{e}"));
}

/// Time that this thread has had [s].
fn seconds() -> f64 {
    thread_local!(static BEGUN: Instant = Instant::now());
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let run = told.and_then(|told| told.split(' ').next()?.parse::<f64>().ok());
    run.map_or_else(|| BEGUN.with(Instant::elapsed).as_secs_f64(), |run| run * 1e-9)
}
