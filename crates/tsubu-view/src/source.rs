//! Where frames come from: a folder, or a run that goes on in this program.

use std::sync::Arc;

use serde_json::Value;
use tsubu_frame::{Frame, Kind};

use crate::ViewError;
use crate::folder::Folder;
use crate::live::Live;

/// A run that is shown.
pub enum Source {
    /// From what it has written.
    Folder(Folder),
    /// From memory.
    Live(Arc<Live>),
}

impl Source {
    /// What there is, as JSON.
    pub fn about(&self) -> Result<Value, ViewError> {
        match self {
            Self::Folder(folder) => folder.about(),
            Self::Live(live) => Ok(live.about()),
        }
    }

    /// The table of the history; nothing if there is none.
    pub fn history(&self) -> Result<Option<Vec<u8>>, ViewError> {
        match self {
            Self::Folder(folder) => folder.history(),
            Self::Live(live) => Ok(live.history()),
        }
    }

    /// Numbers and times [s] of the frames that are there by now.
    pub fn moments(&self) -> Result<Vec<(usize, f64)>, ViewError> {
        match self {
            Self::Folder(folder) => Ok(folder.snapshots()?.iter().map(|snapshot| snapshot.time).enumerate().collect()),
            Self::Live(live) => Ok(live.moments()),
        }
    }

    /// A frame by its number: grains, and what is wanted beside them.
    pub fn frame(&self, number: usize, kinds: &[Kind]) -> Result<Option<Arc<Frame>>, ViewError> {
        match self {
            Self::Folder(folder) => Ok(folder.frame(number, kinds)?.map(Arc::new)),
            Self::Live(live) => {
                live.want_contacts(kinds.contains(&Kind::Contact));
                Ok(live.at(number))
            }
        }
    }

    /// The run, where it goes on in this program.
    pub fn live(&self) -> Option<&Live> {
        match self {
            Self::Folder(_) => None,
            Self::Live(live) => Some(live),
        }
    }
}
