//! The water that grains are in. What the choices are stands in the table of keys and beside their code: `tsubu explain`.

use serde::{Deserialize, Serialize};

/// Water, or any other fluid, and what it does to grains.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Water {
    /// Density rho [kg/m^3].
    pub density: f64,
    /// Kinematic viscosity nu [m^2/s].
    pub viscosity: f64,
    /// Height z up to which there is water [m]; `None`: everywhere.
    pub surface: Option<f64>,
    /// Added mass over the mass of the displaced water [-].
    pub added_mass: f64,
    /// Which stress carries the grains.
    pub buoyancy: Buoyancy,
    /// Grains may be lighter than the water.
    pub float: bool,
    /// How the water moves.
    pub flow: Flow,
    /// What neighbours add to the drag.
    pub hindrance: Hindrance,
    /// Drag coefficient.
    pub drag: Drag,
    /// Torque on spin.
    pub torque: Torque,
    /// Forces across the motion relative to the water.
    pub lift: Vec<Lift>,
    /// Turbulent fluctuation.
    pub fluctuation: Option<Fluctuation>,
}

/// Turbulence as grains on their way see it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Fluctuation {
    /// Root-mean-square velocity over the shear velocity, mean of the squares of the three directions [-].
    pub strength: f64,
    /// What each direction has of it.
    pub directions: Directions,
    /// Lagrangian time: the integral of the correlation [s].
    pub time: f64,
}

/// What each direction has of a fluctuation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Directions {
    /// All the same.
    Even,
    /// As over a rough bed: most along the stream, least upwards.
    Stream,
}

impl Directions {
    /// Strengths along, across and up over that of the fluctuation; the mean of their squares is 1. `Stream`: 2.30, 1.63 and 1.27
    /// (Nezu and Nakagawa 1993) over 1.78.
    pub fn shares(self) -> [f64; 3] {
        match self {
            Self::Even => [1.0; 3],
            Self::Stream => {
                let measured = [2.30, 1.63, 1.27f64];
                let mean = (measured.iter().map(|s| s * s).sum::<f64>() / 3.0).sqrt();
                measured.map(|strength| strength / mean)
            }
        }
    }
}

/// Which part of the stress in the water carries the grains.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Buoyancy {
    /// `water.buoyancy.vertical`.
    Vertical,
    /// `water.buoyancy.normal`.
    Normal,
}

/// How the water moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Flow {
    /// `water.flow.still`.
    Still {},
    /// `water.flow.log-law`.
    LogLaw {
        /// U* [m/s].
        shear_velocity: f64,
        /// k [m].
        roughness: f64,
        /// Height z where Z = 0 [m].
        zero_level: f64,
    },
    /// `water.flow.table`.
    Table {
        /// Heights z [m], rising.
        height: Vec<f64>,
        /// Velocities [m/s].
        velocity: Vec<f64>,
    },
    /// `water.flow.coupled`.
    Coupled {
        /// Height z where the water begins [m].
        bottom: f64,
        /// Height z where it ends [m], without stress: always, or at time 0.
        top: f64,
        /// Number of layers.
        layers: usize,
        /// Plan area of a layer [m^2].
        area: f64,
        /// Equivalent roughness of the bottom [m].
        roughness: f64,
        /// U* that the drive would hold without grains [m/s]; `None`: gravity along x drives.
        shear_velocity: Option<f64>,
        /// Discharge of water per width that is held, or feeds a reach with a free surface [m^2/s].
        discharge: Option<f64>,
        /// Whether the surface finds its level.
        lid: Lid,
        /// Length of a reach with a free surface that is fed [m].
        reach: Option<f64>,
        /// The stream at time 0.
        start: StreamStart,
    },
    /// `water.flow.column`.
    Column {
        /// Height z where the column begins [m].
        bottom: f64,
        /// Height z where it ends [m].
        top: f64,
        /// Number of layers.
        layers: usize,
        /// Plan area [m^2].
        area: f64,
        /// Superficial velocity [m/s].
        velocity: f64,
    },
}

impl Flow {
    /// Bottom and top [m] of a flow in layers.
    pub fn ends(&self) -> Option<[f64; 2]> {
        match self {
            Self::Coupled { bottom, top, .. } | Self::Column { bottom, top, .. } => Some([*bottom, *top]),
            Self::Still {} | Self::LogLaw { .. } | Self::Table { .. } => None,
        }
    }
}

/// What ends a stream above.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Lid {
    /// A lid that stays where it is.
    Rigid,
    /// A surface that finds its level.
    Free,
}

/// A stream at time 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StreamStart {
    /// The log law that the drive would hold without grains.
    LogLaw,
    /// At rest.
    Still,
}

/// What the neighbours of a grain add to its drag; e is the share of the volume that grains leave to the water.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Hindrance {
    /// `water.hindrance.none`.
    None {},
    /// `water.hindrance.di-felice`.
    DiFelice {},
    /// `water.hindrance.richardson-zaki`.
    RichardsonZaki {
        /// The exponent [-].
        exponent: f64,
    },
}

/// The drag coefficient C against the Reynolds number Re = |U - u| d/nu; the force is C rho/2 (pi/4) d^2 |U - u| (U - u).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Drag {
    /// `water.drag.none`.
    None {},
    /// `water.drag.constant`.
    Constant {
        /// C [-].
        coefficient: f64,
    },
    /// `water.drag.stokes-newton`.
    StokesNewton {
        /// C of large Re [-].
        coefficient: f64,
    },
    /// `water.drag.schiller-naumann`.
    SchillerNaumann {},
    /// `water.drag.gidaspow`.
    Gidaspow {},
    /// `water.drag.abraham`.
    Abraham {},
    /// `water.drag.haider-levenspiel`.
    HaiderLevenspiel {},
}

impl Drag {
    /// Its name in a scene, where it is a law of spheres alone.
    pub fn of_spheres(&self) -> Option<&'static str> {
        match self {
            Self::None {} | Self::Constant { .. } | Self::HaiderLevenspiel {} => None,
            Self::StokesNewton { .. } => Some("stokes-newton"),
            Self::SchillerNaumann {} => Some("schiller-naumann"),
            Self::Gidaspow {} => Some("gidaspow"),
            Self::Abraham {} => Some("abraham"),
        }
    }
}

/// The torque of the water on a grain that turns at another spin than it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Torque {
    /// `water.torque.none`.
    None {},
    /// `water.torque.stokes`.
    Stokes {},
    /// `water.torque.finite-reynolds`.
    FiniteReynolds {},
}

/// A force across the motion relative to the water.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Lift {
    /// `water.lift.saffman`.
    Saffman,
    /// `water.lift.saffman-mei`.
    SaffmanMei,
    /// `water.lift.magnus`.
    Magnus,
    /// `water.lift.magnus-oesterle-dinh`.
    MagnusOesterleDinh,
}
