//! The state of grains: what a checkpoint holds. Everything else in an engine is scratch.

pub mod columns;
pub mod grains;
pub mod sphere;

pub use grains::{Grain, Grains, moved_along};
