//! The lattice grain model of Gutt and Haff: real velocities and offsets on the nodes of a triangular lattice.
//!
//! A grain sits on a node, alone, and has a velocity and a position offset from the node, each of two real numbers: five
//! numbers a node with its state. In a step
//!
//! 1. gravity speeds it up, and its offset grows by the way it flies, v dt + g dt^2 / 2: free fall is exact;
//! 2. contacts, short or lasting, are collisions of two grains on adjacent nodes, one after the other, up to six a grain:
//!    those that have met, (o_i - o_j) . n >= 0, and approach, u = (v_i - v_j) . n > 0, exchange (1 + e)/2 u along the
//!    line of centres n, and lose the offset along it. Nodes of a wall are grains of infinite mass;
//! 3. a grain whose offset along one of the six directions exceeds half a spacing jumps to that node if it is free.
//!
//! Pairs are taken in six sets, three directions and two parities, in each of which no grain occurs twice; the order of
//! the sets is drawn anew every step, so that it favours no direction. Then walls: of several wall nodes that a grain
//! runs into the one it meets most head-on comes first, so that a grain that falls onto a level wall leaves it as it
//! came, although the nodes of the wall stand at two heights. Of two grains that want one node that which is
//! nearer to it goes. So neither the order of grains nor the number of threads can matter.
//!
//! Lengths are in spacings, velocities in spacings a step: x to the right, z up.

use super::direction::Direction;
use super::grid::{EMPTY, Grid, WALL};
use crate::about::About;
use crate::random::{Purpose, words};

pub(crate) const ABOUT: About = About {
    key: "method.gutt-haff",
    formula: "o += v dt + g dt^2/2, v += g dt;  a collision exchanges (1 + e)/2 u along the line of centres;  at |o| > 1/2 along a direction the grain jumps to that node",
    symbols: "o offset from the node [spacings], v velocity [spacings/step], u approach of the pair [spacings/step], e \
restitution [-]",
    limits: "One grain a node; no friction, no spin; equal diameters and masses (the mean of the scene's). Free fall is exact.",
    reference: "Gutt and Haff 1990",
};

/// A grain in flight or at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Grain {
    /// The node it sits on.
    pub node: usize,
    /// Velocity, in spacings a step.
    pub velocity: [f64; 2],
    /// Position less that of the node, in spacings.
    pub offset: [f64; 2],
    /// It was removed by an outlet.
    pub removed: bool,
}

/// What a wall node got from a grain, in masses times spacings a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Push {
    /// The node of the wall.
    pub node: usize,
    /// The grain.
    pub grain: usize,
    /// Impulse on the wall.
    pub impulse: [f64; 2],
}

/// Grains on a grid.
#[derive(Clone, Debug)]
pub struct LatticeGrains {
    /// Who sits where.
    pub grid: Grid,
    /// The grains.
    pub grains: Vec<Grain>,
    /// Gravity, in spacings a step squared, along -z.
    pub gravity: f64,
    /// Restitution of grains, and of grains and walls [-].
    pub restitution: [f64; 2],
    /// Seed of the random numbers.
    pub seed: u64,
    /// Steps done.
    pub step: u64,
    /// What walls got in the last step.
    pub pushes: Vec<Push>,
    /// Contacts in the last step.
    pub contacts: usize,
    /// Nodes on which grains vanish; none if it is empty.
    pub outlet: Vec<bool>,
    /// Grains that were removed since somebody took note.
    pub removed: Vec<usize>,
    wants: Vec<Option<(Direction, f64)>>,
}

/// A grain was faster than a spacing a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TooFast {
    /// Which.
    pub grain: usize,
    /// Its speed, in spacings a step.
    pub speed: f64,
}

