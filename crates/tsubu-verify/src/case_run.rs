//! What a run of a case was: kept once a case, beside its claims.

use serde::{Deserialize, Serialize};
use std::time::{SystemTime, UNIX_EPOCH};
use tsubu::bench::processor;
use tsubu_frame::Claim;

/// When, where and with what a case was run, and what that cost.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CaseRun {
    /// Name of the case.
    pub case: String,
    /// Version of tsubu.
    pub version: String,
    /// Model of the processor.
    pub processor: String,
    /// Its cores.
    pub cores: usize,
    /// Day, in UTC, `2026-11-23`.
    pub date: String,
    /// Computing time [s], without that of controls.
    pub seconds: f64,
    /// Runs of its ensembles.
    #[serde(default)]
    pub members: usize,
}

impl CaseRun {
    /// Of this machine and today.
    pub(crate) fn here(case: &str, seconds: f64, members: usize) -> Self {
        Self {
            case: case.to_owned(),
            version: tsubu::VERSION.to_owned(),
            processor: processor(),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            date: today(),
            seconds,
            members,
        }
    }
}

/// A case that is done.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Done {
    /// What the run was.
    pub run: CaseRun,
    /// What came of it.
    pub claims: Vec<Claim>,
}

/// The day, in UTC.
fn today() -> String {
    let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    let [year, month, day] = civil((seconds / 86_400) as i64);
    format!("{year}-{month:02}-{day:02}")
}

/// Year, month and day, so many days after 1970-01-01: years are counted from March, so that a leap day is the last of its year.
fn civil(days: i64) -> [i64; 3] {
    let days = days + 719_468;
    let (era, of_era) = (days.div_euclid(146_097), days.rem_euclid(146_097));
    let year = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    let month = (5 * of_year + 2) / 153;
    let day = of_year - (153 * month + 2) / 5 + 1;
    let from_january = if month < 10 { month + 3 } else { month - 9 };
    [year + era * 400 + i64::from(from_january <= 2), from_january, day]
}

#[cfg(test)]
mod tests {
    use super::civil;

    #[test]
    fn days_have_the_dates_of_the_calendar() {
        let days = [(0, [1970, 1, 1]), (11_016, [2000, 2, 29]), (11_017, [2000, 3, 1]), (20_454, [2026, 1, 1])];
        for (day, date) in days {
            assert_eq!(civil(day), date, "{day}");
        }
    }
}
