//! What is done of a verification is kept in its folder, so that one that was interrupted goes on where it was.
//!
//! `cases/NAME.json` has a case that is done, `members/NAME/RUN-SEED.json` one run of an ensemble. Each has the fingerprint of what
//! was run: program, version, case, constants. What another program has kept is run again.

use crate::case_run::Done;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::Instant;
use tsubu_frame::{FileError, RunFolder, not_a_number::reals, summary::read_json};

/// A folder in which done work is kept.
#[derive(Debug)]
pub struct Archive {
    folder: RunFolder,
    /// Hash of the program that runs.
    program: String,
}

impl Archive {
    /// In a folder of results.
    pub fn new(folder: RunFolder) -> Result<Self, FileError> {
        Ok(Self { folder, program: running_program()? })
    }

    /// The folder.
    pub fn folder(&self) -> &RunFolder {
        &self.folder
    }

    /// A case that was done by the same program.
    pub fn case(&self, case: &str, controls: bool) -> Option<Done> {
        let kept: KeptCase = read_json(&self.folder.file(&case_file(case))).ok()?;
        (kept.fingerprint == self.fingerprint(&[case, &controls.to_string()])).then_some(kept.done)
    }

    pub(crate) fn keep_case(&self, done: &Done, controls: bool) -> Result<(), FileError> {
        let case = &done.run.case;
        let fingerprint = self.fingerprint(&[case, &controls.to_string()]);
        self.folder.write_json(&case_file(case), &KeptCase { fingerprint, done: done.clone() })
    }

    fn fingerprint(&self, what: &[&str]) -> String {
        let mut hasher = blake3::Hasher::new();
        for text in [self.program.as_str(), tsubu::VERSION].iter().chain(what) {
            hasher.update(text.as_bytes()).update(b"\0");
        }
        hasher.finalize().to_hex()[..16].to_owned()
    }
}

/// Hash of the program that runs.
fn running_program() -> Result<String, FileError> {
    static KNOWN: OnceLock<String> = OnceLock::new();
    if let Some(known) = KNOWN.get() {
        return Ok(known.clone());
    }
    let here = Path::new("the running program");
    let program = std::env::current_exe().map_err(FileError::read(here))?;
    let content = std::fs::read(&program).map_err(FileError::read(&program))?;
    Ok(KNOWN.get_or_init(|| blake3::hash(&content).to_hex()[..16].to_owned()).clone())
}

/// The file of a case in a folder of results.
fn case_file(case: &str) -> String {
    format!("cases/{case}.json")
}

#[derive(Serialize, Deserialize)]
struct KeptCase {
    fingerprint: String,
    #[serde(flatten)]
    done: Done,
}

/// One run of an ensemble.
#[derive(Serialize, Deserialize)]
struct Member {
    case: String,
    of: String,
    seed: u64,
    version: String,
    fingerprint: String,
    seconds: f64,
    #[serde(deserialize_with = "reals")]
    values: Vec<f64>,
}

/// The case that is run on this thread, as its ensembles see it.
pub(crate) struct AtHand {
    case: &'static str,
    perturbation: f64,
    archive: Option<Arc<Archive>>,
    /// Hears of every run that is done.
    hear: Arc<dyn Fn() + Send + Sync>,
    tally: Mutex<Tally>,
}

/// What has become of the runs so far.
#[derive(Default)]
struct Tally {
    ensembles: BTreeSet<String>,
    members: usize,
    /// Computing time [s] of runs that were kept from an earlier time.
    kept_seconds: f64,
}

thread_local! {
    static AT_HAND: RefCell<Option<Arc<AtHand>>> = const { RefCell::new(None) };
}

/// Takes the case from the thread again, however it ends.
struct Leave;

impl Drop for Leave {
    fn drop(&mut self) {
        AT_HAND.with_borrow_mut(|at_hand| *at_hand = None);
    }
}

impl AtHand {
    pub fn new(
        case: &'static str,
        perturbation: f64,
        archive: Option<Arc<Archive>>,
        hear: Arc<dyn Fn() + Send + Sync>,
    ) -> Self {
        Self { case, perturbation, archive, hear, tally: Mutex::default() }
    }

