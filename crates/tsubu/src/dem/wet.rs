//! Grains in water: the forces of the water join those of the contacts, block by block.

use super::engine::DemEngine;
use super::touch::{Block, Load};
use crate::contact::chunk::{Chunk, ROWS};
use crate::engine::Engine;
use crate::find::candidates::BLOCK;
use crate::ledger::{Account, Ledger};
use crate::state::Grains;
use crate::water::{EVERY, Flows, Given, Gust, Parcel, Stream, Water};
use glam::DVec3;

/// The water of a run.
#[derive(Debug)]
pub(super) struct Wet {
    pub water: Water,
    /// Force along x on the grains of every layer of a stream [N].
    taken: Vec<f64>,
    /// Momentum along x of the water that grains have picked up in this step, by layers of a stream [N.s].
    picked: Vec<f64>,
}

/// What passes between the water and one block.
#[derive(Clone, Debug, Default)]
pub(super) struct Soaked {
    flows: Flows,
    /// What the layers of a stream give to its grains along x.
    given: Vec<Given>,
    /// What was drawn for the water around each of the own grains, where it fluctuates.
    gusts: Vec<Gust>,
}

/// Water at a moment, for grains to be in.
#[derive(Clone, Copy)]
pub(super) struct Bath<'a> {
    water: &'a Water,
    gravity: DVec3,
    time: f64,
    /// Whether the water is held still.
    held: bool,
}

impl Wet {
    pub fn new(water: Water) -> Self {
        let layers = if let Stream::Coupled(coupled) = &water.stream { coupled.layers.len() } else { 0 };
        Self { water, taken: vec![0.0; layers], picked: vec![0.0; layers] }
    }

    /// Whether there is a stream that gives to the grains and takes from them.
    pub fn has_stream(&self) -> bool {
        matches!(self.water.stream, Stream::Coupled(_))
    }

    /// Its kinetic energy [J].
    pub fn stream_energy(&self) -> f64 {
        if let Stream::Coupled(coupled) = &self.water.stream { coupled.energy() } else { 0.0 }
    }

    /// What the water has done to all blocks; remembers what they have taken from its layers.
    fn gather(&mut self, blocks: &[Block]) -> Flows {
        self.taken.fill(0.0);
        let mut flows = Flows::default();
        for Soaked { flows: of_block, given, .. } in blocks.iter().map(|block| &block.soaked) {
            flows.add(of_block);
            let mut from_below = 0.0;
            for (taken, [even, odd]) in self.taken.iter_mut().zip(given) {
                let above = even[1] + odd[1];
                *taken += from_below + (even[0] + odd[0] - above);
                from_below = above;
            }
        }
        flows
    }
}

impl Bath<'_> {
    /// Adds the forces on the grains of a block that begins with grain `first` to its `loads`, parcel by parcel: those that
    /// forces move, then the others. What fixed grains feel is nobody's business but that of a stream, which they slow as well.
    pub fn soak(&self, grains: &Grains, first: usize, loads: &mut [Load], soaked: &mut Soaked, parcel: &mut Parcel) {
        let own = &grains.inverse_mass[first..(first + BLOCK).min(grains.len())];
        let Soaked { flows, given, gusts } = soaked;
        *flows = Flows::default();
        given.clear();
        if let Stream::Coupled(coupled) = &self.water.stream {
            given.resize(coupled.layers.len(), Given::default());
        }
        if self.water.fluctuation.is_some() {
            gusts.resize(BLOCK, Gust::default());
        }
        let slows = !given.is_empty();
        let mut dip = Dip { bath: self, grains, first, loads, given, gusts, parcel };
        let fixed = own.iter().filter(|m| **m == 0.0).count();
        if fixed == 0 {
            // Nobody need be looked up in a list.
            for begin in (0..own.len()).step_by(ROWS) {
                dip.free((own.len() - begin).min(ROWS), |r| begin + r, flows);
            }
            return;
        }
        let sort = |fixed: bool| {
            let (mut rows, mut len) = ([0u16; BLOCK], 0);
            for (i, m) in own.iter().enumerate() {
                rows[len] = i as u16;
                len += usize::from((*m == 0.0) == fixed);
            }
            (rows, len)
        };
        let (rows, len) = sort(false);
        for rows in rows[..len].chunks(ROWS) {
            dip.free(rows.len(), |r| rows[r] as usize, flows);
        }
        if slows {
            let mut on_fixed = Flows::default();
            let (rows, len) = sort(true);
            for rows in rows[..len].chunks(ROWS) {
                dip.act(rows.len(), |r| rows[r] as usize, &mut on_fixed);
            }
            flows.add_fixed(&on_fixed);
        }
    }
}

