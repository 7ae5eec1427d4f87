//! Words that keys of watches take: axes, faces, quantities, beds, kernels.

use crate::key::Word;
use crate::plan::Vector;
use serde::{Deserialize, Serialize};

const X: Word = Word { name: "x", about: "to the right" };
const Y: Word = Word { name: "y", about: "into the picture, only in space" };
const Z: Word = Word { name: "z", about: "up" };

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
    /// What a scene may say.
    pub(crate) const WORDS: &'static [Word] = &[
        Word { name: "left", about: "at the low end of x" },
        Word { name: "right", about: "at the high end of x" },
        Word { name: "front", about: "at the low end of y, only in space" },
        Word { name: "back", about: "at the high end of y, only in space" },
        Word { name: "floor", about: "at the low end of z" },
        Word { name: "lid", about: "at the high end of z" },
    ];

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
    /// What a scene may say.
    pub(crate) const WORDS: &'static [Word] = &[X, Y, Z];
    /// What a scene may say of a horizontal one.
    pub(crate) const ACROSS: &'static [Word] = &[X, Y];

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
    /// What a scene may say.
    pub(crate) const WORDS: &'static [Word] = &[
        Word { name: "x", about: "to the right" },
        Word { name: "-x", about: "to the left" },
        Word { name: "y", about: "into the picture, only in space" },
        Word { name: "-y", about: "out of the picture, only in space" },
    ];

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

impl Quantity {
    /// What a scene may say.
    pub(crate) const WORDS: &'static [Word] = &[
        Word { name: "solid-fraction", about: "share of the volume that grains fill, in the plane of the area" },
        Word { name: "velocity", about: "mean velocity, by mass" },
        Word { name: "granular-temperature", about: "mean square of a component of the velocity about the mean" },
        Word { name: "coordination", about: "contacts per grain, those with walls among them" },
        Word { name: "spin", about: "mean spin, by moment of inertia" },
    ];
}

/// Which axis of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BodyAxis {
    /// Of the least moment of inertia.
    Long,
    /// Of the largest moment of inertia.
    Short,
}

impl BodyAxis {
    /// What a scene may say.
    pub(crate) const WORDS: &'static [Word] = &[
        Word { name: "long", about: "of the least moment of inertia: along a rod" },
        Word {
            name: "short",
            about: "of the largest moment of inertia: across a disc; in the plane across the long one",
        },
    ];
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

impl Bed {
    /// What a scene may say.
    pub(crate) const WORDS: &'static [Word] = &[
        Word { name: "walls", about: "walls of any shape" },
        Word { name: "fixed-grains", about: "frozen and driven grains" },
        Word { name: "free-grains", about: "grains that forces move" },
    ];
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

impl Kernel {
    /// What a scene may say.
    pub(crate) const WORDS: &'static [Word] = &[
        Word { name: "gaussian", about: "exp(-r^2 / 2 w^2), cut where nothing is left at 8 w" },
        Word { name: "lucy", about: "(1 + 3 r/w) (1 - r/w)^3, zero from w on" },
    ];
}
