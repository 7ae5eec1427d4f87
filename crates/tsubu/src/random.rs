//! Random numbers that depend on what they are for, not on who asked first.
//!
//! Philox4x32-10 (Salmon, Moraes, Dror, Shaw 2011) as a function of (seed, purpose, entity, step): any thread may ask for
//! any number in any order and gets the same bits.

use crate::mutation::{Mutation, left_out};
pub(crate) use tsubu_scene::philox::{MULTIPLIERS, WEYL};
pub use tsubu_scene::philox::{philox, unit};

/// What a number is for; keeps streams apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Placing grains at the start.
    Placement = 1,
    /// Direction of a lattice rebound.
    Rebound = 2,
    /// Who gets a contested lattice cell.
    Lottery = 3,
    /// Order of lattice collisions.
    Order = 4,
    /// Diameters of grains.
    Size = 5,
    /// Grains that come in during a run.
    Stream = 6,
    /// Turbulent fluctuation of the water around a grain.
    Fluctuation = 7,
    /// Which way a lattice collision turns.
    Turn = 8,
    /// Where a force acts on a lattice gas.
    Force = 9,
    /// Which way a grain or a void of a lattice model goes.
    Side = 16,
    /// Whether an outlet of a lattice model takes a grain.
    Outlet = 17,
    /// Order and side of the moves of grains made of lattice points.
    Move = 18,
    /// Values of keys that are tried in a calibration.
    Calibration = 19,
    /// How grains that are no spheres are turned at the start.
    Orientation = 20,
    /// Strengths of bonds.
    BondStrength = 22,
    /// Frequencies and phases of the sines of a random drive, drawn where the scene is read.
    Drive = tsubu_scene::philox::DRIVE as isize,
}

impl Purpose {
    /// Whether it decides how something goes on on a lattice, and not where it begins.
    fn moves_on_a_lattice(self) -> bool {
        use Purpose::{Force, Lottery, Move, Order, Outlet, Rebound, Side, Turn};
        matches!(self, Rebound | Lottery | Order | Turn | Force | Side | Outlet | Move)
    }
}

/// Four random words for one entity at one step.
#[inline]
pub fn words(seed: u64, purpose: Purpose, entity: u32, step: u64) -> [u32; 4] {
    philox([entity, purpose as u32, step as u32, (step >> 32) as u32], key(seed, purpose))
}

/// The key of a stream of numbers.
#[inline]
pub(crate) fn key(seed: u64, purpose: Purpose) -> [u32; 2] {
    let seed = if purpose.moves_on_a_lattice() && left_out(Mutation::LastBit) { seed ^ (1 << 63) } else { seed };
    [seed as u32, (seed >> 32) as u32 ^ ((purpose as u32) << 24)]
}
