//! Contact history over a search, and in a checkpoint: by the ids of the bodies, since indices change.
//!
//! Every block hands over its own contacts, and is filled from what belongs to it: both on many threads.

use super::engine::DemEngine;
use super::memory::WallKey;
use super::sweep::{Way, sweep};
use super::touch::Block;
use crate::contact::Law;
use crate::find::Candidates;
use crate::find::candidates::{BLOCK, List, shares};
use crate::threads;
use crate::wall::Wall;

/// A remembered contact by the ids of its bodies. For a wall the second number is the wall, and `patch` tells the place
/// on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Name {
    pub first: u32,
    pub second: u32,
    pub wall: bool,
    pub patch: u32,
    /// Number of its law; follows from the materials, so a checkpoint does not have it.
    pub law: u32,
}

/// Remembered contacts by name. Kept from search to search for its memory.
#[derive(Clone, Debug, Default)]
pub(super) struct Kept {
    /// Those of one block each.
    pub parts: Vec<Part>,
    /// Index of the grain with each id; [`GONE`] where there is none.
    index: Vec<u32>,
    /// Places that follow one another in a part and are in one block; by block, then by part.
    runs: Vec<Run>,
}

/// Some remembered contacts.
#[derive(Clone, Debug, Default)]
pub(super) struct Part {
    pub names: Vec<Name>,
    /// As many numbers a contact as the widest law has columns of history.
    pub history: Vec<f64>,
    /// Where they belong now, in order.
    places: Vec<Place>,
    /// What those held that belong nowhere [J].
    lost: f64,
}

/// Where a remembered contact belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Place {
    block: u32,
    key: Key,
    /// Its number in the part.
    from: u32,
}

/// A contact of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Key {
    /// By number of the candidate.
    Pair(u32),
    Wall(WallKey),
}

#[derive(Clone, Debug)]
struct Run {
    block: u32,
    part: usize,
    places: std::ops::Range<usize>,
}

/// The index of a grain that is there no more.
const GONE: u32 = u32::MAX;

/// What tells where contacts belong.
struct Now<'a> {
    index: &'a [u32],
    candidates: &'a Candidates,
    walls: &'a [Wall],
    laws: &'a [Law],
    width: usize,
}

impl DemEngine {
    /// Every remembered contact, in the order of blocks.
    pub(super) fn kept(&mut self) -> Kept {
        let mut kept = std::mem::take(&mut self.kept);
        self.keep(&mut kept);
        kept
    }

    /// Writes down every remembered contact, in the order of blocks.
    pub(super) fn keep(&self, kept: &mut Kept) {
        let width = self.widest();
        let lists = if width == 0 { &[] } else { &self.candidates.lists[..] };
        kept.parts.resize_with(lists.len(), Part::default);
        let (id, blocks) = (&self.grains.id, &self.touch.blocks);
        let row = (&mut kept.parts[..], lists);
        sweep(row, Way::There, shares(id.len()), &|(parts, lists): (&mut [Part], &[List])| {
            parts[0].keep(&blocks[lists[0].first / BLOCK], &lists[0], id, width);
        });
    }

    /// Gives the new candidates the histories they had; a pair whose bodies have changed places gets its turned. What a
    /// contact holds whose body is gone, or whose pair is no candidate any more, is returned as lost [J].
    pub(super) fn restore(&mut self, mut kept: Kept) -> f64 {
        let width = self.widest();
        if width == 0 {
            return 0.0;
        }
        let (laws, shares) = (self.table.laws(), shares(self.grains.len()));
        let Kept { parts, index, runs } = &mut kept;
        index.clear();
        index.resize(self.grains.id.iter().max().map_or(0, |m| *m as usize + 1), GONE);
        for (i, id) in (0..).zip(&self.grains.id) {
            index[*id as usize] = i;
        }
        let now = Now { index, candidates: &self.candidates, walls: &self.walls, laws, width };
        threads::each(parts, shares, |part| part.place(&now));
        runs.clear();
        for (part, Part { places, .. }) in parts.iter().enumerate() {
            let mut first = 0;
            while let Some(&Place { block, .. }) = places.get(first) {
                let last = first + places[first..].partition_point(|place| place.block == block);
                runs.push(Run { block, part, places: first..last });
                first = last;
            }
        }
        runs.sort_by_key(|run| run.block);
        let row = (&mut self.touch.blocks[..], &self.candidates.lists[..]);
        sweep(row, Way::There, shares, &|(blocks, lists): (&mut [Block], &[List])| {
            let block = (lists[0].first / BLOCK) as u32;
            let first = runs.partition_point(|run| run.block < block);
            let runs = runs[first..].iter().take_while(|run| run.block == block);
            recall(&mut blocks[0], parts, runs, laws, width);
        });
        let lost = parts.iter().map(|part| part.lost).sum();
        self.kept = kept;
        lost
    }

