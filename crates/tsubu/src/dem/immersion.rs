//! Immersion: the forces of the water on the grains join those of the contacts, block by block.

use super::bodies::Bodies;
use super::contact_forces::{BlockContacts, Load};
use super::engine::DemEngine;
use crate::contact::chunk::{Chunk, ROWS};
use crate::ledger::{Account, Ledger};
use crate::neighbours::block::BLOCK;
use crate::ranks::Reader;
use crate::state::Grains;
use crate::water::{EVERY, Gust, LayerReaction, Parcel, Stream, Submerged, Water, WaterPowers};
use glam::DVec3;

/// The water of a run.
#[derive(Debug)]
pub(super) struct Immersion {
    pub water: Water,
    /// What the water does to all grains.
    pub powers: WaterPowers,
    /// Force along x on the grains of every layer of a stream [N].
    reaction: Vec<f64>,
    /// Momentum along x of the water that grains have picked up in this step, by layers of a stream [N.s].
    entrained: Vec<f64>,
}

/// What passes between the water and one block.
#[derive(Clone, Debug, Default)]
pub(super) struct BlockImmersion {
    /// What the water does to its grains, where there is any.
    powers: Option<WaterPowers>,
    /// What the layers of a stream give to its grains along x.
    reaction: Vec<LayerReaction>,
    /// What was drawn for the water around each of the own grains, where it fluctuates.
    gusts: Vec<Gust>,
}

/// The water at a moment.
#[derive(Clone, Copy)]
pub(super) struct WaterAtTime<'a> {
    water: &'a Water,
    gravity: DVec3,
    time: f64,
    /// Whether the water is held still.
    held: bool,
}

impl BlockImmersion {
    /// Makes room for what this water does.
    pub fn prepare(&mut self, water: Option<&WaterAtTime>) {
        self.powers = water.map(|_| WaterPowers::default());
        let layers = water.map_or(0, |water| water.water.coupled_layers());
        self.reaction.resize(layers, LayerReaction::default());
    }

    /// Writes what the water does into a message.
    pub fn put_powers(&self, message: &mut Vec<f64>) {
        message.extend(self.powers.iter().flat_map(WaterPowers::numbers));
    }

    /// Takes it from a message.
    pub fn take_powers(&mut self, message: &mut Reader) {
        if let Some(powers) = &mut self.powers {
            *powers = WaterPowers::of_numbers(std::array::from_fn(|_| message.number()));
        }
    }

    /// Writes what the layers of a stream give into a message.
    pub fn put_reaction(&self, message: &mut Vec<f64>) {
        message.extend(self.reaction.iter().flatten().flatten());
    }

    /// Takes it from a message.
    pub fn take_reaction(&mut self, message: &mut Reader) {
        for number in self.reaction.iter_mut().flatten().flatten() {
            *number = message.number();
        }
    }
}

impl Immersion {
    pub fn new(water: Water) -> Self {
        let layers = water.coupled_layers();
        Self { water, powers: WaterPowers::default(), reaction: vec![0.0; layers], entrained: vec![0.0; layers] }
    }

    /// How many numbers a block tells other ranks: of what the water does, and before that of what the layers of a stream give.
    pub fn numbers_of_block(&self) -> [usize; 2] {
        [self.powers.numbers().len(), size_of::<LayerReaction>() / size_of::<f64>() * self.reaction.len()]
    }

    /// The water at a time; `held`: it is held still.
    pub fn at(&self, time: f64, gravity: DVec3, held: bool) -> WaterAtTime<'_> {
        WaterAtTime { water: &self.water, gravity, time, held }
    }

    /// Whether there is a stream that gives to the grains and takes from them.
    pub fn has_stream(&self) -> bool {
        self.water.coupled_layers() > 0
    }

    /// Its kinetic energy [J].
    pub fn stream_energy(&self) -> f64 {
        if let Stream::Coupled(coupled) = &self.water.stream { coupled.energy() } else { 0.0 }
    }

    /// Sums what the water has done to all blocks.
    pub fn sum_powers(&mut self, blocks: &[BlockContacts]) {
        self.powers = WaterPowers::default();
        for powers in blocks.iter().filter_map(|block| block.immersion.powers.as_ref()) {
            self.powers.add(powers);
        }
    }

    /// Sums what the grains of all blocks have taken from the layers of a stream.
    pub fn sum_reaction(&mut self, blocks: &[BlockContacts]) {
        self.reaction.fill(0.0);
        for block in blocks {
            let mut from_below = 0.0;
            for (taken, [even, odd]) in self.reaction.iter_mut().zip(&block.immersion.reaction) {
                let above = even[1] + odd[1];
                *taken += from_below + (even[0] + odd[0] - above);
                from_below = above;
            }
        }
    }
}

