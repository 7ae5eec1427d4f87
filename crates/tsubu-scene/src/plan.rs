//! The plan: what a scene means, in SI numbers with every default written out.
//!
//! A [`Plan`] is what engines are built from. It is read (by serde) from the resolved form of the scene file, and that
//! form is also what is written as `scene.toml` into the run folder: running it again gives the same plan, number by
//! number. Names of materials, hosts and groups stay names here, checked to exist; engines turn them into indices.
//!
//! Axes: x to the right, z up, y into the picture. In the plane (`dimension = 2`) vectors are typed with two entries
//! (x, z) and stored here with three; y is locked.

#![allow(rustdoc::broken_intra_doc_links, reason = "[s] is a unit, not a link")]

mod watch;

pub use watch::{Axis, Kernel, Measure, Quantity, Watch};

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A 3-vector in SI units.
pub type Vector = [f64; 3];

/// Everything a run needs to know.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Plan {
    /// One line for people.
    pub title: String,
    /// The method that `tsubu run` uses.
    pub method: Method,
    /// 2: the plane (x, z), y locked. 3: space.
    pub dimension: u8,
    /// Seed of every random number of the run.
    pub seed: u64,
    /// Gravitational acceleration [m/s^2], a vector; (0, 0, -9.8) unless told.
    pub gravity: Vector,
    /// Simulated time [s].
    pub duration: f64,
    /// Typical fastest relative speed [m/s], used by the verdict and the default time step; `None`: estimated.
    pub speed_scale: Option<f64>,
    /// Materials by name.
    pub materials: BTreeMap<String, Material>,
    /// Exceptions to the mixing rule, for named pairs of materials.
    #[serde(default)]
    pub material_pair: Vec<MaterialPair>,
    /// Groups of grains by name, placed in the order of their names.
    #[serde(default)]
    pub particles: BTreeMap<String, Particles>,
    /// Walls by name.
    #[serde(default)]
    pub walls: BTreeMap<String, Wall>,
    /// Axes along which the world repeats itself.
    #[serde(default)]
    pub periodic: Periodic,
    /// Regions in which grains vanish, by name.
    #[serde(default)]
    pub removal: BTreeMap<String, Removal>,
    /// Vibrating structures by name.
    #[serde(default)]
    pub hosts: BTreeMap<String, Host>,
    /// The contact law, used by DEM; pairs of materials may have their own.
    pub contact: Contact,
    /// What only the discrete element method reads.
    pub dem: Dem,
    /// What only the lattice automaton reads.
    pub lattice: Lattice,
    /// What `tsubu response` reads.
    pub response: Option<Response>,
    /// What `tsubu sweep` reads.
    pub sweep: Option<Sweep>,
    /// What is looked at while the scene runs, by name.
    #[serde(default)]
    pub watch: BTreeMap<String, Watch>,
    /// What is written, and how often.
    pub output: Output,
    /// Results that must lie in a range.
    #[serde(default)]
    pub claim: Vec<Claim>,
}

/// How the grains are moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Discrete element method.
    Dem,
    /// Cellular automaton on the triangular lattice.
    Lattice,
}

impl Method {
    /// Name in scene files and summaries.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Dem => "dem",
            Self::Lattice => "lattice",
        }
    }
}

/// Bulk properties of a material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Material {
    /// Young's modulus E [Pa].
    pub young_modulus: f64,
    /// Poisson's ratio [-].
    pub poisson_ratio: f64,
    /// Coefficient of restitution e against the same material [-], 0 < e <= 1.
    pub restitution: f64,
    /// Coulomb friction coefficient against the same material [-].
    pub friction: f64,
    /// Rolling friction coefficient against the same material [-]; for `contact.rolling.contact-width` the factor f'.
    pub rolling_friction: f64,
    /// Twisting friction coefficient against the same material [-].
    pub twisting_friction: f64,
    /// Surface energy gamma of one face [J/m^2]: two like bodies part at 4 pi gamma R* (DMT), 3 pi gamma R* (JKR).
    pub surface_energy: f64,
    /// Attraction of the constant and of the area kinds of cohesion: force [N] or energy density [Pa], as the part says.
    pub cohesion: f64,
    /// Density [kg/m^3]; needed where a grain group gives no mass.
    pub density: Option<f64>,
}

