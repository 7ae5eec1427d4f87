//! Which verification cases notice that something is wrong on purpose: `crates/tsubu-verify/mutants.jsonl`, a mutation a line.

use crate::shell::{cargo_path, command, output, root};
use serde_json::{Value, json};
use std::fs;
use std::io::{BufRead, BufReader};
use std::process::Stdio;

const KEPT: &str = "crates/tsubu-verify/mutants.jsonl";

/// Runs the quick cases with each mutation (or with those named, in words) and keeps who notices in place of what was kept. Fails where
/// nobody does.
pub fn mutants(words: &[&str]) -> Result<(), String> {
    let mut arguments =
        vec!["run", "--package", "tsubu-verify", "--features", "mutations", "--example", "mutants", "--"];
    arguments.extend(words);
    let child = command(&cargo_path(), &arguments).stdout(Stdio::piped()).spawn();
    let mut child = child.map_err(|error| format!("cannot run the mutants: {error}"))?;
    let path = root().join(KEPT);
    let old = fs::read_to_string(&path).map_err(|error| format!("cannot read {KEPT}: {error}"))?;
    let mut kept = lines(&old)?;
    let mut unnoticed = Vec::new();
    // Kept one by one: all take a long time.
    for line in child.stdout.take().into_iter().flat_map(|out| BufReader::new(out).lines()) {
        let found = lines(&line.map_err(|error| format!("cannot hear the mutants: {error}"))?)?;
        unnoticed.extend(found.iter().filter(|line| line["noticed"] == json!([])).map(|line| line["mutation"].clone()));
        kept = replaced(&kept, &found);
        let text = kept.iter().fold(String::new(), |text, line| text + &format!("{line}\n"));
        fs::write(&path, text).map_err(|error| format!("cannot write {KEPT}: {error}"))?;
    }
    let status = child.wait().map_err(|error| format!("cannot run the mutants: {error}"))?;
    eprintln!("wrote {KEPT}; `cargo xtask gen` makes the table");
    match (status.success(), unnoticed.as_slice()) {
        (true, _) => Ok(()),
        (false, []) => Err(format!("the mutants ended badly ({status})")),
        (false, some) => Err(format!("nobody notices: {some:?}")),
    }
}

/// Runs the cases of at most ten seconds from two starts that differ in the last bit, and keeps which claims that moves.
pub fn chaotic() -> Result<(), String> {
    const KEPT: &str = "crates/tsubu-verify/chaotic.jsonl";
    let text = output(
        &cargo_path(),
        &["run", "--package", "tsubu-verify", "--features", "mutations", "--example", "mutants", "--", "--last-bit"],
    )?;
    let found = lines(&text)?;
    let moved = found.iter().filter(|line| line["claims"] != json!([]));
    let text = moved.fold(String::new(), |text, line| text + &format!("{line}\n"));
    fs::write(root().join(KEPT), text).map_err(|error| format!("cannot write {KEPT}: {error}"))?;
    eprintln!("wrote {KEPT}; `cargo xtask gen` makes the table");
    Ok(())
}

fn lines(text: &str) -> Result<Vec<Value>, String> {
    text.lines().map(|line| serde_json::from_str(line).map_err(|error| format!("{KEPT}: {error}"))).collect()
}

/// Old lines with new ones in place of those of the same mutation; new ones that had none come last.
fn replaced(old: &[Value], new: &[Value]) -> Vec<Value> {
    let find = |of: &Value| new.iter().find(|line| line["mutation"] == of["mutation"]);
    let mut all: Vec<Value> = old.iter().map(|line| find(line).unwrap_or(line).clone()).collect();
    all.extend(new.iter().filter(|line| !old.iter().any(|of| of["mutation"] == line["mutation"])).cloned());
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_found_again_takes_the_place_of_what_was_kept() {
        let line = |name: &str, count: u32| json!({ "mutation": name, "noticed": count });
        let all = replaced(&[line("a", 1), line("b", 1)], &[line("c", 2), line("a", 2)]);
        assert_eq!(all, [line("a", 2), line("b", 1), line("c", 2)]);
    }
}
