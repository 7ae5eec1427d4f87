//! `tsubu completions`: a script for the shell.

use crate::failure::Failure;
use crate::output;
use clap::Args;
use clap_complete::Shell;

#[derive(Args)]
#[command(after_help = "\
Examples:
  tsubu completions bash > ~/.local/share/bash-completion/completions/tsubu
  tsubu completions fish > ~/.config/fish/completions/tsubu.fish")]
pub struct Options {
    /// The shell
    shell: Shell,
}

pub fn run(options: &Options) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(options.shell, &mut crate::command_line(), "tsubu", &mut script);
    output::print(&String::from_utf8_lossy(&script))
}
