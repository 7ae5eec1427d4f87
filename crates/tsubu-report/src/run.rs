//! The report of one run.

use std::fmt::Write as _;

use tsubu_frame::{ResultValue, Status, Summary, Table, csv::split_unit};

use crate::claims::claims_of;
use crate::figure::{Axis, Figure, Series};
use crate::moments;
use crate::moving;
use crate::page::{Block, Report, Tone, card, folded};
use crate::quantity::{quantity, spoken};
use crate::source::Source;
use crate::summary::{cost_table, energy_blocks, method_name, result_cards, results_table, summary_cards, versions};
use crate::text::{count, duration, short};
use crate::watch::Watches;

pub(crate) fn build(source: &mut Source) -> Report {
    let summary = source.summary();
    let history = source.table("history.csv");
    if history.is_none() && !source.has("history.csv") {
        source.notes.push("There is no history.csv, so nothing is drawn over time.".into());
    }
    if let Some(table) = &history {
        source.notes.extend(cut(table, summary.as_ref()));
    }
    let mut report = Report {
        kind: "Simulation run".into(),
        title: source.title(),
        headline: headline(summary.as_ref(), history.as_ref()),
        verdict: Some(verdict(summary.as_ref())),
        versions: versions(summary.as_ref()),
        ..Report::default()
    };
    if let Some(summary) = &summary {
        report.cards = summary_cards(summary);
        report.cards.extend(host_card(history.as_ref()));
        report.cards.extend(result_cards(summary, 6));
    }
    let watches = Watches::read(source);
    let motion = history.as_ref().map(|h| motion_blocks(source, h, &watches)).unwrap_or_default();
    let watched = watches.blocks(source, history.as_ref());
    let mut pictures: Vec<Block> = moving::view(source, history.as_ref()).into_iter().collect();
    pictures.extend(moments::blocks(source, history.as_ref(), ""));
    let mut energy = history.as_ref().map(|h| energy_over_time(source, h)).unwrap_or_default();
    if let Some(summary) = &summary {
        energy.extend(energy_blocks(source, &[(summary.method.as_str(), summary)]));
    }
    report.section("To be noted", source.note_blocks());
    // What happened is seen before it is drawn over time.
    report.section("Grains", pictures);
    report.section("Motion", motion);
    report.section("Watches", watched);
    report.section("Energy", energy);
    if let Some(summary) = &summary {
        report.section("Claims", claims_of(summary).into_iter().collect());
        report.section("Results", results_table(summary).into_iter().collect());
        let mut cost = vec![cost_table(&[(method_name(&summary.method), summary)])];
        cost.extend(machine(source));
        report.section("Cost", cost);
    }
    source.scene_and_verdict(&mut report);
    report
}

/// What `tsubu bench` has found out about the machine.
fn machine(source: &mut Source) -> Option<Block> {
    if !source.has("bench.json") {
        return None;
    }
    let read = tsubu_frame::summary::read_json::<serde_json::Value>(&source.dir.join("bench.json"));
    let bench = source.told(read)?;
    let rows: Vec<String> = bench["rows"]
        .as_array()?
        .iter()
        .filter_map(|row| {
            let (work, threads) = (row["work"].as_str()?, row["threads"].as_u64()?);
            let speed = row["particle_steps_per_second"].as_f64()?;
            Some(format!("{work} on {threads} thread{} {:.2e}", if threads == 1 { "" } else { "s" }, speed))
        })
        .collect();
    let processor = bench["processor"].as_str().unwrap_or("this machine");
    Some(Block::Text(format!("The machine: {processor}. `tsubu bench` there, in grain-steps/s: {}.", rows.join(", "))))
}

fn verdict(summary: Option<&Summary>) -> (Tone, String) {
    let Some(summary) = summary else { return (Tone::Warning, "unfinished".into()) };
    match summary.status {
        Status::Finished if summary.claims.iter().any(|c| !c.pass) => (Tone::Bad, "a claim failed".into()),
        Status::Finished => (Tone::Good, "finished".into()),
        Status::Interrupted => (Tone::Warning, "interrupted".into()),
        Status::Failed => (Tone::Bad, "failed".into()),
    }
}

/// What tells that rows of the history are missing, or that it is another table.
fn cut(history: &Table, summary: Option<&Summary>) -> Option<String> {
    let Some(times) =
        history.numbers("time").filter(|_| history.header.first().is_some_and(|first| first == "time [s]"))
    else {
        return Some("history.csv does not begin with a column `time [s]`: it is not the history of a run.".into());
    };
    let end = summary?.simulated_seconds;
    let last = times.last().copied()?;
    let interval = times.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    (last + 1.5 * interval < end)
        .then(|| format!("history.csv ends at {last} s and the run at {end} s: rows at its end are missing."))
}

fn headline(summary: Option<&Summary>, history: Option<&Table>) -> String {
    let Some(s) = summary else { return "This run has left no summary; what there is, is shown.".into() };
    let did = match s.status {
        Status::Finished => "simulated",
        Status::Interrupted => "simulated before the interruption",
        Status::Failed => "simulated before it failed",
    };
    let mut text = format!(
        "{} by {}: {} s {did}, computed in {}.",
        grains(s),
        method_name(&s.method),
        short(s.simulated_seconds),
        duration(s.wall_seconds)
    );
    if let Some((name, peak)) = history.and_then(host_peak) {
        let _ = write!(text, " The {name} reaches {}.", spoken(peak, "m"));
    }
    let residual = s.energy.residual_relative;
    if residual.is_finite() && !s.energy.terms.is_empty() {
        let _ = write!(text, " The energy residual is {}.", short(residual.abs()));
    }
    text
}

