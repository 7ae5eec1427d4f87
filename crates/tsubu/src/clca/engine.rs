//! CL-CA as an engine: walls and gates follow the time, grains come, move and go, and the books are kept.
//!
//! There are no forces. What gravity gives to falling grains, and what walls do to pushed ones, is posted as one row,
//! `lattice rules`, and as rule impulse: the books say how much energy the rules took, not why.

use super::active::Active;
use super::bed::{Bed, GrainKind, Motion, NOWHERE};
use super::build::{Built, GrainStream, OFFERED, build, moves};
use super::order::{Past, Pull};
use super::passive::{Passive, Pusher};
use crate::engine::{Engine, Fault, Note, Refusal};
use crate::lattice::direction::{Direction, Vector};
use crate::lattice::stage::Stage;
use crate::ledger::{Account, Energies, Ledger};
use crate::partner::Hosts;
use crate::view::{Body, Columns, Contacts, View, Wants};
use crate::wall::Wall;
use glam::DVec3;
use tsubu_frame::frame::Kind as Of;
use tsubu_frame::state::MissingSection;
use tsubu_frame::{Frame, State};
use tsubu_scene::plan::{GrainMotion, GravitySwitch, Plan, Removal, Signal};

/// CL-CA of a plan.
#[derive(Clone, Debug)]
pub struct ClCaEngine {
    pub(super) bed: Bed,
    pub(super) stage: Stage,
    pub(super) walls: Vec<Wall>,
    notes: Vec<Note>,
    pub(super) dt: f64,
    /// Downward acceleration [m/s^2].
    pub(super) gravity: f64,
    switch: Option<GravitySwitch>,
    pub(super) rule: Rule,
    pub(super) streams: Vec<GrainStream>,
    pub(super) removal: Vec<Removal>,
    /// Whether the grains of each group are bodies with cells of their own, no discs.
    bodies: Vec<bool>,
    /// Groups that move as told: number, direction, displacement.
    pub(super) driven: Vec<(u32, DVec3, Signal)>,
    /// Where the driven grains were drawn.
    pub(super) drawn: Vec<u32>,
}

/// The rule by which grains move.
#[derive(Clone, Debug)]
pub(super) enum Rule {
    /// Grains move where there is room.
    Active(Active),
    /// The passive rule, the walls that push, and the last moves of driven grains.
    Passive(Box<Passive>, Vec<Pusher>, Vec<Vector>),
}

impl ClCaEngine {
    /// Builds the grains of a plan at time 0, or says all that CL-CA cannot do.
    pub fn new(plan: &Plan, hosts: &Hosts) -> Result<Self, Refusal> {
        let Built { bed, stage, walls, notes, dt, passive, streams } = build(plan, hosts)?;
        let driven = plan.particles.values().enumerate().filter_map(|(number, group)| match &group.motion {
            GrainMotion::Driven { direction, signal } => {
                Some((number as u32, DVec3::from_array(*direction), signal.clone()))
            }
            _ => None,
        });
        let rule = if passive {
            let pushers = walls.iter().enumerate().filter(|(_, wall)| moves(wall));
            let pushers = pushers.map(|(wall, _)| Pusher::of(wall)).collect();
            Rule::Passive(Box::new(Passive::new(&bed)), pushers, Vec::new())
        } else {
            let mut active = Active::default();
            active.turning = plan.cl_ca.turning;
            Rule::Active(active)
        };
        let mut engine = Self {
            drawn: bed.grains.cell.clone(),
            bed,
            stage,
            walls,
            notes,
            dt,
            gravity: -plan.gravity[2],
            switch: plan.cl_ca.gravity_switch,
            rule,
            streams,
            removal: plan.removal.values().cloned().collect(),
            bodies: plan.particles.values().map(|group| group.shape.is_clump()).collect(),
            driven: driven.collect(),
        };
        engine.place_movers(0);
        engine.paint(0.0);
        Ok(engine)
    }

    /// The grains on their lattice.
    pub fn bed(&self) -> &Bed {
        &self.bed
    }

    /// Lets the active rule look at every grain in every step instead of only at those that can have room: slow, the
    /// same bits; for tests.
    pub fn look_everywhere(&mut self, everywhere: bool) {
        if let Rule::Active(active) = &mut self.rule {
            active.everywhere = everywhere;
        }
    }

