//! Grains in water: the forces of the water join those of the contacts.

use super::engine::DemEngine;
use super::touch::Block;
use crate::contact::chunk::{Chunk, ROWS};
use crate::engine::Engine;
use crate::find::candidates::{BLOCK, WORTH_THREADS};
use crate::ledger::{Account, Ledger};
use crate::state::Grains;
use crate::water::{EVERY, Flows, Gust, Parcel, Stream, Water};
use glam::DVec3;
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};

/// Water, and memory for every thread.
#[derive(Debug)]
pub(super) struct Wet {
    pub water: Water,
    /// The moment at which it acts [s].
    time: f64,
    scratch: Vec<Mutex<Parcel>>,
    /// Of every block.
    flows: Vec<Flows>,
    /// Force along x on the grains of every layer of a stream [N], of every block.
    taken: Vec<Vec<f64>>,
    /// The same of all blocks.
    total: Vec<f64>,
}

impl Wet {
    pub fn new(water: Water) -> Self {
        let layers = if let Stream::Coupled(coupled) = &water.stream { coupled.layers.len() } else { 0 };
        Self { water, time: 0.0, scratch: Vec::new(), flows: Vec::new(), taken: Vec::new(), total: vec![0.0; layers] }
    }

    /// Whether there is a stream that gives to the grains and takes from them.
    pub fn has_stream(&self) -> bool {
        matches!(self.water.stream, Stream::Coupled(_))
    }

    /// Its kinetic energy [J].
    pub fn stream_energy(&self) -> f64 {
        if let Stream::Coupled(coupled) = &self.water.stream { coupled.energy() } else { 0.0 }
    }

    /// Adds the forces of the water to the loads of every block; returns what they do in all.
    fn act(&mut self, grains: &Grains, blocks: &mut [Block], gravity: DVec3, held: bool) -> Flows {
        let Self { water, time, scratch, flows, taken, total } = self;
        while scratch.len() < rayon::current_num_threads() {
            scratch.push(Mutex::default());
        }
        flows.resize(blocks.len(), Flows::default());
        taken.resize(blocks.len(), vec![0.0; total.len()]);
        let (water, scratch) = (&*water, &*scratch);
        let work = |(number, ((block, flows), taken)): (usize, ((&mut Block, &mut Flows), &mut Vec<f64>))| {
            let mine = rayon::current_thread_index().unwrap_or(0);
            // Nobody else has this thread's parcel, so the lock is free.
            let mut parcel = scratch[mine].lock().unwrap_or_else(PoisonError::into_inner);
            parcel.time = *time;
            let first = number * BLOCK;
            *flows = block_of_grains(water, grains, first, block, &mut parcel, gravity, held, taken);
        };
        if grains.len() >= WORTH_THREADS && rayon::current_num_threads() > 1 {
            let all = blocks.par_iter_mut().zip(flows.par_iter_mut()).zip(taken.par_iter_mut());
            all.enumerate().with_max_len(1).for_each(work);
        } else {
            blocks.iter_mut().zip(flows.iter_mut()).zip(taken.iter_mut()).enumerate().for_each(work);
        }
        total.fill(0.0);
        for taken in taken {
            for (total, taken) in total.iter_mut().zip(taken) {
                *total += *taken;
            }
        }
        let mut all = Flows::default();
        for flows in flows {
            all.add(flows);
        }
        all
    }
}

