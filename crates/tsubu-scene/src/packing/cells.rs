//! The inside of a closed mesh as small cubes: which of them spheres cover yet.

use super::Ball;
use crate::complaint::Complaint;
use nalgebra::Vector3;

/// Cells that the inside of a body is cut into, about.
const INSIDE: f64 = 5e4;
/// The most cells of the box about it: a thin body that lies askew in it has wider ones.
const MOST: f64 = 1e7;
/// Pieces of a line shorter than this over the size of the body are rounding.
const SHORT: f64 = 1e-6;

/// Cubes in rows along z, each with its middle inside the body and in no sphere yet, or not.
pub(super) struct Cells {
    /// Middle of the first.
    first: Vector3<f64>,
    width: f64,
    count: [usize; 3],
    open: Vec<bool>,
}

impl Cells {
    /// Cuts up what the triangles enclose. On a line through it, the surface must be met inwards and outwards in turn: where it goes round
    /// some place twice, or the other way, it crosses itself.
    pub fn fill(triangles: &[[Vector3<f64>; 3]], volume: f64) -> Result<Self, Complaint> {
        let low = triangles.iter().flatten().copied().reduce(|a, b| a.inf(&b)).unwrap_or_default();
        let high = triangles.iter().flatten().copied().reduce(|a, b| a.sup(&b)).unwrap_or_default();
        let extent = high - low;
        let width = (volume / INSIDE).max(extent.product() / MOST).cbrt();
        let count = [0, 1, 2].map(|k| ((extent[k] / width).ceil() as usize).max(1));
        // In the middle of the box.
        let first = (low + high - Vector3::from(count.map(|n| (n - 1) as f64 * width))) * 0.5;
        let mut cells = Self { first, width, count, open: vec![false; count.iter().product()] };
        let mut lines: Vec<Vec<(f64, i32)>> = vec![Vec::new(); count[0] * count[1]];
        for triangle in triangles {
            cells.meet(triangle, &mut lines);
        }
        let short = SHORT * extent.norm();
        for (line, hits) in lines.iter_mut().enumerate() {
            hits.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut round = 0;
            for pair in hits.windows(2) {
                round += pair[0].1;
                if pair[1].0 - pair[0].0 <= short {
                    continue;
                }
                if !(0..=1).contains(&round) {
                    let at = cells.middle([line / count[1], line % count[1], 0]);
                    return Err(crossing([at.x, at.y, 0.5 * (pair[0].0 + pair[1].0)]));
                }
                if round == 1 {
                    let [from, to] = [pair[0].0, pair[1].0].map(|z| (z - cells.first.z) / width);
                    for k in from.ceil().max(0.0) as usize..(to.floor() + 1.0).clamp(0.0, count[2] as f64) as usize {
                        cells.open[line * count[2] + k] = true;
                    }
                }
            }
        }
        Ok(cells)
    }

    fn middle(&self, index: [usize; 3]) -> Vector3<f64> {
        self.first + Vector3::from(index.map(|n| n as f64 * self.width))
    }

    /// The lines along z that a triangle is met by: where, and whether inwards or outwards.
    fn meet(&self, triangle: &[Vector3<f64>; 3], lines: &mut [Vec<(f64, i32)>]) {
        let ends = [0, 1, 2].map(|axis| {
            let all = triangle.map(|corner| corner[axis]);
            [all[0].min(all[1]).min(all[2]), all[0].max(all[1]).max(all[2])]
        });
        let range = |axis: usize| {
            let [from, to] = ends[axis].map(|x| (x - self.first[axis]) / self.width);
            (from.floor().max(0.0) as usize)..=(to.ceil().clamp(0.0, (self.count[axis] - 1) as f64) as usize)
        };
        for i in range(0) {
            for j in range(1) {
                let place = self.middle([i, j, 0]);
                let [a, b, c] = triangle;
                let sides = [[b, c], [c, a], [a, b]].map(|[from, to]| side(*from, *to, place));
                let up = sides.iter().all(|(left, _)| *left);
                if !up && sides.iter().any(|(left, _)| *left) {
                    continue;
                }
                let whole: f64 = sides.iter().map(|(_, area)| area).sum();
                let z = (sides[0].1 * a.z + sides[1].1 * b.z + sides[2].1 * c.z) / whole;
                // A normal that points up is met on the way out.
                let z = if z.is_finite() { z.clamp(ends[2][0], ends[2][1]) } else { ends[2][0] };
                lines[i * self.count[1] + j].push((z, if up { -1 } else { 1 }));
            }
        }
    }

    pub fn width(&self) -> f64 {
        self.width
    }

    /// Number of open cells whose middle is in a sphere.
    pub fn covers(&self, ball: &Ball) -> usize {
        self.rows(ball).map(|row| self.open[row].iter().filter(|open| **open).count()).sum()
    }

    /// Closes them.
    pub fn cover(&mut self, ball: &Ball) {
        let rows: Vec<_> = self.rows(ball).collect();
        for row in rows {
            self.open[row].fill(false);
        }
    }

    /// The cells in a sphere, row by row.
    fn rows(&self, (centre, radius): &Ball) -> impl Iterator<Item = std::ops::Range<usize>> {
        let (radius, from) = (*radius / self.width, (centre - self.first) / self.width);
        let [nx, ny, nz] = self.count;
        let range = move |at: f64, half: f64, count: usize| {
            ((at - half).ceil().max(0.0) as usize)..((at + half).floor() + 1.0).clamp(0.0, count as f64) as usize
        };
        range(from.x, radius, nx).flat_map(move |i| {
            let left = radius * radius - (i as f64 - from.x).powi(2);
            range(from.y, left.max(0.0).sqrt(), ny).map(move |j| {
                let half = (left - (j as f64 - from.y).powi(2)).max(0.0).sqrt();
                let row = range(from.z, half, nz);
                let begin = (i * ny + j) * nz;
                begin + row.start..begin + row.end.max(row.start)
            })
        })
    }
}

fn crossing(at: [f64; 3]) -> Complaint {
    let [x, y, z] = at.map(|x| format!("{x:.3e}").parse::<f64>().unwrap_or(x));
    Complaint::new(format!("the mesh crosses itself near ({x}, {y}, {z})"))
        .hint("a clump needs a surface that encloses each place once: unite overlapping bodies in the mesh file")
}

/// Whether a place is to the left of an edge seen from above, and twice the area that they span. Of triangles that share an edge just one has a
/// place on it: a place counts as a little farther along x and, by much less, along y.
fn side(from: Vector3<f64>, to: Vector3<f64>, place: Vector3<f64>) -> (bool, f64) {
    let area = (from.x - place.x) * (to.y - place.y) - (from.y - place.y) * (to.x - place.x);
    let left = if area != 0.0 {
        area > 0.0
    } else if from.y != to.y {
        from.y > to.y
    } else {
        to.x > from.x
    };
    (left, area)
}
