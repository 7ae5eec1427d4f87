//! The DEM engine: its state, how it is built from a plan, and how it answers.

use super::integrate::Halves;
use super::place;
use super::step::Flows;
use super::touch::{Forces, Touch};
use crate::check;
use crate::contact::{Law, Table};
use crate::engine::{Engine, Fault, Note, OpenError, Refusal, Verdict};
use crate::find::Candidates;
use crate::ledger::{Ledger, Stocks};
use crate::partner::Hosts;
use crate::state::Grains;
use crate::wall::{Carrier, Plane, plane};
use glam::DVec3;
use tsubu_frame::state::MissingSection;
use tsubu_frame::{Frame, Kind, State};
use tsubu_scene::plan::{Integrator, Normal, Plan, Tangential};

/// Spheres under a contact law.
#[derive(Debug)]
pub struct DemEngine {
    // State.
    pub(super) grains: Grains,
    pub(super) step: u64,
    pub(super) planes: Vec<Plane>,
    pub(super) last_flows: Flows,
    pub(super) candidates: Candidates,
    pub(super) touch: Touch,
    pub(super) forces: Forces,
    // What the plan says.
    pub(super) law: Law,
    pub(super) table: Table,
    pub(super) gravity: DVec3,
    pub(super) integrator: Integrator,
    pub(super) dt: f64,
    pub(super) rotation: bool,
    pub(super) skin: f64,
    pub(super) reach: f64,
    pub(super) smallest_diameter: f64,
    pub(super) largest_overlap: f64,
    pub(super) total_mass: f64,
    /// While grains settle the walls do not follow their carriers.
    pub(super) walls_held: bool,
    outlines: Vec<(Vec<DVec3>, Carrier)>,
    notes: Vec<Note>,
    // Scratch.
    pub(super) halves: Halves,
    pub(super) host_forces: Vec<f64>,
}

impl DemEngine {
    /// Builds the engine at time 0; grains that the scene wants settled have settled.
    pub fn new(plan: &Plan, hosts: &Hosts) -> Result<Self, OpenError> {
        // Every field is named: a new one does not compile until it is decided here.
        let Plan {
            title: _,
            method: _,
            dimension,
            seed: _,
            gravity,
            duration: _,
            speed_scale: _,
            materials: _,
            material_pair: _,
            particles: _,
            walls,
            hosts: _,
            contact,
            dem,
            lattice: _,
            response: _,
            sweep: _,
            output: _,
            claim: _,
        } = plan;
        let refuse = |key: String, text: String| Refusal {
            method: "dem",
            notes: vec![Note { key, verdict: Verdict::Refused, text }],
        };
        if matches!((&contact.normal, &contact.tangential), (Normal::Hooke { .. }, Tangential::Mindlin {})) {
            let text = "wants `contact.normal.hertz`; with `hooke` use `contact.tangential.coulomb`";
            return Err(refuse("contact.tangential.mindlin".to_owned(), text.to_owned()).into());
        }
        let law = Law::new(contact);
        let table = Table::new(plan, &law, hosts);
        let (grains, settle) = place::grains(plan, hosts).map_err(|(key, text)| refuse(key, text))?;
        let mut planes = Vec::new();
        let mut outlines = Vec::new();
        for w in walls.values() {
            let carrier = Carrier::new(w, hosts);
            outlines.push((plane::outline(w), carrier.clone()));
            for (point, normal) in plane::planes(w, *dimension) {
                planes.push(Plane {
                    point,
                    normal,
                    displacement: DVec3::ZERO,
                    velocity: DVec3::ZERO,
                    carrier: carrier.clone(),
                    species: table.wall_species(w, hosts),
                });
            }
        }
        let smallest_diameter = grains.radius.iter().copied().fold(f64::INFINITY, f64::min) * 2.0;
        let largest_diameter = grains.radius.iter().copied().fold(0.0, f64::max) * 2.0;
        let skin = if grains.is_empty() { 0.0 } else { dem.skin * smallest_diameter };
        let mut engine = Self {
            step: 0,
            planes,
            last_flows: Flows::default(),
            candidates: Candidates::default(),
            touch: Touch::default(),
            forces: Forces::default(),
            law,
            dt: check::time_step(plan, &table, hosts),
            table,
            walls_held: false,
            gravity: DVec3::from_array(*gravity),
            integrator: dem.integrator,
            rotation: contact.rotation,
            skin,
            reach: largest_diameter + skin,
            smallest_diameter,
            largest_overlap: dem.largest_overlap,
            total_mass: grains.mass.iter().sum(),
            outlines,
            notes: Vec::new(),
            halves: Halves::default(),
            host_forces: Vec::new(),
            grains,
        };
        engine.move_walls(0.0, hosts);
        engine.start();
        if settle > 0.0 {
            engine.settle(settle).map_err(OpenError::Settling)?;
            engine.start();
        }
        Ok(engine)
    }

    /// Finds, touches and accelerates at the present time level, so that the first step has what it needs.
    fn start(&mut self) {
        self.find();
        self.touch_all();
        self.accelerate();
        self.last_flows = self.flows();
    }
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

    fn advance(&mut self, steps: u64, hosts: &mut Hosts, ledger: &mut Ledger) -> Result<(), Fault> {
        for _ in 0..steps {
            self.step(hosts, ledger)?;
        }
        Ok(())
    }

