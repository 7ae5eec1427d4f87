//! DEM by its outcome.

pub mod bonded_bodies;
mod bonds;
mod books;
mod cells;
mod clump;
mod clump_traffic;
mod come_and_go;
pub mod everything;
mod flat_superellipsoids;
mod gates;
mod idle;
mod lever;
mod monostatic;
mod orientation;
mod pairs;
mod place;
mod plane;
pub mod polyhedron;
mod rest;
mod same_bits;
mod seams;
mod search;
pub mod shapes_at_walls;
mod shown;
mod start;
mod superellipsoid;

use tsubu::engine::{self, Engine};
use tsubu::ledger::Ledger;
use tsubu::methods;
use tsubu::partner::Hosts;
use tsubu::threads::alone;
use tsubu_frame::State;
use tsubu_scene::{Scene, TEMPLATES};

/// A template scene with some keys changed, at time 0.
pub fn open(template: &str, changes: &[&str]) -> (Box<dyn Engine>, Hosts, Ledger) {
    let text = TEMPLATES.iter().find(|t| t.name == template).unwrap().text;
    open_text(text, changes)
}

/// A scene text with some keys changed, at time 0.
pub fn open_text(text: &str, changes: &[&str]) -> (Box<dyn Engine>, Hosts, Ledger) {
    run_text(text, std::path::Path::new("."), changes)
}

/// The same for a scene that names files in a folder.
pub fn run_text(text: &str, folder: &std::path::Path, changes: &[&str]) -> (Box<dyn Engine>, Hosts, Ledger) {
    let changes: Vec<String> = changes.iter().map(|c| (*c).to_owned()).collect();
    let scene = Scene::parse("test", text, folder, &changes).unwrap_or_else(|c| panic!("{c}"));
    let hosts = Hosts::new(&scene.plan().hosts);
    let engine = methods::open(scene.plan(), &hosts).unwrap();
    let ledger = Ledger::open(engine::energies(&*engine, &hosts), engine.momentum());
    (engine, hosts, ledger)
}

/// Hash of all there is after two lots of steps on `threads` threads, and what `look` makes of the end. With `resume` a fresh
/// engine goes on from the checkpoint between the two.
pub fn hash<R: Send>(
    open: impl Fn() -> (Box<dyn Engine>, Hosts, Ledger) + Sync,
    steps: [u64; 2],
    threads: usize,
    resume: bool,
    look: impl Fn(&dyn Engine, &Hosts, &Ledger) -> R + Sync,
) -> (String, R) {
    let checkpoint = |engine: &dyn Engine, ledger: &Ledger| {
        let mut state = State::default();
        engine.save(&mut state);
        ledger.save(&mut state);
        state.into_owned()
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let (mut engine, mut hosts, mut ledger) = open();
        engine.advance(steps[0], &mut hosts, &mut ledger).unwrap();
        if resume {
            let mut state = checkpoint(&*engine, &ledger);
            (engine, hosts, _) = open();
            engine.load(&mut state).unwrap();
            ledger = Ledger::load(&state).unwrap();
        }
        // What keeps threads awake must not matter either.
        alone(|| engine.advance(steps[1], &mut hosts, &mut ledger)).unwrap();
        (checkpoint(&*engine, &ledger).hash(), look(&*engine, &hosts, &ledger))
    })
}

/// The same bits whoever computes a scene, and after a resume between two lots of steps; the same steps come in two ways to share them out. The books
/// close. Gives the number of contacts at the end.
pub fn same_for_all(open: impl Fn() -> (Box<dyn Engine>, Hosts, Ledger) + Sync, lots: [[u64; 2]; 2]) -> usize {
    let run = |steps, threads, resume| {
        let look = |engine: &dyn Engine, hosts: &Hosts, ledger: &_| (missing(engine, hosts, ledger), engine.contacts());
        hash(&open, steps, threads, resume, look)
    };
    let (alone, (residual, contacts)) = run(lots[0], 1, false);
    assert!(residual < 1e-3, "{residual}");
    for (steps, threads, resume) in [(lots[1], 2, false), (lots[0], 7, true)] {
        assert_eq!(alone, run(steps, threads, resume).0, "{steps:?}, {threads} threads, resumed: {resume}");
    }
    contacts
}

/// Energy residual over the energy turned over.
pub fn missing(engine: &dyn Engine, hosts: &Hosts, ledger: &Ledger) -> f64 {
    ledger.residual_relative(&engine::energies(engine, hosts)).abs()
}
