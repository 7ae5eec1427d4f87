//! What the engine shows and what it saves.

use super::engine::DemEngine;
use super::history_transfer::{ContactId, HistorySnapshot};
use crate::partner::Hosts;
use crate::sections;
use crate::state::Grains;
use crate::state::columns::Value;
use crate::view::{Columns, Contact, Contacts, View, Wants};
use glam::{DQuat, DVec3};
use tsubu_frame::state::MissingSection;
use tsubu_frame::{Frame, Kind, State};

impl DemEngine {
    /// The contacts. Of several ranks the first has them; the others tell it theirs.
    pub(super) fn drawn_contacts(&self) -> Frame {
        let room = if self.ranks.is_first() { self.contacts.sums.contacts } else { 0 };
        let mut contacts = ContactColumns::with_room(room);
        self.each_contact(|contact| contacts.push(&contact, &self.grains.id));
        let mut frame = self.empty_frame();
        contacts.put(&mut frame);
        self.tell_world(&mut frame);
        frame
    }

    fn empty_frame(&self) -> Frame {
        Frame { time: self.clock.time(), step: self.clock.step, columns: Vec::new() }
    }

    /// Grains in the order of their ids, and the walls. Of several ranks the first draws it; the others tell it of their contacts where it needs them.
    pub(super) fn drawn_grains(&self) -> Frame {
        let summed = !self.acceleration_tells();
        let mut force = vec![DVec3::ZERO; if summed { self.grains.len() } else { 0 }];
        if summed {
            self.each_contact(|contact| add_force(&mut force, &contact));
        }
        let mut frame = self.empty_frame();
        if !self.ranks.is_first() {
            return frame;
        }
        let order = self.grains.by_id();
        let vectors = |column: &[DVec3]| order.iter().map(|&i| column[i].to_array()).collect::<Vec<_>>();
        let scalars = |column: &[f64]| order.iter().map(|&i| column[i]).collect::<Vec<_>>();
        let whole = |column: &[u32]| order.iter().map(|&i| i64::from(column[i])).collect::<Vec<_>>();
        frame.integer(Kind::Grain, "id", "-", whole(&self.grains.id));
        frame.integer(Kind::Grain, "group", "-", whole(&self.grains.group));
        if !self.integration.bodies.is_empty() {
            let body = |&i: &usize| self.integration.bodies.of(self.grains.id[i]).map_or(-1, i64::from);
            frame.integer(Kind::Grain, "body", "-", order.iter().map(body).collect());
        }
        frame.vector(Kind::Grain, "position", "m", vectors(&self.grains.position));
        frame.vector(Kind::Grain, "velocity", "m/s", vectors(&self.grains.velocity));
        frame.vector(Kind::Grain, "spin", "rad/s", vectors(&self.grains.spin));
        frame.scalar(Kind::Grain, "radius", "m", scalars(&self.grains.radius));
        frame.scalar(Kind::Grain, "mass", "kg", scalars(&self.grains.mass));
        let shaped = self.integration.bodies.shaped();
        let turns = shaped || self.integration.bodies.faceted();
        let turned: Option<Vec<_>> = order
            .iter()
            .map(|&i| self.grains.id[i])
            .map(|id| match self.integration.bodies.orientation(id) {
                Some(turned) if turns || self.integration.orientation.of(id).is_some() => Some(turned),
                _ => self.integration.orientation.of(id).or(turns.then_some(DQuat::IDENTITY)),
            })
            .collect();
        if let Some(turned) = turned {
            frame.quaternion(Kind::Grain, "orientation", turned.iter().map(|q| [q.w, q.x, q.y, q.z]).collect());
        }
        if shaped {
            self.tell_shapes(&order, &mut frame);
        }
        self.integration.bodies.tell_polyhedra(&order, &mut frame);
        if summed {
            frame.vector(Kind::Grain, "contact force", "N", vectors(&force));
        } else {
            let told = order.iter().map(|&i| self.force_of_acceleration(i).to_array()).collect();
            frame.vector(Kind::Grain, "contact force", "N", told);
        }
        if self.immersion.is_some() {
            frame.vector(Kind::Grain, "water force", "N", vectors(&self.water_forces(&force)));
        }
        self.draw_surroundings(&mut frame);
        self.tell_world(&mut frame);
        frame
    }

