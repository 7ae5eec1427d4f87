//! The ground that a model plays on: a lattice laid over the scene, with the scene's walls and outlets painted onto it.
//!
//! A site is as wide as a grain. It belongs to a wall if a grain on it would be cut by one: if its centre is behind, or
//! less than half a spacing before, one of its planes, or within half a spacing of another surface. It is an outlet if it
//! lies where the scene removes grains. Whatever lies beyond the rim of the lattice is wall; along an axis that repeats itself
//! there is no rim.

use crate::lattice::grid::{COLUMN_SPACING, Grid};
use crate::lattice::sheet::{EMPTY, Layout, OUT, ROW_SPACING, Sheet, WALL};
use crate::wall::{Surface, Wall};
use glam::DVec3;
use tsubu_scene::plan::{Region, Removal};

/// The largest ground [sites].
pub const LARGEST: f64 = 1e8;

/// How sites lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sites {
    /// Level rows.
    Level(Layout),
    /// Upright columns of a triangular lattice, every other one half a spacing higher.
    Upright,
}

impl Sites {
    /// Whether grains can go from a column and row to one beside it, `across` and `up` being 0, 1 or 2 for one less, the same,
    /// or one more.
    pub(crate) const fn meet(self, column: usize, row: usize, across: usize, up: usize) -> bool {
        // Every other row or column is shifted, and each site next to two of the next one.
        match self {
            Self::Level(Layout::Triangular) => up == 1 || across == 1 || across == 2 * (row % 2),
            Self::Level(Layout::Square) => true,
            Self::Upright => across == 1 || up == 1 || up == 2 * (column % 2),
        }
    }

    /// Distances of columns and of rows, in spacings.
    const fn pitch(self) -> (f64, f64) {
        match self {
            Self::Level(Layout::Triangular) => (1.0, ROW_SPACING),
            Self::Level(Layout::Square) => (1.0, 1.0),
            Self::Upright => (COLUMN_SPACING, 1.0),
        }
    }
}

/// A lattice over a scene.
#[derive(Clone, Debug)]
pub struct Ground {
    /// How sites lie.
    pub sites: Sites,
    /// Width of a site [m].
    pub spacing: f64,
    /// Columns, with the rim.
    pub columns: usize,
    /// Rows, with the rim.
    pub rows: usize,
    /// Whether the last column is next to the first, and the last row to the first.
    pub periodic: [bool; 2],
    /// Where column 0 and row 0 are [m].
    origin: DVec3,
}

/// No wall owns the site.
pub const NOBODY: u16 = u16::MAX;

impl Ground {
    /// A lattice over a region, its outermost grains half a spacing from the ends. `None` if the region is not wider than
    /// a grain or has more than [`LARGEST`] sites.
    pub fn new(sites: Sites, region: &Region, spacing: f64) -> Option<Self> {
        Self::repeating(sites, region, spacing, [false; 2])
    }

    /// The same; along periodic axes the nearest whole number of sites, of columns an even one.
    pub fn repeating(sites: Sites, region: &Region, spacing: f64, periodic: [bool; 2]) -> Option<Self> {
        let (wide, high) = sites.pitch();
        let size = (DVec3::from_array(region.high) - DVec3::from_array(region.low)) / spacing;
        let columns = if periodic[0] {
            2.0 * (0.5 * size.x / wide).round()
        } else {
            ((size.x - 1.0) / wide + 1e-6).floor() + 1.0
        };
        let rows = if periodic[1] { (size.z / high).round() } else { ((size.z - 1.0) / high - 1e-6).ceil() + 1.0 };
        if !(columns >= 1.0 && rows >= 1.0 && columns * rows <= LARGEST) {
            return None;
        }
        let first = |periodic: bool, pitch: f64| if periodic { 0.5 * pitch } else { 0.5 - pitch };
        // Odd columns stand half a site higher: both kinds lie between the ends.
        let low = if periodic[1] && sites == Sites::Upright { 0.25 } else { first(periodic[1], high) };
        let origin = DVec3::from_array(region.low) + DVec3::new(first(periodic[0], wide), 0.0, low) * spacing;
        let rim = |periodic: bool| if periodic { 0 } else { 2 };
        let (columns, rows) = (columns as usize + rim(periodic[0]), rows as usize + rim(periodic[1]));
        Some(Self { sites, spacing, columns, rows, periodic, origin })
    }

    /// PeriodicBounds of the world along the axes that repeat themselves [m].
    pub fn ends(&self) -> [Option<[f64; 2]>; 3] {
        let (wide, high) = self.sites.pitch();
        let low = self.origin - self.spacing * DVec3::new(0.5 * wide, 0.0, 0.25);
        let end =
            |axis: usize, low: f64, length: f64| self.periodic[axis].then_some([low, low + length * self.spacing]);
        [end(0, low.x, wide * self.columns as f64), None, end(1, low.z, high * self.rows as f64)]
    }

    /// Whether a site is on the rim.
    fn on_rim(&self, site: usize) -> bool {
        let (column, row) = self.column_and_row(site);
        let end = |at: usize, size: usize, axis: usize| !self.periodic[axis] && (at == 0 || at + 1 == size);
        end(column, self.columns, 0) || end(row, self.rows, 1)
    }

    /// Number of sites.
    pub fn len(&self) -> usize {
        self.columns * self.rows
    }

