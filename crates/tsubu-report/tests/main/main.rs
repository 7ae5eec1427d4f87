//! Reports of every kind of folder, whole and damaged, and the pictures in them.

#![allow(clippy::unwrap_used)]

mod fixture;
mod pictures;
mod reports;
mod watches;
