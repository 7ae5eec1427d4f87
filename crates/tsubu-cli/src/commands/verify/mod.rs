//! `tsubu verify`: claims held against their sources.

mod against;
mod apart;
pub mod runner;

use super::{claims, origins};
use crate::failure::Failure;
use crate::launch::{LaunchOptions, Left, Runs as _};
use crate::options::WorkOptions;
use crate::output;
use crate::session;
use crate::stream::Stream;
use crate::table;
use against::Against;
use apart::Cases;
use clap::Args;
use runner::Outcome;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tsubu_frame::{Claim, Existing, Origin, RunFolder, Verdict};
use tsubu_verify::{self as verify, Archive, Case, How};

/// The file of the results; it is written when all cases are done.
const RESULTS: &str = "verify.json";

#[derive(Args)]
#[command(after_help = "\
Examples:
  tsubu verify                       all quick cases
  tsubu verify --list                what there is
  tsubu verify damper-2003           one study
  tsubu verify --all -o out/verify   everything, with a report
  tsubu verify --all --against stored -o out/night
                                     what moved since the claims were stored
  tsubu verify --all -o out/night --launcher slurm
                                     each case a task of its own

A line a claim: pass, FAIL or undecided, study, name, value, accepted range, source. Exit code 1 unless all pass.
With -o, cases and runs of ensembles that are done are kept: an interrupted verification goes on where it was
when the same command is typed again.")]
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
    /// Print what is not as it was stored instead of all claims, and what each case cost; exit code 1 if something moved
    #[arg(long, value_name = "WHAT")]
    against: Option<Against>,
    /// Folder for verify.json, figures and report.html, and for what is done as long as the rest is not
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Replace the results that are in the folder
    #[arg(long, requires = "output")]
    overwrite: bool,
    /// Keep what the same program has done in the folder; this happens anyway where it was interrupted
    #[arg(long, requires = "output", conflicts_with = "overwrite")]
    resume: bool,
    #[command(flatten)]
    work: WorkOptions,
    #[command(flatten)]
    launch: LaunchOptions,
}

pub fn run(options: &Options) -> Result<(), Failure> {
    let mut chosen = verify::chosen(&options.names, options.all || options.list).map_err(Failure::wrong)?;
    if options.list {
        return if options.origins { output::print(&origins::list(&chosen)) } else { list(&chosen) };
    }
    if options.against.is_some() {
        against::telling_first(&mut chosen);
    }
    if !options.launch.is_here()? {
        return apart(options, chosen);
    }
    let archive = options.output.as_ref().map(|path| archive(path, options)).transpose()?;
    let how = How { archive, controls: options.controls };
    let threads = options.work.pool()?.current_num_threads();
    let outcomes =
        runner::judge(&chosen, &how, threads, options.work.quiet, |case, outcome| lines(options, case, outcome))?;
    let wrong = told(options, &chosen, &outcomes)?;
    if let Some(archive) = how.archive {
        write(archive.folder(), &outcomes)?;
        let path = archive.folder().path().to_owned();
        // The report takes the folder for itself.
        drop(archive);
        page(&path)?;
    }
    if wrong { Err(Failure::claim()) } else { Ok(()) }
}

