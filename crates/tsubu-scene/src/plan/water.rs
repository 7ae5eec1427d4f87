//! The water that grains are in.

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
    /// Pressure and shear stress of a uniform stream, - rho V g.
    Vertical,
    /// Pressure alone, normal to the stream.
    Normal,
}

/// How the water moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Flow {
    /// Not at all.
    Still {},
    /// U = U* (8.5 + 5.75 log10(Z/k)) along x, Z = z - zero level.
    LogLaw {
        /// U* [m/s].
        shear_velocity: f64,
        /// k [m].
        roughness: f64,
        /// Height z where Z = 0 [m].
        zero_level: f64,
    },
    /// Straight lines between points, along x.
    Table {
        /// Heights z [m], rising.
        height: Vec<f64>,
        /// Velocities [m/s].
        velocity: Vec<f64>,
    },
    /// Layers that give to the grains and take from them.
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
    /// Upwards with `velocity` over the share that grains leave to the water.
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
    /// Nothing.
    None {},
    /// Re with e |U - u|, force times e^(2 - b).
    DiFelice {},
    /// Force times e^-exponent.
    RichardsonZaki {
        /// The exponent [-].
        exponent: f64,
    },
}

/// The drag coefficient C against the Reynolds number Re = |U - u| d/nu; the force is C rho/2 (pi/4) d^2 |U - u| (U - u).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Drag {
    /// C = 0.
    None {},
    /// C = coefficient.
    Constant {
        /// C [-].
        coefficient: f64,
    },
    /// C = coefficient + 24/Re.
    StokesNewton {
        /// C of large Re [-].
        coefficient: f64,
    },
    /// C = 24/Re (1 + 0.15 Re^0.687) up to Re = 1000, 0.44 above.
    SchillerNaumann {},
    /// Ergun's bed below e = 0.8, Wen and Yu's above.
    Gidaspow {},
    /// C = (0.63 + 4.8/sqrt(Re))^2.
    Abraham {},
}

/// The torque of the water on a grain that turns at another spin than it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Torque {
    /// None.
    None {},
    /// 8 pi mu r^3 (Omega - w).
    Stokes {},
    /// The same beyond slow spin (Dennis, Singh and Ingham 1980).
    FiniteReynolds {},
}

/// A force across the motion relative to the water.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Lift {
    /// By shear, slow (Saffman 1965).
    Saffman,
    /// By shear, slow or fast (Mei 1992).
    SaffmanMei,
    /// By spin, slow (Rubinow and Keller 1961).
    Magnus,
    /// By spin, slow or fast (Oesterle and Dinh 1998).
    MagnusOesterleDinh,
}
