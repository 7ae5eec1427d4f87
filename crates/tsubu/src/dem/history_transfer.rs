//! Contact history over a rebuild of the neighbour lists, and in a checkpoint: by the ids of the bodies, since indices change.
//!
//! Every block hands over its own contacts, and is filled from what belongs to it: both on many threads.

use super::contact_forces::{BlockContacts, ContactForces, ForceInput};
use super::contact_history::{ContactHistory, FeatureKey, WallKey};
use super::ranks::Ranks;
use super::sweep::{Direction, sweep};
use crate::contact::Law;
use crate::mutation::{Mutation, left_out};
use crate::neighbours::NeighbourLists;
use crate::neighbours::block::{BLOCK, BlockList, blocks_at_once};
use crate::polyhedron::contact::turned_feature;
use crate::ranks::Reader;
use crate::threads::{self, piece, shares};
use crate::wall::Wall;
use rayon::prelude::*;
use std::sync::atomic::{AtomicU32, Ordering};

/// A remembered contact by the ids of its bodies. For a wall the second number is the wall, and `patch` tells the place
/// on it; between grains it tells the features of polyhedra, and is 0 for others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ContactId {
    pub first: u32,
    pub second: u32,
    pub wall: bool,
    pub patch: u32,
    /// Number of its law; follows from the materials, so a checkpoint does not have it.
    pub law: u32,
}

impl ContactId {
    fn put(&self, history: &[f64], message: &mut Vec<f64>) {
        let Self { first, second, wall, patch, law } = *self;
        message.extend([first, second, u32::from(wall), patch, law].map(f64::from));
        message.extend(history);
    }

    fn take(message: &mut Reader) -> Self {
        let [first, second, wall, patch, law] = std::array::from_fn(|_| message.number() as u32);
        Self { first, second, wall: wall != 0, patch, law }
    }
}

/// The contact history of all blocks by ids.
#[derive(Debug)]
pub(super) struct HistorySnapshot {
    pub blocks: Vec<BlockHistory>,
    /// Whether every rank has all contacts, as from a checkpoint.
    whole: bool,
}

/// The contact history of one block, or of a checkpoint.
#[derive(Clone, Debug, Default)]
pub(super) struct BlockHistory {
    pub contacts: Vec<ContactId>,
    /// As many numbers a contact as the widest law has columns of history.
    pub history: Vec<f64>,
    /// Where they belong now, in order.
    destinations: Vec<Destination>,
    /// Numbers of those that belong to no list that was made here.
    missing: Vec<u32>,
}

/// Where a remembered contact belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Destination {
    block: u32,
    key: Key,
    /// Its number where it comes from.
    from: u32,
}

/// A contact of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Key {
    /// By number of the pair in the neighbour list.
    Pair(u32),
    Feature(FeatureKey),
    Wall(WallKey),
}

#[derive(Clone, Debug)]
struct Run {
    block: u32,
    from: usize,
    destinations: std::ops::Range<usize>,
}

/// The index of a grain that is there no more.
const REMOVED: u32 = u32::MAX;

/// What tells where contacts belong.
struct Lookup<'a> {
    index: &'a [AtomicU32],
    neighbours: &'a NeighbourLists,
    walls: &'a [Wall],
    laws: &'a [Law],
    width: usize,
}

impl ContactForces {
    /// Snapshot of every contact's history, in the order of blocks.
    pub fn snapshot_history(&self, input: &ForceInput) -> HistorySnapshot {
        let width = input.laws.history_width();
        let own = if width == 0 { 0..0 } else { input.neighbours.own() };
        let lists = &input.neighbours.lists[own.clone()];
        let mut histories = vec![BlockHistory::default(); lists.len()];
        let (id, blocks) = (&input.grains.id, &self.blocks);
        let range = (&mut histories[..], lists);
        sweep(range, Direction::Forward, shares(id.len()), &|(of, lists): (&mut [BlockHistory], &[BlockList])| {
            of[0].record(&blocks[lists[0].first / BLOCK], &lists[0], id, width);
        });
        HistorySnapshot { blocks: histories, whole: false }
    }

