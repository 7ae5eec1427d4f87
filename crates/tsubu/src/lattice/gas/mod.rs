//! Lattice gases: particles of unit speed on the bonds of the triangular lattice, at most one for each direction of a site.
//!
//! [`bits`], [`chance`], [`collide`], [`step`], [`sweep`] and [`planes`] are the gas of Frisch, Hasslacher and Pomeau (1986) in its three
//! forms, 64 sites a word. [`grains`] and [`pile`] are gases of grains, which lose energy and fall;
//! [`elongated`] gives grains an axis, [`numbers`] particles a number to be followed by; [`sites`] says who is next to whom.

#![expect(
    clippy::inline_always,
    reason = "what passes over a column calls has to be compiled for the instruction set of the pass"
)]

pub mod bits;
pub mod chance;
pub mod collide;
pub mod elongated;
pub mod grains;
pub mod numbers;
pub mod pile;
pub mod planes;
pub mod sites;
pub mod step;
pub mod sweep;

use crate::about::About;

pub(crate) const ABOUT: About = About {
    key: "method.fhp",
    formula: "particles of unit speed on the six bonds of a site, at most one each; they fly one bond a step, then collide so that number and momentum stay",
    symbols: "density per site [-], speed 1 bond a step",
    limits: "A fluid at low Mach number; the viscosity is set by `fhp` rules I, II or III and the density. Not Galilean \
invariant at high speeds.",
    reference: "Frisch, Hasslacher and Pomeau 1986; Frisch, d'Humieres, Hasslacher, Lallemand, Pomeau, Rivet 1987",
};
