//! `tsubu view`: not there yet.

use crate::failure::Failure;
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
pub struct Options {
    /// Folder of a run, or a scene
    #[arg(value_name = "DIR|SCENE")]
    what: PathBuf,
    /// Port to listen on
    #[arg(long, value_name = "N")]
    port: Option<u16>,
}

pub fn run(options: &Options) -> Result<(), Failure> {
    let Options { what, port: _ } = options;
    Err(Failure::wrong("`tsubu view` is not there yet")
        .hint(format!("`tsubu report {}` draws the grains on a page", what.display()))
        .hint("the files in frames/ open in ParaView; with `output.xyz = true` also in OVITO"))
}
