//! Touch: candidates into chunks, the law on the chunks, forces back to the grains.
//!
//! Every block of grains works alone: it walks its candidates, puts the touching ones into chunks, and gathers the forces
//! in its own `loads`: first for its own grains, then for grains of other blocks. Afterwards every grain adds what other
//! blocks hold for it, in the order of the blocks. Nothing here depends on the number of threads.

mod walls;

use super::memory::{Contacts, FRESH, Memory, WallKey};
use super::rows::{self, Rows};
use super::sieve::{Hits, Spheres};
use super::sweep::{Way, sweep};
use super::wet::{Bath, Soaked};
use crate::contact::chunk::{Chunk, ROWS};
use crate::contact::{Law, Table};
use crate::find::Candidates;
use crate::find::candidates::{List, shares};
use crate::state::Grains;
use crate::view::{Contact, WallLoad};
use crate::wall::{self, Wall};
use crate::water::Parcel;
use glam::{DVec3, Vec3};
use std::sync::{Mutex, PoisonError};
use walls::{react, walls};

/// Sums over contacts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Sums {
    /// Stored energy [J].
    pub stored: f64,
    /// Power lost in normal damping, sliding, rolling [W].
    pub lost: [f64; 3],
    /// Touching pairs.
    pub contacts: usize,
    /// Deepest overlap [m].
    pub deepest: f64,
}

impl Sums {
    pub fn add(&mut self, other: &Self) {
        self.stored += other.stored;
        for (a, b) in self.lost.iter_mut().zip(other.lost) {
            *a += b;
        }
        self.contacts += other.contacts;
        self.deepest = self.deepest.max(other.deepest);
    }

    /// Adds a correction of the losses [W], to each in proportion.
    pub fn correct(&mut self, correction: f64) {
        let total: f64 = self.lost.iter().map(|l| l.abs()).sum();
        if total > 0.0 {
            for lost in &mut self.lost {
                *lost += correction * lost.abs() / total;
            }
        }
    }
}

/// What contacts do to a grain: one line of the cache.
///
/// Grains are met in any order, by their own block and by others; across two lines each would wait twice. So the part of the
/// force that only corrects the books is in single precision.
#[derive(Clone, Copy, Debug, Default)]
#[repr(align(64))]
pub(super) struct Load {
    /// Force [N].
    pub force: DVec3,
    /// Torque [N.m].
    pub torque: DVec3,
    /// The part of the force that takes energy away: damping and friction [N].
    pub lossy: Vec3,
}

impl Load {
    #[inline]
    pub fn add(&mut self, other: &Self) {
        self.force += other.force;
        self.lossy += other.lossy;
        self.torque += other.torque;
    }
}

/// One block's contacts and what they do.
#[derive(Clone, Debug, Default)]
pub(super) struct Block {
    /// Of each law.
    pub memory: Vec<Memory>,
    /// Loads on own grains, then on those of the halo.
    pub loads: Vec<Load>,
    pub walls: Vec<WallLoad>,
    pub sums: Sums,
    pub soaked: Soaked,
}

/// All blocks, and a chunk for every thread.
#[derive(Debug, Default)]
pub(super) struct Touch {
    pub blocks: Vec<Block>,
    scratch: Vec<Mutex<Scratch>>,
}

/// What the touch phase reads.
#[derive(Clone, Copy)]
pub(super) struct Scene<'a> {
    pub grains: &'a Grains,
    pub walls: &'a [Wall],
    pub candidates: &'a Candidates,
    pub table: &'a Table,
    /// Gap at which bodies may still hold each other [m], of each law.
    pub reaches: &'a [f64],
    /// The widest of them [m].
    pub reach: f64,
    pub rotation: bool,
    pub dt: f64,
    pub bath: Option<Bath<'a>>,
}

/// Memory of one thread.
#[derive(Debug)]
struct Scratch {
    /// Of each law: what no part of a law writes stays zero in its chunk.
    rows: Vec<Rows>,
    /// What the contacts of the block will remember, of each law.
    next: Vec<Memory>,
    /// Contact of the last step that each row goes on from.
    old: [u32; ROWS],
    /// Keys of wall rows.
    keys: Vec<WallKey>,
    spheres: Spheres,
    hits: Hits,
    elements: Vec<u32>,
    touching: Vec<wall::Touch>,
    went_on: Vec<u32>,
    parcel: Parcel,
}