    /// What superellipsoids are; a sphere is one, too.
    fn tell_shapes(&self, order: &[usize], frame: &mut Frame) {
        let shapes: Vec<_> = order
            .iter()
            .map(|&i| {
                let sphere = (DVec3::splat(self.grains.radius[i]), [2.0; 2]);
                self.integration.bodies.superellipsoid(i).map_or(sphere, |(_, own)| (own.semi_axes, own.exponents))
            })
            .collect();
        frame.vector(Kind::Grain, "semi-axes", "m", shapes.iter().map(|(axes, _)| axes.to_array()).collect());
        frame.scalar(Kind::Grain, "profile exponent", "-", shapes.iter().map(|(_, [p, _])| *p).collect());
        frame.scalar(Kind::Grain, "equator exponent", "-", shapes.iter().map(|(_, [_, r])| *r).collect());
    }

    /// Whether accelerations are those of contacts and gravity alone.
    fn acceleration_tells(&self) -> bool {
        self.immersion.is_none()
            && !self.pushed_from_outside()
            && self.integration.bodies.is_empty()
            && self.contacts.bonds.is_empty()
    }

    /// What contacts do to a grain [N], where its acceleration tells.
    fn force_of_acceleration(&self, i: usize) -> DVec3 {
        let g = &self.grains;
        let pull = if g.inverse_mass[i] == 0.0 { DVec3::ZERO } else { self.integration.gravity };
        g.mass[i] * (g.acceleration[i] - pull)
    }

    /// What the water does to every grain that forces move [N]: what gravity and contacts leave of its acceleration, that of
    /// its added mass with it.
    fn water_forces(&self, contact: &[DVec3]) -> Vec<DVec3> {
        let g = &self.grains;
        let rest = |i: usize| {
            let added = if g.inertia[i] == 0.0 { 0.0 } else { g.added_mass(i) };
            (g.mass[i] + added) * g.acceleration[i]
                - g.mass[i] * self.integration.gravity
                - contact[i]
                - self.contacts.outside.on(i)
                - self.contacts.bonds.on(i)
        };
        let mut forces: Vec<DVec3> =
            (0..g.len()).map(|i| if g.inverse_mass[i] == 0.0 { DVec3::ZERO } else { rest(i) }).collect();
        self.integration.bodies.share_water_force(g, &mut forces);
        forces
    }