/// The cases are done apart, or what is there of them is gathered.
fn apart(options: &Options, chosen: Vec<&'static Case>) -> Result<(), Failure> {
    let mut cases = Cases::new(options, chosen)?;
    let Left::Gather = options.launch.go("verify", &mut cases, options.overwrite, &options.work)? else {
        return Ok(());
    };
    cases.goes_on()?;
    let (done, missing) = cases.gather();
    let (chosen, outcomes): (Vec<&'static Case>, Vec<Outcome>) = done.into_iter().unzip();
    for (case, outcome) in chosen.iter().zip(&outcomes) {
        output::print(&lines(options, case, outcome))?;
    }
    let wrong = told(options, &chosen, &outcomes)?;
    write(&cases.results()?, &outcomes)?;
    page(cases.folder())?;
    if !missing.is_empty() {
        output::tell(&missing.concat());
        let message = format!("{} of {} cases have no result", missing.len(), missing.len() + chosen.len());
        return Err(Failure::failed(message).hint("the same command as before does what is missing, and nothing else"));
    }
    if wrong { Err(Failure::claim()) } else { Ok(()) }
}

/// What is told of a case.
fn lines(options: &Options, case: &Case, outcome: &Outcome) -> String {
    match options.against {
        Some(Against::Stored) => against::lines(case, outcome),
        None => outcome.claims.iter().map(claims::line).collect(),
    }
}

/// Tells what came of all; gives whether something is not as it should be.
fn told(options: &Options, chosen: &[&'static Case], outcomes: &[Outcome]) -> Result<bool, Failure> {
    if let Some(Against::Stored) = options.against {
        let (text, moved) = against::end(chosen, outcomes);
        return output::print(&text).map(|()| moved);
    }
    let claims: Vec<&Claim> = outcomes.iter().flat_map(|outcome| &outcome.claims).collect();
    output::print(&verdicts(&claims))?;
    Ok(claims.iter().any(|claim| !claim.pass))
}

/// Makes the page of the results in a folder, and says where they are.
fn page(path: &Path) -> Result<(), Failure> {
    let page = session::page(path)?;
    output::tell(&format!("results in {}; open {}\n", path.display(), page.display()));
    Ok(())
}

/// The folder, with what is kept in it. One in which a verification was begun and did not come to its end is gone on with.
fn archive(path: &Path, options: &Options) -> Result<Arc<Archive>, Failure> {
    let begun = ["cases", "members"].iter().any(|name| path.join(name).is_dir());
    let existing = if options.overwrite {
        Existing::Overwrite
    } else if options.resume || begun && !path.join(RESULTS).exists() {
        Existing::Resume
    } else {
        Existing::Refuse
    };
    let archive = RunFolder::create(path, existing, [RESULTS]).and_then(Archive::new);
    archive.map(Arc::new).map_err(|error| Failure::of_file(&error, path))
}

fn write(folder: &RunFolder, outcomes: &[Outcome]) -> Result<(), Failure> {
    let runs: Vec<_> = outcomes.iter().filter_map(|outcome| outcome.run.as_ref()).collect();
    let claims: Vec<_> = outcomes.iter().flat_map(|outcome| &outcome.claims).collect();
    let content = serde_json::json!({ "tsubu_version": tsubu::VERSION, "runs": runs, "claims": claims });
    let written = folder.write_json(RESULTS, &content).and_then(|()| folder.sync());
    written.map_err(|error| Failure::of_file(&error, folder.path()))
}

/// How many of the claims pass, fail and are undecided, the last on a line of their own; controls and regressions are counted apart.
fn verdicts(claims: &[&Claim]) -> String {
    let of = |origin: Origin| claims.iter().filter(move |claim| claim.origin == origin);
    let apart = [Origin::Control, Origin::Regression];
    let (controls, regressions) = (of(apart[0]).count(), of(apart[1]).count());
    let wrong = apart.map(|origin| of(origin).filter(|claim| !claim.pass).count());
    let claims: Vec<&Claim> = claims.iter().copied().filter(|claim| !apart.contains(&claim.origin)).collect();
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
    let mut also = |number: usize, what: &str, wrong: usize, well: &str| {
        if number > 0 {
            let word = if wrong == 0 { well.to_owned() } else { Stream::Data.bold_red(&format!("{wrong} FAIL")) };
            let _ = writeln!(text, "{number} {what}, {word}");
        }
    };
    also(controls, "controls", wrong[0], "each is refused");
    also(regressions, "regression checks", wrong[1], "none moved");
    text
}

fn list(cases: &[&Case]) -> Result<(), Failure> {
    let mut rows = vec![["case", "study", "budget", "what it checks"].map(str::to_owned).to_vec()];
    rows.extend(
        cases.iter().map(|case| [case.name, case.study, &case.budget_text(), case.about].map(str::to_owned).to_vec()),
    );
    output::print(&table::aligned(&rows))
}
