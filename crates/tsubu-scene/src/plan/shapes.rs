//! The body of every shape of grains, and what shapes that are no spheres have in common.

use super::body::{Clump, ClumpOrientation, scaled};
use super::polyhedron::{self, Polyhedron};
use super::{GrainShape, Superellipsoid, Vector, cells};
use crate::clump::{Solid, surface};

/// Spheres within a closed mesh, and the mesh that they stand for, in the unit of its file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Packing {
    /// Centres and radii, in the order in which they were chosen.
    pub spheres: Vec<(Vector, f64)>,
    /// What the mesh encloses.
    pub solid: Solid,
    /// Surface of the mesh.
    pub surface: f64,
    /// Farthest corner of the mesh from its centre of mass: half of the diameter.
    pub reach: f64,
    /// Number of triangles.
    pub triangles: usize,
    /// How far the mesh lies outside the spheres, over the diameter: on average over its surface, and at most.
    pub gap: [f64; 2],
}

/// What the union of the spheres of a packing has more than the mesh, over what the mesh has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PackingError {
    /// Of the volume.
    pub volume: f64,
    /// Of the principal moments of inertia at the same density, smallest first.
    pub inertia: Vector,
    /// Of the surface.
    pub surface: f64,
}

impl Packing {
    /// How well the spheres stand for the mesh; volume and inertia to about 1e-5, the surface to 5e-3.
    pub fn error(&self) -> Option<PackingError> {
        let union = Solid::of(&self.spheres)?;
        let inertia = |solid: &Solid, k: usize| solid.volume * solid.moments[k];
        Some(PackingError {
            volume: union.volume / self.solid.volume - 1.0,
            inertia: [0, 1, 2].map(|k| inertia(&union, k) / inertia(&self.solid, k) - 1.0),
            surface: surface(&self.spheres) / self.surface - 1.0,
        })
    }
}

