//! The damper automaton as an engine, coupled to the structure that carries its box.
//!
//! In a step of length dt the balls take the impulse P from the box, which moves at the speed that it has at the beginning
//! of the step (a prescribed motion: at its end). The structure is then moved by Runge-Kutta over the same step under the
//! constant force -P/dt (A11).

use super::build::{Built, build};
use super::damper::{Damper, box_motion::OutOfRoom};
use super::direction::{Direction, Vector};
use super::grid::COLUMN_SPACING;
use super::start::Geometry;
use crate::engine::{Engine, Fault, Note, Refusal};
use crate::ledger::{Account, Energies, Ledger};
use crate::partner::Hosts;
use crate::view::{Columns, View, Wants};
use crate::wall::Mover;
use glam::DVec3;
use tsubu_frame::frame::Kind;
use tsubu_frame::state::MissingSection;
use tsubu_frame::{Frame, State};
use tsubu_scene::plan::Plan;

/// The automaton of a plan.
#[derive(Clone, Debug)]
pub struct LatticeEngine {
    damper: Damper,
    notes: Vec<Note>,
    mover: Mover,
    geometry: Geometry,
    dt: f64,
    mass: f64,
    radius: f64,
    /// Number of every ball's group.
    groups: Vec<u32>,
    /// Momentum of one unit of h and of k [N.s].
    momentum_unit: [f64; 2],
    /// m u^2 / 2 [J].
    energy_unit: f64,
    /// Impulse of gravity in a step [N.s], not positive.
    weight_impulse: f64,
    /// Force on every host [N]; zero but for the one that carries the box.
    forces: Vec<f64>,
}

impl LatticeEngine {
    /// Builds the automaton of a plan at time 0, or says all that it cannot do.
    pub fn new(plan: &Plan, hosts: &Hosts) -> Result<Self, Refusal> {
        let Built { mut damper, notes, wall, dt, mass, radius, geometry } = build(plan)?;
        let groups = plan.particles.values().enumerate();
        let groups = groups.flat_map(|(k, group)| std::iter::repeat_n(k as u32, group.count)).collect();
        let mover = Mover::new(&plan.walls[&wall], hosts, DVec3::ZERO);
        let unit = mass * damper.scale.speed;
        // A box that does not begin at its drawn place takes its balls along.
        let level = (mover.displacement(0.0, hosts).0.z / geometry.spacing).round() as i64;
        let place = &mut damper.place;
        place.level = level.clamp(-(place.head as i64), place.head as i64);
        for cell in &mut damper.cell {
            *cell = cell.wrapping_add_signed(place.level as isize);
        }
        damper.rebuild();
        Ok(Self {
            weight_impulse: -(damper.balls() as f64) * unit * damper.scale.gravity as f64,
            damper,
            notes,
            mover,
            geometry,
            dt,
            mass,
            radius,
            groups,
            momentum_unit: [unit * COLUMN_SPACING, 0.5 * unit],
            energy_unit: 0.5 * unit * unit / if mass > 0.0 { mass } else { 1.0 },
            forces: vec![0.0; hosts.list.len()],
        })
    }

    /// The automaton itself, in whole numbers.
    pub fn damper(&self) -> &Damper {
        &self.damper
    }

    /// Lets the automaton look at every ball every step instead of only where something can have changed: slow, the same
    /// bits; for tests.
    pub fn look_everywhere(&mut self, everywhere: bool) {
        self.damper.look_everywhere = everywhere;
    }

    fn momentum_of(&self, vector: Vector) -> [f64; 3] {
        [self.momentum_unit[0] * vector.h as f64, 0.0, self.momentum_unit[1] * vector.k as f64]
    }

    fn fault(&self, what: OutOfRoom) -> Fault {
        Fault::Lattice { step: self.steps(), time: self.time(), text: what.to_string(), hint: Some(what.hint()) }
    }

    fn step(&mut self, hosts: &mut Hosts, ledger: &mut Ledger) -> Result<(), Fault> {
        let time = self.damper.step as f64 * self.dt;
        let (place, velocity) = self.mover.displacement(time + self.dt, hosts);
        let scale = &self.damper.scale;
        let wall = scale.cut(scale.speed_units(velocity.z));
        if wall.abs() > scale.cell / 4 {
            return Err(self.fault(OutOfRoom::Speed));
        }
        let wall_speed = wall as f64 * scale.speed;
        let level = (place.z / self.geometry.spacing).round() as i64;
        self.damper.advance(wall, level).map_err(|e| self.fault(e))?;
        debug_assert_eq!(self.damper.fault(), None, "step {}", self.damper.step);
        let impulse = self.post(wall_speed, ledger);
        self.push_hosts(time, impulse, wall_speed, hosts, ledger);
        Ok(())
    }

