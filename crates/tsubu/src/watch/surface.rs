//! The surface of a bed, column by column.

use super::Inside;
use crate::view::View;
use tsubu_scene::plan::{self, Axis, Plan};

/// Columns across a horizontal axis of a region.
#[derive(Clone, Debug)]
pub(super) struct Surface {
    axis: Axis,
    /// Lower end of the region along the axis [m].
    pub low: f64,
    /// Its width along the axis [m].
    pub width: f64,
    bins: usize,
    region: Inside,
}

impl Surface {
    pub fn new(axis: Axis, bins: usize, region: &plan::Region, plan: &Plan) -> Self {
        let low = region.low[axis.index()];
        Self { axis, low, width: region.high[axis.index()] - low, bins, region: Inside::new(Some(region), plan) }
    }

    /// Middle of a column [m].
    fn middle(&self, k: usize) -> f64 {
        self.low + (k as f64 + 0.5) * self.width / self.bins as f64
    }

    /// Middle and height [m] of every column: the highest point of the grains that count and whose centres are in it, not a
    /// number where there are none.
    pub fn columns(&self, view: &View, counts: impl Fn(usize) -> bool) -> Vec<(f64, f64)> {
        let mut columns: Vec<(f64, f64)> = (0..self.bins).map(|k| (self.middle(k), f64::NAN)).collect();
        for i in (0..view.len()).filter(|&i| counts(i)) {
            let p = view.position(i);
            if self.region.holds(p) {
                let k = (p[self.axis.index()] - self.low) / self.width * self.bins as f64;
                let height = &mut columns[(k as usize).min(self.bins - 1)].1;
                *height = height.max(p.z + view.ends(i, Axis::Z.index())[1]);
            }
        }
        columns
    }
}
