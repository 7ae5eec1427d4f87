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
    scratch: Vec<Mutex<Parcel>>,
    /// Of every block.
    effects: Vec<Effect>,
    /// Force along x on the grains of every layer of a stream [N].
    taken: Vec<f64>,
}

/// What one block does to the water.
#[derive(Debug)]
struct Effect {
    flows: Flows,
    /// Force along x on its grains, by layers of a stream [N].
    taken: Vec<f64>,
}

/// When the water acts, and on what.
struct Moment<'a> {
    grains: &'a Grains,
    gravity: DVec3,
    time: f64,
    /// Whether the water is held still.
    held: bool,
}

impl Wet {
    pub fn new(water: Water) -> Self {
        let layers = if let Stream::Coupled(coupled) = &water.stream { coupled.layers.len() } else { 0 };
        Self { water, scratch: Vec::new(), effects: Vec::new(), taken: vec![0.0; layers] }
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
    fn act(&mut self, moment: &Moment, blocks: &mut [Block]) -> Flows {
        let Self { water, scratch, effects, taken } = self;
        while scratch.len() < rayon::current_num_threads() {
            scratch.push(Mutex::default());
        }
        effects.resize_with(blocks.len(), || Effect { flows: Flows::default(), taken: vec![0.0; taken.len()] });
        let (water, scratch) = (&*water, &*scratch);
        let work = |(number, (block, effect)): (usize, (&mut Block, &mut Effect))| {
            let mine = rayon::current_thread_index().unwrap_or(0);
            // Nobody else has this thread's parcel, so the lock is free.
            let mut parcel = scratch[mine].lock().unwrap_or_else(PoisonError::into_inner);
            block_of_grains(water, moment, number * BLOCK, block, effect, &mut parcel);
        };
        if moment.grains.len() >= WORTH_THREADS && rayon::current_num_threads() > 1 {
            blocks.par_iter_mut().zip(effects.par_iter_mut()).enumerate().with_max_len(1).for_each(work);
        } else {
            blocks.iter_mut().zip(effects.iter_mut()).enumerate().for_each(work);
        }
        taken.fill(0.0);
        let mut flows = Flows::default();
        for effect in effects {
            flows.add(&effect.flows);
            for (taken, effect) in taken.iter_mut().zip(&effect.taken) {
                *taken += effect;
            }
        }
        flows
    }
}

/// The grains of one block, parcel by parcel: those that forces move, then the others. What fixed grains feel is nobody's
/// business but that of a stream, which they slow as well.
fn block_of_grains(
    water: &Water,
    moment: &Moment,
    first: usize,
    block: &mut Block,
    effect: &mut Effect,
    parcel: &mut Parcel,
) {
    let grains = moment.grains;
    let (turns, slows) = (water.turns(), !effect.taken.is_empty());
    let last = (first + BLOCK).min(grains.len());
    if water.fluctuation.is_some() {
        block.gusts.resize(BLOCK, Gust::default());
    }
    effect.flows = Flows::default();
    effect.taken.fill(0.0);
    let mut on_fixed = Flows::default();
    let mut left = last - first;
    for fixed in [false, true] {
        if left == 0 || fixed && !slows {
            break;
        }
        let mut rest = (first..last).filter(|i| (grains.inverse_mass[*i] == 0.0) == fixed);
        loop {
            let mut row = [0u16; ROWS];
            parcel.len = 0;
            for (r, i) in rest.by_ref().take(ROWS).enumerate() {
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
                    let gust = fluctuation.at(&mut block.gusts[i - first], grains.id[i], moment.time);
                    for (column, gust) in parcel.gust.iter_mut().zip(gust) {
                        column[r] = gust;
                    }
                }
                parcel.len = r + 1;
            }
            if parcel.len == 0 {
                break;
            }
            left -= parcel.len;
            water.act(parcel, if fixed { &mut on_fixed } else { &mut effect.flows }, moment.held);
            if slows {
                if water.fluctuation.is_some() && !moment.held {
                    let flows = if fixed { &mut on_fixed } else { &mut effect.flows };
                    flows.gust += parcel.gust_power();
                }
                parcel.give(&mut effect.taken);
            }
            if fixed {
                continue;
            }
            // The step adds gravity to the acceleration; the added mass, which it moves too, has no weight.
            parcel.weigh(water.added_mass * water.density, moment.gravity);
            for (r, own) in row.iter().take(parcel.len).enumerate() {
                let load = &mut block.loads[*own as usize];
                load.force += parcel.total(r);
                if turns {
                    load.torque += parcel.total_torque(r);
                }
            }
        }
    }
    effect.flows.add_fixed(&on_fixed);
}

impl DemEngine {
    /// Gives every grain the added mass of where it is, but those `deep` radii and more below the surface. Returns what the
    /// motion of that water has gained: energy [J] and momentum [N.s], where velocities are ahead of the moment by their last
    /// acceleration over `ahead` [s].
    pub(super) fn immerse(&mut self, deep: f64, ahead: f64) -> (f64, DVec3) {
        let Some(wet) = &self.wet else { return Default::default() };
        let grains = &mut self.grains;
        let (mut energy, mut momentum) = (0.0, DVec3::ZERO);
        let surface = wet.water.surface();
        for i in 0..grains.len() {
            let under = surface - grains.position[i].z > deep * grains.radius[i];
            if under || grains.inverse_mass[i] == 0.0 {
                continue;
            }
            let added = wet.water.added_mass(grains.radius[i], grains.position[i].z);
            let velocity = grains.velocity[i] - ahead * grains.acceleration[i];
            let gained = (added - grains.added_mass(i)) * velocity;
            energy += 0.5 * gained.dot(velocity);
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
        // Whatever is two radii down now has been under water in the last step as well. The mass changes between the two halves of
        // the step, so what it brings has the velocity between them, not the predicted one.
        let (energy, momentum) = self.immerse(2.0, self.motion(self.dt).predicts());
        ledger.post(Account::Buoyancy, energy);
        for (axis, impulse) in ledger.water_impulse.iter_mut().enumerate() {
            *impulse += momentum[axis];
        }
    }

    /// Adds the forces of the water to those of the contacts.
    pub(super) fn soak(&mut self) {
        let time = self.time();
        let Some(wet) = &mut self.wet else { return };
        let moment = Moment { grains: &self.grains, gravity: self.gravity, time, held: self.walls_held };
        self.water_flows = wet.act(&moment, &mut self.touch.blocks);
    }

    /// Moves the stream by a step, under what the grains have taken from it.
    pub(super) fn flow_on(&mut self, ledger: &mut Ledger) {
        let held = self.walls_held;
        let Some(wet) = &mut self.wet else { return };
        let looks = self.step.is_multiple_of(EVERY);
        match &mut wet.water.stream {
            Stream::Coupled(coupled) if !held => {
                let mut turned = coupled.step(&wet.taken, self.dt);
                if looks {
                    let seconds = EVERY as f64 * self.dt;
                    let mixed = coupled.look(&self.grains.position, &self.grains.radius, seconds);
                    (turned.work, turned.lost) = (turned.work + mixed.work, turned.lost + mixed.lost);
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
