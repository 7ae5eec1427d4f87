//! One step of a column of sites: what comes in from the neighbours, walls, collisions, force.

use super::bits::{Bits, WIDE, Wide};
use super::chance::{Odds, fair};
use super::collide::{REST, Rules, SLOTS, collide};
use crate::random::Purpose;
use multiversion::multiversion;

/// What is the same for all columns in a step.
#[derive(Clone, Copy, Debug)]
pub struct Spec {
    /// Which collisions there are.
    pub rules: Rules,
    /// Blocks of a column, an even number, without the margin of one at either end.
    pub blocks: usize,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Steps done.
    pub step: u64,
    /// How often a site that can turns a particle along x and along z.
    pub force: [Odds; 2],
    /// Whether the force points to -x, to -z.
    pub negative: [bool; 2],
}

/// Where the walls of a column are.
#[derive(Clone, Copy, Debug)]
pub struct Walls<'a> {
    /// Sites of walls, which send back what comes in.
    pub solid: &'a [u64],
    /// Sites of smooth walls that stand upright and that lie flat, which mirror it instead; empty where there are none.
    pub smooth: [&'a [u64]; 2],
}

/// Slots seen in a mirror that stands upright, and in one that lies flat.
pub const MIRRORED: [[usize; 6]; 2] = [[0, 5, 4, 3, 2, 1], [3, 2, 1, 0, 5, 4]];

/// The next state of a column from the present one of itself (`from[1]`) and its neighbours to the left and right. `odd`: the
/// column stands half a spacing higher than even ones.
#[multiversion(targets = "simd")]
pub fn column(spec: &Spec, number: usize, from: [&[u64]; 3], walls: Walls, next: &mut [u64]) {
    match spec.rules {
        Rules::One => pass(spec, Rules::One, number, from, walls, next),
        Rules::Two => pass(spec, Rules::Two, number, from, walls, next),
        Rules::Three => pass(spec, Rules::Three, number, from, walls, next),
    }
}

/// Words of a block: [`WIDE`] of every slot.
pub const BLOCK: usize = SLOTS * WIDE;

/// Where a word of a slot's plane is in its column.
#[inline]
pub fn at(slot: usize, word: usize) -> usize {
    (1 + word / WIDE) * BLOCK + slot * WIDE + word % WIDE
}

/// Empties what lies beyond the last row and, where the ends of a column meet, shows each end what waits at the other.
pub fn close(column: &mut [u64], blocks: usize, rows: usize, periodic: bool) {
    for slot in 0..SLOTS {
        let end = rows / 64;
        if !rows.is_multiple_of(64) {
            column[at(slot, end)] &= (1 << (rows % 64)) - 1;
        }
        // The word after the last block too, where a row of before may still wait.
        for word in rows.div_ceil(64)..=blocks * WIDE {
            column[at(slot, word)] = 0;
        }
        if periodic {
            let top = column[at(slot, (rows - 1) / 64)] >> ((rows - 1) % 64) & 1;
            column[slot * WIDE + WIDE - 1] = top << 63;
            column[at(slot, end)] |= (column[at(slot, 0)] & 1) << (rows % 64);
        }
    }
}

