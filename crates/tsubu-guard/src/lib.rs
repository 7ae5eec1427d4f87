//! Standing guards: what is held against tsubu by drawing at random, again and again.
//!
//! ```text
//! (seed, kind, number) -> draw -> Bundle -> judge -> held, or what went wrong
//! ```
//!
//! A case is a [`Bundle`] of files, drawn from a seed so that it can be drawn again. A worker of its own judges case
//! after case ([`work`]), and whoever started it ([`fuzz`]) notices panics, hangs, aborts and dying for want of memory.
//! What was found is kept in `corpus/`, and a test judges it again each time ([`corpus`]).
//!
//! Two other guards: [`kills`], runs that are killed at random moments and resumed; [`variants`], scenes computed in all ways that must not matter.

pub mod bundle;
pub mod corpus;
pub mod draw;
pub mod fuzz;
pub mod kills;
pub mod kind;
pub mod limits;
pub mod outcome;
pub mod variants;
pub mod work;

mod checkpoints;
mod checks;
mod commands;
mod data;
mod nasty;
mod reading;
mod scenes;
mod seeds;
mod spoil;
mod spots;
