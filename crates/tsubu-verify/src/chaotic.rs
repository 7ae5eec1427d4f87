//! Which claims hang on the last bit of the start, as it was found when that was last kept.

use serde::Deserialize;

/// One case a line; `cargo xtask chaotic` writes them.
const KEPT: &str = include_str!("../chaotic.jsonl");

/// A case some of whose claims another start moves: a grain beside its place by the last bit, or other random numbers on a lattice.
#[derive(Clone, Debug, Deserialize)]
pub struct Chaotic {
    /// Its name.
    pub case: String,
    /// The claims.
    pub claims: Vec<String>,
}

/// All that are kept.
pub fn chaotic() -> Vec<Chaotic> {
    KEPT.lines().filter_map(|line| serde_json::from_str(line).ok()).collect()
}

/// Cases that claim by one draw what hangs on it, and why: a list that may only become shorter.
const ONE_DRAW: &[(&str, &[&str])] = &[
    (
        "an error, a loss or what is left of a motion: its range is what rounding and the law allow, whatever the draw",
        &["stacked", "bed-at-rest", "gutt-haff"],
    ),
    (
        "one ball on the orbit of a closed form: nothing is drawn, and the last bit moves the last digits",
        &["impact-damper"],
    ),
];

/// Why a case claims by one draw what hangs on it.
pub fn one_draw(case: &str) -> Option<&'static str> {
    ONE_DRAW.iter().find(|(_, cases)| cases.contains(&case)).map(|(why, _)| *why)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recorded;

    /// One draw of what hangs on the draw says little. The cases that still claim by one are listed, and the list only becomes shorter.
    #[test]
    fn claims_that_hang_on_the_draw_are_ensembles_or_listed() {
        let kept = chaotic();
        for found in &kept {
            let claims = recorded(&found.case);
            assert!(!claims.is_empty(), "there is no case `{}`", found.case);
            let single = claims.iter().find(|claim| found.claims.contains(&claim.name) && claim.ensemble.is_none());
            let listed = ONE_DRAW.iter().any(|(_, cases)| cases.contains(&found.case.as_str()));
            match single {
                Some(claim) => assert!(listed, "{}: {} is one draw", found.case, claim.name),
                None => assert!(!listed, "{}: all are ensembles now: take it from the list", found.case),
            }
        }
        for name in ONE_DRAW.iter().flat_map(|(_, cases)| *cases) {
            assert!(kept.iter().any(|found| found.case == *name), "`{name}` does not hang on the draw");
        }
    }
}
