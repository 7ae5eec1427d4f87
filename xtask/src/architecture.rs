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

/// Owners that an engine may be made of, before a reader loses count.
const OWNERS: usize = 15;

/// The fields of a struct in a text of code.
fn fields(text: &str, name: &str) -> usize {
    let (_, rest) = text.split_once(&format!("pub struct {name} {{")).expect("the struct");
    let body = rest.split("\n}").next().unwrap_or_default();
    body.lines().filter(|line| line.trim_start().starts_with("pub")).count()
}

#[test]
fn the_dem_engine_has_few_owners() {
    let text = std::fs::read_to_string(root().join("crates/tsubu/src/dem/engine.rs")).expect("the engine");
    let fields = fields(&text, "DemEngine");
    assert!(
        fields > 3 && fields <= OWNERS,
        "`DemEngine` has {fields} fields, more than {OWNERS}: give what is new to an owner"
    );
}

#[test]
fn fields_are_counted() {
    let text = "pub struct Engine {\n    /// It.\n    pub(super) one: u8,\n    pub two: u8,\n}\n\npub struct Other {\n    pub three: u8,\n}\n";
    assert_eq!(fields(text, "Engine"), 2);
}