/// Values for one pair of materials that replace the mixing rule (geometric mean of restitution and friction).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct MaterialPair {
    /// The two material names.
    pub between: [String; 2],
    /// Coefficient of restitution [-].
    pub restitution: Option<f64>,
    /// Friction coefficient [-].
    pub friction: Option<f64>,
    /// Rolling friction coefficient [-].
    pub rolling_friction: Option<f64>,
    /// Twisting friction coefficient [-].
    pub twisting_friction: Option<f64>,
    /// Surface energy gamma of one face [J/m^2].
    pub surface_energy: Option<f64>,
    /// Cohesion, in the unit of the cohesion part.
    pub cohesion: Option<f64>,
    /// The contact law of the pair, where it is another than the scene's; whether grains spin is the same in all.
    pub contact: Option<Contact>,
}

impl Plan {
    /// What the scene says of two materials, whichever it names first.
    pub fn pair(&self, a: &str, b: &str) -> Option<&MaterialPair> {
        self.material_pair.iter().find(|pair| {
            let [x, y] = &pair.between;
            (x == a && y == b) || (x == b && y == a)
        })
    }

    /// The contact law of two materials.
    pub fn contact_of(&self, a: &str, b: &str) -> &Contact {
        self.pair(a, b).and_then(|pair| pair.contact.as_ref()).unwrap_or(&self.contact)
    }
}

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
    /// Sphere or disc.
    pub shape: GrainShape,
    /// How the diameters are distributed.
    pub size: Size,
    /// Where they begin.
    pub start: Start,
    /// Free, frozen in place, or moved as told.
    pub motion: GrainMotion,
}

/// What a grain is, for its mass and its moment of inertia; contacts are those of spheres either way.
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

/// An axis-parallel box of space. In the plane the y entries are zero and not looked at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Region {
    /// Corner with the smallest coordinates [m].
    pub low: Vector,
    /// Corner with the largest coordinates [m].
    pub high: Vector,
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

/// Where grains vanish: places that stand still. Every 50 steps it is looked for them, so a grain may go a little way in.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Removal {
    /// Centres inside a box.
    Inside {
        /// The box.
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
        grains: std::sync::Arc<GrainTable>,
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
    /// Prescribed motion; not together with `host`, `servo` or `body`.
    pub motion: Option<Motion>,
    /// Prescribed turning, alone or together with `motion`.
    pub rotation: Option<Rotation>,
    /// A wall that a constant force pushes against the grains.
    pub servo: Option<Servo>,
    /// A free rigid body under gravity and the grains' forces.
    pub body: Option<Body>,
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
    /// Constant force F [N]: given, or `pressure` times `area`.
    pub force: f64,
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

/// A quantity given against time: displacement [m] or force [N], as the place says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Signal {
    /// amplitude sin(2 pi frequency t + phase).
    Sine {
        /// Amplitude [m] or [N].
        amplitude: f64,
        /// Frequency [Hz].
        frequency: f64,
        /// Phase [rad].
        phase: f64,
    },
    /// Sine of constant amplitude whose frequency runs linearly in time; silent afterwards.
    SineSweep {
        /// Amplitude [m] or [N].
        amplitude: f64,
        /// First frequency [Hz].
        from: f64,
        /// Last frequency [Hz].
        to: f64,
        /// Length [s].
        duration: f64,
    },
    /// Half-sine pulse.
    Impact {
        /// Height [m] or [N].
        peak: f64,
        /// Length [s].
        duration: f64,
        /// Begin [s].
        at: f64,
    },
    /// rate t: steady translation or turning.
    Steady {
        /// Rate [m/s] or [rad/s] (or [N/s]).
        rate: f64,
    },
    /// Straight lines between given points, constant outside. Read from a CSV file (`file`), kept here as numbers.
    Table {
        /// Times [s], rising.
        time: Vec<f64>,
        /// Values [m] or [N].
        value: Vec<f64>,
    },
}

