//! Why a run has no result.

use crate::engine::{Fault, OpenError, digits};
use tsubu_frame::state::MissingSection;
use tsubu_frame::{Advise, CheckpointError, FileError, Hint};

/// Why there is no result.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The scene cannot be run by this method, or its grains did not settle; nothing was written.
    #[error(transparent)]
    Open(OpenError),
    /// A file or folder.
    #[error(transparent)]
    File(#[from] FileError),
    /// A file that could not be written on the way; what was computed so far is in the folder, as far as there was room.
    #[error("step {step}, t = {} s: {error}", digits(*time))]
    Stopped {
        /// Step number.
        step: u64,
        /// Simulated time [s].
        time: f64,
        /// The file.
        error: FileError,
    },
    /// A checkpoint that cannot be gone on from.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// A run that would be over before it begins.
    #[error("the run has no step: `duration` = {duration} s is less than half of the time step, {dt} s")]
    NoStep {
        /// Duration of the scene [s].
        duration: f64,
        /// Time step [s].
        dt: f64,
    },
    /// A checkpoint of another scene, or of another version.
    #[error("{0}")]
    NotThisScene(String),
    /// The run that this one is to start from does not fit, or cannot be read.
    #[error("{0}")]
    Start(String),
    /// The run was done by another process and has no result, for the reason that it gave.
    #[error("{0}")]
    Elsewhere(String),
    /// The run went wrong; what was computed so far is in the folder.
    #[error("{0}")]
    Fault(#[from] Fault),
}

impl Advise for RunError {
    fn hints(&self) -> Vec<Hint> {
        match self {
            Self::Open(error) => error.hints(),
            Self::File(error) | Self::Stopped { error, .. } => error.hints(),
            Self::Checkpoint(_) | Self::Elsewhere(_) => Vec::new(),
            Self::NoStep { .. } => vec!["raise `duration`, or shorten the time step".into()],
            Self::NotThisScene(_) => vec!["run without `--resume` into another folder, or with `--overwrite`".into()],
            Self::Start(_) => vec!["make the scene as it was there, and say in stages what changes".into()],
            Self::Fault(fault) => fault.hints(),
        }
    }
}

impl From<OpenError> for RunError {
    fn from(error: OpenError) -> Self {
        match error {
            OpenError::Running(fault) => Self::Fault(fault),
            other => Self::Open(other),
        }
    }
}

impl From<MissingSection> for RunError {
    fn from(error: MissingSection) -> Self {
        Self::NotThisScene(error.to_string())
    }
}
