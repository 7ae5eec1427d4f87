//! The models that Sakaguchi et al. (2001) review, each against what it must show.

mod fhp;

pub(super) use fhp::{channel, collisions, sound, viscosity};
