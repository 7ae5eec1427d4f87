//! A model whose grains are on sites as an engine: lengths, times, masses, gates, and the books.
//!
//! What gravity gives to grains that hop, and what walls and collisions take, is one row, `lattice rules`, and a rule impulse: the
//! books say how much the rules did, not why. It is found as what is left over, while every grain that comes or goes is posted.

mod contacts;
mod invariants;
mod sources;

use super::ground::Ground;
use super::start::GrainStream;
use super::{Model, Seat, section};
use crate::engine::{Engine, Fault, Note};
use crate::ledger::{Account, Energies, Ledger};
use crate::partner::Hosts;
use crate::view::{Columns, Contacts, View, Wants};
use crate::wall::Wall;
use glam::DVec3;
use tsubu_frame::frame::Kind;
use tsubu_frame::state::MissingSection;
use tsubu_frame::{Frame, State};
use tsubu_scene::plan::Removal;

/// The scene on its lattice.
#[derive(Clone, Debug)]
pub(super) struct Scene {
    pub ground: Ground,
    pub walls: Vec<Wall>,
    /// Which wall owns a site.
    pub owner: Vec<u16>,
    pub removal: Vec<Removal>,
    /// Mass of every grain [kg].
    pub mass: Vec<f64>,
    /// Diameter of every grain [m].
    pub diameter: Vec<f64>,
    /// Number of the group of every grain.
    pub group: Vec<u32>,
    /// Gravity as drawn [m/s^2].
    pub gravity: DVec3,
    /// Grains that come in later.
    pub streams: Vec<GrainStream>,
    /// Seed of the places where they do.
    pub seed: u64,
}

/// A model on the ground of a scene.
pub struct SiteEngine {
    model: Box<dyn Model>,
    scene: Scene,
    dt: f64,
    step_key: String,
    notes: Vec<Note>,
    /// Grains that are there.
    present: usize,
    /// Energy [J] and momentum [N.s] of all grains at time 0.
    opening: (f64, DVec3),
}

/// A grain in metres and seconds.
struct Body {
    grain: usize,
    position: DVec3,
    velocity: DVec3,
    /// What periodic ends have taken from the position [m].
    unwrap_offset: DVec3,
}

impl SiteEngine {
    pub(super) fn new(model: Box<dyn Model>, scene: Scene, dt: f64, step_key: String, notes: Vec<Note>) -> Self {
        let mut engine = Self { model, scene, dt, step_key, notes, present: 0, opening: (0.0, DVec3::ZERO) };
        engine.opening = engine.held();
        engine.present = engine.count();
        engine
    }

    fn count(&self) -> usize {
        let mut count = 0;
        self.model.seats(&mut |_| count += 1);
        count
    }

    fn bodies(&self) -> Vec<Body> {
        let mut bodies = Vec::new();
        self.model.seats(&mut |seat| bodies.push(self.body(&seat)));
        bodies
    }

    fn body(&self, &Seat { grain, site, offset, velocity, laps }: &Seat) -> Body {
        let (spacing, speed) = (self.scene.ground.spacing, self.scene.ground.spacing / self.dt);
        let [x, _, z] = self.scene.ground.ends().map(|ends| ends.map_or(0.0, |[low, high]| high - low));
        let position = self.scene.ground.point(site) + spacing * DVec3::new(offset[0], 0.0, offset[1]);
        let velocity = speed * DVec3::new(velocity[0], 0.0, velocity[1]);
        let unwrap_offset = DVec3::new(x * f64::from(laps[0]), 0.0, z * f64::from(laps[1]));
        Body { grain, position, velocity, unwrap_offset }
    }

    /// Energy [J] and momentum [N.s] of a grain.
    fn energy_and_momentum(&self, &Body { grain, position, velocity, unwrap_offset }: &Body) -> (f64, DVec3) {
        let mass = self.scene.mass[grain];
        let energy = mass * (0.5 * velocity.length_squared() - self.scene.gravity.dot(position + unwrap_offset));
        (energy, mass * velocity)
    }