    /// Columns of history of the law that has most.
    pub(super) fn widest(&self) -> usize {
        self.table.laws().iter().map(Law::width).max().unwrap_or_default()
    }
}

impl Kept {
    /// Contacts that are not known by block.
    pub fn of(names: Vec<Name>, history: Vec<f64>) -> Self {
        Self { parts: vec![Part { names, history, ..Part::default() }], ..Self::default() }
    }
}

impl Part {
    /// Adds a contact with its numbers, and zeros up to `width`.
    fn push(&mut self, name: Name, history: impl Iterator<Item = f64>, width: usize) {
        self.names.push(name);
        self.history.extend(history);
        self.history.resize(self.names.len() * width, 0.0);
    }

    /// Writes down the contacts of a block.
    fn keep(&mut self, block: &Block, list: &List, id: &[u32], width: usize) {
        self.names.clear();
        self.history.clear();
        for (law, memory) in (0..).zip(&block.memory) {
            for (c, &k) in memory.pairs.keys.iter().enumerate() {
                let pair = list.pairs[k as usize];
                let (first, second) = (id[list.first + pair.own as usize], id[list.at[pair.place as usize] as usize]);
                self.push(Name { first, second, wall: false, patch: 0, law }, memory.pairs.of(c), width);
            }
            for (c, key) in memory.walls.keys.iter().enumerate() {
                let first = id[list.first + key.own as usize];
                let name = Name { first, second: key.wall, wall: true, patch: key.patch, law };
                self.push(name, memory.walls.of(c), width);
            }
        }
    }

    /// Finds out where the contacts belong, turning those whose bodies have changed places.
    fn place(&mut self, now: &Now) {
        let Self { names, history, places, lost } = self;
        places.clear();
        *lost = 0.0;
        for (from, (name, history)) in (0..).zip(names.iter().zip(history.chunks_exact_mut(now.width))) {
            let law = &now.laws[name.law as usize];
            let Some((block, key, turned)) = now.place(name) else {
                *lost += law.held(history);
                continue;
            };
            if turned {
                law.turned(history);
            }
            places.push(Place { block, key, from });
        }
        places.sort();
    }
}

impl Now<'_> {
    /// The block of a contact, its key there, and whether its bodies have changed places.
    fn place(&self, name: &Name) -> Option<(u32, Key, bool)> {
        let i = self.index(name.first)?;
        if name.wall {
            let own = i % BLOCK as u32;
            let key = Key::Wall(WallKey { own, wall: name.second, patch: name.patch });
            let wall = self.walls.get(name.second as usize)?;
            return (!wall.gone()).then_some((i / BLOCK as u32, key, false));
        }
        let j = self.index(name.second)?;
        let found = |(block, k), turned| (block, Key::Pair(k), turned);
        let same = self.candidate(i, j).map(|place| found(place, false));
        same.or_else(|| self.candidate(j, i).map(|place| found(place, true)))
    }

    fn index(&self, id: u32) -> Option<u32> {
        self.index.get(id as usize).copied().filter(|i| *i != GONE)
    }

    /// Block and number of the candidate of grain `i` with grain `j`.
    fn candidate(&self, i: u32, j: u32) -> Option<(u32, u32)> {
        let (block, own) = (i as usize / BLOCK, i as usize % BLOCK);
        let list = &self.candidates.lists[block];
        let range = list.start[own] as usize..list.start[own + 1] as usize;
        let k = list.pairs[range.clone()].iter().position(|pair| list.at[pair.place as usize] == j)?;
        Some((block as u32, (range.start + k) as u32))
    }
}

/// Fills the memory of a block from the parts.
fn recall<'a>(block: &mut Block, parts: &[Part], runs: impl Iterator<Item = &'a Run>, laws: &[Law], width: usize) {
    for (memory, law) in block.memory.iter_mut().zip(laws) {
        memory.clear(law.width());
    }
    let places = runs.flat_map(|run| parts[run.part].places[run.places.clone()].iter().map(move |p| (p, run.part)));
    let mut places: Vec<(Key, usize, usize)> = places.map(|(p, part)| (p.key, part, p.from as usize)).collect();
    // Runs of several parts, each in order.
    places.sort_by_key(|(key, ..)| *key);
    for (key, part, from) in places {
        let Part { names, history, .. } = &parts[part];
        let (law, history) = (names[from].law as usize, &history[from * width..(from + 1) * width]);
        match key {
            Key::Pair(k) => block.memory[law].pairs.push(k, history),
            Key::Wall(key) => block.memory[law].walls.push(key, history),
        }
    }
}
