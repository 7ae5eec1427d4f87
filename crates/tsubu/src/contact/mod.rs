//! Contact laws: stacks of parts that work on chunks of touching pairs.
//!
//! One file a part. A part knows neither walls nor threads nor dimension: grain-grain and grain-wall contacts reach it as
//! rows of the same [`chunk::Chunk`].

pub mod calibrate;
pub mod chunk;
pub mod law;
pub mod part;
pub mod table;

mod coulomb;
mod hertz;
mod hooke;
mod mindlin;
mod rolling_constant;
mod viscous;

pub use chunk::Chunk;
pub use law::Law;
pub use table::{Pair, Table};
