//! The discrete element method.

mod drawn;
pub mod engine;
mod fill;
mod gates;
mod integrate;
mod keep;
mod memory;
mod orientation;
mod output;
mod place;
mod room;
mod rows;
mod settle;
mod sieve;
pub mod sizes;
mod sources;
mod start;
mod step;
mod sweep;
mod touch;
mod touches;
mod wet;

pub use engine::DemEngine;
