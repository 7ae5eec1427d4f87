//! Contact laws: stacks of parts that work on chunks of touching pairs.
//!
//! One file a part. A part knows neither walls nor threads nor dimension: grain-grain and grain-wall contacts reach it as
//! rows of the same [`chunk::Chunk`]. Beside its own file a part stands here alone: its `mod` line, the arm of its family that
//! puts it into a law, its text in [`ABOUT`].
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
pub mod pair;
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
mod luding;
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
use crate::mutation::{Mutation, mutated};
pub use chunk::Chunk;
pub use law::Law;
pub use pair::Pair;
use part::Part;
pub use table::Table;
use tsubu_scene::plan::{Cohesion, Contact, Damping, Film, Normal, Rolling, Tangential, Twisting};

/// A part, where a scene asks for one.
type Chosen = Option<Box<dyn Part>>;

/// The parts that a `[contact]` asks for.
fn parts(contact: &Contact) -> Vec<Box<dyn Part>> {
    let parts = [
        Some(normal(&contact.normal)),
        cohesion(&contact.cohesion),
        damping(contact),
        tangential(&contact.tangential),
        rolling(&contact.rolling),
        twisting(&contact.twisting),
        film(contact),
    ];
    parts.into_iter().flatten().collect()
}

fn normal(normal: &Normal) -> Box<dyn Part> {
    match *normal {
        Normal::Hertz {} => Box::new(hertz::Hertz),
        Normal::Hooke { stiffness } => {
            Box::new(hooke::Hooke { stiffness: mutated(Mutation::LinearStiffness, stiffness) })
        }
        Normal::Luding { stiffness, unloading_ratio, adhesion_ratio, plasticity_depth } => Box::new(luding::Luding {
            stiffness: mutated(Mutation::LinearStiffness, stiffness),
            unloading: unloading_ratio,
            adhesion: adhesion_ratio,
            depth: plasticity_depth,
        }),
    }
}

fn cohesion(cohesion: &Cohesion) -> Chosen {
    match *cohesion {
        Cohesion::None {} => None,
        Cohesion::Dmt {} => Some(Box::new(dmt::part())),
        Cohesion::Jkr {} => Some(Box::new(jkr::Jkr)),
        Cohesion::Sjkr {} => Some(Box::new(sjkr::part())),
        Cohesion::Constant {} => Some(Box::new(cohesion_constant::part())),
    }
}

fn damping(contact: &Contact) -> Chosen {
    let attraction = contact.attraction;
    let hertz = matches!(contact.normal, Normal::Hertz {});
    let viscous = |form, reference_speed| -> Chosen {
        Some(Box::new(viscous::Viscous { form, hertz, attraction, reference_speed }))
    };
    let exponent = if hertz { 1.5 } else { 1.0 };
    let told = |dashpot| -> Chosen { Some(Box::new(dashpot::Told { dashpot, attraction, exponent })) };
    match contact.damping {
        Damping::None {} => None,
        Damping::Sqrt { reference_speed } => viscous(viscous::Form::Sqrt, reference_speed),
        Damping::Quarter {} => viscous(viscous::Form::Quarter, 1.0),
        Damping::Linear { reference_speed } => viscous(viscous::Form::Linear, reference_speed),
        Damping::Rate { rate } => told(dashpot::Dashpot::Rate(rate)),
        Damping::Viscoelastic { coefficient } => told(dashpot::Dashpot::Disc(coefficient)),
        Damping::Dashpot { coefficient } => told(dashpot::Dashpot::Constant(coefficient)),
    }
}

fn tangential(tangential: &Tangential) -> Chosen {
    match *tangential {
        Tangential::None {} => None,
        Tangential::Coulomb { smoothing_speed } => Some(Box::new(coulomb::part(smoothing_speed))),
        Tangential::Mindlin { form, damping } => Some(Box::new(mindlin::Mindlin { form, damping })),
        Tangential::Spring { ratio, damping, cohesion } => {
            let ratio = mutated(Mutation::TangentialStiffness, ratio);
            Some(Box::new(spring::Spring { ratio, damping, cohesion }))
        }
    }
}

fn rolling(rolling: &Rolling) -> Chosen {
    match *rolling {
        Rolling::None {} => None,
        Rolling::Constant { smoothing_speed } => Some(Box::new(rolling_constant::part(smoothing_speed))),
        Rolling::Viscous { coefficient } => Some(Box::new(rolling_viscous::part(coefficient))),
        Rolling::Epsd { ratio, damping_ratio } => Some(Box::new(epsd::Epsd { told: Some([ratio, damping_ratio]) })),
        Rolling::Epsd2 {} => Some(Box::new(epsd::Epsd { told: None })),
        Rolling::Spring { stiffness, damping } => Some(Box::new(rolling_spring::RollingSpring { stiffness, damping })),
        Rolling::ContactWidth { smoothing_speed } => Some(Box::new(contact_width::part(smoothing_speed))),
    }
}

fn twisting(twisting: &Twisting) -> Chosen {
    match *twisting {
        Twisting::None {} => None,
        Twisting::Sliding { smoothing_spin } => Some(Box::new(twisting_sliding::part(smoothing_spin))),
        Twisting::Spring {} => Some(Box::new(twisting_spring::TwistingSpring)),
    }
}

fn film(contact: &Contact) -> Chosen {
    match contact.film {
        Film::None {} => None,
        Film::Lubrication { roughness, reach, viscosity, in_contact } => {
            let beside_damping = contact.damping != Damping::None {};
            let viscosity = mutated(Mutation::FilmViscosity, viscosity);
            Some(Box::new(lubrication::Lubrication { roughness, reach, viscosity, in_contact, beside_damping }))
        }
    }
}

/// What the parts of contact laws are.
pub const ABOUT: &[&About] = &[
    &hertz::ABOUT,
    &hooke::ABOUT,
    &luding::ABOUT,
    &viscous::SQRT,
    &viscous::QUARTER,
    &viscous::LINEAR,
    &dashpot::RATE,
    &dashpot::VISCOELASTIC,
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
