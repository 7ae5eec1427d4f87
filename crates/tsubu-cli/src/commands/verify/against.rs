//! What moved since claims were stored, and what each case cost.

use super::runner::Outcome;
use crate::stream::Stream;
use crate::table;
use std::fmt::Write as _;
use tsubu_frame::Claim;
use tsubu_verify::{Case, Moved, moved, recorded, recorded_run};

/// What came out is held against this.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Against {
    /// The claims that are stored in the program
    Stored,
}

/// Orders cases so that those come first that tell most for their time: the fewest seconds a claim, as they were stored.
pub fn telling_first(cases: &mut [&'static Case]) {
    let price = |case: &&Case| {
        let seconds = recorded_run(case.name).map_or(f64::from(case.budget), |run| run.seconds);
        seconds / recorded(case.name).len().max(1) as f64
    };
    cases.sort_by(|a, b| price(a).total_cmp(&price(b)));
}

/// What moved in a case, a line each.
pub fn lines(case: &Case, outcome: &Outcome) -> String {
    let stored = recorded(case.name);
    let moved = all_moved(&stored, outcome);
    moved.iter().map(|moved| line(case, moved)).collect()
}

/// Whether a case came to nothing, or to other claims than are stored. A case of which nothing is stored has not moved.
fn all_moved<'a>(stored: &'a [Claim], outcome: &'a Outcome) -> Vec<Moved<'a>> {
    match (&outcome.run, stored) {
        (None, _) => vec![Moved { stored: None, now: outcome.claims.first(), how: "it came to nothing" }],
        (Some(_), []) => Vec::new(),
        (Some(_), stored) => moved(stored, &outcome.claims),
    }
}

/// `moved  case  name: stored 1.2 [1.1, 1.3], now 1.4 [1.35, 1.45]: how`
fn line(case: &Case, moved: &Moved) -> String {
    let side = |word: &str, claim: Option<&Claim>| {
        let interval = |claim: &Claim| match claim.ensemble.as_ref().map(|ensemble| ensemble.interval.as_slice()) {
            Some(&[from, to]) => format!(" {}", table::range(Some(from), Some(to))),
            _ => String::new(),
        };
        claim.map(|claim| format!("{word} {}{}", table::number(claim.value), interval(claim)))
    };
    let sides: Vec<String> = [side("stored", moved.stored), side("now", moved.now)].into_iter().flatten().collect();
    let claim = moved.now.or(moved.stored);
    let (name, source) = claim.map_or(("", ""), |claim| (&claim.name, &claim.source));
    let why = if moved.how == "it came to nothing" { source } else { moved.how };
    format!("{}  {}  {name}: {}: {why}\n", Stream::Data.bold_red("moved"), case.name, sides.join(", "))
}

/// The end of the comparison: how much moved, and what each case cost, the most expensive first; and whether anything moved.
pub fn end(cases: &[&'static Case], outcomes: &[Outcome]) -> (String, bool) {
    let (mut compared, mut count, mut unknown) = (0, 0, 0);
    for (case, outcome) in cases.iter().zip(outcomes) {
        let stored = recorded(case.name);
        compared += stored.len();
        count += all_moved(&stored, outcome).len();
        unknown += usize::from(stored.is_empty());
    }
    let moved = match count {
        0 => "none moved".to_owned(),
        count => Stream::Data.bold_red(&format!("{count} moved")),
    };
    let mut text = cost(cases, outcomes);
    let _ = write!(text, "{compared} stored claims of {} cases, {moved}", cases.len() - unknown);
    if unknown > 0 {
        let _ = write!(text, "; nothing is stored of {unknown} more");
    }
    text.push('\n');
    (text, count > 0)
}

/// case, claims, seconds, seconds when it was stored, budget
fn cost(cases: &[&'static Case], outcomes: &[Outcome]) -> String {
    let seconds = |run: Option<f64>| run.map_or_else(|| "-".to_owned(), |seconds| format!("{seconds:.1}"));
    let mut rows: Vec<(f64, Vec<String>)> = Vec::new();
    for (case, outcome) in cases.iter().zip(outcomes) {
        let taken = outcome.run.as_ref().map(|run| run.seconds);
        let stored = recorded_run(case.name).map(|run| run.seconds);
        let cells = [
            case.name.to_owned(),
            outcome.claims.len().to_string(),
            seconds(taken),
            seconds(stored),
            case.budget.to_string(),
        ];
        rows.push((taken.unwrap_or_default(), cells.to_vec()));
    }
    rows.sort_by(|a, b| b.0.total_cmp(&a.0));
    let all: f64 = rows.iter().map(|(taken, _)| taken).sum();
    let header = ["case", "claims", "seconds", "when stored", "budget"].map(str::to_owned).to_vec();
    let rows: Vec<Vec<String>> = [header].into_iter().chain(rows.into_iter().map(|(_, cells)| cells)).collect();
    format!("{}{all:.0} s of computing in all\n", table::aligned(&rows))
}

#[cfg(test)]
mod tests {
    use super::*;
    use tsubu_verify::{CASES, CaseRun};

    /// What was stored has not moved; a number that did is told, and so is a case that came to nothing.
    #[test]
    fn what_moved_is_told_and_counts() {
        let case = CASES.iter().find(|case| case.name == "restitution").expect("a case");
        let outcome = |claims, run| Outcome { claims, run, late: None };
        let same = outcome(recorded("restitution"), Some(CaseRun::default()));
        assert_eq!(lines(case, &same), "");
        let (text, moved) = end(&[case], &[same]);
        assert!(!moved && text.contains("none moved") && text.contains("budget"), "{text}");
        let mut claims = recorded("restitution");
        claims[0].value += 100.0;
        let far = outcome(claims, Some(CaseRun::default()));
        let told = lines(case, &far);
        assert!(told.starts_with("moved  restitution  ") && told.contains("by more than a tenth"), "{told}");
        assert!(end(&[case], &[far]).1);
        let nothing = outcome(vec![Claim { source: "it did not run: no".to_owned(), ..Claim::default() }], None);
        assert!(lines(case, &nothing).contains("it did not run: no") && end(&[case], &[nothing]).1);
    }
}