/// How many grains there are at the end, and how many have gone.
fn grains(s: &Summary) -> String {
    let gone = s.results.iter().filter(|(name, _)| name.starts_with("removal ") && name.ends_with(" grains"));
    let gone: f64 = gone.map(|(_, value)| if let ResultValue::Number(gone) = value { *gone } else { 0.0 }).sum();
    match (s.particles, gone as u64) {
        (left, 0) => format!("{} grains", count(left)),
        (0, gone) => format!("{} grains, which all have left,", count(gone)),
        (left, gone) => format!("{} grains, after {} have left,", count(left), count(gone)),
    }
}

fn host_peak(history: &Table) -> Option<(String, f64)> {
    let column = *moments::host_columns(history).first()?;
    let values = history.rows.iter().filter_map(|r| r[column].number()).filter(|v| v.is_finite());
    let peak = values.fold(None, |a: Option<f64>, v| Some(a.map_or(v.abs(), |a| a.max(v.abs()))))?;
    Some((split_unit(&history.header[column]).0.to_owned(), peak))
}

fn host_card(history: Option<&Table>) -> Option<crate::page::Card> {
    let (name, peak) = host_peak(history?)?;
    let (value, unit) = quantity(peak, "m");
    Some(card("Largest host displacement", value, &unit, name, Tone::Plain))
}

fn column(history: &Table, i: usize) -> Vec<(f64, f64)> {
    let value = |row: &[tsubu_frame::Cell], i: usize| row[i].number().unwrap_or(f64::NAN);
    history.rows.iter().map(|r| (value(r, 0), value(r, i))).collect()
}

/// Columns that share a unit, as one figure.
fn over_time(history: &Table, columns: &[usize], label: &str) -> Figure {
    let unit = columns.first().and_then(|i| split_unit(&history.header[*i]).1).unwrap_or("-");
    let mut figure = Figure::new("", Axis::new("time", "s"), Axis::new(label, unit));
    for i in columns {
        let name = if columns.len() == 1 { "" } else { split_unit(&history.header[*i]).0 };
        figure = figure.with(Series::line(name, column(history, *i)));
    }
    figure.height = 280;
    figure
}

fn motion_blocks(source: &mut Source, history: &Table, watches: &Watches) -> Vec<Block> {
    let mut blocks = Vec::new();
    let hosts = moments::host_columns(history);
    if !hosts.is_empty() {
        let label = split_unit(&history.header[hosts[0]]).0.to_owned();
        let label = if hosts.len() == 1 { label } else { "host displacement".into() };
        let figure = over_time(history, &hosts, &label);
        blocks.extend(source.figure("host_displacement", &figure, "Displacement of the host over the whole run."));
        if let Some(period) = moments::last_period(history) {
            let end = history.rows.last().and_then(|r| r[0].number()).unwrap_or(f64::NAN);
            let from = end - 6.0 * period.length;
            if from > history.rows[0][0].number().unwrap_or(f64::NAN) + period.length {
                let mut close = figure;
                for series in &mut close.series {
                    series.points.retain(|p| p.0 >= from);
                }
                blocks.extend(source.figure("host_displacement_end", &close, "The last six periods of it."));
            }
        }
    }
    let others: Vec<usize> = (1..history.header.len())
        .filter(|i| !hosts.contains(i) && split_unit(&history.header[*i]).1 != Some("J"))
        .filter(|i| !watches.own(&history.header[*i]))
        .collect();
    let mut inside = Vec::new();
    for i in others.into_iter().take(12) {
        let name = split_unit(&history.header[i]).0.to_owned();
        let file = format!("history_{}", name.replace(|c: char| !c.is_ascii_alphanumeric(), "_"));
        let drawn = source.figure(&file, &over_time(history, &[i], &name), "");
        // Without a host the rest is what there is to see, short of the energy residual.
        if hosts.is_empty() && !name.contains("residual") { blocks.extend(drawn) } else { inside.extend(drawn) }
    }
    if !inside.is_empty() {
        blocks.push(folded("More over time", inside));
    }
    blocks
}

fn energy_over_time(source: &mut Source, history: &Table) -> Vec<Block> {
    let energies = (1..history.header.len()).filter(|i| {
        let (name, unit) = split_unit(&history.header[*i]);
        unit == Some("J") && !name.contains("residual")
    });
    let moves = |i: &usize| history.rows.iter().any(|r| r[*i].number().is_some_and(|x| x != 0.0));
    // What is held now is called an energy; what was turned over since the start goes by its cause.
    let is_held = |i: &usize| split_unit(&history.header[*i]).0.ends_with("energy");
    let (stored, turned): (Vec<usize>, Vec<usize>) = energies.filter(moves).partition(is_held);
    let mut blocks = Vec::new();
    if !stored.is_empty() {
        let figure = over_time(history, &stored, "energy");
        blocks.extend(source.figure("energy_stored", &figure, "Energy stored, over time."));
    }
    if !turned.is_empty() {
        let figure = over_time(history, &turned, "energy");
        blocks.extend(source.figure("energy_turned_over", &figure, "Energy turned over since the start."));
    }
    blocks
}
