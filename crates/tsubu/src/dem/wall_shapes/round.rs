//! Superellipsoids at walls.
//!
//! A mesh is touched where its nearest place, along a normal of the body, is on a face, a sharp edge or a sharp corner with a normal that belongs to it. As a body rolls over an edge the contact
//! wanders from face to edge and on without a jump, and a seam of a plane is nothing.

use super::{WallShape, WallShapes};
use crate::superellipsoid::Outline;
use crate::superellipsoid::at_wall::{AtWall, Ring};
use crate::wall::frustum::Frustum;
use crate::wall::mesh::Mesh;
use crate::wall::{Surface, Wall};
use glam::DVec3;

/// Cosine of 15 degrees: planes of a mesh that meet in a flatter hollow are one bent surface, of which the deepest place counts; see `wall/distinct.rs`.
const ONE_SURFACE: f64 = 0.965_925_826_289_068_3;
/// Over the size of a body: places that are nearer are one.
const SAME: f64 = 1e-6;

/// A place where a body touches a wall.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    contact: AtWall,
    patch: u32,
    face: bool,
    /// Its number among those that were found.
    number: usize,
}

impl WallShapes {
    /// Looks where it touches.
    pub(super) fn round_body(
        &mut self,
        outline: &Outline,
        wall: &Wall,
        centre: DVec3,
        holds: f64,
        elements: &[u32],
        reach: f64,
    ) {
        self.places.clear();
        match &wall.surface {
            Surface::Mesh(mesh) => {
                self.places_at_mesh(outline, wall, mesh, centre, elements, reach);
                self.judge(wall, holds);
            }
            Surface::Frustum(frustum) => {
                let mut found = Vec::new();
                around(outline, wall, frustum, centre, reach, &mut found);
                self.places.extend(found.into_iter().map(|contact| Place { contact, patch: 0, face: true, number: 0 }));
            }
            // No shell comes here: where there are superellipsoids it is a mesh, see `bodies/rims.rs`.
            Surface::HalfSpaces { .. } | Surface::Shell(_) => {
                wall.touching(elements, centre, holds + reach, &mut self.touching);
                for touch in &self.touching {
                    let contact = outline.at_plane(-touch.nearest.normal, touch.nearest.distance);
                    if contact.overlap > -reach {
                        self.places.push(Place { contact, patch: wall.key(touch.element), face: true, number: 0 });
                    }
                }
            }
        }
        self.found.extend(self.places.iter().map(|place| {
            let AtWall { normal, overlap, point, radius, force, torque } = place.contact;
            let (shift, patch) = (point - normal * radius, place.patch);
            WallShape { overlap, normal, radius, shift, patch, share: 1.0, rounding: [force, torque] }
        }));
    }

    fn places_at_mesh(
        &mut self,
        outline: &Outline,
        wall: &Wall,
        mesh: &Mesh,
        centre: DVec3,
        elements: &[u32],
        reach: f64,
    ) {
        let Self { places, ridges, tips, .. } = self;
        let (pose, own) = (&wall.pose, wall.pose.to_own(centre));
        let mut push = |contact: AtWall, patch: u32, face: bool| {
            // A place beyond the body is none of it, however far the body reaches over the plane of a face elsewhere.
            if contact.overlap > -reach && (contact.overlap <= 0.0 || outline.holds(contact.foot())) {
                places.push(Place { contact, patch, face, number: places.len() });
            }
        };
        for t in elements {
            let triangle = &mesh.triangles()[*t as usize];
            let height = triangle.normal.dot(own - triangle.corners[0]);
            let side = -1.0_f64.copysign(height);
            let contact = outline.at_plane(pose.direction(triangle.normal * side), height.abs());
            let on_it = || triangle.holds(own + pose.own_direction(contact.foot()), mesh.tolerance());
            if contact.overlap > -reach && on_it() {
                push(contact, wall.key(*t), true);
            }
        }
        mesh.ridges().of(elements, ridges, tips);
        for number in &*ridges {
            let ridge = &mesh.ridges().ridges[*number as usize];
            let [a, b] = ridge.ends.map(|end| pose.to_world(end) - centre);
            let axis = (b - a).normalize_or_zero();
            // From the body to the edge: normals are against the directions of the arc.
            let ring = Ring { across: ridge.across.map(|across| -pose.direction(across)), axis, lean: [1.0, 0.0] };
            if let Some(contact) = outline.at_edge(a, &ring, ridge.arc) {
                let along = axis.dot(contact.foot() - a);
                let tolerance = mesh.tolerance();
                if along >= -tolerance && along <= axis.dot(b - a) + tolerance {
                    push(contact, ridge.patch, false);
                }
            }
        }
        for number in &*tips {
            let tip = &mesh.ridges().tips[*number as usize];
            if let Some(contact) = outline.at_point(pose.to_world(tip.point) - centre, reach) {
                let way = pose.own_direction(-contact.normal);
                if tip.around.iter().all(|around| around.dot(way) <= 1e-9) {
                    push(contact, tip.patch, false);
                }
            }
        }
    }

    /// Of places on one plane, on one bent surface, and at one spot the deepest is left. Faces stay before edges and corners, so that histories find their contacts.
    fn judge(&mut self, wall: &Wall, size: f64) {
        let places = &mut self.places;
        places.sort_by(|a, b| b.contact.overlap.total_cmp(&a.contact.overlap));
        let mut kept = 0;
        for k in 0..places.len() {
            let this = places[k];
            let same = |other: &Place| {
                let (a, b) = (&this.contact, &other.contact);
                let one_spot = a.normal.distance(b.normal) < 10.0 * SAME && a.foot().distance(b.foot()) < SAME * size;
                let bent = || a.normal.dot(b.normal) > ONE_SURFACE;
                let side_by_side = || this.patch == other.patch || wall.adjacent(this.patch, other.patch);
                one_spot || this.face && other.face && side_by_side() && bent()
            };
            if !places[..kept].iter().any(same) {
                places[kept] = this;
                kept += 1;
            }
        }
        places.truncate(kept);
        places.sort_by_key(|place| place.number);
    }
}

/// In or on a cylinder or a cone.
fn around(outline: &Outline, wall: &Wall, frustum: &Frustum, centre: DVec3, reach: f64, found: &mut Vec<AtWall>) {
    let from = centre - wall.pose.to_world(frustum.point);
    let axis = wall.pose.direction(frustum.axis);
    let ([cos, sin], level) = frustum.slope();
    let out = from - axis * axis.dot(from);
    let hollow = cos * out.length() - sin * axis.dot(from) < level;
    let u = out.try_normalize().unwrap_or_else(|| wall.pose.direction(frustum.across_axis()));
    let sign = if hollow { 1.0 } else { -1.0 };
    let ring = Ring { across: [u, axis.cross(u)], axis, lean: [cos * sign, -sin * sign] };
    outline.around(from, &ring, (level * sign, hollow), reach, found);
}
