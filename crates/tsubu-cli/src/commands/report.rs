//! `tsubu report`: figures and one page.

use crate::failure::Failure;
use crate::output;
use crate::stream::Stream;
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
#[command(after_help = "\
Example:
  tsubu report out/damper            writes out/damper/report.html and out/damper/figures/")]
pub struct Options {
    /// Folder of a run, response, sweep, comparison or verification
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

pub fn run(options: &Options) -> Result<(), Failure> {
    let written = tsubu_report::report(&options.folder).map_err(|error| Failure::of_report(&error))?;
    output::print(&format!("{}\n", written.page.display()))?;
    if written.damage.is_empty() {
        return Ok(());
    }
    let mark = Stream::Error.yellow("warning");
    for note in &written.damage {
        output::tell(&format!("{mark}: {note}\n"));
    }
    Err(Failure::failed(format!("results in {} are not whole", options.folder.display()))
        .hint("the page has what could be read"))
}
