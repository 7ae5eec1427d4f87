//! Which quick cases notice that something is wrong on purpose: a JSON line a mutation, `cargo xtask mutants` keeps them.
//!
//! Without arguments all mutations, else those named, in the words of [`Mutation::ALL`]. A case is run with every mutation that
//! would change something in it, and notices one where a claim that held does not hold any more.

use rayon::ThreadPoolBuilder;
use serde_json::json;
use std::io::Write as _;
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use tsubu::mutation::{Mutation, reached, set};
use tsubu_frame::Origin;
use tsubu_verify::{CASES, Case};

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let wanted = |(_, of): &&(Mutation, &'static str)| words.is_empty() || words.iter().any(|word| word == of);
    let chosen: Vec<&(Mutation, &str)> = Mutation::ALL.iter().filter(wanted).collect();
    let cases: Vec<&Case> = CASES.iter().filter(|case| case.is_quick()).collect();
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
    let reached = left.clone();
    let mut noticed: Vec<Vec<usize>> = vec![Vec::new(); chosen.len()];
    let tell = |m: usize, noticed: &mut Vec<usize>| {
        noticed.sort_unstable();
        let names: Vec<&str> = noticed.iter().map(|&at| cases[at].name).collect();
        let line = json!({ "mutation": chosen[m].1, "reached": reached[m], "noticed": names });
        eprintln!("{}: noticed by {} of {}", chosen[m].1, names.len(), reached[m]);
        // Nobody hears it: then the exit code says so.
        let _ = writeln!(std::io::stdout(), "{line}");
    };
    (0..chosen.len()).filter(|&m| reached[m] == 0).for_each(|m| tell(m, &mut Vec::new()));
    let run = |&(m, at): &(usize, usize)| {
        let now = holding(cases[at], Some(chosen[m].0));
        whole[at].0.iter().any(|claim| !now.contains(claim))
    };
    side_by_side(&jobs, run, |job, notices| {
        let (m, at) = jobs[job];
        noticed[m].extend(notices.then_some(at));
        left[m] -= 1;
        if left[m] == 0 {
            tell(m, &mut noticed[m]);
        }
    });
    if noticed.iter().any(Vec::is_empty) { ExitCode::FAILURE } else { ExitCode::SUCCESS }
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
