//! Who is near whom: cells, neighbour lists, how long they live.

mod block;
mod cell_sort;
pub mod drift;
pub mod grid;
pub mod joined;
pub mod lists;

pub use lists::{NeighbourLists, Search};