impl Scratch {
    fn new(laws: &[Law]) -> Self {
        Self {
            rows: laws.iter().map(|law| Rows::new(law.width())).collect(),
            next: laws.iter().map(|law| Memory::new(law.width())).collect(),
            old: [FRESH; ROWS],
            keys: Vec::with_capacity(ROWS),
            spheres: Spheres::default(),
            hits: Hits::default(),
            elements: Vec::with_capacity(64),
            touching: Vec::with_capacity(64),
            went_on: Vec::with_capacity(64),
            parcel: Parcel::default(),
        }
    }

    /// Makes room for what the contacts of the next block will remember.
    fn forget(&mut self, laws: &[Law]) {
        for (next, law) in self.next.iter_mut().zip(laws) {
            next.clear(law.width());
        }
    }
}

impl Touch {
    /// Prepares as many blocks as there are lists; called when the candidates have changed.
    pub fn fit(&mut self, scene: &Scene) {
        let laws = scene.table.laws();
        let lists = &scene.candidates.lists;
        self.blocks.resize_with(lists.len(), Block::default);
        // Blocks pass their memory on, so each is as large as the largest.
        let pairs = lists.iter().map(|list| list.pairs.len()).max().unwrap_or_default();
        for (block, list) in self.blocks.iter_mut().zip(lists) {
            block.loads.resize(list.own + list.halo.len(), Load::default());
            block.walls.resize(scene.walls.len(), WallLoad::default());
            if block.memory.is_empty() {
                block.memory.extend(laws.iter().map(|law| Memory::new(law.width())));
            }
            for (memory, _) in block.memory.iter_mut().zip(laws).filter(|(_, law)| law.width() > 0) {
                memory.pairs.reserve(pairs);
            }
        }
    }

    /// Evaluates all contacts, and what water does; returns the sums over contacts.
    pub fn forces(&mut self, scene: &Scene) -> Sums {
        // An engine may be moved to a pool with more threads than the one it was built in.
        while self.scratch.len() < rayon::current_num_threads() {
            self.scratch.push(Mutex::new(Scratch::new(scene.table.laws())));
        }
        let scratch = &self.scratch;
        let work = |(blocks, lists): (&mut [Block], &[List])| {
            let mine = rayon::current_thread_index().unwrap_or(0);
            // Nobody else has this thread's scratch, so the lock is free.
            let mut scratch = scratch[mine].lock().unwrap_or_else(PoisonError::into_inner);
            blocks[0].evaluate(scene, &lists[0], &mut scratch);
        };
        let row = (&mut self.blocks[..], &scene.candidates.lists[..]);
        sweep(row, Way::There, shares(scene.grains.len()), &work);
        let mut sums = Sums::default();
        for block in &self.blocks {
            sums.add(&block.sums);
        }
        sums
    }

    /// What the grains do to wall `k`.
    pub fn wall_load(&self, k: usize) -> WallLoad {
        let mut load = WallLoad::default();
        for block in &self.blocks {
            load.add(&block.walls[k]);
        }
        load
    }

    /// All contacts, evaluated anew at the present positions and velocities without changing what is remembered.
    pub fn contacts(&self, scene: &Scene) -> Vec<Contact> {
        // A step of length zero leaves the tangential springs as they are.
        let scene = Scene { dt: 0.0, ..*scene };
        let mut scratch = Scratch::new(scene.table.laws());
        let mut contacts = Vec::new();
        for (block, list) in self.blocks.iter().zip(&scene.candidates.lists) {
            let mut take = |rows: &Rows, wall: bool| {
                // What is only near, within the reach of a law, is no contact.
                for r in (0..rows.chunk.rows()).filter(|&r| rows.chunk.disc[r] > 0.0) {
                    let first = list.first + rows.first[r] as usize;
                    let second = if wall { rows.second[r] as usize } else { list.at[rows.second[r] as usize] as usize };
                    contacts.push(Contact {
                        first,
                        second,
                        wall,
                        position: scene.grains.position[first] + rows.point(r),
                        between: if wall { rows.point(r) } else { Chunk::vector(&rows.between, r) },
                        force: Chunk::vector(&rows.force, r),
                        normal: Chunk::vector(&rows.chunk.normal, r),
                        overlap: rows.chunk.overlap[r],
                    });
                }
            };
            let mut sums = Sums::default();
            pairs(&scene, list, &block.memory, &mut scratch, &mut sums, |rows| take(rows, false));
            walls(&scene, list, &block.memory, &mut scratch, &mut sums, |rows| take(rows, true));
            scratch.forget(scene.table.laws());
        }
        contacts
    }
}

