//! `tsubu verify`: claims held against their sources.

use super::{claims, origins, report};
use crate::failure::Failure;
use crate::options::WorkOptions;
use crate::output;
use crate::progress::Progress;
use crate::stream::Stream;
use crate::{stop, table};
use clap::Args;
use rayon::ThreadPoolBuilder;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::time::Instant;
use tsubu_frame::{Claim, Existing, Origin, RunFolder, Source, Verdict};
use tsubu_verify::{self as verify, Case};

#[derive(Args)]
#[command(after_help = "\
Examples:
  tsubu verify                       all quick cases
  tsubu verify --list                what there is
  tsubu verify damper-2003           one study
  tsubu verify --all -o out/verify   everything, with a report

A line a claim: pass, FAIL or undecided, study, name, value, accepted range, source. Exit code 1 unless all pass.")]
#[expect(clippy::struct_excessive_bools, reason = "flags of the command line")]
pub struct Options {
    /// Cases or studies; none means all quick ones
    #[arg(value_name = "NAME")]
    names: Vec<String>,
    /// List the cases, with the seconds that each may take
    #[arg(long)]
    list: bool,
    /// With `--list`: where each accepted range comes from, and what was refused when it was wrong on purpose
    #[arg(long, requires = "list")]
    origins: bool,
    /// Run every case a second time with constants that are 5 % too small, and keep which claims notice
    #[arg(long)]
    controls: bool,
    /// Run the long ones too: those with a budget of more than a minute, and those that show a gap
    #[arg(long)]
    all: bool,
    /// Folder for verify.json, figures and report.html
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Replace the results that are in the folder
    #[arg(long, requires = "output")]
    overwrite: bool,
    #[command(flatten)]
    work: WorkOptions,
}

pub fn run(options: &Options) -> Result<(), Failure> {
    let chosen = verify::chosen(&options.names, options.all || options.list).map_err(Failure::wrong)?;
    if options.list {
        return if options.origins { output::print(&origins::list(&chosen)) } else { list(&chosen) };
    }
    let existing = if options.overwrite { Existing::Overwrite } else { Existing::Refuse };
    let folder = match &options.output {
        Some(path) => {
            let folder = RunFolder::create(path, existing, ["verify.json"]);
            Some(folder.map_err(|error| Failure::of_file(&error, path))?)
        }
        None => None,
    };
    let claims = judge(&chosen, folder.as_ref(), options)?;
    output::print(&verdicts(&claims))?;
    if let Some(folder) = folder {
        let content = serde_json::json!({ "tsubu_version": tsubu::VERSION, "claims": claims });
        let written = folder.write_json("verify.json", &content).and_then(|()| folder.sync());
        written.map_err(|error| Failure::of_file(&error, folder.path()))?;
        let path = folder.path().to_owned();
        // The report takes the folder for itself.
        drop(folder);
        let page = report::write(&path)?;
        output::tell(&format!("results in {}; open {}\n", path.display(), page.display()));
    }
    if claims.iter().all(|claim| claim.pass) { Ok(()) } else { Err(Failure::claim()) }
}

/// How many of the claims pass, fail and are undecided, the last on a line of their own; regressions are counted apart.
fn verdicts(claims: &[Claim]) -> String {
    let (regressions, claims): (Vec<&Claim>, Vec<&Claim>) =
        claims.iter().partition(|claim| claim.origin == Origin::Regression);
    let count = |verdict| claims.iter().filter(|claim| claim.verdict() == verdict).count();
    let mut text = match count(Verdict::Fail) {
        0 if claims.iter().all(|claim| claim.pass) => format!("{} claims, all pass\n", claims.len()),
        0 => format!("{} claims, none fails\n", claims.len()),
        n => format!("{} claims, {}\n", claims.len(), Stream::Data.bold_red(&format!("{n} FAIL"))),
    };
    let undecided = count(Verdict::Undecided);
    if undecided > 0 {
        let word = Stream::Data.yellow(&format!("{undecided} undecided"));
        let _ = writeln!(text, "{word}: the interval of the ensemble lies neither in the range nor outside");
    }
    if !regressions.is_empty() {
        let moved = regressions.iter().filter(|claim| !claim.pass).count();
        let word = if moved == 0 { "none moved".to_owned() } else { Stream::Data.bold_red(&format!("{moved} FAIL")) };
        let _ = writeln!(text, "{} regression checks, {word}", regressions.len());
    }
    text
}

fn list(cases: &[&Case]) -> Result<(), Failure> {
    let mut rows = vec![["case", "study", "budget", "what it checks"].map(str::to_owned).to_vec()];
    rows.extend(
        cases.iter().map(|case| [case.name, case.study, &case.budget_text(), case.about].map(str::to_owned).to_vec()),
    );
    output::print(&table::aligned(&rows))
}

