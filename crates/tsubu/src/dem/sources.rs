//! Grains that come, go, or move as told: streams, removal regions, driven groups.

use super::engine::DemEngine;
use super::fill::Occupied;
use super::place::{direction, still};
use super::room::{Clearance, Room, Side, images, periodic_bounds, sides};
use crate::contact::Table;
use crate::engine::Engine;
use crate::ledger::{Account, Ledger};
use crate::motion::value_and_rate;
use crate::neighbours::grid::wrapped;
use crate::random::{Purpose, words};
use crate::sizes;
use crate::wall::Wall;
use glam::DVec3;
use tsubu_scene::plan::{Clump, GrainMotion, Particles, Plan, Removal, Signal, Start};

/// Steps between two looks at what should come or go.
const EVERY: u64 = 50;

/// Attempts to find a free place for a grain of a stream at one look; the others wait for the next.
const ATTEMPTS: u64 = 40;

/// A group that comes in one by one.
#[derive(Clone, Debug)]
struct GrainStream {
    name: String,
    group: Particles,
    number: usize,
    material: u32,
    /// The clump that its grains are, if they are several spheres.
    clump: Option<Clump>,
    first_id: u32,
    /// How many have come.
    placed: usize,
    /// Since when it flows as it does [s], and how many had come by then.
    since: (f64, usize),
    /// On which side of every wall its region lies at time 0: to look anew whenever a grain comes would take longer than a step.
    sides: Vec<Side>,
}

impl GrainStream {
    /// Numbers that each of its grains takes.
    fn pieces(&self) -> u32 {
        self.clump.as_ref().map_or(1, |clump| clump.pieces.len() as u32)
    }
}

/// A group that moves as told.
#[derive(Clone, Debug)]
struct Driven {
    number: u32,
    direction: DVec3,
    signal: Signal,
}

/// A region that takes grains away.
#[derive(Clone, Debug)]
struct Drain {
    name: String,
    region: Removal,
    /// How many have gone.
    taken: u64,
}

/// All that comes, goes, or moves as told.
#[derive(Clone, Debug)]
pub(super) struct Sources {
    plan: Plan,
    streams: Vec<GrainStream>,
    removal: Vec<Drain>,
    driven: Vec<Driven>,
    /// Grains are numbered below this, those that are yet to come included.
    pub numbers: u32,
}

impl Sources {
    /// The sources of a plan; ids of the grains of streams begin at `first_id`.
    pub fn new(plan: &Plan, table: &Table, walls: &[Wall], first_id: usize) -> Self {
        let (mut streams, mut driven) = (Vec::new(), Vec::new());
        let mut id = first_id as u32;
        for (number, (name, group)) in plan.particles.iter().enumerate() {
            if let Start::Stream { region, .. } = &group.start {
                let material = table.material(&group.material);
                let gravity = DVec3::from_array(plan.gravity);
                streams.push(GrainStream {
                    name: name.clone(),
                    group: group.clone(),
                    number,
                    material,
                    clump: group.shape.clump(),
                    first_id: id,
                    placed: 0,
                    since: (0.0, 0),
                    sides: sides(walls, &Room::of(region), plan.dimension, gravity),
                });
                id += group.count as u32 * streams.last().map_or(1, GrainStream::pieces);
            }
            if let GrainMotion::Driven { direction, signal } = &group.motion {
                let direction = DVec3::from_array(*direction);
                driven.push(Driven { number: number as u32, direction, signal: signal.clone() });
            }
        }
        // Large tables of grains have done their work.
        let plan = Plan { particles: std::collections::BTreeMap::new(), ..plan.clone() };
        let drain =
            |(name, region): (&String, &Removal)| Drain { name: name.clone(), region: region.clone(), taken: 0 };
        let removal = plan.removal.iter().map(drain).collect();
        Self { plan, streams, removal, driven, numbers: id }
    }

    /// How many grains of every stream have come, and how many every removal region has taken, for a checkpoint.
    pub fn counts(&self) -> Vec<i64> {
        let taken = self.removal.iter().map(|drain| drain.taken as i64);
        self.streams.iter().map(|s| s.placed as i64).chain(taken).collect()
    }

