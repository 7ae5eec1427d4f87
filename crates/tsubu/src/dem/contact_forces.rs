//! Contact forces: touching pairs into batches, the law on the batches, forces back to the grains.
//!
//! Every block of grains works alone: it walks its neighbour list, puts the touching pairs into batches, and gathers the forces
//! in its own `loads`: first for its own grains, then for the grains of its halo. Afterwards every grain adds what other
//! blocks hold for it, in the order of the blocks. Nothing here depends on the number of threads.

mod features;
mod list;
mod pairs;
mod sums;
mod walls;

pub(super) use list::each_contact;
pub(super) use sums::{ContactLosses, ContactSums};

use super::bodies::Bodies;
use super::bonds::Bonds;
use super::contact_batch::{self, ContactBatch};
use super::contact_history::{ContactHistory, FRESH, HistoryColumns, WallKey};
use super::features::PairFeatures;
use super::immersion::{BlockImmersion, WaterAtTime};
use super::narrow_phase::{Spheres, TouchingPairs};
use super::outside::Outside;
use super::ranks::Ranks;
use super::shapes::PairShapes;
use super::sweep::{Direction, sweep};
use super::wall_shapes::WallShapes;
use crate::check;
use crate::contact::chunk::ROWS;
use crate::contact::{Law, Table};
use crate::neighbours::NeighbourLists;
use crate::neighbours::block::{BLOCK, BlockList, blocks_at_once};
use crate::partner::Hosts;
use crate::polyhedron::near::Near;
use crate::ranks::Reader;
use crate::state::Grains;
use crate::threads::shares;
use crate::view::WallLoad;
use crate::wall::Wall;
use crate::water::Parcel;
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};
use tsubu_scene::plan::{Plan, SlipLever};

/// The contact laws of a scene, and how far they reach.
#[derive(Debug)]
pub(super) struct ContactLaws {
    pub table: Table,
    /// Gap at which bodies may still hold each other [m], of each law.
    pub reaches: Vec<f64>,
    /// Whether grains rotate.
    pub rotation: bool,
    /// Share of the overlap that arms of the tangential force leave out of the radius.
    pub lever_share: f64,
}

impl ContactLaws {
    /// With the gaps of the widest pairs that the plan can bring together.
    pub fn new(plan: &Plan, table: Table, hosts: &Hosts) -> Self {
        let mut reaches = vec![0.0f64; table.laws().len()];
        for (a, b) in check::bodies(plan, &table, hosts).pairs() {
            let law = table.law(table.index(a.material, b.material));
            // Whether large or small grains hold each other over the wider gap is the law's business.
            let largest = table.pair((a.material, a.largest, a.mass), (b.material, b.largest, b.mass));
            for pair in [table.pair(a.body(), b.body()), largest] {
                reaches[law] = reaches[law].max(table.laws()[law].reach(&pair));
            }
        }
        let lever_share = match plan.contact.slip_lever {
            SlipLever::Middle => 0.5,
            SlipLever::Radius => 0.0,
        };
        Self { table, reaches, rotation: plan.contact.rotation, lever_share }
    }

    /// The widest gap at which bodies may still hold each other [m].
    pub fn reach(&self) -> f64 {
        self.reaches.iter().copied().fold(0.0, f64::max)
    }

    /// The different laws; in most scenes one.
    #[inline]
    pub fn all(&self) -> &[Law] {
        self.table.laws()
    }

    /// Columns of history of the law that has most.
    pub fn history_width(&self) -> usize {
        self.all().iter().map(Law::width).max().unwrap_or_default()
    }
}

/// What contact forces are computed from.
#[derive(Clone, Copy)]
pub(super) struct ForceInput<'a> {
    pub grains: &'a Grains,
    pub bodies: &'a Bodies,
    pub walls: &'a [Wall],
    pub neighbours: &'a NeighbourLists,
    pub laws: &'a ContactLaws,
    /// Time step [s].
    pub dt: f64,
    /// Whether this is a moment and no step: see [`Chunk::moment`].
    pub moment: bool,
    /// See [`Chunk::completion`] [s].
    pub completion: f64,
    pub water: Option<WaterAtTime<'a>>,
}

/// What contacts do to a grain: one line of the cache.
///
/// Grains are met in any order, by their own block and by others; across two lines each would wait twice. So the part of the
/// force that only corrects the energies is in single precision.
#[derive(Clone, Copy, Debug, Default)]
#[repr(align(64))]
pub(super) struct Load {
    /// Force [N].
    pub force: DVec3,
    /// Torque [N.m].
    pub torque: DVec3,
    /// The dissipative part of the force: damping and friction [N].
    pub dissipative: Vec3,
}

impl Load {
    #[inline]
    pub fn add(&mut self, other: &Self) {
        self.force += other.force;
        self.dissipative += other.dissipative;
        self.torque += other.torque;
    }
}

/// The contacts of one block and what they do.
#[derive(Clone, Debug, Default)]
pub(super) struct BlockContacts {
    /// Of each law.
    pub history: Vec<ContactHistory>,
    /// Loads on own grains, then on those of the halo.
    pub loads: Vec<Load>,
    /// Loads on the walls.
    pub walls: Vec<WallLoad>,
    pub sums: ContactSums,
    pub immersion: BlockImmersion,
    /// Which features of its polyhedra may touch soon.
    near: Near,
}