    fn step(&mut self, ledger: &mut Ledger) {
        let step = self.bed.step;
        let time = step as f64 * self.dt;
        if self.walls.iter().any(|wall| !moves(wall) && !wall.vanished() && wall.goes_by(time)) {
            self.paint(time);
        }
        let (kinetic, momentum) = (self.kinetic(), self.momentum());
        self.insert(time, ledger);
        self.place_movers(step + 1);
        let pull = self.pull(step);
        let before = if cfg!(debug_assertions) { self.bed.grains.cell.clone() } else { Vec::new() };
        match &mut self.rule {
            Rule::Active(active) => match pull {
                Some(pull) => _ = active.step(&mut self.bed, pull),
                None => self.bed.step += 1,
            },
            Rule::Passive(passive, pushers, driven) => {
                passive.step(&mut self.bed, pull, pushers, driven);
            }
        }
        debug_assert_eq!(self.bed.fault(matches!(self.rule, Rule::Active(_)), &before), None, "step {step}");
        let risen: f64 = self.of_kinds(|kind, motion| kind.mass * self.stage.step(motion.sum).z);
        ledger.post(Account::LatticeRules, kinetic - self.kinetic() - self.gravity * risen);
        let now = self.momentum();
        for (axis, impulse) in ledger.rule_impulse.iter_mut().enumerate() {
            *impulse += now[axis] - momentum[axis];
        }
        self.remove(ledger);
    }

    /// The way gravity pulls in the step after `step`.
    fn pull(&self, step: u64) -> Option<Pull> {
        (self.gravity > 0.0).then(|| match self.switch {
            Some(GravitySwitch { down, up }) if step % u64::from(down + up) < u64::from(up) => Pull::UP,
            _ => Pull::DOWN,
        })
    }

    fn of_kinds(&self, value: impl Fn(&GrainKind, &Motion) -> f64) -> f64 {
        self.bed.kinds.iter().zip(&self.bed.motion).map(|(kind, motion)| value(kind, motion)).sum()
    }

    /// Kinetic energy at the speed of the last step [J].
    pub(super) fn kinetic(&self) -> f64 {
        let speed = self.stage.spacing / self.dt;
        self.of_kinds(|kind, motion| 0.5 * kind.mass * motion.moving as f64 * speed * speed)
    }

    /// Reference point of a grain [m].
    pub(super) fn position(&self, grain: usize) -> DVec3 {
        self.stage.position(self.bed.vector(self.bed.grains.cell[grain] as usize))
    }

    /// The bodies among the grains that are there: where the middle of their cells is, and which way these lie longest.
    fn bodies_of(&self, present: &[usize]) -> Vec<Body> {
        let vector = |[x, z]: [f64; 2]| DVec3::new(x, 0.0, z);
        let bodies = present.iter().enumerate().filter(|(_, grain)| self.bodies[self.bed.kind(**grain).group as usize]);
        let body = |(index, &grain): (usize, &usize)| {
            let turn = usize::from(self.bed.grains.turn[grain]);
            let shape = (0..turn).fold(self.bed.kind(grain).shape.clone(), |shape, _| shape.turned());
            let centre = self.position(grain) + self.stage.spacing * vector(shape.cells().centroid());
            Body { grain: index, centre, long: vector(shape.cells().long()), short: DVec3::Y }
        };
        bodies.map(body).collect()
    }

    /// Velocity in the last step [m/s].
    fn velocity(&self, grain: usize) -> DVec3 {
        let last = match (&self.rule, self.bed.grains.last[grain]) {
            (_, Some(direction)) => direction.times(1),
            (Rule::Passive(_, _, driven), None) => driven.get(grain).copied().unwrap_or_default(),
            (Rule::Active(_), None) => Vector::default(),
        };
        self.stage.step(last) / self.dt
    }

    /// Radius of the disc of a grain's area [m].
    pub(super) fn radius(&self, grain: usize) -> f64 {
        0.5 * self.bed.kind(grain).shape.diameter() * self.stage.spacing
    }
}

impl Engine for ClCaEngine {
    fn notes(&self) -> &[Note] {
        &self.notes
    }

    fn time_step(&self) -> f64 {
        self.dt
    }

