//! The piece of the lattice that a scene is played on, and the scene's walls painted onto it.
//!
//! A point of the lattice belongs to a wall if it lies behind one of its planes, or within half a spacing of one of its
//! surfaces. No bond between neighbours can then cross a surface from one free point to another: the distances of two
//! points on opposite sides add up to at most one spacing, so one of them is at most half a spacing away.
//!
//! Walls that move do so by whole steps of the lattice: the vector nearest to their displacement.

use super::direction::Vector;
use super::grid::{COLUMN_SPACING, EMPTY, Grid, WALL};
use crate::wall::{Surface, Wall};
use glam::DVec3;
use tsubu_scene::plan::{Plan, Region, Start};

/// Columns and rows beyond the region on every side: all of them wall.
pub const RIM: usize = 16;

/// The largest lattice [points].
pub const LARGEST: f64 = 4e8;

/// Where the points of a lattice lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage {
    /// Distance of neighbours [m].
    pub spacing: f64,
    /// The point in column 0 and row 0 [m].
    pub origin: DVec3,
    /// Number of columns, with the rims.
    pub columns: usize,
    /// Number of rows, with the rims.
    pub rows: usize,
}

impl Stage {
    /// A lattice over a region. Its first column begins half a column from the low end, so that a wall there keeps
    /// whole columns. `None` if the region is not wider than a spacing, or has more than [`LARGEST`] points.
    pub fn new(region: &Region, spacing: f64) -> Option<Self> {
        let size = DVec3::from_array(region.high) - DVec3::from_array(region.low);
        let columns = (size.x / (COLUMN_SPACING * spacing) + 1e-6).floor();
        let rows = (size.z / spacing - 1e-6).ceil();
        if !(columns >= 1.0 && rows >= 1.0 && columns * rows <= LARGEST) {
            return None;
        }
        let rim = RIM as f64;
        let first = DVec3::new((0.5 - rim) * COLUMN_SPACING, 0.0, 0.5 - rim) * spacing;
        Some(Self {
            spacing,
            origin: DVec3::from_array(region.low) + first,
            columns: columns as usize + 2 * RIM,
            rows: rows as usize + 2 * RIM,
        })
    }

    /// A place of the lattice, in columns and half cells from the origin [m].
    pub fn position(&self, at: Vector) -> DVec3 {
        self.origin + self.step(at)
    }

    /// A vector of the lattice [m].
    pub fn step(&self, by: Vector) -> DVec3 {
        DVec3::new(COLUMN_SPACING * by.h as f64, 0.0, 0.5 * by.k as f64) * self.spacing
    }

    /// The vector of the lattice nearest to one in space.
    pub fn vector(&self, by: DVec3) -> Vector {
        let column = (by.x / (COLUMN_SPACING * self.spacing)).round() as i64;
        let candidates = (column - 1..=column + 1).map(|h| {
            // k has the parity of h.
            let half = by.z / self.spacing - 0.5 * h as f64;
            Vector { h, k: 2 * half.round() as i64 + h }
        });
        let off = |v: &Vector| (self.step(*v) - by).length_squared();
        candidates.min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or_default()
    }

    /// The cell nearest to a point in the plane; `None` outside.
    pub fn cell(&self, grid: &Grid, point: DVec3) -> Option<usize> {
        let Vector { h, k } = self.vector(DVec3::new(point.x, 0.0, point.z) - self.origin);
        let (column, row) = (usize::try_from(h).ok()?, usize::try_from((k - (h & 1)) / 2).ok()?);
        (k >= 0 && column < self.columns && row < self.rows).then(|| grid.index(column, row))
    }

    /// Middle and size of all but the rims [m].
    pub fn inside(&self) -> (DVec3, DVec3) {
        let (columns, rows) = (self.columns as i64, self.rows as i64);
        let rims = 2 * RIM as i64;
        (
            self.position(Vector { h: columns / 2, k: rows }),
            self.step(Vector { h: columns - rims, k: 2 * (rows - rims) }),
        )
    }

    /// All points but the rims.
    pub fn grid(&self) -> Grid {
        let mut grid = Grid::new(self.columns, self.rows);
        grid.fill(WALL);
        for column in RIM..self.columns - RIM {
            for row in RIM..self.rows - RIM {
                let cell = grid.index(column, row);
                grid.set(cell, EMPTY);
            }
        }
        grid
    }

    /// Paints a wall that stands where it was built.
    pub fn paint(&self, grid: &mut Grid, wall: &Wall) {
        let mut cells = Vec::new();
        self.covered(grid, wall, Vector::default(), |cell| cells.push(cell));
        for cell in cells {
            grid.set(cell, WALL);
        }
    }

