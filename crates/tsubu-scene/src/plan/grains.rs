//! Groups of grains, and where they come and go.

use super::{ClumpOrientation, GrainPoints, Packing, Region, Signal, Vector};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A group of grains of one material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Particles {
    /// Name of the material.
    pub material: String,
    /// Number of grains; with `start.at` the number of positions.
    pub count: usize,
    /// Diameter [m]; with a size distribution or a file, the mean.
    pub diameter: f64,
    /// Mass of a grain of that diameter [kg]: given, or from density and diameter. Others scale with their volume.
    pub mass: f64,
    /// Sphere, disc, clump, superellipsoid, polyhedron, polygon or cells.
    pub shape: GrainShape,
    /// How the diameters are distributed.
    pub size: Size,
    /// Where they begin.
    pub start: Start,
    /// Free, frozen in place, or moved as told.
    pub motion: GrainMotion,
}

impl Particles {
    /// Numbers that its grains take: the spheres of a clump have one each.
    pub fn numbered(&self) -> usize {
        self.count * self.shape.spheres()
    }
}

/// What a grain is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum GrainShape {
    /// Mass pi/6 rho d^3, moment of inertia 2/5 m r^2.
    Sphere {},
    /// Mass pi/4 rho d^2 h, moment of inertia 1/2 m r^2; only in the plane.
    Disc {
        /// Thickness h [m].
        thickness: f64,
    },
    /// Spheres that are one body, scaled so that it just fits a sphere of the grain's diameter about its centre of mass.
    Clump {
        /// Centres, in any unit.
        centre: Vec<Vector>,
        /// Diameters in the same unit.
        diameter: Vec<f64>,
        /// How each grain is turned at first.
        orientation: ClumpOrientation,
    },
    /// The same, its spheres from a file.
    ClumpFile {
        /// Name of the file's copy in the run folder (see `Scene::companions`).
        path: String,
        /// What tells one file from another: CRC-32 of its bytes, in hex.
        fingerprint: String,
        /// How each grain is turned at first.
        orientation: ClumpOrientation,
        /// Centre and radius of each, in the unit of the file.
        #[serde(skip)]
        spheres: Arc<Vec<(Vector, f64)>>,
    },
    /// A convex body that is round or nearly a box, scaled so that it just fits a sphere of the grain's diameter.
    Superellipsoid {
        /// Semi-axes along x, y and z, in any unit.
        semi_axes: Vector,
        /// Exponents of the profile and of the equator [-]; 2 and 2: an ellipsoid.
        exponents: Vec<f64>,
        /// How each grain is turned at first.
        orientation: ClumpOrientation,
    },
    /// A convex body with rounded edges, scaled so that it just fits a sphere of the grain's diameter about its centre of mass.
    Polyhedron {
        /// Corners before edges are rounded, in any unit.
        corners: Vec<Vector>,
        /// Radius of the rounded edges in the same unit.
        rounding: f64,
        /// How each grain is turned at first.
        orientation: ClumpOrientation,
    },
    /// The same, its faces from a closed mesh.
    PolyhedronMesh {
        /// Name of the file's copy in the run folder (see `Scene::companions`).
        path: String,
        /// What tells one file from another: CRC-32 of its bytes, in hex.
        fingerprint: String,
        /// Radius of the rounded edges in the unit of the file.
        rounding: f64,
        /// How each grain is turned at first.
        orientation: ClumpOrientation,
        /// Unit normal and distance from the origin of each face.
        #[serde(skip)]
        faces: Arc<Vec<(Vector, f64)>>,
    },
    /// A convex polygon with rounded corners; only in the plane.
    Polygon {
        /// Corners one after the other, before they are rounded, in any unit.
        corners: Vec<Vector>,
        /// Radius of the rounded corners in the same unit.
        rounding: f64,
        /// Thickness along y [m].
        thickness: f64,
        /// How each grain is turned at first.
        orientation: ClumpOrientation,
    },
    /// Cells of a triangular lattice that are one body, with their mass and inertia; only in the plane. CL-CA moves the cells; DEM takes
    /// their outline, as a polygon where it has no bays, or else as discs.
    Cells {
        /// Which cells.
        outline: GrainPoints,
        /// Distance of neighbours [m].
        spacing: f64,
        /// Radius of the rounded corners of the polygon [spacings].
        rounding: f64,
        /// Thickness along y [m].
        thickness: f64,
        /// How each grain is turned at first; by CL-CA to the nearest of six directions.
        orientation: ClumpOrientation,
    },
    /// Spheres within a closed mesh, with the mass and inertia of what it encloses; the diameter is that of the sphere about its centre of mass
    /// which just holds the mesh.
    ClumpMesh {
        /// Name of the file's copy in the run folder (see `Scene::companions`).
        path: String,
        /// What tells one file from another: CRC-32 of its bytes, in hex.
        fingerprint: String,
        /// How many spheres at most.
        spheres: usize,
        /// How each grain is turned at first.
        orientation: ClumpOrientation,
        /// The spheres, and what they stand for.
        #[serde(skip)]
        packing: Arc<Packing>,
    },
}