    /// What those see who look on. A pair that only the reach of the law holds near each other is no contact.
    pub(super) fn shown(&self, wants: Wants) -> View<'_> {
        let g = &self.grains;
        let grains = Columns {
            position: (&g.position).into(),
            unwrap_offset: (&g.unwrap_offset).into(),
            velocity: (&g.velocity).into(),
            spin: (&g.spin).into(),
            radius: (&g.radius).into(),
            mass: (&g.mass).into(),
            inverse_mass: (&g.inverse_mass).into(),
            group: (&g.group).into(),
            id: (&g.id).into(),
        };
        let mut contacts = match wants.contacts {
            Contacts::Nothing => Vec::new(),
            Contacts::Places => self.overlaps(),
            Contacts::Forces => {
                let mut all = Vec::new();
                self.each_contact(|contact| all.push(contact));
                all
            }
        };
        contacts.retain(|c| c.overlap > 0.0 || c.force != DVec3::ZERO);
        let walls = if wants.walls { self.reactions.wall_loads.clone() } else { Vec::new() };
        let water = self.immersion.as_ref().map(|immersion| &immersion.water);
        let bonds = self.contacts.bonds.rows().collect();
        let (bodies, body_of) = if wants.bodies { self.integration.bodies.view() } else { Default::default() };
        View {
            time: self.clock.time(),
            periodic: self.neighbours.search.periodic,
            grains,
            contacts,
            bonds,
            broken_bonds: self.contacts.bonds.broken(),
            walls,
            bodies,
            body_of,
            shapes: Some(&self.integration.bodies),
            water,
            hosts: &[],
        }
    }

    /// Everything that the next step depends on. Of several ranks the first writes it; the others tell it their contacts.
    pub(super) fn write_state<'a>(&'a self, state: &mut State<'a>) {
        let (contacts, history) = self.contacts.by_id(&self.force_input(), &self.ranks);
        if !self.ranks.is_first() {
            return;
        }
        self.grains.save("grains", state);
        let counts =
            [self.clock.step, self.clock.grain_steps, self.contacts.sums.contacts as u64, self.grains.len() as u64];
        state.put_integer("dem.step", counts.map(|n| n as i64).to_vec());
        state.put_real("dem.moved-mass", vec![self.books.moved_mass]);
        if self.clock.begin != (0, 0.0) {
            let (step, time) = self.clock.begin;
            state.put_real("dem.stage-begin", vec![step as f64, time]);
        }
        self.integration.bodies.save(state);
        self.integration.orientation.save(state);
        self.contacts.bonds.save(state);
        state.put_integer("dem.streams", self.sources.counts());
        let begun = self.sources.begun();
        if !begun.is_empty() {
            state.put_real("dem.streams-begun", begun);
        }
        sections::save("dem.powers", self.books.last.clone().named(), state);
        state.put_real("dem.stored", vec![self.contacts.sums.stored]);
        state.put_real("dem.reference", bytemuck::cast_slice(&self.neighbours.reference[..]));
        let places = self.neighbours.wall_reference.iter().flat_map(crate::wall::Pose::place);
        state.put_real("dem.wall-reference", places.collect::<Vec<_>>());
        let drifts = self.neighbours.drifts.of.iter();
        let drifts = drifts.flat_map(|d| d.offset.to_array().into_iter().chain(d.velocity.to_array()));
        state.put_real("dem.drifts", drifts.collect::<Vec<_>>());
        if let Some(immersion) = &self.immersion {
            immersion.water.stream.save(state);
        }
        for wall in &self.walls {
            wall.save(state);
        }
        state.put_index("dem.contacts", contacts);
        state.put_real("dem.history", history);
    }

    /// Takes back what [`DemEngine::write_state`] wrote; columns and contacts are taken out of the state.
    pub(super) fn read_state(&mut self, state: &mut State) -> Result<(), MissingSection> {
        let missing = |name: &str| MissingSection { name: name.to_owned(), kind: "real" };
        let &[step, grain_steps, contacts, grains] = state.integer("dem.step")? else {
            return Err(missing("dem.step"));
        };
        self.grains = Grains::load("grains", grains as usize, state)?;
        self.integration.bodies.load(state, &self.grains)?;
        // Whoever keeps something by the numbers of grains would make room for any number.
        if self.grains.id.iter().any(|id| *id >= self.sources.numbers) {
            return Err(missing("grains.id"));
        }
        // Added up anew, in the order that grains have now, it would be another number in its last digits.
        let &[mass] = state.real("dem.moved-mass")? else { return Err(missing("dem.moved-mass")) };
        self.books.moved_mass = mass;
        (self.clock.step, self.clock.grain_steps) = (step as u64, grain_steps as u64);
        if let Ok(&[step, time]) = state.real("dem.stage-begin") {
            self.clock.begin = (step as u64, time);
        }
        self.contacts.sums.contacts = contacts as usize;
        self.integration.orientation.load(state)?;
        self.sources.set_counts(state.integer("dem.streams")?);
        if let Ok(begun) = state.real("dem.streams-begun") {
            self.sources.set_begun(begun);
        }
        sections::load("dem.powers", self.books.last.named(), state)?;
        let &[stored] = state.real("dem.stored")? else { return Err(missing("dem.stored")) };
        self.contacts.sums.stored = stored;
        let reference = DVec3::take(state, "dem.reference")?;
        let places = state.real("dem.wall-reference")?;
        if reference.len() != self.grains.len() || places.len() != 7 * self.walls.len() {
            return Err(missing("dem.reference"));
        }
        self.neighbours.reference = reference;
        for (wall, place) in self.walls.iter_mut().zip(places.as_chunks::<7>().0) {
            wall.load(state)?;
            // The lists are made with the walls where they stood then; the next step puts them where they belong.
            wall.pose.set_place(*place);
        }
        // A stage may have said anew when they go.
        self.place_gates();
        self.neighbours.wall_reference = self.walls.iter().map(|w| w.pose).collect();
        self.contacts.bonds.load(state, &self.grains)?;
        self.neighbours.joined.bond(self.contacts.bonds.pairs());
        self.neighbours.part = self.cut();
        self.neighbours.build(&self.grains, &self.walls);
        let drifts = state.real("dem.drifts")?.as_chunks::<6>().0;
        for (drift, d) in self.neighbours.drifts.of.iter_mut().zip(drifts) {
            drift.offset = DVec3::from_slice(&d[..3]);
            drift.velocity = DVec3::from_slice(&d[3..]);
        }
        self.resize_contacts();
        if let Some(immersion) = &mut self.immersion {
            immersion.water.stream.load(state)?;
        }
        let hosts = Hosts::default();
        let time = self.clock.time();
        for wall in self.walls.iter_mut().filter(|w| w.host().is_none()) {
            wall.follow(time, &hosts);
        }
        let width = self.laws.history_width();
        let ids = state.take_index("dem.contacts")?;
        let ids = ids.as_chunks::<4>().0;
        let history = state.take_real("dem.history")?;
        if history.len() != ids.len() * width {
            return Err(missing("dem.history"));
        }
        let mut material_of = vec![None; self.sources.numbers as usize];
        for (id, material) in self.grains.id.iter().zip(&self.grains.material) {
            material_of[*id as usize] = Some(*material);
        }
        let of_grain = |id: u32| material_of.get(id as usize).copied().flatten();
        let contact = |&[first, second, wall, patch]: &[u32; 4]| {
            let wall = wall != 0;
            let other = if wall { self.walls.get(second as usize).map(|w| w.material) } else { of_grain(second) };
            let pair = of_grain(first).zip(other);
            let law = pair.map_or(0, |(a, b)| self.laws.table.law(self.laws.table.index(a, b)) as u32);
            ContactId { first, second, wall, patch, law }
        };
        self.restore_history(HistorySnapshot::of(ids.iter().map(contact).collect(), history));
        Ok(())
    }
}

