//! Files that a scene names, read once.

use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Texts of the files beside a scene. A sweep resolves its scene many times; every case must see the same text even if
/// someone edits the file meanwhile.
#[derive(Clone, Debug)]
pub(crate) struct Files {
    folder: PathBuf,
    texts: BTreeMap<String, Result<Arc<str>, String>>,
}

impl Files {
    pub fn new(folder: &Path) -> Self {
        Self { folder: folder.to_path_buf(), texts: BTreeMap::new() }
    }

    /// The text of the file, or why it cannot be read.
    pub fn read(&mut self, name: &str) -> Result<Arc<str>, String> {
        let folder = &self.folder;
        self.texts.entry(name.to_string()).or_insert_with(|| read_text(&folder.join(name)).map(Arc::from)).clone()
    }
}

/// Reads a text file; the error says why not, in words that do not depend on the system.
pub(crate) fn read_text(path: &Path) -> Result<String, String> {
    if path.is_dir() {
        return Err("it is a folder".to_string());
    }
    let bytes = std::fs::read(path).map_err(|error| match error.kind() {
        ErrorKind::NotFound => "there is no such file".to_string(),
        ErrorKind::PermissionDenied => "permission is denied".to_string(),
        _ => error.to_string(),
    })?;
    String::from_utf8(bytes).map_err(|error| {
        let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = valid.split(|byte| *byte == b'\n').count();
        format!("it is not UTF-8 text (line {line})")
    })
}