    /// The contacts of all ranks by ids, in the order of blocks, on the first of them: of each the bodies, whether the second is a wall, and the
    /// patch; and what they remember.
    pub fn by_id(&self, input: &ForceInput, ranks: &Ranks) -> (Vec<u32>, Vec<f64>) {
        let width = input.laws.history_width();
        if width == 0 {
            return Default::default();
        }
        let contacts = if ranks.is_first() { self.sums.contacts } else { 0 };
        let (mut ids, mut histories) = (Vec::with_capacity(4 * contacts), Vec::with_capacity(width * contacts));
        let mut block = BlockHistory::default();
        ranks.tell_first(
            input.neighbours.own(),
            |blocks, message| {
                for number in blocks {
                    block.record(&self.blocks[number], &input.neighbours.lists[number], &input.grains.id, width);
                    for (contact, history) in block.contacts.iter().zip(block.history.chunks_exact(width)) {
                        contact.put(history, message);
                    }
                }
            },
            |message| {
                while !message.is_at_end() {
                    let ContactId { first, second, wall, patch, law: _ } = ContactId::take(message);
                    ids.extend([first, second, u32::from(wall), patch]);
                    histories.extend(message.numbers(width));
                }
            },
        );
        (ids, histories)
    }

    /// Gives the pairs of new neighbour lists the histories they had; a pair whose bodies have changed places gets its turned.
    /// Returns the stored energy of contacts whose body is gone, or whose pair is in no list any more [J].
    pub fn restore_history(&mut self, input: &ForceInput, snapshot: HistorySnapshot, ranks: &mut Ranks) -> f64 {
        let width = input.laws.history_width();
        if width == 0 {
            return 0.0;
        }
        let (laws, ids) = (input.laws.all(), &input.grains.id);
        let shares = shares(ids.len());
        let HistorySnapshot { blocks: mut parts, whole } = snapshot;
        let piece = piece(ids.len());
        // Index of the grain with each id.
        let mut index = Vec::new();
        index.resize_with(ids.par_iter().with_min_len(piece).max().map_or(0, |m| *m as usize + 1), AtomicU32::default);
        index.par_iter_mut().with_min_len(piece).for_each(|i| *i.get_mut() = REMOVED);
        if !left_out(Mutation::HistoryTransfer) {
            let ids = ids.par_iter().enumerate().with_min_len(piece);
            ids.for_each(|(i, id)| index[*id as usize].store(i as u32, Ordering::Relaxed));
        }
        let lookup = Lookup { index: &index, neighbours: input.neighbours, walls: input.walls, laws, width };
        threads::each(&mut parts, shares, |part| part.locate(&lookup));
        let here = parts.len();
        if !whole {
            pass_on(&mut parts, &lookup, ranks);
        }
        // Destinations that follow one another in a block's history and are in one block; by that block, then by the other.
        let mut runs: Vec<Run> = Vec::new();
        let from = parts.par_iter().enumerate().with_min_len(blocks_at_once(ids.len()));
        runs.par_extend(from.flat_map_iter(|(from, part)| part.runs(from)));
        runs.par_sort_by_key(|run| run.block);
        let own = input.neighbours.own();
        let range = (&mut self.blocks[own.clone()], &input.neighbours.lists[own]);
        sweep(range, Direction::Forward, shares, &|(blocks, lists): (&mut [BlockContacts], &[BlockList])| {
            let block = (lists[0].first / BLOCK) as u32;
            let first = runs.partition_point(|run| run.block < block);
            let runs = runs[first..].iter().take_while(|run| run.block == block);
            refill(&mut blocks[0], &parts, runs, laws, width);
        });
        parts.truncate(here);
        let mut lost = ranks.letters();
        lost.resize(lost.len().max(1), Vec::new());
        lost.fill(parts.iter().map(|part| part.lost(&lookup)).collect());
        ranks.pass(&mut lost);
        lost.iter().flatten().sum()
    }
}

impl HistorySnapshot {
    /// Contacts that are not known by block.
    pub fn of(contacts: Vec<ContactId>, history: Vec<f64>) -> Self {
        let all = BlockHistory { contacts, history, ..BlockHistory::default() };
        Self { blocks: vec![all], whole: true }
    }
}

