//! The free surface.

use super::surface::Surface;
use super::{Sample, Sheet, Watch, mean};
use crate::about::About;
use crate::view::{View, Wants};
use tsubu_scene::plan::{Axis, Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.slope",
    formula: "\
Slope of the free surface. The region is cut into columns along a horizontal axis; the surface of a column is the highest
point of the grains whose centres are in it. Through the columns whose middles are in the middle share of the width,
lines are laid by least squares:
angle           atan(b) of z = a + b x: positive where the surface rises along the axis           [rad]
heap angle      -atan(b) of z = a + b |x - centre|: the mean slope of both flanks of a heap        [rad]
surface height  mean of the columns                                                                [m]
Grains that touch nothing are in flight and no surface, unless `touching` is off; frozen and driven ones count.",
    symbols: "",
    limits: "Grains of a falling stream that touch each other count; columns narrower than a grain have holes (left out); \
each column is taken at its highest grain, so a line lies up to a radius above the mean surface, which \
changes its height but not its slope. A line needs two columns.",
    reference: "least squares, by definition",
};

/// Heights of columns, and lines through them.
#[derive(Clone, Debug)]
pub(super) struct Slope {
    axis: Axis,
    share: f64,
    centre: f64,
    touching: bool,
    surface: Surface,
}

pub(super) fn open(asked: &watch::Slope, plan: &Plan) -> Slope {
    let watch::Slope { axis, bins, share, centre, touching, region } = asked;
    let surface = Surface::new(*axis, *bins, region, plan);
    Slope { axis: *axis, share: *share, centre: *centre, touching: *touching, surface }
}

impl Slope {
    /// Middle and height of every column; not a number where it is empty.
    fn columns(&self, view: &View) -> Vec<(f64, f64)> {
        if !self.touching {
            return self.surface.columns(view, |_| true);
        }
        let contacts = view.touching(true);
        self.surface.columns(view, |i| contacts[i] > 0 || !view.free(i))
    }
}

/// Slope of the line through points by least squares; not a number for fewer than two.
pub(crate) fn line(points: &[(f64, f64)]) -> f64 {
    let (x0, z0) = (mean(points.iter().map(|p| p.0)), mean(points.iter().map(|p| p.1)));
    let both: f64 = points.iter().map(|(x, z)| (x - x0) * (z - z0)).sum();
    let square: f64 = points.iter().map(|(x, _)| (x - x0) * (x - x0)).sum();
    both / square
}

impl Watch for Slope {
    fn about(&self) -> &'static About {
        &ABOUT
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
        let columns = self.columns(view);
        let half = 0.5 * self.share * self.surface.width * (1.0 + 1e-9);
        let middle = self.surface.low + 0.5 * self.surface.width;
        let seen: Vec<(f64, f64)> =
            columns.iter().copied().filter(|(x, z)| (x - middle).abs() <= half && z.is_finite()).collect();
        let flanks: Vec<(f64, f64)> = seen.iter().map(|(x, z)| ((x - self.centre).abs(), *z)).collect();
        let scalars = vec![line(&seen).atan(), (-line(&flanks)).atan(), mean(seen.iter().map(|p| p.1))];
        Sample { scalars, rows: columns.into_iter().map(|(x, z)| vec![x, z]).collect() }
    }
}
