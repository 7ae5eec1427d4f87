//! Grains of many points on their lattice.

use super::order::Past;
use crate::lattice::direction::{Direction, Vector};
use crate::lattice::grid::{EMPTY, Grid, WALL};
use crate::lattice::shape::{Shape, Stencil};

/// What grains of one group and shape have in common.
#[derive(Clone, Debug)]
pub struct GrainKind {
    /// Number of the group.
    pub group: u32,
    /// The shape as drawn.
    pub shape: Shape,
    /// Number of its first stencil; turned shapes follow.
    pub stencil: usize,
    /// Orientations that differ: 1 for a hexagon, else 2, 3 or 6.
    pub orientations: u8,
    /// Mass of a grain [kg].
    pub mass: f64,
    /// Whether rules move it; else it is frozen or driven.
    pub free: bool,
}

/// Grains as columns. Their numbers are those of the plan; those that are not there have no cell.
#[derive(Clone, Debug, Default)]
pub struct Grains {
    /// Number of the kind.
    pub kind: Vec<u16>,
    /// Cell of the reference point; [`NOWHERE`] for grains that were removed.
    pub cell: Vec<u32>,
    /// Turned by that many times 60 degrees clockwise.
    pub turn: Vec<u8>,
    /// Where it went in the last step; `None`: nowhere.
    pub last: Vec<Option<Direction>>,
    /// Its sideways moves.
    pub past: Vec<Past>,
    /// Number in the plan.
    pub id: Vec<u32>,
}

/// The cell of a grain that was removed.
pub const NOWHERE: u32 = u32::MAX;

/// What the grains of one kind do together in a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Motion {
    /// How many move.
    pub moving: i64,
    /// Sum of their moves.
    pub sum: Vector,
}

/// The grains, and the lattice that they are on.
#[derive(Clone, Debug)]
pub struct Bed {
    /// Walls, and under the active rule the numbers of grains.
    pub grid: Grid,
    /// Kinds of grains.
    pub kinds: Vec<GrainKind>,
    /// What moves do, for every shape and orientation.
    pub stencils: Vec<Stencil>,
    /// Columns to either side of a grain that a look at its neighbours can reach.
    pub reach: usize,
    /// The grains.
    pub grains: Grains,
    /// What every kind did in the last step.
    pub motion: Vec<Motion>,
    /// Steps done.
    pub step: u64,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Steps of the past that choose the side.
    pub memory: u32,
    /// Moves of one spacing since time 0.
    pub moves: u64,
}

impl Bed {
    /// No grains yet. `kinds` come without numbers of stencils and orientations, which are found here.
    pub fn new(grid: Grid, mut kinds: Vec<GrainKind>, seed: u64, memory: u32) -> Self {
        let mut stencils = Vec::new();
        let mut widest = 0;
        for kind in &mut kinds {
            kind.stencil = stencils.len();
            let mut shape = kind.shape.clone();
            kind.orientations = 0;
            while kind.orientations < 6 {
                stencils.push(Stencil::new(&shape, &grid));
                widest = shape.points().iter().map(|p| p.h.unsigned_abs() as usize).fold(widest, usize::max);
                kind.orientations += 1;
                shape = shape.turned();
                if shape == kind.shape {
                    break;
                }
            }
        }
        let motion = vec![Motion::default(); kinds.len()];
        // A point that is taken or left is one column farther at most, and who is beside it one more.
        let reach = widest + 2;
        Self { grid, kinds, stencils, reach, grains: Grains::default(), motion, step: 0, seed, memory, moves: 0 }
    }

    /// Number of grains, with those that were removed.
    pub fn len(&self) -> usize {
        self.grains.cell.len()
    }

    /// Whether there are no grains.
    pub fn is_empty(&self) -> bool {
        self.grains.cell.is_empty()
    }

