//! Grains made of lattice points, and what moving one of them by one spacing means.
//!
//! A [`Shape`] is a connected set of lattice points round a reference point. Its [`Stencil`] knows, for every direction,
//! the points that a move takes (`ahead`) and those that it leaves (`behind`): only these, a part of the outline, are
//! looked at in a collision test.

use crate::lattice::direction::{Direction, Vector};
use crate::lattice::grid::Grid;
use std::collections::BTreeSet;

/// A set of lattice points round the origin, in the basis (h, k) of [`Vector`]; h + k is even.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shape {
    points: Vec<Vector>,
}

impl Shape {
    /// The hexagon of all points at most `radius` spacings from its centre: 3 r^2 + 3 r + 1 points.
    pub fn hexagon(radius: usize) -> Self {
        let r = radius as i64;
        let columns = -r..=r;
        // A column at distance |h| has 2 r + 1 - |h| points, two half spacings apart.
        let points = columns.flat_map(|h| {
            let top = 2 * r - h.abs();
            (-top..=top).step_by(2).map(move |k| Vector { h, k })
        });
        Self { points: points.collect() }
    }

    /// Any set of points; `None` if it is empty, not connected, names a point twice or one that is not of the lattice.
    /// The reference point becomes the lattice point nearest to the centroid.
    pub fn new(points: &[Vector]) -> Option<Self> {
        let set: BTreeSet<(i64, i64)> = points.iter().map(|p| (p.h, p.k)).collect();
        if set.len() != points.len() || set.iter().any(|(h, k)| (h + k) % 2 != 0) {
            return None;
        }
        let mut reached = BTreeSet::new();
        let mut front = vec![*set.first()?];
        while let Some((h, k)) = front.pop() {
            if reached.insert((h, k)) {
                let near = Direction::ALL.map(|d| (h + d.h(), k + d.k()));
                front.extend(near.into_iter().filter(|p| set.contains(p)));
            }
        }
        if reached.len() != set.len() {
            return None;
        }
        let mut shape = Self { points: set.into_iter().map(|(h, k)| Vector { h, k }).collect() };
        let [x, z] = shape.centroid();
        let distance = |p: &Vector| {
            let (dx, dz) = (p.h as f64 * 0.75_f64.sqrt() - x, 0.5 * p.k as f64 - z);
            dx * dx + dz * dz
        };
        let centre = shape.points.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        for point in &mut shape.points {
            *point = point.plus(Vector { h: -centre.h, k: -centre.k });
        }
        Some(shape)
    }

    /// The points, column by column from below.
    pub fn points(&self) -> &[Vector] {
        &self.points
    }

    /// Mean of the points, in spacings from the reference point: x and z.
    pub fn centroid(&self) -> [f64; 2] {
        let n = self.points.len() as f64;
        let (h, k) = self.points.iter().fold((0, 0), |(h, k), p| (h + p.h, k + p.k));
        [h as f64 * 0.75_f64.sqrt() / n, 0.5 * k as f64 / n]
    }

    /// Turned about its reference point by 60 degrees clockwise.
    #[must_use]
    pub fn turned(&self) -> Self {
        // N (0, 2) becomes NE (1, 1), NE becomes SE (1, -1).
        let turn = |p: &Vector| Vector { h: i64::midpoint(p.h, p.k), k: (p.k - 3 * p.h) / 2 };
        let mut points: Vec<_> = self.points.iter().map(turn).collect();
        points.sort_by_key(|p| (p.h, p.k));
        Self { points }
    }