/// A block of grains under water.
struct Dip<'a> {
    bath: &'a Bath<'a>,
    grains: &'a Grains,
    first: usize,
    loads: &'a mut [Load],
    given: &'a mut [Given],
    gusts: &'a mut [Gust],
    parcel: &'a mut Parcel,
}

impl Dip<'_> {
    /// Forces on so many grains, of which `own` tells the places in the block, and what they take from a stream.
    fn act(&mut self, len: usize, own: impl Fn(usize) -> usize, flows: &mut Flows) {
        let Self { bath, grains, first, given, gusts, parcel, .. } = self;
        let Bath { water, time, held, .. } = **bath;
        let turns = water.turns();
        parcel.len = len;
        for r in 0..parcel.rows() {
            let i = *first + own(r);
            parcel.height[r] = grains.position[i].z;
            parcel.radius[r] = grains.radius[i];
            Chunk::set(&mut parcel.velocity, r, grains.velocity[i]);
            if turns {
                Chunk::set(&mut parcel.spin, r, grains.spin[i]);
            }
            if let Some(fluctuation) = &water.fluctuation {
                let gust = fluctuation.at(&mut gusts[own(r)], grains.id[i], time);
                Chunk::set(&mut parcel.gust, r, DVec3::from_array(gust));
            }
        }
        water.act(parcel, flows, held);
        if !given.is_empty() {
            if water.fluctuation.is_some() && !held {
                flows.gust += parcel.gust_power();
            }
            parcel.give(given);
        }
    }

    /// The same for grains that forces move.
    fn free(&mut self, len: usize, own: impl Fn(usize) -> usize, flows: &mut Flows) {
        self.act(len, &own, flows);
        // The step adds gravity to the acceleration; the added mass, which it moves too, has no weight.
        let water = self.bath.water;
        let weight = water.added_mass * water.density * self.bath.gravity;
        let turns = water.turns();
        for r in 0..self.parcel.rows() {
            let load = &mut self.loads[own(r)];
            load.force += self.parcel.total(r) - weight * self.parcel.volume[r];
            if turns {
                load.torque += self.parcel.total_torque(r);
            }
        }
    }
}

/// Gives every grain from a `level` [m] upwards the added mass of where it is. `gains` hears of each at
/// which height what momentum [N.s] that water has gained, and with which velocity: `ahead` [s] of its last acceleration less
/// than it has.
fn immerse(grains: &mut Grains, water: &Water, level: f64, ahead: f64, mut gains: impl FnMut(f64, DVec3, DVec3)) {
    for first in (0..grains.len()).step_by(ROWS) {
        let rows = first..(first + ROWS).min(grains.len());
        // Counting needs no branches: where all are deep it is all there is to do.
        if grains.position[rows.clone()].iter().filter(|p| p.z >= level).count() == 0 {
            continue;
        }
        for i in rows {
            let height = grains.position[i].z;
            if height < level || grains.inverse_mass[i] == 0.0 {
                continue;
            }
            let added = water.added_mass(grains.radius[i], height);
            let velocity = grains.velocity[i] - ahead * grains.acceleration[i];
            gains(height, (added - grains.added_mass(i)) * velocity, velocity);
            grains.inverse_mass[i] = 1.0 / (grains.mass[i] + added);
        }
    }
}

