//! Which quick cases notice that something is wrong on purpose: a JSON line a mutation, `cargo xtask mutants` keeps them.
//!
//! Without arguments all mutations, else those named, in the words of [`Mutation::ALL`]. A case is run with every mutation that
//! would change something in it, and notices one where a claim that held does not hold any more.

use rayon::prelude::*;
use serde_json::json;
use std::collections::BTreeMap;
use std::io::Write as _;
use std::process::ExitCode;
use tsubu::mutation::{Mutation, reached, set};
use tsubu_frame::{Claim, Origin};
use tsubu_verify::{CASES, Case};

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let chosen: Vec<_> =
        Mutation::ALL.iter().filter(|(_, of)| words.is_empty() || words.iter().any(|w| w == of)).collect();
    let cases: Vec<&Case> = CASES.iter().filter(|case| case.is_quick()).collect();
    // One after the other: what a case reaches is asked of the whole program.
    let mut reach: BTreeMap<&str, Vec<Mutation>> = BTreeMap::new();
    let mut held: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for case in &cases {
        reached();
        held.insert(case.name, holding(case));
        reach.insert(case.name, reached());
        eprintln!("{} is reached by {}", case.name, reach[case.name].len());
    }
    let mut unnoticed = 0;
    for (mutation, words) in chosen {
        set(Some(*mutation));
        let reached: Vec<&&Case> = cases.iter().filter(|case| reach[case.name].contains(mutation)).collect();
        let notices = |case: &&&Case| {
            let now = holding(case);
            held[case.name].iter().any(|claim| !now.contains(claim))
        };
        let noticed: Vec<&&Case> = reached.par_iter().copied().filter(notices).collect();
        set(None);
        let names = |cases: &[&&Case]| cases.iter().map(|case| case.name).collect::<Vec<_>>();
        let line = json!({ "mutation": words, "reached": names(&reached), "noticed": names(&noticed) });
        let written = writeln!(std::io::stdout(), "{line}");
        eprintln!("{words}: noticed by {} of {}", noticed.len(), reached.len());
        if written.is_err() {
            return ExitCode::FAILURE;
        }
        unnoticed += usize::from(noticed.is_empty());
    }
    if unnoticed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The claims of a case that hold. Controls are no claims: that a model which is wrong anyway is refused says nothing.
fn holding(case: &Case) -> Vec<String> {
    let claims: Vec<Claim> = case.claims(None).unwrap_or_default();
    let held = claims.into_iter().filter(|claim| claim.pass && claim.origin != Origin::Control);
    held.map(|claim| claim.name).collect()
}