fn along(direction: Direction) -> [f64; 2] {
    let [x, _, z] = direction.unit();
    [x, z]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn add(a: &mut [f64; 2], factor: f64, b: [f64; 2]) {
    a[0] += factor * b[0];
    a[1] += factor * b[1];
}

impl LatticeGrains {
    /// Grains on a grid that knows its walls.
    pub fn new(mut grid: Grid, grains: Vec<Grain>, gravity: f64, restitution: [f64; 2], seed: u64) -> Self {
        for (number, grain) in grains.iter().enumerate() {
            grid.set(grain.node, number as i32);
        }
        let wants = vec![None; grains.len()];
        let (pushes, outlet) = (Vec::new(), Vec::new());
        Self {
            grid,
            grains,
            gravity,
            restitution,
            seed,
            step: 0,
            pushes,
            contacts: 0,
            outlet,
            removed: Vec::new(),
            wants,
        }
    }

    /// One step.
    pub fn advance(&mut self) -> Result<(), TooFast> {
        self.pushes.clear();
        self.contacts = 0;
        for (number, grain) in self.grains.iter_mut().enumerate().filter(|(_, grain)| !grain.removed) {
            add(&mut grain.offset, 1.0, grain.velocity);
            grain.offset[1] -= 0.5 * self.gravity;
            grain.velocity[1] -= self.gravity;
            let speed = grain.velocity[0].hypot(grain.velocity[1]);
            if speed > 1.0 {
                return Err(TooFast { grain: number, speed });
            }
        }
        for set in self.order() {
            self.collide(set);
        }
        for grain in 0..self.grains.len() {
            if !self.grains[grain].removed {
                self.meet_walls(grain);
            }
        }
        self.jump();
        self.step += 1;
        Ok(())
    }

    /// The six sets of pairs in the order of this step.
    fn order(&self) -> [usize; 6] {
        let mut order = [0, 1, 2, 3, 4, 5];
        let coins = words(self.seed, Purpose::Order, 0, self.step);
        for last in (1..6).rev() {
            let coin = coins[last % 4] >> (8 * (last / 4)) & 0xffff;
            order.swap(last, (coin as usize * (last + 1)) >> 16);
        }
        order
    }

    /// The collisions of one set: grains of one parity with those ahead of them.
    fn collide(&mut self, set: usize) {
        let direction = [Direction::N, Direction::NE, Direction::SE][set / 2];
        let normal = along(direction);
        for first in 0..self.grains.len() {
            let node = self.grains[first].node;
            let (column, row) = self.grid.column_and_row(node);
            if (if set < 2 { row } else { column }) % 2 != set % 2 || self.grains[first].removed {
                continue;
            }
            let ahead = self.grid.at(self.grid.neighbour(node, column, direction));
            if let Ok(second) = usize::try_from(ahead) {
                self.hit(first, second, normal);
            }
        }
    }

    fn hit(&mut self, first: usize, second: usize, normal: [f64; 2]) {
        let (a, b) = (self.grains[first], self.grains[second]);
        let overlap = dot(a.offset, normal) - dot(b.offset, normal);
        if overlap < 0.0 {
            return;
        }
        self.contacts += 1;
        let approach = dot(a.velocity, normal) - dot(b.velocity, normal);
        if approach <= 0.0 {
            return;
        }
        let exchange = 0.5 * (1.0 + self.restitution[0]) * approach;
        for (number, sign) in [(first, -1.0), (second, 1.0)] {
            let grain = &mut self.grains[number];
            add(&mut grain.velocity, sign * exchange, normal);
            let along = dot(grain.offset, normal);
            add(&mut grain.offset, -along, normal);
        }
    }

    /// The collisions of one grain with the walls around it, the most head-on first.
    fn meet_walls(&mut self, number: usize) {
        let node = self.grains[number].node;
        let column = self.grid.column_and_row(node).0;
        for round in 0..Direction::ALL.len() {
            let grain = &self.grains[number];
            let mut next = None;
            for direction in Direction::ALL {
                let wall = self.grid.neighbour(node, column, direction);
                let normal = along(direction);
                if self.grid.at(wall) != WALL || dot(grain.offset, normal) < 0.0 {
                    continue;
                }
                self.contacts += usize::from(round == 0);
                let approach = dot(grain.velocity, normal);
                if approach > next.map_or(0.0, |(_, _, most)| most) {
                    next = Some((wall, normal, approach));
                }
            }
            let Some((wall, normal, approach)) = next else { return };
            let grain = &mut self.grains[number];
            let exchange = (1.0 + self.restitution[1]) * approach;
            add(&mut grain.velocity, -exchange, normal);
            let overlap = dot(grain.offset, normal);
            add(&mut grain.offset, -overlap, normal);
            let impulse = [exchange * normal[0], exchange * normal[1]];
            self.pushes.push(Push { node: wall, grain: number, impulse });
        }
    }

    /// Grains more than half way to a free node jump to it.
    fn jump(&mut self) {
        for (grain, want) in self.grains.iter().zip(&mut self.wants) {
            *want = None;
            if grain.removed || dot(grain.offset, grain.offset) <= 0.25 {
                continue;
            }
            let column = self.grid.column_and_row(grain.node).0;
            for direction in Direction::ALL {
                let way = dot(grain.offset, along(direction));
                let better = want.is_none_or(|(_, best)| way > best);
                if way > 0.5 && better && self.grid.at(self.grid.neighbour(grain.node, column, direction)) == EMPTY {
                    *want = Some((direction, way));
                }
            }
        }
        // Who goes is decided before anybody does.
        let goes: Vec<usize> = (0..self.grains.len()).filter(|&number| self.wins(number)).collect();
        for number in goes {
            if let Some((direction, _)) = self.wants[number] {
                let node = self.grains[number].node;
                let to = self.grid.neighbour(node, self.grid.column_and_row(node).0, direction);
                self.grid.set(node, EMPTY);
                self.grains[number].node = to;
                self.grains[number].removed = self.outlet.get(to) == Some(&true);
                if self.grains[number].removed {
                    self.removed.push(number);
                } else {
                    self.grid.set(to, number as i32);
                }
                add(&mut self.grains[number].offset, -1.0, along(direction));
            }
        }
    }

    /// Whether no other grain that wants the same node is nearer to it; of two as near the one with the lower number goes.
    fn wins(&self, number: usize) -> bool {
        let Some((direction, way)) = self.wants[number] else { return false };
        let node = self.grains[number].node;
        let to = self.grid.neighbour(node, self.grid.column_and_row(node).0, direction);
        let column = self.grid.column_and_row(to).0;
        Direction::ALL.into_iter().all(|other| {
            let rival = self.grid.at(self.grid.neighbour(to, column, other));
            let Ok(rival) = usize::try_from(rival) else { return true };
            match self.wants[rival] {
                Some((wish, near)) if rival != number && wish == other.opposite() => {
                    near < way || (near == way && number < rival)
                }
                _ => true,
            }
        })
    }

    /// Momentum of the grains, in masses times spacings a step.
    pub fn momentum(&self) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for grain in self.grains.iter().filter(|grain| !grain.removed) {
            add(&mut sum, 1.0, grain.velocity);
        }
        sum
    }
}
