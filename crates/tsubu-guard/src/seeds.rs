//! What cases begin from: every scene of the project, with the files it reads.

use crate::bundle::Bundle;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// A larger scene would be read all day.
const LARGEST: u64 = 100_000;

/// The root of the project.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A scene to begin from.
pub struct Seed {
    /// Its files: `scene.toml`, and those it reads.
    pub bundle: Bundle,
    /// Its text.
    pub text: String,
    /// Its tree.
    pub table: toml::Table,
}

/// All of them, in the order of their paths.
pub fn seeds() -> &'static [Seed] {
    static SEEDS: OnceLock<Vec<Seed>> = OnceLock::new();
    SEEDS.get_or_init(|| {
        let mut paths: Vec<PathBuf> = files(&root().join("scenes"));
        for study in files(&root().join("studies")) {
            paths.extend(files(&study));
        }
        paths.retain(|path| path.extension().is_some_and(|ending| ending == "toml"));
        paths.sort();
        paths.iter().filter_map(|path| seed(path)).collect()
    })
}

fn files(folder: &Path) -> Vec<PathBuf> {
    fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect()
}

fn seed(path: &Path) -> Option<Seed> {
    let text = fs::read_to_string(path).ok()?;
    let table: toml::Table = text.parse().ok()?;
    let mut bundle = Bundle::default().with("scene.toml", text.as_bytes());
    let mut named = Vec::new();
    texts(&toml::Value::Table(table.clone()), &mut named);
    for name in named {
        let beside = path.parent()?.join(&name);
        let Ok(about) = fs::metadata(&beside) else { continue };
        if about.is_file() && about.len() > LARGEST {
            return None;
        }
        if about.is_file() {
            bundle.put(name, fs::read(beside).ok()?);
        }
    }
    Some(Seed { bundle, text, table })
}

/// Every text in the tree that could name a file.
fn texts(value: &toml::Value, out: &mut Vec<String>) {
    match value {
        toml::Value::String(text) if text.contains('.') && !text.contains(['/', ' ']) => out.push(text.clone()),
        toml::Value::Array(list) => list.iter().for_each(|value| texts(value, out)),
        toml::Value::Table(table) => table.values().for_each(|value| texts(value, out)),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::seeds;

    #[test]
    fn scenes_come_with_their_files() {
        assert!(seeds().len() > 40, "{}", seeds().len());
        assert!(seeds().iter().any(|seed| seed.bundle.names().count() == 3));
    }
}
