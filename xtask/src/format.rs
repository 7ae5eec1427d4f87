//! How code is laid out: `cargo fmt`, and rustfmt over files that it does not come to.
//!
//! `cargo fmt` goes from file to file along the `mod` lines. Watches have none: a macro makes them from the list of their kinds.

use crate::shell::{cargo, command, root, run};
use std::fs;
use std::path::PathBuf;

/// Folders with such files.
const FOLDERS: [&str; 1] = ["crates/tsubu/src/watch"];

/// Lays all code out.
pub fn write() -> Result<(), String> {
    format(&[])
}

/// Says what is not laid out so.
pub fn check() -> Result<(), String> {
    format(&["--check"])
}

fn format(arguments: &[&str]) -> Result<(), String> {
    cargo(&[&["fmt", "--all"], arguments].concat())?;
    for folder in FOLDERS {
        let entries = fs::read_dir(root().join(folder)).map_err(|error| format!("cannot read `{folder}`: {error}"))?;
        let files = entries.flatten().map(|entry| PathBuf::from(folder).join(entry.file_name()));
        let mut rustfmt = command("rustfmt", &["--quiet", "--edition", "2024"]);
        rustfmt.args(arguments).args(files.filter(|file| file.extension().is_some_and(|ending| ending == "rs")));
        run(rustfmt)?;
    }
    Ok(())
}
