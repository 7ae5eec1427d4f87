//! Grains made of cells of a triangular lattice: their points, the line round them, how their mass is spread.
//!
//! A point [h, k], h + k even, lies at x = h sqrt(3)/2, z = k/2 in spacings, and stands for the hexagon of all that is nearer to it than to
//! other points, of area sqrt(3)/2.

use std::collections::BTreeSet;

/// A point of the lattice.
pub type Point = [i64; 2];

/// The way to the six neighbours of a point, clockwise from the one above.
const AROUND: [Point; 6] = [[0, 2], [1, 1], [1, -1], [0, -2], [-1, -1], [-1, 1]];

/// Area of a cell over the squared spacing.
pub(crate) const AREA: f64 = 0.866_025_403_784_438_6;

/// Mean of x^2, and of z^2, over a cell about its point, over the squared spacing: 5/72 of a hexagon whose sides are 1/2 from its middle.
const OWN: f64 = 5.0 / 72.0;

/// A connected set of points of the lattice, round one of them as the origin.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cells {
    points: Vec<Point>,
}

/// How the mass of cells is spread, in spacings.
pub(crate) struct Spread {
    /// The middle of all.
    pub centre: [f64; 2],
    /// Mean of (x - centre)^2, of the product with that of z, and of (z - centre)^2, with what the cells have themselves.
    pub second: [f64; 3],
}

impl Spread {
    /// The direction in which it is longest; x where none is.
    pub fn long(&self) -> [f64; 2] {
        let [xx, xz, zz] = self.second;
        let (level, slant) = (xx - zz, 2.0 * xz);
        if level.hypot(slant) < 1e-10 * (xx + zz) {
            return [1.0, 0.0];
        }
        let angle = 0.5 * slant.atan2(level);
        [angle.cos(), angle.sin()]
    }

    /// Mean of the squared distance from the line through the middle with a direction.
    pub fn beside(&self, [x, z]: [f64; 2]) -> f64 {
        let [xx, xz, zz] = self.second;
        xx * z * z - 2.0 * xz * x * z + zz * x * x
    }
}

fn plus(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1]]
}

fn even(points: &[Point]) -> bool {
    points.iter().all(|[h, k]| (h + k) % 2 == 0)
}

/// Where a point is, in spacings; of a corner of an outline in half spacings.
pub(crate) fn place([h, k]: Point) -> [f64; 2] {
    [h as f64 * AREA, 0.5 * k as f64]
}

impl Cells {
    /// The hexagon of all points at most `radius` spacings from its centre: 3 r^2 + 3 r + 1 points.
    pub fn hexagon(radius: usize) -> Self {
        let r = radius as i64;
        // A column at distance |h| has 2 r + 1 - |h| points, two half spacings apart.
        let points = (-r..=r).flat_map(|h| {
            let top = 2 * r - h.abs();
            (-top..=top).step_by(2).map(move |k| [h, k])
        });
        Self { points: points.collect() }
    }

    /// Any set of points; `None` if it is empty, not connected, names a point twice or one that is not of the lattice.
    /// The origin becomes the point nearest to the centroid.
    pub fn new(points: &[Point]) -> Option<Self> {
        let set: BTreeSet<Point> = points.iter().copied().collect();
        if set.len() != points.len() || !even(points) {
            return None;
        }
        let mut reached = BTreeSet::new();
        let mut front = vec![*set.first()?];
        while let Some(point) = front.pop() {
            if reached.insert(point) {
                front.extend(AROUND.map(|way| plus(point, way)).into_iter().filter(|p| set.contains(p)));
            }
        }
        if reached.len() != set.len() {
            return None;
        }
        let mut cells = Self { points: set.into_iter().collect() };
        let [x, z] = cells.centroid();
        let distance = |p: &Point| {
            let [px, pz] = place(*p);
            (px - x) * (px - x) + (pz - z) * (pz - z)
        };
        let [h, k] = cells.points.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        for point in &mut cells.points {
            *point = plus(*point, [-h, -k]);
        }
        Some(cells)
    }

