//! The DEM engine: its state, how it is built from a plan, and how it answers.

use super::bodies::{self, Bodies};
use super::bonds::{self, Bonds};
use super::books::{Books, Reactions};
use super::clock::Clock;
use super::contact_forces::{ContactForces, ContactLaws};
use super::immersion::Immersion;
use super::integrate::TimeIntegration;
use super::orientation::Orientation;
use super::place;
use super::ranks::Ranks;
use super::room;
use super::sources::Sources;
use crate::check;
use crate::contact::Table;
use crate::engine::{Engine, Fault, Note, OpenError, Refusal};
use crate::ledger::{Energies, Ledger};
use crate::mutation::{Mutation, left_out, mutated};
use crate::neighbours::joined::Joined;
use crate::neighbours::{NeighbourLists, Search};
use crate::outside::Action;
use crate::partner::Hosts;
use crate::ranks::{Communicator, RankShare};
use crate::state::Grains;
use crate::view::{View, WallLoad, Wants};
use crate::wall::{Faces, Mover, Velocity, Wall};
use crate::water::Water;
use glam::DVec3;
use std::any::Any;
use std::sync::Arc;
use tsubu_frame::state::MissingSection;
use tsubu_frame::{Frame, State};
use tsubu_scene::plan::{Particles, Plan};

/// Grains under a contact law.
#[derive(Debug)]
pub struct DemEngine {
    pub(super) grains: Grains,
    pub(super) walls: Vec<Wall>,
    pub(super) faces: Faces,
    pub(super) clock: Clock,
    pub(super) neighbours: NeighbourLists,
    pub(super) laws: ContactLaws,
    pub(super) contacts: ContactForces,
    pub(super) immersion: Option<Immersion>,
    pub(super) integration: TimeIntegration,
    pub(super) ranks: Ranks,
    pub(super) sources: Sources,
    pub(super) reactions: Reactions,
    pub(super) books: Books,
    pub(super) limits: Limits,
    pub(super) notes: Vec<Note>,
}

/// What the grains of a run may be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Of all grains, those that are yet to come included [m].
    pub smallest_diameter: f64,
    /// The same.
    pub largest_diameter: f64,
    /// Over the diameter; beyond it the run ends [-].
    pub largest_overlap: f64,
    /// Whether grains move in three dimensions.
    pub in_space: bool,
}

impl Limits {
    fn new(plan: &Plan, grains: &Grains, sources: &Sources) -> Self {
        let all = grains.radius.iter().map(|r| (2.0 * r, 2.0 * r)).chain(sources.sizes());
        let ends = all.fold((f64::INFINITY, 0.0_f64), |ends, of| (ends.0.min(of.0), ends.1.max(of.1)));
        Self {
            smallest_diameter: ends.0,
            largest_diameter: plan.particles.values().map(Particles::largest_diameter).fold(ends.1, f64::max),
            largest_overlap: plan.dem.largest_overlap,
            in_space: plan.dimension == 3,
        }
    }
}

impl DemEngine {
    /// Builds the engine at time 0; grains that the scene wants settled have settled.
    pub fn new(plan: &Plan, hosts: &Hosts) -> Result<Self, OpenError> {
        Self::on_ranks(plan, hosts, None)
    }

