//! Who is near whom: cells, neighbour lists, how long they live.

pub mod block;
mod cell_sort;
pub mod drift;
pub mod grid;
pub mod joined;
mod lists;

pub use lists::{NeighbourLists, Search};
