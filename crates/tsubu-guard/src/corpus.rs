//! What was once found, kept in files.

use crate::bundle::Bundle;
use crate::kind::Kind;
use std::io;
use std::path::{Path, PathBuf};

/// Where the cases are that are judged again each time: a folder a kind, a folder in it a case.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus")
}

/// Writes a case into a folder of cases.
pub fn keep(folder: &Path, kind: Kind, name: &str, bundle: &Bundle) -> io::Result<PathBuf> {
    let case = folder.join(kind.name()).join(name);
    bundle.write(&case)?;
    Ok(case)
}

/// The folders of all cases of a kind.
pub fn cases(folder: &Path, kind: Kind) -> io::Result<Vec<PathBuf>> {
    let folder = folder.join(kind.name());
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let mut cases = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        cases.push(entry?.path());
    }
    cases.sort();
    Ok(cases)
}
