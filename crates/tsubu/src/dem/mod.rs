//! The discrete element method: spheres that push and rub where they overlap.

pub mod engine;
mod integrate;
mod place;
mod settle;
mod step;
mod touch;

pub use engine::DemEngine;
