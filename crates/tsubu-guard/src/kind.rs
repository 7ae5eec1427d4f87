//! Kinds of cases: how they are drawn and who judges them.

use crate::bundle::Bundle;
use crate::draw::Draw;
use crate::outcome::Outcome;
use crate::{checkpoints, checks, commands, data, reading, scenes};
use std::path::Path;
use std::time::Duration;

/// A kind of cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Kind {
    /// Scenes and `--set`.
    Scenes,
    /// Tables of signals, grains and meshes.
    Data,
    /// Scenes, and what `tsubu check` says of those that are right.
    Checks,
    /// Run folders that are resumed.
    Checkpoints,
    /// Command lines.
    Commands,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Scenes, Self::Data, Self::Checks, Self::Checkpoints, Self::Commands];

    /// Its name on the command line, and of its folder in the corpus.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Scenes => "scenes",
            Self::Data => "data",
            Self::Checks => "checks",
            Self::Checkpoints => "checkpoints",
            Self::Commands => "commands",
        }
    }

    /// What part of the time it gets.
    pub const fn share(self) -> f64 {
        match self {
            Self::Scenes => 2.0,
            _ => 1.0,
        }
    }

    /// How long a case may take.
    pub const fn limit(self) -> Duration {
        match self {
            // As long as `check` may take, and what a busy machine takes.
            Self::Checks | Self::Commands => Duration::from_secs(20),
            _ => Duration::from_secs(10),
        }
    }

    /// The case of this number.
    pub fn draw(self, seed: u64, number: u64) -> Bundle {
        let mut draw = Draw::new(seed, self.name(), number);
        match self {
            Self::Scenes | Self::Checks => scenes::draw(&mut draw),
            Self::Data => data::draw(&mut draw),
            Self::Checkpoints => checkpoints::draw(&mut draw),
            Self::Commands => commands::draw(&mut draw),
        }
    }

    /// Judges a case, in a folder that is empty: what went wrong, if something did.
    pub fn judge(self, bundle: &Bundle, folder: &Path) -> Result<Outcome, String> {
        match self {
            Self::Scenes | Self::Data => reading::judge(bundle, folder),
            Self::Checks => checks::judge(bundle, folder),
            Self::Checkpoints => checkpoints::judge(bundle, folder),
            Self::Commands => commands::judge(bundle, folder),
        }
    }
}
