//! A scene in motion under bases that are moved from outside: engine, structures and books.

use crate::error::Error;
use tsubu::engine::{self, Engine};
use tsubu::ledger::{Account, Ledger};
use tsubu::methods;
use tsubu::partner::Hosts;
use tsubu::view::Wants;
use tsubu_frame::State;
use tsubu_scene::Scene;
use tsubu_scene::plan::{Plan, Signal, Start};

/// The motion of a base at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// Displacement from where it is drawn [m].
    pub displacement: f64,
    /// Velocity [m/s].
    pub velocity: f64,
    /// Acceleration [m/s^2].
    pub acceleration: f64,
}

impl Motion {
    /// Displacement [m] and velocity [m/s] after a time h [s] of constant acceleration: u + v h + a h^2 / 2, v + a h.
    pub fn after(&self, h: f64) -> (f64, f64) {
        let Self { displacement, velocity, acceleration } = *self;
        (displacement + h * (velocity + 0.5 * h * acceleration), velocity + h * acceleration)
    }
}

/// How far a communication point may be from the end of a step of the engine, over the length of such a step [-]: rounding of a tool that
/// adds up its steps. It is measured from time 0 at every point, so that it never adds up here.
const ROUNDING: f64 = 1e-3;

/// A scene in motion.
pub struct Moving {
    engine: Box<dyn Engine>,
    hosts: Hosts,
    ledger: Ledger,
    /// Force of the grains on each host now [N].
    force: Vec<f64>,
    /// Mean force of the grains on each host over the last communication step [N].
    mean_force: Vec<f64>,
    /// Share of the energy turned over that the books may leave unexplained [-].
    tolerance: f64,
}

/// What a scene in motion was at a moment.
#[derive(Clone)]
pub struct Moment {
    state: State<'static>,
    forces: [Vec<f64>; 2],
}

impl Moving {
    /// Opens a scene at time 0, with each base in a motion of its own.
    ///
    /// # Errors
    ///
    /// What the method of the scene refuses, and a bed that does not settle.
    pub fn open(scene: &Scene, bases: &[Motion]) -> Result<Self, Error> {
        Self::of_plan(&steered(scene.plan(), bases), scene)
    }

    /// Opens it as it was at a moment; `bases` are those that it began with.
    ///
    /// # Errors
    ///
    /// As [`Moving::open`].
    pub fn at(scene: &Scene, bases: &[Motion], moment: &Moment) -> Result<Self, Error> {
        let mut plan = steered(scene.plan(), bases);
        for group in plan.particles.values_mut() {
            // Where grains came to rest before time 0 is in the state.
            if let Start::Settled { time } = &mut group.start {
                *time = 0.0;
            }
        }
        let mut moving = Self::of_plan(&plan, scene)?;
        let missing = |error: tsubu_frame::state::MissingSection| Error::new(error.to_string());
        moving.engine.load(&mut moment.state.clone()).map_err(missing)?;
        moving.hosts.load(&moment.state).map_err(missing)?;
        moving.ledger = Ledger::load(&moment.state).map_err(missing)?;
        [moving.force, moving.mean_force] = moment.forces.clone();
        Ok(moving)
    }

    fn of_plan(plan: &Plan, scene: &Scene) -> Result<Self, Error> {
        let hosts = Hosts::new(&plan.hosts);
        let engine = methods::open(plan, &hosts).map_err(|error| Error::of_open(&error, scene))?;
        let ledger = Ledger::open(engine::energies(&*engine, &hosts), engine.momentum());
        let force = weights(&*engine, &hosts);
        let mean_force = force.clone();
        Ok(Self { engine, hosts, ledger, force, mean_force, tolerance: plan.dem.energy_tolerance })
    }

    /// What it is now.
    pub fn moment(&self) -> Moment {
        let mut state = State::default();
        self.engine.save(&mut state);
        self.hosts.save(&mut state);
        self.ledger.save(&mut state);
        Moment { state: state.into_owned(), forces: [self.force.clone(), self.mean_force.clone()] }
    }

    /// Its clock [s].
    pub fn time(&self) -> f64 {
        self.engine.time()
    }

    /// The engine's time step [s].
    pub fn time_step(&self) -> f64 {
        self.engine.time_step()
    }

    /// What its method has replaced by something near it, or doubts: key and reason.
    pub fn notes(&self) -> impl Iterator<Item = (&str, &str)> {
        self.engine.notes().iter().map(|note| (note.key.as_str(), note.text.as_str()))
    }

