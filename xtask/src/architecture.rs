//! The map must fit the land.

use crate::shell::root;

/// What a path in the text begins with.
const ROOTS: [&str; 8] = ["crates", "scenes", "studies", "docs", "benches", "xtask", ".ci", ".config"];

#[test]
fn every_path_on_the_map_exists() {
    let Ok(text) = std::fs::read_to_string(root().join("ARCHITECTURE.md")) else { return };
    let quoted = text.split('`').skip(1).step_by(2);
    let paths = quoted.filter(|word| {
        let first = word.split('/').next().unwrap_or_default();
        ROOTS.contains(&first)
            && word.contains('/')
            && !word.contains(|c: char| c.is_whitespace() || "*<>{".contains(c))
    });
    let lost: Vec<&str> = paths.filter(|path| !root().join(path).exists()).collect();
    assert!(lost.is_empty(), "ARCHITECTURE.md names paths that do not exist: {lost:?}");
}
