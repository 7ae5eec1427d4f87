//! What can come of a case.

/// What came of a case that held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// What was given was taken.
    Accepted,
    /// What was given was refused, with reasons.
    Refused,
}
