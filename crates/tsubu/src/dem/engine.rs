//! The DEM engine: its state, how it is built from a plan, and how it answers.

use super::integrate::Report;
use super::keep::Kept;
use super::orientation::Orientation;
use super::place;
use super::room;
use super::sources::Sources;
use super::step::Flows;
use super::touch::{Sums, Touch};
use super::wet::Wet;
use crate::check;
use crate::contact::Table;
use crate::engine::{Engine, Fault, Note, OpenError, Refusal, Verdict};
use crate::find::candidates::{BLOCK, shares};
use crate::find::{Candidates, Search};
use crate::ledger::{Ledger, Stocks};
use crate::partner::Hosts;
use crate::state::Grains;
use crate::threads::awake;
use crate::view::{View, WallLoad, Wants};
use crate::wall::{Mover, Wall};
use crate::water::{self, Water};
use glam::DVec3;
use tsubu_frame::state::MissingSection;
use tsubu_frame::{Frame, State};
use tsubu_scene::plan::{Integrator, Particles, Plan};

/// Grains under a contact law.
#[expect(clippy::struct_excessive_bools, reason = "four independent yes or no; a type each would say less")]
#[derive(Debug)]
pub struct DemEngine {
    // State.
    pub(super) grains: Grains,
    pub(super) step: u64,
    /// Grains moved in every step so far, summed.
    pub(super) grain_steps: u64,
    pub(super) walls: Vec<Wall>,
    pub(super) last_flows: Flows,
    pub(super) candidates: Candidates,
    pub(super) touch: Touch,
    pub(super) sums: Sums,
    pub(super) sources: Sources,
    pub(super) wet: Option<Wet>,
    pub(super) orientation: Orientation,
    // What the plan says.
    pub(super) table: Table,
    /// Gap at which bodies may still hold each other [m], of each law.
    pub(super) reaches: Vec<f64>,
    pub(super) search: Search,
    pub(super) gravity: DVec3,
    pub(super) integrator: Integrator,
    pub(super) dt: f64,
    pub(super) rotation: bool,
    pub(super) in_space: bool,
    pub(super) smallest_diameter: f64,
    pub(super) largest_diameter: f64,
    pub(super) largest_overlap: f64,
    pub(super) total_mass: f64,
    /// While grains settle the walls stand, whoever moves them.
    pub(super) walls_held: bool,
    pub(super) notes: Vec<Note>,
    /// Whether the grains have begun the next step already; never between two calls of `advance`.
    pub(super) begun: bool,
    // Scratch.
    pub(super) reports: Vec<Report>,
    pub(super) kept: Kept,
    pub(super) wall_loads: Vec<WallLoad>,
    pub(super) host_forces: Vec<f64>,
    /// Contact force on grains that forces do not move [N], and the power that driven ones give [W].
    pub(super) fixed: (DVec3, f64),
    /// Energy of contacts that a search has found gone [J].
    pub(super) released: f64,
    /// What the water does at this moment.
    pub(super) water_flows: water::Flows,
}

