//! Settings of the methods.

use super::{Region, Vector};
use crate::cells::Cells;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

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
    /// Cells from the middle of a ball to its rim: 0, a ball is one cell; r, a hexagon of 3 r^2 + 3 r + 1 cells.
    pub ball_radius: usize,
}

impl Lattice {
    /// Distance of lattice points [m] for balls of a diameter [m]: as many balls fit into an area as where each has one cell.
    pub fn spacing(&self, diameter: f64) -> f64 {
        let cells = 3 * self.ball_radius * (self.ball_radius + 1) + 1;
        diameter / (cells as f64).sqrt()
    }
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

/// Settings of CL-CA: grains made of many lattice points (Sakaguchi 2001).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct ClCa {
    /// Distance of lattice points [m]; `None`: the smallest grains become hexagons of radius 1.
    pub spacing: Option<f64>,
    /// A grain falls this far in the time of free fall [m]; `None`: the height of the lattice.
    pub fall_height: Option<f64>,
    /// The piece of the lattice that grains can reach; `None`: around walls and grains.
    pub region: Option<Region>,
    /// How grains find room.
    pub rule: ClCaRule,
    /// Steps of the past whose sideways moves choose the side.
    pub memory: u32,
    /// Grains that cannot move turn by 60 degrees where that lets them move on.
    pub turning: bool,
    /// Shaking by gravity that points up and down in turn.
    pub gravity_switch: Option<GravitySwitch>,
    /// Shapes by the names of groups.
    #[serde(default)]
    pub shapes: BTreeMap<String, GrainPoints>,
}

/// Rule by which grains made of lattice points move.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ClCaRule {
    /// Passive where a wall or a driven group moves, else active.
    Automatic,
    /// A grain moves if there is room.
    Active,
    /// Walls and driven grains push; grains move out of overlaps.
    Passive,
}

/// Gravity up for some steps, then down for some.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct GravitySwitch {
    /// Steps with gravity down.
    pub down: u32,
    /// Steps with gravity up; they come first.
    pub up: u32,
}

/// The lattice points of a grain. Vectors hold [column, 0, half spacings up] as whole numbers with an even sum.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum GrainPoints {
    /// All points within a distance of the centre.
    Hexagon {
        /// That distance [spacings].
        radius: u32,
    },
    /// All points on or inside a closed line along the lattice.
    Polygon {
        /// Its corners.
        corners: Vec<Vector>,
    },
    /// Points one by one.
    Points {
        /// The points.
        at: Vec<Vector>,
    },
}

impl GrainPoints {
    /// The cells of such a grain; `None`: it is none.
    pub fn cells(&self) -> Option<Cells> {
        match self {
            Self::Hexagon { radius } => Some(Cells::hexagon(*radius as usize)),
            Self::Polygon { corners } => Cells::polygon(&whole(corners)?),
            Self::Points { at } => Cells::new(&whole(at)?),
        }
    }

    /// The key that holds what may be wrong with it.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Hexagon { .. } => "hexagon",
            Self::Polygon { .. } => "polygon.corners",
            Self::Points { .. } => "points.at",
        }
    }
}

/// Whole numbers, if they are.
fn whole(points: &[Vector]) -> Option<Vec<[i64; 2]>> {
    let number = |x: f64| (x.fract() == 0.0 && x.abs() < 1e6).then_some(x as i64);
    points.iter().map(|[h, _, k]| Some([number(*h)?, number(*k)?])).collect()
}

/// What is wrong where there are no cells.
pub const NO_GRAIN: &str = "this is no grain: it needs whole numbers [column, half spacings up] with even sums, no point twice, all points connected, and for a polygon sides along the lattice";
