//! `tsubu bench`: how fast this machine is.

use crate::failure::Failure;
use crate::output;
use crate::progress::Progress;
use crate::{machine, stop, table};
use clap::{Args, value_parser};
use std::fmt::Write as _;
use std::path::PathBuf;
use tsubu::bench::{Bench, BenchError};
use tsubu::interrupt::Watcher;
use tsubu_frame::summary::write_json;

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

pub fn run(options: &Options) -> Result<(), Failure> {
    let progress = Progress::new("bench", options.quiet);
    let watcher = Watcher {
        interrupt: stop::interrupt("interrupted; nothing was written"),
        progress: &|done| progress.set(done),
    };
    let measured = Bench::measure(f64::from(options.seconds), &watcher);
    progress.end();
    let bench = measured.map_err(|error| match error {
        BenchError::Interrupted => Failure::interrupted("interrupted; nothing was written"),
        other => Failure::of_bench(&other),
    })?;
    output::print(&told(&bench))?;
    if let Some(folder) = &options.output {
        let file = folder.join("bench.json");
        write_json(&file, &bench).map_err(|error| Failure::failed(error.to_string()))?;
        output::tell(&format!("written to {}\n", file.display()));
    }
    match machine::remember(&bench) {
        Ok(file) => output::tell(&format!("kept in {}; `tsubu check` estimates from it\n", file.display())),
        Err(reason) => output::tell(&format!("not kept for `tsubu check`: {reason}\n")),
    }
    Ok(())
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
