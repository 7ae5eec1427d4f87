//! The table of claims.

use crate::page::{Block, Grid, Tone};
use crate::text::short;
use tsubu_frame::{Claim, Summary, Verdict, unit::for_people};

/// The accepted range of a claim, as people read numbers of its unit.
pub(crate) fn range(claim: &Claim, unit: &str) -> String {
    let (factor, unit) = for_people(unit);
    let unit = if unit == "-" { String::new() } else { format!(" {unit}") };
    let end = |x: Option<f64>| x.map_or(String::new(), |x| short(x * factor));
    match (claim.low, claim.high) {
        (None, None) => "any".to_owned(),
        (Some(_), None) => format!("≥ {}{unit}", end(claim.low)),
        (None, Some(_)) => format!("≤ {}{unit}", end(claim.high)),
        (Some(low), Some(high)) if low == high => format!("{}{unit}", end(claim.low)),
        _ => format!("{} … {}{unit}", end(claim.low), end(claim.high)),
    }
}

/// Claims with their ranges; a failed one stands out. `unit` knows the units of those that are about results.
pub(crate) fn claims_table<'a>(claims: &[&'a Claim], unit: impl Fn(&'a str) -> &'a str) -> Block {
    let mut grid = Grid::new(["", "claim", "value", "accepted", "source"]);
    for claim in claims {
        let si = unit(&claim.name);
        let (factor, shown) = for_people(si);
        let value = short(claim.value * factor);
        let value = if shown == "-" { value } else { format!("{value} {shown}") };
        let (tone, word) = match claim.verdict() {
            Verdict::Pass => (Tone::Good, "pass"),
            Verdict::Fail => (Tone::Bad, "FAIL"),
            Verdict::Undecided => (Tone::Warning, "undecided"),
        };
        grid.push(tone, [word, &claim.name, &value, &range(claim, si), &claim.source]);
    }
    Block::Table(grid)
}

/// The claims of a run or study, if it makes any.
pub(crate) fn claims_of(summary: &Summary) -> Option<Block> {
    let claims: Vec<&Claim> = summary.claims.iter().collect();
    (!claims.is_empty()).then(|| claims_table(&claims, |name| summary.unit(name)))
}