impl DemEngine {
    /// Gives every grain the added mass of where it begins.
    pub(super) fn immerse(&mut self) {
        if let Some(wet) = &self.wet {
            immerse(&mut self.grains, &wet.water, f64::NEG_INFINITY, 0.0, |_, _, _| ());
        }
    }

    /// The same within a step, where there is a surface to go through.
    pub(super) fn sink(&mut self, ledger: &mut Ledger) {
        let ahead = self.motion(self.dt).predicts();
        let Some(Wet { water, picked, .. }) = self.wet.as_mut().filter(|wet| wet.water.has_surface()) else { return };
        picked.fill(0.0);
        let layers = water.stream.layers().filter(|_| !picked.is_empty());
        // Whatever is a diameter down now has been under water in the last step as well. The mass changes between the two halves of
        // the step, so what it brings has the velocity between them, not the predicted one.
        let level = water.surface() - self.largest_diameter;
        immerse(&mut self.grains, water, level, ahead, |height, momentum, velocity| {
            ledger.post(Account::Buoyancy, 0.5 * momentum.dot(velocity));
            for (axis, impulse) in ledger.water_impulse.iter_mut().enumerate() {
                *impulse += momentum[axis];
            }
            if let Some(layers) = layers {
                let (below, share) = layers.at(height);
                picked[below] += momentum.x * (1.0 - share);
                picked[below + 1] += momentum.x * share;
            }
        });
    }

    /// The water of this moment.
    pub(super) fn bath(&self) -> Option<Bath<'_>> {
        let Wet { water, .. } = self.wet.as_ref()?;
        Some(Bath { water, gravity: self.gravity, time: self.time(), held: self.walls_held })
    }

    /// Sums what the water has done to all grains.
    pub(super) fn soak(&mut self) {
        if let Some(wet) = &mut self.wet {
            self.water_flows = wet.gather(&self.touch.blocks);
        }
    }

    /// Moves the stream by a step, under what the grains have taken from it.
    pub(super) fn flow_on(&mut self, ledger: &mut Ledger) {
        let held = self.walls_held;
        let Some(wet) = &mut self.wet else { return };
        let looks = self.step.is_multiple_of(EVERY);
        match &mut wet.water.stream {
            Stream::Coupled(coupled) if !held => {
                let mut turned = coupled.step(&wet.taken, &wet.picked, self.dt);
                if looks {
                    let seconds = EVERY as f64 * self.dt;
                    let mixed = coupled.look(&self.grains.position, &self.grains.radius, seconds);
                    (turned.work, turned.lost) = (turned.work + mixed.work, turned.lost + mixed.lost);
                }
                ledger.post(Account::StreamWork, turned.work);
                ledger.post(Account::Buoyancy, -turned.picked);
                ledger.post(Account::StreamFriction, turned.lost);
            }
            Stream::Column { layers, .. } if looks => {
                layers.open = layers.measure(&self.grains.position, &self.grains.radius);
            }
            _ => {}
        }
    }

    /// The stream at a moment that no step has led to: grains stand where they stand.
    pub(super) fn still_stream(&mut self) {
        let Some(wet) = &mut self.wet else { return };
        match &mut wet.water.stream {
            Stream::Coupled(coupled) => coupled.stand(&wet.taken),
            Stream::Column { .. } | Stream::Still | Stream::LogLaw { .. } | Stream::Table { .. } => {}
        }
    }

    /// Makes room for the grains in the layers of the water, before anything moves.
    pub(super) fn make_room(&mut self) {
        let Some(wet) = &mut self.wet else { return };
        let (position, radius) = (&self.grains.position, &self.grains.radius);
        match &mut wet.water.stream {
            Stream::Coupled(coupled) => coupled.make_room(position, radius),
            Stream::Column { layers, .. } => layers.open = layers.measure(position, radius),
            Stream::Still | Stream::LogLaw { .. } | Stream::Table { .. } => {}
        }
    }
}
