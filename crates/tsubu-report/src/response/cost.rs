//! What a response took.

use std::fmt::Write as _;

use tsubu_frame::Summary;

use super::{Case, Curve};
use crate::page::{Block, Grid, Tone};
use crate::quantity::spoken;
use crate::summary::method_name;
use crate::text::{count, duration, short};

/// What each case took, and all of them side by side.
pub(super) fn blocks(cases: &[Case], curves: &[Curve], summary: &Summary) -> Vec<Block> {
    let mut grid = Grid::new(["case", "grains", "frequencies", "computing time [s]", "per frequency [s]"]);
    for case in cases.iter().filter(|c| c.wall.is_finite()) {
        let points = curves.iter().find(|c| c.name == case.name).map_or(0, |c| c.points.len());
        grid.push(
            Tone::Plain,
            [
                case.name.clone(),
                count(case.grains as u64),
                points.to_string(),
                short(case.wall),
                short(case.wall / points as f64),
            ],
        );
    }
    let spent: f64 = cases.iter().map(|c| c.wall).filter(|w| w.is_finite()).sum();
    let mut text = format!(
        "{} of computing on {} threads, done in {}.",
        duration(spent),
        summary.threads,
        duration(summary.wall_seconds)
    );
    if summary.time_step > 0.0 {
        let _ =
            write!(text, " The time step is {} ({}).", spoken(summary.time_step, "s"), method_name(&summary.method));
    }
    let mut blocks = Vec::new();
    if !grid.rows.is_empty() {
        blocks.push(Block::Table(grid));
    }
    blocks.push(Block::Text(text));
    blocks
}
