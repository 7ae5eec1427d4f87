//! The guards as a program; `cargo xtask fuzz` starts it.

use clap::{Args, Parser, Subcommand};
use std::io;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;
use tsubu_guard::bundle::Bundle;
use tsubu_guard::kind::Kind;
use tsubu_guard::{corpus, fuzz, kills, limits, variants, work};

/// Standing guards of tsubu.
#[derive(Parser)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Draw cases and judge them
    Fuzz(Fuzz),
    /// Kill runs of all kinds at random moments, resume them, and hold what they give against runs left alone
    Kills {
        /// Seed of runs and moments
        #[arg(long, default_value_t = 1)]
        seed: u64,
        /// How many kills
        #[arg(long, default_value_t = 200)]
        kills: u64,
        /// Runs of this scene alone
        #[arg(long)]
        only: Option<String>,
    },
    /// One answer for every way to compute it: scenes by methods, in ten ways that must not matter
    Variants(variants::Options),
    /// Scenes by this program and by an earlier build of it: does a change that must not change a number change one
    Same(variants::Earlier),
    /// Judge kept cases again: folders with a case each
    Replay {
        /// The kind of the cases
        kind: Kind,
        /// Their folders
        folders: Vec<PathBuf>,
    },
    /// Judge a range of cases (what `fuzz` starts)
    #[command(hide = true)]
    Work { kind: Kind, folder: PathBuf, seed: u64, from: u64, to: u64 },
    /// Judge one kept case (what `replay` starts)
    #[command(hide = true)]
    Judge { kind: Kind, folder: PathBuf, case: PathBuf },
}

#[derive(Args)]
struct Fuzz {
    /// Seed of all cases
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// How long at most [s]
    #[arg(long, default_value_t = 60.0)]
    seconds: f64,
    /// How many cases of each kind at most
    #[arg(long)]
    cases: Option<u64>,
    /// The case of this number alone
    #[arg(long, requires = "only", conflicts_with = "cases")]
    case: Option<u64>,
    /// Cases of these kinds alone, with commas between them
    #[arg(long, value_delimiter = ',')]
    only: Vec<Kind>,
    /// The folder for what is found, instead of the corpus
    #[arg(long, value_name = "DIR")]
    keep: Option<PathBuf>,
}

fn main() -> ExitCode {
    let held = match Arguments::parse().command {
        Command::Fuzz(options) => options.fuzz(),
        Command::Kills { seed, kills, only } => kill(seed, kills, only),
        Command::Variants(options) => variants::variants(&options).map_err(io::Error::other),
        Command::Same(options) => variants::same(&options).map_err(io::Error::other),
        Command::Replay { kind, folders } => replay(kind, &folders),
        Command::Work { kind, folder, seed, from, to } => work::work(kind, &folder, seed, from..to).map(|()| true),
        Command::Judge { kind, folder, case } => {
            Bundle::read(&case).and_then(|case| work::judge(kind, &folder, &case)).map(|()| true)
        }
    };
    match held {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

impl Fuzz {
    /// Whether all held.
    fn fuzz(&self) -> io::Result<bool> {
        let wanted = |kind: &Kind| self.only.is_empty() || self.only.contains(kind);
        let kinds: Vec<Kind> = Kind::ALL.into_iter().filter(wanted).collect();
        let shares: f64 = kinds.iter().map(|kind| kind.share()).sum();
        let mut held = true;
        println!("{:<12} {:>10} {:>10} {:>9} {:>9}", "seed", self.seed, "accepted", "a second", "found");
        for kind in kinds {
            let options = fuzz::Options {
                seed: self.seed,
                from: self.case.unwrap_or(0),
                cases: self.case.map_or(self.cases.unwrap_or(u64::MAX), |_| 1),
                time: Duration::from_secs_f64(self.seconds * kind.share() / shares),
                keep: self.keep.clone().unwrap_or_else(corpus::folder),
            };
            let tally = fuzz::fuzz(kind, &options)?;
            held &= tally.found.is_empty();
            let (cases, found) = (tally.cases, tally.found.len());
            println!(
                "{:<12} {cases:>10} {:>10} {:>9.0} {found:>9}",
                kind.name(),
                tally.accepted,
                cases as f64 / tally.seconds
            );
            for (text, (times, first)) in &tally.found {
                println!("  {times} times, first in case {first}: {text}");
            }
        }
        Ok(held)
    }
}

fn kill(seed: u64, kills: u64, only: Option<String>) -> io::Result<bool> {
    let tally = kills::kills(&kills::Options { seed, kills, only, tsubu: limits::beside("tsubu")? })?;
    println!("\nseed {seed}: {} kills in {} runs, {} gave another answer", tally.kills, tally.runs, tally.wrong.len());
    for text in &tally.wrong {
        println!("  {text}");
    }
    Ok(tally.wrong.is_empty())
}

fn replay(kind: Kind, folders: &[PathBuf]) -> io::Result<bool> {
    let mut held = true;
    for folder in folders {
        let outcome = fuzz::replay(kind, folder)?;
        held &= outcome.is_ok();
        match outcome {
            Ok(outcome) => println!("{}: {outcome:?}", folder.display()),
            Err(text) => println!("{}: {text}", folder.display()),
        }
    }
    Ok(held)
}