/// A vibrating structure: M q'' + C (q' - r y') + K (q - r y) = w F(t) + w F_grains. The displacement that walls see is
/// w . q along `direction`; y is the base motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Host {
    /// M, C, K.
    pub structure: Structure,
    /// Unit direction of its motion.
    pub direction: Vector,
    /// Base displacement y(t) [m].
    pub base: Option<Signal>,
    /// Applied force F(t) [N].
    pub force: Option<Signal>,
    /// Displacement at time 0 of every coordinate [m].
    pub displacement: f64,
    /// Velocity at time 0 of every coordinate [m/s].
    pub velocity: f64,
}

/// The matrices of a host.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Structure {
    /// One degree of freedom.
    Oscillator {
        /// M [kg], without the grains.
        mass: f64,
        /// K [N/m].
        stiffness: f64,
        /// C [N.s/m].
        damping: f64,
    },
    /// n degrees of freedom.
    Matrices {
        /// M [kg].
        mass: Vec<Vec<f64>>,
        /// C [N.s/m].
        damping: Vec<Vec<f64>>,
        /// K [N/m].
        stiffness: Vec<Vec<f64>>,
        /// Index (from 0) of the coordinate that carries the walls and takes the force.
        coordinate: usize,
    },
    /// A list of modes.
    Modes {
        /// The modes.
        mode: Vec<Mode>,
    },
}

/// One vibration mode.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Mode {
    /// Natural frequency [Hz].
    pub frequency: f64,
    /// Damping ratio [-].
    pub damping_ratio: f64,
    /// Modal mass [kg].
    pub mass: f64,
    /// Mode shape where the walls are [-].
    pub shape: f64,
    /// Participation of the base motion [-].
    pub participation: f64,
}

/// The contact law as a stack of parts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Contact {
    /// Elastic normal force.
    pub normal: Normal,
    /// Normal damping; its coefficient is found so that the materials' restitution comes back.
    pub damping: Damping,
    /// Whether damping may make the normal force attractive (Komatsuzaki 2003, literally); otherwise the force is cut at zero.
    pub attraction: bool,
    /// Tangential force.
    pub tangential: Tangential,
    /// Rolling resistance.
    pub rolling: Rolling,
    /// Resistance against turning about the normal.
    pub twisting: Twisting,
    /// Attraction.
    pub cohesion: Cohesion,
    /// Whether grains spin.
    pub rotation: bool,
}

/// Elastic normal force for overlap d.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Normal {
    /// k d^(3/2), k from the materials (Hertz).
    Hertz {},
    /// k d, one k for all contacts.
    Hooke {
        /// k [N/m].
        stiffness: f64,
    },
}

/// Damping of the normal motion for overlap d and overlap rate d'.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Damping {
    /// No damping, whatever the restitution.
    None {},
    /// c d^(1/2) d' (visco-elastic, Kuwabara-Kono): restitution falls slowly with speed.
    Sqrt {
        /// Impact speed at which the restitution is the materials' [m/s].
        reference_speed: f64,
    },
    /// c d^(1/4) d' (Tsuji 1992): constant restitution with Hertz.
    Quarter {},
    /// c d': constant restitution with Hooke; with Hertz the restitution is met at the reference speed.
    Linear {
        /// Impact speed at which the restitution is the materials' [m/s].
        reference_speed: f64,
    },
    /// rate m* d', whatever the restitution (the `mass_velocity` damping of other codes).
    Rate {
        /// Damping coefficient over reduced mass [1/s].
        rate: f64,
    },
    /// c d', one c for all contacts, whatever the restitution (Osada 2004).
    Dashpot {
        /// c [N.s/m].
        coefficient: f64,
    },
}

