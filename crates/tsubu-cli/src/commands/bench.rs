//! `tsubu bench`: how fast this machine is.

use crate::failure::Failure;
use crate::output;
use crate::progress::Progress;
use crate::{machine, stop, table};
use clap::{Args, value_parser};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use tsubu::bench::{Bench, BenchError};
use tsubu::interrupt::Watcher;
use tsubu_frame::{Existing, RunFolder};

#[derive(Args)]
#[command(after_help = "\
Examples:
  tsubu bench                     about a minute; `tsubu check` estimates from the result
  tsubu bench --seconds 10 -o me  a quick look, and me/bench.json

Close other programs first: what they take is missing here.")]
pub struct Options {
    /// Time to measure for
    #[arg(long, value_name = "N", default_value_t = 60, value_parser = value_parser!(u32).range(1..=3600))]
    seconds: u32,
    /// Folder for bench.json as well
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// No progress on stderr
    #[arg(short, long)]
    quiet: bool,
}

/// Said where it was stopped.
const INTERRUPTED: &str = "interrupted; nothing was measured to the end";

/// The file in the folder that is asked for.
const FILE: &str = "bench.json";

pub fn run(options: &Options) -> Result<(), Failure> {
    // What cannot be written there must say so before a minute is spent on it.
    let folder = options.output.as_deref().map(opened).transpose()?;
    let progress = Progress::new("bench", options.quiet);
    let watcher = Watcher { interrupt: stop::interrupt(INTERRUPTED), progress: &|done| progress.set(done) };
    let measured = Bench::measure(f64::from(options.seconds), &watcher);
    progress.end();
    let bench = measured.map_err(|error| match error {
        BenchError::Interrupted => Failure::interrupted(INTERRUPTED),
        other => Failure::of_bench(&other),
    })?;
    output::print(&told(&bench))?;
    if let Some(folder) = &folder {
        let written = folder.write_json(FILE, &bench).and_then(|()| folder.sync());
        written.map_err(|error| Failure::of_file(&error, folder.path()))?;
        output::tell(&format!("written to {}\n", folder.file(FILE).display()));
    }
    match machine::remember(&bench) {
        Ok(file) => output::tell(&format!("kept in {}; `tsubu check` estimates from it\n", file.display())),
        Err(reason) => output::tell(&format!("not kept for `tsubu check`: {reason}\n")),
    }
    Ok(())
}

/// The folder with room for the file: a new one, or one that is there.
fn opened(folder: &Path) -> Result<RunFolder, Failure> {
    let names = [FILE];
    let opened = if folder.is_dir() {
        RunFolder::open(folder, names)
    } else {
        RunFolder::create(folder, Existing::Refuse, names)
    };
    opened.map_err(|error| Failure::of_file(&error, folder))
}

fn told(bench: &Bench) -> String {
    let mut rows =
        vec![["work", "grains", "threads", "particle-steps/s", "contacts/s", "scaling"].map(str::to_owned).to_vec()];
    rows.extend(bench.rows.iter().map(|row| {
        vec![
            row.work.clone(),
            row.particles.to_string(),
            row.threads.to_string(),
            format!("{:.2e}", row.particle_steps_per_second),
            format!("{:.2e}", row.contacts_per_second),
            format!("{:.2}", row.scaling),
        ]
    }));
    let mut text = table::aligned(&rows);
    let _ = writeln!(text, "  {}, tsubu {}", bench.processor, bench.tsubu_version);
    text
}