/// The contacts of all blocks.
#[derive(Debug, Default)]
pub(super) struct ContactForces {
    pub blocks: Vec<BlockContacts>,
    pub sums: ContactSums,
    /// Energy of contacts that a rebuild of the neighbour lists has found gone [J].
    pub released: f64,
    /// What holds grains together besides contacts.
    pub bonds: Bonds,
    /// Forces on grains that no contact exerts.
    pub outside: Outside,
    /// A batch for every thread.
    scratch: Vec<Mutex<Scratch>>,
}

/// What one thread works with.
#[derive(Debug)]
struct Scratch {
    /// Of each law: what no part of a law writes stays zero in its chunk.
    batches: Vec<ContactBatch>,
    /// What contacts with walls remember from the last step.
    wall_history: HistoryColumns<WallKey>,
    /// Of them, which one each row of a chunk goes on from.
    old: [u32; ROWS],
    /// Keys of wall rows.
    keys: Vec<WallKey>,
    spheres: Spheres,
    touching_pairs: TouchingPairs,
    shapes: PairShapes,
    wall_shapes: WallShapes,
    features: PairFeatures,
    elements: Vec<u32>,
    went_on: Vec<u32>,
    parcel: Parcel,
}

impl Scratch {
    fn new(laws: &[Law]) -> Self {
        Self {
            batches: laws.iter().map(|law| ContactBatch::new(law.width())).collect(),
            wall_history: HistoryColumns::default(),
            old: [FRESH; ROWS],
            keys: Vec::with_capacity(ROWS),
            spheres: Spheres::default(),
            touching_pairs: TouchingPairs::default(),
            shapes: PairShapes::default(),
            wall_shapes: WallShapes::default(),
            features: PairFeatures::default(),
            elements: Vec::with_capacity(64),
            went_on: Vec::with_capacity(64),
            parcel: Parcel::default(),
        }
    }
}

impl ContactForces {
    /// Beside bonds.
    pub fn beside(bonds: Bonds) -> Self {
        Self { bonds, ..Self::default() }
    }

    /// Prepares as many blocks as there are neighbour lists; called when these have been rebuilt.
    pub fn resize(&mut self, input: &ForceInput) {
        let laws = input.laws.all();
        let (lists, own) = (&input.neighbours.lists, input.neighbours.own());
        self.blocks.resize_with(lists.len(), BlockContacts::default);
        let blocks = self.blocks.par_iter_mut().zip(lists).with_min_len(blocks_at_once(input.grains.len()));
        blocks.for_each(|(block, list)| {
            block.walls.resize(input.walls.len(), WallLoad::default());
            block.immersion.prepare(input.water.as_ref());
            // Of a block of another rank its loads on own grains alone are here, as they come.
            if !own.contains(&(list.first / BLOCK)) {
                (block.history, block.loads) = Default::default();
                return;
            }
            let loads = list.own + list.halo.len();
            block.loads.reserve_exact(loads.saturating_sub(block.loads.len()));
            block.loads.resize(loads, Load::default());
            block.near.forget(if input.bodies.faceted() { list.pairs.len() } else { 0 });
            if block.history.is_empty() {
                block.history.extend(laws.iter().map(|law| ContactHistory::new(law.width())));
            }
        });
    }

    /// Other laws hold from now on: batches keep the constants of the last pair of materials.
    pub fn forget_laws(&mut self) {
        self.scratch.clear();
        self.blocks.iter_mut().for_each(|block| block.near.forget_all());
    }

    /// Evaluates all contacts, and the forces of the water. What other ranks have summed is not here yet.
    pub fn evaluate(&mut self, input: &ForceInput, ranks: &mut Ranks) {
        // An engine may be moved to a pool with more threads than the one it was built in.
        while self.scratch.len() < rayon::current_num_threads() {
            self.scratch.push(Mutex::new(Scratch::new(input.laws.all())));
        }
        let (scratch, shares, lists) = (&self.scratch, shares(input.grains.len()), &input.neighbours.lists);
        let evaluate = |blocks: &mut [BlockContacts], range: Range<usize>, asked: &(dyn Fn(usize) -> bool + Sync)| {
            let range = (&mut blocks[range.clone()], &lists[range]);
            sweep(range, Direction::Forward, shares, &|(blocks, lists): (&mut [BlockContacts], &[BlockList])| {
                if !asked(lists[0].first / BLOCK) {
                    return;
                }
                let mine = rayon::current_thread_index().unwrap_or(0);
                // Nobody else has this thread's scratch, so the lock is free.
                let mut scratch = scratch[mine].lock().unwrap_or_else(PoisonError::into_inner);
                blocks[0].evaluate(input, &lists[0], &mut scratch);
            });
        };
        ranks.share_loads(&mut self.blocks, input.neighbours.own(), evaluate);
    }

