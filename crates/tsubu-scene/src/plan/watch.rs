//! Watches: what is looked at while a scene runs, and when. Every kind of watch is one row here; formulas stand beside their
//! code: `tsubu explain`.

mod common;
mod words;

pub use words::{Axis, Bed, BodyAxis, Face, Heading, Kernel, Quantity};

use super::{Region, Vector};
use crate::key::{Family, Key, Kind};
use crate::units::{AREA, DENSITY, FREQUENCY, LENGTH, NUMBER, SPEED, TIME};
use common::{GROUP, REGION, SIZES, STAYS, WALLS, WITHIN};
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

/// The kinds of watches, told once.
///
/// A kind is a row: the file of its code in the engine and its name in the plan, its name in a scene, one sentence, and its keys:
/// field, type, row of the table. The field has the name of its key, with `_` for `-`. From the rows come a struct a kind, the enum
/// of them, what a scene may say, and `every_watch!`, which hands the files and names on to the engine.
macro_rules! kinds {
    ($($file:ident::$kind:ident $name:literal $about:literal {
        $($(#[$field_attribute:meta])* $field:ident: $type:ty = $key:expr),* $(,)?
    })*) => {
        /// What a watch measures.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        pub enum Measure {
            $(
                #[doc = $about]
                #[serde(rename = $name)]
                $kind($kind)
            ),*
        }

        $(
            #[doc = $about]
            #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
            #[serde(rename_all = "kebab-case", deny_unknown_fields)]
            pub struct $kind {
                $($(#[$field_attribute])* pub $field: $type),*
            }

            impl $kind {
                /// What a scene may say.
                pub(crate) const KEYS: &'static [Key] = &[$($key),*];
            }
        )*

        impl Measure {
            /// Names in scene files.
            pub(crate) const NAMES: &'static [&'static str] = &[$($name),*];

            /// What a scene may say: a watch has exactly one of these tables.
            pub(crate) const KEYS: &'static [Key] = &[
                $(Key::new($name, Kind::Table($kind::KEYS), $about).optional().rivals(Self::NAMES)),*
            ];

            /// Name in scene files.
            pub const fn name(&self) -> &'static str {
                match self {
                    $(Self::$kind(_) => $name),*
                }
            }
        }

        /// Calls the macro `watches` of whoever calls this with the file and the name of every kind of watch.
        #[macro_export]
        macro_rules! every_watch {
            () => { watches! { $($file::$kind)* } };
        }
    };
}

