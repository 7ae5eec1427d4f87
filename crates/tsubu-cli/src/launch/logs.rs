//! What tasks have said, in the folder `launch` of the results: why a run has none.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The folder.
pub const FOLDER: &str = "launch";

/// What a task says when it begins a run.
pub fn begun(name: &str) -> String {
    format!("{BEFORE}{name}{BEHIND}")
}

const BEFORE: &str = "case ";
const BEHIND: &str = ": begun";

/// The last that was said of each run.
pub struct Logs(BTreeMap<String, String>);

impl Logs {
    /// Reads what is there.
    pub fn read(folder: &Path) -> Self {
        let entries = fs::read_dir(folder.join(FOLDER)).into_iter().flatten().flatten();
        let mut files: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
        files.retain(|path| path.extension().is_some_and(|extension| extension == "txt"));
        files.sort_by_cached_key(|path| (fs::metadata(path).and_then(|about| about.modified()).ok(), path.clone()));
        let mut last = BTreeMap::new();
        for file in files {
            let text = fs::read(&file).unwrap_or_default();
            let name = file.file_name().unwrap_or_default().to_string_lossy();
            take(&String::from_utf8_lossy(&text), &format!("{FOLDER}/{name}"), &mut last);
        }
        Self(last)
    }

    /// Why a run has no result.
    pub fn why(&self, name: &str) -> String {
        self.0.get(name).cloned().unwrap_or_else(|| "it was not begun".to_owned())
    }
}

/// What a file says of each run: its first error, else its last words.
fn take(text: &str, file: &str, last: &mut BTreeMap<String, String>) {
    let mut of: Option<&str> = None;
    let mut errs = false;
    for line in text.lines().map(str::trim).filter(|line| !line.is_empty()) {
        if let Some(name) = line.strip_prefix(BEFORE).and_then(|rest| rest.strip_suffix(BEHIND)) {
            (of, errs) = (Some(name), false);
            last.insert(name.to_owned(), format!("it was begun and did not end: {file}"));
        } else if let Some(name) = of.filter(|_| !errs) {
            errs = line.starts_with("error: ");
            last.insert(name.to_owned(), format!("{} ({file})", line.trim_start_matches("error: ")));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_try_says_why() {
        let folder = tempfile::tempdir().expect("a folder");
        fs::create_dir(folder.path().join(FOLDER)).expect("a folder");
        let write = |name: &str, text: &str| fs::write(folder.path().join(FOLDER).join(name), text).expect("written");
        write("1_0.txt", "case a: begun\ncase a: finished\ncase b: begun\nerror: the disk is full\nhint: make room\n");
        write("1_1.txt", "case c: begun\n");
        write("2_0.txt", "case d: begun\nslurmstepd: error: JOB 2 ON n1 CANCELLED DUE TO TIME LIMIT\n");
        write("slurm", "1 2\n");
        let logs = Logs::read(folder.path());
        assert_eq!(logs.why("b"), "the disk is full (launch/1_0.txt)");
        assert_eq!(logs.why("c"), "it was begun and did not end: launch/1_1.txt");
        assert_eq!(logs.why("d"), "slurmstepd: error: JOB 2 ON n1 CANCELLED DUE TO TIME LIMIT (launch/2_0.txt)");
        assert_eq!(logs.why("e"), "it was not begun");
    }
}
