//! Polyhedra and polygons at walls.
//!
//! Corners of the core touch as spheres of the rounding radius do, whatever the wall is. Where the wall has sharp edges or bulges towards the body, its edges touch those of the body or the curved
//! surface, and its corners the core, as those of another polyhedron would.

use super::{CORE, EDGES, PLACES, WallShape, WallShapes};
use crate::polyhedron::Turned;
use crate::polyhedron::at_wall::{AtWall, Bulge};
use crate::wall::frustum::Frustum;
use crate::wall::mesh::Mesh;
use crate::wall::{Surface, Wall};
use glam::DVec3;

/// An edge of a mesh, and a corner, bent by less are those of a plane [rad].
const BENT: f64 = 1e-3;
/// What comes from a hollow: the cosine of the angle to the middle of its sharp side from which on an edge or corner of a mesh does not touch. Both sides of an edge are much farther from that.
const HOLLOW: f64 = -0.5;

impl WallShapes {
    /// Looks where it touches.
    pub(super) fn faceted_body(
        &mut self,
        body: &Turned,
        wall: &Wall,
        centre: DVec3,
        holds: f64,
        elements: &[u32],
        reach: f64,
    ) {
        let radius = body.rounding;
        if let Surface::HalfSpaces { .. } = wall.surface {
            wall.touching(elements, centre, holds + reach, &mut self.touching);
            for touch in &self.touching {
                let normal = -touch.nearest.normal;
                for (corner, shift) in body.corners() {
                    let overlap = normal.dot(shift) + radius - touch.nearest.distance;
                    if overlap > -reach {
                        let patch = wall.key(touch.element) + (corner as u32 + 1) * PLACES;
                        self.found.push(WallShape { overlap, shift, patch, ..WallShape::sphere(wall, touch, radius) });
                    }
                }
            }
            return;
        }
        for (corner, shift) in body.corners() {
            wall.touching(elements, centre + shift, radius + reach, &mut self.touching);
            for touch in &self.touching {
                let sphere = WallShape::sphere(wall, touch, radius);
                self.found.push(WallShape { shift, patch: sphere.patch + (corner as u32 + 1) * PLACES, ..sphere });
            }
        }
        match &wall.surface {
            Surface::HalfSpaces { .. } => {}
            Surface::Mesh(mesh) => self.at_mesh(body, wall, mesh, centre, elements, reach),
            Surface::Shell(shell) => {
                let apart = wall.pose.to_world(shell.centre) - centre;
                if apart.length() > shell.radius {
                    self.at_globe(body, apart, shell.radius, reach);
                }
            }
            Surface::Frustum(frustum) => self.at_frustum(body, wall, frustum, centre, reach),
        }
    }

    /// The core at a globe, or in the plane at a disc.
    fn at_globe(&mut self, body: &Turned, apart: DVec3, radius: f64, reach: f64) {
        // All of the globe is one contact with the core, so corners are none.
        self.found.clear();
        if let Some((shift, overlap, normal)) = body.at_point(apart, radius + reach) {
            self.found.push(WallShape {
                overlap: overlap + radius,
                shift,
                patch: CORE * PLACES,
                ..WallShape::of_edge(body.rounding, normal)
            });
        }
    }

    fn at_frustum(&mut self, body: &Turned, wall: &Wall, frustum: &Frustum, centre: DVec3, reach: f64) {
        let from = centre - wall.pose.to_world(frustum.point);
        let axis = wall.pose.direction(frustum.axis);
        let ([cos, sin], level) = frustum.slope();
        let across = from - axis * axis.dot(from);
        if cos * across.length() - sin * axis.dot(from) < level {
            return;
        }
        if wall.in_plane && axis.y.abs() > 0.5 {
            self.at_globe(body, -across, frustum.radius[0], reach);
            return;
        }
        let bulge = Bulge { axis, from, slope: [cos, sin], level };
        body.at_bulge(&bulge, reach, |contact| self.found.push(WallShape::edge(body, &contact, 0)));
    }

    fn at_mesh(&mut self, body: &Turned, wall: &Wall, mesh: &Mesh, centre: DVec3, elements: &[u32], reach: f64) {
        let Self { found, ridges, tips, .. } = self;
        mesh.ridges().of(elements, ridges, tips);
        for number in &*ridges {
            let ridge = &mesh.ridges().ridges[*number as usize];
            if ridge.arc[1] - ridge.arc[0] < BENT {
                continue;
            }
            let [a, b] = ridge.ends.map(|end| wall.pose.to_world(end) - centre);
            let outward = wall.pose.direction(ridge.outward());
            if wall.in_plane {
                // Sections are endless along y: such an edge is a corner of the section.
                if (b - a).y.abs() > 0.0 && (b - a).with_y(0.0) == DVec3::ZERO {
                    corner(body, a.with_y(0.0), outward, *number, reach, found);
                }
                continue;
            }
            body.at_ridge([a, b], reach, |contact| {
                if -contact.normal.dot(outward) > HOLLOW {
                    found.push(WallShape::edge(body, &contact, *number));
                }
            });
        }
        for number in tips.iter().filter(|_| !wall.in_plane) {
            let tip = &mesh.ridges().tips[*number as usize];
            if tip.sharp > BENT {
                let (point, outward) = (wall.pose.to_world(tip.point) - centre, wall.pose.direction(tip.outward));
                corner(body, point, outward, *number, reach, found);
            }
        }
    }
}

/// A corner of a mesh at the core.
fn corner(body: &Turned, point: DVec3, outward: DVec3, number: u32, reach: f64, found: &mut Vec<WallShape>) {
    if let Some((shift, overlap, normal)) = body.at_point(point, reach)
        && -normal.dot(outward) > HOLLOW
    {
        let patch = CORE * PLACES + number % PLACES;
        found.push(WallShape { overlap, shift, patch, ..WallShape::of_edge(body.rounding, normal) });
    }
}

impl WallShape {
    fn of_edge(radius: f64, normal: DVec3) -> Self {
        let none = DVec3::ZERO;
        Self { overlap: 0.0, normal, radius, shift: none, patch: 0, share: 1.0, rounding: [none; 2] }
    }

    /// An edge of the body at an edge of the wall with a number, or at its curved surface.
    fn edge(body: &Turned, contact: &AtWall, number: u32) -> Self {
        Self {
            overlap: contact.overlap,
            shift: contact.point,
            patch: (EDGES + contact.edge as u32) * PLACES + number % PLACES,
            share: contact.share,
            ..Self::of_edge(body.rounding, contact.normal)
        }
    }
}