kinds! {
    profile::Profile "profile"
    "Averages in slices across an axis: solid fraction, velocity, temperature, coordination, spin" {
        /// Axis along which the slices follow each other.
        axis: Axis = Key::new("axis", Kind::OneOf(Axis::WORDS), "Axis along which the slices follow each other").default("'z'"),
        /// Number of slices.
        bins: usize = Key::new("bins", Kind::Whole, "Number of slices").default("20").at_least(1.0).at_most(1e5),
        /// What is averaged.
        quantities: Vec<Quantity> = Key::new("quantities", Kind::SomeOf(Quantity::WORDS), "What is averaged")
            .default("['solid-fraction', 'velocity', 'granular-temperature']"),
        /// Where.
        region: Region = REGION,
    }

    coarse_grain::CoarseGrain "coarse-grain"
    "Density, velocity, stress and granular temperature as smooth fields (Goldhirsch 2010); in the plane per area, not volume" {
        /// How a grain is smeared out.
        kernel: Kernel = Key::new("kernel", Kind::OneOf(Kernel::WORDS), "How a grain is smeared out").default("'lucy'"),
        /// Width of the kernel [m].
        width: f64 = Key::new(
            "width",
            Kind::Quantity(&LENGTH),
            "Width w of the kernel: standard deviation of the Gaussian, reach of Lucy's",
        )
        .above(0.0),
        /// Axes along which fields vary.
        axes: Vec<Axis> = Key::new(
            "axes",
            Kind::SomeOf(Axis::WORDS),
            "Axes along which fields vary; along the others they are averaged over the region",
        )
        .default("['z']"),
        /// Points along each of them.
        points: Vec<usize> = Key::new("points", Kind::Wholes, "Points along each of these axes, evenly spaced in the region")
            .at_least(1.0)
            .at_most(1e5),
        /// Where the points are, and over what the other axes are averaged.
        region: Region = REGION,
    }

    granular_temperature::GranularTemperature "granular-temperature"
    "Granular temperature of a group: how much grains move about their mean velocity, in all and along each axis (Campbell 1990)" {
        /// Only grains of this group.
        group: Option<String> = GROUP,
        /// Only grains inside.
        region: Option<Region> = WITHIN,
    }

    slope::Slope "slope" "Slope of the free surface, and the angle of a heap, by least squares" {
        /// Horizontal axis.
        axis: Axis = Key::new("axis", Kind::OneOf(Axis::ACROSS), "Horizontal axis of the slope").default("'x'"),
        /// Columns.
        bins: usize = Key::new("bins", Kind::Whole, "Columns in which the highest grain is looked for")
            .default("20")
            .at_least(4.0)
            .at_most(1e5),
        /// Middle share of the width that is looked at [-].
        share: f64 = Key::new("share", Kind::Quantity(&NUMBER), "Middle share of the width that the lines are laid through")
            .default("0.8")
            .above(0.0)
            .at_most(1.0),
        /// Where the top of a heap is along the axis [m].
        centre: f64 = Key::new("centre", Kind::Quantity(&LENGTH), "Where the top of a heap is, along the axis")
            .derived("the middle of the region"),
        /// Whether only grains count that touch something.
        touching: bool =
            Key::new("touching", Kind::Flag, "Whether grains must touch something to count: those in flight are no surface")
                .default("true"),
        /// Where.
        region: Region = REGION,
    }

    discharge::Discharge "discharge" "Grains and mass that have passed a plane, less those that came back, and the rate" {
        /// A point on the plane [m].
        point: Vector = Key::new("point", Kind::Vector(&LENGTH), "A point on the plane").default("'origin'"),
        /// Unit direction in which grains pass.
        normal: Vector = Key::new("normal", Kind::Direction, "Direction in which grains pass").default("'-z'"),
        /// Only grains of this group.
        group: Option<String> = GROUP,
        /// Diameters between which passed grains are counted apart [m].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        sizes: Option<Vec<f64>> = SIZES,
    }

    hops::Hops "hops"
    "Hops over a bed, from touch to touch: height, length, times, impact, restitution, contact time" {
        /// What a grain must touch to be on the bed.
        bed: Vec<Bed> = Key::new("bed", Kind::SomeOf(Bed::WORDS), "What a grain must touch to be on the bed")
            .default("['walls', 'fixed-grains']"),
        /// Only grains of this group.
        group: Option<String> = GROUP,
        /// Unit direction in which hops are long.
        along: Vector = Key::new("along", Kind::Direction, "Direction in which hops are long").default("'x'"),
        /// Unit direction in which hops are high.
        up: Vector = Key::new("up", Kind::Direction, "Direction in which hops are high, away from the bed").default("'z'"),
        /// Lower hops are not counted [m].
        lowest: f64 = Key::new("lowest", Kind::Quantity(&LENGTH), "Lower hops are not counted").default("0").at_least(0.0),
        /// After so many hops nothing is written any more.
        most: Option<usize> = Key::new("most", Kind::Whole, "After so many hops nothing is counted any more")
            .at_least(1.0)
            .at_most(1e9)
            .optional(),
    }

    bedload::Bedload "bedload" "Transport of grains along a bed, its fluctuation, and grains that start and stop" {
        /// Horizontal axis.
        axis: Axis = Key::new("axis", Kind::OneOf(Axis::ACROSS), "Horizontal axis of the transport").default("'x'"),
        /// Where; its plan area is what the transport is over.
        region: Region = REGION,
        /// Only grains of this group.
        group: Option<String> = GROUP,
        /// In the plane: grains are spheres, or polygons as thick as they are, in a bed of this width [m]; `None`: areas.
        width: Option<f64> = Key::new(
            "width",
            Kind::Quantity(&LENGTH),
            "In the plane: the grains are spheres, or polygons as thick as they are, in a bed of this width; without it they are flat",
        )
        .above(0.0)
        .optional(),
        /// A grain that is faster begins to move [m/s].
        moving_speed: f64 = Key::new("moving-speed", Kind::Quantity(&SPEED), "A grain that is faster begins to move")
            .default("'10 mm/s'")
            .above(0.0),
        /// A moving grain that is slower has come to rest [m/s].
        resting_speed: f64 = Key::new("resting-speed", Kind::Quantity(&SPEED), "A moving grain that is slower has come to rest")
            .at_least(0.0)
            .derived("half of `moving-speed`"),
        /// Density of the fluid, for the Einstein number [kg/m^3].
        fluid_density: Option<f64> =
            Key::new("fluid-density", Kind::Quantity(&DENSITY), "Density of the fluid; gives the Einstein number")
                .above(0.0)
                .optional(),
        /// Diameters between which grains are counted apart [m].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        sizes: Option<Vec<f64>> = SIZES,
    }

    run_out::RunOut "run-out" "Front, travel and fall of the centre of mass, and the deposit" {
        /// Where the grains run.
        direction: Heading = Key::new("direction", Kind::OneOf(Heading::WORDS), "Where the grains run").default("'x'"),
        /// Share of the mass behind the mass front [-].
        share: f64 = Key::new("share", Kind::Quantity(&NUMBER), "Share of the mass that is behind the mass front")
            .default("0.99")
            .above(0.0)
            .at_most(1.0),
        /// Columns of the deposit.
        bins: usize = Key::new("bins", Kind::Whole, "Columns of the deposit").default("40").at_least(1.0).at_most(1e5),
        /// Only grains of this group.
        group: Option<String> = GROUP,
        /// Where the deposit is.
        region: Region = REGION,
    }

    coordination::Coordination "coordination" "Contacts per grain, with and without rattlers" {
        /// Grains with fewer contacts are rattlers.
        fewest: u32 = Key::new("fewest", Kind::Whole, "Grains with fewer contacts are rattlers; taken out until none is left")
            .default("2")
            .at_least(1.0)
            .at_most(12.0),
        /// Whether contacts with walls count.
        walls: bool = WALLS.default("true"),
        /// Only grains inside.
        region: Option<Region> = WITHIN,
    }

    fabric::Fabric "fabric" "Fabric tensor of the contact normals, its deviator and principal direction" {
        /// Whether contacts with walls count.
        walls: bool = WALLS.default("false"),
        /// Only grains inside.
        region: Option<Region> = WITHIN,
    }

    orientation::Orientation "orientation"
    "How clumps and superellipsoids are turned: nematic order parameter, director, and how many lie at which angle" {
        /// Which axis of a body.
        body_axis: BodyAxis =
            Key::new("body-axis", Kind::OneOf(BodyAxis::WORDS), "Which axis of a body").default("'long'"),
        /// Unit direction that angles are told against.
        along: Vector = Key::new("along", Kind::Direction, "Direction that angles are told against").default("'z'"),
        /// Bins of the angles.
        bins: usize = Key::new("bins", Kind::Whole, "Bins of the angles from 0 to 90 degrees")
            .default("18")
            .at_least(1.0)
            .at_most(1e5),
        /// Only bodies of this group.
        group: Option<String> = GROUP,
        /// Only bodies whose centres are inside.
        region: Option<Region> = WITHIN,
    }

    forces::Forces "forces" "Distribution of normal contact forces, and the share of contacts in force chains" {
        /// Bins of the histogram.
        bins: usize = Key::new("bins", Kind::Whole, "Bins of the histogram").default("30").at_least(1.0).at_most(1e5),
        /// Upper end of the histogram, in mean forces [-].
        largest: f64 = Key::new("largest", Kind::Quantity(&NUMBER), "Upper end of the histogram, in mean forces")
            .default("6")
            .above(1.0),
        /// Whether contacts with walls count.
        walls: bool = WALLS.default("false"),
        /// Only grains inside.
        region: Option<Region> = WITHIN,
    }

    contacts::Contacts "contacts" "Contacts one by one: who touches whom, where, with what force and overlap" {
        /// Whether contacts with walls count.
        walls: bool = WALLS.default("true"),
        /// Only contacts inside.
        region: Option<Region> = WITHIN,
    }

    fragments::Fragments "fragments" "What bonds hold together: how many hold and have broken, into how many pieces, how large the largest is" {}

    segregation::Segregation "segregation" "How well two groups are mixed: Lacey index, and the height of one over the other" {
        /// The two groups.
        groups: [String; 2] =
            Key::new("groups", Kind::Names(Family::Group), "The two groups").derived("the two groups, in the order of their names, where there are two"),
        /// Edge of the cells [m].
        cell: f64 = Key::new("cell", Kind::Quantity(&LENGTH), "Edge of the cells in which grains are counted").above(0.0),
        /// Only grains inside.
        region: Option<Region> = WITHIN,
    }

    mixing::Mixing "mixing" "How well any number of groups are mixed: Lacey index and entropy index" {
        /// The groups; `None`: all.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        groups: Option<Vec<String>> =
            Key::new("groups", Kind::Names(Family::Group), "Only these groups; without it all groups").optional(),
        /// Edge of the cells [m].
        cell: f64 = Key::new("cell", Kind::Quantity(&LENGTH), "Edge of the cells in which grains are counted").above(0.0),
        /// Only grains inside.
        region: Option<Region> = WITHIN,
    }

    residence::Residence "residence" "How long grains stay in a region: residence time with spread, and age of those inside" {
        /// Where grains stay.
        region: Region = STAYS,
        /// Only grains of this group.
        group: Option<String> = GROUP,
    }

    wall_load::WallLoad "wall-load" "Force and torque of the grains on a wall, and its pressure" {
        /// The wall.
        wall: String = Key::new("wall", Kind::Name(Family::Wall), "The wall"),
        /// Only what touches this face of a box.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        face: Option<Face> =
            Key::new("face", Kind::OneOf(Face::WORDS), "Only this face of a box that does not turn; without torque").optional(),
        /// Area for the pressure [m^2].
        area: Option<f64> =
            Key::new("area", Kind::Quantity(&AREA), "Area for the pressure; in the plane times the depth that is meant")
                .above(0.0)
                .optional(),
        /// Unit direction in which the pressure acts on the wall.
        direction: Option<Vector> = Key::new("direction", Kind::Direction, "Direction in which the pressure acts on the wall")
            .derived("of a plane against its normal; else required with `area`"),
    }

    stream::Stream "stream"
    "The water: shear velocity, Shields and Rouse numbers, discharge; velocity, shear, stress and share of water by layers" {
        /// Grains of the Shields and Rouse numbers: of this group.
        group: Option<String> =
            Key::new("group", Kind::Name(Family::Group), "Shields and Rouse numbers are of the grains of this group").optional(),
    }

    stress_path::StressPath "stress-path"
    "Stress and strain of the grains in a box of planes: mean and deviator stress, friction angle, strains, porosity" {
        /// Axis of the axial stress.
        axis: Axis = Key::new("axis", Kind::OneOf(Axis::WORDS), "Axis along which the sample is sheared").default("'z'"),
    }

    track::Track "track" "Position, velocity and spin of some grains; positions go on across periodic ends" {
        /// Their numbers, among all or in the group.
        ids: Vec<u32> = Key::new("ids", Kind::Wholes, "Numbers of the grains, from 0 in the order of the groups' names")
            .at_least(0.0)
            .at_most(4e9),
        /// The group that they are counted in.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        group: Option<String> =
            Key::new("group", Kind::Name(Family::Group), "The group that the numbers count in, from its first grain").optional(),
    }

    spectrum::Spectrum "spectrum"
    "Spectra of a host by Welch's method: accelerations of structure and base, force on the base, transmissibility" {
        /// The host.
        host: String = Key::new("host", Kind::Name(Family::Host), "The host").derived("the only host"),
        /// Lowest and highest frequency [Hz].
        frequency: [f64; 2] = Key::new("frequency", Kind::Ends(&FREQUENCY), "Lowest and highest frequency").above(0.0),
        /// Length of the segments [s].
        segment: f64 = Key::new(
            "segment",
            Kind::Quantity(&TIME),
            "Length of the segments that are averaged; frequencies are the multiples of one over it",
        )
        .above(0.0),
    }

    resonance::Resonance "resonance" "Where the dwell of a host has come to: frequency, lag, amplitude, and the mass that the shift means" {
        /// The host.
        host: String = Key::new("host", Kind::Name(Family::Host), "The host, which has a `dwell`").derived("the only host"),
    }
}