    /// Numbers of the grains that are there.
    pub fn present(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.len()).filter(|&i| self.grains.cell[i] != NOWHERE)
    }

    /// Kind of a grain.
    #[inline]
    pub fn kind(&self, grain: usize) -> &GrainKind {
        &self.kinds[self.grains.kind[grain] as usize]
    }

    /// Stencil of a grain as it is turned now.
    #[inline]
    pub fn stencil(&self, grain: usize) -> &Stencil {
        &self.stencils[self.kind(grain).stencil + self.grains.turn[grain] as usize]
    }

    /// Parity of the column of a cell.
    #[inline]
    pub fn odd(&self, cell: usize) -> usize {
        self.grid.column_and_row(cell).0 & 1
    }

    /// Where a cell lies, in columns and half cells.
    pub fn vector(&self, cell: usize) -> Vector {
        Vector { h: self.grid.column_and_row(cell).0 as i64, k: self.grid.half_height(cell) }
    }

    /// Cells of a shape whose reference point is in `cell`.
    pub fn cells(&self, stencil: usize, cell: usize) -> impl Iterator<Item = usize> + '_ {
        self.stencils[stencil].points[self.odd(cell)].iter().map(move |&offset| cell.wrapping_add_signed(offset))
    }

    /// Whether a grain of a kind, not turned, fits into a cell: all its points are on the lattice and empty.
    pub fn fits(&self, kind: usize, cell: usize) -> bool {
        let (column, row) = self.grid.column_and_row(cell);
        let here = Vector { h: column as i64, k: 2 * row as i64 + (column as i64 & 1) };
        let inside = |p: &Vector| {
            let (h, k) = (here.h + p.h, here.k + p.k);
            h >= 0 && h < self.grid.columns() as i64 && k >= 0 && k / 2 < self.grid.rows() as i64
        };
        self.kinds[kind].shape.points().iter().all(inside)
            && self.cells(self.kinds[kind].stencil, cell).all(|c| self.grid.at(c) == EMPTY)
    }

    /// Puts a grain, not turned, into a cell where it [fits](Bed::fits). Free grains own their points; others are walls.
    pub fn add(&mut self, kind: usize, cell: usize, id: u32) {
        let number = self.len() as i32;
        let grains = &mut self.grains;
        grains.kind.push(kind as u16);
        grains.cell.push(cell as u32);
        grains.turn.push(0);
        grains.last.push(None);
        grains.past.push(Past::default());
        grains.id.push(id);
        let content = if self.kinds[kind].free { number } else { WALL };
        self.paint(number as usize, content);
    }

    /// Writes something into all cells of a grain.
    pub fn paint(&mut self, grain: usize, content: i32) {
        let cell = self.grains.cell[grain] as usize;
        let odd = self.odd(cell);
        let stencil = &self.stencils[self.kind(grain).stencil + self.grains.turn[grain] as usize];
        for &offset in &stencil.points[odd] {
            self.grid.set(cell.wrapping_add_signed(offset), content);
        }
    }

    /// A grain takes a step, or rests and forgets; books of its kind are kept.
    #[inline]
    pub fn note(&mut self, grain: usize, went: Option<Direction>) {
        self.grains.last[grain] = went;
        let Some(direction) = went else {
            self.grains.past[grain] = Past::default();
            return;
        };
        self.grains.past[grain] = self.grains.past[grain].then(direction);
        let motion = &mut self.motion[self.grains.kind[grain] as usize];
        motion.moving += 1;
        motion.sum = motion.sum.plus(direction.times(1));
        self.moves += 1;
    }

    /// Removes a grain. Its cells are the caller's to clear.
    pub fn remove(&mut self, grain: usize) {
        if let Some(direction) = self.grains.last[grain].take() {
            let motion = &mut self.motion[self.grains.kind[grain] as usize];
            motion.moving -= 1;
            motion.sum = motion.sum.plus(direction.times(-1));
        }
        self.grains.cell[grain] = NOWHERE;
    }

    /// Time 0: nobody has moved yet.
    pub fn begin(&mut self) {
        self.grains.last.fill(None);
        self.grains.past.fill(Past::default());
        self.motion.fill(Motion::default());
        (self.step, self.moves) = (0, 0);
    }

    /// The first invariant that a step from the cells `before` has broken: grains move as they remember, by one spacing at
    /// most; no point is a wall's. `owned`, under the active rule: every point is its grain's own, and no other is anybody's.
    pub fn fault(&self, owned: bool, before: &[u32]) -> Option<String> {
        if before.len() != self.len() {
            return Some(format!("{} grains instead of {}", self.len(), before.len()));
        }
        let mut points = 0;
        for grain in self.present().filter(|&grain| self.kind(grain).free) {
            let (from, to) = (self.vector(before[grain] as usize), self.vector(self.grains.cell[grain] as usize));
            let moved = self.grains.last[grain].map_or(Vector::default(), |direction| direction.times(1));
            if from.plus(moved) != to {
                return Some(format!("grain {grain} goes from {from:?} to {to:?}, by {moved:?}"));
            }
            let stencil = self.kind(grain).stencil + self.grains.turn[grain] as usize;
            for cell in self.cells(stencil, self.grains.cell[grain] as usize) {
                let owner = self.grid.at(cell);
                if owner == WALL || owned && owner != grain as i32 {
                    return Some(format!("a point of grain {grain} belongs to {owner}"));
                }
                points += 1;
            }
        }
        let taken = (0..self.grid.columns() * self.grid.rows()).filter(|&cell| self.grid.at(cell) >= 0).count();
        (owned && taken != points).then(|| format!("{taken} points are taken, but grains have {points}"))
    }

    /// What every kind did in the last step, counted again from the grains: after a checkpoint.
    pub fn count_motion(&mut self) {
        self.motion.fill(Motion::default());
        for grain in 0..self.len() {
            if let Some(direction) = self.grains.last[grain] {
                let motion = &mut self.motion[self.grains.kind[grain] as usize];
                motion.moving += 1;
                motion.sum = motion.sum.plus(direction.times(1));
            }
        }
    }
}
