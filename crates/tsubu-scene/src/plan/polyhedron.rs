//! Rounded polyhedra, and polygons in the plane.

use super::{Clump, ClumpOrientation, Vector};
use crate::clump::Solid;
use crate::polyhedron::{Core, Plane, core, faces, measured};
use nalgebra::Vector3;

/// A rounded polyhedron of diameter 1: all points nearer to its core than its rounding radius. In the plane a polygon with y = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyhedron {
    /// Corners of the core.
    pub corners: Vec<Vector>,
    /// Faces of the core; of a polygon its sides.
    pub faces: Vec<PolyhedronFace>,
    /// Edges of the core by the numbers of their corners; a polygon has none.
    pub edges: Vec<[usize; 2]>,
    /// Rounding radius.
    pub rounding: f64,
}

/// A face of the core of a polyhedron.
#[derive(Clone, Debug, PartialEq)]
pub struct PolyhedronFace {
    /// Unit normal outwards.
    pub normal: Vector,
    /// Distance from the centre of mass.
    pub offset: f64,
    /// Numbers of its corners, counter-clockwise from outside.
    pub corners: Vec<usize>,
}

/// The planes of a convex body and its rounding radius, in any unit.
fn body(planes: &[Plane], rounding: f64, space: bool, orientation: ClumpOrientation) -> Option<Clump> {
    let core = core(planes, rounding, space)?;
    let mut solid = measured(&core, rounding, space).solid();
    if !space {
        solid = in_plane(&core, rounding);
    }
    Some(with_mass(core, rounding, &solid, space, orientation))
}

/// A rounded core whose mass is spread as in a solid.
pub(super) fn with_mass(core: Core, rounding: f64, solid: &Solid, space: bool, orientation: ClumpOrientation) -> Clump {
    let core = core.about(&Vector3::from(solid.centre));
    let reach = rounding + core.corners.iter().map(Vector3::norm).fold(0.0, f64::max);
    let unit = 0.5 / reach;
    let axes = solid.axes.map(Vector3::from);
    let own = |v: &Vector3<f64>| axes.map(|axis| axis.dot(v));
    let face = |face: &crate::polyhedron::Face| PolyhedronFace {
        normal: own(&face.plane.normal),
        offset: unit * face.plane.offset,
        corners: face.corners.clone(),
    };
    let polyhedron = Polyhedron {
        corners: core.corners.iter().map(|corner| own(corner).map(|x| unit * x)).collect(),
        faces: core.faces.iter().map(face).collect(),
        edges: core.edges().into_iter().map(|(corners, _)| corners).collect(),
        rounding: unit * rounding,
    };
    Clump {
        pieces: vec![([0.0; 3], 0.5)],
        volume: solid.volume * unit.powi(if space { 3 } else { 2 }),
        moments: solid.moments.map(|moment| moment * unit * unit),
        axes: solid.axes,
        orientation,
        superellipsoid: None,
        polyhedron: Some(polyhedron),
    }
}

/// A polygon turns about y alone: its axes are those of the plane.
fn in_plane(core: &Core, rounding: f64) -> Solid {
    let sum = measured(core, rounding, false);
    let centre = sum.first / sum.volume;
    let spread = sum.second / sum.volume - centre * centre.transpose();
    let (x, z) = (spread[(0, 0)], spread[(2, 2)]);
    Solid {
        volume: sum.volume,
        centre: centre.into(),
        moments: [z, x + z, x],
        axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    }
}

/// Of corners that are right; `None` where they are not, which is complained about elsewhere.
pub(super) fn of_corners(
    corners: &[Vector],
    rounding: f64,
    space: bool,
    orientation: ClumpOrientation,
) -> Option<Clump> {
    let corners: Vec<Vector3<f64>> = corners.iter().map(|corner| Vector3::from(*corner)).collect();
    body(&faces(&corners, space).ok()?, rounding, space, orientation)
}

/// Of the planes of a mesh.
pub(super) fn of_faces(faces: &[(Vector, f64)], rounding: f64, orientation: ClumpOrientation) -> Option<Clump> {
    let plane = |(normal, offset): &(Vector, f64)| Plane { normal: Vector3::from(*normal), offset: *offset };
    body(&faces.iter().map(plane).collect::<Vec<_>>(), rounding, true, orientation)
}

impl Polyhedron {
    /// Surface of one in space: of its faces, its edges, which are parts of cylinders, and its corners, which are a sphere together (Steiner 1840).
    pub(super) fn surface(&self) -> f64 {
        let corner = |k: &usize| Vector3::from(self.corners[*k]);
        let normal = |face: &PolyhedronFace| Vector3::from(face.normal);
        let area = |face: &PolyhedronFace| {
            let next = face.corners.iter().cycle().skip(1);
            let twice: Vector3<f64> = face.corners.iter().zip(next).map(|(a, b)| corner(a).cross(&corner(b))).sum();
            0.5 * twice.dot(&normal(face))
        };
        let turned = |edge: &[usize; 2]| {
            let mut beside = self.faces.iter().filter(|face| edge.iter().all(|end| face.corners.contains(end)));
            let angle = beside.next().zip(beside.next()).map_or(0.0, |(a, b)| normal(a).angle(&normal(b)));
            angle * (corner(&edge[1]) - corner(&edge[0])).norm()
        };
        let r = self.rounding;
        self.faces.iter().map(area).sum::<f64>()
            + r * self.edges.iter().map(turned).sum::<f64>()
            + 4.0 * std::f64::consts::PI * r * r
    }

    /// Diameter of what it fills however it is turned.
    pub(super) fn sure(&self) -> f64 {
        2.0 * (self.rounding + self.faces.iter().map(|face| face.offset).fold(0.5, f64::min))
    }
}
