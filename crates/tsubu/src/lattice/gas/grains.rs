//! Lattice gases of grains: FHP-II that loses energy, under gravity, between rough or smooth walls (after Peng and Herrmann
//! 1994, 1995). Site by site: every grain needs random numbers of its own, and heaps of rest grains have to be let hop.

use super::bits::WIDE;
use super::chance::fair;
use super::collide::{REST, Rules, SLOTS, collide};
use super::step::MIRRORED;
use crate::lattice::direction::{Direction, Vector};
use crate::random::{Purpose, words};

/// What the grains do beside flying and colliding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Habits {
    /// Probability that gravity turns a grain by 60 degrees downward in a step, or lets one at rest go.
    pub gravity: f64,
    /// Probability that the grains of a collision, as FHP-II knows them, stay where they met.
    pub dissipation: f64,
    /// Probability that a wall sends a grain back where it came from instead of mirroring it.
    pub roughness: f64,
}

/// How often a surplus grain hops in a step before it gives up until the next.
const HOPS: u32 = 10_000;

/// A gas of grains.
#[derive(Clone, Debug)]
pub struct Grains {
    pub(super) columns: usize,
    pub(super) rows: usize,
    periodic: [bool; 2],
    habits: Habits,
    pub(super) seed: u64,
    pub(super) step: u64,
    /// After a collision: by chirality and state.
    table: [[u8; 1 << SLOTS]; 2],
    pub(super) state: Vec<u8>,
    next: Vec<u8>,
    /// 0: gas; 1: an upright wall; 2: a wall that lies flat.
    pub(super) wall: Vec<u8>,
    /// Grains at rest that found no place, by site, and their axes, two bits each.
    surplus: Vec<(u32, u8, u16)>,
    /// Axis of the grain in every slot, two bits each; nothing for round grains.
    pub(super) axes: Vec<u16>,
    pub(super) next_axes: Vec<u16>,
    /// Momentum that gravity gave in the last step, in the basis (h, k).
    pulled: Vector,
}

impl Grains {
    /// No grains and no walls.
    ///
    /// # Panics
    ///
    /// Where columns of one kind would meet: a lattice periodic along x needs an even number of them.
    pub fn new(columns: usize, rows: usize, periodic: [bool; 2], habits: Habits, seed: u64) -> Self {
        assert!(!periodic[0] || columns.is_multiple_of(2), "odd columns stand higher");
        let mut table = [[0; 1 << SLOTS]; 2];
        for (turn, table) in table.iter_mut().enumerate() {
            for (state, after) in table.iter_mut().enumerate() {
                let n = std::array::from_fn(|slot| (state >> slot & 1) as u64);
                let new = collide(Rules::Two, n, turn as u64);
                *after = (0..SLOTS).map(|slot| ((new[slot] & 1) as u8) << slot).sum();
            }
        }
        let sites = columns * rows;
        Self {
            columns,
            rows,
            periodic,
            habits,
            seed,
            step: 0,
            table,
            state: vec![0; sites],
            next: vec![0; sites],
            wall: vec![0; sites],
            surplus: Vec::new(),
            axes: Vec::new(),
            next_axes: Vec::new(),
            pulled: Vector::default(),
        }
    }

    /// Makes a site a wall, upright or flat.
    pub fn set_wall(&mut self, column: usize, row: usize, flat: bool) {
        self.wall[column * self.rows + row] = 1 + u8::from(flat);
    }

    /// Whether a site is wall.
    pub fn is_wall(&self, column: usize, row: usize) -> bool {
        self.wall[column * self.rows + row] > 0
    }

    /// Puts grains into a site: bit i for slot i.
    pub fn set_site(&mut self, column: usize, row: usize, state: u8) {
        self.state[column * self.rows + row] = state;
    }

    /// Who is in a site.
    pub fn site(&self, column: usize, row: usize) -> u8 {
        self.state[column * self.rows + row]
    }

    /// Steps done.
    pub fn steps(&self) -> u64 {
        self.step
    }

