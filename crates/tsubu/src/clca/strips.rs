//! Strips of the lattice in which grains take their turns side by side: sets of grains that do not see each other, in a fixed
//! order.
//!
//! Strips of columns are even and odd by turns. All even ones go at once, then all odd ones: a strip is so wide that two of
//! one parity never read or write the same point. Where strips begin and which parity goes first is drawn in every step, so
//! that no column is favoured. Neither depends on the number of threads.

use super::bed::Bed;
use crate::lattice::grid::Grid;
use crate::random::{Purpose, words};

/// So many grains that mean to move are worth strips; fewer take their turns in one row.
const WORTH_STRIPS: usize = 4096;

/// Columns of a strip, at least: few enough for the nearest caches, many enough for few borders.
const COLUMNS: usize = 64;

/// How the columns are cut in a step.
#[derive(Clone, Copy, Debug)]
pub struct Strips {
    /// Columns by which the first strip is too short.
    offset: usize,
    /// Columns of a strip.
    width: usize,
    /// Columns beside a strip that its grains may see.
    reach: usize,
    /// Parity of the strips that go first.
    first: usize,
}

impl Strips {
    /// The cut for a step in which so many grains mean to move.
    pub fn new(bed: &Bed, moving: usize) -> Self {
        let (reach, columns) = (bed.reach, bed.grid.columns());
        if moving < WORTH_STRIPS {
            return Self { offset: 0, width: columns, reach, first: 0 };
        }
        let width = COLUMNS.max(2 * reach);
        let word = words(bed.seed, Purpose::Order, 0, bed.step);
        Self { offset: word[0] as usize % width, width, reach, first: word[1] as usize & 1 }
    }

    /// The strip of a column.
    #[inline]
    pub fn of(&self, column: usize) -> usize {
        (column + self.offset) / self.width
    }

    /// When a strip takes its turn: 0 or 1.
    #[inline]
    pub fn turn(&self, strip: usize) -> usize {
        (strip ^ self.first) & 1
    }

    /// The lattice as the given strips of one parity see it, in rising order: each with the points that are its own for now.
    pub fn windows<'a>(&self, grid: &'a mut Grid, strips: impl Iterator<Item = usize>) -> Vec<Window<'a>> {
        let (columns, rows) = (grid.columns(), grid.rows());
        let column = |edge: usize| edge.saturating_sub(self.offset).min(columns);
        let mut rest = grid.cells_mut();
        let mut begun = 0;
        let mut window = |strip: usize| {
            let first = column(strip * self.width).saturating_sub(self.reach) * rows;
            let end = (column((strip + 1) * self.width) + self.reach).min(columns) * rows;
            let (cells, after) = std::mem::take(&mut rest)[first - begun..].split_at_mut(end - first);
            (rest, begun) = (after, end);
            Window { cells, first }
        };
        strips.map(&mut window).collect()
    }
}

/// A piece of the lattice that somebody works on alone.
#[derive(Debug)]
pub struct Window<'a> {
    cells: &'a mut [i32],
    first: usize,
}

impl Window<'_> {
    /// What is in a cell.
    #[inline]
    pub fn at(&self, cell: usize) -> i32 {
        self.cells[cell - self.first]
    }

    /// Puts something into a cell.
    #[inline]
    pub fn set(&mut self, cell: usize, content: i32) {
        self.cells[cell - self.first] = content;
    }
}
