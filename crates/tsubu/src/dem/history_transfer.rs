//! Contact history over a rebuild of the neighbour lists, and in a checkpoint: by the ids of the bodies, since indices change.
//!
//! Every block hands over its own contacts, and is filled from what belongs to it: both on many threads.

use super::contact_forces::{BlockContacts, ContactForces, ForceInput};
use super::contact_history::{FeatureKey, WallKey};
use super::sweep::{Direction, sweep};
use crate::contact::Law;
use crate::mutation::{Mutation, left_out};
use crate::neighbours::NeighbourLists;
use crate::neighbours::lists::{BLOCK, BlockList, shares};
use crate::polyhedron::touch::turned_feature;
use crate::threads;
use crate::wall::Wall;

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

/// The contact history of all blocks by ids.
#[derive(Clone, Debug, Default)]
pub(super) struct HistorySnapshot {
    pub blocks: Vec<BlockHistory>,
    /// Index of the grain with each id; [`REMOVED`] where there is none.
    index: Vec<u32>,
    /// Destinations that follow one another in a block's history and are in one block; by that block, then by the other.
    runs: Vec<Run>,
}

/// The contact history of one block, or of a checkpoint.
#[derive(Clone, Debug, Default)]
pub(super) struct BlockHistory {
    pub contacts: Vec<ContactId>,
    /// As many numbers a contact as the widest law has columns of history.
    pub history: Vec<f64>,
    /// Where they belong now, in order.
    destinations: Vec<Destination>,
    /// Stored energy of those that belong nowhere [J].
    lost: f64,
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
    index: &'a [u32],
    neighbours: &'a NeighbourLists,
    walls: &'a [Wall],
    laws: &'a [Law],
    width: usize,
}

impl ContactForces {
    /// Snapshot of every contact's history, in the order of blocks.
    pub fn snapshot_history(&mut self, input: &ForceInput) -> HistorySnapshot {
        let mut snapshot = std::mem::take(&mut self.snapshot);
        self.record_history(input, &mut snapshot);
        snapshot
    }

    /// Writes every contact's history into a snapshot, in the order of blocks.
    pub fn record_history(&self, input: &ForceInput, snapshot: &mut HistorySnapshot) {
        let width = input.laws.history_width();
        let lists = if width == 0 { &[] } else { &input.neighbours.lists[..] };
        snapshot.blocks.resize_with(lists.len(), BlockHistory::default);
        let (id, blocks) = (&input.grains.id, &self.blocks);
        let range = (&mut snapshot.blocks[..], lists);
        sweep(range, Direction::Forward, shares(id.len()), &|(of, lists): (&mut [BlockHistory], &[BlockList])| {
            of[0].record(&blocks[lists[0].first / BLOCK], &lists[0], id, width);
        });
    }

    /// Gives the pairs of new neighbour lists the histories they had; a pair whose bodies have changed places gets its turned.
    /// Returns the stored energy of contacts whose body is gone, or whose pair is in no list any more [J].
    pub fn restore_history(&mut self, input: &ForceInput, mut snapshot: HistorySnapshot) -> f64 {
        let width = input.laws.history_width();
        if width == 0 {
            return 0.0;
        }
        let (laws, ids) = (input.laws.all(), &input.grains.id);
        let shares = shares(ids.len());
        let HistorySnapshot { blocks: parts, index, runs } = &mut snapshot;
        index.clear();
        index.resize(ids.iter().max().map_or(0, |m| *m as usize + 1), REMOVED);
        if !left_out(Mutation::HistoryTransfer) {
            for (i, id) in (0..).zip(ids) {
                index[*id as usize] = i;
            }
        }
        let lookup = Lookup { index, neighbours: input.neighbours, walls: input.walls, laws, width };
        threads::each(parts, shares, |part| part.locate(&lookup));
        runs.clear();
        for (from, BlockHistory { destinations, .. }) in parts.iter().enumerate() {
            let mut first = 0;
            while let Some(&Destination { block, .. }) = destinations.get(first) {
                let last = first + destinations[first..].partition_point(|one| one.block == block);
                runs.push(Run { block, from, destinations: first..last });
                first = last;
            }
        }
        runs.sort_by_key(|run| run.block);
        let range = (&mut self.blocks[..], &input.neighbours.lists[..]);
        sweep(range, Direction::Forward, shares, &|(blocks, lists): (&mut [BlockContacts], &[BlockList])| {
            let block = (lists[0].first / BLOCK) as u32;
            let first = runs.partition_point(|run| run.block < block);
            let runs = runs[first..].iter().take_while(|run| run.block == block);
            refill(&mut blocks[0], parts, runs, laws, width);
        });
        let lost = parts.iter().map(|part| part.lost).sum();
        self.snapshot = snapshot;
        lost
    }
}

impl HistorySnapshot {
    /// Contacts that are not known by block.
    pub fn of(contacts: Vec<ContactId>, history: Vec<f64>) -> Self {
        Self { blocks: vec![BlockHistory { contacts, history, ..BlockHistory::default() }], ..Self::default() }
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

    /// Finds out where the contacts belong, turning those whose bodies have changed places.
    fn locate(&mut self, lookup: &Lookup) {
        let Self { contacts, history, destinations, lost } = self;
        destinations.clear();
        *lost = 0.0;
        for (from, (contact, history)) in (0..).zip(contacts.iter().zip(history.chunks_exact_mut(lookup.width))) {
            let law = &lookup.laws[contact.law as usize];
            let Some((block, key, turned)) = lookup.locate(contact) else {
                *lost += law.held(history);
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
            return (!wall.vanished()).then_some((i / BLOCK as u32, key, false));
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
        self.index.get(id as usize).copied().filter(|i| *i != REMOVED)
    }

    /// Block, and number in its list, of the pair of grain `i` with grain `j`.
    fn pair(&self, i: u32, j: u32) -> Option<(u32, u32)> {
        let (block, own) = (i as usize / BLOCK, i as usize % BLOCK);
        let list = &self.neighbours.lists[block];
        let range = list.start[own] as usize..list.start[own + 1] as usize;
        let k = list.pairs[range.clone()].iter().position(|pair| list.grain_at[pair.second as usize] == j)?;
        Some((block as u32, (range.start + k) as u32))
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
