//! The plan: what a scene means, in SI numbers with every default written out.
//!
//! A [`Plan`] is what engines are built from. It is read (by serde) from the resolved form of the scene file, and that
//! form is also what is written as `scene.toml` into the run folder: running it again gives the same plan, number by
//! number. Names of materials, hosts and groups stay names here, checked to exist; engines turn them into indices.
//!
//! Axes: x to the right, z up, y into the picture. In the plane (`dimension = 2`) vectors are typed with two entries
//! (x, z) and stored here with three; y is locked.

#![allow(rustdoc::broken_intra_doc_links, reason = "[s] is a unit, not a link")]

mod body;
mod bonds;
mod cells;
mod contact;
mod gases;
mod grains;
mod hosts;
mod methods;
pub(crate) mod polyhedron;
mod region;
mod shapes;
mod share;
mod sites;
mod stage;
mod study;
mod superellipsoid;
mod typed_order;
mod walls;
pub mod watch;
mod water;

pub use body::{Clump, ClumpOrientation};
pub use bonds::Bond;
pub use cells::CellError;
pub(crate) use cells::planes as planes_of_cells;
pub use contact::{
    Cohesion, Contact, Damping, Film, Material, MaterialPair, MindlinForm, Normal, Rolling, SlipLever, Strength,
    Tangential, Twisting,
};
pub(crate) use contact::{READ_A_DENSITY, READ_A_FORCE, SLIP_LEVER};
pub use gases::{BaxterBehringer, Fhp, FhpRules, GasWalls, KarolyiKertesz, PengHerrmann};
pub use grains::{GrainMotion, GrainShape, GrainTable, Particles, Periodic, Removal, Size, Start, submerged};
pub use hosts::{Dwell, Host, Interface, Mode, Scale, Signal, Structure};
pub use methods::{
    Arithmetic, ClCa, ClCaRule, Collision, Dem, GrainPoints, GravitySwitch, Integrator, Lattice, LatticeMode, NO_GRAIN,
    ObliqueGravity,
};
pub use polyhedron::{Polyhedron, PolyhedronFace};
pub use region::{Ball, Cylinder, Region};
pub use shapes::{Packing, PackingError};
pub use sites::{GuttHaff, Heap, Savage, Split, Voids};
pub use stage::{Stage, Until};
pub use study::{
    Atlas, Calibrate, Claim, Cost, Curve, Design, Envelope, Goal, Keep, Measured, Output, Path, Responded, Response,
    Sweep,
};
pub use superellipsoid::Superellipsoid;
pub(crate) use superellipsoid::deep;
pub use walls::{Body, Motion, Rotation, Servo, Shape, Wall, box_of_planes};
pub use watch::{Axis, Bed, BodyAxis, Face, Heading, Kernel, Measure, Quantity, Watch};
pub use water::{Buoyancy, Directions, Drag, Flow, Fluctuation, Hindrance, Lid, Lift, StreamStart, Torque, Water};

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
    /// The water that the grains are in.
    pub water: Option<Water>,
    /// The contact law, used by DEM; pairs of materials may have their own.
    pub contact: Contact,
    /// Bonds between grains.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bond: Vec<Bond>,
    /// What only the discrete element method reads.
    pub dem: Dem,
    /// What only the lattice automaton reads.
    pub lattice: Lattice,
    /// What only CL-CA reads.
    pub cl_ca: ClCa,
    /// What only Litwiniszyn's model reads.
    pub litwiniszyn: Voids,
    /// What only the voids after Caram and Hong read.
    pub after_caram_hong: Voids,
    /// What only the chute after Savage reads.
    pub after_savage: Savage,
    /// What only the lattice grains of Gutt and Haff read.
    pub gutt_haff: GuttHaff,
    /// What only the forces in a pile after Hemmingsson and Herrmann read.
    pub after_hemmingsson_herrmann: Heap,
    /// What only the lattice gases FHP read.
    pub fhp: Fhp,
    /// What only the gas after Peng and Herrmann reads.
    pub after_peng_herrmann: PengHerrmann,
    /// What only the elongated grains after Baxter and Behringer read.
    pub after_baxter_behringer: BaxterBehringer,
    /// What only the piles after Karolyi and Kertesz read.
    pub after_karolyi_kertesz: KarolyiKertesz,
    /// What `tsubu response` reads.
    pub response: Option<Response>,
    /// What `tsubu atlas` reads.
    pub atlas: Option<Atlas>,
    /// What `tsubu design` reads.
    pub design: Option<Design>,
    /// What `tsubu calibrate` reads.
    pub calibrate: Option<Calibrate>,
    /// What `tsubu sweep` reads.
    pub sweep: Option<Sweep>,
    /// What is looked at while the scene runs, by name, in the order in which the scene asks for it: results are told in it.
    #[serde(default, with = "typed_order")]
    pub watch: toml::map::Map<String, Watch>,
    /// What is written, and how often.
    pub output: Output,
    /// The folder of the run that this one goes on from, as an absolute path.
    pub start_from: Option<String>,
    /// The CRC-32 of the checkpoint there, in hex.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start_fingerprint: Option<String>,
    /// Whether its clock begins at 0 then.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start_at_zero: Option<bool>,
    /// The stages of the run; empty: it is one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stage: Vec<Stage>,
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
    /// Cellular automaton on the triangular lattice, for balls in a shaken box.
    Lattice,
    /// Grains made of many lattice points.
    ClCa,
    /// Litwiniszyn's voids.
    Litwiniszyn,
    /// Voids after Caram and Hong (1991).
    AfterCaramHong,
    /// A chute on the square lattice after Savage (1993).
    AfterSavage,
    /// Lattice grains of Gutt and Haff.
    GuttHaff,
    /// Forces in a pile after Hemmingsson and Herrmann (1997).
    AfterHemmingssonHerrmann,
    /// Lattice gases of Frisch, Hasslacher and Pomeau.
    Fhp,
    /// A gas of grains after Peng and Herrmann (1994).
    AfterPengHerrmann,
    /// A gas of elongated grains after Baxter and Behringer (1990).
    AfterBaxterBehringer,
    /// Piles after Karolyi and Kertesz (1998).
    AfterKarolyiKertesz,
}

