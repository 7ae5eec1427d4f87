//! `tsubu sweep`: every case of a parameter sweep.

use crate::failure::Failure;
use crate::options::{FolderOptions, SceneOptions, WorkOptions, command_to_resume};
use crate::output;
use crate::progress::Progress;
use crate::{stop, table};
use clap::Args;
use std::fmt::Write as _;
use std::path::Path;
use std::sync::atomic::Ordering;
use tsubu::run::Watcher;
use tsubu_frame::{Existing, RunFolder, Table, csv::split_unit};

#[derive(Args)]
#[command(after_help = "\
Examples:
  tsubu sweep scene.toml --jobs 2
  tsubu sweep studies/my-study                  a folder with one scene.toml

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
}

pub fn run(options: &Options) -> Result<(), Failure> {
    let scene = options.scene.read()?;
    let folder = options.folder.folder(&options.scene, "-sweep");
    let pool = options.work.pool()?;
    if options.resume && !folder.is_dir() {
        return Err(Failure::wrong(format!("nothing to resume: {} is not a folder", folder.display())));
    }
    if options.folder.overwrite && scene.plan().sweep.is_some() {
        RunFolder::create(&folder, Existing::Overwrite).map_err(|error| Failure::of_file(&error, &folder))?;
    }
    let progress = Progress::new("sweep", options.work.quiet);
    let interrupted = stop::listen();
    let watcher = Watcher { interrupted, progress: &|done| progress.set(done) };
    let done = pool.install(|| tsubu::study::sweep::sweep(&scene, &folder, &watcher));
    progress.end();
    let summaries = done.map_err(|error| Failure::of_cases(&error, &folder))?;
    if interrupted.load(Ordering::Relaxed) {
        let message = format!("interrupted; finished cases and checkpoints are in {}", folder.display());
        return Err(Failure::interrupted(message).hint(format!("go on with `{}`", command_to_resume())));
    }
    output::print(&told(&folder)?)?;
    output::tell(&format!("results in {}; figures and a page: tsubu report {0}\n", folder.display()));
    let failed: usize = summaries.iter().flat_map(|s| &s.claims).filter(|claim| !claim.pass).count();
    if failed == 0 { Ok(()) } else { Err(Failure::claim()) }
}

/// Results that fit beside the case's name.
const SHOWN: usize = 6;

fn told(folder: &Path) -> Result<String, Failure> {
    let sweep = Table::read(&folder.join("sweep.csv")).map_err(|error| Failure::of_file(&error, folder))?;
    let columns: Vec<usize> = (0..sweep.header.len())
        .filter(|&c| sweep.header[c] == "case [text]" || split_unit(&sweep.header[c]).1 != Some("text"))
        .collect();
    let shown = &columns[..columns.len().min(SHOWN)];
    let mut rows = vec![shown.iter().map(|&c| split_unit(&sweep.header[c]).0.to_owned()).collect::<Vec<_>>()];
    rows.extend(sweep.rows.iter().map(|row| shown.iter().map(|&c| cell(&row[c])).collect()));
    let mut text = table::aligned(&rows);
    if columns.len() > SHOWN {
        let file = folder.join("sweep.csv");
        let _ = writeln!(text, "  and {} more columns in {}", columns.len() - SHOWN, file.display());
    }
    Ok(text)
}

fn cell(cell: &tsubu_frame::Cell) -> String {
    cell.number().map_or_else(|| cell.to_string(), table::number)
}
