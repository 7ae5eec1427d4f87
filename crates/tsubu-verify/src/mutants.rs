//! Which quick cases noticed that something was wrong on purpose, as it was found when that was last kept.

use serde::Deserialize;
use tsubu::mutation::Mutation;

/// One mutation a line; `cargo xtask mutants` writes them.
const KEPT: &str = include_str!("../mutants.jsonl");

/// How long [s] a quick case took when it was last kept that mutations are tried on.
pub const MUTATED_LONGEST: f64 = 4.0;

/// What became of a mutation of the engines.
#[derive(Clone, Debug, Deserialize)]
pub struct Mutant {
    /// What was wrong, in words.
    pub mutation: String,
    /// The cases of at most [`MUTATED_LONGEST`] that it changes something in.
    pub reached: Vec<String>,
    /// Those of them in which claims that held did not hold any more, with these claims.
    pub noticed: Vec<(String, Vec<String>)>,
}

/// All that are kept.
pub fn mutants() -> Vec<Mutant> {
    KEPT.lines().filter_map(|line| serde_json::from_str(line).ok()).collect()
}

/// Words of the mutations that were not run on these engines: `cargo xtask mutants WORDS` does it.
pub fn mutants_not_run() -> Vec<&'static str> {
    let kept = mutants();
    let run = |words: &str| kept.iter().any(|mutant| mutant.mutation == words);
    Mutation::ALL.into_iter().map(|(_, words)| words).filter(|words| !run(words)).collect()
}

/// What was wrong where a claim of a case did not hold any more: its controls.
pub(crate) fn refusing(case: &str, claim: &str) -> Vec<String> {
    let refuses = |mutant: &Mutant| {
        mutant.noticed.iter().any(|(of, claims)| of == case && claims.iter().any(|name| name == claim))
    };
    mutants().into_iter().filter(refuses).map(|mutant| mutant.mutation).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::CASES;

    /// A constant that may be wrong by 5 %, or a rule that may be missing, without that any quick case says so.
    #[test]
    fn no_mutation_is_unnoticed() {
        let kept = mutants();
        assert!(kept.len() >= 12, "of {} mutations only is it known who notices", kept.len());
        for mutant in &kept {
            assert!(!mutant.noticed.is_empty(), "nobody notices: {}", mutant.mutation);
            assert!(Mutation::named(&mutant.mutation).is_some(), "there is no mutation `{}`", mutant.mutation);
            let known = |(name, _): &(String, _)| CASES.iter().any(|case| case.name == name && case.is_quick());
            assert!(mutant.noticed.iter().all(known), "{}: a case is no quick case", mutant.mutation);
            let reached = |(name, _): &(String, _)| mutant.reached.contains(name);
            assert!(mutant.noticed.iter().all(reached), "{}: a case that it does not reach notices", mutant.mutation);
        }
    }
}
