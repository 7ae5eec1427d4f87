//! What the balls of the automaton hold, read from their state: where each is and how fast, momentum and energy of all, and
//! whether whole numbers can hold them.

use super::Damper;
use crate::lattice::direction::{Direction, Vector};

/// Half of what whole numbers hold: what a run adds to the energy of its beginning has as much room again.
const MOST: f64 = (1_u64 << 62) as f64;

/// What is beyond the automaton.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Beyond {
    /// A ball moves more than a cell a step.
    Cell,
    /// Whole numbers cannot hold its books.
    Books,
}

impl Damper {
    /// Velocity of a ball [speed units].
    pub fn velocity(&self, i: usize) -> Vector {
        if self.resting[i] { Direction::N.times(self.rest.speed) } else { self.direction[i].times(self.speed[i]) }
    }

    /// Where a ball is off its cell's centre [distance units].
    pub fn offset(&self, i: usize) -> Vector {
        if self.resting[i] {
            Direction::N.times(self.stored[i] + self.rest.risen)
        } else {
            self.direction[i].times(self.stored[i])
        }
    }

    /// Column and row of a ball; row 0 is the lowest of the box at level 0.
    pub fn seat(&self, i: usize) -> (usize, i64) {
        let (column, row) = self.grid.column_and_row(self.cell[i]);
        (column, row as i64 - self.place.head as i64 - 1)
    }

    /// Total momentum [m u].
    pub fn momentum(&self) -> Vector {
        (0..self.balls()).fold(Vector::default(), |sum, i| sum.plus(self.velocity(i)))
    }

    /// Kinetic energy [m u^2 / 2].
    pub fn kinetic(&self) -> i64 {
        (0..self.balls()).map(|i| self.velocity(i).square4() / 4).sum()
    }

    /// Potential energy, from the centre of the lowest cell of an even column [m u^2 / 2]. The height is that at the time
    /// of the velocity, z - v_z dt / 2, with which free flight conserves the energy exactly.
    pub fn potential(&self) -> i64 {
        let g = self.scale.gravity;
        let energy = |i| {
            let (column, row) = self.seat(i);
            let half_cells = 2 * row + (column % 2) as i64;
            g * (half_cells * self.scale.cell + self.offset(i).k) - g / 2 * self.velocity(i).k
        };
        (0..self.balls()).map(energy).sum()
    }

    /// Touching pairs, of balls and of balls with walls, now.
    pub fn contacts(&self) -> usize {
        let (mut count, mut others) = (0, Vec::new());
        for i in 0..self.balls() {
            for direction in Direction::ALL {
                count += usize::from(self.meets_wall(i, direction));
                others.extend(self.balls_ahead(i, direction).filter(|other| *other > i));
            }
            others.sort_unstable();
            others.dedup();
            count += others.len();
            others.clear();
        }
        count
    }

    /// Whether every ball moves less than a cell a step, and whether whole numbers can hold the books: squares of speeds, and
    /// heights up to the top of the grid.
    pub(crate) fn within_reach(&self) -> Result<(), Beyond> {
        let moving = self.speed.iter().chain([&self.rest.speed]);
        if moving.clone().any(|speed| speed.unsigned_abs() > self.scale.cell.unsigned_abs()) {
            return Err(Beyond::Cell);
        }
        let (gravity, cell) = (self.scale.gravity as f64, self.scale.cell as f64);
        let balls = self.balls() as f64;
        let kinetic: f64 = self.speed.iter().map(|speed| (*speed as f64).powi(2)).sum();
        let shared = balls * (self.rest.speed as f64).powi(2);
        let offsets: f64 = self.stored.iter().map(|stored| (*stored as f64).abs()).sum();
        let height = balls * (self.grid.rows() as f64 * cell + (self.rest.risen as f64).abs()) + offsets;
        if kinetic + shared + 2.0 * gravity * height < MOST { Ok(()) } else { Err(Beyond::Books) }
    }
}
