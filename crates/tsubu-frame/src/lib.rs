//! The answer: frames of named columns, the state of a run, and the files they are written to.
//!
//! Every file appears under its name whole or not at all, and every error names the file it is about.

pub mod checkpoint;
pub mod claim;
pub mod csv;
mod error;
pub mod folder;
pub mod frame;
pub mod history;
pub mod lammps;
mod marker;
pub mod named;
pub mod not_a_number;
pub mod series;
pub mod state;
pub mod summary;
pub mod unit;
pub mod vtp;
pub mod vtp_read;
pub mod whole;
pub mod xyz;

pub use checkpoint::{CheckpointError, Header};
pub use claim::{Claim, Ensemble, Origin, Points, Source, Verdict};
pub use csv::{Cell, Table};
pub use error::{Advise, FileError, Hint};
pub use folder::{Existing, RunFolder};
pub use frame::{Column, Frame, Kind, Values};
pub use history::{History, Mark};
pub use named::Named;
pub use series::{Formats, FrameWriter, Snapshot, snapshots};
pub use state::State;
pub use summary::{Energy, Joule, RanksSummary, ResultValue, Status, Summary};
pub use vtp_read::read_frame;