impl GrainShape {
    /// Of a body that is no sphere, the name of its choice in a scene.
    pub fn clump_key(&self) -> Option<&'static str> {
        match self {
            Self::Sphere {} | Self::Disc { .. } => None,
            Self::Clump { .. } => Some("clump"),
            Self::ClumpFile { .. } => Some("clump-file"),
            Self::ClumpMesh { .. } => Some("clump-mesh"),
            Self::Superellipsoid { .. } => Some("superellipsoid"),
            Self::Polyhedron { .. } => Some("polyhedron"),
            Self::PolyhedronMesh { .. } => Some("polyhedron-mesh"),
            Self::Polygon { .. } => Some("polygon"),
            Self::Cells { .. } => Some("cells"),
        }
    }

    /// What bodies that are no spheres are called.
    pub fn plural(&self) -> &'static str {
        match self {
            Self::Superellipsoid { .. } => "superellipsoids",
            Self::Polyhedron { .. } | Self::PolyhedronMesh { .. } => "polyhedra",
            Self::Polygon { .. } => "polygons",
            Self::Cells { .. } => "grains of cells",
            _ => "clumps",
        }
    }

    /// Whether it is a disc, a polygon or cells, whose mass goes with the square of the diameter.
    pub fn is_flat(&self) -> bool {
        matches!(self, Self::Disc { .. } | Self::Polygon { .. } | Self::Cells { .. })
    }

    /// The same shape, every grain of it turned as drawn.
    #[must_use]
    pub fn as_drawn(mut self) -> Self {
        match &mut self {
            Self::Sphere {} | Self::Disc { .. } => {}
            Self::Clump { orientation, .. }
            | Self::ClumpFile { orientation, .. }
            | Self::ClumpMesh { orientation, .. }
            | Self::Superellipsoid { orientation, .. }
            | Self::Polyhedron { orientation, .. }
            | Self::PolyhedronMesh { orientation, .. }
            | Self::Polygon { orientation, .. }
            | Self::Cells { orientation, .. } => *orientation = ClumpOrientation::AsDrawn,
        }
        self
    }

    /// The nominal diameter (Wadell 1932) of a grain of that diameter: of the sphere of its volume; of a polygon that of the disc of its area.
    pub fn nominal_diameter(&self, diameter: f64) -> f64 {
        self.clump().map_or(diameter, |body| 2.0 * body.equivalent_radius(self.is_flat()) * diameter)
    }

    /// Whether it is a polyhedron or a polygon, or cells that become one.
    pub fn is_polyhedron(&self) -> bool {
        if let Self::Cells { outline, .. } = self {
            return outline.cells().is_some_and(|cells| cells::planes(&cells).is_some());
        }
        matches!(self, Self::Polyhedron { .. } | Self::PolyhedronMesh { .. } | Self::Polygon { .. })
    }

    /// Grains that one body is in frames and watches: the spheres of a clump have a number each.
    pub fn spheres(&self) -> usize {
        match self {
            Self::Clump { centre, .. } => centre.len(),
            Self::ClumpFile { spheres, .. } => spheres.len(),
            Self::ClumpMesh { packing, .. } => packing.spheres.len(),
            _ => 1,
        }
        .max(1)
    }

    /// Whether it is a body that is no sphere: [`GrainShape::clump`] without the work of its mass.
    pub fn is_clump(&self) -> bool {
        match self {
            Self::Sphere {} | Self::Disc { .. } => false,
            Self::Clump { centre, .. } => centre.len() > 1,
            Self::ClumpFile { spheres, .. } => spheres.len() > 1,
            // Even one sphere has the mass and inertia of the mesh.
            Self::ClumpMesh { packing, .. } => !packing.spheres.is_empty(),
            Self::PolyhedronMesh { faces, .. } => !faces.is_empty(),
            Self::Superellipsoid { .. } | Self::Polyhedron { .. } | Self::Polygon { .. } | Self::Cells { .. } => true,
        }
    }

    /// Diameter of what a grain of that diameter fills however it is turned: of a superellipsoid twice its shortest semi-axis. How deep it begins in
    /// something the engine says.
    pub fn sure(&self, diameter: f64) -> f64 {
        if !matches!(self, Self::Superellipsoid { .. }) && !self.is_polyhedron() {
            return diameter;
        }
        let shortest = |axes: &Vector| 2.0 * axes.iter().copied().fold(0.5, f64::min);
        let share = self.clump().and_then(|body| match (&body.superellipsoid, &body.polyhedron) {
            (Some(body), _) => Some(shortest(&body.semi_axes)),
            (_, body) => body.as_ref().map(Polyhedron::sure),
        });
        diameter * share.unwrap_or(1.0)
    }

    /// The packing in place of a mesh.
    pub fn packing(&self) -> Option<&Packing> {
        if let Self::ClumpMesh { packing, .. } = self { Some(packing) } else { None }
    }

    /// The clump, if it is one of several spheres (of one sphere it is a sphere), or the superellipsoid.
    pub fn clump(&self) -> Option<Clump> {
        if !self.is_clump() {
            return None;
        }
        match self {
            Self::Sphere {} | Self::Disc { .. } => None,
            Self::Clump { centre, diameter, orientation } => {
                let spheres: Vec<_> = centre.iter().zip(diameter).map(|(c, d)| (*c, 0.5 * d)).collect();
                let whole = centre.len() == diameter.len();
                if whole { Some(scaled(&spheres, &Solid::of(&spheres)?, 0.0, *orientation)) } else { None }
            }
            Self::ClumpFile { spheres, orientation, .. } => {
                Some(scaled(spheres, &Solid::of(spheres)?, 0.0, *orientation))
            }
            Self::ClumpMesh { packing, orientation, .. } => {
                Some(scaled(&packing.spheres, &packing.solid, packing.reach, *orientation))
            }
            Self::Superellipsoid { semi_axes, exponents, orientation } => {
                let exponents = <[f64; 2]>::try_from(&exponents[..]).ok()?;
                Some(Superellipsoid::new(*semi_axes, exponents).body(*orientation))
            }
            Self::Polyhedron { corners, rounding, orientation } => {
                polyhedron::of_corners(corners, *rounding, true, *orientation)
            }
            Self::Polygon { corners, rounding, orientation, .. } => {
                polyhedron::of_corners(corners, *rounding, false, *orientation)
            }
            Self::Cells { outline, rounding, orientation, .. } => {
                cells::body(&outline.cells()?, *rounding, *orientation)
            }
            Self::PolyhedronMesh { faces, rounding, orientation, .. } => {
                polyhedron::of_faces(faces, *rounding, *orientation)
            }
        }
    }
}