    /// Whether there are none; there never are.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Column and row of a site.
    pub fn column_and_row(&self, site: usize) -> (usize, usize) {
        match self.sites {
            Sites::Level(_) => (site % self.columns, site / self.columns),
            Sites::Upright => (site / self.rows, site % self.rows),
        }
    }

    /// The site of a column and row.
    pub fn index(&self, column: usize, row: usize) -> usize {
        match self.sites {
            Sites::Level(_) => row * self.columns + column,
            Sites::Upright => column * self.rows + row,
        }
    }

    /// Centre of a site [m].
    pub fn point(&self, site: usize) -> DVec3 {
        let (column, row) = self.column_and_row(site);
        let (c, r) = (column as f64, row as f64);
        let [x, z] = match self.sites {
            Sites::Level(Layout::Triangular) => [c + 0.5 * (row % 2) as f64, ROW_SPACING * r],
            Sites::Level(Layout::Square) => [c, r],
            Sites::Upright => [COLUMN_SPACING * c, r + 0.5 * (column % 2) as f64],
        };
        self.origin + self.spacing * DVec3::new(x, 0.0, z)
    }

    /// The site nearest to a point in the plane, and its distance [m]; the rim does not count.
    pub fn nearest(&self, point: DVec3) -> Option<(usize, f64)> {
        let at = (point - self.origin) / self.spacing;
        let (wide, high) = self.sites.pitch();
        let around = |x: f64, end: usize| {
            let low = (x.floor() - 1.0).max(0.0) as usize;
            (low..low + 4).filter(move |&index| index < end)
        };
        let candidates = around(at.x / wide, self.columns)
            .flat_map(|column| around(at.z / high, self.rows).map(move |row| (column, row)));
        let flat = |p: DVec3| p.x.hypot(p.z);
        candidates
            .map(|(column, row)| self.index(column, row))
            .filter(|site| !self.on_rim(*site))
            .map(|site| (site, flat(self.point(site) - point)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Middle of the ground, and its width and height [m].
    pub fn inside(&self) -> (DVec3, DVec3) {
        let (low, high) = (self.point(0), self.point(self.len() - 1));
        (0.5 * (low + high), high - low)
    }

    /// What walls that stand and removal make of every site, and which wall owns it.
    pub fn paint(&self, walls: &[Wall], removal: &[Removal]) -> (Vec<i32>, Vec<u16>) {
        let mut cells = vec![EMPTY; self.len()];
        let mut owner = vec![NOBODY; self.len()];
        let mut near = Vec::new();
        for site in 0..self.len() {
            let point = self.point(site);
            for (number, wall) in walls.iter().enumerate() {
                let planes = matches!(wall.surface, Surface::HalfSpaces { .. });
                let reach = self.spacing * if planes { 0.5 - 1e-6 } else { 0.5 + 1e-6 };
                wall.near(point, self.spacing, &mut near);
                if near.iter().any(|&element| wall.nearest(element, point).distance < reach) {
                    cells[site] = WALL;
                    owner[site] = number as u16;
                    break;
                }
            }
            if self.on_rim(site) {
                cells[site] = WALL;
            } else if cells[site] == EMPTY && removal.iter().any(|removal| removal.takes(point.to_array())) {
                cells[site] = OUT;
            }
        }
        (cells, owner)
    }

    /// A sheet with those contents; only for level rows.
    pub fn sheet(&self, cells: &[i32]) -> Sheet {
        let layout = if let Sites::Level(layout) = self.sites { layout } else { Layout::Triangular };
        let mut sheet = Sheet::new(layout, self.columns, self.rows);
        sheet.cells.copy_from_slice(cells);
        sheet
    }

    /// A grid with those walls; only for upright columns.
    pub fn grid(&self, cells: &[i32]) -> Grid {
        let mut grid = Grid::new(self.columns, self.rows);
        for (site, &cell) in cells.iter().enumerate() {
            grid.set(site, if cell == WALL { WALL } else { EMPTY });
        }
        grid
    }
}

#[cfg(test)]
mod tests {
    use super::{Ground, Sites};
    use crate::lattice::sheet::Layout;
    use glam::DVec3;
    use tsubu_scene::plan::Region;

    /// The outermost sites lie half a spacing from the ends, and the nearest site of a site's centre is the site.
    #[test]
    fn sites_fit_the_region_and_are_found() {
        let region = Region::of_box([-5.0, 0.0, 1.0], [5.0, 0.0, 11.0]);
        for sites in [Sites::Level(Layout::Triangular), Sites::Level(Layout::Square), Sites::Upright] {
            let ground = Ground::new(sites, &region, 1.0).expect("a region of ten sites");
            let inner: Vec<usize> = (0..ground.len())
                .filter(|&s| {
                    let (c, r) = ground.column_and_row(s);
                    c > 0 && r > 0 && c + 1 < ground.columns && r + 1 < ground.rows
                })
                .collect();
            let least = inner.iter().map(|&s| ground.point(s)).reduce(DVec3::min).expect("sites");
            assert!((least.x + 4.5).abs() < 1e-12 && (least.z - 1.5).abs() < 0.5 + 1e-12, "{sites:?}: {least}");
            for site in inner {
                let found = ground.nearest(ground.point(site) + DVec3::new(0.2, 0.0, -0.2)).expect("a site");
                assert_eq!(found.0, site, "{sites:?}");
            }
        }
        assert!(Ground::new(Sites::Upright, &region, 20.0).is_none());
    }
}
