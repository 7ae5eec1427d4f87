//! A short run of every scene, as a user would start it.

use crate::shell::{cargo, cargo_path, command, root, run};
use std::fs;
use std::path::PathBuf;

/// Long enough for balls to meet; short enough for all scenes in a minute.
const DURATION: &str = "duration=0.05 s";

/// Runs every scene for a moment, by every step that a user takes.
pub fn smoke() -> Result<(), String> {
    cargo(&["build", "--package", "tsubu-cli", "--quiet"])?;
    let out = root().join("target/smoke");
    for scene in scenes()? {
        let name = scene.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let folder = out.join(name);
        let (scene, folder) = (scene.to_string_lossy(), folder.to_string_lossy());
        tsubu(&["check", &scene])?;
        tsubu(&["run", &scene, "--set", DURATION, "--output", &folder, "--overwrite", "--quiet"])?;
        tsubu(&["report", &folder])?;
    }
    Ok(())
}

fn tsubu(words: &[&str]) -> Result<(), String> {
    let mut all = vec!["run", "--package", "tsubu-cli", "--quiet", "--"];
    all.extend(words);
    run(command(&cargo_path(), &all))
}

/// Every scene, in order.
fn scenes() -> Result<Vec<PathBuf>, String> {
    let entries = fs::read_dir(root().join("scenes")).map_err(|error| format!("cannot list scenes/: {error}"))?;
    let mut scenes: Vec<PathBuf> = entries
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .collect();
    scenes.sort();
    if scenes.is_empty() { Err("there are no scenes".to_owned()) } else { Ok(scenes) }
}