    /// Runs the case; gives what came of it, its computing time [s] with that of the runs that were kept, and the number of runs.
    pub fn run<T>(self, work: impl FnOnce() -> T) -> (T, f64, usize) {
        let here = Arc::new(self);
        AT_HAND.with_borrow_mut(|at_hand| *at_hand = Some(here.clone()));
        let leave = Leave;
        let begun = Instant::now();
        let result = work();
        drop(leave);
        let tally = here.tally();
        (result, begun.elapsed().as_secs_f64() + tally.kept_seconds, tally.members)
    }

    fn tally(&self) -> MutexGuard<'_, Tally> {
        // Whoever panicked has added to it or has not.
        self.tally.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// One run of an ensemble: as it was kept, or done and kept.
    fn member(&self, of: &str, seed: u64, run: impl Fn(u64) -> Result<Vec<f64>, String>) -> Result<Vec<f64>, String> {
        let Some(archive) = &self.archive else {
            let values = run(seed)?;
            self.count(0.0);
            return Ok(values);
        };
        let name = format!("members/{}/{}-{seed}.json", self.case, plain(of, self.perturbation));
        let fingerprint =
            archive.fingerprint(&[self.case, of, &seed.to_string(), &self.perturbation.to_bits().to_string()]);
        let kept = read_json::<Member>(&archive.folder.file(&name)).ok().filter(|kept| kept.fingerprint == fingerprint);
        if let Some(kept) = kept {
            self.count(kept.seconds);
            return Ok(kept.values);
        }
        let begun = Instant::now();
        let values = run(seed)?;
        // JSON has one word for all that are no numbers.
        if values.iter().any(|value| value.is_infinite()) {
            self.count(0.0);
            return Ok(values);
        }
        let member = Member {
            case: self.case.to_owned(),
            of: of.to_owned(),
            seed,
            version: tsubu::VERSION.to_owned(),
            fingerprint,
            seconds: begun.elapsed().as_secs_f64(),
            values,
        };
        archive.folder.write_json(&name, &member).map_err(|error| error.to_string())?;
        self.count(0.0);
        Ok(member.values)
    }

    fn count(&self, kept_seconds: f64) {
        let mut tally = self.tally();
        tally.members += 1;
        tally.kept_seconds += kept_seconds;
        drop(tally);
        (self.hear)();
    }
}

/// Runs an ensemble side by side on all threads of the pool; its runs come in the order of the seeds. `of` tells it from the other
/// ensembles of the case: two of one name would be taken for one another.
pub(crate) fn runs(
    of: &str,
    seeds: &[u64],
    run: impl Fn(u64) -> Result<Vec<f64>, String> + Sync,
) -> Result<Vec<Vec<f64>>, String> {
    let Some(at_hand) = AT_HAND.with_borrow(Clone::clone) else {
        return seeds.par_iter().map(|&seed| run(seed)).collect();
    };
    if !at_hand.tally().ensembles.insert(of.to_owned()) {
        return Err(format!("two ensembles of `{}` are called `{of}`", at_hand.case));
    }
    seeds.par_iter().map(|&seed| at_hand.member(of, seed, &run)).collect()
}

/// The same of runs that give so many values each.
pub(crate) fn members<const N: usize>(
    of: &str,
    seeds: &[u64],
    run: impl Fn(u64) -> Result<[f64; N], String> + Sync,
) -> Result<Vec<[f64; N]>, String> {
    let found = runs(of, seeds, |seed| run(seed).map(Vec::from))?;
    let whole = |values: Vec<f64>| values.try_into().map_err(|_| format!("a run of `{of}` has not {N} values"));
    found.into_iter().map(whole).collect()
}

/// Whether the case at hand is run a second time, with constants that are wrong.
pub(crate) fn is_spoilt() -> bool {
    AT_HAND.with_borrow(|at_hand| at_hand.as_ref().is_some_and(|at_hand| at_hand.perturbation != 1.0))
}

/// A name for a file: letters and digits, and a hash, for names that differ in nothing else.
fn plain(of: &str, perturbation: f64) -> String {
    let words: Vec<&str> = of.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let short: String = words.join("-").to_lowercase().chars().take(60).collect();
    let hash = blake3::hash(format!("{of}\0{}", perturbation.to_bits()).as_bytes());
    format!("{short}-{}", &hash.to_hex()[..6])
}
