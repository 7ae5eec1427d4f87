//! Keeping what verification cases claim, `crates/tsubu-verify/claims.jsonl`, and the runs that this is of, `runs.jsonl` beside it.

use crate::shell::{command, output, released, root};
use serde_json::Value;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Stdio;

/// Where the claims are kept, one a line.
pub const KEPT: &str = "crates/tsubu-verify/claims.jsonl";

/// Where the runs are kept that the claims are of, one a case and line.
const RUNS: &str = "crates/tsubu-verify/runs.jsonl";

/// Runs cases (those of some names or studies; without names all of at most a minute) and keeps their claims in place of the old. After
/// `--from` it takes what a folder of `tsubu verify -o` has, and runs nothing.
pub fn claims(words: &[&str]) -> Result<(), String> {
    let tsubu = released()?;
    let list = output(&tsubu, &["verify", "--list"])?;
    let cases = listed(&list);
    let (folder, chosen): (PathBuf, Vec<&str>) = match words {
        ["--from", folder] => {
            let folder = PathBuf::from(folder);
            let done = |case: &&Listed| folder.join(format!("cases/{}.json", case.name)).is_file();
            let done = cases.iter().filter(done).map(|case| case.name).collect();
            (folder, done)
        }
        names => {
            let named = |case: &Listed, name: &str| [case.name, case.study].contains(&name);
            if let Some(name) = names.iter().find(|name| !cases.iter().any(|case| named(case, name))) {
                return Err(format!("no case and no study is named `{name}`: `tsubu verify --list` shows them"));
            }
            let wanted = |case: &&Listed| match names {
                [] => case.short,
                names => names.iter().any(|name| named(case, name)),
            };
            let chosen: Vec<&str> = cases.iter().filter(wanted).map(|case| case.name).collect();
            (run(&tsubu, &chosen)?, chosen)
        }
    };
    let (old, old_runs) = (read()?, runs()?);
    let (mut claims, mut runs) = (String::new(), String::new());
    for case in cases.iter().map(|case| case.name) {
        if chosen.contains(&case) {
            let done = read_json(&folder.join(format!("cases/{case}.json")))?;
            for mut claim in done["claims"].as_array().cloned().unwrap_or_default() {
                claim["case"] = case.into();
                claim.as_object_mut().map(|fields| fields.remove("points"));
                // In the order of names, so that the file differs where a claim does.
                claim.sort_all_objects();
                let _ = writeln!(claims, "{claim}");
            }
            let _ = writeln!(runs, "{}", done["run"]);
        } else {
            let of_case = |all: &[Value]| {
                let lines = all.iter().filter(|line| line["case"] == case);
                lines.fold(String::new(), |text, line| format!("{text}{line}\n"))
            };
            let kept = [&old, &old_runs].map(|all| of_case(all));
            claims += &kept[0];
            runs += &kept[1];
        }
    }
    for (name, text) in [(KEPT, claims), (RUNS, runs)] {
        fs::write(root().join(name), text).map_err(|error| format!("cannot write {name}: {error}"))?;
    }
    eprintln!("wrote {KEPT} and {RUNS} of {} cases; `cargo xtask gen` makes the tables", chosen.len());
    Ok(())
}

/// The claims that are kept.
pub fn read() -> Result<Vec<Value>, String> {
    lines(KEPT)
}

/// The runs that they are of.
fn runs() -> Result<Vec<Value>, String> {
    lines(RUNS)
}

fn lines(name: &str) -> Result<Vec<Value>, String> {
    let text = fs::read_to_string(root().join(name)).map_err(|error| format!("cannot read {name}: {error}"))?;
    let lines = text.lines().map(|line| serde_json::from_str(line).map_err(|error| format!("{name}: {error}")));
    lines.collect()
}

fn read_json(path: &Path) -> Result<Value, String> {
    let text = fs::read_to_string(path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    serde_json::from_str(&text).map_err(|error| format!("{}: {error}", path.display()))
}

struct Listed<'a> {
    name: &'a str,
    study: &'a str,
    short: bool,
}

/// The rows of `tsubu verify --list`: case, study, budget, what it checks. Short is a budget of at most a minute.
fn listed(list: &str) -> Vec<Listed<'_>> {
    let rows = list.lines().skip(1).filter_map(|line| {
        let mut words = line.split_whitespace();
        let (name, study, budget) = (words.next()?, words.next()?, words.next()?.parse::<u32>().ok()?);
        Some(Listed { name, study, short: budget <= 60 })
    });
    rows.collect()
}

/// Runs cases side by side with their controls; gives the folder in which each is kept, whether its claims hold or not. What the same
/// program has done before is not run again. A release build: what a case costs is told, and some claims are on time.
fn run(tsubu: &str, cases: &[&str]) -> Result<PathBuf, String> {
    let folder = root().join("target/kept-claims");
    let mut verify = command(tsubu, &[&["verify"], cases].concat());
    verify.args(["--controls", "-o"]).arg(&folder).stdout(Stdio::null());
    if folder.join(".tsubu").is_file() {
        verify.arg("--resume");
    }
    let done = verify.status().map_err(|error| format!("cannot run the cases: {error}"))?;
    if matches!(done.code(), Some(0 | 1)) { Ok(folder) } else { Err(format!("`tsubu verify` ended badly ({done})")) }
}

#[cfg(test)]
mod tests {
    use super::listed;

    #[test]
    fn the_list_of_cases_is_read() {
        let list = "  case   study  budget   what it checks\n  haff   dem   2 s    a gas\n  janssen dem   1800 s    long silos\n  twin dem   5 s, gap    a gap\n";
        let cases = listed(list);
        assert_eq!(cases.len(), 3);
        assert_eq!((cases[0].name, cases[0].study, cases[0].short), ("haff", "dem", true));
        assert!(!cases[1].short && cases[2].short);
    }
}
