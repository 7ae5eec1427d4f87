//! `tsubu`, the program: reads the command line, calls the library, says how it went.
//!
//! Results go to stdout, everything else to stderr. The exit code says what happened: 0 done, 1 a claim failed, 2 the
//! scene or the command line is wrong and nothing was written, 3 the run failed, 130 interrupted.

mod commands;
mod failure;
mod looked_at;
mod machine;
mod options;
mod output;
mod progress;
mod session;
mod stop;
mod stream;
mod table;

use clap::{CommandFactory, Parser};
use commands::Command;
use std::process::ExitCode;

/// Granular dynamics: one scene, several methods, books that close.
#[derive(Parser)]
#[command(name = "tsubu", version, max_term_width = 100, after_help = EXAMPLES)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
}

const EXAMPLES: &str = "\
Examples:
  tsubu new damper                a commented example scene, damper.toml
  tsubu run damper.toml           simulate it into out/damper
  tsubu response damper.toml      its frequency response, with figures and report.html

Exit codes: 0 done, 1 a claim failed, 2 the scene or the command line is wrong, 3 the run failed,
130 interrupted and ready for --resume. `tsubu help COMMAND` has more examples.";

const BRIEF: &str = "\
tsubu simulates granular matter from one scene file.

  tsubu new damper                a commented example scene, damper.toml
  tsubu run damper.toml           simulate it into out/damper
  tsubu response damper.toml      its frequency response, with figures and report.html

`tsubu --help` lists all commands.
";

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    stop::listen();
    let done = match arguments.command {
        Some(command) => commands::run(command),
        None => output::print(BRIEF),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => output::report(&failure),
    }
}

/// The command line as clap knows it, for shell completion.
fn command_line() -> clap::Command {
    Arguments::command()
}
