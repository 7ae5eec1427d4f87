//! The report of a design: the response before and after, what was tried, how the search went.

use tsubu_frame::{ResultValue, Summary, Table};

use crate::figure::{Axis, Figure, Series, Style};
use crate::page::{Block, Report, Tone, card, folded};
use crate::quantity::{quantity, spoken};
use crate::source::{Source, shown};
use crate::summary::{claims_and_results, ended, versions, wall_time_card};
use crate::text::short;

/// The candidates of `design.csv`, column by column.
struct Candidates {
    names: Vec<String>,
    standing: Vec<String>,
    front: Vec<String>,
    mass: Vec<f64>,
    rms: Vec<f64>,
    low: Vec<f64>,
    high: Vec<f64>,
    cheap: Vec<f64>,
    ratio: Vec<f64>,
    expected: [Vec<f64>; 3],
}

impl Candidates {
    fn read(table: &Table) -> Self {
        let column = |name: &str| table.numbers(name).unwrap_or_else(|| vec![f64::NAN; table.rows.len()]);
        let texts = |name: &str| table.texts(name).unwrap_or_else(|| vec![String::new(); table.rows.len()]);
        Self {
            names: texts("candidate"),
            standing: texts("standing"),
            front: texts("front"),
            mass: column("grain mass"),
            rms: column("rms displacement"),
            low: column("rms low"),
            high: column("rms high"),
            cheap: column("cheap rms"),
            ratio: column("peak frequency ratio"),
            expected: ["expected rms", "expected low", "expected high"].map(column),
        }
    }

    fn row(&self, standing: &str) -> Option<usize> {
        self.standing.iter().position(|one| one == standing)
    }
}

pub(crate) fn build(source: &mut Source) -> Report {
    let summary = source.summary_of_study();
    let table = source.table("design.csv").unwrap_or_default();
    let candidates = Candidates::read(&table);
    let mut report = Report {
        kind: "Design".into(),
        title: source.title(),
        headline: headline(&candidates),
        versions: versions(summary.as_ref()),
        ..Report::default()
    };
    for (standing, label) in [("best", "Best"), ("as written", "As written")] {
        let Some(row) = candidates.row(standing) else { continue };
        let (value, unit) = quantity(candidates.rms[row], "m");
        let interval = if candidates.low[row].is_finite() {
            format!("95 %: {} to {}", spoken(candidates.low[row], "m"), spoken(candidates.high[row], "m"))
        } else {
            "no interval".to_owned()
        };
        let name = if standing == "best" { format!("{}; ", candidates.names[row]) } else { String::new() };
        let note = format!(
            "{name}{interval}; {} of grains; peak at f/f₀ = {}",
            spoken(candidates.mass[row], "kg"),
            short(candidates.ratio[row])
        );
        report.cards.push(card(&format!("{label}, rms displacement"), value, &unit, note, Tone::Plain));
    }
    report.headline += summary.as_ref().map_or("", ended_by);
    if let Some(summary) = &summary {
        report.cards.push(wall_time_card(summary));
        report.verdict = Some(ended(summary));
    }
    let curves = before_and_after(source);
    let tried = tried(source, &candidates);
    let course = course(source, &candidates);
    let cheap = cheap(source, &candidates);
    let steps = if source.has("steps.csv") { source.table("steps.csv") } else { None };
    report.section("To be noted", source.note_blocks());
    report.section("Before and after", curves);
    report.section("One step from the best", steps.iter().map(shown).collect());
    report.section("What was tried", tried);
    report.section("How the search went", course);
    report.section("What the cheap method told", cheap);
    report.section("Candidates", vec![folded("All that were measured", vec![shown(&table)])]);
    if let Some(summary) = &summary {
        claims_and_results(&mut report, summary);
    }
    source.scene_and_verdict(&mut report);
    report
}

fn headline(candidates: &Candidates) -> String {
    let Some(best) = candidates.row("best") else { return "No candidate was confirmed in this folder.".into() };
    let times = candidates.row("as written").map_or(f64::NAN, |row| candidates.rms[row] / candidates.rms[best]);
    let compared = match times {
        times if times >= 2.0 => format!(", {} times less than the scene as it is written", short(times)),
        times if times > 1.0 => {
            format!(", {} % less than the scene as it is written", short(100.0 * (1.0 - 1.0 / times)))
        }
        times if times.is_finite() => ", no less than the scene as it is written".to_owned(),
        _ => String::new(),
    };
    format!("The best is {}: {} rms{compared}.", candidates.names[best], spoken(candidates.rms[best], "m"))
}

/// What stopped it, where the scene asks for more than a number of runs.
fn ended_by(summary: &Summary) -> &'static str {
    match summary.results.get("ended by until") {
        Some(ResultValue::Number(ended)) if *ended > 0.0 => {
            " It ended because the best is known as well as asked and nothing better is expected."
        }
        Some(_) => " It ended because its runs were spent.",
        None => "",
    }
}

