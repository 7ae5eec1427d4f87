//! `tsubu run`: one scene to its end.

use super::claims;
use crate::failure::Failure;
use crate::looked_at::{LookedAt, PageOptions};
use crate::options::{FolderOptions, SceneOptions, WorkOptions};
use crate::session::{Session, judge, resume};
use crate::stream::Stream;
use crate::{machine, output, ranks, stop, table};
use clap::{Args, ValueEnum};
use std::fmt::Write as _;
use std::sync::Arc;
use tsubu::check::human_time;
use tsubu::interrupt::Watcher;
use tsubu::ranks::Communicator;
use tsubu::threads::alone;
use tsubu_frame::summary::mean_beside;
use tsubu_frame::{Existing, ResultValue, RunFolder, Status, Summary, unit::for_people};

#[derive(Args)]
#[command(after_help = "\
Examples:
  tsubu run damper.toml                                     into out/damper
  tsubu run damper.toml -o few --set particles.balls.count=10
  tsubu run damper.toml --resume                            go on after Ctrl-C or a power cut
  tsubu run damper.toml --view                              look at it in the browser as it goes on
  mpirun -n 4 tsubu run chute.toml                          on four ranks, with the same bits

The folder holds scene.toml (as run, with every default), summary.json, history.csv,
frames/ (for ParaView) and checkpoint/. `tsubu report DIR` makes figures and a page of it.")]
pub struct Options {
    #[command(flatten)]
    scene: SceneOptions,
    #[command(flatten)]
    folder: FolderOptions,
    /// Go on from the checkpoint in the folder
    #[arg(long, conflicts_with = "overwrite")]
    resume: bool,
    /// Look at it in the browser while it goes on: pause it, go on, stop it
    #[arg(long)]
    view: bool,
    #[command(flatten)]
    page: PageOptions,
    /// What does the work: the processor; a GPU does not yet
    #[arg(long, value_enum, default_value = "cpu", hide = true)]
    device: Device,
    #[command(flatten)]
    work: WorkOptions,
}

/// What can do the work of a run.
#[derive(Clone, Copy, ValueEnum)]
enum Device {
    Cpu,
    Gpu,
}

pub fn run(options: &Options) -> Result<(), Failure> {
    let Options { scene, folder, resume, view, page, device, work } = options;
    if let Device::Gpu = device {
        return Err(Failure::wrong("no engine of this tsubu works on a GPU yet: `--device gpu` is not there")
            .hint("leave it out: `--threads` and `mpirun -n N tsubu run SCENE` work on processors"));
    }
    if !view && (page.port != 0 || page.no_open) {
        return Err(Failure::wrong("`--port` and `--no-open` are of the page: add `--view`"));
    }
    let existing = if *resume { Existing::Resume } else { folder.existing() };
    let session = || Session::begin("run", "", scene, folder, work);
    let Some(ranks) = ranks::join()? else {
        let session = session()?;
        return if *view { run_shown(&session, existing, *page) } else { run_alone(&session, existing) };
    };
    let communicator = ranks.communicator();
    let session = match view {
        true => Err(Failure::wrong("`--view` shows a run on one rank; look at one on several with `tsubu view`")),
        false => session(),
    };
    let done = ranks::together(&**communicator, session).and_then(|session| match communicator.rank() {
        0 => lead(&session, existing, communicator),
        _ => follow(&session, communicator),
    });
    ranks::part(&**communicator, done)
}

/// The run on rank 0 of several.
fn lead(session: &Session, existing: Existing, communicator: &Arc<dyn Communicator>) -> Result<(), Failure> {
    let Session { scene, folder, .. } = session;
    let work = |watcher: &Watcher| {
        ranks::at_work(|| tsubu::run::run_on_ranks(scene, folder, existing, watcher, communicator.clone()))
    };
    let (done, _) = session.work(stop::NOT_BEGUN, work);
    let summary = done.map_err(|error| Failure::of_scene(&error, scene, folder))?;
    ended(session, &summary)
}

/// The run on another rank: the first tells how it went.
fn follow(session: &Session, communicator: &Arc<dyn Communicator>) -> Result<(), Failure> {
    let Session { scene, folder, .. } = session;
    let done = session.silently(|interrupt| ranks::at_work(|| tsubu::run::follow(scene, communicator, interrupt)));
    done.map_err(|error| Failure::of_scene(&error, scene, folder).quiet())
}

fn run_alone(session: &Session, existing: Existing) -> Result<(), Failure> {
    let Session { scene, folder, .. } = session;
    let work = |watcher: &Watcher| alone(|| tsubu::run::run(scene, folder, existing, watcher));
    let (done, _) = session.work(stop::NOT_BEGUN, work);
    let summary = done.map_err(|error| Failure::of_scene(&error, scene, folder))?;
    ended(session, &summary)
}

