//! The question: text -> [`plan::Plan`], with all complaints at once.

pub mod plan;