/// The grains of one block, parcel by parcel.
#[expect(clippy::too_many_arguments, reason = "one call; a struct would be made and taken apart beside it")]
fn block_of_grains(
    water: &Water,
    grains: &Grains,
    first: usize,
    block: &mut Block,
    parcel: &mut Parcel,
    gravity: DVec3,
    held: bool,
    taken: &mut [f64],
) -> Flows {
    let mut flows = Flows::default();
    taken.fill(0.0);
    let layers = if taken.is_empty() { None } else { water.stream.layers() };
    let turns = water.turns();
    let last = (first + BLOCK).min(grains.len());
    if water.fluctuation.is_some() {
        block.gusts.resize(BLOCK, Gust::default());
    }
    // What fixed grains feel is nobody's business but that of a stream, which they slow as well.
    let mut on_fixed = Flows::default();
    let kinds: &[bool] = if layers.is_some() { &[false, true] } else { &[false] };
    for (begin, &fixed) in (first..last).step_by(ROWS).flat_map(|begin| kinds.iter().map(move |fixed| (begin, fixed))) {
        let n = ROWS.min(last - begin);
        parcel.len = 0;
        let mut row = [0u16; ROWS];
        for i in begin..begin + n {
            if (grains.inverse_mass[i] == 0.0) != fixed {
                continue;
            }
            let r = parcel.len;
            row[r] = (i - first) as u16;
            parcel.height[r] = grains.position[i].z;
            parcel.radius[r] = grains.radius[i];
            let v = grains.velocity[i];
            parcel.velocity[0][r] = v.x;
            parcel.velocity[1][r] = v.y;
            parcel.velocity[2][r] = v.z;
            if turns {
                Chunk::set(&mut parcel.spin, r, grains.spin[i]);
            }
            if let Some(fluctuation) = &water.fluctuation {
                let gust = fluctuation.at(&mut block.gusts[i - first], grains.id[i], parcel.time);
                for (column, gust) in parcel.gust.iter_mut().zip(gust) {
                    column[r] = gust;
                }
            }
            parcel.len += 1;
        }
        water.act(parcel, if fixed { &mut on_fixed } else { &mut flows }, held);
        if let Some(layers) = layers {
            for r in 0..parcel.len {
                let (k, above, share) = layers.weights(parcel.height[r]);
                let force = parcel.total[0][r];
                taken[k] += force * (1.0 - share);
                taken[above] += force * share;
            }
        }
        if fixed {
            continue;
        }
        // The step adds gravity to the acceleration; the added mass, which it moves too, has no weight.
        parcel.weigh(water.added_mass * water.density, gravity);
        for (r, own) in row.iter().take(parcel.len).enumerate() {
            let load = &mut block.loads[*own as usize];
            load.force += parcel.total(r);
            if turns {
                load.torque += parcel.total_torque(r);
            }
        }
    }
    flows.add_fixed(&on_fixed);
    flows
}

impl DemEngine {
    /// Gives every grain the added mass of where it is, but those `deep` radii and more below the surface. Returns what the
    /// motion of that water has gained: energy [J] and momentum [N.s].
    pub(super) fn immerse(&mut self, deep: f64) -> (f64, DVec3) {
        let Some(wet) = &self.wet else { return Default::default() };
        let grains = &mut self.grains;
        let (mut energy, mut momentum) = (0.0, DVec3::ZERO);
        let surface = wet.water.surface;
        for i in 0..grains.len() {
            let under = surface - grains.position[i].z > deep * grains.radius[i];
            if under || grains.inverse_mass[i] == 0.0 {
                continue;
            }
            let added = wet.water.added_mass(grains.radius[i], grains.position[i].z);
            let gained = (added - grains.added_mass(i)) * grains.velocity[i];
            energy += 0.5 * gained.dot(grains.velocity[i]);
            momentum += gained;
            grains.inverse_mass[i] = 1.0 / (grains.mass[i] + added);
        }
        (energy, momentum)
    }

    /// The same within a step, where there is a surface to go through.
    pub(super) fn sink(&mut self, ledger: &mut Ledger) {
        if !self.wet.as_ref().is_some_and(|wet| wet.water.has_surface()) {
            return;
        }
        // Whatever is two radii down now has been under water in the last step as well.
        let (energy, momentum) = self.immerse(2.0);
        ledger.post(Account::Buoyancy, energy);
        for (axis, impulse) in ledger.water_impulse.iter_mut().enumerate() {
            *impulse += momentum[axis];
        }
    }

    /// Adds the forces of the water to those of the contacts.
    pub(super) fn soak(&mut self) {
        let time = self.time();
        let Some(wet) = &mut self.wet else { return };
        wet.time = time;
        self.water_flows = wet.act(&self.grains, &mut self.touch.blocks, self.gravity, self.walls_held);
    }

    /// Moves the stream by a step, under what the grains have taken from it.
    pub(super) fn flow_on(&mut self, ledger: &mut Ledger) {
        let held = self.walls_held;
        let Some(wet) = &mut self.wet else { return };
        let looks = self.step.is_multiple_of(EVERY);
        match &mut wet.water.stream {
            Stream::Coupled(coupled) if !held => {
                let mut turned = coupled.step(&wet.total, self.dt);
                if looks {
                    turned.lost += coupled.look(&self.grains.position, &self.grains.radius).lost;
                }
                ledger.post(Account::StreamWork, turned.work);
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
            Stream::Coupled(coupled) => coupled.stand(&wet.total),
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
