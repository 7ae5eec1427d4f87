//! Contact history: what contacts remember, kept for touching pairs alone.
//!
//! Every block has the contacts of the last step in the order of its neighbour list. A step walks pairs and contacts side
//! by side, takes along what goes on and leaves what has opened; nothing is looked up. What it writes goes into the place of
//! what it has read; where more contacts have come than have gone, those that are yet to be read make way. So a step fetches
//! and stores every history once, and a block has room for its own contacts alone.

use crate::contact::Law;
use crate::contact::chunk::{Column, ROWS};

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
        self.columns.resize_with(others.columns.len(), Vec::new);
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

    /// Copies the histories at `slots` into the rows of a chunk.
    pub fn gather(&self, slots: &[u32], columns: &mut [Column]) {
        for (to, from) in columns.iter_mut().zip(&self.columns) {
            for (value, &slot) in to.iter_mut().zip(slots) {
                *value = from[slot as usize];
            }
        }
    }
}

/// How far a step has come through the contacts of the last one.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Walk {
    /// The next contact to read.
    at: usize,
    /// How many have been written.
    written: usize,
    /// Energy that contacts held which have opened [J].
    pub released: f64,
}

/// For how many contacts more than are needed those that are yet to be read make way.
const AHEAD: usize = 16;

impl<K: Ord + Copy + Default> HistoryColumns<K> {
    /// Walks on along touching `keys`, in order, and copies what each contact remembers into the rows of a chunk.
    pub fn recall(
        &self,
        keys: impl ExactSizeIterator<Item = K> + Clone,
        walk: &mut Walk,
        law: &Law,
        columns: &mut [Column],
    ) {
        let rows = keys.len();
        // Most often all go on as they were. To look at all of them is faster than to stop at the first that differs.
        let before = self.keys.get(walk.at..walk.at + rows).unwrap_or_default();
        let same = before.iter().zip(keys.clone()).fold(0, |same, (before, key)| same + usize::from(*before == key));
        if same == rows {
            let first = Self::slot(walk.at) as usize;
            for (to, from) in columns.iter_mut().zip(&self.columns) {
                to[..rows].copy_from_slice(&from[first..first + rows]);
            }
            walk.at += rows;
            return;
        }
        let mut old = [FRESH; ROWS];
        for (key, old) in keys.zip(&mut old) {
            self.open(walk, law, |before| *before < key);
            if self.keys.get(walk.at) == Some(&key) {
                *old = Self::slot(walk.at);
                walk.at += 1;
            }
        }
        self.gather(&old[..rows], columns);
    }

    /// Puts what the rows of a chunk remember from now on into the place of what has been read, or behind it where all has.
    pub fn remember(&mut self, keys: impl ExactSizeIterator<Item = K>, walk: &mut Walk, columns: &[Column]) {
        let (begin, end) = (walk.written, walk.written + keys.len());
        if end > walk.at {
            self.make_way(walk, end - walk.at);
        }
        for (to, key) in self.keys[begin..end].iter_mut().zip(keys) {
            *to = key;
        }
        for (to, from) in self.columns.iter_mut().zip(columns) {
            to[begin + 1..=end].copy_from_slice(&from[..end - begin]);
        }
        walk.written = end;
    }

    /// Moves what is yet to be read on by so many contacts, or a few more.
    fn make_way(&mut self, walk: &mut Walk, contacts: usize) {
        let (at, end) = (walk.at, self.keys.len());
        let way = if at < end { contacts + AHEAD } else { contacts };
        self.reserve(end + way);
        self.keys.resize(end + way, K::default());
        self.keys.copy_within(at..end, at + way);
        for column in &mut self.columns {
            column.resize(end + way + 1, 0.0);
            column.copy_within(at + 1..=end, at + way + 1);
        }
        walk.at += way;
    }

    /// Ends a walk: what was not read has opened.
    pub fn end(&mut self, walk: &mut Walk, law: &Law) {
        self.open(walk, law, |_| true);
        self.keys.truncate(walk.written);
        self.columns.iter_mut().for_each(|column| column.truncate(walk.written + 1));
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct FeatureKey {
    pub pair: u32,
    pub feature: u32,
}

/// A contact with a wall: its grain (counted from the first of the block), its wall, and the wall's name for the place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::Table;
    use crate::contact::chunk::ZERO;
    use proptest::collection::{btree_set, vec};
    use proptest::prelude::*;
    use std::collections::BTreeMap;
    use std::path::Path;
    use tsubu_scene::Scene;

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

    /// Its law has a spring in the tangent plane, seven numbers a contact.
    fn table() -> Table {
        let text = "duration = '1 ms'\n[materials.glass]\nyoung-modulus = '1 MPa'\nfriction = 0.5\n[contact.tangential.mindlin]\n\
                    [particles.ball]\nmaterial = 'glass'\ndiameter = '2 mm'\nmass = '10 mg'\nstart.at = { position = [[0, '1 mm']] }\n";
        let scene = Scene::parse("scene.toml", text, Path::new(""), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
        Table::new(scene.plan())
    }

    proptest! {
        /// Against a map: contacts come and go anywhere, and each that stays goes on with what it had.
        #[test]
        fn what_is_written_in_its_place_is_what_was_read(steps in vec(btree_set(0u32..600, 0..500), 1..6)) {
            let table = table();
            let law = &table.laws()[0];
            let mut history = HistoryColumns::<u32>::default();
            history.clear(law.width());
            let mut expected = BTreeMap::<u32, f64>::new();
            let mut columns = vec![ZERO; law.width()];
            for (step, touching) in (1..).zip(&steps) {
                let touching: Vec<u32> = touching.iter().copied().collect();
                let mut walk = Walk::default();
                for keys in touching.chunks(ROWS) {
                    history.recall(keys.iter().copied(), &mut walk, law, &mut columns);
                    for (r, key) in keys.iter().enumerate() {
                        prop_assert_eq!(columns[2][r], expected.get(key).copied().unwrap_or_default());
                        columns[2][r] += f64::from(step * (key + 1));
                    }
                    history.remember(keys.iter().copied(), &mut walk, &columns);
                }
                history.end(&mut walk, law);
                let before = std::mem::take(&mut expected);
                for key in touching {
                    expected.insert(key, before.get(&key).copied().unwrap_or_default() + f64::from(step * (key + 1)));
                }
                prop_assert!(history.keys.iter().eq(expected.keys()));
                prop_assert!((0..history.keys.len()).zip(expected.values()).all(|(c, value)| history.history(c).nth(2) == Some(*value)));
                prop_assert!(history.columns.iter().all(|column| column[0] == 0.0 && column.len() == history.keys.len() + 1));
                prop_assert!(history.keys.capacity() <= 700, "room for {} of at most 500", history.keys.capacity());
            }
        }
    }
}
