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
use crate::lattice::direction::{Direction, Vector};
use crate::lattice::grid::WALL;
use tsubu_scene::plan::Collision;

impl Damper {
    /// The lowest ball above the floor or the resting stack of every column that flies vertically.
    pub(super) fn meet_floor(&mut self, wall: i64) {
        let floor = self.place.floor();
        for column in 1..=self.place.columns {
            let mut cell = self.grid.index(column, floor) + self.rest.height[column];
            while let Ok(i) = usize::try_from(self.grid.at(cell)) {
                if !self.direction[i].is_vertical() {
                    break;
                }
                let approach = 2 * wall - self.velocity(i).k;
                if approach <= 0 || self.looks_away(i, Direction::S) {
                    break;
                }
                if approach <= 2 * self.rules.resting_speed {
                    self.join(i, column, wall);
                    cell += 1;
                    continue;
                }
                if self.rest.height[column] == 0 {
                    self.hit_floor(i, wall, true);
                } else {
                    let top = self.grid.at(cell - 1) as usize;
                    self.strike(i, top, approach, Direction::S);
                }
                break;
            }
        }
    }

    /// The balls under the ceiling that fly vertically.
    pub(super) fn meet_ceiling(&mut self, wall: i64) {
        let top = self.place.floor() + self.place.rows - 1;
        for column in 1..=self.place.columns {
            let Ok(i) = usize::try_from(self.grid.at(self.grid.index(column, top))) else { continue };
            let free = !self.resting[i] && self.direction[i].is_vertical() && !self.hit.contains(i);
            if free && self.velocity(i).k > 2 * wall && !self.looks_away(i, Direction::N) {
                self.hit_floor(i, wall, false);
            }
        }
    }

    /// An oblique ball looks into a wall.
    pub(super) fn hit_wall_ahead(&mut self, i: usize, wall: i64) {
        let (column, _) = self.grid.column_and_row(self.ahead[i]);
        if column == 0 || column > self.place.columns {
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

    /// Whether the cell ahead of a ball is a wall.
    #[inline]
    pub(super) fn faces_wall(&self, i: usize) -> bool {
        self.grid.at(self.ahead[i]) == WALL
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
