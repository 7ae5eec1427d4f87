//! How a study stands, for the head of its README: how many of its stored claims hold, and why the others do not.

use super::held_against::sentence;
use std::fmt::Write as _;
use tsubu_frame::{Claim, Origin, Verdict};
use tsubu_verify::{CASES, reason, recorded};

/// Of the studies named, one after the other with a space between.
pub fn standing(studies: &str) -> String {
    let cases = CASES.iter().filter(|case| studies.split(' ').any(|study| case.study == study));
    let claims: Vec<(&str, Claim)> = cases
        .flat_map(|case| recorded(case.name).into_iter().map(|claim| (case.name, claim)))
        .filter(|(_, claim)| !matches!(claim.origin, Origin::Control | Origin::Regression))
        .collect();
    let hold = |origin| claims.iter().filter(|(_, claim)| claim.origin == origin && claim.pass).count();
    let origins = Origin::SHIPPED.iter().map(|&origin| (origin, hold(origin))).filter(|&(_, count)| count > 0);
    let origins: Vec<String> = origins.map(|(origin, count)| format!("{} {count}", origin.words())).collect();
    let all = claims.iter().filter(|(_, claim)| claim.verdict() == Verdict::Pass).count();
    let mut text =
        format!("{all} of {} claims hold, by where their ranges come from: {}.\n", claims.len(), origins.join(", "));
    for (verdict, heading) in [(Verdict::Fail, "Does not agree"), (Verdict::Undecided, "Undecided")] {
        let reasons = reasons(&claims, verdict);
        if reasons.is_empty() {
            let _ = write!(text, "\n**{heading}:** nothing.\n");
            continue;
        }
        let _ = write!(text, "\n**{heading}:**\n\n");
        for (case, why, count) in reasons {
            let claims = if count == 1 { "1 claim".to_owned() } else { format!("{count} claims") };
            let _ = writeln!(text, "- `{case}`, {claims}: {}.", sentence(why));
        }
    }
    text
}

/// Cases with claims of a verdict, each with its reasons and how many claims they are said of.
fn reasons<'a>(claims: &'a [(&'a str, Claim)], verdict: Verdict) -> Vec<(&'a str, &'a str, usize)> {
    let mut reasons: Vec<(&str, &str, usize)> = Vec::new();
    for (case, claim) in claims.iter().filter(|(_, claim)| claim.verdict() == verdict) {
        let why = reason(case, &claim.name).unwrap_or(&claim.source);
        match reasons.iter_mut().find(|(of, same, _)| of == case && *same == why) {
            Some((.., count)) => *count += 1,
            None => reasons.push((case, why, 1)),
        }
    }
    reasons
}
