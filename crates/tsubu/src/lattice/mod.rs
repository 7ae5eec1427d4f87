//! Cellular automata on lattices.
//!
//! The kit: [`direction`], [`grid`], [`shape`] (grains of many points), [`stage`] (a scene's walls on the lattice), [`remarks`] and
//! [`fixed`] for the triangular lattice with gravity along one of its axes, [`sheet`] for lattices with level rows. [`damper`] is the automaton of
//! Komatsuzaki, Sato, Iwata and Morishita (2003) for balls in a shaken box, one file per family of rules; [`engine`] runs it
//! from a plan, together with the structure that carries the box. Models of beds and piles, a file each: [`litwiniszyn`] and
//! [`caram_hong`] (voids that walk up), [`savage`] (a chute that sorts), [`gutt_haff`] (velocities and offsets on nodes),
//! [`hemmingsson_herrmann`] (forces handed down); [`site`] runs them from a plan. [`gas`] has the lattice gases.

pub mod build;
pub mod caram_hong;
pub mod damper;
pub mod direction;
pub mod engine;
pub mod fixed;
pub mod gas;
pub mod grid;
pub mod gutt_haff;
pub mod hemmingsson_herrmann;
pub mod litwiniszyn;
pub(crate) mod reach;
pub mod remarks;
pub mod savage;
pub mod shape;
pub mod sheet;
pub mod site;
pub mod stage;
pub mod start;

use crate::about::About;

/// What the methods on lattices are, but CL-CA.
pub(crate) const ABOUT: &[&About] = &[
    &damper::ABOUT,
    &litwiniszyn::ABOUT,
    &caram_hong::ABOUT,
    &savage::ABOUT,
    &gutt_haff::ABOUT,
    &hemmingsson_herrmann::ABOUT,
    &gas::ABOUT,
    &gas::grains::ABOUT,
    &gas::elongated::ABOUT,
    &gas::pile::ABOUT,
];