impl Method {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::Dem,
        Self::Lattice,
        Self::ClCa,
        Self::Litwiniszyn,
        Self::AfterCaramHong,
        Self::AfterSavage,
        Self::GuttHaff,
        Self::AfterHemmingssonHerrmann,
        Self::Fhp,
        Self::AfterPengHerrmann,
        Self::AfterBaxterBehringer,
        Self::AfterKarolyiKertesz,
    ];

    /// Name in scene files and summaries.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Dem => "dem",
            Self::Lattice => "lattice",
            Self::ClCa => "cl-ca",
            Self::Litwiniszyn => "litwiniszyn",
            Self::AfterCaramHong => "after-caram-hong",
            Self::AfterSavage => "after-savage",
            Self::GuttHaff => "gutt-haff",
            Self::AfterHemmingssonHerrmann => "after-hemmingsson-herrmann",
            Self::Fhp => "fhp",
            Self::AfterPengHerrmann => "after-peng-herrmann",
            Self::AfterBaxterBehringer => "after-baxter-behringer",
            Self::AfterKarolyiKertesz => "after-karolyi-kertesz",
        }
    }
}

impl Plan {
    /// What the scene says of two materials, whichever it names first.
    pub fn pair(&self, a: &str, b: &str) -> Option<&MaterialPair> {
        self.material_pair.iter().find(|pair| {
            let [x, y] = &pair.between;
            (x == a && y == b) || (x == b && y == a)
        })
    }

    /// Number of all grains, those that come later included; a clump is one.
    pub fn grains(&self) -> usize {
        self.particles.values().map(|group| group.count).sum()
    }

    /// The same with each sphere of a clump for one: grains are numbered below it.
    pub fn numbered(&self) -> usize {
        self.particles.values().map(Particles::numbered).sum()
    }

    /// Mass of all grains, those that come later included [kg].
    pub fn grain_mass(&self) -> f64 {
        self.particles.values().map(|group| group.mass * group.count as f64).sum()
    }

    /// Cost of all grains, those that come later included, by what the materials cost in `cost`; nothing where one of them is not there.
    pub fn grain_cost(&self, cost: &BTreeMap<String, Cost>) -> Option<f64> {
        let of_group = |group: &Particles| {
            let cost = cost.get(&group.material)?;
            Some(group.count as f64 * (cost.per_kilogram * group.mass + cost.per_grain))
        };
        self.particles.values().map(of_group).sum()
    }

    /// Number of the first grain of a group: groups follow each other in the order of their names, those of streams after the
    /// others.
    pub fn first_of(&self, group: &str) -> usize {
        let comes_later = |group: &Particles| matches!(group.start, Start::Stream { .. });
        let Some(wanted) = self.particles.get(group) else { return 0 };
        let before = self
            .particles
            .iter()
            .filter(|(name, other)| (comes_later(other), name.as_str()) < (comes_later(wanted), group));
        before.map(|(_, other)| other.numbered()).sum()
    }

    /// The contact law of two materials.
    pub fn contact_of(&self, a: &str, b: &str) -> &Contact {
        self.pair(a, b).and_then(|pair| pair.contact.as_ref()).unwrap_or(&self.contact)
    }
}
