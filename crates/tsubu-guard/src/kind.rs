//! Kinds of cases: how they are drawn and who judges them.

use crate::bundle::Bundle;
use crate::draw::Draw;
use crate::{reading, scenes};
use std::path::Path;
use std::time::Duration;

/// What came of a case that held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// What was given was taken.
    Accepted,
    /// What was given was refused, with reasons.
    Refused,
}

/// A kind of cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Kind {
    /// Scenes and `--set`.
    Scenes,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 1] = [Self::Scenes];

    /// Its name on the command line, and of its folder in the corpus.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Scenes => "scenes",
        }
    }

    /// What part of the time it gets.
    pub const fn share(self) -> f64 {
        match self {
            Self::Scenes => 1.0,
        }
    }

    /// How long a case may take.
    pub const fn limit(self) -> Duration {
        match self {
            Self::Scenes => Duration::from_secs(10),
        }
    }

    /// The case of this number.
    pub fn draw(self, seed: u64, number: u64) -> Bundle {
        let mut draw = Draw::new(seed, self.name(), number);
        match self {
            Self::Scenes => scenes::draw(&mut draw),
        }
    }

    /// Judges a case, in a folder that is empty: what went wrong, if something did.
    pub fn judge(self, bundle: &Bundle, folder: &Path) -> Result<Outcome, String> {
        match self {
            Self::Scenes => reading::judge(bundle, folder),
        }
    }
}
