//! The body of grains that are no spheres: the spheres of a clump, or one convex body, at a diameter of 1.

use super::polyhedron::Polyhedron;
use super::{Superellipsoid, Vector};
use crate::clump::{Solid, area_of_discs, surface};
use serde::{Deserialize, Serialize};

/// How the grains of a group that are no spheres are turned at first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ClumpOrientation {
    /// Any orientation as likely as another.
    Random,
    /// As the centres, or semi-axes along x, y and z, say.
    AsDrawn,
}

/// The spheres of a clump of diameter 1, or the one that holds a superellipsoid or polyhedron, and how its mass is spread.
#[derive(Clone, Debug, PartialEq)]
pub struct Clump {
    /// Centres from the centre of mass, along the principal axes, and radii.
    pub pieces: Vec<(Vector, f64)>,
    /// Volume; what overlaps counts once. Of a polygon its area.
    pub volume: f64,
    /// Principal moments of inertia over the mass; of a clump the smallest first.
    pub moments: Vector,
    /// Directions of the principal axes as drawn.
    pub axes: [Vector; 3],
    /// How each grain is turned at first.
    pub orientation: ClumpOrientation,
    /// What is in the place of its one sphere.
    pub superellipsoid: Option<Superellipsoid>,
    /// The same.
    pub polyhedron: Option<Polyhedron>,
}

impl Clump {
    /// Radius of the sphere of its volume; where it is `flat`, of the disc of its area.
    pub fn equivalent_radius(&self, flat: bool) -> f64 {
        let pi = std::f64::consts::PI;
        if flat { (self.volume / pi).sqrt() } else { (0.75 / pi * self.volume).cbrt() }
    }

    /// Of spheres in the plane the area of their discs there, what overlaps counts once; of a superellipsoid that of its cut.
    pub fn area(&self) -> f64 {
        if let Some(body) = &self.superellipsoid {
            return body.area();
        }
        let drawn = |arm: &Vector, along: usize| (0..3).map(|k| arm[k] * self.axes[k][along]).sum::<f64>();
        let discs: Vec<_> = self.pieces.iter().map(|(arm, r)| ([drawn(arm, 0), drawn(arm, 2)], *r)).collect();
        area_of_discs(&discs)
    }

    /// How far it reaches along x, y and z from end to end, as drawn.
    pub fn extent(&self) -> Vector {
        let points: Vec<(Vector, f64)> = match (&self.superellipsoid, &self.polyhedron) {
            // Its axes are those of the drawing.
            (Some(body), _) => return body.semi_axes.map(|axis| 2.0 * axis),
            (_, Some(body)) => body.corners.iter().map(|corner| (*corner, body.rounding)).collect(),
            _ => self.pieces.clone(),
        };
        [0, 1, 2].map(|along| {
            let drawn = |arm: &Vector| (0..3).map(|k| arm[k] * self.axes[k][along]).sum::<f64>();
            let ends = points.iter().map(|(arm, r)| [drawn(arm) - r, drawn(arm) + r]);
            let [low, high] =
                ends.fold([f64::INFINITY, f64::NEG_INFINITY], |all, end| [all[0].min(end[0]), all[1].max(end[1])]);
            high - low
        })
    }

    /// Whether it is one convex body, no spheres.
    pub fn is_one_piece(&self) -> bool {
        self.superellipsoid.is_some() || self.polyhedron.is_some()
    }

    /// Surface of the sphere of its volume over its own; of a body in space.
    pub fn sphericity(&self) -> f64 {
        let surface = match (&self.superellipsoid, &self.polyhedron) {
            (Some(body), _) => body.surface(),
            (_, Some(body)) => body.surface(),
            _ => surface(&self.pieces),
        };
        std::f64::consts::PI.cbrt() * (6.0 * self.volume).powf(2.0 / 3.0) / surface
    }

    /// Radius of the smallest sphere, and of the largest.
    pub fn radii(&self) -> [f64; 2] {
        let radii = || self.pieces.iter().map(|(_, radius)| *radius);
        [radii().fold(f64::INFINITY, f64::min), radii().fold(0.0, f64::max)]
    }

    /// Radii that a contact can have, the smallest and the largest that matter: of spheres theirs, of a superellipsoid that of its flattest place,
    /// where a contact is stiffest, of a polyhedron its rounding radius.
    pub fn contact_radii(&self) -> [f64; 2] {
        match (&self.superellipsoid, &self.polyhedron) {
            (Some(body), _) => [body.flattest(); 2],
            (_, Some(body)) => [body.rounding; 2],
            _ => self.radii(),
        }
    }

    /// The mass over the smallest that it shows to an impact anywhere: 1 + (r x n) . I^-1 (r x n) m, of the worst arm r and normal n.
    pub fn lightness(&self) -> f64 {
        if let Some(body) = &self.superellipsoid {
            return body.lightness();
        }
        if let Some(body) = &self.polyhedron {
            return 1.0 + body.corners.iter().map(|corner| self.worst(corner)).fold(0.0, f64::max);
        }
        1.0 + self.pieces.iter().map(|(arm, _)| self.worst(arm)).fold(0.0, f64::max)
    }

    /// (r x n) . I^-1 (r x n) m of the worst normal n on an arm r.
    fn worst(&self, arm: &Vector) -> f64 {
        // Of I^-1 across the arm the larger of two eigenvalues, from its trace and that of its square.
        let squared: f64 = arm.iter().map(|x| x * x).sum();
        if squared == 0.0 {
            return 0.0;
        }
        let across = |i: usize, j: usize| f64::from(u8::from(i == j)) - arm[i] * arm[j] / squared;
        let entry = |i: usize, j: usize| (0..3).map(|k| across(i, k) * across(k, j) / self.moments[k]).sum::<f64>();
        let trace: f64 = (0..3).map(|i| entry(i, i)).sum();
        let square: f64 = (0..9).map(|k| entry(k / 3, k % 3).powi(2)).sum();
        squared * 0.5 * (trace + (2.0 * square - trace * trace).max(0.0).sqrt())
    }
}

/// To a diameter of 1, of what reaches as far from its centre of mass as its spheres do, and at least that far.
pub(super) fn scaled(spheres: &[(Vector, f64)], solid: &Solid, reach: f64, orientation: ClumpOrientation) -> Clump {
    let arm = |c: &Vector| [0, 1, 2].map(|k| c[k] - solid.centre[k]);
    let dot = |a: &Vector, b: &Vector| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
    let reach = spheres.iter().map(|(c, r)| dot(&arm(c), &arm(c)).sqrt() + r).fold(reach, f64::max);
    let unit = 0.5 / reach;
    Clump {
        pieces: spheres.iter().map(|(c, r)| (solid.axes.map(|axis| unit * dot(&axis, &arm(c))), unit * r)).collect(),
        volume: solid.volume * unit.powi(3),
        moments: solid.moments.map(|moment| moment * unit * unit),
        axes: solid.axes,
        orientation,
        superellipsoid: None,
        polyhedron: None,
    }
}
