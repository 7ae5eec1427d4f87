//! Random numbers that depend on what they are for, not on who asked first.
//!
//! Philox4x32-10 (Salmon, Moraes, Dror, Shaw 2011) as a function of (seed, purpose, entity, step): any thread may ask for
//! any number in any order and gets the same bits.

use crate::mutation::{Mutation, left_out};

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
    BondStrength = 21,
}

impl Purpose {
    /// Whether it decides how something goes on on a lattice, and not where it begins.
    fn moves_on_a_lattice(self) -> bool {
        use Purpose::{Force, Lottery, Move, Order, Outlet, Rebound, Side, Turn};
        matches!(self, Rebound | Lottery | Order | Turn | Force | Side | Outlet | Move)
    }
}

pub(crate) const MULTIPLIERS: [u32; 2] = [0xD251_1F53, 0xCD9E_8D57];
pub(crate) const WEYL: [u32; 2] = [0x9E37_79B9, 0xBB67_AE85];

/// Philox4x32-10: ten rounds of the counter under the key.
#[inline]
pub fn philox(mut counter: [u32; 4], mut key: [u32; 2]) -> [u32; 4] {
    for round in 0..10 {
        if round > 0 {
            key[0] = key[0].wrapping_add(WEYL[0]);
            key[1] = key[1].wrapping_add(WEYL[1]);
        }
        let first = u64::from(counter[0]) * u64::from(MULTIPLIERS[0]);
        let second = u64::from(counter[2]) * u64::from(MULTIPLIERS[1]);
        counter = [
            (second >> 32) as u32 ^ counter[1] ^ key[0],
            second as u32,
            (first >> 32) as u32 ^ counter[3] ^ key[1],
            first as u32,
        ];
    }
    counter
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

/// A number in [0, 1) from two words.
#[inline]
pub fn unit(high: u32, low: u32) -> f64 {
    let bits = (u64::from(high) << 32 | u64::from(low)) >> 11;
    bits as f64 / (1u64 << 53) as f64
}

#[cfg(test)]
mod tests {
    use super::philox;

    /// Known answers published with Random123 (kat_vectors, philox4x32-10).
    #[test]
    fn philox_matches_the_published_vectors() {
        let zero = philox([0; 4], [0; 2]);
        assert_eq!(zero, [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]);
        let ones = philox([u32::MAX; 4], [u32::MAX; 2]);
        assert_eq!(ones, [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]);
        let pi = philox([0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344], [0xa409_3822, 0x299f_31d0]);
        assert_eq!(pi, [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1]);
    }
}
