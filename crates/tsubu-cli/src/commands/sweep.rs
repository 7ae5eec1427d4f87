//! `tsubu sweep`: every case of a parameter sweep.

use super::run::warnings;
use crate::failure::Failure;
use crate::launch::{LaunchOptions, Left, Logs, OfStudy};
use crate::options::{FolderOptions, SceneOptions, WorkOptions};
use crate::session::{Session, judge, resume};
use crate::{ranks, table};
use clap::Args;
use std::fmt::Write as _;
use std::path::Path;
use std::sync::Arc;
use tsubu::interrupt::{Interrupt, Watcher};
use tsubu::ranks::Communicator;
use tsubu::study::sweep::{Outcome, Sweep};
use tsubu_frame::{Status, Summary, Table, csv::split_unit, unit::for_people};

#[derive(Args)]
#[command(after_help = "\
Examples:
  tsubu sweep scene.toml --jobs 2
  tsubu sweep studies/my-study                  a folder with one scene.toml
  tsubu sweep scene.toml --launcher slurm       an array job, and a last one that gathers

The scene says what varies:
  [sweep]
  vary = { \"particles.balls.count\" = [10, 20, 50] }

An interrupted sweep goes on where it was when the same command is typed again.")]
pub struct Options {
    #[command(flatten)]
    scene: SceneOptions,
    #[command(flatten)]
    folder: FolderOptions,
    /// Go on where an interrupted sweep stopped; this happens anyway
    #[arg(long, conflicts_with = "overwrite")]
    resume: bool,
    #[command(flatten)]
    work: WorkOptions,
    #[command(flatten)]
    launch: LaunchOptions,
}

impl Options {
    /// Whether it does single cases, as a task does.
    pub fn is_task(&self) -> bool {
        !self.launch.cases().is_empty()
    }
}

pub fn run(options: &Options) -> Result<(), Failure> {
    if options.is_task()
        && let Some(ranks) = ranks::join()?
    {
        return on_ranks(options, ranks.communicator());
    }
    let session = Session::begin("sweep", "-sweep", &options.scene, &options.folder, &options.work)?;
    if options.resume {
        session.needs_folder()?;
    }
    let Session { scene, folder, .. } = &session;
    if !options.launch.is_here()? {
        return apart(options, &session);
    }
    let overwrite = options.folder.overwrite;
    let work = |watcher: &Watcher| tsubu::study::sweep::sweep(scene, folder, overwrite, watcher);
    let (done, interrupt) = session.work(&format!("interrupted; {}", resume()), work);
    let summaries = done.map_err(|error| Failure::of_cases(&error, scene, folder))?;
    if interrupt.asked() {
        let message = format!("interrupted; finished cases and checkpoints are in {}", folder.display());
        return Err(Failure::interrupted(message).hint(resume()));
    }
    session.show(&told(folder, summaries.iter().all(is_whole))?, None)?;
    let broken = summaries.iter().filter(|summary| summary.status == Status::Failed).count();
    if broken > 0 {
        let message = format!("{broken} of {} cases failed; the others are whole", summaries.len());
        return Err(Failure::failed(message).hint("the remarks above and in sweep.csv say why"));
    }
    judge(summaries.iter().flat_map(|summary| &summary.claims))
}

fn is_whole(summary: &Summary) -> bool {
    summary.status == Status::Finished
}

/// A task on several ranks.
fn on_ranks(options: &Options, communicator: &Arc<dyn Communicator>) -> Result<(), Failure> {
    let session = Session::begin("sweep", "-sweep", &options.scene, &options.folder, &options.work);
    let done = ranks::together(&**communicator, session).and_then(|session| {
        let Session { scene, folder, .. } = &session;
        let broken = |error| Failure::of_cases(&error, scene, folder);
        let sweep = Sweep::new(scene, folder).map_err(broken);
        let sweep = ranks::together(&**communicator, sweep)?;
        if communicator.rank() > 0 {
            let follow = |interrupt: &Interrupt| ranks::at_work(|| sweep.follow(communicator, interrupt));
            return session.silently(follow).map_err(|error| broken(error).quiet());
        }
        let runs = &mut OfStudy { study: &mut sweep.on_ranks(communicator.clone()), session: &session };
        options.launch.go("sweep", runs, false, &options.work).map(|_| ())
    });
    ranks::part(&**communicator, done)
}

/// The cases are done apart, or what is there of them is gathered.
fn apart(options: &Options, session: &Session) -> Result<(), Failure> {
    let Session { scene, folder, .. } = session;
    let broken = |error| Failure::of_cases(&error, scene, folder);
    let mut sweep = Sweep::new(scene, folder).map_err(broken)?;
    let runs = &mut OfStudy { study: &mut sweep, session };
    let Left::Gather = options.launch.go("sweep", runs, options.folder.overwrite, &options.work)? else {
        return Ok(());
    };
    let logs = Logs::read(folder);
    let outcomes = sweep.gather(&|name| logs.why(name)).map_err(broken)?;
    let page = session.page()?;
    let all = outcomes.len();
    let summaries: Vec<Summary> = outcomes.into_iter().filter_map(Outcome::summary).collect();
    let whole = summaries.iter().filter(|summary| is_whole(summary)).count();
    session.show(&told(folder, whole == all)?, Some(&page))?;
    if whole < all {
        let message = format!("{} of {all} cases failed or are missing; the others are whole", all - whole);
        return Err(Failure::failed(message)
            .hint("the remarks above and in sweep.csv say why")
            .hint("the same command as before does what is missing, and nothing else"));
    }
    judge(summaries.iter().flat_map(|summary| &summary.claims))
}

/// Results that fit beside the case's name.
const SHOWN: usize = 6;

fn told(folder: &Path, whole: bool) -> Result<String, Failure> {
    let sweep = Table::read(&folder.join("sweep.csv")).map_err(|error| Failure::of_file(&error, folder))?;
    let unit = |c: usize| split_unit(&sweep.header[c]).1.unwrap_or("-");
    let known = |c: &usize| ["wall seconds [s]", "energy residual [-]"].contains(&sweep.header[*c].as_str());
    let (cost, results): (Vec<usize>, Vec<usize>) =
        (0..sweep.header.len()).filter(|&c| unit(c) != "text").partition(known);
    let mut shown = sweep.index("case [text]").into_iter().collect::<Vec<_>>();
    if !whole {
        shown.extend(sweep.index("status [text]"));
    }
    shown.extend(results.iter().chain(&cost).take(SHOWN));
    let mut rows = vec![shown.iter().map(|&c| heading(&sweep.header[c])).collect::<Vec<_>>()];
    rows.extend(sweep.rows.iter().map(|row| {
        let cell = |&c: &usize| {
            row[c].number().map_or_else(|| row[c].to_string(), |x| table::number(x * for_people(unit(c)).0))
        };
        shown.iter().map(cell).collect()
    }));
    let mut text = table::aligned(&rows);
    if results.len() + cost.len() > SHOWN {
        let file = folder.join("sweep.csv");
        let _ = writeln!(text, "  and {} more columns in {}", results.len() + cost.len() - SHOWN, file.display());
    }
    let names = sweep.texts("case").unwrap_or_default().into_iter();
    for (case, remark) in names.zip(sweep.texts("remark").unwrap_or_default()).filter(|(_, r)| !r.is_empty()) {
        text += &warnings(&[format!("case `{case}`: {remark}")]);
    }
    Ok(text)
}

/// Name and unit of a column as people read them.
fn heading(header: &str) -> String {
    match split_unit(header) {
        (name, Some("text" | "-") | None) => name.to_owned(),
        (name, Some(unit)) => format!("{name} [{}]", for_people(unit).1),
    }
}