    /// Takes back what [`Sources::counts`] gave.
    pub fn set_counts(&mut self, counts: &[i64]) {
        let (placed, taken) = counts.split_at(self.streams.len().min(counts.len()));
        for (stream, placed) in self.streams.iter_mut().zip(placed) {
            stream.placed = *placed as usize;
        }
        for (drain, taken) in self.removal.iter_mut().zip(taken) {
            drain.taken = *taken as u64;
        }
    }

    /// Since when the streams flow as they do, for a checkpoint; nothing where all have from the first.
    pub fn begun(&self) -> Vec<f64> {
        let begun = self.streams.iter().flat_map(|s| [s.since.0, s.since.1 as f64]);
        if self.streams.iter().all(|s| s.since == (0.0, 0)) { Vec::new() } else { begun.collect() }
    }

    /// Takes back what [`Sources::begun`] gave.
    pub fn set_begun(&mut self, begun: &[f64]) {
        for (stream, [since, before]) in self.streams.iter_mut().zip(begun.as_chunks::<2>().0) {
            stream.since = (*since, *before as usize);
        }
    }

    /// At time 0 of another clock: all streams begin to flow anew, with the grains that are left of them.
    pub fn begin_anew(&mut self) {
        for stream in &mut self.streams {
            stream.since = (0.0, stream.placed);
        }
    }

    /// Another stage begins at `time` [s]: streams that it changes begin to flow anew, with the grains that are left of them.
    pub fn change(&mut self, plan: &Plan, walls: &[Wall], time: f64) {
        let gravity = DVec3::from_array(plan.gravity);
        for stream in &mut self.streams {
            let Some(group) = plan.particles.get(&stream.name).filter(|group| group.start != stream.group.start) else {
                continue;
            };
            stream.group.start = group.start.clone();
            stream.since = (time, stream.placed);
            if let Start::Stream { region, .. } = &group.start {
                stream.sides = sides(walls, &Room::of(region), plan.dimension, gravity);
            }
        }
        for drain in &mut self.removal {
            if let Some(region) = plan.removal.get(&drain.name) {
                drain.region = region.clone();
            }
        }
    }

    /// The same with names.
    pub fn traffic(&self) -> Vec<(String, u64)> {
        let came = self.streams.iter().map(|s| (format!("stream {} grains", s.name), s.placed as u64));
        let went = self.removal.iter().map(|drain| (format!("removal {} grains", drain.name), drain.taken));
        came.chain(went).collect()
    }

    /// Whether a grain with its centre there [m] vanishes; it is counted.
    fn take(&mut self, place: DVec3) -> bool {
        let drain = self.removal.iter_mut().find(|drain| drain.region.takes(place.to_array()));
        drain.map(|drain| drain.taken += 1).is_some()
    }

    /// Largest diameter [m] of grains that may still come, and the smallest.
    pub fn sizes(&self) -> Option<(f64, f64)> {
        let ranges = self.streams.iter().map(|s| {
            let [thin, thick] = s.clump.as_ref().map_or([1.0; 2], |clump| clump.radii().map(|radius| 2.0 * radius));
            (thin * s.group.smallest_diameter(), thick * s.group.largest_diameter())
        });
        ranges.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
    }
}

impl DemEngine {
    /// Moves the driven groups to where they are at `time`.
    pub(super) fn move_driven(&mut self, time: f64) {
        if self.clock.settling {
            return;
        }
        for driven in &self.sources.driven {
            let (now, rate) = value_and_rate(&driven.signal, time);
            let (before, rate_before) = value_and_rate(&driven.signal, time - self.clock.dt);
            // The drift of the step has taken them along with the velocity they had; at time 0 there was none.
            let missing = if self.clock.step > 0 { now - before - rate_before * self.clock.dt } else { 0.0 };
            for i in 0..self.grains.len() {
                if self.grains.group[i] == driven.number {
                    self.grains.position[i] += driven.direction * missing;
                    self.grains.velocity[i] = driven.direction * rate;
                }
            }
        }
    }

    /// Whether it is time after step `step` to look at what should come or go.
    pub(super) fn insertion_due(&self, step: u64) -> bool {
        let nothing = self.sources.streams.is_empty() && self.sources.removal.is_empty();
        !nothing && !self.clock.settling && step.is_multiple_of(EVERY)
    }

