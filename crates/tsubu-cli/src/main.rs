//! `tsubu`, the program.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(tsubu_cli::run(std::env::args_os()))
}
