//! Which quick cases notice that something is wrong on purpose: a JSON line a mutation, `cargo xtask mutants` keeps them.
//!
//! Without arguments all mutations and all quick cases that took at most [`MUTATED_LONGEST`] seconds when they were last kept, else
//! those named: mutations in the words of [`Mutation::ALL`], cases, of any length, by their names. A case is run with every mutation
//! that would change something in it, and notices one where a claim that held does not hold any more.
//!
//! `--last-bit`: which claims of cases of at most ten seconds hang on the last bit of the start, a JSON line a case.

use rayon::ThreadPoolBuilder;
use serde_json::json;
use std::collections::BTreeMap;
use std::io::Write as _;
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use tsubu::mutation::{Mutation, reached, set};
use tsubu_frame::{Claim, Origin};
use tsubu_verify::{CASES, Case, MUTATED_LONGEST, recorded_run};

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if words == ["--last-bit"] {
        last_bit();
        return ExitCode::SUCCESS;
    }
    let (names, words): (Vec<String>, Vec<String>) =
        words.into_iter().partition(|word| CASES.iter().any(|case| case.name == word));
    let wanted = |(_, of): &&(Mutation, &'static str)| words.is_empty() || words.iter().any(|word| word == of);
    let chosen: Vec<&(Mutation, &str)> = Mutation::ALL.iter().filter(wanted).collect();
    let short = |case: &Case| case.is_quick() && seconds(case).is_some_and(|seconds| seconds <= MUTATED_LONGEST);
    let run = |case: &&Case| if names.is_empty() { short(case) } else { names.iter().any(|name| name == case.name) };
    let cases: Vec<&Case> = CASES.iter().filter(run).collect();
    let mut whole: Vec<(Vec<String>, Vec<Mutation>)> = vec![Default::default(); cases.len()];
    side_by_side(&cases, |case| (holding(case, None), reached()), |at, found| whole[at] = found);
    eprintln!("{} cases run without a mutation", cases.len());
    let reaches =
        |mutation: Mutation| -> Vec<usize> { (0..cases.len()).filter(|&at| whole[at].1.contains(&mutation)).collect() };
    let mut jobs: Vec<(usize, usize)> = Vec::new();
    for (m, (mutation, _)) in chosen.iter().enumerate() {
        jobs.extend(reaches(*mutation).into_iter().map(|at| (m, at)));
    }
    let mut left: Vec<usize> = chosen.iter().map(|(mutation, _)| reaches(*mutation).len()).collect();
    let mut noticed: Vec<BTreeMap<usize, Vec<String>>> = vec![BTreeMap::new(); chosen.len()];
    let tell = |m: usize, noticed: &BTreeMap<usize, Vec<String>>| {
        let noticed: Vec<(&str, &Vec<String>)> = noticed.iter().map(|(&at, claims)| (cases[at].name, claims)).collect();
        let reached: Vec<&str> = reaches(chosen[m].0).into_iter().map(|at| cases[at].name).collect();
        eprintln!("{}: noticed by {} of {}", chosen[m].1, noticed.len(), reached.len());
        let tried: Vec<&str> = cases.iter().map(|case| case.name).collect();
        let line = json!({ "mutation": chosen[m].1, "tried": tried, "reached": reached, "noticed": noticed });
        // Nobody hears it: then the exit code says so.
        let _ = writeln!(std::io::stdout(), "{line}");
    };
    (0..chosen.len()).filter(|&m| reaches(chosen[m].0).is_empty()).for_each(|m| tell(m, &BTreeMap::new()));
    let run = |&(m, at): &(usize, usize)| {
        let now = holding(cases[at], Some(chosen[m].0));
        whole[at].0.iter().filter(|claim| !now.contains(claim)).cloned().collect::<Vec<_>>()
    };
    side_by_side(&jobs, run, |job, claims| {
        let (m, at) = jobs[job];
        if !claims.is_empty() {
            noticed[m].insert(at, claims);
        }
        left[m] -= 1;
        if left[m] == 0 {
            tell(m, &noticed[m]);
        }
    });
    ExitCode::SUCCESS
}

/// What a case took when it was last kept [s].
fn seconds(case: &Case) -> Option<f64> {
    recorded_run(case.name).map(|run| run.seconds)
}

/// Runs cases from two starts, and tells whose claims differ.
fn last_bit() {
    let short = |case: &&Case| seconds(case).is_some_and(|seconds| seconds <= 10.0);
    let cases: Vec<&Case> = CASES.iter().filter(short).collect();
    let run = |case: &&Case| {
        let values = |mutation| {
            set(mutation);
            let claims = case.claims(None).unwrap_or_default();
            set(None);
            claims.into_iter().filter(|claim| claim.origin != Origin::Control).collect::<Vec<_>>()
        };
        let (one, other) = (values(None), values(Some(Mutation::LastBit)));
        let differ = one.iter().zip(&other).filter(|(one, other)| differs(one, other));
        differ.map(|(claim, _)| claim.name.clone()).collect::<Vec<_>>()
    };
    side_by_side(&cases, run, |at, claims| {
        let line = json!({ "case": cases[at].name, "claims": claims });
        // Nobody hears it: there is nobody to tell.
        let _ = writeln!(std::io::stdout(), "{line}");
    });
}

/// Whether a value has moved by more than a millionth of itself and of the ends of the accepted range: rounding, grown by some thousand
/// steps of a regular motion, moves it by less.
fn differs(one: &Claim, other: &Claim) -> bool {
    let ends = [one.low, one.high].into_iter().flatten();
    let scale = ends.fold(one.value.abs(), |scale, end| scale.max(end.abs()));
    (one.value - other.value).abs() > 1e-6 * scale
}

/// The claims of a case that hold. Controls are no claims: that a model which is wrong anyway is refused says nothing.
fn holding(case: &Case, mutation: Option<Mutation>) -> Vec<String> {
    reached();
    set(mutation);
    let claims = case.claims(None).unwrap_or_default();
    set(None);
    let held = claims.into_iter().filter(|claim| claim.pass && claim.origin != Origin::Control);
    held.map(|claim| claim.name).collect()
}

/// Does all jobs in their order, as many at once as there are cores, each on a thread of its own: a mutation is of a thread.
fn side_by_side<J: Sync, T: Send>(jobs: &[J], work: impl Fn(&J) -> T + Sync, mut hear: impl FnMut(usize, T)) {
    let next = AtomicUsize::new(0);
    let (sender, receiver) = mpsc::channel();
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..workers {
            let (sender, next, work) = (sender.clone(), &next, &work);
            scope.spawn(move || {
                let pool = ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
                while let Some((at, job)) = {
                    let at = next.fetch_add(1, Ordering::Relaxed);
                    jobs.get(at).map(|job| (at, job))
                } {
                    if sender.send((at, pool.install(|| work(job)))).is_err() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        for (at, found) in receiver {
            hear(at, found);
        }
    });
}
