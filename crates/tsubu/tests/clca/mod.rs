//! Grains made of lattice points: invariants, the same bits, pushing, and what is refused.

mod books;
mod refusal;

use std::path::Path;
use tsubu::clca::bed::NOWHERE;
use tsubu::clca::engine::ClCaEngine;
use tsubu::engine::{self, Engine};
use tsubu::ledger::Ledger;
use tsubu::partner::Hosts;
use tsubu_frame::State;
use tsubu_scene::Scene;

/// A box with hexagons of two sizes and some rods.
pub const BOX: &str = r#"
title = "a box of hexagons and rods"
method = "cl-ca"
duration = "2 s"
[materials.m]
density = "2700 kg/m^3"
young-modulus = "1 MPa"
[particles.large]
material = "m"
count = 12
diameter = "4.6 mm"
start.random.region = { low = [0, 0], high = ["40 mm", "80 mm"] }
[particles.rods]
material = "m"
count = 8
diameter = "2.1 mm"
start.random.region = { low = [0, 0], high = ["40 mm", "80 mm"] }
[particles.small]
material = "m"
count = 40
diameter = "2.8 mm"
start.random.region = { low = [0, 0], high = ["40 mm", "80 mm"] }
[walls.box]
material = "m"
shape.box = { width = "40 mm", height = "80 mm", depth = "5 mm", floor-centre = ["20 mm", 0] }
[cl-ca]
spacing = "1 mm"
shapes.rods.points.at = [[0, 0], [0, 2], [0, 4], [0, 6]]
"#;

/// A run of CL-CA.
pub struct Run {
    pub engine: ClCaEngine,
    pub hosts: Hosts,
    pub ledger: Ledger,
}

impl Run {
    pub fn new(text: &str, changes: &[String]) -> Self {
        let scene = Scene::parse("test", text, Path::new("."), changes).unwrap();
        let hosts = Hosts::default();
        let engine = ClCaEngine::new(scene.plan(), &hosts).unwrap();
        let ledger = Ledger::open(engine::energies(&engine, &hosts), engine.momentum());
        Self { engine, hosts, ledger }
    }

    pub fn advance(&mut self, steps: u64) {
        self.engine.advance(steps, &mut self.hosts, &mut self.ledger).unwrap();
    }

    pub fn state(&self) -> State<'_> {
        let mut state = State::default();
        self.engine.save(&mut state);
        self.ledger.save(&mut state);
        state
    }

    pub fn residual(&self) -> f64 {
        let momentum = self.ledger.momentum_residual(self.engine.momentum());
        let energy = self.ledger.residual_relative(&engine::energies(&self.engine, &self.hosts));
        energy.abs().max(momentum.iter().fold(0.0, |m, p| p.abs().max(m)))
    }

    /// Cells of all grains.
    pub fn cells(&self) -> Vec<u32> {
        let cells = self.engine.bed().grains.cell.clone();
        assert!(!cells.contains(&NOWHERE));
        cells
    }
}

/// Runs at every number of threads.
pub fn with_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(work)
}