    /// The same on this rank of several, which all do so.
    pub fn on_ranks(
        plan: &Plan,
        hosts: &Hosts,
        communicator: Option<Arc<dyn Communicator>>,
    ) -> Result<Self, OpenError> {
        // Every field is named: a new one does not compile until it is decided here.
        let Plan {
            title: _,
            method: _,
            dimension,
            seed,
            gravity,
            duration: _,
            speed_scale: _,
            materials: _,
            material_pair: _,
            particles: _,
            walls: _,
            periodic: _,
            removal: _,
            hosts: _,
            water,
            contact,
            bond,
            dem,
            lattice: _,
            cl_ca: _,
            litwiniszyn: _,
            after_caram_hong: _,
            after_savage: _,
            gutt_haff: _,
            after_hemmingsson_herrmann: _,
            fhp: _,
            after_peng_herrmann: _,
            after_baxter_behringer: _,
            after_karolyi_kertesz: _,
            response: _,
            atlas: _,
            design: _,
            calibrate: _,
            sweep: _,
            watch: _,
            output: _,
            start_from: _, // Of the run, as its stages.
            start_fingerprint: _,
            start_at_zero: _,
            stage: _,
            claim: _,
        } = plan;
        let refuse = |(key, text): (String, String)| Refusal::of("dem", key, text);
        bodies::refused(plan)?;
        bonds::refused(plan)?;
        let table = Table::new(plan);
        let dt = check::time_step(plan, &table, hosts);
        if let Some(text) = check::blows_up(plan, hosts, dt) {
            return Err(refuse(("dem.time-step".to_owned(), text)).into());
        }
        let gravity = DVec3::from_array(*gravity);
        let mut walls = walls(plan, &table, hosts, *dimension, gravity);
        let (mut grains, settle) = place::grains(plan, &table, &walls).map_err(refuse)?;
        let first = (0..grains.len()).find(|&i| grains.inverse_mass[i] != 0.0);
        if let Some(i) = first.filter(|_| left_out(Mutation::LastBit)) {
            grains.position[i].x += f64::EPSILON * grains.position[i].x.abs().max(grains.radius[i]);
        }
        let bodies = Bodies::assemble(plan, &mut grains);
        let sources = Sources::new(plan, &table, &walls, grains.len());
        let orientation = Orientation::new(dem.orientation || !bond.is_empty());
        let immersion =
            water.as_ref().map(|water| Immersion::new(Water::new(water, gravity).seeded(*seed, *dimension == 3)));
        // Who looks at all grains in every step.
        let looked_at = !bodies.is_empty()
            || orientation.is_wanted()
            || immersion.as_ref().is_some_and(|immersion| immersion.water.has_surface());
        let limits = Limits::new(plan, &grains, &sources);
        let smallest = limits.smallest_diameter;
        let notes = bodies::facet(plan, &mut walls, smallest);
        let skin = if smallest.is_finite() { dem.skin * smallest } else { 0.0 };
        let laws = ContactLaws::new(plan, table, hosts);
        let search = Search { skin, reach: laws.reach(), periodic: room::periodic_bounds(plan) };
        let reactions = Reactions { wall_loads: vec![WallLoad::default(); walls.len()], ..Reactions::default() };
        let mut engine = Self {
            walls,
            faces: Faces::new(plan),
            clock: Clock { dt, ..Clock::default() },
            neighbours: NeighbourLists::new(search).but(Joined::bodies(bodies.of_grains())),
            laws,
            contacts: ContactForces::beside(Bonds::new(plan)),
            immersion,
            integration: TimeIntegration::new(dem.integrator, gravity, contact.rotation, bodies, orientation),
            ranks: Ranks::new(communicator, looked_at),
            sources,
            reactions,
            books: Books { moved_mass: grains.moved_mass(), ..Books::default() },
            limits,
            notes,
            grains,
        };
        engine.start();
        engine.judge_start(plan)?;
        if settle > 0.0 {
            engine.settle(settle).map_err(OpenError::Settling)?;
            engine.start();
        }
        engine.make_bonds(&mut Ledger::default());
        Ok(engine)
    }

    /// Gives the first step what it needs.
    pub(super) fn start(&mut self) {
        self.move_driven(self.clock.time());
        self.init_added_mass();
        self.init_porosity();
        self.rebuild_neighbours();
        self.evaluate_at_rest();
        self.ranks.gather_grains(&mut self.grains);
    }
}

/// The walls of a plan at time 0.
fn walls(plan: &Plan, table: &Table, hosts: &Hosts, dimension: u8, gravity: DVec3) -> Vec<Wall> {
    let build = |(name, wall): (&String, &tsubu_scene::plan::Wall)| {
        let mut built = Wall::new(name, wall, dimension, hosts, gravity);
        built.material = table.material(&wall.material);
        // A wall on a light structure gives way in an impact: its mass is the one the structure shows.
        built.inverse_mass = match (&built.mover, &wall.servo, &wall.body) {
            (Mover::Host { host, interface }, ..) => 1.0 / hosts.list[*host].shown_mass(*interface),
            (_, Some(servo), _) => 1.0 / servo.mass,
            (_, _, Some(body)) => 1.0 / body.mass,
            _ => 0.0,
        };
        built
    };
    plan.walls.iter().map(build).collect()
}

impl Engine for DemEngine {
    fn notes(&self) -> &[Note] {
        &self.notes
    }

    fn time_step(&self) -> f64 {
        self.clock.dt
    }