/// Tangential force.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Tangential {
    /// None.
    None {},
    /// Sliding friction -mu f_n v_t / max(|v_t|, v_eps): Komatsuzaki 2003, no spring.
    Coulomb {
        /// v_eps [m/s].
        smoothing_speed: f64,
    },
    /// Mindlin's spring with history, capped at mu f_n.
    Mindlin {
        /// How force and slip belong together.
        form: MindlinForm,
        /// Tangential over normal dashpot [-]; `None`: equal damping ratios.
        damping: Option<f64>,
    },
    /// A linear spring with history and a dashpot, capped at mu f_n + c b (Cundall and Strack 1979; Osada 2004).
    Spring {
        /// k_t over the stiffness of `contact.normal.hooke` [-].
        ratio: f64,
        /// Tangential over normal dashpot [-].
        damping: f64,
        /// Grain-level cohesion c: the tangential force may reach mu f_n plus this [N].
        cohesion: f64,
    },
}

/// Which reading of Mindlin's no-slip solution is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MindlinForm {
    /// dF = -k_t(d) dx, F scaled down on unloading (Thornton, Cummins, Cleary 2013).
    Incremental,
    /// F = -k_t(d) x, x the whole slip (the form behind the curves of Chung and Ooi 2011).
    Secant,
}

/// Rolling resistance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Rolling {
    /// None.
    None {},
    /// Torque mu_r R f_n against the relative rolling, smoothed below a small rolling speed.
    Constant {
        /// Rolling speed below which the torque fades [m/s].
        smoothing_speed: f64,
    },
    /// Torque coefficient times the rolling, without a limit (model B of Ai 2011).
    Viscous {
        /// Torque over (mu_r R f_n) at a rolling speed of 1 m/s [s/m].
        coefficient: f64,
    },
    /// Elastic-plastic spring-dashpot (EPSD, model C of Ai 2011): k_r = ratio k_n (mu_r R)^2, capped at mu_r R f_n.
    Epsd {
        /// 2.25 in space, 3 in the plane [-].
        ratio: f64,
        /// Damping ratio of the rolling spring [-].
        damping_ratio: f64,
    },
    /// The same without a dashpot, k_r = k_t R^2 (EPSD2).
    Epsd2 {},
    /// Rolling spring-dashpot-slider on the rolling displacement: force k x + c v, capped at mu_r f_n, at arm R (Luding 2008).
    Spring {
        /// k [N/m].
        stiffness: f64,
        /// c [N.s/m].
        damping: f64,
    },
    /// Torque f' b f_n, b the half width of contact (Osada 2004).
    ContactWidth {
        /// Rolling speed below which the torque fades [m/s].
        smoothing_speed: f64,
    },
}

/// Resistance against relative spin about the normal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Twisting {
    /// None.
    None {},
    /// Torque 2/3 mu_t a f_n against the twisting, a the contact radius, fading below a small rate.
    Sliding {
        /// Spin below which the torque fades [rad/s].
        smoothing_spin: f64,
    },
    /// Spring k_t a^2 / 2 on the angle of twist, capped at 2/3 mu_t a f_n (Marshall 2009).
    Spring {},
}

/// Attraction between bodies in contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Cohesion {
    /// None.
    None {},
    /// Hertz less 4 pi gamma R* (Derjaguin, Muller, Toporov 1975).
    Dmt {},
    /// Johnson, Kendall, Roberts 1971: replaces Hertz; holds on beyond the geometric contact until pull-off.
    Jkr {},
    /// Energy density times the area of the overlap lens; depends on stiffness.
    Sjkr {},
    /// The same force in every contact.
    Constant {},
}

/// Settings of the discrete element method.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Dem {
    /// Time step [s]; `None`: the shortest contact time at the speed scale over `steps_per_contact`.
    pub time_step: Option<f64>,
    /// Steps per contact for the automatic time step.
    pub steps_per_contact: f64,
    /// Time integration.
    pub integrator: Integrator,
    /// Extra reach of the candidate search over the smallest diameter [-]; changes speed, and above 96 grains the last bits.
    pub skin: f64,
    /// Overlap over diameter at which the run stops as blown up [-].
    pub largest_overlap: f64,
    /// Follow how grains turn.
    pub orientation: bool,
    /// Energy residual over turned-over energy above which the run warns [-].
    pub energy_tolerance: f64,
}