impl BlockHistory {
    /// Adds a contact with its numbers, and zeros up to `width`.
    fn push(&mut self, contact: ContactId, history: impl Iterator<Item = f64>, width: usize) {
        self.contacts.push(contact);
        self.history.extend(history);
        self.history.resize(self.contacts.len() * width, 0.0);
    }

    /// Writes down the contacts of a block.
    fn record(&mut self, block: &BlockContacts, list: &BlockList, id: &[u32], width: usize) {
        self.contacts.clear();
        self.history.clear();
        let contacts = block.history.iter().map(ContactHistory::len).sum();
        self.contacts.reserve_exact(contacts);
        self.history.reserve_exact(contacts * width);
        for (law, of) in (0..).zip(&block.history) {
            for (c, &k) in of.pairs.keys.iter().enumerate() {
                let pair = list.pairs[k as usize];
                let first = id[list.first + pair.first as usize];
                let second = id[list.grain_at[pair.second as usize] as usize];
                self.push(ContactId { first, second, wall: false, patch: 0, law }, of.pairs.history(c), width);
            }
            for (c, key) in of.features.keys.iter().enumerate() {
                let pair = list.pairs[key.pair as usize];
                let first = id[list.first + pair.first as usize];
                let second = id[list.grain_at[pair.second as usize] as usize];
                let contact = ContactId { first, second, wall: false, patch: key.feature, law };
                self.push(contact, of.features.history(c), width);
            }
            for (c, key) in of.walls.keys.iter().enumerate() {
                let first = id[list.first + key.own as usize];
                let contact = ContactId { first, second: key.wall, wall: true, patch: key.patch, law };
                self.push(contact, of.walls.history(c), width);
            }
        }
    }

    /// The runs of its destinations, where it is part `from`.
    fn runs(&self, from: usize) -> impl Iterator<Item = Run> {
        let mut end = 0;
        self.destinations.chunk_by(|a, b| a.block == b.block).map(move |run| {
            let first = end;
            end += run.len();
            Run { block: run[0].block, from, destinations: first..end }
        })
    }

    /// Adds the contacts of a message.
    fn receive(&mut self, message: &[f64], width: usize) {
        let mut message = Reader::new(message);
        while !message.is_at_end() {
            let contact = ContactId::take(&mut message);
            self.push(contact, message.numbers(width).iter().copied(), width);
        }
    }

    /// Stored energy of those that belong nowhere [J].
    fn lost(&self, lookup: &Lookup) -> f64 {
        let mut lost = 0.0;
        for &from in &self.missing {
            lost += lookup.laws[self.contacts[from as usize].law as usize].held(self.history_of(from, lookup.width));
        }
        lost
    }

    fn history_of(&self, number: u32, width: usize) -> &[f64] {
        &self.history[number as usize * width..(number as usize + 1) * width]
    }

    /// Finds out where the contacts belong, turning those whose bodies have changed places.
    fn locate(&mut self, lookup: &Lookup) {
        let Self { contacts, history, destinations, missing } = self;
        destinations.clear();
        destinations.reserve_exact(contacts.len());
        missing.clear();
        for (from, (contact, history)) in (0..).zip(contacts.iter().zip(history.chunks_exact_mut(lookup.width))) {
            let law = &lookup.laws[contact.law as usize];
            let Some((block, key, turned)) = lookup.locate(contact) else {
                missing.push(from);
                continue;
            };
            if turned {
                law.turned(history);
            }
            destinations.push(Destination { block, key, from });
        }
        destinations.sort();
    }
}

