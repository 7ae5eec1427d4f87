//! One step of a gas of grains: they fly, meet walls, collide, fall under gravity, and those who came to rest where somebody
//! rests hop on.

use super::{Grains, Surplus};
use crate::lattice::direction::{Direction, Vector};
use crate::lattice::gas::bits::WIDE;
use crate::lattice::gas::chance::fair;
use crate::lattice::gas::collide::REST;
use crate::lattice::gas::numbers::{EMPTY, NOBODY, go_on};
use crate::lattice::gas::step::MIRRORED;
use crate::random::{Purpose, words};

/// Slots after a wall that sends back.
const REVERSED: [usize; 6] = [3, 4, 5, 0, 1, 2];

/// How often a surplus grain hops in a step before it gives up until the next.
const HOPS: u32 = 10_000;

impl Grains {
    /// One step: fly, meet walls, collide, fall, hop.
    pub fn step(&mut self) {
        self.fly();
        self.collide();
        self.fall();
        self.hop();
        self.step += 1;
    }

    fn fly(&mut self) {
        self.next.fill(0);
        if let Some(numbers) = &mut self.numbers {
            numbers.cross();
            numbers.next.fill(EMPTY);
        }
        for column in 0..self.sites.columns {
            for row in 0..self.sites.rows {
                let at = self.sites.index(column, row);
                let state = self.state[at];
                if state == 0 {
                    continue;
                }
                self.next[at] |= state & 1 << REST;
                self.carry(at, REST, at);
                for way in Direction::ALL {
                    if state >> way as u8 & 1 == 1
                        && let Some((c, r)) = self.sites.neighbour(column, row, way)
                    {
                        let to = self.sites.index(c, r);
                        self.next[to] |= 1 << way as u8;
                        self.carry(at, way as usize, to);
                    }
                }
            }
        }
        std::mem::swap(&mut self.state, &mut self.next);
        if let Some(numbers) = &mut self.numbers {
            std::mem::swap(&mut numbers.crews, &mut numbers.next);
        }
    }

    /// Takes the number of a slot along to the next state of a site.
    #[inline]
    fn carry(&mut self, from: usize, slot: usize, to: usize) {
        if let Some(numbers) = &mut self.numbers
            && numbers.crews[from][slot] != NOBODY
        {
            numbers.next[to][slot] = numbers.crews[from][slot];
        }
    }

    /// Gives a site a new state; whoever was there takes his number along, in the order of slots.
    #[inline]
    fn become_state(&mut self, at: usize, new: u8) {
        let old = std::mem::replace(&mut self.state[at], new);
        if let Some(numbers) = &mut self.numbers
            && old != new
        {
            numbers.crews[at] = go_on(numbers.crews[at], new);
        }
    }

    /// Those who met on a site come to rest: the first of them keeps it, the others have to look for a place.
    fn come_to_rest(&mut self, at: usize) {
        let count = self.state[at].count_ones() as u8 - 1;
        self.state[at] = 1 << REST;
        let mut waiting = Surplus { site: at as u32, count, who: EMPTY };
        if let Some(numbers) = &mut self.numbers {
            let mut there = numbers.crews[at].into_iter().filter(|who| *who != NOBODY);
            let mut crew = EMPTY;
            crew[REST] = there.next().unwrap_or(NOBODY);
            waiting.who.iter_mut().zip(there).for_each(|(to, who)| *to = who);
            numbers.crews[at] = crew;
        }
        self.surplus.push(waiting);
    }

    fn collide(&mut self) {
        let pairs = self.sites.rows.div_ceil(128 * WIDE);
        let odds = (self.habits.dissipation * f64::from(u16::MAX)) as u16;
        let rough = (self.habits.roughness * f64::from(u32::MAX)) as u32;
        let mut turns = Vec::with_capacity(2 * WIDE * pairs);
        for column in 0..self.sites.columns {
            // The bits that the planes of FHP have there.
            turns.clear();
            for pair in 0..pairs {
                let drawn = fair(self.seed, Purpose::Turn, (column * pairs + pair) as u32, self.step);
                turns.extend(drawn.iter().flat_map(|wide| wide.0));
            }
            for row in 0..self.sites.rows {
                let at = self.sites.index(column, row);
                let state = self.state[at];
                if state.trailing_zeros() >= REST as u32 {
                    continue;
                }
                if self.wall[at] > 0 {
                    let mirror = MIRRORED.get(usize::from(self.wall[at]) - 1).copied().unwrap_or(REVERSED);
                    let back = words(self.seed, Purpose::Rebound, at as u32, self.step);
                    let word = |slot: usize| back[slot % 4].rotate_left(7 * slot as u32);
                    let out = |slot: usize| {
                        if rough == u32::MAX || word(slot) < rough { (slot + 3) % 6 } else { mirror[slot] }
                    };
                    self.become_state(at, send_back(state, out, mirror));
                    continue;
                }
                if odds > 0 && self.table[0][usize::from(state)] != state {
                    let [word, ..] = words(self.seed, Purpose::Order, at as u32, self.step);
                    if (word as u16) < odds {
                        self.come_to_rest(at);
                        continue;
                    }
                }
                let turn = turns[row / 64] >> (row % 64) & 1;
                self.become_state(at, self.table[turn as usize][usize::from(state)]);
            }
        }
    }

