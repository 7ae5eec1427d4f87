//! Who is near whom.

pub mod candidates;
pub mod drift;
pub mod grid;

pub use candidates::{Candidates, Search};
