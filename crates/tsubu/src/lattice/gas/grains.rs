//! Lattice gases of grains: FHP-II that loses energy, under gravity, between rough or smooth walls (after Peng and Herrmann
//! 1994, 1995). Site by site: every grain needs random numbers of its own, and heaps of rest grains have to be let hop.

use super::bits::WIDE;
use super::chance::fair;
use super::collide::{REST, Rules, SLOTS, collide};
use super::numbers::{Crew, EMPTY, NOBODY, Numbers, go_on};
use super::sites::Sites;
use super::step::MIRRORED;
use crate::about::About;
use crate::lattice::direction::{Direction, Vector};
use crate::random::{Purpose, words};

pub(crate) const ABOUT: About = About {
    key: "method.after-peng-herrmann",
    formula: "FHP-II; in a step gravity turns a particle by 60 degrees downward with a probability; those of a collision stay with the probability `dissipation`; a wall sends back with `roughness`",
    symbols: "probabilities [-]",
    limits: "Speeds are 0 or 1: no temperature but by directions.",
    reference: "after Peng and Herrmann 1994, 1995",
};

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

/// Slots after a wall that sends back.
const REVERSED: [usize; 6] = [3, 4, 5, 0, 1, 2];

/// How often a surplus grain hops in a step before it gives up until the next.
const HOPS: u32 = 10_000;

/// Grains that came to rest on a site whose place for one was taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Surplus {
    /// Where.
    pub site: u32,
    /// How many there are.
    pub count: u8,
    /// Their numbers, the first to go first.
    pub who: Crew,
}

/// A gas of grains.
#[derive(Clone, Debug)]
pub struct Grains {
    /// Who is next to whom.
    pub sites: Sites,
    habits: Habits,
    pub(super) seed: u64,
    pub(super) step: u64,
    /// After a collision: by chirality and state.
    table: [[u8; 1 << SLOTS]; 2],
    pub(super) state: Vec<u8>,
    next: Vec<u8>,
    /// 0: gas; 1: an upright wall; 2: a wall that lies flat; 3: one that sends back whatever its roughness.
    pub(super) wall: Vec<u8>,
    /// Grains at rest that found no place.
    surplus: Vec<Surplus>,
    /// Who is who, if anybody asked.
    pub(super) numbers: Option<Numbers>,
    /// Axis of every grain by its number; nothing for round grains.
    pub(super) axes: Vec<u8>,
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
        let sites = Sites::new(columns, rows, periodic);
        let mut table = [[0; 1 << SLOTS]; 2];
        for (turn, table) in table.iter_mut().enumerate() {
            for (state, after) in table.iter_mut().enumerate() {
                let n = std::array::from_fn(|slot| (state >> slot & 1) as u64);
                let new = collide(Rules::Two, n, turn as u64);
                *after = (0..SLOTS).map(|slot| ((new[slot] & 1) as u8) << slot).sum();
            }
        }
        Self {
            sites,
            habits,
            seed,
            step: 0,
            table,
            state: vec![0; sites.count()],
            next: vec![0; sites.count()],
            wall: vec![0; sites.count()],
            surplus: Vec::new(),
            numbers: None,
            axes: Vec::new(),
            pulled: Vector::default(),
        }
    }

    /// Makes a site a wall; `mirror` is Some(0) for an upright one, Some(1) for one that lies flat, None for one that
    /// always sends back.
    pub fn set_wall(&mut self, column: usize, row: usize, mirror: Option<usize>) {
        self.wall[self.sites.index(column, row)] = mirror.map_or(3, |axis| 1 + axis as u8);
    }

    /// Makes a wall a site of the gas.
    pub fn free(&mut self, site: usize) {
        self.wall[site] = 0;
    }

    /// Whether a site is wall.
    pub fn is_wall(&self, column: usize, row: usize) -> bool {
        self.wall[self.sites.index(column, row)] > 0
    }

    /// Puts grains into a site: bit i for slot i. Not in a gas whose grains have numbers.
    pub fn set_site(&mut self, column: usize, row: usize, state: u8) {
        self.state[self.sites.index(column, row)] = state;
    }

    /// Who is in a site.
    pub fn site(&self, column: usize, row: usize) -> u8 {
        self.state[self.sites.index(column, row)]
    }

    /// Steps done.
    pub fn steps(&self) -> u64 {
        self.step
    }

    /// Who is who, if the grains have numbers.
    pub fn numbers(&self) -> Option<&Numbers> {
        self.numbers.as_ref()
    }

    /// Grains at rest that found no place, in the order in which they look for one.
    pub fn surplus(&self) -> &[Surplus] {
        &self.surplus
    }

    /// Gives the grains of a gas the numbers of another time, where they were then, and the steps done.
    pub fn restore(&mut self, numbers: Numbers, surplus: Vec<Surplus>, step: u64) {
        (self.surplus, self.step) = (surplus, step);
        for (site, state) in self.state.iter_mut().enumerate() {
            *state = numbers.state(site);
        }
        self.numbers = Some(numbers);
    }

    /// Puts a grain with a number into a slot of a site; false if somebody is there.
    pub fn put(&mut self, site: usize, slot: usize, number: u32) -> bool {
        let free = self.wall[site] == 0 && self.state[site] >> slot & 1 == 0;
        if free {
            self.state[site] |= 1 << slot;
            if let Some(numbers) = &mut self.numbers {
                numbers.set(site, slot, number);
            }
        }
        free
    }

    /// Takes everybody from a site who is there; on walls nobody is gone.
    pub fn clear(&mut self, site: usize) {
        if self.wall[site] > 0 {
            return;
        }
        if self.state[site] > 0 {
            self.state[site] = 0;
            if let Some(numbers) = &mut self.numbers {
                numbers.clear(site);
            }
        }
        self.surplus.retain(|waiting| waiting.site as usize != site);
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
                let (mut column, mut row) = self.sites.place(*site as usize);
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

    /// Momentum that gravity gave in the last step, in the basis (h, k).
    pub fn pulled(&self) -> Vector {
        self.pulled
    }

    /// Number of grains.
    pub fn mass(&self) -> u64 {
        let there: u64 = self.state.iter().map(|s| u64::from(s.count_ones())).sum();
        there + self.surplus.iter().map(|waiting| u64::from(waiting.count)).sum::<u64>()
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
                    grains.set_wall(column, row, Some(usize::from(row % 39 == 0)));
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
