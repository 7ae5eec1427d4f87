//! What can go wrong with a file, with its name in the message.

use std::io;
use std::path::{Path, PathBuf};

/// A file or folder that could not be written, read or understood.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// The system refused a write: no space, no permission, no such folder.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The system refused a read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file is there, but its content is not what it should be.
    #[error("{} is not as expected: {reason}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// The output folder has something in it already.
    #[error(
        "the output folder {} is not empty: go on from its checkpoint with --resume, \
         replace its results with --overwrite, or name another folder with -o",
        path.display()
    )]
    NotEmpty {
        /// The folder.
        path: PathBuf,
    },
    /// There is nothing to go on from.
    #[error("nothing to resume: {} is not a folder; leave out --resume to start the run", path.display())]
    NothingToResume {
        /// The folder.
        path: PathBuf,
    },
}

impl FileError {
    /// A refused write.
    pub fn write(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Write { path, source }
    }

    /// A refused read.
    pub fn read(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Read { path, source }
    }

    /// Content that cannot be understood.
    pub fn content(path: &Path, reason: impl Into<String>) -> Self {
        Self::Content { path: path.to_owned(), reason: reason.into() }
    }

    /// The file or folder it is about.
    pub fn path(&self) -> &Path {
        match self {
            Self::Write { path, .. }
            | Self::Read { path, .. }
            | Self::Content { path, .. }
            | Self::NotEmpty { path }
            | Self::NothingToResume { path } => path,
        }
    }

    /// Whether the disk (or the quota) was full.
    pub fn is_disk_full(&self) -> bool {
        matches!(self, Self::Write { source, .. }
            if matches!(source.kind(), io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded))
    }
}
