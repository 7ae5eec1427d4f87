//! Grains made of lattice points, and what moving one of them by one spacing means.
//!
//! A [`Shape`] is a connected set of lattice points round a reference point. Its [`Stencil`] knows, for every direction,
//! the points that a move takes (`ahead`) and those that it leaves (`behind`): only these, a part of the outline, are
//! looked at in a collision test.

use super::direction::{Direction, Vector};
use super::grid::Grid;
use std::collections::BTreeSet;
use tsubu_scene::Cells;

/// A set of lattice points round the origin, in the basis (h, k) of [`Vector`]; h + k is even.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shape {
    cells: Cells,
    points: Vec<Vector>,
}

impl Shape {
    /// The shape of cells.
    pub fn of(cells: Cells) -> Self {
        let points = vectors(cells.points());
        Self { cells, points }
    }

    /// The hexagon of all points at most `radius` spacings from its centre: 3 r^2 + 3 r + 1 points.
    pub fn hexagon(radius: usize) -> Self {
        Self::of(Cells::hexagon(radius))
    }

    /// Any set of points; `None` if it is empty, not connected, names a point twice or one that is not of the lattice.
    /// The reference point becomes the lattice point nearest to the centroid.
    pub fn new(points: &[Vector]) -> Option<Self> {
        Cells::new(&points.iter().map(|p| [p.h, p.k]).collect::<Vec<_>>()).map(Self::of)
    }

    /// The points, column by column from below.
    pub fn points(&self) -> &[Vector] {
        &self.points
    }

    /// Columns and rows of its points for a reference point in a column and row.
    pub fn seen_from(&self, column: usize, row: i64) -> impl Iterator<Item = [i64; 2]> {
        let odd = (column % 2) as i64;
        self.points.iter().map(move |point| {
            let shifted = (odd + point.h).rem_euclid(2);
            [column as i64 + point.h, row + (odd + point.k - shifted) / 2]
        })
    }

    /// The same as cells.
    pub fn cells(&self) -> &Cells {
        &self.cells
    }

    /// Turned about its reference point by 60 degrees clockwise.
    #[must_use]
    pub fn turned(&self) -> Self {
        Self::of(self.cells.turned())
    }

    /// Corners of its outline as a closed line, in half spacings from the reference point: see [`Cells::outline`].
    pub fn outline(&self) -> Vec<Vector> {
        vectors(&self.cells.outline())
    }

    /// Diameter of the disc of the same area, in spacings: each point stands for an area of sqrt(3)/2.
    pub fn diameter(&self) -> f64 {
        (self.points.len() as f64 * 4.0 * 0.75_f64.sqrt() / std::f64::consts::PI).sqrt()
    }
}

fn vectors(points: &[[i64; 2]]) -> Vec<Vector> {
    points.iter().map(|&[h, k]| Vector { h, k }).collect()
}

/// Index differences of a shape's points on a grid, for a reference point in an even and in an odd column.
#[derive(Clone, Debug)]
pub struct Stencil {
    /// All points.
    pub points: [Vec<isize>; 2],
    /// The points that a move takes, seen from where it starts.
    pub ahead: [[Vec<isize>; 6]; 2],
    /// The points that a move leaves, seen from where it starts.
    pub behind: [[Vec<isize>; 6]; 2],
}

impl Stencil {
    /// The stencil of a shape on a grid.
    pub fn new(shape: &Shape, grid: &Grid) -> Self {
        let here: BTreeSet<(i64, i64)> = shape.points.iter().map(|p| (p.h, p.k)).collect();
        let moved = |d: Direction| here.iter().map(|(h, k)| (h + d.h(), k + d.k())).collect::<BTreeSet<_>>();
        let indices = |odd: usize, set: &mut dyn Iterator<Item = &(i64, i64)>| {
            set.map(|&(h, k)| grid.offset(odd, Vector { h, k })).collect::<Vec<_>>()
        };
        let edges = |odd: usize, ahead: bool| {
            Direction::ALL.map(|d| {
                let there = moved(d);
                let (to, from) = if ahead { (&there, &here) } else { (&here, &there) };
                indices(odd, &mut to.difference(from))
            })
        };
        Self {
            points: [0, 1].map(|odd| indices(odd, &mut here.iter())),
            ahead: [0, 1].map(|odd| edges(odd, true)),
            behind: [0, 1].map(|odd| edges(odd, false)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Shape, Stencil};
    use crate::lattice::direction::{Direction, Vector};
    use crate::lattice::grid::Grid;

    /// Columns and rows that a shape is told to have are those that its stencil has on the grid, from both kinds of column.
    #[test]
    fn shapes_lie_where_their_stencil_does() {
        let (shape, grid) = (Shape::hexagon(2), Grid::new(15, 15));
        let stencil = Stencil::new(&shape, &grid);
        for column in [6, 7] {
            let middle = grid.index(column, 7);
            let told = shape.seen_from(column, 7).map(|[column, row]| grid.index(column as usize, row as usize));
            let drawn = stencil.points[column % 2].iter().map(|offset| middle.wrapping_add_signed(*offset));
            assert!(told.eq(drawn), "column {column}");
            for direction in Direction::ALL {
                // A move takes as much as it leaves: one side of the hexagon.
                let [ahead, behind] =
                    [&stencil.ahead, &stencil.behind].map(|edge| edge[column % 2][direction as usize].len());
                assert_eq!([ahead, behind], [5, 5]);
            }
        }
    }

    /// 3 r^2 + 3 r + 1 points, and the same shape after a turn; a rod is another shape after a turn and itself after three.
    #[test]
    fn hexagons_have_their_points_and_symmetry() {
        for (radius, points) in [(0, 1), (1, 7), (2, 19), (3, 37), (4, 61)] {
            let hexagon = Shape::hexagon(radius);
            assert_eq!(hexagon.points().len(), points);
            assert_eq!(hexagon.turned(), hexagon);
        }
        let rod = Shape::new(&[0, 2, 4].map(|k| Vector { h: 0, k })).expect("a grain");
        assert_ne!(rod.turned(), rod);
        assert_eq!(rod.turned().turned().turned(), rod);
        // Clockwise: what is above comes to the upper right.
        let lead = |rod: &Shape| rod.points().contains(&Direction::NE.times(1));
        assert!(lead(&rod.turned()) && !lead(&rod));
    }
}