impl DemEngine {
    /// Builds the engine at time 0; grains that the scene wants settled have settled.
    #[expect(clippy::too_many_lines, reason = "a third of them names the fields of the plan, one each")]
    pub fn new(plan: &Plan, hosts: &Hosts) -> Result<Self, OpenError> {
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
            particles,
            walls: _,
            periodic: _,
            removal: _,
            hosts: _,
            water,
            contact,
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
            sweep: _,
            watch: _,
            output: _,
            claim: _,
        } = plan;
        let refuse = |(key, text): (String, String)| {
            let notes = vec![Note { key, verdict: Verdict::Refused, text }];
            Refusal { method: "dem", notes }
        };
        let table = Table::new(plan);
        let dt = check::time_step(plan, &table, hosts);
        if let Some(text) = check::blows_up(plan, hosts, dt) {
            return Err(refuse(("dem.time-step".to_owned(), text)).into());
        }
        let gravity = DVec3::from_array(*gravity);
        let walls = walls(plan, &table, hosts, *dimension, gravity);
        let (grains, settle) = place::grains(plan, &table, &walls).map_err(refuse)?;
        let sources = Sources::new(plan, &table, &walls, grains.len());
        let diameters = grains.radius.iter().map(|r| (2.0 * r, 2.0 * r)).chain(sources.sizes());
        let (smallest, largest) = diameters.fold((f64::INFINITY, 0.0f64), |a, d| (a.0.min(d.0), a.1.max(d.1)));
        let skin = if smallest.is_finite() { dem.skin * smallest } else { 0.0 };
        let mut reaches = vec![0.0f64; table.laws().len()];
        for (a, b) in check::bodies(plan, &table, hosts).pairs() {
            let law = table.law(table.index(a.material, b.material));
            // Whether large or small grains hold each other over the wider gap is the law's business.
            let largest = table.pair((a.material, a.largest, a.mass), (b.material, b.largest, b.mass));
            for pair in [table.pair(a.body(), b.body()), largest] {
                reaches[law] = reaches[law].max(table.laws()[law].reach(&pair));
            }
        }
        let reach = reaches.iter().copied().fold(0.0, f64::max);
        let wall_loads = vec![WallLoad::default(); walls.len()];
        let largest_present = particles.values().map(Particles::largest_diameter).fold(largest, f64::max);
        let mut engine = Self {
            step: 0,
            grain_steps: 0,
            walls,
            last_flows: Flows::default(),
            candidates: Candidates::default(),
            touch: Touch::default(),
            sums: Sums::default(),
            sources,
            wet: water.as_ref().map(|water| Wet::new(Water::new(water, gravity).seeded(*seed, *dimension == 3))),
            orientation: Orientation::new(dem.orientation),
            dt,
            table,
            reaches,
            search: Search { skin, reach, ends: room::ends(plan) },
            gravity,
            integrator: dem.integrator,
            rotation: contact.rotation,
            in_space: *dimension == 3,
            smallest_diameter: smallest,
            largest_diameter: largest_present,
            largest_overlap: dem.largest_overlap,
            total_mass: grains.moved_mass(),
            walls_held: false,
            notes: Vec::new(),
            begun: false,
            reports: Vec::new(),
            kept: Kept::default(),
            wall_loads,
            host_forces: Vec::new(),
            fixed: Default::default(),
            released: 0.0,
            water_flows: water::Flows::default(),
            grains,
        };
        engine.start();
        engine.judge_start(plan)?;
        if settle > 0.0 {
            engine.settle(settle).map_err(OpenError::Settling)?;
            engine.start();
        }
        Ok(engine)
    }

    /// Gives the first step what it needs.
    fn start(&mut self) {
        self.drive(0.0);
        self.immerse();
        self.make_room();
        self.find();
        self.stand();
    }
}

/// The walls of a plan at time 0.
fn walls(plan: &Plan, table: &Table, hosts: &Hosts, dimension: u8, gravity: DVec3) -> Vec<Wall> {
    let build = |(name, wall): (&String, &tsubu_scene::plan::Wall)| {
        let mut built = Wall::new(name, wall, dimension, hosts, gravity);
        built.material = table.material(&wall.material);
        // A wall on a light structure gives way in an impact: its mass is the one the structure shows.
        built.inverse_mass = match (&built.mover, &wall.servo, &wall.body) {
            (Mover::Host(index, _), ..) => 1.0 / hosts.list[*index].effective_mass(),
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
        self.dt
    }

    fn steps(&self) -> u64 {
        self.step
    }

    fn grains(&self) -> usize {
        self.grains.len()
    }

    fn traffic(&self) -> Vec<(String, u64)> {
        self.sources.traffic()
    }

    fn advance(&mut self, steps: u64, hosts: &mut Hosts, ledger: &mut Ledger) -> Result<(), Fault> {
        let grains = self.grains.len();
        let mut go = || (0..steps).try_for_each(|step| self.step(hosts, ledger, step + 1 < steps));
        if shares(grains) > 1 { awake(grains.div_ceil(BLOCK), go) } else { go() }
    }

    fn grain_stocks(&self) -> Stocks {
        let walls: f64 = self.walls.iter().map(|w| w.energy().0 + w.energy().1).sum();
        let stream = self.wet.as_ref().map_or(0.0, Wet::stream_energy);
        Stocks { elastic: self.sums.stored, walls, stream, ..self.grains.stocks(self.gravity) }
    }

    fn momentum(&self) -> [f64; 3] {
        self.grains.momentum().to_array()
    }

    fn centre_of_mass(&self) -> [f64; 3] {
        self.grains.centre_of_mass().to_array()
    }

    fn grain_steps(&self) -> u64 {
        self.grain_steps
    }

    fn contacts(&self) -> usize {
        self.sums.contacts
    }

    fn frame(&self, _hosts: &Hosts) -> Frame {
        self.picture()
    }

    fn offers(&self) -> Wants {
        Wants::ALL
    }

    fn view(&self, wants: Wants) -> View<'_> {
        self.shown(wants)
    }

    fn save(&self, state: &mut State) {
        self.write_state(state);
    }

    fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        self.read_state(state)
    }
}
