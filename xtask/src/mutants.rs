//! Which verification cases notice that something is wrong on purpose: `crates/tsubu-verify/mutants.jsonl`, a mutation a line.

use crate::shell::{cargo_path, command, output, root};
use serde_json::{Value, json};
use std::fs;
use std::io::{BufRead, BufReader};
use std::process::Stdio;

const KEPT: &str = "crates/tsubu-verify/mutants.jsonl";

/// Runs the short cases (or those named) with each mutation (or with those named, in words) and keeps who notices in place of what was
/// kept of these cases. Fails where nobody does.
pub fn mutants(words: &[&str]) -> Result<(), String> {
    let mut arguments =
        vec!["run", "--release", "--package", "tsubu-verify", "--features", "mutations", "--example", "mutants", "--"];
    arguments.extend(words);
    let child = command(&cargo_path(), &arguments).stdout(Stdio::piped()).spawn();
    let mut child = child.map_err(|error| format!("cannot run the mutants: {error}"))?;
    let path = root().join(KEPT);
    let old = fs::read_to_string(&path).map_err(|error| format!("cannot read {KEPT}: {error}"))?;
    let mut kept = lines(&old)?;
    // Kept one by one: all take a long time.
    for line in child.stdout.take().into_iter().flat_map(|out| BufReader::new(out).lines()) {
        let found = lines(&line.map_err(|error| format!("cannot hear the mutants: {error}"))?)?;
        kept = replaced(&kept, &found);
        let text = kept.iter().fold(String::new(), |text, line| text + &format!("{line}\n"));
        fs::write(&path, text).map_err(|error| format!("cannot write {KEPT}: {error}"))?;
    }
    let status = child.wait().map_err(|error| format!("cannot run the mutants: {error}"))?;
    eprintln!("wrote {KEPT}; `cargo xtask gen` makes the table");
    let unnoticed: Vec<&Value> =
        kept.iter().filter(|line| line["noticed"] == json!([])).map(|line| &line["mutation"]).collect();
    match (status.success(), unnoticed.as_slice()) {
        (true, []) => Ok(()),
        (true, some) => Err(format!("nobody notices: {some:?}")),
        (false, _) => Err(format!("the mutants ended badly ({status})")),
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

/// Old lines with new ones in place of those of the same mutation, as far as these tell of the same cases; new ones that had none come
/// last.
fn replaced(old: &[Value], new: &[Value]) -> Vec<Value> {
    let of = |line: &Value| new.iter().find(|new| new["mutation"] == line["mutation"]).cloned();
    let mut all: Vec<Value> =
        old.iter().map(|line| of(line).map_or_else(|| line.clone(), |new| joined(line, new))).collect();
    let had = |line: &&Value| !old.iter().any(|old| old["mutation"] == line["mutation"]);
    all.extend(new.iter().filter(had).map(|line| joined(&Value::Null, line.clone())));
    all
}

/// A new line with what an old one says of other cases.
fn joined(old: &Value, mut new: Value) -> Value {
    let tried = new.as_object_mut().and_then(|fields| fields.remove("tried")).unwrap_or_default();
    let other = |case: &Value| !tried.as_array().is_some_and(|tried| tried.contains(case));
    for (key, case) in [("reached", None), ("noticed", Some(0))] {
        let name = |entry: &Value| case.map_or_else(|| entry.clone(), |at: usize| entry[at].clone());
        let kept = old[key].as_array().into_iter().flatten().filter(|entry| other(&name(entry))).cloned();
        let mut all: Vec<Value> = kept.chain(new[key].as_array().cloned().unwrap_or_default()).collect();
        all.sort_by_key(|entry| name(entry).to_string());
        new[key] = all.into();
    }
    new
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_found_again_takes_the_place_of_what_was_kept() {
        let line = |name: &str, tried: &[&str], noticed: &[&str]| {
            let noticed: Vec<Value> = noticed.iter().map(|case| json!([case, ["a claim"]])).collect();
            json!({ "mutation": name, "tried": tried, "reached": tried, "noticed": noticed })
        };
        let kept = replaced(&[], &[line("a", &["x", "y"], &["x"]), line("b", &["x"], &[])]);
        let all = replaced(&kept, &[line("c", &["x"], &["x"]), line("a", &["x", "z"], &["z"])]);
        let short = |line: &Value| (line["mutation"].clone(), line["reached"].clone(), line["noticed"].clone());
        let expected = [
            (json!("a"), json!(["x", "y", "z"]), json!([["z", ["a claim"]]])),
            (json!("b"), json!(["x"]), json!([])),
            (json!("c"), json!(["x"]), json!([["x", ["a claim"]]])),
        ];
        assert_eq!(all.iter().map(short).collect::<Vec<_>>(), expected);
        assert!(all.iter().all(|line| line.get("tried").is_none()));
    }
}