/// Runs the cases and prints each one's claims as soon as it and all before it are done.
fn judge(cases: &[&'static Case], folder: Option<&RunFolder>, options: &Options) -> Result<Vec<Claim>, Failure> {
    let threads = options.work.pool()?.current_num_threads();
    let progress = Progress::new("verify", options.work.quiet);
    let how = How { folder, controls: options.controls };
    stop::so_far(so_far(0, cases.len(), ""));
    let (mut waiting, mut claims) = (BTreeMap::new(), Vec::new());
    let (mut next, mut done) = (0, 0_usize);
    let judged = side_by_side(cases, threads, how, |index, outcome| {
        waiting.insert(index, outcome);
        done += 1;
        while let Some(outcome) = waiting.remove(&next) {
            let lines: String = outcome.claims.iter().map(claims::line).collect();
            progress.hide_while(|| {
                outcome.late.iter().for_each(|text| output::tell(text));
                output::print(&lines)
            })?;
            claims.extend(outcome.claims);
            next += 1;
        }
        let untold = waiting.values().flat_map(|outcome| &outcome.claims).map(claims::line);
        stop::so_far(so_far(done, cases.len(), &untold.collect::<String>()));
        progress.set(done as f64 / cases.len() as f64);
        Ok(())
    });
    progress.end();
    judged.map(|()| claims)
}

/// How cases are run.
#[derive(Clone, Copy, Default)]
struct How<'a> {
    /// Where they leave pictures and tables.
    folder: Option<&'a RunFolder>,
    /// A second time, with constants that are wrong.
    controls: bool,
}

/// What came of a case.
struct Outcome {
    claims: Vec<Claim>,
    /// A warning where it took longer than it may.
    late: Option<String>,
}

/// Runs the cases in their order, as many at once as there are threads, and hears of each when it is done. A case has threads of
/// its own, one of them as a rule: in a pool that all shared, a case that hands out work would do another case while it waits,
/// and take that one's time as well.
fn side_by_side(
    cases: &[&'static Case],
    threads: usize,
    how: How<'_>,
    mut hear: impl FnMut(usize, Outcome) -> Result<(), Failure>,
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
                    // Nobody listens any more once printing has failed.
                    if sender.send((index, pool.install(|| outcome(case, how)))).is_err() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        receiver.into_iter().try_for_each(|(index, outcome)| hear(index, outcome))
    })
}

/// Runs a case and looks at the clock.
fn outcome(case: &Case, how: How<'_>) -> Outcome {
    let begun = Instant::now();
    let claims = case.claims(how.folder);
    let taken = begun.elapsed().as_secs_f64();
    let claims = if how.controls { claims.and_then(|claims| case.with_controls(claims)) } else { claims };
    let claims = claims.unwrap_or_else(|error| vec![broken(case, &error)]);
    let late = (taken > f64::from(case.budget)).then(|| {
        let (name, budget) = (case.name, case.budget);
        format!(
            "{}: `{name}` took {taken:.1} s, longer than its budget of {budget} s\n",
            Stream::Error.yellow("warning")
        )
    });
    Outcome { claims, late }
}

/// What is said of an interrupted verification; `untold` are the claims of cases that were done before others ahead of them.
fn so_far(done: usize, all: usize, untold: &str) -> String {
    let told = if done == 0 { "" } else { "; their claims were told" };
    let text = format!(": {done} of {all} cases were done{told}");
    if untold.is_empty() { text } else { format!("{text}, the last of them here:\n{}", untold.trim_end()) }
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
    use std::time::Duration;

    fn case(budget: u32, run: fn(f64) -> verify::Judged) -> &'static Case {
        Box::leak(Box::new(Case { name: "some", study: "none", about: "", budget, gap: false, run, kept: None }))
    }

    #[expect(clippy::unnecessary_wraps, reason = "what a case gives")]
    fn value(value: usize) -> verify::Judged {
        Ok(vec![Claim::judge("value", value as f64, Some(0.0), None, Source::new(Origin::Own, "a test"))])
    }

    fn heard(cases: &[&'static Case], threads: usize) -> Vec<(f64, bool)> {
        let mut heard = Vec::new();
        let done = side_by_side(cases, threads, How::default(), |_, outcome| {
            heard.push((outcome.claims[0].value, outcome.late.is_some()));
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
        let told = outcome(case(0, run), How::default()).late.unwrap_or_default();
        assert!(told.starts_with("warning: `some` took 0.0 s, longer than its budget of 0 s"), "{told}");
    }

    /// All threads were one pool: a case that handed out work did other cases while it waited, and the clock counted them.
    #[test]
    fn cases_run_at_once_on_threads_of_their_own() {
        static HERE: AtomicU32 = AtomicU32::new(0);
        let meet = |_: f64| {
            HERE.fetch_add(1, Ordering::SeqCst);
            let begun = Instant::now();
            while HERE.load(Ordering::SeqCst) < 2 {
                if begun.elapsed() > Duration::from_secs(20) {
                    return Err("the other case did not come".to_owned());
                }
                std::thread::yield_now();
            }
            value(rayon::current_num_threads())
        };
        assert_eq!(heard(&[case(60, meet), case(60, meet)], 2), [(1.0, false), (1.0, false)]);
        let count = |_: f64| value(rayon::current_num_threads());
        let mut counts = heard(&[case(60, count), case(60, count)], 5);
        counts.sort_by(|a, b| a.0.total_cmp(&b.0));
        assert_eq!(counts, [(2.0, false), (3.0, false)]);
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
        let done = side_by_side(&cases, 1, How::default(), |_, _| Err(Failure::failed("the reader has gone")));
        assert!(done.is_err() && BEGUN.load(Ordering::SeqCst) < 10);
    }
}