    /// Posts what the automaton did; returns the impulse of the box on the balls along z [N.s].
    fn post(&self, wall_speed: f64, ledger: &mut Ledger) -> f64 {
        let tally = &self.damper.tally;
        ledger.gravity_impulse[2] += self.weight_impulse;
        let [x, _, z] = self.momentum_of(tally.wall);
        ledger.wall_impulse[0] += x;
        ledger.wall_impulse[2] += z;
        let [rule_x, _, rule_z] = self.momentum_of(tally.rule);
        ledger.rule_impulse[0] += rule_x;
        ledger.rule_impulse[2] += rule_z;
        ledger.post(Account::Collision, self.energy_unit * tally.collision as f64);
        ledger.post(Account::LatticeRules, self.energy_unit * tally.rules as f64);
        if matches!(self.mover, Mover::Motion(..)) {
            ledger.post(Account::WallWork, z * wall_speed);
        }
        z
    }

    /// Every host moves by one step; the one that carries the box feels the balls.
    fn push_hosts(&mut self, time: f64, impulse: f64, wall_speed: f64, hosts: &mut Hosts, ledger: &mut Ledger) {
        let mut before = 0.0;
        if let Mover::Host { host, .. } = &self.mover {
            let [_, _, along] = hosts.list[*host].direction;
            before = along * hosts.list[*host].displacement();
            self.forces[*host] = -impulse / self.dt * along;
        }
        for (host, force) in hosts.list.iter_mut().zip(&self.forces) {
            host.runge_kutta(time, self.dt, *force, ledger);
        }
        if let Mover::Host { host, .. } = &self.mover {
            // The balls were pushed at the speed the box had before it felt them.
            let moved = hosts.list[*host].direction[2] * hosts.list[*host].displacement() - before;
            ledger.post(Account::HeavyBox, impulse * (moved / self.dt - wall_speed));
        }
    }

    /// Position of a ball [m].
    fn position(&self, i: usize) -> [f64; 3] {
        let (column, row) = self.damper.seat(i);
        let [x, y, z] = self.geometry.centre(column, row);
        let offset = self.damper.offset(i);
        let unit = self.damper.scale.distance;
        [x + unit * COLUMN_SPACING * offset.h as f64, y, z + 0.5 * unit * offset.k as f64]
    }

    fn velocity(&self, i: usize) -> [f64; 3] {
        let velocity = self.damper.velocity(i);
        let unit = self.damper.scale.speed;
        [unit * COLUMN_SPACING * velocity.h as f64, 0.0, 0.5 * unit * velocity.k as f64]
    }

    /// Corners of the box at the level where the automaton has it [m].
    fn outline(&self) -> Vec<[f64; 3]> {
        let Geometry { spacing, floor_centre: [x, y, z], place, .. } = self.geometry;
        let half = 0.5 * place.columns as f64 * COLUMN_SPACING * spacing;
        let low = z + self.damper.place.level as f64 * spacing;
        // Odd columns stand half a cell higher, and their highest balls too.
        let high = low + (place.rows as f64 + 0.5) * spacing;
        vec![[x - half, y, low], [x + half, y, low], [x + half, y, high], [x - half, y, high]]
    }
}

impl Engine for LatticeEngine {
    fn notes(&self) -> &[Note] {
        &self.notes
    }

    fn time_step(&self) -> f64 {
        self.dt
    }

