//! The report of an atlas: what cavities show over acceleration, a curve for each frequency.

use std::collections::BTreeMap;

use tsubu_frame::Table;

use crate::figure::{Axis, Figure, Series, Style};
use crate::page::{Block, Report, Tone, card, folded};
use crate::quantity::spoken;
use crate::source::{Source, shown};
use crate::summary::{claims_and_results, ended, versions, wall_time_card};
use crate::text::short;

/// Figures that are seen without unfolding.
const OPEN: usize = 3;

/// Points of a curve, or lower and upper ends of a band.
type Line = Vec<(f64, f64)>;

/// The points of a cavity, in the mean over the seeds.
struct Cavity {
    name: String,
    /// By frequency and acceleration, as bits of positive numbers: effective mass over that of the grains, loss factor, error; summed, with
    /// their number.
    points: BTreeMap<(u64, u64), ([f64; 3], f64)>,
}

impl Cavity {
    /// The largest loss factor: frequency, acceleration, and what is shown there.
    fn best(&self) -> Option<([f64; 2], [f64; 3])> {
        let mean = |(place, (sums, n)): (&(u64, u64), &([f64; 3], f64))| {
            ([f64::from_bits(place.0), f64::from_bits(place.1)], sums.map(|sum| sum / n))
        };
        self.points.iter().map(mean).max_by(|a, b| a.1[1].total_cmp(&b.1[1]))
    }

    /// One of the numbers over the acceleration, a series for each frequency.
    fn series(&self, which: usize) -> Vec<Series> {
        let mut columns: BTreeMap<u64, (Line, Line)> = BTreeMap::new();
        for ((frequency, acceleration), (sums, n)) in &self.points {
            let (line, band) = columns.entry(*frequency).or_default();
            let (value, error) = (sums[which] / n, 2.0 * sums[2] / n);
            line.push((f64::from_bits(*acceleration), value));
            band.push((value - error, value + error));
        }
        let series = |(frequency, (line, band)): (u64, (Line, Line))| {
            let name = spoken(f64::from_bits(frequency), "Hz");
            Series::line(name, line).styled(Style::LineAndPoints).with_band(band)
        };
        columns.into_iter().map(series).collect()
    }
}

pub(crate) fn build(source: &mut Source) -> Report {
    let summary = source.summary_of_study();
    let table = source.table("atlas.csv").unwrap_or_default();
    let cavities = cavities(&table);
    if cavities.is_empty() {
        source.notes.push("atlas.csv holds no points.".into());
    }
    let mut report = Report {
        kind: "Atlas of cavities".into(),
        title: source.title(),
        headline: headline(&cavities),
        versions: versions(summary.as_ref()),
        ..Report::default()
    };
    for cavity in &cavities {
        let Some(([frequency, acceleration], [mass, loss, _])) = cavity.best() else { continue };
        let place = format!("at {} and {}", spoken(frequency, "Hz"), spoken(acceleration, "m/s^2"));
        let note = format!("{place}; effective mass {} of the grains'", short(mass));
        let label = format!("Largest loss factor, {}", cavity.name);
        report.cards.push(card(&label, short(loss), "", note, Tone::Plain));
    }
    if let Some(summary) = &summary {
        report.cards.push(wall_time_card(summary));
        report.verdict = Some(ended(summary));
    }
    let charts = charts(source, &cavities);
    report.section("To be noted", source.note_blocks());
    report.section("What the cavities show", charts);
    report.section("Points", vec![folded("All points", vec![shown(&table)])]);
    if let Some(summary) = &summary {
        claims_and_results(&mut report, summary);
    }
    source.scene_and_verdict(&mut report);
    report
}

fn cavities(table: &Table) -> Vec<Cavity> {
    let column = |name: &str| table.numbers(name).unwrap_or_else(|| vec![f64::NAN; table.rows.len()]);
    let [grains, frequency, acceleration, mass, loss, error] =
        ["grain mass", "frequency", "acceleration", "effective mass", "loss factor", "error"].map(column);
    let mut cavities: Vec<Cavity> = Vec::new();
    for (row, name) in table.texts("case").unwrap_or_default().into_iter().enumerate() {
        let values = [mass[row] / grains[row], loss[row], error[row] / grains[row]];
        if !(values[..2].iter().all(|value| value.is_finite()) && frequency[row] > 0.0 && acceleration[row] > 0.0) {
            continue;
        }
        let index = cavities.iter().position(|cavity| cavity.name == name).unwrap_or_else(|| {
            cavities.push(Cavity { name, points: BTreeMap::new() });
            cavities.len() - 1
        });
        let place = (frequency[row].to_bits(), acceleration[row].to_bits());
        let (sums, n) = cavities[index].points.entry(place).or_insert(([0.0; 3], 0.0));
        for (sum, value) in sums.iter_mut().zip(values) {
            *sum += if value.is_finite() { value } else { 0.0 };
        }
        *n += 1.0;
    }
    cavities
}

fn headline(cavities: &[Cavity]) -> String {
    let best = cavities.iter().filter_map(|cavity| Some((cavity, cavity.best()?)));
    let Some((cavity, ([frequency, acceleration], [_, loss, _]))) = best.max_by(|a, b| a.1.1[1].total_cmp(&b.1.1[1]))
    else {
        return "No cavity was measured in this folder.".into();
    };
    format!(
        "The largest loss factor is that of {}: {} at {} and {}.",
        cavity.name,
        short(loss),
        spoken(frequency, "Hz"),
        spoken(acceleration, "m/s^2")
    )
}

fn charts(source: &mut Source, cavities: &[Cavity]) -> Vec<Block> {
    let mut blocks = Vec::new();
    for (index, cavity) in cavities.iter().enumerate() {
        let mut pair = Vec::new();
        for (which, label, file) in
            [(1, "loss factor", "loss_factor"), (0, "effective mass / mass of the grains", "effective_mass")]
        {
            let x = Axis::new("amplitude of the acceleration", "m/s^2").log();
            let mut figure = Figure::new(&cavity.name, x, Axis::new(label, "-"));
            for series in cavity.series(which) {
                figure = figure.with(series);
            }
            let caption = if which == 1 {
                "Energy that grains take out of the motion: lossy mass over their mass, a curve for each frequency. \
                 The bands are 95 % of the measurement."
            } else {
                "Part of the grains' force in phase with the acceleration, over the acceleration and their mass: 1 while they ride along."
            };
            pair.extend(source.figure(&format!("{file}_{index}"), &figure, caption));
        }
        if index < OPEN {
            blocks.extend(pair);
        } else {
            blocks.push(folded(&cavity.name, pair));
        }
    }
    blocks
}
