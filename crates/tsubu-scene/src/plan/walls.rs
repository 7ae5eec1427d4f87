//! Walls, and who moves them.

use super::{Signal, Vector};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A wall, still, moved, or carried by a host.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Wall {
    /// Name of the material.
    pub material: String,
    /// Its shape.
    pub shape: Shape,
    /// The host that carries it.
    pub host: Option<String>,
    /// The interface of the host that it hangs on; `None`: it moves along the host's direction.
    pub interface: Option<String>,
    /// Prescribed motion; not together with `host`, `servo` or `body`.
    pub motion: Option<Motion>,
    /// Prescribed turning, alone or together with `motion`.
    pub rotation: Option<Rotation>,
    /// A wall that a constant force pushes against the grains.
    pub servo: Option<Servo>,
    /// A free rigid body under gravity and the grains' forces.
    pub body: Option<Body>,
    /// When it vanishes [s]: a gate; not together with `host`, `servo` or `body`.
    pub until: Option<f64>,
}

/// Turning about a fixed axis: right-handed angle against time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Rotation {
    /// A point on the axis [m].
    pub centre: Vector,
    /// Unit direction of the axis.
    pub axis: Vector,
    /// Angle [rad] against time.
    pub signal: Signal,
}

/// A wall of mass M on a guide: M s'' = F - c s' + F_grains along the direction, s its displacement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Servo {
    /// Unit direction of the force and of the guide.
    pub direction: Vector,
    /// Constant force F [N]: given, or `pressure` times `area`; not with `pressure`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub force: Option<f64>,
    /// Constant pressure on the face of a box of planes that the wall is, as large as it is at the time [Pa].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pressure: Option<f64>,
    /// Moving mass M [kg].
    pub mass: f64,
    /// Damping c [N.s/m].
    pub damping: f64,
}

/// A free rigid body: six degrees of freedom.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Body {
    /// Mass [kg].
    pub mass: f64,
    /// Principal moments of inertia about the scene's axes at time 0 [kg.m^2].
    pub inertia: Vector,
    /// Centre of mass at time 0 [m].
    pub centre: Vector,
    /// Velocity of the centre at time 0 [m/s].
    pub velocity: Vector,
    /// Spin at time 0 [rad/s].
    pub spin: Vector,
}

/// Geometry of a wall.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Shape {
    /// A closed box, grains inside. In the plane the front and back panes are frictionless and ignored.
    Box {
        /// Inner size along x [m].
        width: f64,
        /// Inner size along z [m].
        height: f64,
        /// Inner size along y [m].
        depth: f64,
        /// Centre of the floor [m].
        floor_centre: Vector,
    },
    /// An infinite plane.
    Plane {
        /// A point on it [m].
        point: Vector,
        /// Unit normal, towards the grains.
        normal: Vector,
    },
    /// The curved surface of a cylinder, open at the ends; grains may touch it from inside and outside.
    Cylinder {
        /// Centre of one end [m].
        point: Vector,
        /// Unit direction of the axis, from that end into the cylinder.
        axis: Vector,
        /// Radius [m].
        radius: f64,
        /// Length [m]; `None`: endless both ways.
        length: Option<f64>,
    },
    /// The curved surface of a cone or of a piece of one, open at the ends, touched from both sides.
    Cone {
        /// Centre of one end [m].
        point: Vector,
        /// Unit direction of the axis, from that end to the other.
        axis: Vector,
        /// Radius at that end [m]; may be 0.
        radius: f64,
        /// Radius at the other end [m]; may be 0.
        end_radius: f64,
        /// Length along the axis [m].
        length: f64,
    },
    /// A spherical shell, touched from both sides.
    Sphere {
        /// Centre [m].
        centre: Vector,
        /// Radius [m].
        radius: f64,
    },
    /// Triangles from an STL or OBJ file, touched from both sides.
    Mesh {
        /// Name of the file's copy in the run folder (see `Scene::companions`).
        path: String,
        /// What tells one file from another: CRC-32 of its bytes, in hex.
        fingerprint: String,
        /// Factor on the file's coordinates [-], for files in millimetres 0.001.
        scale: f64,
        /// Displacement after scaling [m].
        shift: Vector,
        /// The corners of each triangle [m], scaled and shifted.
        #[serde(skip)]
        triangles: std::sync::Arc<Vec<[Vector; 3]>>,
    },
}

/// Motion of a wall along a fixed direction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Motion {
    /// Unit direction.
    pub direction: Vector,
    /// Displacement [m] against time.
    pub signal: Signal,
}

/// The box that planes at right angles to the axes make: for every axis that the scene has, the numbers of the walls at its low and its
/// high end, in the order of the names. `None` where an axis has not just these two.
pub fn box_of_planes(walls: &BTreeMap<String, Wall>, space: bool) -> Option<Vec<(usize, [usize; 2])>> {
    let axes: &[usize] = if space { &[0, 1, 2] } else { &[0, 2] };
    let facing = |axis: usize, sign: f64| {
        let mut found = walls
            .values()
            .enumerate()
            .filter(|(_, wall)| matches!(wall.shape, Shape::Plane { normal, .. } if normal[axis] * sign > 1.0 - 1e-9));
        found.next().filter(|_| found.next().is_none()).map(|(number, _)| number)
    };
    axes.iter().map(|&axis| Some((axis, [facing(axis, 1.0)?, facing(axis, -1.0)?]))).collect()
}