    /// The neighbour of a site, if there is one.
    #[inline]
    pub(super) fn neighbour(&self, column: usize, row: usize, way: Direction) -> Option<(usize, usize)> {
        let wrap = |at: i64, size: usize, ends: bool| {
            let inside = (0..size as i64).contains(&at);
            if inside {
                Some(at as usize)
            } else if ends {
                Some(at.rem_euclid(size as i64) as usize)
            } else {
                None
            }
        };
        let to = wrap(column as i64 + way.h(), self.columns, self.periodic[0])?;
        let row = (2 * row as i64 + (column % 2) as i64 + way.k() - (to % 2) as i64) >> 1;
        Some((to, wrap(row, self.rows, self.periodic[1])?))
    }

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
        self.next_axes.fill(0);
        for column in 0..self.columns {
            for row in 0..self.rows {
                let at = column * self.rows + row;
                let state = self.state[at];
                if state == 0 {
                    continue;
                }
                self.next[at] |= state & 1 << REST;
                self.carry(at, REST, at);
                for way in Direction::ALL {
                    if state >> way as u8 & 1 == 1
                        && let Some((c, r)) = self.neighbour(column, row, way)
                    {
                        self.next[c * self.rows + r] |= 1 << way as u8;
                        self.carry(at, way as usize, c * self.rows + r);
                    }
                }
            }
        }
        std::mem::swap(&mut self.state, &mut self.next);
        std::mem::swap(&mut self.axes, &mut self.next_axes);
    }

    /// Takes the axis of a slot along to the next state of a site.
    #[inline]
    fn carry(&mut self, from: usize, slot: usize, to: usize) {
        if !self.axes.is_empty() {
            self.next_axes[to] |= self.axes[from] & 3 << (2 * slot);
        }
    }

    /// Gives a site a new state; whoever was there takes his axis along, in the order of slots.
    #[inline]
    fn become_state(&mut self, at: usize, new: u8) {
        let old = std::mem::replace(&mut self.state[at], new);
        if !self.axes.is_empty() && old != new {
            let slots = |state: u8| (0..SLOTS).filter(move |slot| state >> slot & 1 == 1);
            let axes = self.axes[at];
            self.axes[at] = slots(old).zip(slots(new)).map(|(from, to)| (axes >> (2 * from) & 3) << (2 * to)).sum();
        }
    }

    fn collide(&mut self) {
        let pairs = self.rows.div_ceil(128 * WIDE);
        let odds = (self.habits.dissipation * f64::from(u16::MAX)) as u16;
        let rough = (self.habits.roughness * f64::from(u32::MAX)) as u32;
        let mut turns = Vec::with_capacity(2 * WIDE * pairs);
        for column in 0..self.columns {
            // The bits that the planes of FHP have there.
            turns.clear();
            for pair in 0..pairs {
                let drawn = fair(self.seed, Purpose::Turn, (column * pairs + pair) as u32, self.step);
                turns.extend(drawn.iter().flat_map(|wide| wide.0));
            }
            for row in 0..self.rows {
                let at = column * self.rows + row;
                let state = self.state[at];
                if state.trailing_zeros() >= REST as u32 {
                    continue;
                }
                if self.wall[at] > 0 {
                    let mirror = MIRRORED[usize::from(self.wall[at]) - 1];
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
                        let met = state.count_ones() as u8;
                        // The first of them keeps the site.
                        let mut axes = 0;
                        if !self.axes.is_empty() {
                            let there = (0..SLOTS).filter(|slot| state >> slot & 1 == 1);
                            let all = there
                                .enumerate()
                                .map(|(i, slot)| (self.axes[at] >> (2 * slot) & 3) << (2 * i))
                                .sum::<u16>();
                            self.axes[at] = (all & 3) << (2 * REST);
                            axes = all >> 2;
                        }
                        self.state[at] = 1 << REST;
                        self.surplus.push((at as u32, met - 1, axes));
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
                    if !self.axes.is_empty() {
                        let axis = self.axes[at] >> (2 * slot) & 3;
                        self.axes[at] = self.axes[at] & !(3 << (2 * slot)) | axis << (2 * to);
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
        for (index, (at, count, axes)) in waiting.iter_mut().enumerate() {
            while *count > 0 {
                let (mut column, mut row) = (*at as usize / self.rows, *at as usize % self.rows);
                let mut found = false;
                for hop in 0..HOPS {
                    let key = self.step << 20 | u64::from(hop) << 4 | u64::from(*count);
                    let [word, ..] = words(self.seed, Purpose::Lottery, index as u32 ^ *at, key);
                    let way = Direction::from_index(((u64::from(word) * 6) >> 32) as usize);
                    let Some(to) = self.neighbour(column, row, way) else { continue };
                    if self.is_wall(to.0, to.1) {
                        continue;
                    }
                    (column, row) = to;
                    let place = &mut self.state[column * self.rows + row];
                    if *place >> REST & 1 == 0 {
                        *place |= 1 << REST;
                        if let Some(there) = self.axes.get_mut(column * self.rows + row) {
                            *there |= (*axes & 3) << (2 * REST);
                        }
                        *axes >>= 2;
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
        waiting.retain(|(_, count, _)| *count > 0);
        self.surplus = waiting;
    }

    /// Momentum that gravity gave in the last step, in the basis (h, k).
    pub fn pulled(&self) -> Vector {
        self.pulled
    }

    /// Number of grains.
    pub fn mass(&self) -> u64 {
        let there: u64 = self.state.iter().map(|s| u64::from(s.count_ones())).sum();
        there + self.surplus.iter().map(|(_, count, _)| u64::from(*count)).sum::<u64>()
    }

    /// Momentum in the basis (h, k).
    pub fn momentum(&self) -> Vector {
        let mut sum = Vector::default();
        for state in &self.state {
            for way in Direction::ALL {
                sum = sum.plus(way.times(i64::from(state >> way as u8 & 1)));
            }
        }
        sum
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

#[cfg(test)]
mod tests {
    use super::{Grains, Habits};
    use crate::lattice::direction::Vector;
    use proptest::prelude::*;

    fn scattered(habits: Habits, walls: bool, thinning: u32) -> Grains {
        let mut grains = Grains::new(10, 40, [true, !walls], habits, 4);
        for row in 0..40 {
            for column in 0..10 {
                if walls && (row % 39 == 0 || (column == 3 && row < 20)) {
                    grains.set_wall(column, row, row % 39 == 0);
                } else {
                    let drawn =
                        crate::random::words(4, crate::random::Purpose::Placement, (column * 40 + row) as u32, 0);
                    grains.set_site(
                        column,
                        row,
                        (drawn[0] & drawn[1] & drawn[2] & drawn[3].rotate_left(thinning)) as u8 & 0x7F,
                    );
                }
            }
        }
        grains
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(40))]
        /// Nobody is lost, whatever the grains do, and walls keep them.
        #[test]
        fn grains_are_kept(g in 0.0..1.0_f64, d in 0.0..1.0_f64, r in 0.0..1.0_f64, walls: bool, thinning in 0_u32..32) {
            let habits = Habits { gravity: g, dissipation: d, roughness: r };
            let mut grains = scattered(habits, walls, thinning);
            let mass = grains.mass();
            for _ in 0..30 {
                grains.step();
                prop_assert_eq!(grains.mass(), mass);
            }
        }

        /// Without walls and dissipation momentum changes by what gravity gives.
        #[test]
        fn gravity_gives_all_momentum(g in 0.0..1.0_f64) {
            let mut grains = scattered(Habits { gravity: g, dissipation: 0.0, roughness: 1.0 }, false, 28);
            for _ in 0..20 {
                let Vector { h, k } = grains.momentum();
                grains.step();
                let given = grains.pulled();
                prop_assert_eq!(grains.momentum(), Vector { h: h + given.h, k: k + given.k });
            }
        }
    }
}