    /// Adds up what all blocks have summed.
    pub fn add_up(&mut self) {
        self.sums = ContactSums::default();
        for block in &self.blocks {
            self.sums.add(&block.sums);
        }
    }

    /// What the grains do to wall `k`.
    pub fn wall_load(&self, k: usize) -> WallLoad {
        let mut load = WallLoad::default();
        for block in &self.blocks {
            load.add(&block.walls[k]);
        }
        load
    }
}

impl BlockContacts {
    /// Writes what it has summed into a message: contacts, loads on walls, what the water does.
    pub fn put_sums(&self, message: &mut Vec<f64>) {
        self.sums.put(message);
        for load in &self.walls {
            message.extend([load.force, load.torque].iter().flat_map(DVec3::to_array));
        }
        self.immersion.put_powers(message);
    }

    /// Takes it from a message.
    pub fn take_sums(&mut self, message: &mut Reader) {
        self.sums.take(message);
        for load in &mut self.walls {
            (load.force, load.torque) = (message.vector(), message.vector());
        }
        self.immersion.take_powers(message);
    }

    fn evaluate(&mut self, input: &ForceInput, list: &BlockList, scratch: &mut Scratch) {
        let Self { history, loads, walls, sums, immersion, near } = self;
        let rotation = input.laws.rotation;
        loads.fill(Load::default());
        walls.fill(WallLoad::default());
        *sums = ContactSums::default();
        std::mem::swap(near, &mut scratch.features.near);
        pairs::evaluate(input, list, history, scratch, sums, |batch| pairs::scatter(batch, loads, rotation));
        features::evaluate(input, list, history, scratch, sums, |batch| pairs::scatter(batch, loads, rotation));
        walls::evaluate(input, list, history, scratch, sums, |batch| walls::scatter(input, list, batch, loads, walls));
        std::mem::swap(near, &mut scratch.features.near);
        // The grains are in the cache now.
        if let Some(water) = &input.water {
            water.apply_forces((input.grains, input.bodies), list.first, loads, immersion, &mut scratch.parcel);
        }
    }
}

/// Power [W] at which an energy [J] goes within a step; in a moment there is none.
fn power(energy: f64, input: &ForceInput) -> f64 {
    if input.moment { 0.0 } else { energy / input.dt }
}

/// Law `number` on a filled batch, and its sums.
fn apply_law(input: &ForceInput, number: usize, batch: &mut ContactBatch, sums: &mut ContactSums) {
    let law = &input.laws.all()[number];
    batch.constants(&input.laws.table);
    if law.needs.roll || law.needs.twist {
        batch.relative_spin();
    }
    (batch.chunk.completion, batch.chunk.rotation) = (input.completion, input.laws.rotation);
    batch.chunk.moment = input.moment;
    law.apply(&mut batch.chunk, input.dt);
    batch.forces_and_torques(input.laws.rotation);
    let c = &batch.chunk;
    let n = c.rows();
    let adheres = input.laws.reaches[number] > 0.0;
    let contacts = if adheres { c.overlap[..n].iter().filter(|d| **d > 0.0).count() } else { n };
    let ([stored, normal, sliding, rolling], deepest) = contact_batch::sums(c);
    sums.add(&ContactSums { stored, lost: ContactLosses { normal, sliding, rolling }, contacts, deepest });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::DemEngine;
    use crate::engine::Engine as _;
    use crate::ledger::Ledger;
    use crate::partner::Hosts;
    use std::path::Path;
    use tsubu_scene::Scene;

    /// At a moment without a step the springs of contacts that have opened were posted over a time of zero: infinitely many watts.
    #[test]
    fn contacts_that_open_in_no_time_lose_no_power() {
        let text = "duration = '1 ms'\n[materials.glass]\nyoung-modulus = '1 MPa'\nfriction = 0.5\n\
                    [contact.tangential.mindlin]\n[particles.balls]\nmaterial = 'glass'\ndiameter = '2 mm'\nmass = '10 mg'\n\
                    start.at = { position = [[0, '1 mm'], ['1.99 mm', '1.2 mm']], velocity = [[0.1, 0], [-0.1, 0]] }\n";
        let scene = Scene::parse("scene.toml", text, Path::new(""), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
        let mut engine = DemEngine::new(scene.plan(), &Hosts::default()).unwrap_or_else(|error| panic!("{error}"));
        let stepped = engine.advance(10, &mut Hosts::default(), &mut Ledger::default());
        assert!(stepped.is_ok() && engine.contacts.sums.stored > 0.0);
        let energy = |engine: &DemEngine| {
            let history = &engine.contacts.blocks[0].history[0].pairs;
            history.stored_energy(0..history.keys.len(), &engine.laws.all()[0])
        };
        assert!(energy(&engine) > 0.0, "the tangential spring is stretched");
        engine.grains.position[1].x += 1e-3;
        let (mut contacts, input) = (std::mem::take(&mut engine.contacts), engine.force_input());
        contacts.evaluate(&ForceInput { moment: true, ..input }, &mut Ranks::default());
        contacts.add_up();
        assert_eq!(contacts.sums.contacts, 0);
        assert_eq!(contacts.sums.lost, ContactLosses::default());
    }
}
