//! Claims as they were found when they were last kept, so that they can be read without running anything.

use serde_json::Value;
use tsubu_frame::Claim;

/// One claim a line; `cargo xtask claims` writes them.
const KEPT: &str = include_str!("../claims.jsonl");

/// The kept claims of a case, in the order in which the case makes them; none where it has not been run since.
pub fn recorded(case: &str) -> Vec<Claim> {
    let lines = KEPT.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    let of_case = lines.filter(|line| line["case"] == case);
    of_case.filter_map(|line| serde_json::from_value(line).ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::CASES;

    /// A case that was renamed would leave claims of nobody behind.
    #[test]
    fn what_is_kept_is_of_cases_that_there_are() {
        for line in KEPT.lines() {
            let line: Value = serde_json::from_str(line).expect("a claim");
            let case = CASES.iter().find(|case| line["case"] == case.name);
            assert_eq!(line["study"], case.expect("a case").study, "{line}");
        }
        for case in CASES.iter().filter(|case| case.is_quick()) {
            let kept = recorded(case.name);
            assert!(!kept.is_empty(), "{}: `cargo xtask claims {}`", case.name, case.name);
            for claim in kept {
                let low = claim.low.is_none_or(|low| claim.value >= low);
                let high = claim.high.is_none_or(|high| claim.value <= high);
                assert_eq!(claim.pass, low && high, "{}: {}", case.name, claim.name);
            }
        }
    }

    /// A gap is a case of which a claim fails, and nothing else is.
    #[test]
    fn gaps_are_the_cases_whose_claims_fail() {
        for case in CASES {
            let kept = recorded(case.name);
            if !kept.is_empty() {
                assert_eq!(case.gap, kept.iter().any(|claim| !claim.pass), "{}", case.name);
            }
        }
    }
}
