//! Plans of Komatsuzaki 2003 for the automaton, written in code.

use std::path::Path;
use tsubu::engine::{Engine, Fault};
use tsubu::lattice::engine::LatticeEngine;
use tsubu::ledger::Ledger;
use tsubu::partner::Hosts;
use tsubu_scene::Scene;
#[allow(clippy::wildcard_imports, reason = "a plan names nearly all of them")]
use tsubu_scene::plan::*;

/// Paper A's box and balls with g = 10 m/s^2 and e = 0.75: `count` balls settled on the floor of a still box.
pub fn plan(count: usize, mode: LatticeMode) -> Plan {
    let mode = if mode == LatticeMode::Extended { "extended" } else { "literal" };
    let text = format!(
        r#"
        title = "damper"
        method = "lattice"
        gravity = 10
        duration = 1
        [materials.acrylic]
        young-modulus = 0.5e9
        restitution = 0.75
        [particles.balls]
        material = "acrylic"
        count = 1
        diameter = 6e-3
        mass = 0.2e-3
        start.settled = {{}}
        [walls.casing]
        material = "acrylic"
        shape.box = {{ width = 60e-3, height = 96e-3, depth = 6e-3 }}
        [lattice]
        mode = "{mode}"
        head-room = 5
        "#
    );
    let scene = Scene::parse("damper", &text, Path::new("."), &[]).expect("the text is right");
    let mut plan = scene.plan().clone();
    for balls in plan.particles.values_mut() {
        balls.count = count;
    }
    plan.particles.retain(|_, group| group.count > 0);
    plan
}

/// The box shaken by a sine of this amplitude [m] and frequency [Hz].
pub fn shaken(mut plan: Plan, amplitude: f64, frequency: f64) -> Plan {
    let signal = Signal::Sine { amplitude, frequency, phase: 0.0 };
    casing(&mut plan).motion = Some(Motion { direction: [0.0, 0.0, 1.0], signal });
    plan
}

/// The box on the leaf spring of Komatsuzaki 2003, its base shaken at f / f0 = `ratio` with amplitude `base` [m].
pub fn coupled(mut plan: Plan, base: f64, ratio: f64) -> Plan {
    let natural = (123.4_f64 / 0.086).sqrt() / std::f64::consts::TAU;
    let host = Host {
        structure: Structure::Oscillator { mass: 0.086, stiffness: 123.4, damping: 0.08, cubic_stiffness: 0.0 },
        direction: [0.0, 0.0, 1.0],
        interface: std::collections::BTreeMap::new(),
        at: None,
        copies: 1.0,
        base: Some(Signal::Sine { amplitude: base, frequency: ratio * natural, phase: 0.0 }),
        force: None,
        dwell: None,
        displacement: 0.0,
        velocity: 0.0,
    };
    plan.hosts.insert("spring".into(), host);
    casing(&mut plan).host = Some("spring".into());
    plan
}

/// Balls at these places [m] with these velocities [m/s].
pub fn at(mut plan: Plan, position: Vec<Vector>, velocity: Vec<Vector>) -> Plan {
    if let Some(balls) = plan.particles.get_mut("balls") {
        balls.count = position.len();
        balls.start = Start::At { position, velocity, spin: Vec::new() };
    }
    plan
}

pub fn casing(plan: &mut Plan) -> &mut Wall {
    plan.walls.get_mut("casing").expect("the plans here have a casing")
}

/// A run: engine, hosts and books.
pub struct Run {
    pub engine: LatticeEngine,
    pub hosts: Hosts,
    pub ledger: Ledger,
}

impl Run {
    pub fn new(plan: &Plan) -> Self {
        let hosts = Hosts::new(&plan.hosts);
        let engine = LatticeEngine::new(plan, &hosts).expect("the plan is good");
        let ledger = Ledger::open(tsubu::engine::energies(&engine, &hosts), engine.momentum());
        Self { engine, hosts, ledger }
    }

    pub fn advance(&mut self, steps: u64) -> Result<(), Fault> {
        self.engine.advance(steps, &mut self.hosts, &mut self.ledger)
    }

    /// Energy and momentum that the books cannot explain, over what was turned over.
    pub fn residuals(&self) -> (f64, f64) {
        let now = tsubu::engine::energies(&self.engine, &self.hosts);
        let energy = self.ledger.residual_relative(&now);
        let left = self.ledger.momentum_residual(self.engine.momentum());
        let scale = self.ledger.gravity_impulse[2].abs() + self.engine.momentum().iter().map(|p| p.abs()).sum::<f64>();
        (energy.abs(), left.iter().map(|p| p.abs()).sum::<f64>() / scale.max(1e-300))
    }
}
