//! `tsubu design`: which of many dampers serves best.

use super::points;
use crate::failure::Failure;
use crate::table;
use clap::Args;
use std::fmt::Write as _;
use std::path::Path;
use tsubu::study::design;
use tsubu_frame::{ResultValue, Summary, Table};

#[derive(Args)]
#[command(after_help = "\
Examples:
  tsubu design damper.toml                              into out/damper-design
  tsubu design damper.toml --set design.runs=400        search longer
  tsubu run out/damper-design/best.toml                 the best, as a scene of its own
  tsubu design damper.toml --launcher slurm             round by round, each an array job

The scene says what may vary, and within which limits:
  [design]
  vary = { \"particles.balls.count\" = [10, 20, 30, 40, 50] }
  mass-limit = \"8 g\"

An interrupted design goes on where it was when the same command is typed again.")]
pub struct Options {
    #[command(flatten)]
    points: points::PointsOptions,
}

pub fn run(options: &Options) -> Result<(), Failure> {
    points::run("design", "runs", &options.points, design::design, design::runs, candidates)
}

/// Candidates that are shown.
const SHOWN: usize = 8;

/// A line for each of the candidates that are confirmed, the best first, and for the scene as it is written.
fn candidates(folder: &Path) -> Result<String, Failure> {
    let file = folder.join("design.csv");
    let all = Table::read(&file).map_err(|error| Failure::of_file(&error, folder))?;
    let column = |name: &str| all.numbers(name).unwrap_or_else(|| vec![f64::NAN; all.rows.len()]);
    let [mass, rms, low, high, stroke, ratio] =
        ["grain mass", "rms displacement", "rms low", "rms high", "peak displacement", "peak frequency ratio"]
            .map(column);
    let names = all.texts("candidate").unwrap_or_default();
    let standing = all.texts("standing").unwrap_or_default();
    let told = |row: &usize| ["best", "confirmed", "as written"].contains(&standing[*row].as_str());
    let mut order: Vec<usize> = (0..names.len().min(standing.len())).filter(told).collect();
    order.sort_by(|a, b| (standing[*b] == "best").cmp(&(standing[*a] == "best")).then(rms[*a].total_cmp(&rms[*b])));
    let header = ["", "candidate", "grains g", "rms mm", "95 % from", "to mm", "stroke mm", "peak ratio"];
    let mut rows = vec![header.map(str::to_owned).to_vec()];
    for row in order.iter().take(SHOWN) {
        let numbers = [mass[*row], rms[*row], low[*row], high[*row], stroke[*row]].map(|x| table::number(1e3 * x));
        let texts = [standing[*row].clone(), names[*row].clone()];
        rows.push(texts.into_iter().chain(numbers).chain([table::number(ratio[*row])]).collect());
    }
    let mut text = table::aligned(&rows);
    let summary = Summary::read(&folder.join("summary.json")).ok();
    match summary.as_ref().and_then(|summary| summary.results.get("ended by until")) {
        Some(ResultValue::Number(ended)) if *ended > 0.0 => {
            text.push_str("  ended by `until`: the best is known as well as asked, and nothing better is expected\n");
        }
        Some(_) => text.push_str("  ended by `runs`, before `until`\n"),
        None => {}
    }
    let scene = folder.join("best.toml");
    if scene.exists() {
        let _ = writeln!(text, "  the scene of the best: {}", scene.display());
    }
    Ok(text)
}