    /// The same of all grains that are there.
    fn held(&self) -> (f64, DVec3) {
        let (mut energy, mut momentum) = (0.0, DVec3::ZERO);
        self.model.seats(&mut |seat| {
            let (e, p) = self.energy_and_momentum(&self.body(&seat));
            energy += e;
            momentum += p;
        });
        (energy, momentum)
    }

    /// Posts what a grain brings that comes (`sign` 1), or takes that goes (-1), in the step in which it does so.
    fn exchange(&mut self, sign: f64, seat: &Seat, ledger: &mut Ledger) {
        let (energy, momentum) = self.energy_and_momentum(&self.body(seat));
        ledger.post(Account::Exchange, sign * energy);
        for (impulse, p) in ledger.exchange_impulse.iter_mut().zip(momentum.to_array()) {
            *impulse += sign * p;
        }
    }

    /// What the rules have done since time 0 is what nothing else explains. It is found from the state of this moment alone: a sum
    /// over calls would depend on how steps are shared out among them.
    fn balance(&self, ledger: &mut Ledger) {
        let (energy, momentum) = self.held();
        ledger.set(Account::LatticeRules, self.opening.0 + ledger.flow(Account::Exchange) - energy);
        let made = momentum - self.opening.1 - DVec3::from_array(ledger.exchange_impulse);
        ledger.rule_impulse = made.to_array();
    }
}

impl Engine for SiteEngine {
    fn notes(&self) -> &[Note] {
        &self.notes
    }

    fn time_step(&self) -> f64 {
        self.dt
    }

    fn step_key(&self) -> &str {
        &self.step_key
    }

    fn steps(&self) -> u64 {
        self.model.step()
    }

    fn grains(&self) -> usize {
        self.present
    }

    fn places(&self) -> usize {
        self.scene.ground.len()
    }

    fn advance(&mut self, steps: u64, hosts: &mut Hosts, ledger: &mut Ledger) -> Result<(), Fault> {
        for _ in 0..steps {
            let time = self.time();
            self.open_gates(time);
            self.insert(time, ledger);
            let before = if cfg!(debug_assertions) { self.seated() } else { Vec::new() };
            self.model.advance().map_err(|text| Fault::Lattice { step: self.model.step(), time, text, hint: None })?;
            self.remove(ledger);
            debug_assert_eq!(self.fault(&before), None, "step {}", self.model.step());
            for host in &mut hosts.list {
                host.runge_kutta(time, self.dt, 0.0, ledger);
            }
        }
        self.balance(ledger);
        Ok(())
    }

    fn grain_energies(&self) -> Energies {
        let mut energies = Energies::default();
        for Body { grain, position, velocity, unwrap_offset } in self.bodies() {
            energies.kinetic += 0.5 * self.scene.mass[grain] * velocity.length_squared();
            energies.potential -= self.scene.mass[grain] * self.scene.gravity.dot(position + unwrap_offset);
        }
        energies
    }

    fn momentum(&self) -> [f64; 3] {
        self.held().1.to_array()
    }

    fn centre_of_mass(&self) -> [f64; 3] {
        let (mut mass, mut moment) = (0.0, DVec3::ZERO);
        for body in self.bodies() {
            mass += self.scene.mass[body.grain];
            moment += self.scene.mass[body.grain] * body.position;
        }
        if mass > 0.0 { (moment / mass).to_array() } else { [0.0; 3] }
    }

    fn contacts(&self) -> usize {
        self.model.contacts()
    }