    /// Moves everything by so many steps of the engine, with bases that have a motion at their begin.
    ///
    /// # Errors
    ///
    /// What fails in a step; nothing can go on then.
    pub fn advance(&mut self, steps: u64, bases: &[Motion]) -> Result<(), Error> {
        let (now, dt) = (self.time(), self.time_step());
        let then = (self.engine.steps() + steps) as f64 * dt;
        for (host, motion) in self.hosts.list.iter_mut().zip(bases) {
            let (displacement, velocity) = motion.after(then - now);
            host.steer_base([now, then], displacement, velocity);
        }
        let mut impulse = vec![0.0; self.hosts.list.len()];
        for _ in 0..steps {
            let moved = self.engine.advance(1, &mut self.hosts, &mut self.ledger);
            moved.map_err(|fault| Error::of(&fault))?;
            for ((sum, force), host) in impulse.iter_mut().zip(&mut self.force).zip(&self.hosts.list) {
                // The trapezoidal rule, as in the books.
                *sum += 0.5 * (*force + host.grain_force());
                *force = host.grain_force();
            }
        }
        self.mean_force = impulse.iter().map(|sum| sum / steps as f64).collect();
        Ok(())
    }

    /// The number of the engine's steps in a communication step from `begin` to `end` [s].
    ///
    /// # Errors
    ///
    /// A begin that is not now, and a length that is no whole number of the engine's steps.
    pub fn steps(&self, begin: f64, end: f64) -> Result<u64, Error> {
        let (now, dt) = (self.time(), self.time_step());
        let off = (begin - now) / dt;
        if !begin.is_finite() || off.abs() > ROUNDING {
            return Err(Error::new(format!(
                "a communication step that begins at {begin} s after the start, where the grains are at {now} s"
            ))
            .hint("begin each step where the last one has ended"));
        }
        let steps = (end - now) / dt;
        if steps.round() < 1.0 || !steps.is_finite() || (steps - steps.round()).abs() > ROUNDING {
            let (length, near) = (end - begin, steps.round().max(1.0));
            return Err(Error::new(format!(
                "a communication step of {length} s is {steps:.6} of the engine's steps of {dt} s, and must be a whole number of them"
            ))
            .hint(format!("take {} s, or pack the scene again with `--step {length}`", near * dt)));
        }
        Ok(steps.round() as u64)
    }

    /// Displacement [m] and velocity [m/s] of a host, the force of the grains on it now and in the mean [N].
    pub fn host(&self, at: usize) -> [f64; 4] {
        let host = &self.hosts.list[at];
        [host.displacement(), host.velocity(), self.force[at], self.mean_force[at]]
    }

    /// What grains and structures hold now.
    pub fn energies(&self) -> tsubu::ledger::Energies {
        engine::energies(&*self.engine, &self.hosts)
    }

    /// Energy lost since time 0 [J].
    pub fn dissipated(&self) -> f64 {
        Account::ALL.into_iter().filter(|account| !account.is_work()).map(|account| self.ledger.flow(account)).sum()
    }

    /// Work of the bases since time 0 [J].
    pub fn base_work(&self) -> f64 {
        self.ledger.flow(Account::BaseWork)
    }

    /// What the books cannot explain, over the energy turned over [-].
    pub fn residual(&self) -> f64 {
        self.ledger.residual_relative(&self.energies())
    }

    /// Whether the residual is within what the scene tolerates.
    pub fn books_close(&self) -> bool {
        self.residual().abs() <= self.tolerance
    }

    /// What to say of a residual that is not.
    pub fn unexplained(&self) -> String {
        let (residual, tolerance) = (self.residual(), self.tolerance);
        format!(
            "the energy residual is {residual:.2e} of the energy turned over, more than `dem.energy-tolerance` = {tolerance:e}: shorten \
             `dem.time-step`"
        )
    }
}

/// What grains that lie on the walls of hosts do to them at time 0, before any step [N]; hosts hear it with the first.
fn weights(engine: &dyn Engine, hosts: &Hosts) -> Vec<f64> {
    let mut sums = vec![0.0; hosts.list.len()];
    for (wall, load) in engine.walls().iter().zip(engine.view(Wants::WALLS).walls.iter()) {
        if let Some((at, _)) = wall.host() {
            sums[at] += load.force.to_array().iter().zip(hosts.list[at].direction).map(|(f, d)| f * d).sum::<f64>();
        }
    }
    sums
}

/// The plan with bases that begin in the given motion; what the scene says of them counts for nothing.
fn steered(plan: &Plan, bases: &[Motion]) -> Plan {
    let mut plan = plan.clone();
    for (host, motion) in plan.hosts.values_mut().zip(bases) {
        if host.base.is_some() {
            let (value, rate) = (motion.displacement, motion.velocity);
            host.base = Some(Signal::Table { time: vec![0.0, 1.0], value: vec![value, value + rate] });
        }
    }
    plan
}
