//! The answer: frames of named columns, the state of a run, and the files they are written to.

pub mod frame;
pub mod state;

pub use frame::{Column, Frame, Kind, Values};
pub use state::State;
