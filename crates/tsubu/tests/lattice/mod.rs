//! The damper automaton, judged by its physics.

mod books;
mod coupling;
mod free;
mod plans;
mod refusal;
