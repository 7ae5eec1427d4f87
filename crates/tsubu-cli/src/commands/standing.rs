//! How a study stands: for the head of its README how many of its stored claims hold, and for a section of its own why the others do not.

use super::held_against::sentence;
use std::fmt::Write as _;
use tsubu_frame::{Claim, Origin, Verdict};
use tsubu_verify::{CASES, reason, recorded};

/// Verdicts that need a reason, and what they are called there.
const OPEN: [(Verdict, &str); 2] = [(Verdict::Fail, "Does not agree"), (Verdict::Undecided, "Undecided")];

/// In how many claims the studies named hold, and in which cases not; names with a space between.
pub fn standing(studies: &str) -> String {
    let claims = claims(studies);
    let hold = |origin| claims.iter().filter(|(_, claim)| claim.origin == origin && claim.pass).count();
    let origins = Origin::SHIPPED.iter().map(|&origin| (origin, hold(origin))).filter(|&(_, count)| count > 0);
    let origins: Vec<String> = origins.map(|(origin, count)| format!("{} {count}", origin.words())).collect();
    let all = claims.iter().filter(|(_, claim)| claim.verdict() == Verdict::Pass).count();
    let mut text = format!("{all} of {} claims hold", claims.len());
    if !origins.is_empty() {
        let _ = write!(text, ", by where their ranges come from: {}", origins.join(", "));
    }
    text.push_str(".\n");
    for (verdict, heading) in OPEN {
        let mut cases: Vec<(&str, usize)> = Vec::new();
        for (case, _, count) in reasons(&claims, verdict) {
            match cases.iter_mut().find(|(of, _)| *of == case) {
                Some((_, all)) => *all += count,
                None => cases.push((case, count)),
            }
        }
        let cases: Vec<String> = cases.iter().map(|(case, count)| format!("`{case}` {count}")).collect();
        let cases = if cases.is_empty() { "nothing".to_owned() } else { cases.join(", ") };
        let _ = write!(text, "\n**{heading}:** {cases}.\n");
    }
    text
}

/// Why the other claims of the studies named do not hold, case by case.
pub fn open(studies: &str) -> String {
    let claims = claims(studies);
    let mut text = String::new();
    for (verdict, heading) in OPEN {
        let reasons = reasons(&claims, verdict);
        if reasons.is_empty() {
            continue;
        }
        let _ = write!(text, "{}**{heading}:**\n\n", if text.is_empty() { "" } else { "\n" });
        for (case, why, count) in reasons {
            let claims = if count == 1 { "1 claim".to_owned() } else { format!("{count} claims") };
            let _ = writeln!(text, "- `{case}`, {claims}: {}.", sentence(why));
        }
    }
    if text.is_empty() { "All claims hold.\n".to_owned() } else { text }
}

/// The claims that are kept of some studies, each with its case.
fn claims(studies: &str) -> Vec<(&'static str, Claim)> {
    let cases = CASES.iter().filter(|case| studies.split(' ').any(|study| case.study == study));
    cases
        .flat_map(|case| recorded(case.name).into_iter().map(|claim| (case.name, claim)))
        .filter(|(_, claim)| !matches!(claim.origin, Origin::Control | Origin::Regression))
        .collect()
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
