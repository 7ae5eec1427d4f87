//! The moving box: its displacement is rounded to whole cells; when it shifts, what is in the way is ejected.
//!
//! The cluster is every ball that touches the advancing wall, and every ball that touches one of the cluster. All get the
//! velocity of the box and are moved with it by one cell. Cells that are finer than balls shift more often, and would stop all that
//! touches each time, until the bed is one lump: balls of several cells are in the cluster where they are in the way, and keep their velocity
//! if they are faster than the wall. With resting impulses their change of momentum is delivered to
//! the box; without, the box feels only the balls that hit it (A11), and the change is the rules' doing. Since floor and
//! ceiling belong to one rigid box, the opposite wall gives way by the same cell and never squeezes the cluster.
//!
//! When the floor recedes, resting balls ride down with it if resting contacts count: their contact is a lasting one, and
//! the shift is only the rounding of a motion that they share. In the literal automaton they are left behind and fall.

use super::Damper;
use crate::lattice::direction::{Direction, Vector};
use crate::lattice::grid::EMPTY;
use tsubu_frame::Hint;

/// The box cannot move there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum OutOfRoom {
    /// It leaves the grid.
    #[error("the box moved more than {head} cells from its place, out of the automaton's grid")]
    Grid {
        /// Cells above and below.
        head: usize,
    },
    /// It moves too fast.
    #[error("the box moves faster than a quarter of a cell a step, too fast for the automaton")]
    Speed,
    /// The cells that an ejected cluster moves to are taken.
    #[error("an ejected cluster of {balls} balls is squeezed against the opposite wall")]
    Squeezed {
        /// Size of the cluster.
        balls: usize,
    },
}

impl OutOfRoom {
    /// What to change.
    pub fn hint(self) -> Hint {
        match self {
            Self::Grid { .. } => "raise `lattice.head-room`, or shake less".into(),
            Self::Speed => "shorten `lattice.time-step`, or shake less".into(),
            Self::Squeezed { .. } => "use fewer balls, or a higher box".into(),
        }
    }
}

impl Damper {
    /// Moves the box by one cell.
    pub(super) fn shift(&mut self, up: bool, wall: i64) -> Result<(), OutOfRoom> {
        let level = self.place.level + if up { 1 } else { -1 };
        if level.unsigned_abs() as usize > self.place.head {
            return Err(OutOfRoom::Grid { head: self.place.head });
        }
        if !up && !self.rules.resting_impulses {
            // The literal automaton forgets resting balls when the floor recedes. They were given this step's rise already.
            self.release_all(true);
        }
        self.gather(up);
        for place in 0..self.cluster.len() {
            let i = self.cluster[place];
            if !self.resting[i] && !self.outruns(i, up, wall) {
                self.eject(i, up, wall);
            }
        }
        self.move_cells(up, level)
    }

    /// Collects the cluster: who touches the advancing wall and all that touch it in turn; and all resting balls, with who is in their way.
    fn gather(&mut self, up: bool) {
        self.cluster.clear();
        self.hit.clear();
        let (wall, way) = if up { (Direction::S, [Direction::N]) } else { (Direction::N, [Direction::S]) };
        for i in 0..self.balls() {
            if self.meets_wall(i, wall) {
                self.take(i);
            }
        }
        self.gather_ahead(0, if self.has_one_cell_a_ball() { &Direction::ALL } else { &way });
        let first = self.cluster.len();
        for i in 0..self.balls() {
            if self.resting[i] {
                self.take(i);
            }
        }
        self.gather_ahead(first, &way);
    }

    /// Takes into the cluster who touches one of it, from that number on, in these directions.
    fn gather_ahead(&mut self, first: usize, directions: &[Direction]) {
        let mut next = first;
        while let Some(&i) = self.cluster.get(next) {
            next += 1;
            for &direction in directions {
                for k in 0..self.stencil.ahead[self.odd[i]][direction as usize].len() {
                    if let Ok(other) = usize::try_from(self.grid.at(self.goal(i, direction, k))) {
                        self.take(other);
                    }
                }
            }
        }
    }

    /// Takes a ball into the cluster, once.
    fn take(&mut self, i: usize) {
        if !self.hit.contains(i) {
            self.hit.insert(i);
            self.cluster.push(i);
        }
    }

    fn has_one_cell_a_ball(&self) -> bool {
        self.shape.points().len() == 1
    }

    /// Whether a ball of several cells goes faster than the wall that comes after it.
    fn outruns(&self, i: usize, up: bool, wall: i64) -> bool {
        let ahead = self.velocity(i).k - 2 * wall;
        !self.has_one_cell_a_ball() && if up { ahead >= 0 } else { ahead <= 0 }
    }

    /// A ball of the cluster takes the velocity of the box.
    fn eject(&mut self, i: usize, up: bool, wall: i64) {
        let old = self.velocity(i);
        let k = 2 * wall - old.k;
        let gain = wall * wall - old.square4() / 4 + self.scale.gravity / 2 * k;
        let impulse = Vector { h: -old.h, k };
        if self.rules.resting_impulses {
            self.tally.wall = self.tally.wall.plus(impulse);
            self.tally.rules += k * wall - gain;
        } else {
            self.tally.rule = self.tally.rule.plus(impulse);
            self.tally.rules -= gain;
        }
        let moving_up = wall > 0 || (wall == 0 && up);
        let direction = if moving_up { Direction::N } else { Direction::S };
        // The height it has is kept: the shift turns it into a whole cell. `redirect` would see only the direction.
        let height = self.stored[i] * self.direction[i].k() / 2;
        self.tally.rules += self.scale.gravity * (self.stored[i] * self.direction[i].k() - 2 * height);
        self.stored[i] = if moving_up { height } else { -height };
        self.point(i, direction, wall.abs());
    }

    /// Moves the cluster and the walls by one cell.
    fn move_cells(&mut self, up: bool, level: i64) -> Result<(), OutOfRoom> {
        let (sign, step) = if up { (1, 1_isize) } else { (-1, -1) };
        for place in 0..self.cluster.len() {
            self.put(self.cluster[place], EMPTY);
        }
        for &i in &self.cluster {
            self.cell[i] = self.cell[i].wrapping_add_signed(step);
            if self.cells(i).any(|cell| self.grid.at(cell) >= 0) {
                return Err(OutOfRoom::Squeezed { balls: self.cluster.len() });
            }
        }
        let forget = self.rules.reset_when_blocked;
        let cell = self.scale.cell;
        for place in 0..self.cluster.len() {
            let i = self.cluster[place];
            if self.resting[i] && !forget {
                continue;
            }
            if self.resting[i] || !self.direction[i].is_vertical() {
                self.tally.rules -= self.scale.gravity * 2 * cell * sign;
                continue;
            }
            let half_k = self.direction[i].k() / 2;
            let height = self.stored[i] * half_k;
            // More than one cell behind the wall would be inside it.
            let kept = if forget { 0 } else { (height - sign * cell).clamp(-cell, cell) };
            self.tally.rules -= self.scale.gravity * 2 * (kept - height + sign * cell);
            self.stored[i] = kept * half_k;
        }
        if !forget {
            self.rest.risen -= sign * cell;
        }
        self.place.level = level;
        self.paint();
        Ok(())
    }
}
