//! The cells of a triangular lattice: who sits where.
//!
//! Columns run along gravity; odd columns are shifted up by half a cell. Cells of one column lie side by side in memory, so
//! that N and S are the next and the previous cell. A cell holds a ball's number, [`EMPTY`] or [`WALL`].

use super::direction::{Direction, Vector};

/// Nobody is in the cell.
pub const EMPTY: i32 = -1;
/// The cell belongs to a wall.
pub const WALL: i32 = -2;

/// How the cells of a rectangular piece of the lattice are numbered: column by column.
#[derive(Clone, Copy, Debug)]
pub struct Numbering {
    columns: usize,
    rows: usize,
    /// Index differences to the six neighbours, for even and odd columns.
    offsets: [[isize; 6]; 2],
}

impl Numbering {
    /// Column and row of a cell.
    #[inline]
    pub fn column_and_row(&self, cell: usize) -> (usize, usize) {
        (cell / self.rows, cell % self.rows)
    }

    /// The neighbour of a cell; `odd` is the parity of the cell's column. The cell must not be on the rim of the grid.
    #[inline]
    pub fn neighbour(&self, cell: usize, odd: usize, direction: Direction) -> usize {
        cell.wrapping_add_signed(self.offsets[odd & 1][direction as usize])
    }
}

/// Occupancy of a rectangular piece of the lattice.
#[derive(Clone, Debug)]
pub struct Grid {
    numbering: Numbering,
    cells: Vec<i32>,
}

impl Grid {
    /// A grid of walls.
    pub fn new(columns: usize, rows: usize) -> Self {
        let column = rows as isize;
        // From an even column the right-hand neighbours stand at rows r (half a cell higher) and r - 1; from an odd one
        // at r + 1 and r.
        let even = [1, column, column - 1, -1, -column - 1, -column];
        let odd = [1, column + 1, column, -1, -column, -column + 1];
        Self { numbering: Numbering { columns, rows, offsets: [even, odd] }, cells: vec![WALL; columns * rows] }
    }

    /// How its cells are numbered.
    pub fn numbering(&self) -> Numbering {
        self.numbering
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.numbering.columns
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.numbering.rows
    }

    /// Index of a cell.
    #[inline]
    pub fn index(&self, column: usize, row: usize) -> usize {
        column * self.rows() + row
    }

    /// Column and row of a cell.
    #[inline]
    pub fn column_and_row(&self, cell: usize) -> (usize, usize) {
        self.numbering.column_and_row(cell)
    }

    /// What is in a cell.
    #[inline]
    pub fn at(&self, cell: usize) -> i32 {
        self.cells[cell]
    }

    /// All cells, column by column.
    pub fn cells_mut(&mut self) -> &mut [i32] {
        &mut self.cells
    }

    /// Puts something into a cell.
    #[inline]
    pub fn set(&mut self, cell: usize, content: i32) {
        self.cells[cell] = content;
    }

    /// The neighbour of a cell; `odd` is the parity of the cell's column. The cell must not be on the rim of the grid.
    #[inline]
    pub fn neighbour(&self, cell: usize, odd: usize, direction: Direction) -> usize {
        self.numbering.neighbour(cell, odd, direction)
    }

    /// Index difference from a cell, in an even (0) or odd (1) column, to the one a vector away; h + k must be even.
    pub fn offset(&self, odd: usize, vector: Vector) -> isize {
        let other = (odd as i64 + vector.h).rem_euclid(2);
        (vector.h * self.rows() as i64 + (odd as i64 + vector.k - other) / 2) as isize
    }

    /// Height of a cell's centre over that of row 0 in even columns, in half cells.
    #[inline]
    pub fn half_height(&self, cell: usize) -> i64 {
        let (column, row) = self.column_and_row(cell);
        (2 * row + column % 2) as i64
    }

    /// Puts the same into all cells.
    pub fn fill(&mut self, content: i32) {
        self.cells.fill(content);
    }

    /// Makes everything wall but the interior: columns `1..=columns`, rows `floor..floor + rows`. Balls are wiped out.
    pub fn paint_box(&mut self, columns: usize, floor: usize, rows: usize) {
        self.cells.fill(WALL);
        for column in 1..=columns {
            let first = self.index(column, floor);
            self.cells[first..first + rows].fill(EMPTY);
        }
    }
}

/// Distance between neighbouring columns over the cell spacing: sqrt(3)/2.
pub const COLUMN_SPACING: f64 = 0.866_025_403_784_438_6;

#[cfg(test)]
mod tests {
    use super::{COLUMN_SPACING, Grid};
    use crate::lattice::direction::Direction;

    /// Every neighbour lies one cell spacing away, in its direction, from both kinds of column.
    #[test]
    fn neighbours_lie_where_they_should() {
        let grid = Grid::new(7, 9);
        for column in [2, 3] {
            let cell = grid.index(column, 4);
            for direction in Direction::ALL {
                let other = grid.neighbour(cell, column, direction);
                let x = (grid.column_and_row(other).0 as f64 - column as f64) * COLUMN_SPACING;
                let z = 0.5 * (grid.half_height(other) - grid.half_height(cell)) as f64;
                let unit = direction.unit();
                assert!((x - unit[0]).abs() < 1e-12 && (z - unit[2]).abs() < 1e-12, "{direction:?} {x} {z}");
                let odd = grid.column_and_row(other).0;
                assert_eq!(grid.neighbour(other, odd, direction.opposite()), cell);
            }
        }
    }
}
