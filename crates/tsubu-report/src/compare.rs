//! The report of one scene by several methods.

use tsubu_frame::{Summary, Table, csv::split_unit};

use crate::figure::{Axis, Bars, Figure, Series, Style};
use crate::moments;
use crate::page::{Block, Report, Tone};
use crate::source::{Source, card, cost_table, energy_blocks, method_name, shown, versions};
use crate::text::{duration, short};

/// What one method left in its folder.
struct Method {
    name: String,
    summary: Option<Summary>,
    history: Option<Table>,
}

pub(crate) fn build(source: &mut Source) -> Report {
    let methods = methods(source);
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
    report.section("What differs", table.iter().map(shown).collect());
    report.section("Motion", motion);
    report.section("Energy", energy);
    report.section("Grains", pictures);
    report.section("Cost", cost);
    source.scene_and_verdict(&mut report);
    report
}

fn methods(source: &mut Source) -> Vec<Method> {
    let mut names: Vec<String> = std::fs::read_dir(&source.dir)
        .into_iter()
        .flatten()
        .filter_map(Result::ok)
        .filter(|e| e.path().join("summary.json").exists() || e.path().join("history.csv").exists())
        .map(|e| e.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
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

fn headline(runs: &[(&str, &Summary)]) -> String {
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
        blocks.push(crate::source::folded("More over time", inside));
    }
    blocks
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |c| c.to_uppercase().chain(letters).collect())
}
