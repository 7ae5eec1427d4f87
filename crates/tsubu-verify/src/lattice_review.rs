//! The models that Sakaguchi et al. (2001) review, each against what it must show.

mod baxter_behringer;
mod fhp;
mod fhp_waves;
mod karolyi_kertesz;
mod peng_herrmann;

pub(super) use baxter_behringer::{hopper_order, hopper_walls};
pub(super) use fhp::{channel, collisions, slope, sound};
pub(super) use fhp_waves::{viscosity, viscosity_plain};
pub(super) use karolyi_kertesz::{pile_angle, pile_avalanches, pile_segregation, silo_layers};
pub(super) use peng_herrmann::{pipe_limit, pipe_smooth, pipe_spectrum, pipe_waves};
