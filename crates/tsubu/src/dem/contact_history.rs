//! Contact history: what contacts remember, kept for touching pairs alone.
//!
//! Every block has the contacts of the last step in the order of its neighbour list. A step walks pairs and contacts side
//! by side, takes along what goes on and leaves what has opened; nothing is looked up. What it writes goes into memory that
//! the thread has at hand, and from there into the place of what it has read: so a step fetches and stores every history
//! once, and a block has room for its own contacts alone.

use crate::contact::Law;
use crate::contact::chunk::Column;

/// Contacts with their histories, in order of their keys.
#[derive(Clone, Debug)]
pub(super) struct HistoryColumns<K> {
    /// What contact it is.
    pub keys: Vec<K>,
    /// Columns as in a chunk, one number a contact; the first is zero, the history of a fresh contact.
    columns: Vec<Vec<f64>>,
}

/// Most columns of history that a law may have: springs of 4 in tangential and rolling, 2 in twisting and cohesion are 12.
pub(super) const MAX_COLUMNS: usize = 32;

/// Where the history of a fresh contact lies.
pub(super) const FRESH: u32 = 0;

impl<K> Default for HistoryColumns<K> {
    fn default() -> Self {
        Self { keys: Vec::new(), columns: Vec::new() }
    }
}

impl<K> HistoryColumns<K> {
    /// Forgets all; from now on there are `width` numbers a contact.
    pub fn clear(&mut self, width: usize) {
        self.keys.clear();
        self.columns.resize_with(width, Vec::new);
        for column in &mut self.columns {
            column.clear();
            column.push(0.0);
        }
    }

    /// Makes room for so many contacts; where there is less, for a few that come later, too.
    fn reserve(&mut self, contacts: usize) {
        if self.keys.capacity() >= contacts {
            return;
        }
        let room = (contacts + contacts / 8).next_multiple_of(32);
        self.keys.reserve_exact(room.saturating_sub(self.keys.len()));
        for column in &mut self.columns {
            column.reserve_exact((room + 1).saturating_sub(column.len()));
        }
    }

    /// Takes a copy of others.
    pub fn keep(&mut self, others: &Self)
    where
        K: Copy,
    {
        self.keys.clear();
        self.columns.iter_mut().for_each(Vec::clear);
        self.reserve(others.keys.len());
        self.keys.extend_from_slice(&others.keys);
        for (to, from) in self.columns.iter_mut().zip(&others.columns) {
            to.extend_from_slice(from);
        }
    }

    pub fn push(&mut self, key: K, history: &[f64]) {
        self.reserve(self.keys.len() + 1);
        self.keys.push(key);
        for (column, value) in self.columns.iter_mut().zip(history) {
            column.push(*value);
        }
    }

    /// Where the history of contact `c` lies.
    #[inline]
    pub fn slot(c: usize) -> u32 {
        c as u32 + 1
    }

    /// History of contact `c`.
    pub fn history(&self, c: usize) -> impl Iterator<Item = f64> {
        self.columns.iter().map(move |column| column[c + 1])
    }

    /// Energy [J] that the histories of the contacts `range` hold.
    pub fn stored_energy(&self, range: std::ops::Range<usize>, law: &Law) -> f64 {
        let mut history = [0.0; MAX_COLUMNS];
        range
            .map(|c| {
                for (entry, value) in history.iter_mut().zip(self.history(c)) {
                    *entry = value;
                }
                law.held(&history[..law.width()])
            })
            .sum()
    }

    /// Copies the histories at `slots` into the rows of a chunk. Where contacts go on as they were their slots follow
    /// one another, and columns are copied whole.
    pub fn gather(&self, slots: &[u32], columns: &mut [Column]) {
        let Some(&first) = slots.first() else { return };
        let first = first as usize;
        let follow = slots.windows(2).all(|pair| pair[1] == pair[0] + 1);
        for (to, from) in columns.iter_mut().zip(&self.columns) {
            if follow {
                to[..slots.len()].copy_from_slice(&from[first..first + slots.len()]);
            } else {
                for (value, &slot) in to.iter_mut().zip(slots) {
                    *value = from[slot as usize];
                }
            }
        }
    }