    /// Lets grains come and go between two steps. What is posted is the difference of all that is held: motion, height, and
    /// the energy of the contacts of grains that go.
    pub(super) fn insert_and_remove(&mut self, ledger: &mut Ledger) {
        let Self { grains, sources, integration, .. } = self;
        let ends = periodic_bounds(&sources.plan);
        // A body goes as a whole, with its centre of mass.
        let gone = integration.bodies.taken(|centre| sources.take(wrapped(&ends, centre)));
        let mut order: Vec<u32> = Vec::with_capacity(grains.len());
        for i in 0..grains.len() {
            let goes = match integration.bodies.of(grains.id[i]) {
                Some(body) => gone[body as usize],
                None => grains.inverse_mass[i] != 0.0 && sources.take(grains.position[i]),
            };
            if !goes {
                order.push(i as u32);
            }
        }
        let some_go = order.len() < grains.len();
        let arrivals = self.arrivals();
        if !some_go && arrivals.is_empty() {
            return;
        }
        let history = self.snapshot_history();
        let before = self.energy_and_momentum();
        self.grains.permute(&order, &[]);
        for grain in arrivals {
            self.grains.push(grain);
        }
        self.books.moved_mass = self.grains.moved_mass();
        self.init_added_mass();
        self.rebuild_neighbours_with(history);
        // What the springs of those contacts held is in the difference below.
        self.contacts.released = 0.0;
        if some_go {
            self.evaluate_at_rest();
        }
        let after = self.energy_and_momentum();
        ledger.post(Account::Exchange, after.0 - before.0);
        for (axis, impulse) in ledger.exchange_impulse.iter_mut().enumerate() {
            *impulse += after.1[axis] - before.1[axis];
        }
    }

    fn energy_and_momentum(&self) -> (f64, DVec3) {
        (self.grain_energies().total(), self.momentum().into())
    }

    /// The grains that come now.
    fn arrivals(&mut self) -> Vec<crate::state::Grain> {
        let mut arrivals = Vec::new();
        let time = self.clock.time();
        let (dimension, ends) = (self.sources.plan.dimension, periodic_bounds(&self.sources.plan));
        for stream in &mut self.sources.streams {
            let Start::Stream { region, rate, velocity, speed, from } = &stream.group.start else { continue };
            let (since, before) = stream.since;
            let due = ((time - since - from) * rate).max(0.0).floor() as usize;
            let due = (before + due).min(stream.group.count);
            if stream.placed >= due {
                continue;
            }
            let (low, high) = (DVec3::from_array(region.low), DVec3::from_array(region.high));
            let room = Room::of(region);
            let mut clearance = Clearance::on(stream.sides.clone(), &self.walls, self.integration.gravity);
            let largest = self.limits.largest_diameter * 0.5;
            let mut occupied = Occupied::new(largest);
            let margin = DVec3::splat(2.0 * largest);
            for (p, r) in self.grains.position.iter().zip(&self.grains.radius) {
                for image in images(&ends, *p, 2.0 * largest) {
                    if image.cmpge(low - margin).all() && image.cmple(high + margin).all() {
                        occupied.put(image, *r);
                    }
                }
            }
            while stream.placed < due {
                let id = stream.first_id + stream.placed as u32 * stream.pieces();
                let diameter = sizes::diameter(&stream.group, self.sources.plan.seed, id);
                let radius = 0.5 * diameter;
                let place = (0..ATTEMPTS).find_map(|attempt| {
                    let step = self.clock.step * ATTEMPTS + attempt;
                    let p = room.anywhere(&self.sources.plan, radius, Purpose::Stream, id, step);
                    (room.holds(p, radius) && occupied.free(p, radius) && clearance.free(p, radius)).then_some(p)
                });
                let Some(p) = place else { break };
                for image in images(&ends, p, 2.0 * largest) {
                    occupied.put(image, radius);
                }
                let mut grain = still(&stream.group, stream.number, stream.material, p, diameter, id as usize);
                let w = words(self.sources.plan.seed, Purpose::Stream, id, 1);
                grain.velocity = DVec3::from_array(*velocity) + direction(dimension, w) * *speed;
                grain.acceleration = self.integration.gravity;
                match &stream.clump {
                    Some(clump) => {
                        arrivals.extend(self.integration.bodies.enter(clump, &grain, id, &self.sources.plan));
                    }
                    None => arrivals.push(grain),
                }
                stream.placed += 1;
            }
        }
        arrivals
    }
}
