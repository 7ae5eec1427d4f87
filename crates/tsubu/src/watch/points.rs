//! The points at which fields are given, and which of them something near reaches.

use crate::neighbours::grid::PeriodicBounds;
use glam::DVec3;
use tsubu_scene::plan::{Axis, Region};

/// Points along some axes, at the middles of equal cells of a region.
#[derive(Clone, Debug)]
pub(super) struct Points {
    axes: Vec<usize>,
    low: DVec3,
    step: DVec3,
    count: [usize; 3],
}

impl Points {
    pub fn new(axes: &[Axis], count: &[usize], region: &Region) -> Self {
        let mut points = Self { axes: Vec::new(), low: DVec3::ZERO, step: DVec3::ZERO, count: [1; 3] };
        for (axis, n) in axes.iter().zip(count) {
            let a = axis.index();
            points.axes.push(a);
            points.count[a] = *n;
            points.step[a] = (region.high[a] - region.low[a]) / *n as f64;
            points.low[a] = region.low[a] + 0.5 * points.step[a];
        }
        points
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.count.iter().product()
    }

    /// Where a point is; zero along axes that fields do not vary along.
    pub fn position(&self, k: usize) -> DVec3 {
        let [nx, ny, _] = self.count;
        let index = DVec3::new((k % nx) as f64, (k / nx % ny) as f64, (k / (nx * ny)) as f64);
        self.low + index * self.step
    }

    /// Only the entries along the axes that fields vary along.
    pub fn project(&self, v: DVec3) -> DVec3 {
        let mut p = DVec3::ZERO;
        for &a in &self.axes {
            p[a] = v[a];
        }
        p
    }

    /// Calls `visit(point, x)` for every point within `reach` [m] (along each axis) of the stretch from `p` to `p + b`,
    /// with the vector `x` from `p`, or from an image of it across periodic ends, to the point.
    pub fn near(&self, p: DVec3, b: DVec3, reach: f64, ends: &PeriodicBounds, mut visit: impl FnMut(usize, DVec3)) {
        let ranges: [Vec<(usize, f64)>; 3] = std::array::from_fn(|a| self.along(a, p[a], b[a], reach, ends[a]));
        let [nx, ny, _] = self.count;
        for &(k, z) in &ranges[2] {
            for &(j, y) in &ranges[1] {
                for &(i, x) in &ranges[0] {
                    visit((k * ny + j) * nx + i, DVec3::new(x, y, z));
                }
            }
        }
    }

    /// Indices along an axis with their distance from `p`; several images where the world repeats.
    fn along(&self, a: usize, p: f64, b: f64, reach: f64, end: Option<[f64; 2]>) -> Vec<(usize, f64)> {
        if !self.axes.contains(&a) {
            return vec![(0, 0.0)];
        }
        let (first, last) = (p + b.min(0.0) - reach, p + b.max(0.0) + reach);
        let (low, step, n) = (self.low[a], self.step[a], self.count[a]);
        let high = low + (n - 1) as f64 * step;
        let mut found = Vec::new();
        let mut image = |shift: f64| {
            let from = ((first + shift - low) / step).ceil().max(0.0) as usize;
            let to = ((last + shift - low) / step).floor();
            if to >= 0.0 {
                found.extend((from..=(to as usize).min(n - 1)).map(|k| (k, low + k as f64 * step - p - shift)));
            }
        };
        match end {
            None => image(0.0),
            Some([from, to]) => {
                let period = to - from;
                let images = ((low - last) / period).ceil() as i64..=((high - first) / period).floor() as i64;
                images.for_each(|times| image(times as f64 * period));
            }
        }
        found
    }
}
