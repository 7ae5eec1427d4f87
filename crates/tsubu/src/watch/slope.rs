//! The free surface.

use super::{Inside, Sample, Sheet, Watch, mean};
use crate::view::{View, Wants};
use tsubu_scene::plan::{Axis, Measure, Plan};

pub(super) const ABOUT: &str = "\
Slope of the free surface. The region is cut into columns along a horizontal axis; the surface of a column is the highest
point of the grains whose centres are in it. Through the columns whose middles are in the middle share of the width,
lines are laid by least squares:
angle           atan(b) of z = a + b x: positive where the surface rises along the axis           [rad]
heap angle      -atan(b) of z = a + b |x - centre|: the mean slope of both flanks of a heap        [rad]
surface height  mean of the columns                                                                [m]
Grains that touch nothing are in flight and no surface, unless `touching` is off; frozen and driven ones count.
Limits: grains of a falling stream that touch each other count; columns narrower than a grain have holes (left out); each
column is taken at its highest grain, so a line lies up
to a radius above the mean surface, which changes its height but not its slope. A line needs two columns.";

/// Heights of columns, and lines through them.
#[derive(Clone, Debug)]
pub(super) struct Slope {
    axis: Axis,
    low: f64,
    width: f64,
    bins: usize,
    share: f64,
    centre: f64,
    touching: bool,
    region: Inside,
}

impl Slope {
    pub fn new(measure: &Measure, plan: &Plan) -> Self {
        let Measure::Slope { axis, bins, share, centre, touching, region } = measure else {
            unreachable!("another kind of watch")
        };
        let (low, high) = (region.low[axis.index()], region.high[axis.index()]);
        Self {
            axis: *axis,
            low,
            width: high - low,
            bins: *bins,
            share: *share,
            centre: *centre,
            touching: *touching,
            region: Inside::new(Some(region), plan),
        }
    }

    /// Middle of a column.
    fn middle(&self, k: usize) -> f64 {
        self.low + (k as f64 + 0.5) * self.width / self.bins as f64
    }

    /// Height of every column; not a number where it is empty.
    fn heights(&self, view: &View) -> Vec<f64> {
        let contacts = if self.touching { view.touching(true) } else { vec![1; view.len()] };
        let mut heights = vec![f64::NAN; self.bins];
        for (i, z) in contacts.iter().enumerate() {
            let p = view.place(i);
            if (*z > 0 || !view.free(i)) && self.region.holds(p) {
                let k = (p[self.axis.index()] - self.low) / self.width * self.bins as f64;
                let height = &mut heights[(k as usize).min(self.bins - 1)];
                *height = height.max(p.z + view.grains.radius[i]);
            }
        }
        heights
    }
}

/// Slope of the line through points by least squares; not a number for fewer than two.
fn line(points: &[(f64, f64)]) -> f64 {
    let (x0, z0) = (mean(points.iter().map(|p| p.0)), mean(points.iter().map(|p| p.1)));
    let both: f64 = points.iter().map(|(x, z)| (x - x0) * (z - z0)).sum();
    let square: f64 = points.iter().map(|(x, _)| (x - x0) * (x - x0)).sum();
    both / square
}

impl Watch for Slope {
    fn about(&self) -> &'static str {
        ABOUT
    }

    fn wants(&self) -> Wants {
        if self.touching { Wants::CONTACTS } else { Wants::GRAINS }
    }

    fn scalars(&self) -> Vec<String> {
        ["angle [rad]", "heap angle [rad]", "surface height [m]"].map(String::from).to_vec()
    }

    fn sheet(&self) -> Option<Sheet> {
        let coordinates = vec![format!("{} [m]", self.axis.name())];
        Some(Sheet { coordinates, values: vec!["surface height [m]".to_owned()], steady: true })
    }

    fn take(&mut self, view: &View) -> Sample {
        let heights = self.heights(view);
        let half = 0.5 * self.share * self.width * (1.0 + 1e-9);
        let middle = self.low + 0.5 * self.width;
        let columns = heights.iter().enumerate().map(|(k, z)| (self.middle(k), *z));
        let seen: Vec<(f64, f64)> =
            columns.clone().filter(|(x, z)| (x - middle).abs() <= half && z.is_finite()).collect();
        let flanks: Vec<(f64, f64)> = seen.iter().map(|(x, z)| ((x - self.centre).abs(), *z)).collect();
        let scalars = vec![line(&seen).atan(), (-line(&flanks)).atan(), mean(seen.iter().map(|p| p.1))];
        Sample { scalars, rows: columns.map(|(x, z)| vec![x, z]).collect() }
    }
}
