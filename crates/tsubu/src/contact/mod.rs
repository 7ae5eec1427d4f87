//! Contact laws: stacks of parts that work on chunks of touching pairs.
//!
//! One file a part. A part knows neither walls nor threads nor dimension: grain-grain and grain-wall contacts reach it as
//! rows of the same [`chunk::Chunk`].
//!
//! # How a part is made fast
//!
//! The work of a part is a free function over the rows, under `#[multiversion(targets = "simd")]`: it is compiled for
//! several instruction sets, and the one of the machine is chosen when the program runs. The loop must be one that the
//! compiler can write with vectors: columns indexed by `0..chunk.rows()`; no branch that is not a choice between two
//! numbers; nothing called that cannot be inlined (`#[inline(always)]` on helpers; roots from `root.rs`); and
//! `least`, `most` in place of `f64::min`, `f64::max`. The bits are the same whatever the set, as Rust never fuses a
//! product and a sum of its own accord.
//!
//! Hertz with the quarter damping and Mindlin takes 12.7 ns a row with SSE2, 5.9 ns with AVX2 and 3.2 ns with AVX-512 (EPYC,
//! Zen 5, full chunks in the cache); JKR, the longest, 43 ns, 11 ns and 5.6 ns. AVX-512 is used from Ice Lake on, where it no
//! longer slows the clock.

#![allow(clippy::inline_always, reason = "a call inside a row would end the vector code of its loop")]

pub mod calibrate;
pub mod chunk;
pub mod law;
pub mod part;
pub mod table;

mod cohesion_constant;
mod contact_width;
mod coulomb;
mod dashpot;
mod dmt;
mod epsd;
mod hertz;
mod hooke;
mod jkr;
mod lubrication;
mod mindlin;
mod rolling_constant;
mod rolling_spring;
mod rolling_viscous;
mod root;
mod sjkr;
mod slider;
mod spring;
mod twisting_sliding;
mod twisting_spring;
mod viscous;

use crate::about::About;
pub use chunk::Chunk;
pub use law::Law;
pub use table::{Pair, Table};

/// What the parts of contact laws are.
pub const ABOUT: &[&About] = &[
    &hertz::ABOUT,
    &hooke::ABOUT,
    &viscous::SQRT,
    &viscous::QUARTER,
    &viscous::LINEAR,
    &dashpot::RATE,
    &dashpot::DASHPOT,
    &coulomb::ABOUT,
    &mindlin::INCREMENTAL,
    &mindlin::SECANT,
    &spring::ABOUT,
    &rolling_constant::ABOUT,
    &rolling_viscous::ABOUT,
    &epsd::EPSD,
    &epsd::EPSD2,
    &rolling_spring::ABOUT,
    &contact_width::ABOUT,
    &twisting_sliding::ABOUT,
    &twisting_spring::ABOUT,
    &dmt::ABOUT,
    &jkr::ABOUT,
    &sjkr::ABOUT,
    &cohesion_constant::ABOUT,
    &lubrication::ABOUT,
];
