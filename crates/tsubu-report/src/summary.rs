//! What a summary gives the page: cards, results, the books, what it cost.

use tsubu_frame::summary::mean_beside;
use tsubu_frame::{ResultValue, Status, Summary, csv::split_unit, unit::for_people};

use crate::claims::{claims_of, range};
use crate::figure::{Axis, Bars, Figure};
use crate::page::{Block, Card, Grid, Report, Tone, card, folded};
use crate::quantity::{quantity, spoken};
use crate::source::Source;
use crate::text::{count, duration, short};

/// Lists up to this length are told in numbers.
const FEW: usize = 6;

/// How a study of many runs ended, for the head of its page.
pub(crate) fn ended(summary: &Summary) -> (Tone, String) {
    let failed = summary.claims.iter().filter(|claim| !claim.pass).count();
    match (summary.status, failed) {
        (Status::Finished, 0) => (Tone::Good, "finished".into()),
        (Status::Finished, n) => (Tone::Bad, format!("{n} claims failed")),
        (status, _) => (Tone::Warning, status.word().into()),
    }
}

/// Cards that every summary gives.
pub(crate) fn summary_cards(summary: &Summary) -> Vec<Card> {
    vec![
        card(
            "Grains",
            count(summary.particles),
            "",
            format!("{}, {}-D", method_name(&summary.method), summary.dimension),
            Tone::Plain,
        ),
        card(
            "Simulated",
            short(summary.simulated_seconds),
            "s",
            format!("{} steps of {}", count(summary.steps), spoken(summary.time_step, "s")),
            Tone::Plain,
        ),
        wall_time_card(summary),
        residual_card(summary),
    ]
}

/// How long the computer worked.
pub(crate) fn wall_time_card(summary: &Summary) -> Card {
    // A study counts no steps of its own.
    let note = if summary.particle_steps_per_second > 0.0 {
        format!("{} grain-steps/s", short(summary.particle_steps_per_second))
    } else {
        format!("on {} threads", summary.threads)
    };
    card("Computed in", duration(summary.wall_seconds), "", note, Tone::Plain)
}

/// What is left over in the books.
pub(crate) fn residual_card(summary: &Summary) -> Card {
    let residual = summary.energy.residual_relative;
    let tone = if residual.abs() < 1e-3 { Tone::Good } else { Tone::Warning };
    card("Energy residual", short(residual), "", "of the energy turned over".into(), tone)
}

/// Name and SI unit of a result; a name may carry its unit itself.
fn named<'a>(summary: &'a Summary, result: &'a str) -> (&'a str, &'a str) {
    match split_unit(result) {
        (name, Some(unit)) => (name, unit),
        (name, None) => (name, summary.unit(result)),
    }
}

/// Results that are single numbers, as cards, in the order in which the scene asks for them. The mean of a watch and its
/// value at the end share a card.
pub(crate) fn result_cards(summary: &Summary, most: usize) -> Vec<Card> {
    let mut cards = Vec::new();
    for (result, value) in summary.results_in_order() {
        // The energy residual is no result to be proud of; the energy has its own card. What came to no number is none.
        let ResultValue::Number(x) = value else { continue };
        if result.contains("residual") || !x.is_finite() {
            continue;
        }
        let claim = summary.claims.iter().find(|claim| claim.name == result);
        if claim.is_none() && mean_beside(result).is_some_and(|mean| summary.results.get(mean).is_some()) {
            continue;
        }
        let (name, unit) = named(summary, result);
        let (value, shown) = quantity(*x, unit);
        let (tone, note) = match (claim, summary.results.get(&format!("{result} final"))) {
            (Some(claim), _) => {
                let tone = if claim.pass { Tone::Good } else { Tone::Bad };
                (tone, format!("claimed: {}", range(claim, unit)))
            }
            (None, Some(ResultValue::Number(last))) => {
                (Tone::Plain, format!("mean; {} at the end", spoken(*last, unit)))
            }
            _ => (Tone::Plain, String::new()),
        };
        cards.push(card(name, value, &shown, note, tone));
    }
    cards.truncate(most);
    cards
}

/// All results as a table. A list is a profile, which a figure shows.
pub(crate) fn results_table(summary: &Summary) -> Option<Block> {
    if summary.results.is_empty() {
        return None;
    }
    let mut grid = Grid::new(["result", "value", "unit"]);
    for (result, value) in summary.results_in_order() {
        let (name, unit) = named(summary, result);
        let (factor, unit) = for_people(unit);
        let value = match value {
            ResultValue::Number(x) => short(x * factor),
            ResultValue::List(list) if list.len() <= FEW => {
                list.iter().map(|x| short(x * factor)).collect::<Vec<_>>().join(", ")
            }
            ResultValue::List(list) => format!("{} values, see figure", list.len()),
        };
        let unit = if unit == "-" { String::new() } else { crate::text::unit(unit) };
        grid.push(Tone::Plain, [name, value.as_str(), unit.as_str()]);
    }
    Some(Block::Table(grid))
}

