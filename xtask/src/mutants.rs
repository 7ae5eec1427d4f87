//! Which verification cases notice that something is wrong on purpose: `crates/tsubu-verify/mutants.jsonl`, a mutation a line.

use crate::shell::{cargo_path, command, root};
use serde_json::Value;
use std::fmt::Write as _;
use std::fs;
use std::process::Stdio;

const KEPT: &str = "crates/tsubu-verify/mutants.jsonl";

/// Runs the quick cases with each mutation (or with those named, in words) and keeps who notices in place of what was kept. Fails where
/// nobody does.
pub fn mutants(words: &[&str]) -> Result<(), String> {
    let mut arguments =
        vec!["run", "--package", "tsubu-verify", "--features", "mutations", "--example", "mutants", "--"];
    arguments.extend(words);
    let run = command(&cargo_path(), &arguments).stderr(Stdio::inherit()).output();
    let run = run.map_err(|error| format!("cannot run the mutants: {error}"))?;
    let found = lines(&String::from_utf8_lossy(&run.stdout))?;
    let path = root().join(KEPT);
    let old = fs::read_to_string(&path).map_err(|error| format!("cannot read {KEPT}: {error}"))?;
    let text = replaced(&lines(&old)?, &found);
    fs::write(&path, text).map_err(|error| format!("cannot write {KEPT}: {error}"))?;
    eprintln!("wrote {KEPT}; `cargo xtask gen` makes the table");
    let unnoticed: Vec<&Value> = found
        .iter()
        .filter(|line| line["noticed"].as_array().is_none_or(Vec::is_empty))
        .map(|l| &l["mutation"])
        .collect();
    match (run.status.success(), unnoticed.as_slice()) {
        (true, _) => Ok(()),
        (false, []) => Err(format!("the mutants ended badly ({})", run.status)),
        (false, some) => Err(format!("nobody notices: {some:?}")),
    }
}

fn lines(text: &str) -> Result<Vec<Value>, String> {
    text.lines().map(|line| serde_json::from_str(line).map_err(|error| format!("{KEPT}: {error}"))).collect()
}

/// Old lines with new ones in place of those of the same mutation; new ones that had none come last.
fn replaced(old: &[Value], new: &[Value]) -> String {
    let find = |of: &Value| new.iter().find(|line| line["mutation"] == of["mutation"]);
    let mut all: Vec<&Value> = old.iter().map(|line| find(line).unwrap_or(line)).collect();
    all.extend(new.iter().filter(|line| !old.iter().any(|of| of["mutation"] == line["mutation"])));
    all.iter().fold(String::new(), |mut text, line| {
        let _ = writeln!(text, "{line}");
        text
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn what_is_found_again_takes_the_place_of_what_was_kept() {
        let line = |name: &str, count: u32| json!({ "mutation": name, "noticed": count });
        let text = replaced(&[line("a", 1), line("b", 1)], &[line("c", 2), line("a", 2)]);
        assert_eq!(lines(&text), Ok(vec![line("a", 2), line("b", 1), line("c", 2)]));
    }
}