    fn grain_frame(&self, _hosts: &Hosts) -> Frame {
        let mut frame = Frame { time: self.time(), step: self.steps(), columns: Vec::new() };
        let bodies = self.bodies();
        let real = |of: &dyn Fn(&Body) -> f64| bodies.iter().map(of).collect::<Vec<_>>();
        let whole = |of: &dyn Fn(&Body) -> i64| bodies.iter().map(of).collect::<Vec<_>>();
        let vectors = |of: &dyn Fn(&Body) -> DVec3| bodies.iter().map(|b| of(b).to_array()).collect::<Vec<_>>();
        frame.integer(Kind::Grain, "id", "-", whole(&|b| b.grain as i64));
        frame.vector(Kind::Grain, "position", "m", vectors(&|b| b.position));
        frame.vector(Kind::Grain, "velocity", "m/s", vectors(&|b| b.velocity));
        frame.scalar(Kind::Grain, "radius", "m", real(&|b| 0.5 * self.scene.diameter[b.grain]));
        frame.scalar(Kind::Grain, "mass", "kg", real(&|b| self.scene.mass[b.grain]));
        frame.integer(Kind::Grain, "group", "-", whole(&|b| i64::from(self.scene.group[b.grain])));
        let axes: Vec<[f64; 3]> =
            bodies.iter().filter_map(|b| self.model.axis(b.grain)).map(|[x, z]| [x, 0.0, z]).collect();
        if axes.len() == bodies.len() && !axes.is_empty() {
            frame.vector(Kind::Grain, "axis", "-", axes);
        }
        if self.model.offers().contacts == Contacts::Forces {
            let mut load = vec![[0.0; 3]; bodies.len()];
            for contact in self.forces(&bodies).0.iter().filter(|contact| contact.force.z > 0.0) {
                for (sum, part) in load[contact.first].iter_mut().zip(contact.force.to_array()) {
                    *sum += part;
                }
            }
            frame.vector(Kind::Grain, "force from below", "N", load);
        }
        self.draw_walls(&mut frame);
        frame
    }

    fn offers(&self) -> Wants {
        self.model.offers()
    }

    fn view(&self, wants: Wants) -> View<'_> {
        let bodies = self.bodies();
        let n = bodies.len();
        let real = |of: &dyn Fn(&Body) -> f64| bodies.iter().map(of).collect::<Vec<_>>();
        let vectors = |of: &dyn Fn(&Body) -> DVec3| bodies.iter().map(of).collect::<Vec<_>>();
        let grains = Columns {
            position: vectors(&|b| b.position).into(),
            unwrap_offset: vectors(&|b| b.unwrap_offset).into(),
            velocity: vectors(&|b| b.velocity).into(),
            spin: vec![DVec3::ZERO; n].into(),
            radius: real(&|b| 0.5 * self.scene.diameter[b.grain]).into(),
            mass: real(&|b| self.scene.mass[b.grain]).into(),
            inverse_mass: real(&|b| 1.0 / self.scene.mass[b.grain]).into(),
            group: bodies.iter().map(|b| self.scene.group[b.grain]).collect(),
            id: bodies.iter().map(|b| b.grain as u32).collect(),
        };
        let needs = wants.walls || wants.contacts > Contacts::Nothing;
        let (contacts, walls) = if needs { self.forces(&bodies) } else { (Vec::new(), Vec::new()) };
        View { time: self.time(), periodic: self.scene.ground.ends(), grains, contacts, walls, ..View::default() }
    }

    fn save<'a>(&'a self, state: &mut State<'a>) {
        self.model.save(state);
        if !self.scene.streams.is_empty() {
            state.put_integer("sites.placed", self.scene.streams.iter().map(|s| s.placed as i64).collect::<Vec<_>>());
        }
    }

    fn load(&mut self, state: &mut State) -> Result<(), MissingSection> {
        self.model.load(state)?;
        if !self.scene.streams.is_empty() {
            let placed = section(state, "sites.placed", self.scene.streams.len())?;
            for (stream, &placed) in self.scene.streams.iter_mut().zip(placed) {
                stream.placed = placed as usize;
            }
        }
        // The walls of the last step: those that vanish now do so in the next.
        let time = self.model.step().saturating_sub(1) as f64 * self.dt;
        self.open_gates(time);
        self.model.load(state)?;
        self.present = self.count();
        Ok(())
    }
}
