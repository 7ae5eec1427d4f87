//! What of two bodies may touch soon.
//!
//! Most features of two bodies stay apart for many steps: conservative advancement (Mirtich 1996), feature by feature. Their distance changes by no more than both bodies have gone, each told as a path that no
//! point of it has exceeded. So a pair of features that is apart sleeps until both have gone as far; and which features are near at all is looked up again when they have gone farther than the margin of the
//! last look. What is left out cannot touch: contacts are, to the bit, those of a look at everything. So nothing of this is state, and it may be forgotten at any time.

use super::Turned;
use super::awake::{Awake, Couple};
use super::contact::Contact;
use super::touch::{Search, touch};
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
    pub(super) features: Vec<Sleeper>,
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

/// A pair of features: few bytes, for a step walks along all of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sleeper {
    /// The path of both bodies up to which it cannot touch, or, of a corner that is [`OVER`] or [`BESIDE`], up to which it stays there [m].
    until: f64,
    /// See [`Contact::feature`].
    pub feature: u32,
    /// The face that a corner was nearest to, or the edge; with one of these marks.
    place: u32,
}

/// A corner is straight above a face, or below, and no other is nearer.
const OVER: u32 = 1 << 31;
/// A corner is nearest to an edge.
const BESIDE: u32 = 1 << 30;

/// Nothing is known.
const UNKNOWN: Pair = Pair { until: f64::NEG_INFINITY, first: 0, count: 0, room: 0 };

/// What is looked at.
const AWAKE: Sleeper = Sleeper { until: f64::NEG_INFINITY, feature: 0, place: 0 };

impl Sleeper {
    /// Whether it may touch after a path.
    #[expect(clippy::needless_bitwise_bool, reason = "a processor cannot guess which")]
    #[inline]
    pub fn is_awake(&self, path: f64) -> bool {
        (path > self.until) | (self.place >= BESIDE)
    }

    /// It is not nearer than a gap [m], over the rounding radii not too small to sleep.
    #[inline]
    pub fn sleep(&mut self, path: f64, gap: f64, radii: f64) {
        self.until = if gap > LEAST * radii { path + SHARE * gap } else { f64::NEG_INFINITY };
        self.place = 0;
    }

    /// The distance of a corner from a core, as [`Turned::distance`] tells it.
    #[inline]
    pub fn distance(&mut self, path: f64, core: &Turned, point: DVec3, cut: f64) -> Result<(f64, DVec3), f64> {
        let (mark, number) = (self.place & (OVER | BESIDE), self.place & !(OVER | BESIDE));
        if mark > 0 && path <= self.until {
            return if mark == OVER {
                core.distance_over(number as usize, point, cut)
            } else {
                core.distance_beside(number as usize, point, cut)
            };
        }
        let mut face = if mark == OVER { number } else { 0 };
        let found = core.distance_from(&mut face, point, cut)?;
        let over = core.slack(face as usize, point);
        let (edge, beside) = if over > 0.0 { (0, 0.0) } else { core.beside(point) };
        (self.until, self.place) = if over > 0.0 {
            (path + over, OVER | face)
        } else if beside > 0.0 {
            (path + beside, BESIDE | edge as u32)
        } else {
            (f64::NEG_INFINITY, 0)
        };
        Ok(found)
    }
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

    /// Adds the features of two bodies that may touch, or may be nearer than `reach` [m].
    pub fn wake(&mut self, couple: Couple, bodies: [&Turned; 2], reach: f64, search: &mut Search, awake: &mut Awake) {
        if couple.path > self.pairs[couple.pair as usize].until {
            self.look(&couple, bodies, reach, search, &mut awake.found);
        }
        let Pair { first, count, .. } = self.pairs[couple.pair as usize];
        awake.add(couple, first, &self.features[first as usize..(first + count) as usize]);
    }

    /// Looks which features of a pair are near.
    fn look(
        &mut self,
        &Couple { pair, path, apart, .. }: &Couple,
        bodies: [&Turned; 2],
        reach: f64,
        search: &mut Search,
        found: &mut Vec<Contact>,
    ) {
        let margin = bodies[0].rounding + bodies[1].rounding;
        found.clear();
        let beyond = touch(bodies, apart, reach + margin, search, found);
        let Self { apart: asleep, pairs, features } = self;
        let known = &mut pairs[pair as usize];
        known.until = path + SHARE * (margin + beyond);
        known.count = found.len() as u32;
        asleep[pair as usize] = if known.count == 0 { known.until } else { f64::NEG_INFINITY };
        if known.count > known.room {
            // What it had stays behind; rooms double, so it is less than what is there.
            (known.first, known.room) = (features.len() as u32, known.count.next_power_of_two());
            features.resize(features.len() + known.room as usize, AWAKE);
        }
        for (sleeper, contact) in features[known.first as usize..].iter_mut().zip(found) {
            *sleeper = Sleeper { feature: contact.feature, ..AWAKE };
        }
    }
}
