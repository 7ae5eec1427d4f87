//! `tsubu check`: a verdict a line.

use crate::failure::Failure;
use crate::machine;
use crate::options::SceneOptions;
use crate::output::{self, Stream};
use clap::Args;
use std::fmt::Write as _;

#[derive(Args)]
#[command(after_help = "\
Examples:
  tsubu check damper.toml
  tsubu check damper.toml --set dem.time-step='20 us' --strict")]
pub struct Options {
    #[command(flatten)]
    scene: SceneOptions,
    /// Exit with 2 if there is a warning
    #[arg(long)]
    strict: bool,
}

pub fn run(options: &Options) -> Result<(), Failure> {
    let scene = options.scene.read()?;
    let verdict =
        tsubu::check::check(scene.plan(), machine::known().as_ref()).map_err(|error| Failure::from(&error))?;
    let stream = Stream::Data;
    let mut text = String::new();
    for line in &verdict.lines {
        let word = if line.good { stream.green("ok  ") } else { stream.yellow("warn") };
        let _ = writeln!(text, "{word} {}", line.text);
        if !line.advice.is_empty() {
            let _ = writeln!(text, "       change: {}", line.advice);
        }
    }
    output::print(&text)?;
    let warnings = verdict.lines.iter().filter(|line| !line.good).count();
    let plural = if warnings == 1 { "" } else { "s" };
    if options.strict && warnings > 0 {
        return Err(Failure::wrong(format!("{warnings} warning{plural}, and `--strict` lets none pass")));
    }
    match warnings {
        0 => output::tell(&format!("the scene is right; run it: tsubu run {}\n", options.scene.scene.display())),
        n => output::tell(&format!("the scene can be run, with {n} warning{plural}\n")),
    }
    Ok(())
}
