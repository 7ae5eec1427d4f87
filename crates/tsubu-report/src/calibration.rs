//! The report of a calibration: what is known of each key, what is not told apart, and what fresh runs gave.

use tsubu_frame::Table;
use tsubu_frame::csv::split_unit;

use crate::figure::{Axis, Figure, Mark, Series, Style};
use crate::page::{Block, Grid, Report, Tone, card, folded};
use crate::quantity::spoken;
use crate::source::{Source, shown};
use crate::summary::{claims_and_results, ended, versions, wall_time_card};
use crate::text::short;

/// Bars of a histogram.
const BINS: usize = 40;
/// Pairs of keys that are drawn, those most correlated first.
const PAIRS: usize = 3;

pub(crate) fn build(source: &mut Source) -> Report {
    let summary = source.summary_of_study();
    let [parameters, posterior, measured, correlations] =
        ["parameters.csv", "posterior.csv", "measured.csv", "correlations.csv"]
            .map(|name| source.table(name).unwrap_or_default());
    let keys = Keys::read(&parameters);
    let mut report = Report {
        kind: "Calibration".into(),
        title: source.title(),
        headline: keys.headline(),
        versions: versions(summary.as_ref()),
        ..Report::default()
    };
    for row in 0..keys.names.len() {
        let note = format!(
            "95 %: {} to {}; was {} to {}",
            short(keys.low[row]),
            short(keys.high[row]),
            short(keys.from[row]),
            short(keys.to[row])
        );
        report.cards.push(card(&keys.names[row], short(keys.mean[row]), &keys.units[row], note, Tone::Plain));
    }
    if let Some(summary) = &summary {
        report.cards.push(wall_time_card(summary));
        report.verdict = Some(ended(summary));
    }
    let densities = densities(source, &keys, &posterior);
    let scattered = scattered(source, &posterior, &correlations);
    let compared = [curve(source), compared(&measured)].concat();
    let runs = source.table("runs.csv");
    report.section("To be noted", source.note_blocks());
    report.section("What was measured, and what fresh runs gave", compared);
    report.section("What is known of each key", densities);
    report.section("What is told apart", scattered);
    report.section("Runs", runs.iter().map(|runs| folded("All runs", vec![shown(runs)])).collect());
    if let Some(summary) = &summary {
        claims_and_results(&mut report, summary);
    }
    source.scene_and_verdict(&mut report);
    report
}

/// The rows of `parameters.csv`.
struct Keys {
    names: Vec<String>,
    units: Vec<String>,
    mean: Vec<f64>,
    deviation: Vec<f64>,
    low: Vec<f64>,
    high: Vec<f64>,
    from: Vec<f64>,
    to: Vec<f64>,
}

impl Keys {
    fn read(table: &Table) -> Self {
        let column = |name: &str| table.numbers(name).unwrap_or_else(|| vec![f64::NAN; table.rows.len()]);
        let texts = |name: &str| table.texts(name).unwrap_or_else(|| vec![String::new(); table.rows.len()]);
        let units = texts("unit").into_iter().map(|unit| if unit == "-" { String::new() } else { unit }).collect();
        Self {
            names: texts("key"),
            units,
            mean: column("mean"),
            deviation: column("deviation"),
            low: column("low"),
            high: column("high"),
            from: column("range low"),
            to: column("range high"),
        }
    }

    fn headline(&self) -> String {
        let one = |row: usize| {
            let (mean, deviation) = (short(self.mean[row]), short(self.deviation[row]));
            format!("{} is {mean} ± {deviation} {}", self.names[row], self.units[row]).trim_end().to_owned()
        };
        if self.names.is_empty() {
            return "This calibration has not come to its end.".into();
        }
        format!("{}.", (0..self.names.len()).map(one).collect::<Vec<_>>().join(", "))
    }
}

/// How many samples lie where, key by key, beside the range before anything was measured.
fn densities(source: &mut Source, keys: &Keys, posterior: &Table) -> Vec<Block> {
    let mut blocks = Vec::new();
    for (row, name) in keys.names.iter().enumerate() {
        let Some(values) = posterior.numbers(name).filter(|values| !values.is_empty()) else { continue };
        let [least, most] = [
            values.iter().copied().fold(f64::INFINITY, f64::min),
            values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        ];
        let width = (most - least) / BINS as f64;
        if width.is_nan() || width <= 0.0 {
            continue;
        }
        let mut counts = vec![0.0; BINS];
        for value in &values {
            counts[(((value - least) / width) as usize).min(BINS - 1)] += 1.0 / (values.len() as f64 * width);
        }
        let points =
            counts.iter().enumerate().map(|(bin, density)| (least + (bin as f64 + 0.5) * width, *density)).collect();
        let unit = if keys.units[row].is_empty() { "-" } else { &keys.units[row] };
        let mut figure = Figure::new("", Axis::new(name.clone(), unit), Axis::new("probability density", "-"));
        figure = figure.with(Series::line(name.clone(), points));
        for (at, label) in [(keys.low[row], "2.5 %"), (keys.mean[row], "mean"), (keys.high[row], "97.5 %")] {
            figure = figure.marked(Mark::vertical(at, label));
        }
        let caption = format!(
            "Samples of {name}. Before, all of {} to {} was equally likely.",
            short(keys.from[row]),
            short(keys.to[row])
        );
        blocks.extend(source.figure(&format!("density_{row}"), &figure, &caption));
    }
    blocks
}

