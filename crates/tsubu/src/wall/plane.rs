//! Planes: what boxes and floors are made of for DEM.

use super::Carrier;
use crate::partner::Hosts;
use glam::DVec3;
use tsubu_scene::plan::{Shape, Wall};

/// An infinite plane with grains on the side of its normal.
#[derive(Clone, Debug)]
pub struct Plane {
    /// A point on it at displacement zero [m].
    pub point: DVec3,
    /// Unit normal towards the grains.
    pub normal: DVec3,
    /// Present displacement [m].
    pub displacement: DVec3,
    /// Present velocity [m/s].
    pub velocity: DVec3,
    /// Who carries it.
    pub carrier: Carrier,
    /// Index into the contact table.
    pub species: u32,
}

impl Plane {
    /// Distance of a point from the plane, positive on the grains' side [m].
    #[inline]
    pub fn distance(&self, p: DVec3) -> f64 {
        (p - self.point - self.displacement).dot(self.normal)
    }

    /// Moves to where the carrier is.
    pub fn follow(&mut self, time: f64, hosts: &Hosts) {
        (self.displacement, self.velocity) = self.carrier.place(time, hosts);
    }
}

/// The planes of a wall: points on them and normals towards the grains. In the plane a box has no front and back.
pub fn planes(wall: &Wall, dimension: u8) -> Vec<(DVec3, DVec3)> {
    match &wall.shape {
        Shape::Plane { point, normal } => vec![(DVec3::from_array(*point), DVec3::from_array(*normal))],
        Shape::Box { width, height, depth, floor_centre } => {
            let c = DVec3::from_array(*floor_centre);
            let half = DVec3::new(0.5 * width, 0.5 * depth, 0.0);
            let mut planes = vec![
                (c - DVec3::X * half.x, DVec3::X),
                (c + DVec3::X * half.x, DVec3::NEG_X),
                (c, DVec3::Z),
                (c + DVec3::Z * *height, DVec3::NEG_Z),
            ];
            if dimension == 3 {
                planes.push((c - DVec3::Y * half.y, DVec3::Y));
                planes.push((c + DVec3::Y * half.y, DVec3::NEG_Y));
            }
            planes
        }
        Shape::Cylinder { .. } | Shape::Cone { .. } | Shape::Sphere { .. } | Shape::Mesh { .. } => Vec::new(),
    }
}

/// Corners of the closed outline of a wall at displacement zero, for pictures; a plane is drawn 1 m long.
pub fn outline(wall: &Wall) -> Vec<DVec3> {
    match &wall.shape {
        Shape::Plane { point, normal } => {
            let along = DVec3::from_array(*normal).cross(DVec3::Y);
            [-0.5, 0.5].map(|s| DVec3::from_array(*point) + along * s).to_vec()
        }
        Shape::Box { width, height, floor_centre, .. } => {
            let c = DVec3::from_array(*floor_centre);
            let (x, z) = (DVec3::X * (0.5 * width), DVec3::Z * *height);
            vec![c - x, c + x, c + x + z, c - x + z]
        }
        Shape::Cylinder { .. } | Shape::Cone { .. } | Shape::Sphere { .. } | Shape::Mesh { .. } => Vec::new(),
    }
}