impl Block {
    fn evaluate(&mut self, scene: &Scene, list: &List, scratch: &mut Scratch) {
        let Self { memory, loads, walls: wall_loads, sums, soaked } = self;
        loads.fill(Load::default());
        wall_loads.fill(WallLoad::default());
        *sums = Sums::default();
        pairs(scene, list, memory, scratch, sums, |rows| scatter(rows, loads, scene.rotation));
        walls(scene, list, memory, scratch, sums, |rows| react(scene, list, rows, loads, wall_loads));
        memory.swap_with_slice(&mut scratch.next);
        scratch.forget(scene.table.laws());
        // The grains are in the cache now.
        if let Some(bath) = &scene.bath {
            bath.soak(scene.grains, list.first, loads, soaked, &mut scratch.parcel);
        }
    }
}

/// Walks the grain-grain candidates of a block, law by law; `visit` sees every finished chunk.
fn pairs(
    scene: &Scene,
    list: &List,
    memory: &[Memory],
    scratch: &mut Scratch,
    sums: &mut Sums,
    mut visit: impl FnMut(&Rows),
) {
    let Scratch { spheres, hits, rows, old, next, .. } = scratch;
    spheres.place(scene.grains, list, &scene.candidates.shifts);
    hits.sieve(list, spheres, scene.reach);
    if scene.reaches.len() > 1 {
        hits.part(scene.grains, list, spheres, scene.table, scene.reaches);
    }
    for (k, (law, ((memory, next), rows))) in
        scene.table.laws().iter().zip(memory.iter().zip(next).zip(rows)).enumerate()
    {
        let width = law.width();
        let mut cursor = 0;
        let mut released = 0.0;
        for hits in hits.under(k).chunks(ROWS) {
            rows.gather(hits, scene.grains, list, spheres, scene.table, scene.rotation);
            rows.spheres(scene.rotation);
            if width > 0 {
                for (hit, old) in hits.iter().zip(&mut *old) {
                    let opened = skip(&memory.pairs.keys, &mut cursor, |k| *k < hit.candidate);
                    if !opened.is_empty() {
                        released += memory.pairs.held(opened, law);
                    }
                    let goes_on = memory.pairs.keys.get(cursor) == Some(&hit.candidate);
                    *old = if goes_on { Contacts::<u32>::place(cursor) } else { FRESH };
                    cursor += usize::from(goes_on);
                }
                memory.pairs.recall(&old[..hits.len()], &mut rows.chunk.history);
            }
            apply(scene, k, rows, sums);
            if width > 0 {
                next.pairs.keys.extend(hits.iter().map(|hit| hit.candidate));
                next.pairs.remember(hits.len(), &rows.chunk.history);
            }
            visit(rows);
        }
        if width > 0 {
            released += memory.pairs.held(cursor..memory.pairs.keys.len(), law);
            sums.lost[1] += released / scene.dt;
        }
    }
}

/// Moves `cursor` past the keys that `pass`; returns which they were.
fn skip<K>(keys: &[K], cursor: &mut usize, pass: impl Fn(&K) -> bool) -> std::ops::Range<usize> {
    let begin = *cursor;
    while *cursor < keys.len() && pass(&keys[*cursor]) {
        *cursor += 1;
    }
    begin..*cursor
}

/// Law `k` on a filled chunk, and its sums.
fn apply(scene: &Scene, k: usize, rows: &mut Rows, sums: &mut Sums) {
    let law = &scene.table.laws()[k];
    rows.constants(scene.table);
    if law.needs.roll || law.needs.twist {
        rows.rolling();
    }
    law.apply(&mut rows.chunk, scene.dt);
    rows.actions(scene.rotation);
    let c = &rows.chunk;
    let n = c.rows();
    let contacts = if scene.reaches[k] > 0.0 { c.overlap[..n].iter().filter(|d| **d > 0.0).count() } else { n };
    let ([stored, lost @ ..], deepest) = rows::sums(c);
    sums.add(&Sums { stored, lost, contacts, deepest });
}

/// Adds the forces of a chunk to both grains of every row.
fn scatter(rows: &Rows, loads: &mut [Load], rotation: bool) {
    for r in 0..rows.chunk.rows() {
        let force = Chunk::vector(&rows.force, r);
        let lossy = Chunk::vector(&rows.lossy, r).as_vec3();
        let first = &mut loads[rows.first[r] as usize];
        first.force += force;
        first.lossy += lossy;
        if rotation {
            first.torque += Chunk::vector(&rows.turn[0], r);
        }
        let second = &mut loads[rows.second[r] as usize];
        second.force -= force;
        second.lossy -= lossy;
        if rotation {
            second.torque += Chunk::vector(&rows.turn[1], r);
        }
    }
}
