//! `tsubu new`: a commented example scene.

use crate::failure::Failure;
use crate::options::quoted;
use crate::{output, table};
use clap::Args;
use clap::builder::PossibleValuesParser;
use std::fs::OpenOptions;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use tsubu_scene::TEMPLATES;

#[derive(Args)]
#[command(after_help = "\
Examples:
  tsubu new damper                   writes damper.toml
  tsubu new drop first.toml
  tsubu new --list")]
pub struct Options {
    /// Which scene
    #[arg(value_parser = PossibleValuesParser::new(TEMPLATES.iter().map(|t| t.name)), hide_possible_values = true,
          required_unless_present = "list")]
    template: Option<String>,
    /// File to write [default: TEMPLATE.toml]
    file: Option<PathBuf>,
    /// List the templates
    #[arg(long, conflicts_with = "template")]
    list: bool,
}

pub fn run(options: &Options) -> Result<(), Failure> {
    let wanted = options.template.as_deref();
    let Some(template) = TEMPLATES.iter().find(|t| Some(t.name) == wanted) else {
        let rows: Vec<Vec<String>> = TEMPLATES.iter().map(|t| vec![t.name.to_owned(), t.about.to_owned()]).collect();
        return output::print(&table::aligned(&rows));
    };
    let file = options.file.clone().unwrap_or_else(|| PathBuf::from(format!("{}.toml", template.name)));
    write(&file, template.text)?;
    for (name, text) in template.files() {
        if let Err(failure) = beside(&file.with_file_name(name), text) {
            // The scene could not be read without it.
            let _ = std::fs::remove_file(&file);
            return Err(failure);
        }
    }
    let file = quoted(&file.to_string_lossy());
    output::tell(&format!("wrote {file}; judge it: tsubu check {file}, run it: tsubu run {file}\n"));
    Ok(())
}

/// Writes a file that the scene names, where it is not there already just so.
fn beside(file: &Path, text: &str) -> Result<(), Failure> {
    if std::fs::read(file).is_ok_and(|there| there == text.as_bytes()) { Ok(()) } else { write(file, text) }
}

/// Writes a file that is not there yet.
fn write(file: &Path, text: &str) -> Result<(), Failure> {
    let cannot = |error: &std::io::Error| Failure::wrong(format!("cannot write {}: {error}", file.display()));
    let mut out = match OpenOptions::new().write(true).create_new(true).open(file) {
        Ok(out) => out,
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {
            return Err(Failure::wrong(format!("{} is there already and stays as it is", file.display()))
                .hint("name another file: tsubu new TEMPLATE FILE"));
        }
        Err(error) => return Err(cannot(&error)),
    };
    out.write_all(text.as_bytes()).map_err(|error| {
        // A scene cut in half would be worse than none.
        let _ = std::fs::remove_file(file);
        cannot(&error)
    })
}
