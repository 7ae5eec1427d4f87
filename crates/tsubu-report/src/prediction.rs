//! The report of a prediction: curves of steady motions from an atlas, and the frequencies that were simulated in full.

use tsubu_frame::Table;

use crate::figure::{Axis, Figure, Series, Style};
use crate::page::{Block, Report, Tone, card, folded};
use crate::quantity::{quantity, spoken};
use crate::source::{Source, shown};
use crate::summary::{ended, versions, wall_time_card};
use crate::text::short;

/// What is predicted of a case.
struct Curve {
    name: String,
    /// Frequency ratio, rms, low and high end of the largest stable motion at each frequency.
    largest: Vec<[f64; 4]>,
    /// Frequency ratio and rms of all other motions, stable and not.
    others: [Vec<(f64, f64)>; 2],
}

pub(crate) fn build(source: &mut Source) -> Report {
    let summary = source.summary_of_study();
    let table = source.table("prediction.csv").unwrap_or_default();
    let cases = source.table("cases.csv").unwrap_or_default();
    let curves = curves(&table);
    if curves.is_empty() {
        source.notes.push("prediction.csv holds no curve.".into());
    }
    let mut report = Report {
        kind: "Predicted response".into(),
        title: source.title(),
        headline: headline(&cases),
        versions: versions(summary.as_ref()),
        ..Report::default()
    };
    let column = |name: &str| cases.numbers(name).unwrap_or_else(|| vec![f64::NAN; cases.rows.len()]);
    let [ratio, rms, low, high, error] =
        ["peak frequency ratio", "peak rms", "peak spread low", "peak spread high", "error of the peak"].map(column);
    for (row, name) in cases.texts("case").unwrap_or_default().into_iter().enumerate() {
        let (value, unit) = quantity(rms[row], "m");
        let mut note =
            format!("{name}, at f/f₀ = {}; {} to {}", short(ratio[row]), spoken(low[row], "m"), spoken(high[row], "m"));
        if error[row].is_finite() {
            note += &format!("; {:+.1} % of what is simulated", 100.0 * error[row]).replace('-', "−");
        }
        let tone = if error[row].abs() > 0.1 { Tone::Warning } else { Tone::Plain };
        report.cards.push(card("Predicted peak rms", value, &unit, note, tone));
    }
    if let Some(summary) = &summary {
        report.cards.push(wall_time_card(summary));
        report.verdict = Some(ended(summary));
    }
    let chart = chart(source, &curves, &cases);
    report.section("To be noted", source.note_blocks());
    report.section("Response", chart);
    report.section("Cases", vec![shown(&cases), folded("All motions", vec![shown(&table)])]);
    source.scene_and_verdict(&mut report);
    report
}

fn curves(table: &Table) -> Vec<Curve> {
    let column = |name: &str| table.numbers(name).unwrap_or_else(|| vec![f64::NAN; table.rows.len()]);
    let [ratio, rms, low, high, stable] =
        ["frequency ratio", "rms displacement", "rms spread low", "rms spread high", "stable"].map(column);
    let mut curves: Vec<Curve> = Vec::new();
    for (row, name) in table.texts("case").unwrap_or_default().into_iter().enumerate() {
        let index = curves.iter().position(|curve| curve.name == name).unwrap_or_else(|| {
            curves.push(Curve { name, largest: Vec::new(), others: [Vec::new(), Vec::new()] });
            curves.len() - 1
        });
        let curve = &mut curves[index];
        // The spread stands beside the largest stable motion alone.
        if high[row].is_finite() {
            curve.largest.push([ratio[row], rms[row], low[row], high[row]]);
        } else {
            curve.others[usize::from(stable[row] != 1.0)].push((ratio[row], rms[row]));
        }
    }
    curves
}

fn headline(cases: &Table) -> String {
    let numbers = |name: &str| cases.numbers(name).unwrap_or_default();
    let (rms, ratio) = (numbers("peak rms"), numbers("peak frequency ratio"));
    let names = cases.texts("case").unwrap_or_default();
    let Some(best) = (0..rms.len()).filter(|row| rms[*row].is_finite()).min_by(|a, b| rms[*a].total_cmp(&rms[*b]))
    else {
        return "Nothing is predicted in this folder.".into();
    };
    format!(
        "The lowest predicted peak is that of {}: {} rms at {} of the natural frequency.",
        names[best],
        spoken(rms[best], "m"),
        short(ratio[best])
    )
}

fn chart(source: &mut Source, curves: &[Curve], cases: &Table) -> Vec<Block> {
    let x = Axis::new("frequency / natural frequency", "-");
    let mut figure = Figure::new("", x, Axis::new("rms displacement", "m"));
    for curve in curves {
        let line = curve.largest.iter().map(|point| (point[0], point[1])).collect();
        let band = curve.largest.iter().map(|point| (point[2], point[3])).collect();
        figure = figure.with(Series::line(&curve.name, line).with_band(band));
        for (points, word) in curve.others.iter().zip(["smaller motion", "not stable"]) {
            if !points.is_empty() {
                let name = format!("{}, {word}", curve.name);
                figure = figure.with(Series::line(name, points.clone()).styled(Style::Points));
            }
        }
    }
    let numbers = |name: &str| cases.numbers(name).unwrap_or_default();
    let simulated: Vec<(f64, f64)> = numbers("peak frequency ratio")
        .into_iter()
        .zip(numbers("simulated rms"))
        .filter(|(_, rms)| rms.is_finite())
        .collect();
    let checked = !simulated.is_empty();
    if checked {
        figure = figure.with(Series::line("simulated in full", simulated).styled(Style::Points));
    }
    figure.height = 420 + 12 * curves.len() as u32;
    let points = if checked { " Points: the predicted peaks, simulated in full." } else { "" };
    let caption = format!(
        "Predicted steady rms displacement of the host. The bands are 95 %: scatter of the atlas, what lies between its points, and what \
         grains stir at higher frequencies.{points}"
    );
    source.figure("prediction_rms", &figure, &caption).into_iter().collect()
}
