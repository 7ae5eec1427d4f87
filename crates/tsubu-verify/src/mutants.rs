//! Which quick cases noticed that something was wrong on purpose, as it was found when that was last kept.

use serde::Deserialize;

/// One mutation a line; `cargo xtask mutants` writes them.
const KEPT: &str = include_str!("../mutants.jsonl");

/// What became of a mutation of the engines.
#[derive(Clone, Debug, Deserialize)]
pub struct Mutant {
    /// What was wrong, in words.
    pub mutation: String,
    /// How many quick cases it changes something in.
    pub reached: usize,
    /// Those of them in which a claim that held did not hold any more.
    pub noticed: Vec<String>,
}

/// All that are kept.
pub fn mutants() -> Vec<Mutant> {
    KEPT.lines().filter_map(|line| serde_json::from_str(line).ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::CASES;
    use tsubu::mutation::Mutation;

    /// A constant that may be wrong by 5 %, or a rule that may be missing, without that any quick case says so.
    #[test]
    fn no_mutation_is_unnoticed() {
        let kept = mutants();
        for (_, words) in Mutation::ALL {
            let mutant = kept.iter().find(|mutant| mutant.mutation == words);
            let noticed = mutant.is_some_and(|mutant| !mutant.noticed.is_empty());
            assert!(noticed, "nobody notices: {words} (`cargo xtask mutants '{words}'`)");
        }
        for mutant in &kept {
            assert!(Mutation::named(&mutant.mutation).is_some(), "there is no mutation `{}`", mutant.mutation);
            let known = |name: &String| CASES.iter().any(|case| case.name == name && case.is_quick());
            assert!(mutant.noticed.iter().all(known), "{}: a case is no quick case", mutant.mutation);
            assert!(mutant.noticed.len() <= mutant.reached, "{}", mutant.mutation);
        }
    }
}
