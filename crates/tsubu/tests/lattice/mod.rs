//! The damper automaton, judged by its physics; models with one grain a site, by their invariants.

mod books;
mod coupling;
mod free;
mod methods;
mod plans;
mod refusal;
mod sites;
