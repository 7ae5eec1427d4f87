//! Runs verification cases side by side.

use crate::failure::Failure;
use crate::options::command_to_resume;
use crate::output;
use crate::progress::Progress;
use crate::stop;
use crate::stream::Stream;
use rayon::ThreadPoolBuilder;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, mpsc};
use tsubu_frame::{Claim, Origin, Source};
use tsubu_verify::{Case, CaseRun, How, recorded_run};

/// What came of a case.
pub struct Outcome {
    /// Its claims.
    pub claims: Vec<Claim>,
    /// What the run was; none where it came to no claims.
    pub run: Option<CaseRun>,
    /// A warning where it took longer than it may.
    pub late: Option<String>,
}

/// What is heard of the cases, by their places.
enum News {
    /// A run of its ensembles is done.
    Member(usize),
    /// It is done.
    Case(usize, Outcome),
}

/// Runs the cases and prints what is to be told of each as soon as it and all before it are done.
pub fn judge(
    cases: &[&'static Case],
    how: &How,
    threads: usize,
    quiet: bool,
    lines: impl Fn(&Case, &Outcome) -> String,
) -> Result<Vec<Outcome>, Failure> {
    let progress = Progress::new("verify", quiet);
    let mut share = Share::of(cases);
    let hint = if how.archive.is_some() {
        format!("go on with `{}`", command_to_resume())
    } else {
        "with `-o DIR` what is done is kept, and an interrupted verification goes on from it".to_owned()
    };
    let so_far = |done: usize, untold: &str| stop::so_far(so_far(done, cases.len(), untold, &hint));
    so_far(0, "");
    let (mut waiting, mut told) = (BTreeMap::new(), Vec::new());
    let mut done = 0_usize;
    let judged = side_by_side(cases, threads, how, |news| {
        match news {
            News::Member(index) => share.member(index),
            News::Case(index, outcome) => {
                waiting.insert(index, outcome);
                done += 1;
                share.done(index);
                while let Some(outcome) = waiting.remove(&told.len()) {
                    let text = lines(cases[told.len()], &outcome);
                    progress.hide_while(|| {
                        outcome.late.iter().for_each(|text| output::tell(text));
                        output::print(&text)
                    })?;
                    told.push(outcome);
                }
                let untold: Vec<String> = waiting.iter().map(|(&at, outcome)| lines(cases[at], outcome)).collect();
                so_far(done, &untold.concat());
            }
        }
        progress.set(share.all());
        Ok(())
    });
    progress.end();
    judged.map(|()| told)
}

/// The claims of the cases, and nothing printed; `heard` is told the share that is done and says whether to go on with more cases.
pub fn claims(
    cases: &[&'static Case],
    threads: usize,
    heard: impl Fn(f64) -> bool,
) -> Result<Vec<(&'static str, Claim)>, Failure> {
    let mut share = Share::of(cases);
    let mut claims: Vec<Vec<Claim>> = vec![Vec::new(); cases.len()];
    side_by_side(cases, threads, &How::default(), |news| {
        match news {
            News::Member(index) => share.member(index),
            News::Case(index, outcome) => {
                share.done(index);
                claims[index] = outcome.claims;
            }
        }
        if heard(share.all()) { Ok(()) } else { Err(Failure::interrupted("interrupted")) }
    })?;
    let named = |(case, claims): (&&'static Case, Vec<Claim>)| -> Vec<(&'static str, Claim)> {
        claims.into_iter().map(|claim| (case.name, claim)).collect()
    };
    Ok(cases.iter().zip(claims).flat_map(named).collect())
}

/// How much is done, by the seconds that each case took when it was stored, or may take.
struct Share {
    seconds: Vec<f64>,
    /// Runs of ensembles that there were, none where that is not known.
    members: Vec<usize>,
    /// Runs that are done.
    heard: Vec<usize>,
    done: Vec<bool>,
}

impl Share {
    fn of(cases: &[&'static Case]) -> Self {
        let stored: Vec<Option<CaseRun>> = cases.iter().map(|case| recorded_run(case.name)).collect();
        let seconds = |(case, run): (&&Case, &Option<CaseRun>)| {
            run.as_ref().map_or(f64::from(case.budget), |run| run.seconds).max(1e-3)
        };
        Self {
            seconds: cases.iter().zip(&stored).map(seconds).collect(),
            members: stored.iter().map(|run| run.as_ref().map_or(0, |run| run.members)).collect(),
            heard: vec![0; cases.len()],
            done: vec![false; cases.len()],
        }
    }

    fn member(&mut self, index: usize) {
        self.heard[index] += 1;
    }

    fn done(&mut self, index: usize) {
        self.done[index] = true;
    }

    /// The share of all, 0 to 1.
    fn all(&self) -> f64 {
        let of = |index: usize| match (self.done[index], self.members[index]) {
            (true, _) => 1.0,
            (false, 0) => 0.0,
            (false, members) => self.heard[index].min(members) as f64 / members as f64,
        };
        let done: f64 = self.seconds.iter().enumerate().map(|(index, seconds)| seconds * of(index)).sum();
        done / self.seconds.iter().sum::<f64>().max(f64::MIN_POSITIVE)
    }
}

/// Runs the cases in their order, as many at once as there are threads, and hears of each when it is done. A case has threads of
/// its own, one of them as a rule: in a pool that all shared, a case that hands out work would do another case while it waits,
/// and take that one's time as well.
fn side_by_side(
    cases: &[&'static Case],
    threads: usize,
    how: &How,
    mut hear: impl FnMut(News) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let workers = threads.clamp(1, cases.len().max(1));
    let build = |worker| {
        let own = threads / workers + usize::from(worker < threads % workers);
        let pool = ThreadPoolBuilder::new().num_threads(own.max(1)).build();
        pool.map_err(|error| Failure::wrong(format!("cannot start the threads: {error}")))
    };
    let pools = (0..workers).map(build).collect::<Result<Vec<_>, _>>()?;
    let next = &AtomicUsize::new(0);
    let (sender, receiver) = mpsc::channel();
    std::thread::scope(|scope| {
        for pool in pools {
            let sender = sender.clone();
            scope.spawn(move || {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    let Some(case) = cases.get(index) else { return };
                    let member = sender.clone();
                    let hear = Arc::new(move || _ = member.send(News::Member(index)));
                    let outcome = pool.install(|| outcome(case, how, hear));
                    // Nobody listens any more once printing has failed.
                    if sender.send(News::Case(index, outcome)).is_err() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        receiver.into_iter().try_for_each(&mut hear)
    })
}

/// What a case takes over its budget before that is told: machines, and what else they do, differ by less.
const LATE: f64 = 3.0;

/// Runs a case and looks at the clock.
fn outcome(case: &Case, how: &How, hear: Arc<dyn Fn() + Send + Sync>) -> Outcome {
    let done = match case.done(how, hear) {
        Ok(done) => done,
        Err(error) => return Outcome { claims: vec![broken(case, &error)], run: None, late: None },
    };
    let late = (done.run.seconds > LATE * f64::from(case.budget)).then(|| {
        let (name, budget, taken) = (case.name, case.budget, done.run.seconds);
        format!(
            "{}: `{name}` took {taken:.1} s, more than {LATE} times its budget of {budget} s\n",
            Stream::Error.yellow("warning")
        )
    });
    Outcome { claims: done.claims, run: Some(done.run), late }
}

/// What is said of an interrupted verification; `untold` are the claims of cases that were done before others ahead of them.
fn so_far(done: usize, all: usize, untold: &str, hint: &str) -> String {
    let mut text = format!(": {done} of {all} cases were done");
    if !untold.is_empty() {
        text = format!("{text}, the last of them here:\n{}", untold.trim_end());
    }
    format!("{text}\n{}: {hint}", Stream::Error.bold_cyan("hint"))
}

/// A case that came to no value: a claim that fails.
fn broken(case: &Case, error: &str) -> Claim {
    let reason = format!("it did not run: {}", error.replace('\n', "; "));
    Claim::judge(case.name, f64::NAN, None, None, Source::new(Origin::Own, &reason)).of(case.study)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicU32;
    use std::time::{Duration, Instant};

    fn case(budget: u32, run: fn(f64) -> tsubu_verify::Judged) -> &'static Case {
        Box::leak(Box::new(Case { name: "some", study: "none", about: "", budget, gap: false, run, kept: None }))
    }

    #[expect(clippy::unnecessary_wraps, reason = "what a case gives")]
    fn value(value: usize) -> tsubu_verify::Judged {
        Ok(vec![Claim::judge("value", value as f64, Some(0.0), None, Source::new(Origin::Own, "a test"))])
    }

    fn heard(cases: &[&'static Case], threads: usize) -> Vec<(f64, bool)> {
        let mut heard = Vec::new();
        let done = side_by_side(cases, threads, &How::default(), |news| {
            if let News::Case(_, outcome) = news {
                heard.push((outcome.claims[0].value, outcome.late.is_some()));
            }
            Ok(())
        });
        assert!(done.is_ok());
        heard
    }

    /// A budget was told and never looked at: a case came to take six times as long, and nobody noticed.
    #[test]
    fn a_case_over_its_budget_is_told_and_counts() {
        let run = |_: f64| value(7);
        assert_eq!(heard(&[case(0, run), case(60, run)], 1), [(7.0, true), (7.0, false)]);
        let told = outcome(case(0, run), &How::default(), Arc::new(|| ())).late.unwrap_or_default();
        assert!(told.starts_with("warning: `some` took 0.0 s, more than 3 times its budget of 0 s"), "{told}");
    }

    /// All threads were one pool: a case that handed out work did other cases while it waited, and the clock counted them.
    #[test]
    fn cases_run_at_once_on_threads_of_their_own() {
        static HERE: AtomicU32 = AtomicU32::new(0);
        /// Waits until as many cases have come, so that no thread takes two.
        fn meet(coming: u32) -> tsubu_verify::Judged {
            HERE.fetch_add(1, Ordering::SeqCst);
            let begun = Instant::now();
            while HERE.load(Ordering::SeqCst) < coming {
                if begun.elapsed() > Duration::from_secs(20) {
                    return Err("the other case did not come".to_owned());
                }
                std::thread::yield_now();
            }
            value(rayon::current_num_threads())
        }
        assert_eq!(heard(&[case(60, |_| meet(2)), case(60, |_| meet(2))], 2), [(1.0, false), (1.0, false)]);
        let mut counts = heard(&[case(60, |_| meet(4)), case(60, |_| meet(4))], 5);
        counts.sort_by(|a, b| a.0.total_cmp(&b.0));
        assert_eq!(counts, [(2.0, false), (3.0, false)]);
        let count = |_: f64| value(rayon::current_num_threads());
        assert_eq!(heard(&[case(60, count)], 4), [(4.0, false)]);
    }

    /// Cases ran on to their ends though nobody could read what they claimed.
    #[test]
    fn no_case_begins_once_nobody_listens() {
        static BEGUN: AtomicU32 = AtomicU32::new(0);
        let run = |_: f64| {
            BEGUN.fetch_add(1, Ordering::SeqCst);
            std::thread::sleep(Duration::from_millis(20));
            value(1)
        };
        let cases = [case(60, run); 50];
        let done = side_by_side(&cases, 1, &How::default(), |_| Err(Failure::failed("the reader has gone")));
        assert!(done.is_err() && BEGUN.load(Ordering::SeqCst) < 10);
    }

    /// The bar stood still for as long as the only case ran.
    #[test]
    fn the_runs_of_an_ensemble_move_the_bar() {
        let mut share = Share { seconds: vec![3.0, 1.0], members: vec![4, 0], heard: vec![0; 2], done: vec![false; 2] };
        assert_eq!(share.all(), 0.0);
        (0..2).for_each(|_| share.member(0));
        assert_eq!(share.all(), 0.375);
        (0..9).for_each(|_| share.member(0));
        assert_eq!(share.all(), 0.75);
        (0..2).for_each(|index| share.done(index));
        assert_eq!(share.all(), 1.0);
    }
}
