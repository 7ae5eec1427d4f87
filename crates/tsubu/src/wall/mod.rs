//! Walls: their geometry, and who carries them.

pub mod carrier;

pub use carrier::Carrier;
