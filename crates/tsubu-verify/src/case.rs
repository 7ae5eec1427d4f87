//! What a verification case is.

use crate::control;
use tsubu_frame::{Claim, RunFolder};

/// The claims of a case, or why it came to none.
pub type Judged = Result<Vec<Claim>, String>;

/// One verification case: a few claims from one set of runs.
#[derive(Clone, Copy)]
pub struct Case {
    /// Name, as in `tsubu verify NAME`.
    pub name: &'static str,
    /// Study it belongs to; `tsubu verify STUDY` runs all its cases.
    pub study: &'static str,
    /// One line.
    pub about: &'static str,
    /// How long it may take [s]: one thread of its own, release build, an ordinary desktop of today.
    pub budget: u32,
    /// Shows where tsubu and its source differ: a claim fails, and the study says why. Never quick.
    pub gap: bool,
    /// Runs it. The factor multiplies the constants of the contact law; 1 but in the runs that show that the
    /// claims can fail.
    pub run: fn(perturbation: f64) -> Judged,
    /// The same into a folder, where it leaves pictures and tables; `None`: claims are all there is.
    pub kept: Option<fn(folder: &RunFolder) -> Judged>,
}

impl Case {
    /// The longest budget [s] of a quick case: what every change is held against, and `tsubu verify` alone runs.
    pub const QUICK: u32 = 60;

    /// Whether it runs without being asked for: by `--all`, by its name or by its study's.
    pub const fn is_quick(&self) -> bool {
        self.budget <= Self::QUICK && !self.gap
    }

    /// Its budget in words, and whether it shows a gap.
    pub fn budget_text(&self) -> String {
        format!("{} s{}", self.budget, if self.gap { ", gap" } else { "" })
    }

    /// Runs the case, into a folder if there is one; its claims carry its study's name.
    pub fn claims(&self, folder: Option<&RunFolder>) -> Judged {
        let mut claims = match (self.kept, folder) {
            (Some(kept), Some(folder)) => kept(folder)?,
            _ => (self.run)(1.0)?,
        };
        control::attach(&mut claims);
        Ok(claims.into_iter().map(|c| c.of(self.study)).collect())
    }

    /// Its claims, each told whether it refuses the case's constants 5 % too small: by a second run.
    pub fn with_controls(&self, mut claims: Vec<Claim>) -> Judged {
        control::attach_spoilt(&mut claims, &(self.run)(control::SPOILT)?);
        Ok(claims)
    }
}
