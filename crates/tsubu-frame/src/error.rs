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
    /// Something stands where a result is to be written, and tsubu has not put it there.
    #[error(
        "{} was not written by this tsubu, and is left as it is\n\
         hint: name another folder with `-o`, or move it away (results of a tsubu from before the file `.tsubu` too)",
        path.display()
    )]
    Foreign {
        /// What stands there.
        path: PathBuf,
    },
    /// A file that tsubu wrote, and somebody has changed since.
    #[error(
        "{} has been changed since tsubu wrote it, and is left as it is\n\
         hint: name another folder with `-o`, or move the file away",
        path.display()
    )]
    Edited {
        /// The file.
        path: PathBuf,
    },
    /// A file or folder in the output folder that stands somewhere else.
    #[error(
        "{} is a link, and tsubu writes through none\n\
         hint: remove it, or name the folder that it leads to with `-o`",
        path.display()
    )]
    Link {
        /// The link.
        path: PathBuf,
    },
    /// Somebody else writes there.
    #[error(
        "another tsubu is writing into this folder: it holds the lock {}\n\
         hint: wait for its end, or name another folder with `-o`",
        path.display()
    )]
    Locked {
        /// The lock.
        path: PathBuf,
    },
    /// A folder of which nobody knows what in it is tsubu's.
    #[error(
        "cannot go on in {}: it has no file `.tsubu`, which says what tsubu wrote there\n\
         hint: start again into another folder, without `--resume`",
        path.display()
    )]
    Unmarked {
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
            | Self::Foreign { path }
            | Self::Edited { path }
            | Self::Link { path }
            | Self::Locked { path }
            | Self::Unmarked { path }
            | Self::NothingToResume { path } => path,
        }
    }

    /// Whether the disk (or the quota) was full.
    pub fn is_disk_full(&self) -> bool {
        matches!(self, Self::Write { source, .. }
            if matches!(source.kind(), io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded))
    }
}
