//! CL-CA: grains made of many lattice points that move where there is room (Sakaguchi, Murakami, Hasegawa, Kawai 2001).
//!
//! A grain is a connected set of points of the triangular lattice ([`crate::lattice::shape`]). In a step it moves by one spacing or
//! rests; forces do not exist. Under the [`active`] rule gravity lets it go down where there is room; under the
//! [`passive`] rule walls and driven grains push, grains overlap, and the number of shared points stands for the force.
//! Many grains take their turns in strips of the lattice side by side. [`bed`] holds the grains and [`order`] says who goes
//! first; [`build`] reads a plan, `kinds` which points its grains have, and [`engine`] runs it, with walls and driven grains in `movers` and those that come and go in
//! `sources`.

pub mod active;
pub mod bed;
pub mod build;
pub mod engine;
mod kinds;
mod movers;
pub mod order;
mod output;
pub mod passive;
mod place;
mod sources;
mod strips;

use crate::about::About;

pub(crate) const ABOUT: About = About {
    key: "method.cl-ca",
    formula: "a grain is a connected set of lattice points; in a step it moves by one spacing where there is room, else it rests",
    symbols: "spacing [m], time step from free fall through `cl-ca.fall-height` [s]",
    limits: "No forces, no velocities: the number of shared points under the passive rule stands for the force. Slopes \
are those of the lattice.",
    reference: "Sakaguchi, Murakami, Hasegawa, Kawai 2001",
};
