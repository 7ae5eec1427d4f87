//! Studies: many runs that answer one question.

pub mod apart;
pub mod atlas;
pub mod calibrate;
pub mod cases;
pub mod compare;
pub mod design;
pub mod fidelity;
mod journal;
mod journaled;
mod kept;
pub mod predict;
mod ranges;
pub mod response;
pub mod ring_down;
mod summary;
pub mod surrogate;
pub mod sweep;
pub mod variant;