impl Lookup<'_> {
    /// The block of a contact, its key there, and whether its bodies have changed places.
    fn locate(&self, contact: &ContactId) -> Option<(u32, Key, bool)> {
        let i = self.index(contact.first)?;
        if contact.wall {
            let own = i % BLOCK as u32;
            let key = Key::Wall(WallKey { own, wall: contact.second, patch: contact.patch });
            let wall = self.walls.get(contact.second as usize)?;
            let here = !wall.vanished() && self.neighbours.own().contains(&(i as usize / BLOCK));
            return here.then_some((i / BLOCK as u32, key, false));
        }
        let j = self.index(contact.second)?;
        let found = |(block, pair), turned| {
            let key = match contact.patch {
                0 => Key::Pair(pair),
                feature if turned => Key::Feature(FeatureKey { pair, feature: turned_feature(feature) }),
                feature => Key::Feature(FeatureKey { pair, feature }),
            };
            (block, key, turned)
        };
        let same = self.pair(i, j).map(|pair| found(pair, false));
        same.or_else(|| self.pair(j, i).map(|pair| found(pair, true)))
    }

    fn index(&self, id: u32) -> Option<u32> {
        self.index.get(id as usize).map(|i| i.load(Ordering::Relaxed)).filter(|i| *i != REMOVED)
    }

    /// Block, and number in its list, of the pair of grain `i` with grain `j`.
    fn pair(&self, i: u32, j: u32) -> Option<(u32, u32)> {
        let (block, own) = (i as usize / BLOCK, i as usize % BLOCK);
        if !self.neighbours.own().contains(&block) {
            return None;
        }
        let list = &self.neighbours.lists[block];
        let range = list.start[own] as usize..list.start[own + 1] as usize;
        let k = list.pairs[range.clone()].iter().position(|pair| list.grain_at[pair.second as usize] == j)?;
        Some((block as u32, (range.start + k) as u32))
    }
}

/// Sends the contacts that belong to no list here to the ranks that have their grains, and adds what such ranks send as another part each.
fn pass_on(parts: &mut Vec<BlockHistory>, lookup: &Lookup, ranks: &mut Ranks) {
    let mut letters = ranks.letters();
    let mut sent: Vec<Vec<(usize, u32)>> = vec![Vec::new(); letters.len()];
    for (part, block) in parts.iter().enumerate() {
        for &from in &block.missing {
            let contact = &block.contacts[from as usize];
            let second = if contact.wall { None } else { lookup.index(contact.second) };
            for rank in ranks.others([lookup.index(contact.first), second]) {
                contact.put(block.history_of(from, lookup.width), &mut letters[rank]);
                sent[rank].push((part, from));
            }
        }
    }
    ranks.pass(&mut letters);
    for letter in &mut letters {
        let mut part = BlockHistory::default();
        part.receive(letter, lookup.width);
        part.locate(lookup);
        // The answer: which of them are nobody's here either.
        letter.clear();
        letter.extend(part.missing.drain(..).map(f64::from));
        parts.push(part);
    }
    ranks.pass(&mut letters);
    let mut found: Vec<(usize, u32)> = Vec::new();
    for (sent, letter) in sent.iter().zip(&letters) {
        let lost = |k: usize| letter.contains(&(k as f64));
        found.extend(sent.iter().enumerate().filter(|(k, _)| !lost(*k)).map(|(_, contact)| *contact));
    }
    for (part, from) in found {
        parts[part].missing.retain(|missing| *missing != from);
    }
}

/// Fills the history of a block from the parts of a snapshot.
fn refill<'a>(
    block: &mut BlockContacts,
    parts: &[BlockHistory],
    runs: impl Iterator<Item = &'a Run>,
    laws: &[Law],
    width: usize,
) {
    for (history, law) in block.history.iter_mut().zip(laws) {
        history.clear(law.width());
    }
    let all = runs.flat_map(|run| {
        parts[run.from].destinations[run.destinations.clone()]
            .iter()
            .map(move |one| (one.key, run.from, one.from as usize))
    });
    let mut all: Vec<(Key, usize, usize)> = all.collect();
    // Runs of several parts, each in order.
    all.sort_by_key(|(key, ..)| *key);
    for (key, part, from) in all {
        let BlockHistory { contacts, history, .. } = &parts[part];
        let (law, history) = (contacts[from].law as usize, &history[from * width..(from + 1) * width]);
        match key {
            Key::Pair(k) => block.history[law].pairs.push(k, history),
            Key::Feature(key) => block.history[law].features.push(key, history),
            Key::Wall(key) => block.history[law].walls.push(key, history),
        }
    }
}
