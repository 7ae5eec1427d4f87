//! Why there is nothing to look at.

use std::io;
use std::path::PathBuf;

use tsubu_frame::{Advise, FileError, Hint};

/// Why runs cannot be shown.
#[derive(Debug, thiserror::Error)]
pub enum ViewError {
    /// There is no such folder.
    #[error("{} is not a folder", path.display())]
    NoFolder {
        /// What was asked for.
        path: PathBuf,
    },
    /// It holds no run.
    #[error("{} holds no run: neither summary.json nor history.csv nor frames/ is in it", path.display())]
    NoRun {
        /// The folder.
        path: PathBuf,
    },
    /// It holds a run that wrote no frames.
    #[error("{} holds a run without frames: there is nothing to look at", path.display())]
    NoFrames {
        /// The folder.
        path: PathBuf,
    },
    /// A file of the run stands somewhere else, by a link.
    #[error("{} leads out of its run folder, and is not shown", path.display())]
    Outside {
        /// The file.
        path: PathBuf,
    },
    /// A file of the run cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// Somebody listens there already, or may not.
    #[error("cannot listen on port {port} of this machine: {source}")]
    Port {
        /// The port; 0 for any.
        port: u16,
        /// What the system said.
        source: io::Error,
    },
    /// The system has no random numbers for the token.
    #[error("the system gives no random numbers for the address")]
    Random,
}

impl Advise for ViewError {
    fn hints(&self) -> Vec<Hint> {
        match self {
            Self::NoFolder { .. } | Self::NoRun { .. } => {
                vec!["`tsubu run SCENE` makes a folder that can be looked at".into()]
            }
            Self::NoFrames { .. } => {
                vec!["give the scene `output.frame-interval = \"20 ms\"` and run it again".into()]
            }
            Self::Port { .. } => vec!["name another with `--port`, or leave it out to have a free one".into()],
            Self::File(error) => error.hints(),
            Self::Outside { .. } | Self::Random => Vec::new(),
        }
    }
}