    fn step_key(&self) -> &'static str {
        "cl-ca.spacing"
    }

    fn steps(&self) -> u64 {
        self.bed.step
    }

    fn grains(&self) -> usize {
        self.bed.present().count()
    }

    fn places(&self) -> usize {
        self.bed.grid.columns() * self.bed.grid.rows()
    }

    fn advance(&mut self, steps: u64, hosts: &mut Hosts, ledger: &mut Ledger) -> Result<(), Fault> {
        for _ in 0..steps {
            let time = self.time();
            self.step(ledger);
            for host in &mut hosts.list {
                host.runge_kutta(time, self.dt, 0.0, ledger);
            }
        }
        Ok(())
    }

    fn grain_energies(&self) -> Energies {
        let free = self.bed.present().filter(|&grain| self.bed.kind(grain).free);
        let moment: f64 = free.map(|grain| self.bed.kind(grain).mass * self.position(grain).z).sum();
        Energies { kinetic: self.kinetic(), potential: self.gravity * moment, ..Energies::default() }
    }

    fn momentum(&self) -> [f64; 3] {
        let of = |axis: usize| self.of_kinds(|kind, motion| kind.mass * self.stage.step(motion.sum)[axis]);
        [of(0) / self.dt, 0.0, of(2) / self.dt]
    }

    fn centre_of_mass(&self) -> [f64; 3] {
        let free = || self.bed.present().filter(|&grain| self.bed.kind(grain).free);
        let sum: DVec3 = free().map(|grain| self.bed.kind(grain).mass * self.position(grain)).sum();
        let mass: f64 = free().map(|grain| self.bed.kind(grain).mass).sum();
        if mass > 0.0 { (sum / mass).to_array() } else { [0.0; 3] }
    }

    fn contacts(&self) -> usize {
        self.pairs().len()
    }

    fn grain_frame(&self, _hosts: &Hosts) -> Frame {
        let mut frame = Frame { time: self.time(), step: self.steps(), columns: Vec::new() };
        let mut present: Vec<usize> = self.bed.present().collect();
        present.sort_by_key(|&grain| self.bed.grains.id[grain]);
        let whole = |of: &dyn Fn(usize) -> i64| present.iter().map(|&grain| of(grain)).collect::<Vec<_>>();
        let real = |of: &dyn Fn(usize) -> f64| present.iter().map(|&grain| of(grain)).collect::<Vec<_>>();
        let vectors =
            |of: &dyn Fn(usize) -> DVec3| present.iter().map(|&grain| of(grain).to_array()).collect::<Vec<_>>();
        frame.integer(Of::Grain, "id", "-", whole(&|grain| i64::from(self.bed.grains.id[grain])));
        frame.vector(Of::Grain, "position", "m", vectors(&|grain| self.position(grain)));
        frame.vector(Of::Grain, "velocity", "m/s", vectors(&|grain| self.velocity(grain)));
        frame.scalar(Of::Grain, "radius", "m", real(&|grain| self.radius(grain)));
        frame.scalar(Of::Grain, "mass", "kg", real(&|grain| self.bed.kind(grain).mass));
        frame.integer(Of::Grain, "group", "-", whole(&|grain| i64::from(self.bed.kind(grain).group)));
        frame.integer(Of::Grain, "points", "-", whole(&|grain| self.bed.kind(grain).shape.points().len() as i64));
        self.draw_grains(&present, &mut frame);
        self.draw_walls(&mut frame);
        frame
    }

    fn offers(&self) -> Wants {
        OFFERED
    }

    fn view(&self, wants: Wants) -> View<'_> {
        let present: Vec<usize> = self.bed.present().collect();
        let n = present.len();
        let vectors = |of: &dyn Fn(usize) -> DVec3| present.iter().map(|&grain| of(grain)).collect::<Vec<_>>();
        let real = |of: &dyn Fn(usize) -> f64| present.iter().map(|&grain| of(grain)).collect::<Vec<_>>();
        let inverse = |grain: usize| if self.bed.kind(grain).free { 1.0 / self.bed.kind(grain).mass } else { 0.0 };
        let grains = Columns {
            position: vectors(&|grain| self.position(grain)).into(),
            unwrap_offset: vec![DVec3::ZERO; n].into(),
            velocity: vectors(&|grain| self.velocity(grain)).into(),
            spin: vec![DVec3::ZERO; n].into(),
            radius: real(&|grain| self.radius(grain)).into(),
            mass: real(&|grain| self.bed.kind(grain).mass).into(),
            inverse_mass: real(&inverse).into(),
            group: present.iter().map(|&grain| self.bed.kind(grain).group).collect(),
            id: present.iter().map(|&grain| self.bed.grains.id[grain]).collect(),
        };
        let contacts = if wants.contacts > Contacts::Nothing { self.contacts_of(&present) } else { Vec::new() };
        let bodies = if wants.bodies { self.bodies_of(&present) } else { Vec::new() };
        View { time: self.time(), periodic: [None; 3], grains, contacts, bodies, ..View::default() }
    }

    fn save<'a>(&'a self, state: &mut State<'a>) {
        let grains = &self.bed.grains;
        let n = self.bed.len();
        let whole = |of: &dyn Fn(usize) -> i64| (0..n).map(of).collect::<Vec<_>>();
        state.put_integer("cl-ca.id", whole(&|i| i64::from(grains.id[i])));
        state.put_integer("cl-ca.kind", whole(&|i| i64::from(grains.kind[i])));
        state.put_integer("cl-ca.cell", whole(&|i| i64::from(grains.cell[i])));
        state.put_integer("cl-ca.turn", whole(&|i| i64::from(grains.turn[i])));
        state.put_integer("cl-ca.last", whole(&|i| grains.last[i].map_or(-1, |d| d as i64)));
        state.put_integer("cl-ca.past", whole(&|i| grains.past[i].0 as i64));
        state.put_integer("cl-ca.placed", self.streams.iter().map(|s| s.placed as i64).collect::<Vec<_>>());
        state.put_integer("cl-ca.clock", vec![self.bed.step as i64, self.bed.moves as i64]);
    }

    fn load(&mut self, state: &mut State) -> Result<(), MissingSection> {
        let wrong = |name: &str| MissingSection { name: name.to_owned(), kind: "integer" };
        let id = state.integer("cl-ca.id")?;
        let column = |name: &str, fits: &dyn Fn(i64) -> bool| -> Result<Vec<i64>, MissingSection> {
            let values = state.integer(name)?;
            let right = values.len() == id.len() && values.iter().all(|&value| fits(value));
            if right { Ok(values.to_vec()) } else { Err(wrong(name)) }
        };
        let (kinds, cells) = (self.bed.kinds.len(), self.bed.grid.columns() * self.bed.grid.rows());
        let grains = &mut self.bed.grains;
        let kind = column("cl-ca.kind", &|kind| (0..kinds as i64).contains(&kind))?;
        let cell = column("cl-ca.cell", &|cell| (0..cells as i64).contains(&cell) || cell == i64::from(NOWHERE))?;
        let turn = column("cl-ca.turn", &|turn| (0..6).contains(&turn))?;
        let last = column("cl-ca.last", &|last| (-1..6).contains(&last))?;
        grains.past = column("cl-ca.past", &|_| true)?.into_iter().map(|past| Past(past as u64)).collect();
        grains.id = id.iter().map(|&id| id as u32).collect();
        grains.kind = kind.into_iter().map(|kind| kind as u16).collect();
        grains.cell = cell.into_iter().map(|cell| cell as u32).collect();
        grains.turn = turn.into_iter().map(|turn| turn as u8).collect();
        let direction = |last: i64| usize::try_from(last).ok().map(Direction::from_index);
        grains.last = last.into_iter().map(direction).collect();
        let placed = state.integer("cl-ca.placed")?;
        let clock = state.integer("cl-ca.clock")?;
        if placed.len() != self.streams.len() || clock.len() != 2 {
            return Err(wrong("cl-ca.clock"));
        }
        for (stream, &placed) in self.streams.iter_mut().zip(placed) {
            stream.placed = placed as usize;
        }
        (self.bed.step, self.bed.moves) = (clock[0] as u64, clock[1] as u64);
        self.bed.count_motion();
        if let Rule::Passive(_, pushers, _) = &mut self.rule {
            // What they cover is that of time 0, and would stay where a wall has not moved in the last step.
            for pusher in pushers {
                pusher.cells.clear();
            }
        }
        self.place_movers(self.bed.step);
        // The walls of the last step: those that vanish now do so in the next.
        self.paint(self.bed.step.saturating_sub(1) as f64 * self.dt);
        Ok(())
    }
}
