//! The table of a sweep, `sweep.csv`.

use super::super::cases::{Case, value_text};
use super::CASES;
use tsubu_frame::{Cell, ResultValue, Summary, Table};

/// What is known of a case.
pub enum Outcome {
    /// What its run says.
    Told(Box<Summary>),
    /// It has no result, and why.
    Missing(String),
}

impl Outcome {
    /// What its run says, where there is any.
    pub fn summary(self) -> Option<Summary> {
        match self {
            Self::Told(summary) => Some(*summary),
            Self::Missing(_) => None,
        }
    }

    fn told(&self) -> Option<&Summary> {
        match self {
            Self::Told(summary) => Some(summary),
            Self::Missing(_) => None,
        }
    }
}

/// One row a case: what varied, how it ended, what it cost, what came out, what is to be noted of it alone, and where it is.
pub(super) fn of(cases: &[&Case], outcomes: &[Outcome]) -> Table {
    let told: Vec<&Summary> = outcomes.iter().filter_map(Outcome::told).collect();
    let mut results: Vec<(&str, &str)> = Vec::new();
    for summary in &told {
        for (name, value) in summary.results_in_order() {
            if matches!(value, ResultValue::Number(_)) && !results.iter().any(|(known, _)| *known == name) {
                results.push((name, summary.unit(name)));
            }
        }
    }
    let keys: Vec<&str> =
        cases.first().map_or_else(Vec::new, |case| case.values.iter().map(|(k, _)| k.as_str()).collect());
    let header = ["case [text]".to_owned()]
        .into_iter()
        .chain(keys.iter().map(|k| format!("{k} [text]")))
        .chain(["status [text]", "wall seconds [s]", "energy residual [-]"].map(str::to_owned))
        .chain(results.iter().map(|(name, unit)| format!("{name} [{unit}]")))
        .chain(["remark [text]", "folder [text]"].map(str::to_owned));
    let mut table = Table::new(header);
    for (case, outcome) in cases.iter().zip(outcomes) {
        let mut row = vec![Cell::Text(case.name.clone())];
        row.extend(case.values.iter().map(|(_, v)| Cell::Text(value_text(v))));
        let summary = outcome.told();
        let number = |of: &dyn Fn(&Summary) -> f64| Cell::Number(summary.map_or(f64::NAN, of));
        row.push(summary.map_or("missing", |summary| summary.status.word()).into());
        row.extend([number(&|s| s.wall_seconds), number(&|s| s.energy.residual_relative)]);
        row.extend(results.iter().map(|(name, _)| match summary.and_then(|summary| summary.results.get(name)) {
            Some(ResultValue::Number(value)) => Cell::Number(*value),
            _ => Cell::Number(f64::NAN),
        }));
        row.push(Cell::Text(match outcome {
            Outcome::Told(summary) => remark(summary, &told),
            Outcome::Missing(why) => why.clone(),
        }));
        row.push(Cell::Text(format!("{CASES}{}", case.folder())));
        table.push(row);
    }
    table
}

/// Warnings of a case that not every case has: what the method says of the scene belongs to all of them.
fn remark(summary: &Summary, told: &[&Summary]) -> String {
    let common = |warning: &String| told.len() > 1 && told.iter().all(|other| other.warnings.contains(warning));
    let own = summary.warnings.iter().filter(|warning| !common(warning));
    own.filter_map(|warning| warning.lines().next()).collect::<Vec<_>>().join("; ")
}
