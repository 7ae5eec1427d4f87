//! The report of one scene by several methods.

use tsubu_frame::{Cell, Status, Summary, Table, csv::split_unit, read_frame, snapshots, summary::read_json};

use crate::balls::{Balls, ColourBy, Look};
use crate::figure::{Axis, Bars, Figure, Series, Style};
use crate::moments;
use crate::page::{Block, Grid, Report, Tone, card, folded};
use crate::source::{Source, shown};
use crate::strip::{Panel, strip};
use crate::summary::{cost_table, energy_blocks, method_name, versions};
use crate::text::{duration, short};

/// What stands in `compare.json`.
#[derive(Debug, Default, serde::Deserialize)]
#[serde(default)]
struct Compared {
    /// Who ran, in order.
    methods: Vec<String>,
    /// Who cannot run the scene.
    refused: Vec<Refused>,
}

/// A method that cannot run the scene.
#[derive(Debug, serde::Deserialize)]
pub(crate) struct Refused {
    pub method: String,
    /// Keys, and why not.
    pub because: Vec<(String, String)>,
}

/// What one method left in its folder.
struct Method {
    name: String,
    summary: Option<Summary>,
    history: Option<Table>,
}

pub(crate) fn build(source: &mut Source) -> Report {
    let read =
        if source.has("compare.json") { read_json(&source.dir.join("compare.json")) } else { Ok(Compared::default()) };
    let compared = source.told(read).unwrap_or_default();
    let methods = methods(source, &compared);
    let table = source.table("compare.csv");
    if table.is_none() {
        source.notes.push("There is no compare.csv, so the methods are not set against each other in numbers.".into());
    }
    let runs: Vec<(&str, &Summary)> =
        methods.iter().filter_map(|m| Some((method_name(&m.name), m.summary.as_ref()?))).collect();
    let mut report = Report {
        kind: "Comparison of methods".into(),
        title: source.title(),
        headline: headline(&runs),
        versions: versions(runs.first().map(|r| r.1)),
        ..Report::default()
    };
    for (name, s) in &runs {
        let note = format!("{} s simulated, step {} s", short(s.simulated_seconds), short(s.time_step));
        report.cards.push(card(&format!("{name}, wall time"), duration(s.wall_seconds), "", note, Tone::Plain));
    }
    let motion = motion_blocks(source, &methods);
    let energy = energy_blocks(source, &runs);
    let mut pictures = Vec::new();
    for method in &methods {
        let mut inside = source.inside(&method.name);
        let drawn = moments::blocks(&mut inside, method.history.as_ref(), &format!("{}_", method.name));
        if !drawn.is_empty() {
            pictures.push(Block::Text(format!("By {}:", method_name(&method.name))));
            pictures.extend(drawn);
        }
        source.files.append(&mut inside.files);
        source.notes.extend(inside.notes.into_iter().map(|n| format!("{}: {n}", method.name)));
    }
    let mut cost = Vec::new();
    if runs.len() > 1 {
        let bars = Bars {
            categories: runs.iter().map(|r| r.0.to_owned()).collect(),
            parts: vec![(
                "wall time per simulated second".into(),
                runs.iter().map(|r| r.1.wall_seconds / r.1.simulated_seconds).collect(),
            )],
            stacked: false,
            horizontal: true,
        };
        let mut figure = Figure::of_bars("", Axis::new("wall time per simulated second", "-"), bars);
        figure.height = 90 + 40 * runs.len() as u32;
        cost.extend(source.figure("cost", &figure, "What each method cost."));
    }
    if !runs.is_empty() {
        cost.push(cost_table(&runs));
    }
    report.section("To be noted", source.note_blocks());
    let mut differs: Vec<Block> = last_pictures(source, &methods).into_iter().collect();
    differs.extend(table.as_ref().map(|table| shown(&told(table))));
    report.section("What differs", differs);
    if !compared.refused.is_empty() {
        report.section("Who cannot run it", vec![refusals(&compared.refused)]);
    }
    report.section("Motion", motion);
    report.section("Energy", energy);
    report.section("Grains", pictures);
    report.section("Cost", cost);
    source.scene_and_verdict(&mut report);
    report
}

fn methods(source: &mut Source, compared: &Compared) -> Vec<Method> {
    let mut names = compared.methods.clone();
    if names.is_empty() {
        let entries = std::fs::read_dir(&source.dir).into_iter().flatten().filter_map(Result::ok);
        let there = entries.filter(|e| ["summary.json", "history.csv"].iter().any(|name| e.path().join(name).exists()));
        names = there.map(|e| e.file_name().to_string_lossy().into_owned()).collect();
        names.sort();
    }
    names
        .into_iter()
        .map(|name| {
            let mut inside = source.inside(&name);
            let method = Method { summary: inside.summary(), history: inside.table("history.csv"), name };
            source.notes.extend(inside.notes.into_iter().map(|n| format!("{}: {n}", method.name)));
            method
        })
        .collect()
}

fn refusals(refused: &[Refused]) -> Block {
    let mut grid = Grid::new(["method", "key", "why"]);
    for Refused { method, because } in refused {
        for (key, why) in because {
            grid.push(Tone::Plain, [method_name(method), key, why]);
        }
    }
    Block::Table(grid)
}