    fn step_key(&self) -> &'static str {
        "dem.time-step"
    }

    fn steps(&self) -> u64 {
        self.clock.step
    }

    fn stage_begin(&self) -> (u64, f64) {
        self.clock.begin
    }

    fn change(&mut self, plans: [&Plan; 2], hosts: &Hosts) -> Result<(), OpenError> {
        self.change_plan(plans, hosts)
    }

    fn follow_hosts(&mut self, hosts: &Hosts) {
        self.walls_follow(hosts);
    }

    fn restart_clock(&mut self, plan: &Plan, hosts: &Hosts) -> Result<(), OpenError> {
        self.turn_clock_back(plan, hosts)
    }

    fn grains(&self) -> usize {
        self.grains.len()
    }

    fn traffic(&self) -> Vec<(String, u64)> {
        self.sources.traffic()
    }

    fn set_in_motion(&mut self, velocity: [f64; 3]) -> bool {
        let Grains { velocity: of, inverse_mass, .. } = &mut self.grains;
        for (own, _) in of.iter_mut().zip(inverse_mass).filter(|(_, inverse)| **inverse != 0.0) {
            *own += DVec3::from_array(velocity);
        }
        self.integration.bodies.push(DVec3::from_array(velocity));
        true
    }

    fn on_ranks(&self, ranks: usize) -> Option<RankShare> {
        let contacts = |block: usize| self.contacts.blocks[block].sums.contacts;
        let [water, stream] = self.immersion.as_ref().map_or([0; 2], Immersion::numbers_of_block);
        let numbers = [6 * self.walls.len() + water, stream];
        Some(self.ranks.share_of_busiest(ranks, &self.neighbours, contacts, numbers))
    }

    fn worked(&self) -> &[f64] {
        self.ranks.worked()
    }

    fn advance(&mut self, steps: u64, hosts: &mut Hosts, ledger: &mut Ledger) -> Result<(), Fault> {
        self.go(steps, hosts, ledger, true)
    }

    fn advance_unseen(&mut self, steps: u64, hosts: &mut Hosts, ledger: &mut Ledger) -> Result<(), Fault> {
        self.go(steps, hosts, ledger, false)
    }

    fn grain_energies(&self) -> Energies {
        let walls: f64 = self.walls.iter().map(|w| w.energy().0 + w.energy().1).sum();
        let stream = self.immersion.as_ref().map_or(0.0, Immersion::stream_energy);
        let (spheres, bodies) = (
            self.grains.energies(self.integration.gravity),
            self.integration.bodies.energies(self.integration.gravity),
        );
        Energies {
            kinetic: spheres.kinetic + bodies.kinetic,
            added_mass: spheres.added_mass + bodies.added_mass,
            rotational: mutated(Mutation::Rotation, spheres.rotational + bodies.rotational),
            potential: spheres.potential + bodies.potential,
            elastic: self.contacts.sums.stored,
            bonds: self.contacts.bonds.stored,
            walls,
            stream,
            ..spheres
        }
    }

    fn momentum(&self) -> [f64; 3] {
        (self.grains.momentum() + self.integration.bodies.momentum()).to_array()
    }

    fn centre_of_mass(&self) -> [f64; 3] {
        let (mass, moment) =
            (self.grains.moved_mass(), self.grains.moment_of_mass() + self.integration.bodies.moment_of_mass());
        if mass > 0.0 { (moment / mass).to_array() } else { [0.0; 3] }
    }

    fn grain_steps(&self) -> u64 {
        self.clock.grain_steps
    }

    fn contacts(&self) -> usize {
        self.contacts.sums.contacts
    }

    fn grain_frame(&self, _hosts: &Hosts) -> Frame {
        self.drawn_grains()
    }

    fn contact_frame(&self) -> Frame {
        self.drawn_contacts()
    }

    fn offers(&self) -> Wants {
        Wants::ALL
    }

    fn view(&self, wants: Wants) -> View<'_> {
        self.shown(wants)
    }

    fn walls(&self) -> &[Wall] {
        &self.walls
    }

    fn steer(&mut self, wall: &str, velocity: Velocity) -> Result<(), Refusal> {
        self.steer_wall(wall, velocity)
    }

    fn act(&mut self, every: u64, action: Box<dyn Action>) -> Result<(), Refusal> {
        self.act_from_outside(every, action);
        Ok(())
    }

    fn leave(&mut self) {
        self.leave_alone();
    }

    fn renew(&mut self, column: &str) -> Option<Box<dyn Any + Send + Sync>> {
        self.grains.renew(column)
    }

    fn save<'a>(&'a self, state: &mut State<'a>) {
        self.write_state(state);
    }

    fn load(&mut self, state: &mut State) -> Result<(), MissingSection> {
        self.read_state(state)
    }
}