    /// Calls for every cell that a wall covers when it has moved by `shift` since it was built.
    pub fn covered(&self, grid: &Grid, wall: &Wall, shift: Vector, mut call: impl FnMut(usize)) {
        let moved = self.step(shift);
        let planes = matches!(wall.surface, Surface::HalfSpaces { .. });
        // A plane that runs through points leaves them free.
        let reach = self.spacing * if planes { -1e-6 } else { 0.5 + 1e-6 };
        let mut near = Vec::new();
        for column in 0..self.columns {
            for row in 0..self.rows {
                let cell = grid.index(column, row);
                let at = Vector { h: column as i64, k: grid.half_height(cell) };
                let point = self.position(at) - moved;
                wall.near(point, self.spacing, &mut near);
                if near.iter().any(|&element| wall.nearest(element, point).distance < reach) {
                    call(cell);
                }
            }
        }
    }
}

/// The region that the grains of a plan can reach, as far as the plan tells: around where they begin and the walls that
/// have an end, cut at planes along the axes that stay, and widened to sides that are open by three times the height.
/// `None` if nothing tells.
pub fn region(plan: &Plan, walls: &[Wall], margin: f64) -> Option<Region> {
    let mut low = DVec3::INFINITY;
    let mut high = DVec3::NEG_INFINITY;
    let mut include = |point: DVec3, reach: f64| {
        low = low.min(point - DVec3::splat(reach));
        high = high.max(point + DVec3::splat(reach));
    };
    for group in plan.particles.values() {
        let radius = 0.5 * group.largest_diameter();
        match &group.start {
            Start::Rows { region, .. } | Start::Random { region, .. } => {
                for corner in region.iter().flat_map(|r| [r.low, r.high]) {
                    include(DVec3::from_array(corner), 0.0);
                }
            }
            Start::Stream { region, .. } => {
                include(DVec3::from_array(region.low), 0.0);
                include(DVec3::from_array(region.high), 0.0);
            }
            Start::At { position, .. } => position.iter().for_each(|p| include(DVec3::from_array(*p), radius)),
            Start::File { grains, .. } => grains.position.iter().for_each(|p| include(DVec3::from_array(*p), radius)),
            Start::Settled { .. } => {}
        }
    }
    for wall in walls {
        if wall.lone_plane().is_none() {
            let outline = wall.outline();
            outline.lines.iter().flatten().for_each(|p| include(*p, 0.0));
        }
    }
    let height = high.z - low.z;
    if height.is_nan() || height <= 0.0 {
        return None;
    }
    // PeriodicBounds: planes along an axis, boxes included, that grains are in front of and that stay where they are.
    let (mut ends_low, mut ends_high) = ([f64::NEG_INFINITY; 2], [f64::INFINITY; 2]);
    for wall in walls {
        let Surface::HalfSpaces { planes, .. } = &wall.surface else { continue };
        let stays = wall.until.is_none() && matches!(wall.mover, crate::wall::Mover::Still) && wall.turning.is_none();
        for plane in planes.iter().filter(|_| stays) {
            for (axis, along) in [(0, DVec3::X), (1, DVec3::Z)] {
                let at = plane.point.dot(along);
                if plane.normal.dot(along) > 1.0 - 1e-9 {
                    ends_low[axis] = ends_low[axis].max(at);
                } else if plane.normal.dot(along) < -1.0 + 1e-9 {
                    ends_high[axis] = ends_high[axis].min(at);
                }
            }
        }
    }
    let ends = |low: f64, high: f64, axis: usize, wide: f64| {
        let pick = |end: f64, open: f64| if end.is_finite() { end } else { open };
        (pick(ends_low[axis], low - wide), pick(ends_high[axis], high + wide))
    };
    let (left, right) = ends(low.x, high.x, 0, 3.0 * height);
    let (bottom, top) = ends(low.z, high.z, 1, margin);
    Some(Region::of_box([left, 0.0, bottom], [right, 0.0, top]))
}

#[cfg(test)]
mod tests {
    use super::Stage;
    use crate::lattice::direction::Vector;
    use glam::DVec3;
    use tsubu_scene::plan::Region;

    /// Places and nearest vectors undo each other, also a little off; a region of whole columns keeps them.
    #[test]
    fn places_and_vectors_agree() {
        let region = Region::of_box([0.0; 3], [100.0 * 0.75_f64.sqrt(), 0.0, 40.0]);
        let stage = Stage::new(&region, 1.0).expect("inside");
        assert_eq!((stage.columns, stage.rows), (132, 72));
        let grid = stage.grid();
        for at in [Vector { h: 20, k: 40 }, Vector { h: 21, k: 41 }, Vector { h: 57, k: 63 }] {
            let place = stage.position(at) + DVec3::new(0.2, 0.0, -0.3);
            assert_eq!(stage.vector(place - stage.origin), at);
            let cell = stage.cell(&grid, place).expect("inside");
            assert_eq!((grid.column_and_row(cell).0 as i64, grid.half_height(cell)), (at.h, at.k));
        }
        assert!(Stage::new(&region, 200.0).is_none());
        assert!(stage.cell(&grid, DVec3::new(-50.0, 0.0, 0.0)).is_none());
    }
}
