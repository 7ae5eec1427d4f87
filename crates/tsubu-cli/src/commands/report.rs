//! `tsubu report`: figures and one page.

use crate::failure::Failure;
use crate::output;
use clap::Args;
use std::path::{Path, PathBuf};

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
    let page = write(&options.folder)?;
    output::print(&format!("{}\n", page.display()))
}

/// Writes figures and page into a folder of results, and gives the page's path.
pub fn write(folder: &Path) -> Result<PathBuf, Failure> {
    tsubu_report::report(folder).map_err(|error| Failure::of_report(&error))
}
