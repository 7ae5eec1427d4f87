//! Plans of Komatsuzaki 2003 for the automaton, written in code.

use std::collections::BTreeMap;
use tsubu::engine::{Engine, Fault};
use tsubu::lattice::engine::LatticeEngine;
use tsubu::ledger::Ledger;
use tsubu::partner::Hosts;
#[allow(clippy::wildcard_imports, reason = "a plan names nearly all of them")]
use tsubu_scene::plan::*;

/// Paper A's box and balls with g = 10 m/s^2 and e = 0.75: `count` balls settled on the floor of a still box.
pub fn plan(count: usize, mode: LatticeMode) -> Plan {
    let extended = mode == LatticeMode::Extended;
    let acrylic = Material {
        young_modulus: 0.5e9,
        poisson_ratio: 0.3,
        restitution: 0.75,
        friction: 0.5,
        rolling_friction: 0.0,
        twisting_friction: 0.0,
        surface_energy: 0.0,
        cohesion: 0.0,
        density: None,
    };
    let balls = Particles {
        material: "acrylic".into(),
        count,
        diameter: 6e-3,
        mass: 0.2e-3,
        shape: GrainShape::Sphere {},
        size: Size::Equal {},
        motion: GrainMotion::Free {},
        start: Start::Settled { time: 1.0 },
    };
    let casing = Wall {
        material: "acrylic".into(),
        shape: Shape::Box { width: 60e-3, height: 96e-3, depth: 6e-3, floor_centre: [0.0; 3] },
        host: None,
        motion: None,
        rotation: None,
        servo: None,
        body: None,
        until: None,
    };
    Plan {
        title: "damper".into(),
        method: Method::Lattice,
        dimension: 2,
        seed: 1,
        gravity: [0.0, 0.0, -10.0],
        duration: 1.0,
        speed_scale: None,
        materials: BTreeMap::from([("acrylic".into(), acrylic)]),
        material_pair: Vec::new(),
        particles: if count > 0 { BTreeMap::from([("balls".into(), balls)]) } else { BTreeMap::new() },
        walls: BTreeMap::from([("casing".into(), casing)]),
        periodic: Periodic::default(),
        removal: BTreeMap::new(),
        hosts: BTreeMap::new(),
        water: None,
        contact: Contact {
            normal: Normal::Hertz {},
            damping: Damping::Quarter {},
            attraction: false,
            tangential: Tangential::Coulomb { smoothing_speed: 1e-3 },
            rolling: Rolling::None {},
            twisting: Twisting::None {},
            cohesion: Cohesion::None {},
            film: Film::None {},
            rotation: false,
        },
        dem: Dem {
            orientation: false,
            time_step: None,
            steps_per_contact: 20.0,
            integrator: Integrator::VelocityVerlet,
            skin: 0.2,
            largest_overlap: 0.1,
            energy_tolerance: 1e-3,
        },
        lattice: Lattice {
            mode,
            time_step: 1e-4,
            oblique_gravity: ObliqueGravity::Projected,
            collision: if extended { Collision::Pairwise } else { Collision::Literal },
            rebound_scatter: true,
            reset_when_blocked: true,
            keep_remainder: true,
            resting_impulses: extended,
            resting_threshold: 2.0,
            arithmetic: Arithmetic::Fixed,
            head_room: 5,
        },
        response: None,
        sweep: None,
        watch: BTreeMap::new(),
        output: Output {
            history_interval: 0.1,
            frame_interval: None,
            checkpoint_interval: 60.0,
            xyz: false,
            lammps: false,
        },
        claim: Vec::new(),
    }
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
        structure: Structure::Oscillator { mass: 0.086, stiffness: 123.4, damping: 0.08 },
        direction: [0.0, 0.0, 1.0],
        base: Some(Signal::Sine { amplitude: base, frequency: ratio * natural, phase: 0.0 }),
        force: None,
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
        let ledger = Ledger::open(tsubu::engine::stocks(&engine, &hosts), engine.momentum());
        Self { engine, hosts, ledger }
    }

    pub fn advance(&mut self, steps: u64) -> Result<(), Fault> {
        self.engine.advance(steps, &mut self.hosts, &mut self.ledger)
    }

    /// Energy and momentum that the books cannot explain, over what was turned over.
    pub fn residuals(&self) -> (f64, f64) {
        let now = tsubu::engine::stocks(&self.engine, &self.hosts);
        let energy = self.ledger.residual_relative(&now);
        let left = self.ledger.momentum_residual(self.engine.momentum());
        let scale = self.ledger.gravity_impulse[2].abs() + self.engine.momentum().iter().map(|p| p.abs()).sum::<f64>();
        (energy.abs(), left.iter().map(|p| p.abs()).sum::<f64>() / scale.max(1e-300))
    }
}
