//! The files: what is written comes back, and what is damaged is refused.

#![allow(clippy::unwrap_used)]

mod checkpoint;
mod files;
mod frames;
mod tables;
