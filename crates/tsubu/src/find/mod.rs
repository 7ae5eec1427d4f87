//! Who may touch whom.

pub mod candidates;
pub mod grid;

pub use candidates::Candidates;