    fn step_key(&self) -> &'static str {
        "lattice.time-step"
    }

    fn steps(&self) -> u64 {
        self.damper.step
    }

    fn grains(&self) -> usize {
        self.damper.balls()
    }

    fn advance(&mut self, steps: u64, hosts: &mut Hosts, ledger: &mut Ledger) -> Result<(), Fault> {
        for _ in 0..steps {
            self.step(hosts, ledger)?;
        }
        Ok(())
    }

    fn grain_energies(&self) -> Energies {
        // Potential energy counts from z = 0, the automaton's from the centre of the lowest cell.
        let lowest = self.geometry.floor_centre[2] + 0.5 * self.geometry.spacing;
        Energies {
            kinetic: self.energy_unit * self.damper.kinetic() as f64,
            potential: self.energy_unit * self.damper.potential() as f64 - self.weight_impulse / self.dt * lowest,
            ..Energies::default()
        }
    }

    fn momentum(&self) -> [f64; 3] {
        self.momentum_of(self.damper.momentum())
    }

    fn centre_of_mass(&self) -> [f64; 3] {
        let balls = self.grains();
        let sum: DVec3 = (0..balls).map(|i| DVec3::from_array(self.position(i))).sum();
        (sum / balls.max(1) as f64).to_array()
    }

    fn contacts(&self) -> usize {
        self.damper.contacts()
    }

    fn grain_frame(&self, _hosts: &Hosts) -> Frame {
        let n = self.grains();
        let mut frame = Frame { time: self.time(), step: self.steps(), columns: Vec::new() };
        frame.integer(Kind::Grain, "id", "-", (0..n as i64).collect());
        frame.vector(Kind::Grain, "position", "m", (0..n).map(|i| self.position(i)).collect());
        frame.vector(Kind::Grain, "velocity", "m/s", (0..n).map(|i| self.velocity(i)).collect());
        frame.scalar(Kind::Grain, "radius", "m", vec![self.radius; n]);
        frame.scalar(Kind::Grain, "mass", "kg", vec![self.mass; n]);
        let outline = self.outline();
        frame.integer(Kind::Surface, "outline", "-", vec![0; outline.len()]);
        frame.vector(Kind::Surface, "position", "m", outline);
        frame
    }

    fn offers(&self) -> Wants {
        Wants::GRAINS
    }

    fn view(&self, _wants: Wants) -> View<'_> {
        let n = self.grains();
        let vectors = |of: &dyn Fn(usize) -> [f64; 3]| (0..n).map(|i| DVec3::from_array(of(i))).collect::<Vec<_>>();
        let grains = Columns {
            position: vectors(&|i| self.position(i)).into(),
            unwrap_offset: vec![DVec3::ZERO; n].into(),
            velocity: vectors(&|i| self.velocity(i)).into(),
            spin: vec![DVec3::ZERO; n].into(),
            radius: vec![self.radius; n].into(),
            mass: vec![self.mass; n].into(),
            inverse_mass: vec![1.0 / self.mass; n].into(),
            group: self.groups.as_slice().into(),
            id: (0..n as u32).collect(),
        };
        View { time: self.time(), periodic: [None; 3], grains, ..View::default() }
    }

    fn save<'a>(&'a self, state: &mut State<'a>) {
        let d = &self.damper;
        let whole = |values: &[i64]| values.to_vec();
        state.put_integer("lattice.cell", d.cell.iter().map(|&c| c as i64).collect::<Vec<_>>());
        state.put_integer("lattice.direction", d.direction.iter().map(|&d| d as i64).collect::<Vec<_>>());
        state.put_integer("lattice.speed", whole(&d.speed));
        state.put_integer("lattice.stored", whole(&d.stored));
        state.put_integer("lattice.resting", d.resting.iter().map(|&r| i64::from(r)).collect::<Vec<_>>());
        state.put_integer("lattice.box", vec![d.place.level, d.rest.speed, d.rest.risen, d.step as i64]);
    }

    fn load(&mut self, state: &mut State) -> Result<(), MissingSection> {
        let n = self.grains();
        let column = |name: &str| -> Result<&[i64], MissingSection> {
            let values = state.integer(name)?;
            let wanted = if name == "lattice.box" { 4 } else { n };
            if values.len() != wanted {
                return Err(MissingSection { name: name.to_owned(), kind: "integer" });
            }
            Ok(values)
        };
        let cells = self.damper.grid.columns() * self.damper.grid.rows();
        let wrong = || MissingSection { name: "lattice.cell".to_owned(), kind: "integer" };
        let mut cell = Vec::with_capacity(n);
        for &c in column("lattice.cell")? {
            cell.push(usize::try_from(c).ok().filter(|&c| c < cells).ok_or_else(wrong)?);
        }
        let direction = column("lattice.direction")?.iter().map(|&d| Direction::from_index(d as usize)).collect();
        let (speed, stored) = (column("lattice.speed")?.to_vec(), column("lattice.stored")?.to_vec());
        let resting = column("lattice.resting")?.iter().map(|&r| r != 0).collect();
        let numbers = column("lattice.box")?;
        let d = &mut self.damper;
        if numbers[0].unsigned_abs() as usize > d.place.head {
            return Err(MissingSection { name: "lattice.box".to_owned(), kind: "integer" });
        }
        (d.cell, d.direction, d.speed, d.stored, d.resting) = (cell, direction, speed, stored, resting);
        (d.place.level, d.rest.speed, d.rest.risen) = (numbers[0], numbers[1], numbers[2]);
        d.step = numbers[3] as u64;
        let section = |name: &str| MissingSection { name: name.to_owned(), kind: "integer" };
        if !d.cell.iter().all(|&cell| d.fits(cell)) {
            return Err(section("lattice.cell"));
        }
        d.rebuild();
        d.within_reach().map_err(|_| section("lattice.speed"))?;
        if d.fault().is_some() { Err(section("lattice.cell")) } else { Ok(()) }
    }
}
