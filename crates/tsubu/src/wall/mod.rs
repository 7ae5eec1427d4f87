//! Walls: their geometry, and who carries them.

pub mod carrier;
pub mod plane;

pub use carrier::Carrier;
pub use plane::Plane;