/// Claims, and all results, folded away: a study's page has shown those that matter, in better order.
pub(crate) fn claims_and_results(report: &mut Report, summary: &Summary) {
    report.section("Claims", claims_of(summary).into_iter().collect());
    let results = results_table(summary).map(|table| folded("All results", vec![table]));
    report.section("Results", results.into_iter().collect());
}

/// What the run cost.
pub(crate) fn cost_table(runs: &[(&str, &Summary)]) -> Block {
    let mut grid = Grid::new([
        "method",
        "grains",
        "steps",
        "time step [s]",
        "threads",
        "wall time [s]",
        "grain-steps [1/s]",
        "wall / simulated",
    ]);
    for (name, s) in runs {
        grid.push(
            Tone::Plain,
            [
                (*name).to_owned(),
                count(s.particles),
                count(s.steps),
                short(s.time_step),
                s.threads.to_string(),
                short(s.wall_seconds),
                short(s.particle_steps_per_second),
                short(s.wall_seconds / s.simulated_seconds),
            ],
        );
    }
    Block::Table(grid)
}

/// Energy by cause: bars for the eye, the table for the books. Several runs stand side by side.
pub(crate) fn energy_blocks(source: &mut Source, runs: &[(&str, &Summary)]) -> Vec<Block> {
    let mut names: Vec<&str> = Vec::new();
    for (_, summary) in runs {
        for (name, _) in summary.energy.terms.iter() {
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    if names.is_empty() {
        return Vec::new();
    }
    let value = |s: &Summary, name: &str| s.energy.terms.get(name).map_or(f64::NAN, |j| j.0);
    // A bar too short to be seen stands in the table only.
    let largest = names.iter().flat_map(|n| runs.iter().map(|(_, s)| value(s, n).abs())).fold(0.0, f64::max);
    let moved = |name: &&str| runs.iter().any(|(_, s)| value(s, name).abs() > 1e-3 * largest);
    let drawn: Vec<&str> = names.iter().copied().filter(moved).collect();
    let parts = runs.iter().map(|(run, s)| ((*run).to_owned(), drawn.iter().map(|n| value(s, n)).collect())).collect();
    let bars =
        Bars { categories: drawn.iter().map(|n| (*n).to_owned()).collect(), parts, stacked: false, horizontal: true };
    let mut figure = Figure::of_bars("", Axis::new("energy at the end", "J"), bars);
    figure.height = (90 + 30 * drawn.len() as u32 * runs.len().max(1) as u32).clamp(180, 700);
    let mut blocks = Vec::new();
    blocks.extend(source.figure("energy_by_cause", &figure, "Where the energy went, by cause."));
    let mut grid = Grid::new(std::iter::once("cause".to_owned()).chain(
        runs.iter().map(|(run, _)| if runs.len() == 1 { "energy [J]".to_owned() } else { format!("{run} [J]") }),
    ));
    for name in &names {
        let cells = runs.iter().map(|(_, s)| short(value(s, name)));
        grid.push(Tone::Plain, std::iter::once((*name).to_owned()).chain(cells));
    }
    let residuals = runs.iter().map(|(_, s)| short(s.energy.residual_relative));
    grid.push(Tone::Plain, std::iter::once("residual, relative".to_owned()).chain(residuals));
    blocks.push(folded("Energy terms in numbers", vec![Block::Table(grid)]));
    blocks
}

/// Versions for the foot of the page.
pub(crate) fn versions(summary: Option<&Summary>) -> Vec<(String, String)> {
    let mut versions = Vec::new();
    if let Some(s) = summary {
        versions.push(("tsubu".to_owned(), s.tsubu_version.clone()));
        if !s.state_hash.is_empty() {
            versions.push(("state hash".to_owned(), s.state_hash.clone()));
        }
    }
    versions.push(("report".to_owned(), env!("CARGO_PKG_VERSION").to_owned()));
    versions
}

/// A method as readers call it.
pub(crate) fn method_name(method: &str) -> &str {
    match method {
        "dem" => "DEM",
        "lattice" => "lattice automaton",
        "cl-ca" => "CL-CA",
        other => other,
    }
}
