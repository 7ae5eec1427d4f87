//! A short run of every scene, as a user would start it.

use crate::shell::{cargo, cargo_path, command, root, run};
use std::fs;

/// Long enough for balls to meet; short enough for all scenes in a minute; too short for what scenes claim.
const DURATION: &str = "duration=0.05 s";

/// Runs every scene for a moment, by every step that a user takes.
pub fn smoke() -> Result<(), String> {
    cargo(&["build", "--package", "tsubu-cli", "--quiet"])?;
    for name in scenes()? {
        let (scene, folder) = (format!("scenes/{name}.toml"), format!("target/smoke/{name}"));
        tsubu(&["check", &scene])?;
        tsubu(&["run", &scene, "--set", DURATION, "--set", "claim=[]", "--output", &folder, "--overwrite", "--quiet"])?;
        tsubu(&["report", &folder])?;
    }
    Ok(())
}

fn tsubu(words: &[&str]) -> Result<(), String> {
    let mut all = vec!["run", "--package", "tsubu-cli", "--quiet", "--"];
    all.extend(words);
    run(command(&cargo_path(), &all))
}

/// The name of every scene, in order.
pub fn scenes() -> Result<Vec<String>, String> {
    let entries = fs::read_dir(root().join("scenes")).map_err(|error| format!("cannot list scenes/: {error}"))?;
    let files =
        entries.flatten().map(|entry| entry.path()).filter(|path| path.extension().is_some_and(|e| e == "toml"));
    let mut names: Vec<String> =
        files.filter_map(|path| Some(path.file_stem()?.to_string_lossy().into_owned())).collect();
    names.sort();
    if names.is_empty() { Err("there are no scenes".to_owned()) } else { Ok(names) }
}
