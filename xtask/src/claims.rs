//! Keeping what verification cases claim: `crates/tsubu-verify/claims.jsonl`.

use crate::shell::{cargo, cargo_path, command, output, root};
use serde_json::Value;
use std::fmt::Write as _;
use std::fs;

/// Where the claims are kept, one a line.
pub const KEPT: &str = "crates/tsubu-verify/claims.jsonl";

/// Runs cases (those of some names or studies; without names all quick ones) and keeps their claims in place of the old.
pub fn claims(names: &[&str]) -> Result<(), String> {
    cargo(&["build", "--package", "tsubu-cli", "--quiet"])?;
    let list = output(&["run", "--package", "tsubu-cli", "--quiet", "--", "verify", "--list"])?;
    let cases = listed(&list);
    let chosen = |case: &&Listed| match names {
        [] => case.quick,
        names => names.contains(&case.name) || names.contains(&case.study),
    };
    let old = read()?;
    let mut text = String::new();
    for case in &cases {
        if chosen(&case) {
            for mut claim in run(case.name)? {
                claim["case"] = case.name.into();
                claim.as_object_mut().map(|fields| fields.remove("points"));
                let _ = writeln!(text, "{claim}");
            }
        } else {
            for claim in old.iter().filter(|claim| claim["case"] == case.name) {
                let _ = writeln!(text, "{claim}");
            }
        }
    }
    fs::write(root().join(KEPT), text).map_err(|error| format!("cannot write {KEPT}: {error}"))?;
    eprintln!("wrote {KEPT}; `cargo xtask gen` makes the tables");
    Ok(())
}

/// What is kept.
pub fn read() -> Result<Vec<Value>, String> {
    let text = fs::read_to_string(root().join(KEPT)).map_err(|error| format!("cannot read {KEPT}: {error}"))?;
    let lines = text.lines().map(|line| serde_json::from_str(line).map_err(|error| format!("{KEPT}: {error}")));
    lines.collect()
}

struct Listed<'a> {
    name: &'a str,
    study: &'a str,
    quick: bool,
}

/// The rows of `tsubu verify --list`: case, study, budget, what it checks. Quick is what `tsubu verify` alone runs: a budget of at most
/// a minute, no gap.
fn listed(list: &str) -> Vec<Listed<'_>> {
    let rows = list.lines().skip(1).filter_map(|line| {
        let mut words = line.split_whitespace();
        let (name, study, budget) = (words.next()?, words.next()?, words.next()?.parse::<u32>().ok()?);
        Some(Listed { name, study, quick: budget <= 60 && words.next()? == "s" })
    });
    rows.collect()
}

/// The claims of a case, whether they hold or not.
fn run(case: &str) -> Result<Vec<Value>, String> {
    eprintln!("{case}");
    let folder = root().join("target/claims").join(case);
    let arguments = [
        "run",
        "--package",
        "tsubu-cli",
        "--quiet",
        "--",
        "verify",
        case,
        "--quiet",
        "--controls",
        "--overwrite",
        "-o",
    ];
    let mut verify = command(&cargo_path(), &arguments);
    let done = verify.arg(&folder).output().map_err(|error| format!("cannot run `{case}`: {error}"))?;
    if !matches!(done.status.code(), Some(0 | 1)) {
        return Err(format!("`tsubu verify {case}` ended badly: {}", String::from_utf8_lossy(&done.stderr)));
    }
    let text = fs::read_to_string(folder.join("verify.json")).map_err(|error| format!("{case}: {error}"))?;
    let kept: Value = serde_json::from_str(&text).map_err(|error| format!("{case}: {error}"))?;
    Ok(kept["claims"].as_array().cloned().unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::listed;

    #[test]
    fn the_list_of_cases_is_read() {
        let list = "  case   study  budget   what it checks\n  haff   dem   2 s    a gas\n  janssen dem   1800 s    long silos\n  twin dem   5 s, gap    a gap\n";
        let cases = listed(list);
        assert_eq!(cases.len(), 3);
        assert_eq!((cases[0].name, cases[0].study, cases[0].quick), ("haff", "dem", true));
        assert!(!cases[1].quick && !cases[2].quick);
    }
}
