//! The work: engines, contact laws, walls, hosts, ledger, checks and studies.
//!
//! A [`Plan`](tsubu_scene::plan::Plan) comes in, frames and books go out. [`methods::open`] builds the engine that the
//! plan's method names; [`engine::Engine::advance`] moves it; [`partner::Hosts`] are the vibrating structures that it meets
//! once a step; [`ledger::Ledger`] keeps the books.

pub mod about;
pub(crate) mod beam;
pub mod bench;
pub mod check;
pub mod clca;
pub mod contact;
pub mod dem;
pub mod engine;
pub mod explain;
pub mod interrupt;
pub mod lattice;
pub mod ledger;
mod memory;
pub mod methods;
pub mod motion;
pub mod mutation;
pub mod neighbours;
pub mod outside;
pub mod partner;
pub mod polyhedron;
pub mod random;
pub mod ranks;
pub mod run;
pub(crate) mod scene_files;
pub mod sections;
mod shape_mesh;
pub(crate) mod sizes;
pub mod state;
pub mod student;
pub mod study;
pub mod superellipsoid;
pub mod threads;
pub mod trial;
pub mod view;
pub mod wall;
pub mod watch;
pub mod water;

/// Version of the program, as written into summaries and checkpoints.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
