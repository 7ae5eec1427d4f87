//! Files of code are short: one idea each.

use crate::shell::root;
use std::fs;
use std::path::{Path, PathBuf};

/// Lines that a file of code may have.
const MOST: usize = 400;

#[test]
fn files_are_short() {
    let files: Vec<PathBuf> = ["crates", "xtask"].iter().flat_map(|folder| sources(&root().join(folder))).collect();
    assert!(files.len() > 100, "only {} files of code were found", files.len());
    let long: Vec<String> =
        files.iter().filter_map(|file| refusal(file, &fs::read_to_string(file).expect("code is text"))).collect();
    assert!(long.is_empty(), "{}", long.join("\n"));
}

/// What to say of a file that is too long.
fn refusal(file: &Path, text: &str) -> Option<String> {
    let lines = text.lines().count();
    let file = file.strip_prefix(root()).unwrap_or(file).display();
    (lines > MOST).then(|| {
        format!(
            "{file} has {lines} lines, more than {MOST}\nhint: split it by idea, into files beside it or in a folder of its name, each named after its idea"
        )
    })
}

/// All files of code below a folder.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let below = |path: PathBuf| match path.extension() {
        _ if path.is_dir() => sources(&path),
        Some(ending) if ending == "rs" => vec![path],
        _ => Vec::new(),
    };
    fs::read_dir(folder).expect("a folder").flatten().map(|entry| entry.path()).flat_map(below).collect()
}

#[test]
fn a_long_file_is_refused_with_its_length() {
    let file = root().join("crates/one/src/two.rs");
    assert_eq!(refusal(&file, &"//\n".repeat(MOST)), None);
    let told = refusal(&file, &"//\n".repeat(MOST + 1)).expect("refused");
    assert!(told.starts_with("crates/one/src/two.rs has 401 lines, more than 400\nhint: "), "{told}");
}