/// Adds what a contact does to its grains [N].
fn add_force(force: &mut [DVec3], contact: &Contact) {
    force[contact.first] += contact.force;
    if !contact.wall {
        force[contact.second] -= contact.force;
    }
}

/// The contacts of a frame.
#[derive(Debug)]
struct ContactColumns {
    first: Vec<i64>,
    second: Vec<i64>,
    position: Vec<[f64; 3]>,
    force: Vec<[f64; 3]>,
    normal: Vec<[f64; 3]>,
    overlap: Vec<f64>,
}

impl ContactColumns {
    /// For so many contacts: columns that grew side by side would leave as much memory in pieces as they take.
    fn with_room(contacts: usize) -> Self {
        Self {
            first: Vec::with_capacity(contacts),
            second: Vec::with_capacity(contacts),
            position: Vec::with_capacity(contacts),
            force: Vec::with_capacity(contacts),
            normal: Vec::with_capacity(contacts),
            overlap: Vec::with_capacity(contacts),
        }
    }

    fn push(&mut self, contact: &Contact, id: &[u32]) {
        let id = |i: usize| i64::from(id[i]);
        self.first.push(id(contact.first));
        // A wall is told as -1 less its number.
        self.second.push(if contact.wall { -1 - contact.second as i64 } else { id(contact.second) });
        self.position.push(contact.position.to_array());
        self.force.push(contact.force.to_array());
        self.normal.push(contact.normal.to_array());
        self.overlap.push(contact.overlap);
    }

    fn put(self, frame: &mut Frame) {
        frame.integer(Kind::Contact, "first", "-", self.first);
        frame.integer(Kind::Contact, "second", "-", self.second);
        frame.vector(Kind::Contact, "position", "m", self.position);
        frame.vector(Kind::Contact, "force", "N", self.force);
        frame.vector(Kind::Contact, "normal", "-", self.normal);
        frame.scalar(Kind::Contact, "overlap", "m", self.overlap);
    }
}
