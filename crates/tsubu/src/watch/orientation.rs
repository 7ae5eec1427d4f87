//! How bodies that are no spheres are turned.

use super::axial::{dyad, principal};
use super::{Axes, Inside, LETTERS, Sample, Sheet, Watch, axes, group_number};
use crate::about::About;
use crate::view::{Body, View, Wants};
use glam::DVec3;
use nalgebra::Matrix3;
use std::f64::consts::FRAC_PI_2;
use tsubu_scene::plan::{BodyAxis, Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.orientation",
    formula: "\
Of N bodies with an axis u, whose head and tail are alike, Q = sum (3 u u - 1) / 2N in space, sum (2 u u - 1) / N in the plane.
bodies             N                                                                                       [-]
order parameter    largest eigenvalue of Q: 1 where all lie along one direction, 0 where none is preferred [-]
director           its unit vector, the preferred direction, its last entry not negative                   [-]
alignment          entry of Q along `along`: 1 for bodies along it, -1/2 across it, -1 in the plane        [-]
The director of a run is the principal axis of sum n n over the directors n of its looks: n and -n are the same.
The table has for each angle to `along` how many times as many bodies lie there as if all directions were alike. A body counts where its
centre of mass is inside. `long` is the principal axis of the least moment of inertia, `short` that of the largest; in the plane `short` lies
across `long`.",
    symbols: "",
    limits: "\
Spheres do not count. N bodies at random have an order parameter of about 1 / sqrt(N), not of 0. Where moments are equal any axis may be taken: ask
for the long axis of rods and the short one of discs.",
    reference: "de Gennes and Prost 1993, section 2.1; Eppenga and Frenkel 1984",
};

/// Sums up axes.
#[derive(Clone, Debug)]
pub(super) struct Orientation {
    body_axis: BodyAxis,
    along: DVec3,
    bins: usize,
    group: Option<u32>,
    region: Inside,
    axes: Axes,
}

pub(super) fn open(asked: &watch::Orientation, plan: &Plan) -> Orientation {
    let watch::Orientation { body_axis, along, bins, group, region } = asked;
    Orientation {
        body_axis: *body_axis,
        along: DVec3::from_array(*along),
        bins: *bins,
        group: group.as_ref().map(|name| group_number(plan, name)),
        region: Inside::new(region.as_ref(), plan),
        axes: axes(plan),
    }
}

impl Orientation {
    fn plane(&self) -> bool {
        self.axes.len() == 2
    }

    fn axis(&self, body: &Body) -> DVec3 {
        match self.body_axis {
            BodyAxis::Long => body.long,
            BodyAxis::Short if self.plane() => DVec3::new(-body.long.z, 0.0, body.long.x),
            BodyAxis::Short => body.short,
        }
    }

    /// Share of all directions whose angle to a line is at most this [rad].
    fn share(&self, angle: f64) -> f64 {
        if self.plane() { angle / FRAC_PI_2 } else { 1.0 - angle.cos() }
    }
}

impl Watch for Orientation {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants { bodies: true, ..Wants::GRAINS }
    }

    fn scalars(&self) -> Vec<String> {
        let director = self.axes.iter().map(|&a| format!("director {} [-]", LETTERS[a]));
        let first = ["bodies [-]", "order parameter [-]"].map(String::from);
        first.into_iter().chain(director).chain(["alignment [-]".to_owned()]).collect()
    }

    fn axis(&self) -> Option<&'static str> {
        Some("director")
    }

    fn sheet(&self) -> Option<Sheet> {
        let (coordinates, values) = (vec!["angle [deg]".to_owned()], vec!["density over random [-]".to_owned()]);
        Some(Sheet { coordinates, values, steady: true })
    }

    fn take(&mut self, view: &View) -> Sample {
        let g = &view.grains;
        let of_the_group = |body: &&Body| self.group.is_none_or(|group| g.group[body.grain] == group);
        let inside = |body: &&Body| self.region.holds(view.put(body.centre));
        let lie: Vec<DVec3> =
            view.bodies.iter().filter(of_the_group).filter(inside).map(|body| self.axis(body)).collect();
        let number = lie.len() as f64;
        let dyads: Matrix3<f64> = lie.iter().copied().map(dyad).sum();
        let (times, less) = if self.plane() { (2.0, 1.0) } else { (1.5, 0.5) };
        // Without bodies not numbers.
        let alike = dyads / number;
        let mut scalars = vec![number];
        if lie.is_empty() {
            scalars.resize(self.scalars().len(), f64::NAN);
        } else {
            let (largest, director) = principal(alike);
            scalars.push(times * largest - less);
            scalars.extend(self.axes.iter().map(|&a| director[a]));
            let along = lie.iter().map(|u| u.dot(self.along).powi(2)).sum::<f64>() / number;
            scalars.push(times * along - less);
        }
        let width = FRAC_PI_2 / self.bins as f64;
        let mut counts = vec![0.0; self.bins];
        for u in &lie {
            // The angle by its tangent, which tells small ones too.
            let angle = u.cross(self.along).length().atan2(u.dot(self.along).abs());
            counts[((angle / width) as usize).min(self.bins - 1)] += 1.0;
        }
        let row = |(k, count): (usize, f64)| {
            let [low, high] = [k as f64, k as f64 + 1.0].map(|k| k * width);
            vec![(0.5 * (low + high)).to_degrees(), count / (number * (self.share(high) - self.share(low)))]
        };
        Sample { scalars, rows: counts.into_iter().enumerate().map(row).collect() }
    }
}
