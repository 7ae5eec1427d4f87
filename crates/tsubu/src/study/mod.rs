//! Studies: many runs that answer one question.

pub mod cases;
pub mod compare;
pub mod response;
pub mod ring_down;
pub mod sweep;
pub mod variant;
