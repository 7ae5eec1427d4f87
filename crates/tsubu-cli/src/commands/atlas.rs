//! `tsubu atlas`: the mass and the loss that a cavity shows, over frequency and acceleration.

use super::points;
use crate::failure::Failure;
use crate::table;
use clap::Args;
use std::collections::BTreeMap;
use std::path::Path;
use tsubu::study::atlas;
use tsubu_frame::Table;

#[derive(Args)]
#[command(after_help = "\
Examples:
  tsubu atlas damper.toml                               into out/damper-atlas
  tsubu atlas damper.toml --set atlas.seeds=3           three beds: the scatter between them
  tsubu atlas damper.toml --launcher slurm              round by round, each an array job
  tsubu predict structure.toml out/damper-atlas         the response of a structure with such a cavity

An interrupted atlas goes on where it was when the same command is typed again.")]
pub struct Options {
    #[command(flatten)]
    points: points::PointsOptions,
}

pub fn run(options: &Options) -> Result<(), Failure> {
    points::run("atlas", "points", &options.points, atlas::atlas, atlas::runs, cavities)
}

/// A line for each cavity: where it takes most energy.
fn cavities(folder: &Path) -> Result<String, Failure> {
    let file = folder.join("atlas.csv");
    let points = Table::read(&file).map_err(|error| Failure::of_file(&error, folder))?;
    let column = |name: &str| points.numbers(name).unwrap_or_else(|| vec![f64::NAN; points.rows.len()]);
    let columns = ["grain mass", "loss factor", "frequency", "acceleration", "effective mass"].map(column);
    let [mass, loss, frequency, acceleration, effective] = &columns;
    let mut best: BTreeMap<String, (usize, usize)> = BTreeMap::new();
    for (row, name) in points.texts("case").unwrap_or_default().into_iter().enumerate() {
        let (top, number) = best.entry(name).or_insert((row, 0));
        *number += 1;
        if loss[row] > loss[*top] {
            *top = row;
        }
    }
    let header = ["cavity", "grains g", "points", "largest loss factor", "at Hz", "and m/s2", "effective mass g"];
    let mut rows = vec![header.map(str::to_owned).to_vec()];
    for (name, (top, number)) in best {
        let values = [loss[top], frequency[top], acceleration[top], 1e3 * effective[top]].map(table::number);
        let first = [name, table::number(1e3 * mass[top]), number.to_string()];
        rows.push(first.into_iter().chain(values).collect());
    }
    Ok(table::aligned(&rows))
}
