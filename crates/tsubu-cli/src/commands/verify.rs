//! `tsubu verify`: claims held against their sources.

use super::{claims, report};
use crate::failure::Failure;
use crate::options::WorkOptions;
use crate::output;
use crate::progress::Progress;
use crate::stream::Stream;
use crate::{stop, table};
use clap::Args;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::mpsc;
use tsubu_frame::{Claim, Existing, RunFolder};
use tsubu_verify::{self as verify, Case};

#[derive(Args)]
#[command(after_help = "\
Examples:
  tsubu verify                       all quick cases
  tsubu verify --list                what there is
  tsubu verify damper-2003           one study
  tsubu verify --all -o out/verify   everything, with a report

A line a claim: pass or FAIL, study, name, value, accepted range, source. Exit code 1 if one fails.")]
pub struct Options {
    /// Cases or studies; none means all quick ones
    #[arg(value_name = "NAME")]
    names: Vec<String>,
    /// List the cases, with the seconds that each may take
    #[arg(long)]
    list: bool,
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
        return list(&chosen);
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
    let failed = claims.iter().filter(|claim| !claim.pass).count();
    let total = claims.len();
    output::print(&match failed {
        0 => format!("{total} claims, all pass\n"),
        n => format!("{total} claims, {}\n", Stream::Data.bold_red(&format!("{n} FAIL"))),
    })?;
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
    if failed == 0 { Ok(()) } else { Err(Failure::claim()) }
}

fn list(cases: &[&Case]) -> Result<(), Failure> {
    let mut rows = vec![["case", "study", "budget", "what it checks"].map(str::to_owned).to_vec()];
    rows.extend(
        cases.iter().map(|case| [case.name, case.study, &case.budget_text(), case.about].map(str::to_owned).to_vec()),
    );
    output::print(&table::aligned(&rows))
}

/// Runs the cases side by side and prints each one's claims as soon as it and all before it are done.
fn judge(cases: &[&'static Case], folder: Option<&RunFolder>, options: &Options) -> Result<Vec<Claim>, Failure> {
    let pool = options.work.pool()?;
    let progress = Progress::new("verify", options.work.quiet);
    stop::so_far(so_far(0, cases.len(), ""));
    let (sender, receiver) = mpsc::channel();
    let claims = pool.in_place_scope(|scope| {
        for (index, case) in cases.iter().copied().enumerate() {
            let sender = sender.clone();
            scope.spawn(move |_| {
                // Nobody listens any more once printing has failed.
                let _ = sender.send((index, case.claims(folder)));
            });
        }
        drop(sender);
        let mut waiting = BTreeMap::new();
        let mut claims = Vec::new();
        let (mut next, mut done) = (0, 0_usize);
        for (index, outcome) in receiver {
            waiting.insert(index, outcome);
            done += 1;
            while let Some(outcome) = waiting.remove(&next) {
                let of_case = outcome.unwrap_or_else(|error| vec![broken(cases[next], &error)]);
                let lines: String = of_case.iter().map(claims::line).collect();
                progress.hide_while(|| output::print(&lines))?;
                claims.extend(of_case);
                next += 1;
            }
            let untold = waiting.values().flatten().flatten().map(claims::line);
            stop::so_far(so_far(done, cases.len(), &untold.collect::<String>()));
            progress.set(done as f64 / cases.len() as f64);
        }
        Ok(claims)
    });
    progress.end();
    claims
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
    Claim::judge(case.name, f64::NAN, None, None, reason).of(case.study)
}
