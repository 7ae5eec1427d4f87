//! Ball-wall collisions (A10): v' = v_w - e (v - v_w) along the normal of the wall, which is infinitely heavy in this
//! formula.
//!
//! Floor and ceiling have vertical normals and move at the speed of the box, side walls have horizontal normals and
//! v_w = 0; the other component stays, and the ball takes the lattice direction nearest to the sum. Straight hits go
//! straight back, as the drop test of Komatsuzaki (2003, fig. 8) needs. The signs of the speeds count: with `pairwise` a
//! floor that comes up faster than a rising ball hits it too; with `literal` a ball meets only the wall that it looks at.
//!
//! A contact at no more than the resting speed is a resting one: the ball takes the velocity of the box.

use super::Damper;
use super::ball_set::BallSet;
use crate::lattice::direction::{Direction, Vector};
use tsubu_scene::plan::Collision;

impl Damper {
    /// The balls that fly vertically above the floor or a ball at rest.
    pub(super) fn meet_floor(&mut self, wall: i64) {
        for word in 0..self.near.0.len() {
            for i in BallSet::members(word, self.near.0[word]) {
                self.meet_floor_with(i, wall);
            }
        }
    }

    fn meet_floor_with(&mut self, i: usize, wall: i64) {
        if self.resting[i] || !self.direction[i].is_vertical() {
            self.near.remove(i);
            return;
        }
        let floor = self.meets_wall(i, Direction::S);
        let below = self.balls_ahead(i, Direction::S).find(|below| self.resting[*below]);
        if !floor && below.is_none() {
            if !self.meets_wall(i, Direction::N) {
                self.near.remove(i);
            }
            return;
        }
        let approach = 2 * wall - self.velocity(i).k;
        if approach <= 0 || self.hit.contains(i) || self.looks_away(i, Direction::S) {
            return;
        }
        if approach <= 2 * self.rules.resting_speed {
            self.join(i, wall);
            // Who is above has something to lie down on.
            for k in 0..self.stencil.ahead[self.odd[i]][Direction::N as usize].len() {
                if let Ok(above) = usize::try_from(self.grid.at(self.goal(i, Direction::N, k))) {
                    self.near.insert(above);
                    self.meet_floor_with(above, wall);
                }
            }
        } else if floor {
            self.hit_floor(i, wall, true);
        } else if let Some(below) = below {
            self.strike(i, below, approach, Direction::S);
        }
    }

    /// The balls under the ceiling that fly vertically.
    pub(super) fn meet_ceiling(&mut self, wall: i64) {
        for word in 0..self.near.0.len() {
            for i in BallSet::members(word, self.near.0[word]) {
                let free = !self.resting[i] && self.direction[i].is_vertical() && !self.hit.contains(i);
                let rises = free && self.velocity(i).k > 2 * wall && !self.looks_away(i, Direction::N);
                if rises && self.meets_wall(i, Direction::N) {
                    self.hit_floor(i, wall, false);
                }
            }
        }
    }

    /// An oblique ball looks into a wall; in a corner the side comes first.
    pub(super) fn hit_wall_ahead(&mut self, i: usize, wall: i64) {
        let beside = |cell: usize| !(1..=self.place.columns).contains(&self.grid.column_and_row(cell).0);
        if self.ahead(i, self.direction[i]).any(beside) {
            self.hit_side(i, wall);
        } else {
            self.hit_floor(i, wall, self.direction[i].k() < 0);
        }
    }

    /// In the literal automaton a ball meets only what is ahead of it: a floor that overtakes a rising ball is not felt
    /// until the box moves by a cell and ejects it.
    #[inline]
    fn looks_away(&self, i: usize, wall_side: Direction) -> bool {
        self.rules.collision == Collision::Literal && self.direction[i] != wall_side
    }

    /// `floor`: else the ceiling.
    fn hit_floor(&mut self, i: usize, wall: i64, floor: bool) {
        let relative = 2 * wall - self.velocity(i).k;
        if relative == 0 || (relative > 0) != floor {
            return;
        }
        let approach = relative.abs();
        if approach <= 2 * self.rules.resting_speed {
            self.come_to_rest(i, wall);
            return;
        }
        let mut jump = approach + self.rules.wall.of(approach);
        // An even change keeps the energy of the lattice vector a whole number.
        jump -= jump % (2 * self.scale.quantum);
        self.rebound_from_wall(i, Vector { h: 0, k: jump * relative.signum() }, wall);
    }

    fn hit_side(&mut self, i: usize, wall: i64) {
        let old = self.velocity(i);
        let approach = old.h.abs();
        if approach == 0 {
            return;
        }
        if approach <= self.rules.resting_speed && (old.k - 2 * wall).abs() <= 2 * self.rules.resting_speed {
            self.come_to_rest(i, wall);
            return;
        }
        let mut jump = approach + self.rules.wall.of(approach);
        jump -= jump % (2 * self.scale.quantum);
        self.rebound_from_wall(i, Vector { h: -jump * old.h.signum(), k: 0 }, wall);
    }

    /// The wall gives the ball an impulse; the books take work and restitution loss.
    fn rebound_from_wall(&mut self, i: usize, impulse: Vector, wall: i64) {
        let old = self.velocity(i);
        let meant = old.plus(impulse);
        let gain = (meant.square4() - old.square4()) / 4 + self.scale.gravity / 2 * impulse.k;
        self.tally.wall = self.tally.wall.plus(impulse);
        self.tally.collision += impulse.k * wall - gain;
        let direction = Direction::nearest(meant);
        let speed = self.scale.cut(direction.along4(meant) / 4);
        self.hit.insert(i);
        self.redirect(i, meant, direction, speed);
    }

    /// A ball in resting contact with something that moves with the box takes the velocity of the box.
    pub(super) fn come_to_rest(&mut self, i: usize, wall: i64) {
        self.post_resting(self.velocity(i), wall, 1);
        self.hit.insert(i);
        let (direction, speed) = if wall > 0 { (Direction::N, wall) } else { (Direction::S, -wall) };
        self.redirect(i, direction.times(speed), direction, speed);
    }
}
