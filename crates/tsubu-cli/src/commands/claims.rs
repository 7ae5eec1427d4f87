//! Claims as lines.

use crate::stream::Stream;
use crate::table;
use tsubu_frame::{Claim, Verdict};

/// `pass  study  name  value  [low, high]  source`
pub fn line(claim: &Claim) -> String {
    let verdict = match claim.verdict() {
        Verdict::Pass => Stream::Data.green("pass"),
        Verdict::Fail => Stream::Data.bold_red("FAIL"),
        Verdict::Undecided => Stream::Data.yellow("undecided"),
    };
    let study = if claim.study.is_empty() { String::new() } else { format!("{:<12}  ", claim.study) };
    let value = table::number(claim.value);
    let range = table::range(claim.low, claim.high);
    format!("{verdict}  {study}{:<52}  {value:>11}  {range:<24}  {}", claim.name, claim.source).trim_end().to_owned()
        + "\n"
}
