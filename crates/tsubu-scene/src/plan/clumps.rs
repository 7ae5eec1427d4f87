//! Clumps: grains that are several spheres; and what they have in common with other bodies that are no spheres.

use super::polyhedron::{self, Polyhedron};
use super::{GrainShape, Superellipsoid, Vector, cells};
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
