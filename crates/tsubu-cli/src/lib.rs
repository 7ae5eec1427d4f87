//! The commands of `tsubu`, as the program and the Python package call them: read the command line, call the library, say how it
//! went.
//!
//! Results go to stdout, everything else to stderr. The exit code says what happened: 0 done, 1 a claim failed, 2 the
//! scene or the command line is wrong and nothing was written, 3 the run failed, 130 interrupted.

mod commands;
mod failure;
mod launch;
mod looked_at;
mod machine;
mod options;
mod output;
mod progress;
mod ranks;
mod session;
mod stop;
mod stream;
mod table;

pub use commands::check::judged;
pub use commands::verify::runner::claims;
pub use failure::Failure;
pub use launch::Logs;
pub use stream::allow_colour;

use clap::{CommandFactory, Parser};
use commands::Command;
use std::ffi::OsString;

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
130 interrupted: a run, and studies of many runs, go on with --resume. `tsubu help COMMAND` has more examples.";

const BRIEF: &str = "\
tsubu simulates granular matter from one scene file.

  tsubu new damper                a commented example scene, damper.toml
  tsubu run damper.toml           simulate it into out/damper
  tsubu response damper.toml      its frequency response, with figures and report.html

`tsubu --help` lists all commands.
";

/// Does what a command line says, the name of the program first, and gives the exit code. A line that is no command ends the process,
/// as `--help` does.
pub fn run(line: impl IntoIterator<Item = OsString>) -> u8 {
    stop::listen();
    let words: Vec<OsString> = line.into_iter().collect();
    options::typed(&words);
    let arguments = Arguments::parse_from(words);
    let done = match arguments.command {
        Some(command) => commands::run(command),
        None => output::print(BRIEF),
    };
    match done {
        Ok(()) => 0,
        Err(failure) => output::report(&failure),
    }
}

/// The command line as clap knows it, for shell completion.
fn command_line() -> clap::Command {
    Arguments::command()
}
