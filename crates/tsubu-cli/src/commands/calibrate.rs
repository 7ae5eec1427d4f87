//! `tsubu calibrate`: which values of keys fit what was measured.

use super::points;
use crate::failure::Failure;
use crate::table;
use clap::Args;
use std::fmt::Write as _;
use std::path::Path;
use tsubu::study::calibrate;
use tsubu_frame::{Table, unit::for_people};

#[derive(Args)]
#[command(after_help = "\
Examples:
  tsubu calibrate calibrate.toml                         into out/calibrate-calibrate
  tsubu calibrate calibrate.toml --set calibrate.runs=200
  tsubu run out/calibrate-calibrate/best.toml            the scene with the most likely values
  tsubu calibrate calibrate.toml --launcher slurm        round by round, each an array job

The scene says what is not known, with its least and largest value, and what was measured:
  [calibrate]
  vary = { \"materials.sand.friction\" = [0.2, 0.8] }
  [[calibrate.measured]]
  result = \"heap slope\"
  value = 0.52
  uncertainty = 0.02

An interrupted calibration goes on where it was when the same command is typed again.")]
pub struct Options {
    #[command(flatten)]
    points: points::PointsOptions,
}

pub fn run(options: &Options) -> Result<(), Failure> {
    points::run("calibrate", "runs", &options.points, calibrate::calibrate, calibrate::runs, told)
}

/// What is known of each key, and each measured result beside what fresh runs gave.
fn told(folder: &Path) -> Result<String, Failure> {
    let read = |name: &str| Table::read(&folder.join(name)).map_err(|error| Failure::of_file(&error, folder));
    if !folder.join("parameters.csv").exists() {
        // Some of the runs are missing, and nothing is known yet.
        return Ok(String::new());
    }
    let parameters = read("parameters.csv")?;
    let mut rows =
        vec![["", "mean", "deviation", "95 % from", "to", "range from", "to", ""].map(str::to_owned).to_vec()];
    let column = |table: &Table, name: &str| table.numbers(name).unwrap_or_else(|| vec![f64::NAN; table.rows.len()]);
    let numbers = ["mean", "deviation", "low", "high", "range low", "range high"].map(|name| column(&parameters, name));
    let keys = parameters.texts("key").unwrap_or_default().into_iter();
    for (row, (key, unit)) in keys.zip(parameters.texts("unit").unwrap_or_default()).enumerate() {
        let unit = if unit == "-" { String::new() } else { unit };
        let cells = numbers.iter().map(|column| table::number(column[row]));
        rows.push([key].into_iter().chain(cells).chain([unit]).collect());
    }
    let mut text = table::aligned(&rows);
    let measured = read("measured.csv")?;
    let mut rows = vec![
        ["", "measured", "uncertainty", "expected", "fresh runs", "95 % from", "to", ""].map(str::to_owned).to_vec(),
    ];
    let numbers = ["measured", "uncertainty", "expected", "fresh runs", "fresh runs low", "fresh runs high"]
        .map(|name| column(&measured, name));
    let results = measured.texts("result").unwrap_or_default().into_iter();
    for (row, (result, unit)) in results.zip(measured.texts("unit").unwrap_or_default()).enumerate() {
        let (factor, unit) = for_people(&unit);
        let cells = numbers.iter().map(|column| table::number(factor * column[row]));
        let unit = if unit == "-" { String::new() } else { unit.to_owned() };
        rows.push([result].into_iter().chain(cells).chain([unit]).collect());
    }
    text += &table::aligned(&rows);
    let scene = folder.join("best.toml");
    if scene.exists() {
        let _ = writeln!(text, "  the scene of the most likely values: {}", scene.display());
    }
    Ok(text)
}