impl WaterAtTime<'_> {
    /// Adds the forces on the grains of a block that begins with grain `first` to its `loads`, parcel by parcel: those that
    /// forces move, then the others. What fixed grains feel is nobody's business but that of a stream, which they slow as well. A body of several
    /// pieces feels it at the first of them.
    pub fn apply_forces(
        &self,
        (grains, bodies): (&Grains, &Bodies),
        first: usize,
        loads: &mut [Load],
        immersion: &mut BlockImmersion,
        parcel: &mut Parcel,
    ) {
        let own = &grains.inverse_mass[first..(first + BLOCK).min(grains.len())];
        let BlockImmersion { powers, reaction, gusts } = immersion;
        let powers = powers.insert(WaterPowers::default());
        reaction.fill(LayerReaction::default());
        if self.water.fluctuation.is_some() {
            gusts.resize(BLOCK, Gust::default());
        }
        let slows = !reaction.is_empty();
        let mut forces = WaterForces { at: self, grains, bodies, first, loads, reaction, gusts, parcel };
        let fixed = own.iter().filter(|m| **m == 0.0).count();
        if fixed == 0 && bodies.is_empty() {
            // Nobody need be looked up in a list.
            for begin in (0..own.len()).step_by(ROWS) {
                forces.free((own.len() - begin).min(ROWS), |r| begin + r, powers);
            }
            return;
        }
        let sort = |fixed: bool| {
            let (mut rows, mut len) = ([0u16; BLOCK], 0);
            for (i, m) in own.iter().enumerate() {
                rows[len] = i as u16;
                len += usize::from((*m == 0.0) == fixed && !bodies.follows(first + i));
            }
            (rows, len)
        };
        let (rows, len) = sort(false);
        for rows in rows[..len].chunks(ROWS) {
            forces.free(rows.len(), |r| rows[r] as usize, powers);
        }
        if slows {
            let mut on_fixed = WaterPowers::default();
            let (rows, len) = sort(true);
            for rows in rows[..len].chunks(ROWS) {
                forces.act(rows.len(), |r| rows[r] as usize, &mut on_fixed);
            }
            powers.add_fixed(&on_fixed);
        }
    }
}

/// The forces of the water on a block of grains.
struct WaterForces<'a> {
    at: &'a WaterAtTime<'a>,
    grains: &'a Grains,
    bodies: &'a Bodies,
    first: usize,
    loads: &'a mut [Load],
    reaction: &'a mut [LayerReaction],
    gusts: &'a mut [Gust],
    parcel: &'a mut Parcel,
}

impl WaterForces<'_> {
    /// Forces on so many grains, of which `own` tells the places in the block, and what they take from a stream.
    fn act(&mut self, len: usize, own: impl Fn(usize) -> usize, powers: &mut WaterPowers) {
        let Self { at, grains, bodies, first, reaction, gusts, parcel, .. } = self;
        let WaterAtTime { water, time, held, .. } = **at;
        let rotates = water.rotates();
        parcel.len = len;
        for r in 0..parcel.rows() {
            let i = *first + own(r);
            let (mut height, mut seen) = (grains.position[i].z, Submerged::sphere(grains.radius[i]));
            let (mut velocity, mut spin) = (grains.velocity[i], grains.spin[i]);
            if let Some((body, arm)) = bodies.led_by(i) {
                (height, seen) = (height - arm.z, body.submerged);
                (velocity, spin) = (body.velocity, body.spin);
            }
            parcel.height[r] = height;
            (parcel.radius[r], parcel.sphericity[r]) = (seen.radius, seen.sphericity);
            Chunk::set(&mut parcel.velocity, r, velocity);
            if rotates {
                Chunk::set(&mut parcel.spin, r, spin);
            }
            if let Some(fluctuation) = &water.fluctuation {
                let fluctuation = fluctuation.at(&mut gusts[own(r)], grains.id[i], time);
                Chunk::set(&mut parcel.fluctuation, r, DVec3::from_array(fluctuation));
            }
        }
        water.act(parcel, powers, held);
        if !reaction.is_empty() {
            if water.fluctuation.is_some() && !held {
                powers.fluctuation += parcel.fluctuation_power();
            }
            parcel.react(reaction);
        }
    }

    /// The same for grains that forces move.
    fn free(&mut self, len: usize, own: impl Fn(usize) -> usize, powers: &mut WaterPowers) {
        self.act(len, &own, powers);
        // The step adds gravity to the acceleration; the added mass, which it moves too, has no weight.
        let water = self.at.water;
        let weight = water.added_mass * water.density * self.at.gravity;
        let rotates = water.rotates();
        for r in 0..self.parcel.rows() {
            let load = &mut self.loads[own(r)];
            let force = self.parcel.total(r) - weight * self.parcel.volume[r];
            load.force += force;
            if rotates {
                load.torque += self.parcel.total_torque(r);
            }
            // It acts at the centre of mass.
            if let Some((_, arm)) = self.bodies.led_by(self.first + own(r)) {
                load.torque -= arm.cross(force);
            }
        }
    }
}