/// A run that a page shows.
pub fn run_shown(session: &Session, existing: Existing, page: PageOptions) -> Result<(), Failure> {
    let Session { scene, folder, .. } = session;
    let seen = LookedAt::begin(folder.display().to_string(), scene.plan(), page)?;
    let work = |watcher: &Watcher| alone(|| tsubu::run::run_seen(scene, folder, existing, watcher, &seen));
    let (done, _) = session.work(stop::NOT_BEGUN, work);
    match done {
        Err(error) => {
            seen.end(None, error.to_string());
            Err(Failure::of_scene(&error, scene, folder))
        }
        Ok(summary) => {
            let end = ended(session, &summary);
            let told = match summary.status {
                Status::Interrupted => resume(),
                _ => format!("results in {}", folder.display()),
            };
            seen.end(Some(summary), told);
            end
        }
    }
}

/// How the command ends with a run that came to some end.
fn ended(session: &Session, summary: &Summary) -> Result<(), Failure> {
    let Session { scene, folder, .. } = session;
    if summary.status == Status::Interrupted {
        let message = format!(
            "interrupted at t = {} s, step {}; the checkpoint is in {}",
            table::number(summary.simulated_seconds),
            summary.steps,
            folder.display()
        );
        return Err(Failure::interrupted(message).hint(resume()));
    }
    if let Some(bench) = machine::known() {
        let written = RunFolder::open(folder, ["bench.json"]).and_then(|folder| {
            folder.write_json("bench.json", &bench)?;
            folder.sync()
        });
        if let Err(error) = written {
            // The run is done, whatever this file does.
            output::tell(&format!("warning: the speed of this machine is not kept with the results: {error}\n"));
        }
    }
    session.show(&told(&scene.plan().title, summary), None)?;
    judge(&summary.claims)
}

/// A summary in a few lines.
fn told(title: &str, summary: &Summary) -> String {
    let mut text = String::new();
    if !title.is_empty() {
        let _ = writeln!(text, "{}", Stream::Data.bold_cyan(title));
    }
    let _ = writeln!(
        text,
        "  simulated  {} s in {} of {} s, {}, method {}",
        table::number(summary.simulated_seconds),
        plural(summary.steps, "step"),
        table::number(summary.time_step),
        plural(summary.particles, "grain"),
        summary.method
    );
    let _ = writeln!(
        text,
        "  computed   in {} {}with {}, {:.2e} particle-steps/s",
        human_time(summary.wall_seconds),
        summary
            .ranks
            .map(|ranks| format!("on {} ranks (imbalance {:.2}) ", ranks.count, ranks.imbalance))
            .unwrap_or_default(),
        plural(u64::from(summary.threads), "thread"),
        summary.particle_steps_per_second
    );
    let _ = writeln!(
        text,
        "  energy     residual {:.1e} of the energy turned over",
        summary.energy.residual_relative.abs()
    );
    let _ = writeln!(text, "  state      {}", summary.state_hash);
    text += &results(summary);
    if !summary.claims.is_empty() {
        let _ = writeln!(text, "  claims");
        for claim in &summary.claims {
            let _ = write!(text, "    {}", claims::line(claim));
        }
    }
    text + &warnings(&summary.warnings)
}

/// So many of something.
pub fn plural(n: u64, word: &str) -> String {
    format!("{n} {word}{}", if n == 1 { "" } else { "s" })
}

/// The results as a table: a mean stands beside its spread, its ends and the value at the end.
fn results(summary: &Summary) -> String {
    let twin = |name: &str, what: &str| match summary.results.get(&format!("{name} {what}")) {
        Some(ResultValue::Number(value)) => table::number(value * for_people(summary.unit(name)).0),
        _ => "-".to_owned(),
    };
    let is_twin = |name: &str| mean_beside(name).is_some_and(|mean| summary.results.get(mean).is_some());
    let mut rows =
        vec![["  result", "value or mean", "spread", "least", "largest", "at the end", ""].map(str::to_owned).to_vec()];
    let mut lists = 0;
    for (name, value) in summary.results_in_order().into_iter().filter(|(name, _)| !is_twin(name)) {
        let ResultValue::Number(value) = value else {
            lists += 1;
            continue;
        };
        let (factor, unit) = for_people(summary.unit(name));
        let [spread, least, largest, last] = ["spread", "least", "largest", "final"].map(|what| twin(name, what));
        let unit = unit.trim_matches('-').to_owned();
        rows.push(vec![format!("  {name}"), table::number(value * factor), spread, least, largest, last, unit]);
    }
    let table = if rows.len() > 1 { table::aligned(&rows) } else { String::new() };
    // A profile is for a figure, not for a line.
    if lists > 0 { format!("{table}  and {} in summary.json\n", plural(lists, "list")) } else { table }
}

/// Warnings, a line each.
pub fn warnings(list: &[String]) -> String {
    list.iter().fold(String::new(), |mut text, warning| {
        let _ = writeln!(text, "  {}: {warning}", Stream::Data.yellow("warning"));
        text
    })
}