    fn grain_stocks(&self) -> Stocks {
        Stocks { elastic: self.forces.sums.stored, ..self.grains.stocks(self.gravity) }
    }

    fn momentum(&self) -> [f64; 3] {
        self.grains.momentum().to_array()
    }

    fn contacts(&self) -> usize {
        self.forces.sums.contacts
    }

    fn frame(&self, hosts: &Hosts) -> Frame {
        let order = self.grains.by_id();
        let vectors = |column: &[DVec3]| order.iter().map(|&i| column[i].to_array()).collect::<Vec<_>>();
        let scalars = |column: &[f64]| order.iter().map(|&i| column[i]).collect::<Vec<_>>();
        let mut frame = Frame { time: self.time(), step: self.step, columns: Vec::new() };
        let ids = order.iter().map(|&i| i64::from(self.grains.id[i])).collect();
        frame.integer(Kind::Grain, "id", "-", ids);
        frame.vector(Kind::Grain, "position", "m", vectors(&self.grains.position));
        frame.vector(Kind::Grain, "velocity", "m/s", vectors(&self.grains.velocity));
        frame.vector(Kind::Grain, "spin", "rad/s", vectors(&self.grains.spin));
        frame.scalar(Kind::Grain, "radius", "m", scalars(&self.grains.radius));
        frame.scalar(Kind::Grain, "mass", "kg", scalars(&self.grains.mass));
        let force: Vec<DVec3> = (0..self.grains.len())
            .map(|i| self.grains.mass[i] * (self.grains.acceleration[i] - self.gravity))
            .collect();
        frame.vector(Kind::Grain, "contact force", "N", vectors(&force));
        let contacts = self.contact_list();
        let id = |i: usize| i64::from(self.grains.id[i]);
        frame.integer(Kind::Contact, "first", "-", contacts.iter().map(|c| id(c.first)).collect());
        frame.integer(Kind::Contact, "second", "-", contacts.iter().map(|c| c.second.map_or(-1, id)).collect());
        frame.vector(Kind::Contact, "position", "m", contacts.iter().map(|c| c.position.to_array()).collect());
        frame.vector(Kind::Contact, "force", "N", contacts.iter().map(|c| c.force.to_array()).collect());
        frame.scalar(Kind::Contact, "overlap", "m", contacts.iter().map(|c| c.overlap).collect());
        let mut corners = Vec::new();
        let mut index = Vec::new();
        for (k, (outline, carrier)) in self.outlines.iter().enumerate() {
            let (displacement, _) = carrier.place(self.time(), hosts);
            corners.extend(outline.iter().map(|p| (*p + displacement).to_array()));
            index.extend(outline.iter().map(|_| k as i64));
        }
        frame.vector(Kind::Surface, "position", "m", corners);
        frame.integer(Kind::Surface, "outline", "-", index);
        frame
    }

    fn save(&self, state: &mut State) {
        self.grains.save("grains", state);
        state.put_integer("dem.step", vec![self.step as i64, self.forces.sums.contacts as i64]);
        let mut reals = self.last_flows.powers.to_vec();
        reals.extend(self.last_flows.wall_force.to_array());
        reals.push(self.forces.sums.stored);
        state.put_real("dem.flows", reals);
        let flat = |v: &[DVec3]| v.iter().flat_map(DVec3::to_array).collect::<Vec<_>>();
        state.put_real("dem.reference", flat(&self.candidates.reference));
        state.put_real("dem.plane-reference", flat(&self.candidates.plane_reference));
        let held = self.held_history();
        state.put_integer(
            "dem.history-pairs",
            held.keys().flat_map(|k| [i64::from(k.0), i64::from(k.1)]).collect::<Vec<_>>(),
        );
        state.put_real("dem.history", held.values().flatten().copied().collect::<Vec<_>>());
    }

    fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        let missing = |name: &str| MissingSection { name: name.to_owned(), kind: "real" };
        self.grains = Grains::load("grains", self.grains.len(), state)?;
        let &[step, contacts] = state.integer("dem.step")? else { return Err(missing("dem.step")) };
        (self.step, self.forces.sums.contacts) = (step as u64, contacts as usize);
        let flows = state.real("dem.flows")?;
        if flows.len() != 8 {
            return Err(missing("dem.flows"));
        }
        self.last_flows.powers.copy_from_slice(&flows[..4]);
        self.last_flows.wall_force = DVec3::from_slice(&flows[4..7]);
        self.forces.sums.stored = flows[7];
        let vectors = |name: &str, count: usize| -> Result<Vec<DVec3>, MissingSection> {
            let values = state.real(name)?;
            if values.len() != 3 * count {
                return Err(missing(name));
            }
            Ok(values.chunks_exact(3).map(DVec3::from_slice).collect())
        };
        self.candidates.reference = vectors("dem.reference", self.grains.len())?;
        self.candidates.plane_reference = vectors("dem.plane-reference", self.planes.len())?;
        self.candidates.list(&self.grains, &self.planes, self.skin, self.reach);
        let pairs = state.integer("dem.history-pairs")?;
        let values = state.real("dem.history")?;
        let held = pairs
            .chunks_exact(2)
            .zip(values.chunks_exact(4))
            .map(|(p, h)| ((p[0] as u32, p[1] as u32), [h[0], h[1], h[2], h[3]]))
            .collect();
        self.restore_history(&held);
        Ok(())
    }
}
