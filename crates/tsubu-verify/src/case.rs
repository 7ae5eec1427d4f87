//! What a verification case is.

use crate::case_run::{CaseRun, Done};
use crate::control;
use crate::keep::{Archive, AtHand};
use std::sync::Arc;
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

/// How cases are run.
#[derive(Clone, Debug, Default)]
pub struct How {
    /// Where what is done is kept, and whence it is taken.
    pub archive: Option<Arc<Archive>>,
    /// A second time, with constants that are wrong.
    pub controls: bool,
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

    /// Runs the case, or takes what was kept of it; `hear` is told of every run of its ensembles that is done.
    pub fn done(&self, how: &How, hear: Arc<dyn Fn() + Send + Sync>) -> Result<Done, String> {
        if let Some(kept) = how.archive.as_ref().and_then(|archive| archive.case(self.name, how.controls)) {
            return Ok(kept);
        }
        let at_hand = |perturbation, hear| AtHand::new(self.name, perturbation, how.archive.clone(), hear);
        let folder = how.archive.as_ref().map(|archive| archive.folder());
        let (claims, seconds, members) = at_hand(1.0, hear).run(|| self.claims(folder));
        let mut claims = claims?;
        if how.controls {
            let (spoilt, ..) = at_hand(control::SPOILT, Arc::new(|| ())).run(|| (self.run)(control::SPOILT));
            control::attach_spoilt(&mut claims, &spoilt?);
        }
        let done = Done { run: CaseRun::here(self.name, seconds, members), claims };
        if let Some(archive) = &how.archive {
            archive.keep_case(&done, how.controls).map_err(|error| error.to_string())?;
        }
        Ok(done)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ensemble;
    use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
    use tsubu_frame::{Existing, Origin, Source};

    /// Runs that came to an end.
    static RUNS: AtomicUsize = AtomicUsize::new(0);
    static INTERRUPTED: AtomicBool = AtomicBool::new(true);

    /// Two ensembles; the last run of each does not come to an end while it is interrupted.
    fn shaky(perturbation: f64) -> Judged {
        let value = |seed: u64| {
            if seed == 5 && INTERRUPTED.load(Ordering::SeqCst) {
                return Err("interrupted".to_owned());
            }
            RUNS.fetch_add(1, Ordering::SeqCst);
            // A run whose value is no number is done, too.
            Ok([if seed == 2 { f64::NAN } else { perturbation / seed as f64 }])
        };
        let source = Source::new(Origin::Own, "a test");
        let claim = |of: &str| {
            let [found] = ensemble::members(of, 1..=5, value)?;
            Ok::<_, String>(Claim::judge_ensemble(of, found, None, None, source))
        };
        Ok(vec![claim("one")?, claim("two")?])
    }

    fn case(run: fn(f64) -> Judged) -> Case {
        Case { name: "shaky", study: "tests", about: "", budget: 1, gap: false, run, kept: None }
    }

    fn archive(path: &std::path::Path) -> How {
        let existing = if path.exists() { Existing::Resume } else { Existing::Refuse };
        let folder = RunFolder::create(path, existing, ["cases/"; 0]).expect("a folder");
        How { archive: Some(Arc::new(Archive::new(folder).expect("a program"))), controls: false }
    }

    /// An interrupted ensemble lost all its runs: a night of work, where the machine was needed in the morning.
    #[test]
    fn runs_that_are_done_are_not_run_again() {
        let desk = tempfile::tempdir().expect("a folder");
        let path = desk.path().join("out");
        let run = |how: How| case(shaky).done(&how, Arc::new(|| ()));
        assert!(run(archive(&path)).is_err());
        INTERRUPTED.store(false, Ordering::SeqCst);
        run(archive(&path)).expect("claims");
        assert_eq!(RUNS.load(Ordering::SeqCst), 10, "what was kept was run again");
        let done = run(archive(&path)).expect("claims");
        assert_eq!(RUNS.load(Ordering::SeqCst), 10, "a case that was done was run again");
        assert_eq!(done.run.members, 10);
        let alone = case(shaky).done(&How::default(), Arc::new(|| ())).expect("claims");
        assert_eq!(format!("{:?}", alone.claims), format!("{:?}", done.claims));
        // Of the same case with controls nothing but the runs is known.
        let how = How { controls: true, ..archive(&path) };
        let before = RUNS.load(Ordering::SeqCst);
        run(how).expect("claims");
        assert_eq!(RUNS.load(Ordering::SeqCst), before + 10);
        // What another version or program has left counts for nothing.
        let member =
            std::fs::read_dir(path.join("members/shaky")).expect("members").flatten().next().expect("a member");
        let text = std::fs::read_to_string(member.path()).expect("a member");
        assert!(["version", "seed", "case", "fingerprint"].iter().all(|key| text.contains(key)), "{text}");
        for folder in ["members/shaky", "cases"] {
            for file in std::fs::read_dir(path.join(folder)).expect("files").flatten() {
                let text = std::fs::read_to_string(file.path()).expect("a file");
                let (before, after) = text.split_once("\"fingerprint\": \"").expect("a fingerprint");
                std::fs::write(file.path(), format!("{before}\"fingerprint\": \"x{}", &after[1..])).expect("written");
            }
        }
        let before = RUNS.load(Ordering::SeqCst);
        run(archive(&path)).expect("claims");
        assert_eq!(RUNS.load(Ordering::SeqCst), before + 10, "what another program kept was taken");
    }

    /// Two ensembles of one name would have been taken for one another after an interruption.
    #[test]
    fn two_ensembles_of_one_name_are_refused() {
        let twice = |_: f64| {
            for _ in 0..2 {
                ensemble::members("the same", 1..=2, |seed| Ok([seed as f64]))?;
            }
            Ok(Vec::new())
        };
        assert!(case(twice).done(&How::default(), Arc::new(|| ())).is_err_and(|e| e.contains("the same")));
    }
}
