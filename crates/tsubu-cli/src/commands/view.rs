//! `tsubu view`: runs in the browser.

use crate::failure::Failure;
use crate::output;
use clap::Args;
use std::io::IsTerminal;
use std::path::PathBuf;
use tsubu_view::Server;

#[derive(Args)]
#[command(after_help = "\
Examples:
  tsubu view out/hopper                       prints an address, and opens it
  tsubu view out/few out/many                 two runs side by side, with one camera
  tsubu view out/hopper --port 8000 --no-open

The page is for this machine alone, and for who knows the address. Ctrl-C ends it.")]
pub struct Options {
    /// Folders of runs; several are shown side by side
    #[arg(value_name = "DIR", required = true)]
    folders: Vec<PathBuf>,
    /// Port to listen on [default: any that is free]
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    port: u16,
    /// Do not open the page in a browser
    #[arg(long)]
    no_open: bool,
}

pub fn run(options: &Options) -> Result<(), Failure> {
    let server = Server::bind(&options.folders, options.port).map_err(|error| Failure::of_words(&error))?;
    let address = server.address();
    output::print(&format!("{address}\n"))?;
    if !options.no_open && std::io::stdout().is_terminal() {
        // The address is on the terminal, for machines without a browser.
        let _ = open::that_detached(&address);
    }
    // There is nothing to save: Ctrl-C ends the program.
    server.serve(&|| false).map_err(|error| Failure::of_words(&error))
}