fn before_and_after(source: &mut Source) -> Vec<Block> {
    if !source.has("curves.csv") {
        return Vec::new();
    }
    let table = source.table("curves.csv").unwrap_or_default();
    let column = |name: &str| table.numbers(name).unwrap_or_default();
    let (ratio, rms) = (column("frequency ratio"), column("rms displacement"));
    let mut curves: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
    for (row, name) in table.texts("candidate").unwrap_or_default().into_iter().enumerate() {
        if curves.last().is_none_or(|(last, _)| *last != name) {
            curves.push((name, Vec::new()));
        }
        let (Some(last), Some(x), Some(y)) = (curves.last_mut(), ratio.get(row), rms.get(row)) else { continue };
        last.1.push((*x, *y));
    }
    let x = Axis::new("frequency / natural frequency", "-");
    let mut figure = Figure::new("", x, Axis::new("rms displacement", "m"));
    for (name, points) in curves {
        figure = figure.with(Series::line(name, points).styled(Style::LineAndPoints));
    }
    let caption =
        "Response of the scene as it is written and of the best candidate, simulated in full with the first seed.";
    source.figure("before_and_after", &figure, caption).into_iter().collect()
}

fn tried(source: &mut Source, candidates: &Candidates) -> Vec<Block> {
    let points = |wanted: &[&str]| -> Vec<(f64, f64)> {
        let rows = (0..candidates.names.len()).filter(|row| wanted.contains(&candidates.standing[*row].as_str()));
        rows.map(|row| (candidates.mass[row], candidates.rms[row])).collect()
    };
    let mut front: Vec<(f64, f64)> = (0..candidates.names.len())
        .filter(|row| candidates.front[*row] == "yes")
        .map(|row| (candidates.mass[row], candidates.rms[row]))
        .collect();
    front.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut figure = Figure::new("", Axis::new("mass of the grains", "kg"), Axis::new("rms displacement", "m"));
    figure = figure.with(Series::line("front of mass and response", front));
    for (name, wanted) in [
        ("one seed", &["searched"][..]),
        ("confirmed", &["confirmed"]),
        ("beyond the stroke limit", &["beyond the stroke limit"]),
        ("best", &["best"]),
        ("as written", &["as written"]),
    ] {
        let points = points(wanted);
        if !points.is_empty() {
            figure = figure.with(Series::line(name, points).styled(Style::Points));
        }
    }
    let caption =
        "All candidates that were measured. On the front are those than which none is both lighter and better.";
    source.figure("tried", &figure, caption).into_iter().collect()
}

fn course(source: &mut Source, candidates: &Candidates) -> Vec<Block> {
    let rows = || (0..candidates.names.len()).filter(|row| candidates.standing[*row] != "as written");
    let place = |row: usize| row as f64 + 1.0;
    let measured = rows().map(|row| (place(row), candidates.rms[row])).collect();
    let [mean, low, high] = &candidates.expected;
    let known: Vec<usize> = rows().filter(|row| mean[*row].is_finite()).collect();
    let expected = known.iter().map(|row| (place(*row), mean[*row])).collect();
    let band = known.iter().map(|row| (low[*row], high[*row])).collect();
    let mut figure =
        Figure::new("", Axis::new("candidate, in the order of the search", "-"), Axis::new("rms displacement", "m"));
    figure = figure.with(Series::line("measured", measured).styled(Style::Points));
    if !known.is_empty() {
        figure = figure.with(Series::line("expected before", expected).with_band(band));
    }
    let caption = "What was measured of each candidate, and what the Gaussian process had expected of it before, with its 95 % band. \
                   Where nothing better was expected, neighbours of the lowest were measured, then what was farthest from all others.";
    source.figure("course", &figure, caption).into_iter().collect()
}

/// What a cheap method gave beside what the scene's own did.
fn cheap(source: &mut Source, candidates: &Candidates) -> Vec<Block> {
    let both: Vec<(f64, f64)> =
        candidates.cheap.iter().copied().zip(candidates.rms.iter().copied()).filter(|two| two.0.is_finite()).collect();
    if both.is_empty() {
        return Vec::new();
    }
    let ends = both.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), two| (low.min(two.0), high.max(two.0)));
    let figure = Figure::new(
        "",
        Axis::new("rms displacement by the cheap method", "m"),
        Axis::new("rms displacement by the scene's own", "m"),
    )
    .with(Series::line("equal", vec![(ends.0, ends.0), (ends.1, ends.1)]))
    .with(Series::line("candidates", both).styled(Style::Points));
    let caption = "Candidates that were measured both ways. What decides is how well the cheap method orders them, not whether it gives the same numbers.";
    source.figure("cheap", &figure, caption).into_iter().collect()
}