    /// Corners of its outline as a closed line, in half spacings from the reference point.
    ///
    /// The line runs through the middles between the grain's points and those beside it that are not the grain's: straight
    /// along straight sides, half a row off them. Grains that touch have a stretch of line in common, and no two lines
    /// cross. The line round a hole hangs on the first by a way there and back.
    pub fn outline(&self) -> Vec<Vector> {
        let own: BTreeSet<(i64, i64)> = self.points.iter().map(|p| (p.h, p.k)).collect();
        let beside = |(h, k): (i64, i64), d: Direction| (h + d.h(), k + d.k());
        // Points with a way out of the grain: the line crosses each of these once.
        let ways = own.iter().flat_map(|&point| Direction::ALL.map(|out| (point, out)));
        let mut ways: Vec<_> = ways.filter(|&(point, out)| !own.contains(&beside(point, out))).collect();
        let mut corners: Vec<Vector> = Vec::new();
        while let Some(&first) = ways.first() {
            let (mut middles, mut at) = (Vec::new(), first);
            while let Some(here) = ways.iter().position(|way| *way == at) {
                ways.remove(here);
                let (point, out) = at;
                middles.push(Vector { h: 2 * point.0 + out.h(), k: 2 * point.1 + out.k() });
                // The next way out clockwise: from the same point, or from the one that stands there.
                let next = beside(point, out.clockwise());
                at = if own.contains(&next) { (next, out.counter_clockwise()) } else { (point, out.clockwise()) };
            }
            let count = middles.len();
            let side = |from: usize| {
                let (a, b) = (middles[from % count], middles[(from + 1) % count]);
                (b.h - a.h, b.k - a.k)
            };
            let bends = |i: &usize| side(i + count - 1) != side(*i);
            let mut line: Vec<Vector> = (0..count).filter(bends).map(|i| middles[i]).collect();
            if let Some(&hook) = corners.first() {
                line.extend(line.first().copied());
                corners.push(hook);
            }
            corners.append(&mut line);
        }
        corners
    }

    /// Diameter of the disc of the same area, in spacings: each point stands for an area of sqrt(3)/2.
    pub fn diameter(&self) -> f64 {
        (self.points.len() as f64 * 4.0 * 0.75_f64.sqrt() / std::f64::consts::PI).sqrt()
    }
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

/// All lattice points on or inside a closed line whose sides run along the lattice; `None` if a corner is not of the
/// lattice or a side runs another way.
pub fn polygon(corners: &[Vector]) -> Option<Vec<Vector>> {
    let mut border = BTreeSet::new();
    for (from, to) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let along = |d: &Direction| {
            let steps = if d.h() == 0 { (to.k - from.k) / d.k() } else { (to.h - from.h) / d.h() };
            (steps > 0 && from.plus(d.times(steps)) == *to).then_some((*d, steps))
        };
        let (direction, steps) = Direction::ALL.iter().find_map(along)?;
        border.extend((0..steps).map(|s| from.plus(direction.times(s))).map(|p| (p.h, p.k)));
    }
    if corners.iter().any(|p| (p.h + p.k) % 2 != 0) {
        return None;
    }
    let ends = |of: fn(&(i64, i64)) -> i64| (border.iter().map(of).min(), border.iter().map(of).max());
    let ((Some(left), Some(right)), (Some(low), Some(high))) = (ends(|p| p.0), ends(|p| p.1)) else { return None };
    // What is outside can be reached from the rim of a frame round the line without crossing it: neighbours of neighbours
    // cannot slip through, as the line itself is made of neighbours.
    let inside = |&(h, k): &(i64, i64)| (left - 1..=right + 1).contains(&h) && (low - 2..=high + 2).contains(&k);
    let mut outside = BTreeSet::new();
    let rim = (left - 1..=right + 1).flat_map(|h| [low - 2, low - 1, high + 1, high + 2].map(|k| (h, k)));
    let mut front: Vec<_> = rim.filter(|(h, k)| (h + k) % 2 == 0).collect();
    while let Some((h, k)) = front.pop() {
        if outside.insert((h, k)) {
            let near = Direction::ALL.map(|d| (h + d.h(), k + d.k()));
            front.extend(near.into_iter().filter(|p| inside(p) && !border.contains(p) && !outside.contains(p)));
        }
    }
    let all = (left..=right).flat_map(|h| (low..=high).map(move |k| (h, k)));
    let kept = all.filter(|p| (p.0 + p.1) % 2 == 0 && !outside.contains(p));
    Some(kept.map(|(h, k)| Vector { h, k }).collect())
}

#[cfg(test)]
mod tests {
    use super::{Shape, polygon};
    use crate::lattice::direction::{Direction, Vector};

    fn vectors(points: &[(i64, i64)]) -> Vec<Vector> {
        points.iter().map(|&(h, k)| Vector { h, k }).collect()
    }

