//! The commands, one file each.

mod atlas;
mod bench;
mod calibrate;
pub mod check;
mod claims;
mod compare;
mod completions;
mod design;
mod explain;
mod held_against;
mod new;
mod origins;
mod playground;
mod points;
mod predict;
mod report;
mod response;
mod run;
mod schema;
mod standing;
mod sweep;
pub mod verify;
mod view;

use crate::failure::Failure;
use crate::ranks;
use clap::Subcommand;

/// What tsubu can be asked to do.
#[derive(Subcommand)]
pub enum Command {
    /// Run a scene to its end
    Run(run::Options),
    /// Judge a scene without running it: is it resolved well enough, and what will it cost?
    Check(check::Options),
    /// Run every case of a parameter sweep, side by side
    Sweep(sweep::Options),
    /// Frequency response of the vibrating structure, with figures and report.html
    Response(response::Options),
    /// Effective mass and loss of a cavity of grains, over frequency and acceleration
    Atlas(atlas::Options),
    /// Response of a structure from an atlas of its cavity, in seconds, with spot checks
    Predict(predict::Options),
    /// Which of many dampers serves best within its limits, confirmed by simulation
    Design(design::Options),
    /// Which values of a scene fit what was measured, with intervals
    Calibrate(calibrate::Options),
    /// One scene by several methods: what differs, and what each costs
    Compare(compare::Options),
    /// Check the shipped verification cases and published studies, claim by claim
    Verify(verify::Options),
    /// What a law, a watch, a wall, a method or a claim is: formula, symbols with units, limits, source
    Explain(explain::Options),
    /// Make figures and a self-contained report.html from a folder of results
    Report(report::Options),
    /// Measure how fast this machine is, in about a minute
    Bench(bench::Options),
    /// Look at runs in the browser
    View(view::Options),
    /// Scenes that run in the browser itself: not there yet
    #[command(hide = true)]
    Playground(playground::Options),
    /// Write a commented example scene
    New(new::Options),
    /// Print the JSON Schema of the scene file, for editors
    Schema,
    /// Print the completion script for a shell
    Completions(completions::Options),
}

/// Does it.
pub fn run(command: Command) -> Result<(), Failure> {
    match &command {
        Command::Run(_) => {}
        Command::Sweep(options) if options.is_task() => {}
        _ => ranks::refuse()?,
    }
    match command {
        Command::Run(options) => run::run(&options),
        Command::Check(options) => check::run(&options),
        Command::Sweep(options) => sweep::run(&options),
        Command::Response(options) => response::run(&options),
        Command::Atlas(options) => atlas::run(&options),
        Command::Predict(options) => predict::run(&options),
        Command::Design(options) => design::run(&options),
        Command::Calibrate(options) => calibrate::run(&options),
        Command::Compare(options) => compare::run(&options),
        Command::Verify(options) => verify::run(&options),
        Command::Explain(options) => explain::run(&options),
        Command::Report(options) => report::run(&options),
        Command::Bench(options) => bench::run(&options),
        Command::View(options) => view::run(&options),
        Command::Playground(options) => playground::run(&options),
        Command::New(options) => new::run(&options),
        Command::Schema => schema::run(),
        Command::Completions(options) => completions::run(&options),
    }
}