    /// All points on or inside a closed line whose sides run along the lattice; `None` if a corner is not of the
    /// lattice or a side runs another way.
    pub fn polygon(corners: &[Point]) -> Option<Self> {
        let mut border = BTreeSet::new();
        for (from, to) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            let along = |way: &Point| {
                let steps = if way[0] == 0 { (to[1] - from[1]) / way[1] } else { (to[0] - from[0]) / way[0] };
                (steps > 0 && plus(*from, way.map(|x| x * steps)) == *to).then_some((*way, steps))
            };
            let (way, steps) = AROUND.iter().find_map(along)?;
            border.extend((0..steps).map(|s| plus(*from, way.map(|x| x * s))));
        }
        if !even(corners) {
            return None;
        }
        let ends = |k: usize| (border.iter().map(|p| p[k]).min(), border.iter().map(|p| p[k]).max());
        let ((Some(left), Some(right)), (Some(low), Some(high))) = (ends(0), ends(1)) else { return None };
        // What is outside can be reached from the rim of a frame round the line without crossing it: neighbours of neighbours
        // cannot slip through, as the line itself is made of neighbours.
        let inside = |&[h, k]: &Point| (left - 1..=right + 1).contains(&h) && (low - 2..=high + 2).contains(&k);
        let mut outside = BTreeSet::new();
        let rim = (left - 1..=right + 1).flat_map(|h| [low - 2, low - 1, high + 1, high + 2].map(|k| [h, k]));
        let mut front: Vec<_> = rim.filter(|[h, k]| (h + k) % 2 == 0).collect();
        while let Some(point) = front.pop() {
            if outside.insert(point) {
                let near = AROUND.map(|way| plus(point, way));
                front.extend(near.into_iter().filter(|p| inside(p) && !border.contains(p) && !outside.contains(p)));
            }
        }
        let all = (left..=right).flat_map(|h| (low..=high).map(move |k| [h, k]));
        let kept: Vec<Point> = all.filter(|p| (p[0] + p[1]) % 2 == 0 && !outside.contains(p)).collect();
        Self::new(&kept)
    }

    /// The points, column by column from below.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Turned about its origin by 60 degrees clockwise.
    #[must_use]
    pub fn turned(&self) -> Self {
        // [0, 2] becomes [1, 1], that becomes [1, -1].
        let mut points: Vec<Point> = self.points.iter().map(|&[h, k]| [i64::midpoint(h, k), (k - 3 * h) / 2]).collect();
        points.sort_unstable();
        Self { points }
    }

    /// Mean of the points, in spacings from the origin: x and z.
    pub fn centroid(&self) -> [f64; 2] {
        let n = self.points.len() as f64;
        let (h, k) = self.points.iter().fold((0, 0), |(h, k), p| (h + p[0], k + p[1]));
        [h as f64 * AREA / n, 0.5 * k as f64 / n]
    }

    /// The direction in which they lie longest, x and z; x where none is longer than others.
    pub fn long(&self) -> [f64; 2] {
        self.spread().long()
    }

    /// How the mass is spread.
    pub(crate) fn spread(&self) -> Spread {
        let centre = self.centroid();
        let mut second = [0.0; 3];
        for point in &self.points {
            let [x, z] = place(*point);
            let [x, z] = [x - centre[0], z - centre[1]];
            for (sum, part) in second.iter_mut().zip([x * x + OWN, x * z, z * z + OWN]) {
                *sum += part / self.points.len() as f64;
            }
        }
        Spread { centre, second }
    }

    /// Points beside which some are not the grain's.
    pub(crate) fn rim(&self) -> impl Iterator<Item = Point> {
        let own: BTreeSet<Point> = self.points.iter().copied().collect();
        self.points.iter().copied().filter(move |point| AROUND.iter().any(|way| !own.contains(&plus(*point, *way))))
    }

    /// Corners of its outline as a closed line, in half spacings from the origin.
    ///
    /// The line runs through the middles between the grain's points and those beside it that are not the grain's: straight
    /// along straight sides, half a row off them. Grains that touch have a stretch of line in common, and no two lines
    /// cross. The line round a hole hangs on the first by a way there and back.
    pub fn outline(&self) -> Vec<Point> {
        let own: BTreeSet<Point> = self.points.iter().copied().collect();
        // Points with a way out of the grain: the line crosses each of these once.
        let ways = own.iter().flat_map(|&point| (0..6).map(move |out| (point, out)));
        let mut ways: Vec<(Point, usize)> =
            ways.filter(|&(point, out)| !own.contains(&plus(point, AROUND[out]))).collect();
        let mut corners: Vec<Point> = Vec::new();
        while let Some(&first) = ways.first() {
            let (mut middles, mut at) = (Vec::new(), first);
            while let Some(here) = ways.iter().position(|way| *way == at) {
                ways.remove(here);
                let (point, out) = at;
                middles.push(plus(point.map(|x| 2 * x), AROUND[out]));
                // The next way out clockwise: from the same point, or from the one that stands there.
                let clockwise = (out + 1) % 6;
                let next = plus(point, AROUND[clockwise]);
                at = if own.contains(&next) { (next, (out + 5) % 6) } else { (point, clockwise) };
            }
            let count = middles.len();
            let side = |from: usize| {
                let (a, b) = (middles[from % count], middles[(from + 1) % count]);
                [b[0] - a[0], b[1] - a[1]]
            };
            let bends = |i: &usize| side(i + count - 1) != side(*i);
            let mut line: Vec<Point> = (0..count).filter(bends).map(|i| middles[i]).collect();
            if let Some(&hook) = corners.first() {
                line.extend(line.first().copied());
                corners.push(hook);
            }
            corners.append(&mut line);
        }
        corners
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The outline of a hexagon has six corners, each half a point farther out than its own; that of three points in a row
    /// six as well. Every point is inside, every neighbour outside, whatever the shape and however it is turned: a hole is. The area within is that of the cells
    /// less a quarter of one, for each corner of 60 degrees takes a 24th of a cell and each bay gives one back; a hole gives a quarter.
    #[test]
    fn outlines_part_a_grain_from_its_neighbours() {
        let ring = AROUND.to_vec();
        let hook = vec![[0, 0], [0, 2], [1, 3], [2, 2], [2, 0], [2, -2]];
        let (rod, triangle) = (vec![[0, 0], [0, 2], [0, 4]], vec![[0, 0], [0, 2], [1, 1]]);
        for (points, corners, holes) in [(rod, 6, 0.0), (triangle, 6, 0.0), (hook, 12, 0.0), (ring, 14, 1.0)] {
            let mut cells = Cells::new(&points).expect("a grain");
            for turn in 0..6 {
                let line = cells.outline();
                assert_eq!(line.len(), corners, "{points:?} turned {turn} times");
                let near = cells.points().iter().flat_map(|p| AROUND.map(|way| plus(*p, way)));
                for point in cells.points().iter().copied().chain(near) {
                    assert_eq!(holds(&line, point), cells.points().contains(&point), "{point:?} of {points:?}");
                }
                let doubled: i64 = (0..line.len())
                    .map(|i| (line[i], line[(i + 1) % line.len()]))
                    .map(|(a, b)| a[0] * b[1] - a[1] * b[0])
                    .sum();
                // Of [h, k] in half spacings 8 are a cell.
                let area = doubled.abs() as f64 / 2.0 / 8.0;
                assert!((area - (points.len() as f64 - 0.25 * (1.0 - holes))).abs() < 1e-12, "{area} of {points:?}");
                cells = cells.turned();
            }
        }
        for radius in 0..4 {
            let mut line = Cells::hexagon(radius).outline();
            let mut far: Vec<Point> = AROUND.map(|way| way.map(|x| x * (2 * radius as i64 + 1))).to_vec();
            line.sort_unstable();
            far.sort_unstable();
            assert_eq!(line, far);
        }
    }

    /// Whether a point of the lattice is inside a closed line of half spacings: how often the line crosses the way right.
    fn holds(line: &[Point], point: Point) -> bool {
        let (x, z) = (2.0 * point[0] as f64, 2.0 * point[1] as f64 + 0.1);
        let sides =
            line.iter().zip(line.iter().cycle().skip(1)).map(|(a, b)| [a[0], a[1], b[0], b[1]].map(|c| c as f64));
        let right = |[h, k, i, l]: &[f64; 4]| (*k > z) != (*l > z) && h + (z - k) / (l - k) * (i - h) > x;
        sides.filter(right).count() % 2 == 1
    }

    #[test]
    fn what_is_no_grain_is_refused() {
        assert!(Cells::new(&[[0, 0], [0, 4]]).is_none(), "two pieces");
        assert!(Cells::new(&[[0, 0], [0, 1]]).is_none(), "between two points");
        assert!(Cells::new(&[[0, 0], [0, 0]]).is_none(), "twice");
        assert!(Cells::new(&[]).is_none(), "nothing");
        assert!(Cells::polygon(&[[0, 0], [2, 0], [0, 4]]).is_none(), "a side across the lattice");
    }

    /// A triangle of side 3 has 10 points: its row of four, three, two and one. A hexagon drawn by its corners is the hexagon.
    #[test]
    fn polygons_are_filled() {
        let triangle = Cells::polygon(&[[0, 0], [3, 3], [0, 6]]).expect("a grain");
        assert_eq!(triangle.points().len(), 10);
        let corners = AROUND.map(|way| way.map(|x| 2 * x));
        assert_eq!(Cells::polygon(&corners).expect("a grain"), Cells::hexagon(2));
    }

    /// The second moments of a cell are those of a hexagon by a sum over a fine grid within it; those of a row of n add the squares of
    /// the places, (n^2 - 1) / 12.
    #[test]
    fn mass_is_spread_over_cells() {
        let [mut count, mut squares] = [0.0; 2];
        for i in -500..=500_i32 {
            for j in -500..=500_i32 {
                let (x, z) = (f64::from(i) / 800.0, f64::from(j) / 800.0);
                let beyond = |way: &Point| {
                    let [h, k] = place(*way);
                    x * h + z * k > 0.5
                };
                if !AROUND.iter().any(beyond) {
                    count += 1.0;
                    squares += x * x;
                }
            }
        }
        let one = Cells::hexagon(0).spread();
        assert!((squares / count / one.second[0] - 1.0).abs() < 2e-3, "{} {}", squares / count, one.second[0]);
        let row = Cells::new(&[[0, 0], [0, 2], [0, 4], [0, 6]]).expect("a grain").spread();
        assert!((row.second[2] - OWN - 15.0 / 12.0).abs() < 1e-12 && (row.second[0] - OWN).abs() < 1e-12);
    }
}