    fn fall(&mut self) {
        self.pulled = Vector::default();
        let odds = (self.habits.gravity * f64::from(u16::MAX)) as u16;
        if odds == 0 {
            return;
        }
        for at in 0..self.state.len() {
            let mut state = self.state[at];
            if state == 0 || self.wall[at] > 0 {
                continue;
            }
            let w = words(self.seed, Purpose::Force, at as u32, self.step);
            let draw = |slot: usize| (w[slot / 2] >> (16 * (slot % 2))) as u16;
            let side = w[3] >> 16 & 1 == 1;
            // From the lowest up, so that who makes room is asked first. N turns to one side.
            for (slot, to) in [(2, 3), (4, 3), (REST, 3), (1, 2), (5, 4), (0, if side { 1 } else { 5 })] {
                if state >> slot & 1 == 1 && state >> to & 1 == 0 && draw(slot) < odds {
                    state ^= 1 << slot | 1 << to;
                    if let Some(numbers) = &mut self.numbers {
                        numbers.crews[at].swap(slot, to);
                    }
                    let way = |slot: usize| {
                        if slot == REST { Vector::default() } else { Direction::from_index(slot).times(1) }
                    };
                    self.pulled.h += way(to).h - way(slot).h;
                    self.pulled.k += way(to).k - way(slot).k;
                }
            }
            self.state[at] = state;
        }
    }

    /// Surplus grains hop from site to site until one has room for a grain at rest.
    fn hop(&mut self) {
        let mut waiting = std::mem::take(&mut self.surplus);
        for (index, Surplus { site, count, who }) in waiting.iter_mut().enumerate() {
            while *count > 0 {
                let (mut column, mut row) = self.sites.column_and_row(*site as usize);
                let (mut found, mut laps) = (false, [0, 0]);
                for hop in 0..HOPS {
                    let key = self.step << 20 | u64::from(hop) << 4 | u64::from(*count);
                    let [word, ..] = words(self.seed, Purpose::Lottery, index as u32 ^ *site, key);
                    let way = Direction::from_index(((u64::from(word) * 6) >> 32) as usize);
                    let Some(to) = self.sites.neighbour(column, row, way) else { continue };
                    if self.is_wall(to.0, to.1) {
                        continue;
                    }
                    let [x, z] = self.sites.crossing(column, row, way);
                    laps = [laps[0] + x, laps[1] + z];
                    (column, row) = to;
                    let place = self.sites.index(column, row);
                    if self.state[place] >> REST & 1 == 0 {
                        self.state[place] |= 1 << REST;
                        if let Some(numbers) = &mut self.numbers {
                            numbers.crews[place][REST] = who[0];
                            numbers.lap(who[0], laps);
                            who.rotate_left(1);
                        }
                        found = true;
                        break;
                    }
                }
                if !found {
                    break;
                }
                *count -= 1;
            }
        }
        waiting.retain(|waiting| waiting.count > 0);
        self.surplus = waiting;
    }
}

/// What a wall makes of those who come in: each goes where it is sent if the slot is free, else where the other rule sends it, else
/// to the first free one.
fn send_back(state: u8, out: impl Fn(usize) -> usize, mirror: [usize; 6]) -> u8 {
    let mut new = state & 1 << REST;
    for slot in (0..6).filter(|slot| state >> slot & 1 == 1) {
        let free = |to: &usize| new >> to & 1 == 0;
        let to = [out(slot), (slot + 3) % 6, mirror[slot]].into_iter().find(free).or_else(|| (0..6).find(free));
        new |= 1 << to.unwrap_or(slot);
    }
    new
}