/// The rows in which any method has something to say: most of the books' causes are not at work in a scene.
fn told(table: &Table) -> Table {
    let says = |cell: &Cell| cell.number().is_some_and(|x| x.is_finite() && x != 0.0);
    let rows = table.rows.iter().filter(|row| row.iter().skip(1).any(says)).cloned().collect();
    Table { header: table.header.clone(), rows }
}

/// The last moment by each method side by side, grains coloured by where they began: which of them have moved, and how far.
fn last_pictures(source: &mut Source, methods: &[Method]) -> Option<Block> {
    let mut panels = Vec::new();
    for method in methods {
        let read = snapshots(&source.dir.join(&method.name));
        let found = source.told(read)?;
        let (Some(first), Some(last)) = (found.first(), found.last()) else { continue };
        let frames = read_frame(&first.path).and_then(|first| Ok((first, read_frame(&last.path)?)));
        let (first, last) = source.told(frames)?;
        let began = ColourBy::Given("height at the start".into(), "m".into(), moments::heights(&first, &last));
        let balls = Balls::of(&last, &Look { colour: began, ..Look::default() });
        let label = format!("{}, {}", method_name(&method.name), crate::legend::time_label(last.time, last.time));
        panels.push(Panel { balls, label, arrow: None });
    }
    // In space one colours by depth, in pictures of their own.
    if panels.len() < 2 || panels.iter().any(|panel| panel.balls.space) {
        return None;
    }
    let look = Look { window: most(&panels), ..Look::default() };
    let columns = if look.window.is_some_and(|w| w[2] - w[0] > 0.6 * (w[3] - w[1])) { 3 } else { 6 };
    let caption =
        "The last moment by each method, without the few grains that are far out; those that came in later are grey.";
    Some(source.drawing("methods", strip(&panels, &look, columns), caption))
}

/// A window on nearly all grains of all panels: endless walls and the one grain that rolled away would leave them no room.
fn most(panels: &[Panel]) -> Option<[f64; 4]> {
    let ends = |axis: usize, share: f64| {
        let centres = panels.iter().flat_map(|panel| &panel.balls.centres);
        let mut places: Vec<f64> = centres.map(|centre| centre[axis]).filter(|x| x.is_finite()).collect();
        places.sort_by(f64::total_cmp);
        let last = places.len().checked_sub(1)?;
        let at = |share: f64| places[(share * last as f64).round() as usize];
        Some([at(1.0 - share), at(share)])
    };
    let ([left, right], [bottom, top]) = (ends(0, 0.97)?, ends(1, 0.995)?);
    let margin = 0.06 * (right - left).max(top - bottom);
    (margin > 0.0).then_some([left - margin, bottom - margin, right + margin, top + margin])
}

fn headline(runs: &[(&str, &Summary)]) -> String {
    if let Some((name, cut)) = runs.iter().find(|(_, summary)| summary.status != Status::Finished) {
        return format!("{name} did not come to its end ({}): what is told of it is of a part.", cut.status.word());
    }
    let pace = |s: &Summary| s.wall_seconds / s.simulated_seconds;
    let by_pace = |a: &&(&str, &Summary), b: &&(&str, &Summary)| pace(a.1).total_cmp(&pace(b.1));
    match (runs.iter().min_by(by_pace), runs.iter().max_by(by_pace)) {
        (Some(fast), Some(slow)) if fast.0 != slow.0 => format!(
            "The same scene by {} methods: {} takes {} for what takes {} {}, {} times as long.",
            runs.len(),
            fast.0,
            duration(fast.1.wall_seconds),
            slow.0,
            duration(slow.1.wall_seconds),
            short(pace(slow.1) / pace(fast.1))
        ),
        (Some(only), _) => format!("Only {} left a summary.", only.0),
        _ => "No method left a summary.".into(),
    }
}

/// Every column that at least two methods wrote, one figure each; host displacements first, the rest folded.
fn motion_blocks(source: &mut Source, methods: &[Method]) -> Vec<Block> {
    let histories: Vec<(&str, &Table)> =
        methods.iter().filter_map(|m| Some((method_name(&m.name), m.history.as_ref()?))).collect();
    let Some((_, first)) = histories.first() else { return Vec::new() };
    let mut blocks = Vec::new();
    let mut inside = Vec::new();
    for header in first.header.iter().skip(1).take(16) {
        let (name, unit) = split_unit(header);
        let mut figure = Figure::new("", Axis::new("time", "s"), Axis::new(name, unit.unwrap_or("-")));
        for (i, (method, history)) in histories.iter().enumerate() {
            let (Some(time), Some(values)) = (history.numbers("time"), history.numbers(header)) else { continue };
            let style = if i == 0 { Style::Line } else { Style::Dashed };
            let points = time.into_iter().zip(values).collect();
            figure = figure.with(Series { colour: Some(i), ..Series::line(*method, points).styled(style) });
        }
        let file = format!("compare_{}", name.replace(|c: char| !c.is_ascii_alphanumeric(), "_"));
        let caption = format!("{} by each method.", capital(name));
        let drawn = source.figure(&file, &figure, &caption);
        if name.contains("host") { blocks.extend(drawn) } else { inside.extend(drawn) }
    }
    if blocks.is_empty() {
        return inside;
    }
    if !inside.is_empty() {
        blocks.push(folded("More over time", inside));
    }
    blocks
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |c| c.to_uppercase().chain(letters).collect())
}
