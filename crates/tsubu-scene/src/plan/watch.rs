//! Watches: what is looked at while a scene runs, and when.

use super::{GrainMotion, Particles, Region, Vector};
use serde::{Deserialize, Serialize};

/// A watch: when it looks, and at what.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct Watch {
    /// When the first look is taken [s].
    pub from: f64,
    /// After this no look is taken [s]; `None`: to the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until: Option<f64>,
    /// Time between looks [s]; `None`: a look at every step.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub every: Option<f64>,
    /// What is measured.
    #[serde(flatten)]
    pub measure: Measure,
}

/// What a watch measures.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Measure {
    /// Averages in slices across an axis.
    Profile {
        /// Axis along which the slices follow each other.
        axis: Axis,
        /// Number of slices.
        bins: usize,
        /// What is averaged.
        quantities: Vec<Quantity>,
        /// Where.
        region: Region,
    },
    /// Smooth fields (Goldhirsch 2010).
    CoarseGrain {
        /// How a grain is smeared out.
        kernel: Kernel,
        /// Width of the kernel [m].
        width: f64,
        /// Axes along which fields vary.
        axes: Vec<Axis>,
        /// Points along each of them.
        points: Vec<usize>,
        /// Where the points are, and over what the other axes are averaged.
        region: Region,
    },
    /// Slope of the free surface.
    Slope {
        /// Horizontal axis.
        axis: Axis,
        /// Columns.
        bins: usize,
        /// Middle share of the width that is looked at [-].
        share: f64,
        /// Where the top of a heap is along the axis [m].
        centre: f64,
        /// Whether only grains count that touch something.
        touching: bool,
        /// Where.
        region: Region,
    },
    /// Grains that have passed a plane.
    Discharge {
        /// A point on the plane [m].
        point: Vector,
        /// Unit direction in which grains pass.
        normal: Vector,
        /// Only grains of this group.
        group: Option<String>,
    },
    /// Hops of grains over a bed.
    Hops {
        /// What a grain must touch to be on the bed.
        bed: Vec<Bed>,
        /// Only grains of this group.
        group: Option<String>,
        /// Unit direction in which hops are long.
        along: Vector,
        /// Unit direction in which hops are high.
        up: Vector,
        /// Lower hops are not counted [m].
        lowest: f64,
        /// After so many hops nothing is written any more.
        most: Option<usize>,
    },
    /// Transport of grains along a bed.
    Bedload {
        /// Horizontal axis.
        axis: Axis,
        /// Where; its plan area is what the transport is over.
        region: Region,
        /// Only grains of this group.
        group: Option<String>,
        /// In the plane: grains are spheres in a bed of this width [m]; `None`: discs.
        width: Option<f64>,
        /// A grain that is faster begins to move [m/s].
        moving_speed: f64,
        /// A moving grain that is slower has come to rest [m/s].
        resting_speed: f64,
        /// Density of the fluid, for the Einstein number [kg/m^3].
        fluid_density: Option<f64>,
    },
    /// Front, travel and deposit.
    RunOut {
        /// Where the grains run.
        direction: Heading,
        /// Share of the mass behind the mass front [-].
        share: f64,
        /// Columns of the deposit.
        bins: usize,
        /// Only grains of this group.
        group: Option<String>,
        /// Where the deposit is.
        region: Region,
    },
    /// Contacts per grain.
    Coordination {
        /// Grains with fewer contacts are rattlers.
        fewest: u32,
        /// Whether contacts with walls count.
        walls: bool,
        /// Only grains inside.
        region: Option<Region>,
    },
    /// Fabric tensor of the contacts.
    Fabric {
        /// Whether contacts with walls count.
        walls: bool,
        /// Only grains inside.
        region: Option<Region>,
    },
    /// Distribution of the contact forces.
    Forces {
        /// Bins of the histogram.
        bins: usize,
        /// Upper end of the histogram, in mean forces [-].
        largest: f64,
        /// Whether contacts with walls count.
        walls: bool,
        /// Only grains inside.
        region: Option<Region>,
    },
    /// Contacts one by one.
    Contacts {
        /// Whether contacts with walls count.
        walls: bool,
        /// Only contacts inside.
        region: Option<Region>,
    },
    /// Mixing of two groups.
    Segregation {
        /// The two groups.
        groups: [String; 2],
        /// Edge of the cells [m].
        cell: f64,
        /// Only grains inside.
        region: Option<Region>,
    },
    /// Force and torque on a wall.
    WallLoad {
        /// The wall.
        wall: String,
        /// Only what touches this face of a box.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        face: Option<Face>,
        /// Area for the pressure [m^2].
        area: Option<f64>,
        /// Unit direction in which the pressure acts on the wall.
        direction: Option<Vector>,
    },
    /// The water, and what it means to grains.
    Stream {
        /// Grains of the Shields and Rouse numbers: of this group.
        group: Option<String>,
    },
    /// Single grains.
    Track {
        /// Their numbers, among all or in the group.
        ids: Vec<u32>,
        /// The group that they are counted in.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        group: Option<String>,
    },
}