/// Samples of the pairs that are correlated most.
fn scattered(source: &mut Source, posterior: &Table, correlations: &Table) -> Vec<Block> {
    let texts = |name: &str| correlations.texts(name).unwrap_or_default();
    let found = correlations.numbers("correlation").unwrap_or_default();
    let mut pairs: Vec<(String, String, f64)> =
        texts("key").into_iter().zip(texts("other key")).zip(found).map(|((a, b), r)| (a, b, r)).collect();
    pairs.sort_by(|a, b| b.2.abs().total_cmp(&a.2.abs()));
    let mut blocks = Vec::new();
    for (index, (a, b, correlation)) in pairs.iter().take(PAIRS).enumerate() {
        let (Some(x), Some(y)) = (posterior.numbers(a), posterior.numbers(b)) else { continue };
        let axis =
            |name: &str| Axis::from_header(posterior.index(name).map_or(name, |column| &posterior.header[column]));
        let points = x.into_iter().zip(y).collect();
        let figure = Figure::new("", axis(a), axis(b)).with(Series::line("samples", points).styled(Style::Points));
        let caption = format!(
            "Samples of {a} and {b}: values that fit what was measured as well as each other. Their correlation is {}.",
            short(*correlation)
        );
        blocks.extend(source.figure(&format!("pair_{index}"), &figure, &caption));
    }
    if pairs.len() > 1 {
        blocks.push(folded("All correlations", vec![shown(correlations)]));
    }
    blocks
}

/// A measured response curve, what is expected, and what fresh runs gave.
fn curve(source: &mut Source) -> Vec<Block> {
    let Some(table) = source.table("curve.csv").filter(|table| table.header.len() == 7) else { return Vec::new() };
    let axis = |column: usize| Axis::from_header(&table.header[column]);
    let names: Vec<&str> = table.header.iter().map(|header| split_unit(header).0).collect();
    let column = |column: usize| table.numbers(names[column]).unwrap_or_default();
    let frequency = column(0);
    let along = |values: Vec<f64>| frequency.iter().copied().zip(values).collect::<Vec<_>>();
    let band = column(4).into_iter().zip(column(5)).collect();
    let uncertain = column(1).into_iter().zip(column(2));
    let mut figure = Figure::new("", axis(0), axis(1))
        .with(Series::line("expected (95 %)", along(column(3))).with_band(band))
        .with(Series::line("fresh runs, mean", along(column(6))).styled(Style::Points));
    let within = uncertain.map(|(value, uncertainty)| (value - uncertainty, value + uncertainty)).collect();
    figure = figure.with(Series::line("measured", along(column(1))).styled(Style::Points).with_band(within));
    let caption = "The measured response with its uncertainty, what is expected of the values that were found, and what fresh runs with them gave.";
    source.figure("curve", &figure, caption).into_iter().collect()
}

fn compared(measured: &Table) -> Vec<Block> {
    if measured.rows.is_empty() {
        return Vec::new();
    }
    let column = |name: &str| measured.numbers(name).unwrap_or_else(|| vec![f64::NAN; measured.rows.len()]);
    let texts = |name: &str| measured.texts(name).unwrap_or_else(|| vec![String::new(); measured.rows.len()]);
    let [value, uncertainty, expected, deviation, fresh, low, high, inside, all] = [
        "measured",
        "uncertainty",
        "expected",
        "expected deviation",
        "fresh runs",
        "fresh runs low",
        "fresh runs high",
        "as expected",
        "checks",
    ]
    .map(column);
    let (names, units, sources) = (texts("result"), texts("unit"), texts("source"));
    let row = |row: usize| -> Vec<String> {
        let spoken = |x: f64| spoken(x, &units[row]);
        vec![
            names[row].clone(),
            format!("{} ± {}", spoken(value[row]), spoken(uncertainty[row])),
            format!("{} ± {}", spoken(expected[row]), spoken(deviation[row])),
            format!("{} ({} to {})", spoken(fresh[row]), spoken(low[row]), spoken(high[row])),
            format!("{} of {}", inside[row], all[row]),
            sources[row].clone(),
        ]
    };
    let header =
        ["result", "measured", "expected of what was found", "fresh runs, mean (95 %)", "as expected", "source"];
    let mut grid = Grid::new(header);
    for index in 0..names.len() {
        grid.push(Tone::Plain, row(index));
    }
    vec![Block::Table(grid)]
}
