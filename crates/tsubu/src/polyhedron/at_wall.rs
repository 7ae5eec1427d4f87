//! Where a body touches surfaces with sharp edges, and surfaces that bulge towards it. What of a wall is flat or hollow is touched by corners, as spheres of the rounding radius.

use super::Turned;
use super::contact::Contact;
use super::crossing::{CROWN, Crossing, Edge};
use glam::DVec3;

/// Rounds of a search along an edge.
const ROUNDS: usize = 60;

/// A contact with a wall.
#[derive(Clone, Copy, Debug)]
pub struct AtWall {
    /// Number of the edge of the body.
    pub edge: usize,
    /// The point of the core, from the centre of the body [m].
    pub point: DVec3,
    /// Overlap, below 0 where there is a gap [m].
    pub overlap: f64,
    /// Unit normal from the body to the wall.
    pub normal: DVec3,
    /// How much the overlap grows as the points come nearer, see [`Contact`].
    pub share: f64,
}

/// A surface that bulges: a point, from its first end and from its axis, is `cos` x - `sin` s - `level` above it [m].
#[derive(Clone, Copy, Debug)]
pub struct Bulge {
    /// Unit direction of the axis.
    pub axis: DVec3,
    /// From its first end to the centre of the body [m].
    pub from: DVec3,
    /// Cosine and sine of the angle by which it widens along the axis.
    pub slope: [f64; 2],
    /// Distance of the surface from the origin [m].
    pub level: f64,
}

impl Turned<'_> {
    /// Its edges with their numbers.
    fn edges(&self) -> impl Iterator<Item = (usize, Edge)> {
        (0..self.shape.edges.len()).map(|number| (number, self.edge(number)))
    }

    /// Tells where edges of the body cross a sharp edge with these ends, from the centre of the body [m], nearer than `reach` [m] to its rounded edge.
    pub fn at_ridge(&self, [a, b]: [DVec3; 2], reach: f64, mut found: impl FnMut(AtWall)) {
        let (radius, cut) = (self.rounding, self.rounding + reach);
        let beside = |face: usize| self.above(face, a).min(self.above(face, b)) >= cut;
        if (0..self.faces()).any(beside) {
            return;
        }
        let ridge = Edge::between([a, b]);
        for (edge, own) in self.edges() {
            let crossing = Crossing::of(&own, &ridge, radius);
            if crossing.squared < cut * cut {
                let Contact { points: [point, _], overlap, normal, share, .. } =
                    crossing.contact(0, DVec3::ZERO, radius);
                found(AtWall { edge, point, overlap, normal, share });
            }
        }
    }

    /// Where the core is nearest to a point from its centre, if the rounded body is nearer than `reach` [m]: the point of the core, the overlap, and the unit normal to the point.
    pub fn at_point(&self, point: DVec3, reach: f64) -> Option<(DVec3, f64, DVec3)> {
        let (distance, away) = self.distance(point, self.rounding + reach).ok()?;
        Some((point - away * distance, self.rounding - distance, away))
    }

    /// Tells where edges of the body, crowned as where two cross, are nearer than `reach` [m] to a surface that bulges towards it. The height of an edge above the surface is convex.
    pub fn at_bulge(&self, bulge: &Bulge, reach: f64, mut found: impl FnMut(AtWall)) {
        let [cos, sin] = bulge.slope;
        let radius = self.rounding;
        let back = 4.0 * CROWN * radius;
        let across = |v: DVec3| v - bulge.axis * bulge.axis.dot(v);
        for (number, edge) in self.edges() {
            let middle = bulge.from + edge.middle;
            let (start, way) = (across(middle), across(edge.way));
            let height = |t: f64| {
                let at = start + way * t;
                let x = at.length();
                let s = bulge.axis.dot(middle + edge.way * t);
                (cos * x - sin * s - bulge.level + back * t * t, at / (x + f64::MIN_POSITIVE))
            };
            // No slope is steeper than 1.
            if height(0.0).0 > radius + reach + 0.5 * edge.squared.sqrt() {
                continue;
            }
            let slope = |t: f64| cos * height(t).1.dot(way) - sin * bulge.axis.dot(edge.way) + 2.0 * back * t;
            let [mut low, mut high] = [-0.5, 0.5];
            for _ in 0..ROUNDS {
                let middle = 0.5 * (low + high);
                if slope(middle) > 0.0 {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            let t = 0.5 * (low + high);
            let (height, radial) = height(t);
            if height < radius + reach {
                found(AtWall {
                    edge: number,
                    point: edge.middle + edge.way * t,
                    overlap: radius - height,
                    normal: bulge.axis * sin - radial * cos,
                    share: 1.0,
                });
            }
        }
    }
}
