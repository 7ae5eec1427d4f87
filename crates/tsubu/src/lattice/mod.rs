//! Cellular automata on a triangular lattice.
//!
//! [`direction`], [`grid`] and [`fixed`] are the kit that any lattice model can use; [`damper`] is the automaton of
//! Komatsuzaki, Sato, Iwata and Morishita (2003) for balls in a shaken box, one file per family of rules; [`engine`] runs it
//! from a plan, together with the structure that carries the box.

pub mod build;
pub mod damper;
pub mod direction;
pub mod engine;
pub mod fixed;
pub mod gas;
pub mod grid;
pub mod start;
