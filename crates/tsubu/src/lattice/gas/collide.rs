//! Collisions of the lattice gases FHP-I, II and III (Frisch, d'Humieres, Hasslacher, Lallemand, Pomeau, Rivet 1987) as
//! bit logic: what is written for one site happens at 64 sites of a word at once.
//!
//! A collision keeps the number of particles and their momentum. Three moves do that, and every rule is made of them:
//! a head-on pair **turns** onto another axis (an empty axis between full ones likewise), a symmetric triple **flips**, and a
//! mover with a particle at rest **parts** into the two neighbouring directions, or back.

use super::bits::Bits;
use crate::mutation::{Mutation, left_out};

/// Slots of a site: six directions in the order of [`crate::lattice::direction::Direction`], and rest.
pub const SLOTS: usize = 7;
/// The slot of the particle at rest.
pub const REST: usize = 6;

/// Which collisions there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rules {
    /// Six velocities: head-on pairs and symmetric triples.
    One,
    /// Also a particle at rest, which stands by, or parts with a mover when nobody else is there.
    Two,
    /// Every state that another one shares mass and momentum with goes over into such a one.
    Three,
}

/// The state of sites after a collision. `turn` says where a choice of two is left which to take.
#[inline(always)]
pub fn collide<T: Bits>(rules: Rules, n: [T; SLOTS], turn: T) -> [T; SLOTS] {
    match rules {
        Rules::One => one(n, turn),
        Rules::Two => two(n, turn),
        Rules::Three => three(n, turn),
    }
}

/// Axes whose pair of slots changes when the axes in `alone` differ from both others: `alone` gives its state to the next
/// axis or to the one after.
#[inline(always)]
fn turned<T: Bits>(alone: [T; 3], turn: T) -> [T; 3] {
    let [a, b, c] = alone;
    [a | (turn & c) | (!turn & b), b | (turn & a) | (!turn & c), c | (turn & b) | (!turn & a)]
}

/// Sites where one axis is full and the others are empty, and those where slots are full and empty by turns.
#[inline(always)]
fn pairs_and_triples<T: Bits>(n: &[T; SLOTS]) -> ([T; 3], T) {
    let (even, odd) = (n[0] & n[2] & n[4], n[1] & n[3] & n[5]);
    let (no_even, no_odd) = (!(n[0] | n[2] | n[4]), !(n[1] | n[3] | n[5]));
    let mut pair = [T::NONE; 3];
    for a in 0..3 {
        let (b, c) = ((a + 1) % 3, (a + 2) % 3);
        pair[a] = n[a] & n[a + 3] & !(n[b] | n[b + 3] | n[c] | n[c + 3]);
    }
    let triple = if left_out(Mutation::TripleCollision) { T::NONE } else { (even & no_odd) | (odd & no_even) };
    (pair, triple)
}

#[inline(always)]
fn one<T: Bits>(n: [T; SLOTS], turn: T) -> [T; SLOTS] {
    let (pair, triple) = pairs_and_triples(&n);
    changed(n, turned(pair, turn), triple, [T::NONE; 6])
}

#[inline(always)]
fn two<T: Bits>(n: [T; SLOTS], turn: T) -> [T; SLOTS] {
    let (pair, triple) = pairs_and_triples(&n);
    let rest = n[REST];
    let mut part = [T::NONE; 6];
    for i in 0..6 {
        let (left, right) = (n[(i + 5) % 6], n[(i + 1) % 6]);
        let far = n[(i + 2) % 6] | n[(i + 3) % 6] | n[(i + 4) % 6];
        part[i] = ((rest & n[i] & !(left | right)) | (left & right & !(rest | n[i]))) & !far;
    }
    changed(n, turned(pair, turn), triple, part)
}

/// FHP-III treats particles and holes alike. Seen from the rest slot (is a slot as full as it?) a state and its negative are
/// one, and of 128 states 64 are left.
#[inline(always)]
fn three<T: Bits>(n: [T; SLOTS], turn: T) -> [T; SLOTS] {
    let mut m = [T::NONE; 6];
    for i in 0..6 {
        m[i] = n[i] ^ n[REST];
    }
    let seen = StateBits { low: eighths(m[0], m[1], m[2]), high: eighths(m[3], m[4], m[5]) };
    let mut alone = [T::NONE; 3];
    for (a, alone) in alone.iter_mut().enumerate() {
        *alone = seen.is(bit(a) | bit(a + 3)) | seen.is(63 ^ bit(a) ^ bit(a + 3));
    }
    let triple = seen.is(0b01_0101) | seen.is(0b10_1010);
    let mut axis = turned(alone, turn);
    let mut part = [T::NONE; 6];
    for i in 0..6 {
        let (after, before) = ((i + 1) % 6, (i + 5) % 6);
        part[i] = part[i] | seen.is(63 ^ bit(i)) | seen.is(bit(after) | bit(before));
        // Total momentum along direction i in three ways: with a pair on one axis, with a pair on the other, or with a
        // particle at rest between two movers. `turn` says which way round they follow each other.
        let first = seen.is(bit(i) | bit(i + 1) | bit(i + 4));
        let second = seen.is(bit(i) | bit(i + 2) | bit(i + 5));
        let third = seen.is(63 ^ bit(after) ^ bit(before));
        let swap = (first & turn) | (second & !turn);
        axis[(i + 1) % 3] = axis[(i + 1) % 3] | swap;
        axis[(i + 2) % 3] = axis[(i + 2) % 3] | swap;
        part[before] = part[before] | (third & turn) | (first & !turn);
        part[after] = part[after] | (second & turn) | (third & !turn);
    }
    changed(n, axis, triple, part)
}