    /// Adds the histories of the first `rows` rows of a chunk; their keys come apart.
    pub fn append(&mut self, rows: usize, columns: &[Column]) {
        for (to, from) in self.columns.iter_mut().zip(columns) {
            to.extend_from_slice(&from[..rows]);
        }
    }
}

/// How far a step has come through the contacts of the last one.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Walk {
    at: usize,
    /// Energy that contacts held which have opened [J].
    pub released: f64,
}

impl<K: Ord> HistoryColumns<K> {
    /// Walks on along touching `keys`, in order, and tells in `old` where the history of each lies.
    pub fn follow(&self, keys: impl Iterator<Item = K>, old: &mut [u32], walk: &mut Walk, law: &Law) {
        for (key, old) in keys.zip(old) {
            self.open(walk, law, |before| *before < key);
            let goes_on = self.keys.get(walk.at) == Some(&key);
            *old = if goes_on { Self::slot(walk.at) } else { FRESH };
            walk.at += usize::from(goes_on);
        }
    }

    /// Walks past the contacts that `have_opened`.
    pub fn open(&self, walk: &mut Walk, law: &Law, have_opened: impl Fn(&K) -> bool) {
        let opened = self.pass(walk, have_opened);
        if !opened.is_empty() {
            walk.released += self.stored_energy(opened, law);
        }
    }

    /// The contacts that come next and `are` so; walks past them.
    pub fn pass(&self, walk: &mut Walk, are: impl Fn(&K) -> bool) -> std::ops::Range<usize> {
        let begin = walk.at;
        while self.keys.get(walk.at).is_some_and(&are) {
            walk.at += 1;
        }
        begin..walk.at
    }
}

/// A contact of two features of bodies: number of the pair in the neighbour list, and which features.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct FeatureKey {
    pub pair: u32,
    pub feature: u32,
}

/// A contact with a wall: its grain (counted from the first of the block), its wall, and the wall's name for the place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct WallKey {
    pub own: u32,
    pub wall: u32,
    pub patch: u32,
}

/// The contacts of one block under one law.
#[derive(Clone, Debug, Default)]
pub(super) struct ContactHistory {
    /// Grain-grain contacts by number of the pair in the neighbour list.
    pub pairs: HistoryColumns<u32>,
    /// Contacts of features of polyhedra with other grains.
    pub features: HistoryColumns<FeatureKey>,
    /// Grain-wall contacts.
    pub walls: HistoryColumns<WallKey>,
}

impl ContactHistory {
    /// Nothing to remember, `width` numbers a contact.
    pub fn new(width: usize) -> Self {
        let mut history = Self::default();
        history.clear(width);
        history
    }

    /// Forgets all; from now on there are `width` numbers a contact.
    pub fn clear(&mut self, width: usize) {
        self.pairs.clear(width);
        self.features.clear(width);
        self.walls.clear(width);
    }

    /// How many contacts there are.
    pub fn len(&self) -> usize {
        self.pairs.keys.len() + self.features.keys.len() + self.walls.keys.len()
    }

    /// Takes a copy of others.
    pub fn keep(&mut self, others: &Self) {
        self.pairs.keep(&others.pairs);
        self.features.keep(&others.features);
        self.walls.keep(&others.walls);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Blocks were given as much room as the fullest of them took: a bed that is full below and loose above took five times what it had to remember.
    #[test]
    fn a_block_has_room_for_its_own_contacts_alone() {
        let mut at_hand = HistoryColumns::<u32>::default();
        at_hand.clear(1);
        (0..3000).for_each(|key| at_hand.push(key, &[f64::from(key)]));
        let mut block = HistoryColumns::default();
        block.clear(1);
        block.keep(&at_hand);
        let room = block.keys.capacity();
        assert!((3000..3500).contains(&room), "{room}");
        at_hand.clear(1);
        (0..3100).for_each(|key| at_hand.push(key, &[f64::from(key)]));
        block.keep(&at_hand);
        assert_eq!(
            (block.keys.capacity(), block.columns[0].capacity()),
            (room, room + 1),
            "a few more ask for nothing"
        );
        assert!(block.keys.len() == 3100 && block.history(3099).eq([3099.0]));
    }
}
