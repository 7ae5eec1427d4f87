//! `tsubu response`: vibration against frequency.

use super::points;
use crate::failure::Failure;
use crate::table;
use clap::Args;
use std::path::Path;
use tsubu::check::human_time;
use tsubu::study::response;
use tsubu_frame::Table;

#[derive(Args)]
#[command(after_help = "\
Examples:
  tsubu response damper.toml                            into out/damper-response
  tsubu response damper.toml --set method=lattice       the cellular automaton: coarser, far faster
  tsubu response damper.toml --set response.seeds=3     mean and spread over three beds
  tsubu response damper.toml --launcher slurm           a task for some frequencies, and a last job that gathers

An interrupted response goes on where it was when the same command is typed again.")]
pub struct Options {
    #[command(flatten)]
    points: points::PointsOptions,
}

pub fn run(options: &Options) -> Result<(), Failure> {
    points::run("response", "frequencies", &options.points, response::response, response::runs, cases)
}

/// Columns of `cases.csv` that fit on a terminal, with the factor to the unit shown.
const COLUMNS: [(&str, &str, f64); 6] = [
    ("peak frequency ratio", "peak ratio", 1.0),
    ("peak rms", "peak rms mm", 1e3),
    ("half-power damping", "half-power damping", 1.0),
    ("loss factor", "loss factor", 1.0),
    ("apparent mass", "apparent mass g", 1e3),
    ("added-mass limit", "added-mass limit", 1.0),
];

fn cases(folder: &Path) -> Result<String, Failure> {
    let file = folder.join("cases.csv");
    let cases = Table::read(&file).map_err(|error| Failure::of_file(&error, folder))?;
    let column = |name: &str| cases.numbers(name).unwrap_or_else(|| vec![f64::NAN; cases.rows.len()]);
    let mut rows = vec![vec!["case".to_owned()]];
    rows[0].extend(COLUMNS.map(|(_, shown, _)| shown.to_owned()));
    rows[0].push("computed in".to_owned());
    rows.extend(cases.texts("case").unwrap_or_default().into_iter().map(|name| vec![name]));
    for (name, _, factor) in COLUMNS {
        for (row, value) in rows[1..].iter_mut().zip(column(name)) {
            row.push(table::number(factor * value));
        }
    }
    for (row, seconds) in rows[1..].iter_mut().zip(column("wall seconds")) {
        row.push(human_time(seconds));
    }
    Ok(table::aligned(&rows))
}
