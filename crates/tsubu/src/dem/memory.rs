//! What contacts remember: history, kept for touching pairs alone.
//!
//! Every block has the contacts of the last step in the order of its candidates. A step walks candidates and contacts side
//! by side, takes along what goes on and leaves what has opened; nothing is looked up. Two lists are used in turns, so
//! that a step reads one and writes the other.

use crate::contact::Law;

/// Contacts with their histories, in order of their keys.
#[derive(Clone, Debug)]
pub(super) struct Contacts<K> {
    /// What contact it is.
    pub keys: Vec<K>,
    /// `width` numbers a contact.
    pub history: Vec<f64>,
}

impl<K> Default for Contacts<K> {
    fn default() -> Self {
        Self { keys: Vec::new(), history: Vec::new() }
    }
}

impl<K> Contacts<K> {
    pub fn clear(&mut self) {
        self.keys.clear();
        self.history.clear();
    }

    pub fn reserve(&mut self, contacts: usize, width: usize) {
        self.keys.reserve(contacts.saturating_sub(self.keys.len()));
        self.history.reserve((contacts * width).saturating_sub(self.history.len()));
    }

    pub fn push(&mut self, key: K, history: &[f64]) {
        self.keys.push(key);
        self.history.extend_from_slice(history);
    }

    /// History of contact `c`.
    pub fn of(&self, c: usize, width: usize) -> &[f64] {
        &self.history[c * width..(c + 1) * width]
    }

    /// Energy [J] that the histories of the contacts `range` hold.
    pub fn held(&self, range: std::ops::Range<usize>, law: &Law) -> f64 {
        range.map(|c| law.held(self.of(c, law.width()))).sum()
    }
}

/// A contact with a wall: its grain (counted from the first of the block), its wall, and the wall's name for the place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct WallKey {
    pub own: u32,
    pub wall: u32,
    pub patch: u32,
}

/// The contacts of one block: those of the last step, and those that this step writes.
#[derive(Clone, Debug, Default)]
pub(super) struct Memory {
    /// Grain-grain contacts of the last step by number of the candidate.
    pub pairs: Contacts<u32>,
    /// Grain-wall contacts of the last step.
    pub walls: Contacts<WallKey>,
    /// Written by this step.
    pub next_pairs: Contacts<u32>,
    /// Written by this step.
    pub next_walls: Contacts<WallKey>,
}

impl Memory {
    /// What this step has written becomes what the next one reads.
    pub fn turn(&mut self) {
        std::mem::swap(&mut self.pairs, &mut self.next_pairs);
        std::mem::swap(&mut self.walls, &mut self.next_walls);
        self.next_pairs.clear();
        self.next_walls.clear();
    }
}

/// One remembered contact by the ids of its bodies, as it is kept over a search and in a checkpoint. For a wall the second
/// number is the wall, and `patch` tells the place on it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Kept {
    pub first: u32,
    pub second: u32,
    pub wall: bool,
    pub patch: u32,
    pub history: Vec<f64>,
}