impl Measure {
    /// Name in scene files.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Profile { .. } => "profile",
            Self::CoarseGrain { .. } => "coarse-grain",
            Self::Slope { .. } => "slope",
            Self::Discharge { .. } => "discharge",
            Self::Hops { .. } => "hops",
            Self::Bedload { .. } => "bedload",
            Self::RunOut { .. } => "run-out",
            Self::Coordination { .. } => "coordination",
            Self::Fabric { .. } => "fabric",
            Self::Forces { .. } => "forces",
            Self::Contacts { .. } => "contacts",
            Self::Segregation { .. } => "segregation",
            Self::WallLoad { .. } => "wall-load",
            Self::Stream { .. } => "stream",
            Self::Track { .. } => "track",
        }
    }

    /// The region it looks at, if it is not everywhere.
    pub const fn region(&self) -> Option<&Region> {
        match self {
            Self::Profile { region, .. }
            | Self::CoarseGrain { region, .. }
            | Self::Slope { region, .. }
            | Self::Bedload { region, .. }
            | Self::RunOut { region, .. } => Some(region),
            Self::Coordination { region, .. }
            | Self::Fabric { region, .. }
            | Self::Forces { region, .. }
            | Self::Contacts { region, .. }
            | Self::Segregation { region, .. } => region.as_ref(),
            Self::Discharge { .. }
            | Self::Hops { .. }
            | Self::WallLoad { .. }
            | Self::Stream { .. }
            | Self::Track { .. } => None,
        }
    }
}

/// A face of a box, seen from within.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Face {
    /// At the low end of x.
    Left,
    /// At the high end of x.
    Right,
    /// At the low end of y.
    Front,
    /// At the high end of y.
    Back,
    /// At the low end of z.
    Floor,
    /// At the high end of z.
    Lid,
}

impl Face {
    /// Unit normal, towards the grains.
    pub const fn normal(self) -> Vector {
        match self {
            Self::Left => [1.0, 0.0, 0.0],
            Self::Right => [-1.0, 0.0, 0.0],
            Self::Front => [0.0, 1.0, 0.0],
            Self::Back => [0.0, -1.0, 0.0],
            Self::Floor => [0.0, 0.0, 1.0],
            Self::Lid => [0.0, 0.0, -1.0],
        }
    }
}

/// An axis of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Axis {
    /// To the right.
    X,
    /// Into the picture.
    Y,
    /// Up.
    Z,
}

impl Axis {
    /// 0, 1, 2.
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Name in scene files and tables.
    pub const fn name(self) -> &'static str {
        ["x", "y", "z"][self as usize]
    }
}

/// A horizontal axis, and which way along it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Heading {
    /// To the right.
    #[serde(rename = "x")]
    X,
    /// To the left.
    #[serde(rename = "-x")]
    MinusX,
    /// Into the picture.
    #[serde(rename = "y")]
    Y,
    /// Out of the picture.
    #[serde(rename = "-y")]
    MinusY,
}

impl Heading {
    /// The axis.
    pub const fn axis(self) -> Axis {
        match self {
            Self::X | Self::MinusX => Axis::X,
            Self::Y | Self::MinusY => Axis::Y,
        }
    }

    /// 1 along the axis, -1 against it.
    pub const fn sign(self) -> f64 {
        match self {
            Self::X | Self::Y => 1.0,
            Self::MinusX | Self::MinusY => -1.0,
        }
    }
}

/// What a profile averages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Quantity {
    /// Share of the volume that grains fill.
    SolidFraction,
    /// Mean velocity by mass.
    Velocity,
    /// Mean square of a component of the velocity about the mean.
    GranularTemperature,
    /// Contacts per grain.
    Coordination,
    /// Mean spin by moment of inertia.
    Spin,
}

/// Mean density [kg/m^3] and diameter [m] of the free grains, of one group or of all: mass over volume, and by number. Not
/// numbers where there are none.
pub fn submerged<'a>(groups: impl Iterator<Item = (&'a String, &'a Particles)>, only: Option<&str>) -> (f64, f64) {
    let (mut number, mut mass, mut volume, mut diameters) = (0.0, 0.0, 0.0, 0.0);
    for (_, group) in groups.filter(|(name, group)| {
        matches!(group.motion, GrainMotion::Free {}) && only.is_none_or(|only| only == name.as_str())
    }) {
        let count = group.count as f64;
        number += count;
        mass += count * group.mass;
        volume += count * group.shape.mass(1.0, group.diameter);
        diameters += count * group.diameter;
    }
    (mass / volume, diameters / number)
}

/// What the bed is that grains hop on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Bed {
    /// Walls.
    Walls,
    /// Frozen and driven grains.
    FixedGrains,
    /// Grains that forces move.
    FreeGrains,
}

/// How a grain is smeared out into a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kernel {
    /// exp(-r^2 / 2 w^2).
    Gaussian,
    /// (1 + 3 r/w) (1 - r/w)^3.
    Lucy,
}
