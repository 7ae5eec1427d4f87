//! The damper automaton, judged by its physics; models with grains on sites, by their invariants.

mod books;
mod coupling;
mod free;
mod gases;
mod methods;
mod plans;
mod refusal;
mod sites;
mod told;
