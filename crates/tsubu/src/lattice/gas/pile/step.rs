//! One step of a pile: grains fly, slide, stop, and knock others loose.

use super::{Flyer, NOBODY, Pile, Place, WALL};
use crate::lattice::direction::Direction;
use crate::random::{Purpose, unit, words};
use std::collections::VecDeque;

impl Pile {
    /// One step: every flying grain moves, stops, or takes another direction.
    pub fn step(&mut self) {
        let mut flyers = std::mem::take(&mut self.flyers);
        flyers.sort_unstable();
        for flyer in flyers {
            self.fly(flyer);
        }
        self.step += 1;
    }

    fn fly(&mut self, flyer: Flyer) {
        let Flyer { row, column, way, who } = flyer;
        let (row, column, kind) = (row as usize, column as usize, self.kinds[who as usize] as usize);
        let site = self.sites.index(column, row);
        self.taken[site] &= !(1 << way);
        let draw = words(self.seed, Purpose::Rebound, site as u32, self.step << 3 | u64::from(way));
        let chance = |index: usize| unit(draw[index], draw[(index + 1) % 4]);
        let left = draw[3] & 1 == 0;
        let mut way = Direction::from_index(usize::from(way));
        if way != Direction::S && self.room(column, row, Direction::S) && chance(0) < self.habits.gravity {
            way = match way {
                Direction::N if left => Direction::NW,
                Direction::N => Direction::NE,
                Direction::NE => Direction::SE,
                Direction::NW => Direction::SW,
                _ => Direction::S,
            };
        }
        if self.room(column, row, way) {
            let Some((c, r)) = self.sites.neighbour(column, row, way) else {
                if way.k() < 0 || way.h() != 0 {
                    self.removed.push((who, Place { site, way: Some(way) }));
                    return;
                }
                return self.turn(column, row, &[Direction::S], who);
            };
            if self.taken[self.sites.index(c, r)] & 1 << way as u8 != 0 {
                return self.turn(column, row, &[way], who);
            }
            self.laps[who as usize] += self.sites.crossing(column, row, way)[0];
            let slides = way.h() != 0 && way.k() < 0 && !self.room(c, r, Direction::S);
            if slides && chance(1) < self.habits.friction[kind] {
                return self.stop(c, r, who);
            }
            return self.turn(c, r, &[way], who);
        }
        self.knock(column, row, way, chance(2));
        let mirrored = |way: Direction| Direction::from_index((6 - way as usize) % 6);
        let sides = if left { [Direction::SW, Direction::SE] } else { [Direction::SE, Direction::SW] };
        if chance(1) >= self.habits.dissipation {
            let off = match way {
                Direction::S | Direction::N => [sides[0].opposite(), sides[1].opposite()],
                other => [mirrored(other), other.opposite()],
            };
            return self.turn(column, row, &off, who);
        }
        let lower: Vec<Direction> = sides.into_iter().filter(|side| self.room(column, row, *side)).collect();
        if self.room(column, row, Direction::S) {
            self.turn(column, row, &[Direction::S, Direction::SW, Direction::SE], who);
        } else if lower.is_empty() || chance(3) < self.habits.friction[kind] {
            self.stop(column, row, who);
        } else {
            self.turn(column, row, &lower, who);
        }
    }

    /// Goes on from a site in the first of some directions that nobody has, or in any other.
    fn turn(&mut self, column: usize, row: usize, ways: &[Direction], who: u32) {
        let taken = self.taken[self.sites.index(column, row)];
        let free = |way: &&Direction| taken & 1 << **way as u8 == 0;
        match ways.iter().find(free).or_else(|| Direction::ALL.iter().find(free)) {
            Some(way) => self.launch(column, row, *way, who),
            None => self.stop(column, row, who),
        }
    }

    /// Comes to rest at a site, or at the first one above it where nobody is; falls on if there is no ground.
    pub(super) fn stop(&mut self, column: usize, mut row: usize, who: u32) {
        let first = row;
        while row + 1 < self.sites.rows && self.who_rests(column, row).is_some() {
            row += 1;
        }
        let site = self.sites.index(column, row);
        if self.rest[site] != NOBODY {
            return self.stop_near(column, first, who);
        }
        if self.room(column, row, Direction::S) && self.taken[site] & 1 << Direction::S as u8 == 0 {
            return self.launch(column, row, Direction::S, who);
        }
        self.rest[site] = who;
    }

    /// Comes to rest as near as can be to a site that is full up to a wall; where all are, flies on.
    fn stop_near(&mut self, column: usize, row: usize, who: u32) {
        let mut seen = vec![(column, row, 0)];
        let mut next = VecDeque::from(seen.clone());
        while let Some((c, r, lap)) = next.pop_front() {
            for way in Direction::ALL {
                let Some(to) = self.sites.neighbour(c, r, way) else { continue };
                let lap = lap + self.sites.crossing(c, r, way)[0];
                let there = self.rest[self.sites.index(to.0, to.1)];
                if there == NOBODY {
                    self.laps[who as usize] += lap;
                    return self.stop(to.0, to.1, who);
                }
                if there != WALL && !seen.iter().any(|(c, r, _)| (*c, *r) == to) {
                    seen.push((to.0, to.1, lap));
                    next.push_back((to.0, to.1, lap));
                }
            }
        }
        // Seven can be at a site, and whoever flies has just left a place: there is one.
        if let Some(&(c, r, lap)) = seen.iter().find(|(c, r, _)| self.taken[self.sites.index(*c, *r)] != 0x3F) {
            self.laps[who as usize] += lap;
            self.turn(c, r, &[Direction::N], who);
        }
    }

    /// The grain at rest that is in the way may be knocked loose; whoever lay on it falls.
    fn knock(&mut self, column: usize, row: usize, way: Direction, chance: f64) {
        let Some((c, r)) = self.sites.neighbour(column, row, way) else { return };
        let Some(who) = self.who_rests(c, r) else { return };
        if chance < self.habits.friction[self.kinds[who as usize] as usize] {
            return;
        }
        let sides = [Direction::SE, Direction::SW];
        let Some(side) = sides.into_iter().find(|side| self.room(c, r, *side)) else { return };
        self.rest[self.sites.index(c, r)] = NOBODY;
        self.loosened += 1;
        self.turn(c, r, &[side], who);
        self.fall_from_above(c, r);
    }

    /// Grains at rest straight above a site that nobody holds any more set out.
    pub(super) fn fall_from_above(&mut self, column: usize, row: usize) {
        for above in row + 1..self.sites.rows {
            let site = self.sites.index(column, above);
            let Some(who) = self.who_rests(column, above) else { break };
            if self.taken[site] & 1 << Direction::S as u8 != 0 {
                break;
            }
            self.rest[site] = NOBODY;
            self.loosened += 1;
            self.launch(column, above, Direction::S, who);
        }
    }
}
