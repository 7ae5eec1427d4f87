//! Claims as they were found when they were last kept, so that they can be read without running anything.

use crate::case_run::CaseRun;
use crate::mutants;
use serde_json::Value;
use tsubu_frame::Claim;

/// One claim a line; `cargo xtask claims` writes them.
const KEPT: &str = include_str!("../claims.jsonl");

/// The kept claims of a case, in the order in which the case makes them, with the mutations that refuse them among their controls; none
/// where it has not been run since.
pub fn recorded(case: &str) -> Vec<Claim> {
    let lines = KEPT.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    let of_case = lines.filter(|line| line["case"] == case);
    let mut claims: Vec<Claim> = of_case.filter_map(|line| serde_json::from_value(line).ok()).collect();
    for claim in &mut claims {
        claim.controls.extend(mutants::refusing(case, &claim.name));
    }
    claims
}

/// One run of a case a line, the one that its kept claims are of.
const RUNS: &str = include_str!("../runs.jsonl");

/// The run that the kept claims of a case are of; none of claims that were kept before runs were.
pub fn recorded_run(case: &str) -> Option<CaseRun> {
    let runs = RUNS.lines().filter_map(|line| serde_json::from_str::<CaseRun>(line).ok());
    runs.into_iter().find(|run| run.case == case)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CASES, control};
    use tsubu_frame::Origin;

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
            let run = recorded_run(case.name).expect("its run");
            assert!(!run.processor.is_empty() && run.cores > 0 && run.date.len() == 10, "{run:?}");
            for claim in kept {
                let low = claim.low.is_none_or(|low| claim.value >= low);
                let high = claim.high.is_none_or(|high| claim.value <= high);
                assert_eq!(claim.pass, low && high, "{}: {}", case.name, claim.name);
            }
        }
    }

    /// A range without a word on where it comes from would count as any other.
    #[test]
    fn no_claim_is_without_origin() {
        for case in CASES {
            for claim in recorded(case.name) {
                assert!(Origin::SHIPPED.contains(&claim.origin), "{}: {}", case.name, claim.name);
                assert!(!claim.source.is_empty(), "{}: {}", case.name, claim.name);
            }
        }
    }

    /// A claim that no wrong model was ever refused by may hold for anything.
    #[test]
    fn no_claim_is_without_control() {
        for case in CASES {
            for claim in recorded(case.name) {
                assert!(!control::is_missing(&claim), "{}: {} has no control", case.name, claim.name);
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
