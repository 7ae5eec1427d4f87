//! The integration tests of the crate, one binary.
#![allow(clippy::unwrap_used, reason = "a test that panics is a test that fails")]

mod allocation;
mod atlas;
mod bench;
mod book;
mod calibrate;
mod clca;
mod contact;
mod dem;
mod design;
mod drives;
mod grouping;
mod host;
mod interface;
mod lattice;
mod outside;
mod polyhedron;
mod ranks;
mod response;
mod stages;
mod superellipsoid;
mod triaxial;
mod wall;
mod watch;
mod water;
