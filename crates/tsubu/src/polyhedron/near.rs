//! What of two bodies may touch soon.
//!
//! Most features of two bodies stay apart for many steps: conservative advancement (Mirtich 1996), feature by feature. Their distance changes by no more than both bodies have gone, each told as a path that no
//! point of it has exceeded. So a pair of features that is apart sleeps until both have gone as far; and which features are near at all is looked up again when they have gone farther than the margin of the
//! last look. What is left out cannot touch: contacts are, to the bit, those of a look at everything. So nothing of this is state, and it may be forgotten at any time.

use super::Turned;
use super::touch::{Contact, Cut, Search, touch};
use glam::DVec3;

/// Gaps are slept through but for this share, for rounding.
const SHARE: f64 = 0.999;
/// Over the rounding radii: what is nearer does not sleep.
const LEAST: f64 = 1e-5;

/// The features that are near, of all pairs of a list.
#[derive(Clone, Debug, Default)]
pub struct Near {
    /// The path of both bodies of each pair up to which nothing of them can touch [m].
    apart: Vec<f64>,
    pairs: Vec<Pair>,
    features: Vec<Sleeper>,
}

/// Two bodies.
#[derive(Clone, Copy, Debug)]
struct Pair {
    /// The path of both up to which the features are known [m].
    until: f64,
    /// Where they are, and for how many there is room.
    first: u32,
    count: u32,
    room: u32,
}

/// A pair of features.
#[derive(Clone, Copy, Debug)]
struct Sleeper {
    /// The path of both bodies up to which it cannot touch [m].
    until: f64,
    feature: u32,
    /// The face that a corner was nearest to.
    face: u32,
}

/// Nothing is known.
const UNKNOWN: Pair = Pair { until: f64::NEG_INFINITY, first: 0, count: 0, room: 0 };

/// What is looked at.
const AWAKE: Sleeper = Sleeper { until: f64::NEG_INFINITY, feature: 0, face: 0 };

/// The path up to which a gap [m] can be slept through, from a path on [m].
fn sleep(path: f64, gap: f64, radii: f64) -> f64 {
    if gap > LEAST * radii { path + SHARE * gap } else { f64::NEG_INFINITY }
}

impl Near {
    /// Forgets all; from now on there are so many pairs.
    pub fn forget(&mut self, pairs: usize) {
        self.apart.clear();
        self.apart.resize(pairs, f64::NEG_INFINITY);
        self.pairs.clear();
        self.pairs.resize(pairs, UNKNOWN);
        self.features.clear();
    }

    /// Forgets all; there are as many pairs as before.
    pub fn forget_all(&mut self) {
        self.forget(self.pairs.len());
    }

    /// Whether nothing of a pair can touch before both bodies have gone farther than so far [m].
    #[inline]
    pub fn is_apart(&self, pair: usize, path: f64) -> bool {
        path <= self.apart[pair]
    }

    /// Appends where the two bodies of a pair touch, or are nearer than `reach` [m], as [`touch`] does; `path` is how far both have gone [m].
    pub fn touch(
        &mut self,
        pair: usize,
        path: f64,
        (bodies, apart, reach): ([&Turned; 2], DVec3, f64),
        search: &mut Search,
        found: &mut Vec<Contact>,
    ) {
        if path > self.pairs[pair].until {
            self.look(pair, path, (bodies, apart, reach), search, found);
        }
        let Pair { first, count, .. } = self.pairs[pair];
        let radii = bodies[0].rounding + bodies[1].rounding;
        let cut = Cut { radii, reach };
        for sleeper in &mut self.features[first as usize..(first + count) as usize] {
            if path <= sleeper.until {
                continue;
            }
            match cut.at(bodies, apart, sleeper.feature, &mut sleeper.face) {
                Ok(contact) => found.push(contact),
                Err(gap) => sleeper.until = sleep(path, gap, radii),
            }
        }
    }

    /// Looks which features of a pair are near.
    fn look(
        &mut self,
        pair: usize,
        path: f64,
        (bodies, apart, reach): ([&Turned; 2], DVec3, f64),
        search: &mut Search,
        found: &mut Vec<Contact>,
    ) {
        let margin = bodies[0].rounding + bodies[1].rounding;
        let before = found.len();
        let beyond = touch(bodies, apart, reach + margin, search, found);
        let Self { apart: asleep, pairs, features } = self;
        let known = &mut pairs[pair];
        known.until = path + SHARE * (margin + beyond);
        known.count = (found.len() - before) as u32;
        asleep[pair] = if known.count == 0 { known.until } else { f64::NEG_INFINITY };
        if known.count > known.room {
            // What it had stays behind; rooms double, so it is less than what is there.
            (known.first, known.room) = (features.len() as u32, known.count.next_power_of_two());
            features.resize(features.len() + known.room as usize, AWAKE);
        }
        for (sleeper, contact) in features[known.first as usize..].iter_mut().zip(found.drain(before..)) {
            *sleeper = Sleeper { feature: contact.feature, ..AWAKE };
        }
    }
}