/// Which of 64 states sites are in.
struct StateBits<T> {
    low: [T; 8],
    high: [T; 8],
}

impl<T: Bits> StateBits<T> {
    /// The sites in one state.
    #[inline(always)]
    fn is(&self, state: usize) -> T {
        self.low[state & 7] & self.high[state >> 3]
    }
}

/// The bit of a direction, counted round the clock.
const fn bit(direction: usize) -> usize {
    1 << (direction % 6)
}

/// The sites in each of the eight states of three slots.
#[inline(always)]
fn eighths<T: Bits>(a: T, b: T, c: T) -> [T; 8] {
    let (neither, both) = (!(a | b), a & b);
    [neither & !c, a & !(b | c), b & !(a | c), both & !c, neither & c, a & c & !b, b & c & !a, both & c]
}

/// Applies the three moves.
#[inline(always)]
fn changed<T: Bits>(n: [T; SLOTS], axis: [T; 3], triple: T, part: [T; 6]) -> [T; SLOTS] {
    let mut new = n;
    for i in 0..6 {
        new[i] = n[i] ^ (axis[i % 3] | triple | part[i] | part[(i + 1) % 6] | part[(i + 5) % 6]);
        new[REST] = new[REST] ^ part[i];
    }
    new
}

#[cfg(test)]
mod tests {
    use super::{REST, Rules, SLOTS, collide};
    use crate::lattice::direction::{Direction, Vector};

    fn after(rules: Rules, state: usize, turn: bool) -> usize {
        let n = std::array::from_fn(|i| if state >> i & 1 == 1 { u64::MAX } else { 0 });
        let out = collide(rules, n, if turn { u64::MAX } else { 0 });
        assert!(out.iter().all(|&w| w == 0 || w == u64::MAX));
        (0..SLOTS).map(|i| usize::from(out[i] != 0) << i).sum()
    }

    fn content(state: usize) -> (u32, Vector) {
        let movers = (0..REST).filter(|i| state >> i & 1 == 1);
        let momentum = movers.fold(Vector::default(), |sum, i| sum.plus(Direction::from_index(i).times(1)));
        (state.count_ones(), momentum)
    }

    /// Mass and momentum stay; no two states become one, so that no state is preferred; the published numbers of states
    /// that collide come out.
    #[test]
    fn every_state() {
        for (rules, wanted) in [(Rules::One, 5), (Rules::Two, 22), (Rules::Three, 76)] {
            let states = if rules == Rules::One { 64 } else { 128 };
            for turn in [false, true] {
                let mut seen = [false; 128];
                let mut colliding = 0;
                for state in 0..states {
                    let new = after(rules, state, turn);
                    assert_eq!(content(new), content(state), "{rules:?} {state:07b} -> {new:07b}");
                    assert!(!seen[new], "{rules:?}: two states become {new:07b}");
                    seen[new] = true;
                    colliding += usize::from(new != state);
                }
                assert_eq!(colliding, wanted, "{rules:?}");
            }
        }
    }

    /// What one chirality does is undone by the other, so that averaged over both the gas is reversible.
    #[test]
    fn the_other_chirality_undoes_it() {
        for rules in [Rules::One, Rules::Two, Rules::Three] {
            for state in 0..if rules == Rules::One { 64 } else { 128 } {
                assert_eq!(after(rules, after(rules, state, true), false), state, "{rules:?} {state:07b}");
            }
        }
    }

    /// Seen in a mirror the two chiralities change places.
    #[test]
    fn a_mirror_exchanges_chiralities() {
        let mirrored =
            |state: usize| (0..SLOTS).map(|i| (state >> i & 1) << if i == REST { REST } else { (6 - i) % 6 }).sum();
        for rules in [Rules::One, Rules::Two, Rules::Three] {
            for state in 0..if rules == Rules::One { 64 } else { 128 } {
                let there: usize = mirrored(after(rules, state, true));
                assert_eq!(there, after(rules, mirrored(state), false), "{rules:?} {state:07b}");
            }
        }
    }
}
