//! Stress and strain of the grains in a box of planes.

use super::{Axes, LETTERS, Sample, Volumes, Watch, axes, mean};
use crate::about::About;
use crate::view::{View, Wants};
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;
use tsubu_scene::plan::{Plan, box_of_planes, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.stress-path",
    formula: "\
The grains press on two planes at the ends of every axis, L apart; compression is positive.
stress x, y, z      s = mean force on the two planes over the area between the others   [Pa]; in the plane [N/m]
mean stress         p = mean of the stresses                                            [Pa]; in the plane [N/m]
deviator stress     q = axial stress less the mean of the others                        [Pa]; in the plane [N/m]
friction angle      arcsin((s axial - s others) / (s axial + s others))                 [deg]
axial strain        ln(L0 / L) of the axis                                              [-]
volume strain       the sum of that over the axes                                       [-]
porosity            1 - volume of the grains, by shape, over that of the box            [-]
L0 is L at the first look that finds a grain at each plane: in a stage, at its begin.",
    symbols: "",
    limits: "Not a number until each plane is touched. A sample is no deeper than its planes: where they rub, or grains lie in \
layers along them, that is in it.",
    reference: "by definition; signs and strains as in soil mechanics",
};

/// Looks at the planes.
#[derive(Clone, Debug)]
pub(super) struct StressPath {
    /// Numbers of the walls at the low and the high end of every axis.
    planes: Vec<(usize, [usize; 2])>,
    axial: usize,
    axes: Axes,
    volumes: Volumes,
    /// Distances at the first look [m]; not a number before.
    first: [f64; 3],
}

pub(super) fn open(asked: &watch::StressPath, plan: &Plan) -> StressPath {
    StressPath {
        planes: box_of_planes(&plan.walls, plan.dimension == 3).unwrap_or_default(),
        axial: asked.axis.index(),
        axes: axes(plan),
        volumes: Volumes::new(plan, plan.dimension == 2),
        first: [f64::NAN; 3],
    }
}

impl StressPath {
    /// Where a plane stands along its axis [m], and the force on it against its normal [N].
    fn load(view: &View, wall: usize, axis: usize) -> (f64, f64) {
        let (mut place, mut force) = (f64::NAN, 0.0);
        for c in view.contacts.iter().filter(|c| c.wall && c.second == wall) {
            // Of a body the contact is half of the overlap beyond the plane.
            let shaped = view.shapes.is_some_and(|shapes| shapes.ends(c.first, axis).is_some());
            let ball = view.grains.radius[c.first] - c.overlap;
            let to_plane = c.normal * if shaped { c.branch.dot(c.normal) - 0.5 * c.overlap } else { ball };
            (place, force) = ((view.grains.position[c.first] + to_plane)[axis], force - c.force.dot(c.normal));
        }
        (place, force)
    }

    /// Volume of all grains [m^3]; in the plane their area [m^2].
    fn solid(&self, view: &View) -> f64 {
        (0..view.len()).map(|i| self.volumes.of(view, i)).sum()
    }
}

impl Watch for StressPath {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants::CONTACTS
    }

    fn scalars(&self) -> Vec<String> {
        let unit = if self.axes.len() == 3 { "Pa" } else { "N/m" };
        let stresses = self.axes.iter().map(|&a| format!("stress {} [{unit}]", LETTERS[a]));
        let others = [format!("mean stress [{unit}]"), format!("deviator stress [{unit}]")];
        let strains = ["friction angle [deg]", "axial strain [-]", "volume strain [-]", "porosity [-]"];
        stresses.chain(others).chain(strains.map(str::to_owned)).collect()
    }

    fn take(&mut self, view: &View) -> Sample {
        let (mut size, mut force) = ([1.0; 3], [0.0; 3]);
        for (axis, ends) in &self.planes {
            let [(low, on_low), (high, on_high)] = ends.map(|wall| Self::load(view, wall, *axis));
            (size[*axis], force[*axis]) = (high - low, 0.5 * (on_low + on_high));
        }
        let volume: f64 = size.iter().product();
        if !volume.is_finite() {
            return Sample { scalars: vec![f64::NAN; self.scalars().len()], rows: Vec::new() };
        }
        if self.first[self.axial].is_nan() {
            self.first = size;
        }
        let stress = |axis: usize| force[axis] * size[axis] / volume;
        let strain = |axis: usize| (self.first[axis] / size[axis]).ln();
        let axial = stress(self.axial);
        let lateral = mean(self.axes.iter().filter(|&&a| a != self.axial).map(|&a| stress(a)));
        let mut scalars: Vec<f64> = self.axes.iter().map(|&a| stress(a)).collect();
        scalars.push(mean(self.axes.iter().map(|&a| stress(a))));
        scalars.push(axial - lateral);
        scalars.push(((axial - lateral) / (axial + lateral)).asin().to_degrees());
        scalars.push(strain(self.axial));
        scalars.push(self.axes.iter().map(|&a| strain(a)).sum());
        scalars.push(1.0 - self.solid(view) / volume);
        Sample { scalars, rows: Vec::new() }
    }

    fn save(&self, name: &str, state: &mut State) {
        state.put_real(&format!("{name}.first"), self.first.to_vec());
    }

    fn load(&mut self, name: &str, state: &State) -> Result<(), MissingSection> {
        let section = format!("{name}.first");
        let first = state.real(&section)?.try_into();
        self.first = first.map_err(|_| MissingSection { name: section, kind: "real" })?;
        Ok(())
    }
}
