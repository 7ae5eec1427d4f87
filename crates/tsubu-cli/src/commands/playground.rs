//! `tsubu playground`: not there yet, and says so.

use crate::failure::Failure;
use clap::Args;

#[derive(Args)]
pub struct Options {
    /// Port on this machine
    #[arg(long, value_name = "N")]
    port: Option<u16>,
}

pub fn run(_: &Options) -> Result<(), Failure> {
    Err(Failure::wrong("`tsubu playground`, scenes that run in the browser itself, is not there yet")
        .hint("`tsubu run SCENE --view` runs a scene on this machine and shows it in the browser"))
}