#[inline(always)]
fn pass(spec: &Spec, rules: Rules, number: usize, from: [&[u64]; 3], walls: Walls, next: &mut [u64]) {
    // Who comes from where, in the order of slots: N, S and rest from the column itself, the others from left and right.
    const SIDE: [usize; SLOTS] = [1, 0, 0, 1, 2, 2, 1];
    let odd = number % 2 == 1;
    let mut turn = [Wide::NONE; 2];
    let next = next[BLOCK..].chunks_exact_mut(BLOCK);
    for (block, next) in next.take(spec.blocks).enumerate() {
        // The block with the one before and the one after.
        let near = from.map(|column| &column[block * BLOCK..(block + 3) * BLOCK]);
        let mut n = [Wide::NONE; SLOTS];
        for (slot, n) in n.iter_mut().enumerate() {
            let near = near[SIDE[slot]];
            let at = BLOCK + slot * WIDE;
            let here = Wide::at(near, at);
            *n = match slot {
                0 => here.from_below(near[at - BLOCK + WIDE - 1]),
                3 => here.from_above(near[at + BLOCK]),
                1 | 5 if !odd => here.from_below(near[at - BLOCK + WIDE - 1]),
                2 | 4 if odd => here.from_above(near[at + BLOCK]),
                _ => here,
            };
        }
        if block % 2 == 0 {
            turn = fair(spec.seed, Purpose::Turn, (number * (spec.blocks / 2) + block / 2) as u32, spec.step);
        }
        let mut new = collided(rules, &n, &turn[block % 2]);
        let solid = Wide::at(walls.solid, block * WIDE);
        if solid.any() {
            let mut back = n;
            for i in 0..6 {
                back[i] = n[(i + 3) % 6];
            }
            for (mirror, smooth) in MIRRORED.iter().zip(walls.smooth) {
                if !smooth.is_empty() {
                    let here = Wide::at(smooth, block * WIDE);
                    for i in 0..6 {
                        back[i] = (here & n[mirror[i]]) | (!here & back[i]);
                    }
                }
            }
            for i in 0..SLOTS {
                new[i] = (solid & back[i]) | (!solid & new[i]);
            }
        }
        for (slot, new) in new.into_iter().enumerate() {
            if slot != REST || rules != Rules::One {
                new.put(next, slot * WIDE);
            }
        }
    }
}

/// Collisions of a block: word by word in a loop. Written for eight words at once the compiler would take them apart and put them
/// together again otherwise (a third slower).
#[inline(always)]
fn collided(rules: Rules, n: &[Wide; SLOTS], turn: &Wide) -> [Wide; SLOTS] {
    let mut new = [Wide::NONE; SLOTS];
    for lane in 0..WIDE {
        let mut word = [0; SLOTS];
        for (word, n) in word.iter_mut().zip(n) {
            *word = n.0[lane];
        }
        let word = collide(rules, word, turn.0[lane]);
        for (new, word) in new.iter_mut().zip(word) {
            new.0[lane] = word;
        }
    }
    new
}

/// Turns particles toward the force: along z from N to S (or back), along x from an eastern to the western direction beside
/// it, where the slot is free. Every turn gives the same momentum; returns how many there were along either axis.
#[multiversion(targets = "simd")]
pub fn force(spec: &Spec, number: usize, solid: &[u64], next: &mut [u64]) -> [u64; 2] {
    const TURNS: [&[(usize, usize)]; 2] = [&[(5, 1), (4, 2)], &[(3, 0)]];
    let mut turns = [0; 2];
    for axis in 0..2 {
        if spec.force[axis] == Odds::default() {
            continue;
        }
        for (pair, next) in next[BLOCK..].chunks_exact_mut(2 * BLOCK).take(spec.blocks / 2).enumerate() {
            let place = (number * spec.blocks + 2 * pair + axis) as u32;
            let drawn = spec.force[axis].draw(spec.seed, Purpose::Force, place, spec.step);
            for (half, next) in next.chunks_exact_mut(BLOCK).enumerate() {
                let free = drawn[half] & !Wide::at(solid, (2 * pair + half) * WIDE);
                for &(low, high) in TURNS[axis] {
                    let (from, to) = if spec.negative[axis] { (high, low) } else { (low, high) };
                    let (a, b) = (Wide::at(next, from * WIDE), Wide::at(next, to * WIDE));
                    let moved = free & a & !b;
                    (a ^ moved).put(next, from * WIDE);
                    (b ^ moved).put(next, to * WIDE);
                    for word in moved.0 {
                        turns[axis] += u64::from(word.count_ones());
                    }
                }
            }
        }
    }
    turns
}