/// Gives every grain from a `level` [m] upwards the added mass of where it is. `gains` hears of each at
/// which height what momentum [N.s] that water has gained, and with which velocity: `ahead` [s] of its last acceleration less
/// than it has.
fn update_added_mass(
    (grains, bodies): (&mut Grains, &mut Bodies),
    water: &Water,
    level: f64,
    ahead: f64,
    mut gains: impl FnMut(f64, DVec3, DVec3),
) {
    for first in (0..grains.len()).step_by(ROWS) {
        let rows = first..(first + ROWS).min(grains.len());
        // Counting needs no branches: where all are deep it is all there is to do.
        if grains.position[rows.clone()].iter().filter(|p| p.z >= level).count() == 0 {
            continue;
        }
        for i in rows {
            let height = grains.position[i].z;
            if height < level || grains.inverse_mass[i] == 0.0 || grains.inertia[i] == 0.0 {
                continue;
            }
            let added = water.added_mass(grains.radius[i], height);
            let velocity = grains.velocity[i] - ahead * grains.acceleration[i];
            gains(height, (added - grains.added_mass(i)) * velocity, velocity);
            grains.inverse_mass[i] = 1.0 / (grains.mass[i] + added);
        }
    }
    bodies.add_mass(grains, |body, height| {
        let added = water.added_mass(body.submerged.radius, height);
        let velocity = body.velocity - ahead * body.acceleration;
        gains(height, (added - body.added_mass) * velocity, velocity);
        added
    });
}

impl DemEngine {
    /// Gives every grain the added mass of where it begins.
    pub(super) fn init_added_mass(&mut self) {
        if let Some(immersion) = &self.immersion {
            let bodies = &mut self.integration.bodies;
            bodies.find(&self.grains);
            let all = (&mut self.grains, bodies);
            update_added_mass(all, &immersion.water, f64::NEG_INFINITY, 0.0, |_, _, _| ());
        }
    }

    /// The same within a step, where there is a surface to go through.
    pub(super) fn update_added_mass(&mut self, ledger: &mut Ledger) {
        let ahead = self.integration.predicted_for(self.clock.dt);
        let Some(immersion) = self.immersion.as_mut().filter(|immersion| immersion.water.has_surface()) else { return };
        let Immersion { water, entrained, .. } = immersion;
        entrained.fill(0.0);
        let layers = water.stream.layers().filter(|_| !entrained.is_empty());
        // Whatever is a diameter down now has been under water in the last step as well. The mass changes between the two halves of
        // the step, so what it brings has the velocity between them, not the predicted one.
        let level = water.surface() - self.limits.largest_diameter;
        let all = (&mut self.grains, &mut self.integration.bodies);
        update_added_mass(all, water, level, ahead, |height, momentum, velocity| {
            ledger.post(Account::Buoyancy, 0.5 * momentum.dot(velocity));
            for (axis, impulse) in ledger.water_impulse.iter_mut().enumerate() {
                *impulse += momentum[axis];
            }
            if let Some(layers) = layers {
                let (below, share) = layers.at(height);
                entrained[below] += momentum.x * (1.0 - share);
                entrained[below + 1] += momentum.x * share;
            }
        });
    }

    /// Moves the stream by a step, under the reaction of the grains.
    pub(super) fn advance_stream(&mut self, ledger: &mut Ledger) {
        let dt = self.clock.dt;
        let Some(immersion) = &mut self.immersion else { return };
        let looks = self.clock.step.is_multiple_of(EVERY);
        if looks {
            self.ranks.gather_positions(&mut self.grains);
        }
        match &mut immersion.water.stream {
            Stream::Coupled(coupled) if !self.clock.settling => {
                let mut turned = coupled.step(&immersion.reaction, &immersion.entrained, dt);
                if looks {
                    let seconds = EVERY as f64 * dt;
                    let (position, radius) = self.integration.bodies.spheres_in_water(&self.grains);
                    let mixed = coupled.look(&position, &radius, seconds);
                    (turned.work, turned.lost) = (turned.work + mixed.work, turned.lost + mixed.lost);
                }
                ledger.post(Account::StreamWork, turned.work);
                ledger.post(Account::Buoyancy, -turned.picked);
                ledger.post(Account::StreamFriction, turned.lost);
            }
            Stream::Column { layers, .. } if looks => {
                let (position, radius) = self.integration.bodies.spheres_in_water(&self.grains);
                layers.porosity = layers.measure(&position, &radius);
            }
            _ => {}
        }
    }

    /// The stream at a moment that no step has led to: grains stand where they stand.
    pub(super) fn evaluate_stream_at_rest(&mut self) {
        let Some(immersion) = &mut self.immersion else { return };
        match &mut immersion.water.stream {
            Stream::Coupled(coupled) => coupled.stand(&immersion.reaction),
            Stream::Column { .. } | Stream::Still | Stream::LogLaw { .. } | Stream::Table { .. } => {}
        }
    }

    /// Porosity of the layers of the water, before anything moves.
    pub(super) fn init_porosity(&mut self) {
        let Some(immersion) = &mut self.immersion else { return };
        let (position, radius) = self.integration.bodies.spheres_in_water(&self.grains);
        match &mut immersion.water.stream {
            Stream::Coupled(coupled) => coupled.init_porosity(&position, &radius),
            Stream::Column { layers, .. } => layers.porosity = layers.measure(&position, &radius),
            Stream::Still | Stream::LogLaw { .. } | Stream::Table { .. } => {}
        }
    }
}