    /// 3 r^2 + 3 r + 1 points, and the same shape after a turn; a rod is another shape after a turn and itself after three.
    #[test]
    fn hexagons_have_their_points_and_symmetry() {
        for (radius, points) in [(0, 1), (1, 7), (2, 19), (3, 37), (4, 61)] {
            let hexagon = Shape::hexagon(radius);
            assert_eq!(hexagon.points().len(), points);
            assert_eq!(hexagon.turned(), hexagon);
            let corners: Vec<_> = Direction::ALL.iter().map(|d| d.times(radius as i64)).collect();
            if radius > 0 {
                assert_eq!(Shape::new(&polygon(&corners).expect("a grain")).expect("a grain"), hexagon);
            }
        }
        let rod = Shape::new(&vectors(&[(0, 0), (0, 2), (0, 4)])).expect("a grain");
        assert_ne!(rod.turned(), rod);
        assert_eq!(rod.turned().turned().turned(), rod);
    }

    /// The outline of a hexagon has six corners, each half a point farther out than its own; that of three points in a row
    /// six as well. Every point is inside, every neighbour outside, whatever the shape and however it is turned: a hole is.
    #[test]
    fn outlines_part_a_grain_from_its_neighbours() {
        let ring: Vec<Vector> = Direction::ALL.iter().map(|d| d.times(1)).collect();
        let hook = vectors(&[(0, 0), (0, 2), (1, 3), (2, 2), (2, 0), (2, -2)]);
        let rod = vectors(&[(0, 0), (0, 2), (0, 4)]);
        let triangle = vectors(&[(0, 0), (0, 2), (1, 1)]);
        for (points, corners) in [(rod, 6), (triangle, 6), (hook, 12), (ring, 14)] {
            let mut shape = Shape::new(&points).expect("a grain");
            for turn in 0..6 {
                let line = shape.outline();
                assert_eq!(line.len(), corners, "{points:?} turned {turn} times");
                let near = shape.points().iter().flat_map(|p| Direction::ALL.map(|d| p.plus(d.times(1))));
                for point in shape.points().iter().copied().chain(near) {
                    assert_eq!(holds(&line, point), shape.points().contains(&point), "{point:?} of {points:?}");
                }
                shape = shape.turned();
            }
        }
        for radius in 0..4 {
            let mut line = Shape::hexagon(radius).outline();
            let mut far: Vec<Vector> = Direction::ALL.map(|d| d.times(2 * radius as i64 + 1)).to_vec();
            for corners in [&mut line, &mut far] {
                corners.sort_by_key(|p| (p.h, p.k));
            }
            assert_eq!(line, far);
        }
    }

    /// Whether a point of the lattice is inside a closed line of half spacings: how often the line crosses the way right.
    fn holds(line: &[Vector], point: Vector) -> bool {
        let (x, z) = (2.0 * point.h as f64, 2.0 * point.k as f64 + 0.1);
        let sides = line.iter().zip(line.iter().cycle().skip(1)).map(|(a, b)| [a.h, a.k, b.h, b.k].map(|c| c as f64));
        let right = |[h, k, i, l]: &[f64; 4]| (*k > z) != (*l > z) && h + (z - k) / (l - k) * (i - h) > x;
        sides.filter(right).count() % 2 == 1
    }

    #[test]
    fn what_is_no_grain_is_refused() {
        assert!(Shape::new(&vectors(&[(0, 0), (0, 4)])).is_none(), "two pieces");
        assert!(Shape::new(&vectors(&[(0, 0), (0, 1)])).is_none(), "between two points");
        assert!(Shape::new(&vectors(&[(0, 0), (0, 0)])).is_none(), "twice");
        assert!(Shape::new(&[]).is_none(), "nothing");
        assert!(polygon(&vectors(&[(0, 0), (2, 0), (0, 4)])).is_none(), "a side across the lattice");
    }

    /// A triangle of side 3 has 10 points: its row of four, three, two and one.
    #[test]
    fn polygons_are_filled() {
        let triangle = polygon(&vectors(&[(0, 0), (3, 3), (0, 6)])).expect("a grain");
        assert_eq!(triangle.len(), 10);
    }
}
