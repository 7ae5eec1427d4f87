//! The sites of a gas: who is next to whom.
//!
//! Columns run along gravity and odd ones stand half a spacing higher, as in [`crate::lattice::grid`]; unlike there an axis may
//! end where it begins.

use super::step::MIRRORED;
use crate::lattice::direction::Direction;

/// A rectangular piece of the lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sites {
    /// Number of columns.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
    /// Whether the last column is next to the first, and the last row to the first.
    pub periodic: [bool; 2],
}

impl Sites {
    /// So many columns and rows.
    ///
    /// # Panics
    ///
    /// Where columns of one kind would meet: a lattice periodic along x needs an even number of them.
    pub fn new(columns: usize, rows: usize, periodic: [bool; 2]) -> Self {
        assert!(!periodic[0] || columns.is_multiple_of(2), "odd columns stand higher");
        Self { columns, rows, periodic }
    }

    /// Number of sites.
    pub fn count(&self) -> usize {
        self.columns * self.rows
    }

    /// Index of a site.
    #[inline]
    pub fn index(&self, column: usize, row: usize) -> usize {
        column * self.rows + row
    }

    /// Column and row of a site.
    #[inline]
    pub fn column_and_row(&self, site: usize) -> (usize, usize) {
        (site / self.rows, site % self.rows)
    }

    /// The site next to one, counted on beyond the ends.
    #[inline]
    fn beside(column: usize, row: usize, way: Direction) -> (i64, i64) {
        let to = column as i64 + way.h();
        (to, (2 * row as i64 + (column % 2) as i64 + way.k() - to.rem_euclid(2)) >> 1)
    }

    /// The neighbour of a site, if there is one.
    #[inline]
    pub fn neighbour(&self, column: usize, row: usize, way: Direction) -> Option<(usize, usize)> {
        let wrap = |at: i64, size: usize, ends: bool| {
            if (0..size as i64).contains(&at) {
                Some(at as usize)
            } else {
                ends.then(|| at.rem_euclid(size as i64) as usize)
            }
        };
        let (to, row) = Self::beside(column, row, way);
        Some((wrap(to, self.columns, self.periodic[0])?, wrap(row, self.rows, self.periodic[1])?))
    }

    /// Which ends lie between a site and its neighbour, 1 for the high and -1 for the low one of an axis.
    #[inline]
    pub fn crossing(&self, column: usize, row: usize, way: Direction) -> [i32; 2] {
        let end = |at: i64, size: usize| i32::from(at >= size as i64) - i32::from(at < 0);
        let (to, row) = Self::beside(column, row, way);
        [end(to, self.columns), end(row, self.rows)]
    }

    /// Sites from which somebody may leave at an end.
    pub fn edge(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let Self { columns, rows, .. } = *self;
        let inner = move |column: &usize| *column > 0 && *column + 1 < columns;
        let sides = [0, columns - 1].into_iter().take(columns).flat_map(move |c| (0..rows).map(move |r| (c, r)));
        sides.chain((0..columns).filter(inner).flat_map(move |c| [(c, 0), (c, rows - 1)].into_iter().take(rows)))
    }

    /// The walls beside a site, and how each [mirrors](Self::mirror).
    pub fn walls_beside(&self, site: usize, wall: impl Fn(usize) -> bool) -> Vec<(usize, usize, Option<usize>)> {
        let (column, row) = self.column_and_row(site);
        let beside = Direction::ALL.into_iter().filter_map(|way| self.neighbour(column, row, way));
        let walls = beside.filter(|(c, r)| wall(self.index(*c, *r)));
        walls.map(|(c, r)| (c, r, self.mirror(c, r, &wall))).collect()
    }

    /// How a smooth wall at a site mirrors: Some(0) as an upright one, Some(1) as a level one; `None` if either would send
    /// somebody who comes from the gas anywhere but into the gas. `wall` tells of a site whether it is wall.
    pub fn mirror(&self, column: usize, row: usize, wall: impl Fn(usize) -> bool) -> Option<usize> {
        let gas = |way: Direction| self.neighbour(column, row, way).is_some_and(|(c, r)| !wall(self.index(c, r)));
        (0..2).find(|&axis: &usize| {
            let out = |way: Direction| Direction::from_index(MIRRORED[axis][way as usize]);
            Direction::ALL.into_iter().filter(|way| gas(way.opposite())).all(|way| gas(out(way)))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Sites;
    use crate::lattice::direction::Direction;
    use crate::lattice::grid::Grid;

    /// Neighbours are those of the grid; across an end the way back leads back, and both ways cross it.
    #[test]
    fn neighbours_are_those_of_the_grid() {
        let (sites, grid) = (Sites::new(6, 9, [true, true]), Grid::new(6, 9));
        for (column, row) in (0..6).flat_map(|c| (0..9).map(move |r| (c, r))) {
            for way in Direction::ALL {
                let (c, r) = sites.neighbour(column, row, way).expect("no end");
                assert_eq!(sites.neighbour(c, r, way.opposite()), Some((column, row)));
                let [there, back] = [sites.crossing(column, row, way), sites.crossing(c, r, way.opposite())];
                assert_eq!(there, back.map(|lap| -lap));
                if there == [0, 0] {
                    let cell = grid.neighbour(grid.index(column, row), column, way);
                    assert_eq!(grid.column_and_row(cell), (c, r));
                } else {
                    assert!(sites.edge().any(|site| site == (column, row)));
                    assert_eq!(Sites::new(6, 9, [false, false]).neighbour(column, row, way), None);
                }
            }
        }
    }

    /// Straight walls mirror, slopes and ends do not.
    #[test]
    fn straight_walls_mirror() {
        let sites = Sites::new(12, 12, [false, false]);
        let left = |site: usize| site < 12;
        assert_eq!(sites.mirror(0, 6, left), Some(0));
        let floor = |site: usize| site.is_multiple_of(12);
        assert_eq!((sites.mirror(5, 0, floor), sites.mirror(6, 0, floor)), (Some(1), Some(1)));
        let slope = |site: usize| site / 12 < site % 12;
        assert_eq!(sites.mirror(5, 6, slope), None);
    }
}
