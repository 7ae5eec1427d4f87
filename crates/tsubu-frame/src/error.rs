//! What can go wrong with a file, with its name in the message; and what to do about an error.

use std::borrow::Cow;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// What to do about an error: a value of its own, beside the message that says what went wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hint(Cow<'static, str>);

impl fmt::Display for Hint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl From<&'static str> for Hint {
    fn from(text: &'static str) -> Self {
        Self(text.into())
    }
}

impl From<String> for Hint {
    fn from(text: String) -> Self {
        Self(text.into())
    }
}

/// An error that may know ways out.
pub trait Advise: std::error::Error {
    /// What to do about it.
    fn hints(&self) -> Vec<Hint>;

    /// What went wrong and what to do about it, for the remarks on a run: every hint on a line of its own.
    fn told(&self) -> String {
        let hints = self.hints().into_iter().map(|hint| format!("\nhint: {hint}"));
        std::iter::once(self.to_string()).chain(hints).collect()
    }
}

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
        /// What to do about it.
        hint: Option<Hint>,
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
        "{} was not written by this tsubu, and is left as it is",
        path.display()
    )]
    Foreign {
        /// What stands there.
        path: PathBuf,
    },
    /// A file that tsubu wrote, and somebody has changed since.
    #[error(
        "{} has been changed since tsubu wrote it, and is left as it is",
        path.display()
    )]
    Edited {
        /// The file.
        path: PathBuf,
    },
    /// A file or folder in the output folder that stands somewhere else.
    #[error(
        "{} is a link, and tsubu writes through none",
        path.display()
    )]
    Link {
        /// The link.
        path: PathBuf,
    },
    /// Somebody else writes there.
    #[error(
        "another tsubu is writing into this folder: it holds the lock {}",
        path.display()
    )]
    Locked {
        /// The lock.
        path: PathBuf,
    },
    /// A folder of which nobody knows what in it is tsubu's.
    #[error(
        "cannot go on in {}: it has no file `.tsubu`, which says what tsubu wrote there",
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
        Self::Content { path: path.to_owned(), reason: reason.into(), hint: None }
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

    /// Whether somebody else writes there.
    pub fn is_locked(&self) -> bool {
        matches!(self, Self::Locked { .. })
    }

    /// Whether the disk (or the quota) was full.
    pub fn is_disk_full(&self) -> bool {
        matches!(self, Self::Write { source, .. }
            if matches!(source.kind(), io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded))
    }
}

impl Advise for FileError {
    fn hints(&self) -> Vec<Hint> {
        let hint = match self {
            Self::Write { .. } | Self::Read { .. } | Self::NotEmpty { .. } | Self::NothingToResume { .. } => None,
            Self::Content { hint, .. } => hint.clone(),
            Self::Foreign { .. } => Some(
                "name another folder with `-o`, or move it away (results of a tsubu from before the file `.tsubu` too)"
                    .into(),
            ),
            Self::Edited { .. } => Some("name another folder with `-o`, or move the file away".into()),
            Self::Link { .. } => Some("remove it, or name the folder that it leads to with `-o`".into()),
            Self::Locked { .. } => Some("wait for its end, or name another folder with `-o`".into()),
            Self::Unmarked { .. } => Some("start again into another folder, without `--resume`".into()),
        };
        hint.into_iter().collect()
    }
}
