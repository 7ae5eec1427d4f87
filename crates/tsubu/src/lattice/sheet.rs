//! A piece of a lattice with level rows: who sits where.
//!
//! Sites of one row lie side by side in memory. On the [triangular](Layout::Triangular) lattice rows stand d sqrt(3)/2
//! apart and odd rows are shifted to the right by half a site, so that every site has two sites below it and two above,
//! 60 degrees from the level. On the [square](Layout::Square) lattice rows stand d apart. The outermost sites are a rim
//! that no grain may enter: nobody has to ask whether a neighbour exists.

/// How rows lie upon each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// Every other row is shifted by half a site.
    Triangular,
    /// Site above site.
    Square,
}

/// Nobody is on the site.
pub const EMPTY: i32 = -1;
/// The site belongs to a wall.
pub const WALL: i32 = -2;
/// Grains that come here are removed: an outlet.
pub const OUT: i32 = -3;

/// Height of a row of the triangular lattice over the spacing: sqrt(3)/2.
pub const ROW_SPACING: f64 = 0.866_025_403_784_438_6;

/// Occupancy of a rectangular piece of a lattice.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    layout: Layout,
    columns: usize,
    rows: usize,
    /// A grain's number, [`EMPTY`], [`WALL`] or [`OUT`].
    pub cells: Vec<i32>,
    /// Grains that were removed since somebody took note, each with its outlet.
    pub removed: Vec<(i32, usize)>,
}

impl Sheet {
    /// Empty sites within a rim of walls; the rim counts.
    pub fn new(layout: Layout, columns: usize, rows: usize) -> Self {
        let mut sheet = Self { layout, columns, rows, cells: vec![WALL; columns * rows], removed: Vec::new() };
        for row in 1..rows - 1 {
            for column in 1..columns - 1 {
                let site = sheet.index(column, row);
                sheet.cells[site] = EMPTY;
            }
        }
        sheet
    }

    /// Number of sites in a row, with the rim.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Number of rows, with the rim.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Index of a site.
    #[inline]
    pub fn index(&self, column: usize, row: usize) -> usize {
        row * self.columns + column
    }

    /// Column and row of a site.
    #[inline]
    pub fn column_and_row(&self, site: usize) -> (usize, usize) {
        (site % self.columns, site / self.columns)
    }

    /// Where a site is, in spacings from the first site of row 0: to the right, and up.
    pub fn point(&self, site: usize) -> [f64; 2] {
        let (column, row) = self.column_and_row(site);
        match self.layout {
            Layout::Triangular => [column as f64 + 0.5 * (row % 2) as f64, ROW_SPACING * row as f64],
            Layout::Square => [column as f64, row as f64],
        }
    }

    /// The two sites above, left and right; the site must not be on the rim. Triangular lattice.
    #[inline]
    pub fn above(&self, site: usize) -> [usize; 2] {
        let left = site + self.columns - 1 + self.shift(site);
        [left, left + 1]
    }

    /// The two sites below, left and right; the site must not be on the rim. Triangular lattice.
    #[inline]
    pub fn below(&self, site: usize) -> [usize; 2] {
        let left = site - self.columns - 1 + self.shift(site);
        [left, left + 1]
    }

    /// 1 in a row that is shifted to the right.
    #[inline]
    fn shift(&self, site: usize) -> usize {
        site / self.columns % 2
    }

    /// All sites with that content.
    pub fn sites(&self, content: i32) -> impl Iterator<Item = usize> + '_ {
        self.cells.iter().enumerate().filter(move |(_, c)| **c == content).map(|(site, _)| site)
    }

    /// Number of grains.
    pub fn grains(&self) -> usize {
        self.cells.iter().filter(|&&cell| cell >= 0).count()
    }

    /// Puts grains on all empty sites of the rows `from..until`, numbered on from `count`; returns the next number.
    pub fn fill(&mut self, from: usize, until: usize, mut count: i32) -> i32 {
        for cell in &mut self.cells[from * self.columns..until * self.columns] {
            if *cell == EMPTY {
                *cell = count;
                count += 1;
            }
        }
        count
    }
}

/// The last move of every grain: the step in which it was made, and how far it went, in half spacings to the right and
/// rows up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trail(pub Vec<(u64, [i32; 2])>);

impl Trail {
    /// The grains of a sheet have not moved.
    pub fn new(sheet: &Sheet) -> Self {
        let last = sheet.cells.iter().copied().max().unwrap_or(EMPTY);
        Self(vec![(0, [0; 2]); (last + 1).max(0) as usize])
    }

    /// A grain moves in a step; several moves in one step add up.
    #[inline]
    pub fn moves(&mut self, grain: i32, step: u64, by: [i32; 2]) {
        let (last, way) = &mut self.0[grain as usize];
        if *last == step {
            way[0] += by[0];
            way[1] += by[1];
        } else {
            (*last, *way) = (step, by);
        }
    }

    /// How far a grain went in a step.
    pub fn during(&self, grain: usize, step: u64) -> [i32; 2] {
        let (last, way) = self.0[grain];
        if last == step { way } else { [0; 2] }
    }
}

#[cfg(test)]
mod tests {
    use super::{Layout, ROW_SPACING, Sheet};

    /// Neighbours lie one spacing away, 60 degrees from the level, and name each other.
    #[test]
    fn neighbours_lie_where_they_should() {
        let sheet = Sheet::new(Layout::Triangular, 7, 9);
        for row in [3, 4] {
            let site = sheet.index(3, row);
            let [x, z] = sheet.point(site);
            for (side, lean) in [(0, -0.5), (1, 0.5)] {
                let (above, below) = (sheet.above(site)[side], sheet.below(site)[side]);
                let [up, down] = [sheet.point(above), sheet.point(below)];
                assert!((up[0] - x - lean).abs() < 1e-12 && (up[1] - z - ROW_SPACING).abs() < 1e-12);
                assert!((down[0] - x - lean).abs() < 1e-12 && (z - down[1] - ROW_SPACING).abs() < 1e-12);
                assert_eq!(sheet.below(above)[1 - side], site);
                assert_eq!(sheet.above(below)[1 - side], site);
            }
        }
    }
}