/// Time integration of grains.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Integrator {
    /// Velocity Verlet, second order.
    VelocityVerlet,
    /// Kick, then drift with the new velocity; first order, stable.
    SymplecticEuler,
    /// Drift with the old velocity, then kick; only to reproduce older work.
    ForwardEuler,
}

/// Settings of the damper automaton. `mode` sets what the other options default to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
#[expect(clippy::struct_excessive_bools, reason = "each is an independent reading of the published rules")]
pub struct Lattice {
    /// Literal (Komatsuzaki 2003) or extended rules.
    pub mode: LatticeMode,
    /// Time step [s].
    pub time_step: f64,
    /// Gravity along the oblique directions: `projected` (half) or `unit` (full).
    pub oblique_gravity: ObliqueGravity,
    /// Who changes in a ball-ball collision.
    pub collision: Collision,
    /// Scatter of a rebound: straight back with probability 1/2, else the two neighbours; `false`: straight back.
    pub rebound_scatter: bool,
    /// Forget the stored distance when a collision happens or a move is blocked.
    pub reset_when_blocked: bool,
    /// Keep the remainder of the stored distance after a move (else set to zero).
    pub keep_remainder: bool,
    /// Resting contacts pass their impulse to the host.
    pub resting_impulses: bool,
    /// Collisions at or below this many g dt of relative speed are resting contacts [-].
    pub resting_threshold: f64,
    /// Number representation of speeds.
    pub arithmetic: Arithmetic,
    /// Rows of head-room added above and below the box's travel.
    pub head_room: usize,
}

/// Preset of lattice rules.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LatticeMode {
    /// The nearest reading of Komatsuzaki 2003.
    Literal,
    /// With resting impulses.
    Extended,
}

/// Gravity along oblique lattice directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ObliqueGravity {
    /// The component along the direction (one half).
    Projected,
    /// As if vertical.
    Unit,
}

/// Ball-ball collision on the lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Collision {
    /// Both balls change, momentum conserved along the line.
    Pairwise,
    /// Each ball updates only itself.
    Literal,
}

/// Numbers of the automaton.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Arithmetic {
    /// Fixed point, 1/1024 of g dt.
    Fixed,
    /// Whole multiples of g dt, truncated toward zero.
    Integer,
}

/// A frequency-response sweep.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Response {
    /// The host whose displacement is measured; its base (or force) must be a sine, whose frequency is varied.
    pub host: String,
    /// Frequency over the host's first undamped natural frequency [-].
    pub frequency_ratio: Vec<f64>,
    /// Periods thrown away before measuring, with grains.
    pub discard_periods: u32,
    /// Periods thrown away for the empty host.
    pub discard_periods_empty: u32,
    /// Periods measured.
    pub measure_periods: u32,
    /// Number of random seeds, from the scene's seed upwards.
    pub seeds: u32,
    /// Scene keys and the values they take; every combination is a case.
    pub vary: BTreeMap<String, Vec<toml::Value>>,
}

/// A parameter sweep: every combination of the values is a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Sweep {
    /// Scene keys and the values they take.
    pub vary: BTreeMap<String, Vec<toml::Value>>,
}

/// What is written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Output {
    /// Simulated time between rows of `history.csv` [s].
    pub history_interval: f64,
    /// Simulated time between frames [s]; `None`: no frames.
    pub frame_interval: Option<f64>,
    /// Simulated time between checkpoints [s].
    pub checkpoint_interval: f64,
    /// Also write extended XYZ.
    pub xyz: bool,
    /// Also write LAMMPS dump files.
    pub lammps: bool,
}

/// A result that must lie in a range.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Claim {
    /// Name of the result, as in `results` of `summary.json`.
    pub result: String,
    /// Lower end of the accepted range.
    pub low: Option<f64>,
    /// Upper end of the accepted range.
    pub high: Option<f64>,
    /// Where the number comes from.
    pub source: String,
}