/// Distribution of diameters within a group.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Size {
    /// All have the group's `diameter`.
    Equal {},
    /// Every diameter between two is as likely.
    Uniform {
        /// Smallest diameter [m].
        smallest: f64,
        /// Largest diameter [m].
        largest: f64,
    },
    /// Normal, cut at `cut` deviations on both sides.
    Normal {
        /// Mean diameter [m].
        mean: f64,
        /// Standard deviation [m].
        deviation: f64,
        /// Where the tails are cut, in deviations [-].
        cut: f64,
    },
    /// Log-normal: ln d is normal around ln(median), cut at `cut` deviations on both sides.
    LogNormal {
        /// Median diameter [m].
        median: f64,
        /// Standard deviation of ln d [-].
        deviation: f64,
        /// Where the tails are cut, in deviations [-].
        cut: f64,
    },
    /// A sieve curve: share of the mass that passes each sieve, straight between sieves.
    Sieve {
        /// Sieve openings [m], rising.
        diameter: Vec<f64>,
        /// Share of the mass that passes [-], rising from 0 to 1.
        passing: Vec<f64>,
    },
}

/// Who moves the grains of a group.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum GrainMotion {
    /// Forces do.
    Free {},
    /// Nobody: they stay where they are, of infinite mass to others.
    Frozen {},
    /// A displacement given in advance; they do not spin, of infinite mass to others.
    Driven {
        /// Unit direction.
        direction: Vector,
        /// Displacement [m] from where the grains are placed, against time.
        signal: Signal,
    },
}

/// Axes along which the world repeats: a grain that leaves at one end comes in at the other.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Periodic {
    /// Ends along x [m], low and high.
    pub x: Option<[f64; 2]>,
    /// Ends along y [m]; not in the plane.
    pub y: Option<[f64; 2]>,
    /// Ends along z [m].
    pub z: Option<[f64; 2]>,
}

/// Where grains vanish: places that stand still. Grains are looked at every 50 steps, so one may go a little way in. The centre of a clump is
/// that of its mass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Removal {
    /// Centres inside a region.
    Inside {
        /// The region.
        region: Region,
    },
    /// Centres behind a plane.
    Behind {
        /// A point on the plane [m].
        point: Vector,
        /// Unit normal, away from where grains vanish.
        normal: Vector,
    },
}

impl Removal {
    /// Whether a grain with its centre there [m] vanishes. In the plane both y are zero, and so is the centre's.
    pub fn takes(&self, at: Vector) -> bool {
        match self {
            Self::Inside { region } => region.holds(at),
            Self::Behind { point, normal } => (0..3).map(|k| (at[k] - point[k]) * normal[k]).sum::<f64>() < 0.0,
        }
    }
}

/// How grains are placed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Start {
    /// Dropped into the box in random loose rows and settled by DEM (or filled row by row on the lattice) before time 0.
    Settled {
        /// Longest settling time [s].
        time: f64,
    },
    /// Rows from the floor up, at rest.
    Rows {
        /// Distance of centres over diameter [-], at least 1.
        spacing: f64,
        /// Random displacement over the free gap [-], 0 to 1.
        jitter: f64,
        /// Speed of each grain in a random direction [m/s].
        speed: f64,
        /// Where; `None`: the inside of the box.
        region: Option<Region>,
    },
    /// Anywhere in a region, without overlap.
    Random {
        /// Where centres may lie, less a radius; `None`: the inside of the box.
        region: Option<Region>,
        /// Velocity of all [m/s].
        velocity: Vector,
        /// Speed of each grain in a random direction, added [m/s].
        speed: f64,
    },
    /// Not there at first: put into a region one after the other, where there is room, without overlap.
    Stream {
        /// Where.
        region: Region,
        /// Grains per second.
        rate: f64,
        /// Velocity they come with [m/s].
        velocity: Vector,
        /// Speed of each grain in a random direction, added [m/s].
        speed: f64,
        /// When the first comes [s].
        from: f64,
    },
    /// Places (and, where the file has them, diameters, velocities and spins) from a file.
    File {
        /// Name of the file's copy in the run folder (see `Scene::companions`).
        path: String,
        /// Which atom type of a LAMMPS data file; `None`: all of them.
        kind: Option<u32>,
        /// What tells one file from another: CRC-32 of its bytes, in hex.
        fingerprint: String,
        /// What the file says.
        #[serde(skip)]
        grains: Arc<GrainTable>,
    },
    /// Given places.
    At {
        /// Centres [m].
        position: Vec<Vector>,
        /// Velocities [m/s]; empty means at rest.
        velocity: Vec<Vector>,
        /// Spins [rad/s]; empty means none.
        spin: Vec<Vector>,
    },
}

/// Grains read from a file. Columns other than `position` may be empty: the group's values hold then.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GrainTable {
    /// Centres [m].
    pub position: Vec<Vector>,
    /// Diameters [m].
    pub diameter: Vec<f64>,
    /// Velocities [m/s].
    pub velocity: Vec<Vector>,
    /// Spins [rad/s].
    pub spin: Vec<Vector>,
}

/// Mean density [kg/m^3] and diameter [m] of the free grains, of one group or of all: mass over volume, and by number, of the spheres of
/// their volume. Not numbers where there are none.
pub fn submerged<'a>(groups: impl Iterator<Item = (&'a String, &'a Particles)>, only: Option<&str>) -> (f64, f64) {
    let (mut number, mut mass, mut volume, mut diameters) = (0.0, 0.0, 0.0, 0.0);
    for (_, group) in groups.filter(|(name, group)| {
        matches!(group.motion, GrainMotion::Free {}) && only.is_none_or(|only| only == name.as_str())
    }) {
        let count = group.count as f64;
        number += count;
        mass += count * group.mass;
        volume += count * group.shape.mass(1.0, group.diameter);
        diameters += count * group.shape.nominal_diameter(group.diameter);
    }
    (mass / volume, diameters / number)
}
