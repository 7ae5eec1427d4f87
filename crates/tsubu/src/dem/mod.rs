//! The discrete element method.

mod bodies;
mod bonds;
mod books;
mod clock;
mod contact_batch;
mod contact_forces;
mod contact_history;
mod drawn;
pub mod engine;
mod features;
mod fill;
mod gates;
mod history_transfer;
mod immersion;
mod integrate;
mod narrow_phase;
mod orientation;
mod output;
mod outside;
mod overlaps;
mod place;
mod ranks;
mod room;
mod settle;
mod shapes;
mod sources;
mod stage;
mod start;
mod step;
mod sweep;
mod wall_shapes;

use crate::about::About;
pub use engine::DemEngine;

pub(crate) const ABOUT: About = About {
    key: "method.dem",
    formula: "m dv/dt = sum f + m g,  I dw/dt = sum T; velocity Verlet; f and T by the contact law, see `contact`",
    symbols: "v velocity [m/s], w spin [rad/s], m mass [kg], I moment of inertia [kg.m^2], f force [N], T torque [N.m], g \
gravity [m/s^2]",
    limits: "Spheres, clumps of spheres, superellipsoids, polyhedra; in the plane discs, polygons and cells as well, with centres and motion in it. The step must resolve the shortest contact: `tsubu \
check` says how well. Contacts are soft: the overlap is to stay below about 1 % of the diameter.",
    reference: "Cundall and Strack 1979",
};
