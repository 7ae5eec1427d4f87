//! The geometry of a wall in the frame it was drawn in: the elements of every shape behind one door.

use super::frustum::Frustum;
use super::half_space::HalfSpace;
use super::mesh::Mesh;
use super::nearest::Nearest;
use super::shell::SphericalShell;
use super::{Pose, half_space};
use glam::DVec3;
use tsubu_scene::plan::Shape;

/// What a wall is made of. Elements are counted from 0.
#[derive(Clone, Debug)]
pub enum Surface {
    /// Half-spaces, one element each.
    HalfSpaces {
        /// The half-spaces.
        planes: Vec<HalfSpace>,
        /// How far from the centre of rotation grains between them can be [m]; infinite for a lone plane.
        radius: f64,
    },
    /// A cylinder or a cone: its near and its far side.
    Frustum(Frustum),
    /// A spherical shell, one element.
    Shell(SphericalShell),
    /// Triangles, one element each.
    Mesh(Mesh),
}

impl Surface {
    /// From the plan; `centre` is the wall's centre of rotation [m].
    pub(super) fn new(shape: &Shape, dimension: u8, centre: DVec3) -> Self {
        let vector = DVec3::from_array;
        match shape {
            Shape::Plane { .. } | Shape::Box { .. } => {
                let planes = half_space::planes(shape, dimension);
                Self::HalfSpaces { planes, radius: box_radius(shape, dimension, centre) }
            }
            Shape::Cylinder { point, axis, radius, length } => {
                let axis = vector(*axis);
                // In the plane a drum has no ends.
                let length = length.filter(|_| dimension == 3 || axis.cross(DVec3::Y).length() > 1e-9);
                Self::Frustum(Frustum { point: vector(*point), axis, radius: [*radius; 2], length })
            }
            Shape::Cone { point, axis, radius, end_radius, length } => Self::Frustum(Frustum {
                point: vector(*point),
                axis: vector(*axis),
                radius: [*radius, *end_radius],
                length: Some(*length),
            }),
            Shape::Sphere { centre, radius } => {
                Self::Shell(SphericalShell { centre: vector(*centre), radius: *radius })
            }
            Shape::Mesh { triangles, .. } => {
                let corners: Vec<_> = triangles.iter().map(|t| t.map(vector)).collect();
                Self::Mesh(if dimension == 2 { Mesh::in_plane(&corners, centre) } else { Mesh::new(&corners, centre) })
            }
        }
    }

    /// Number of elements.
    pub fn elements(&self) -> usize {
        match self {
            Self::HalfSpaces { planes, .. } => planes.len(),
            Self::Frustum(_) => Frustum::ELEMENTS,
            Self::Shell(_) => 1,
            Self::Mesh(mesh) => mesh.triangles().len(),
        }
    }

    /// Nearest point of an element; all in the own frame.
    #[inline]
    pub fn nearest(&self, element: u32, centre: DVec3) -> Nearest {
        match self {
            Self::HalfSpaces { planes, .. } => planes[element as usize].nearest(centre),
            Self::Frustum(frustum) => frustum.nearest(element, centre),
            Self::Shell(shell) => shell.nearest(centre),
            Self::Mesh(mesh) => mesh.nearest(element, centre),
        }
    }

    /// Puts the elements within `reach` of a point into `out`, ascending.
    pub(super) fn near(&self, centre: DVec3, reach: f64, out: &mut Vec<u32>) {
        out.clear();
        match self {
            Self::Mesh(mesh) => mesh.near(centre, reach, out),
            // Both sides of a frustum go together: what hides the far one may change before the next search.
            Self::Frustum(frustum) if frustum.nearest(0, centre).distance < reach => out.extend([0, 1]),
            Self::Frustum(_) => {}
            _ => out.extend((0..self.elements() as u32).filter(|&e| self.nearest(e, centre).distance < reach)),
        }
    }

    /// How far any point of the surface may have moved between two poses [m]; planes only along their normals.
    pub(super) fn travel(&self, pose: &Pose, reference: &Pose, extent: f64) -> f64 {
        match self {
            Self::HalfSpaces { planes, radius } => {
                planes.iter().map(|p| p.travel(pose, reference, extent.min(*radius))).fold(0.0, f64::max)
            }
            Self::Frustum(frustum) => frustum.travel(pose, reference, extent),
            Self::Shell(shell) => shell.travel(pose, reference),
            Self::Mesh(mesh) => mesh.travel(pose, reference),
        }
    }
}

/// Distance of the farthest corner of a box from a point [m]; endless for other shapes.
fn box_radius(shape: &Shape, dimension: u8, centre: DVec3) -> f64 {
    let Shape::Box { width, height, depth, floor_centre } = shape else { return f64::INFINITY };
    let middle = DVec3::from_array(*floor_centre) + DVec3::Z * (0.5 * height);
    let half = DVec3::new(0.5 * width, if dimension == 3 { 0.5 * depth } else { 0.0 }, 0.5 * height);
    ((middle - centre).abs() + half).length()
}
