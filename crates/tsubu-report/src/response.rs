//! The report of a frequency response.

use tsubu_frame::{Table, csv::split_unit};

use crate::figure::{Axis, Bars, Figure, Mark, Series, Style};
use crate::moments;
use crate::page::{Block, Report, Tone};
use crate::source::{
    Source, card, claims_table, cost_table, method_name, quantity, result_cards, results_table, shown, spoken,
    summary_cards, versions,
};
use crate::text::short;

/// The points of one case by one method.
struct Curve {
    name: String,
    /// Frequency ratio (or frequency), rms, peak, low and high end of the rms.
    points: Vec<[f64; 5]>,
}

impl Curve {
    fn top(&self) -> Option<[f64; 5]> {
        self.points.iter().copied().filter(|p| p[1].is_finite()).max_by(|a, b| a[1].total_cmp(&b[1]))
    }
}

pub(crate) fn build(source: &mut Source) -> Report {
    let summary = if source.has("summary.json") { source.summary() } else { None };
    let response = source.table("response.csv");
    let cases = source.table("cases.csv");
    let causes = source.table("energy_by_cause.csv");
    let by_ratio = response
        .as_ref()
        .is_some_and(|r| r.numbers("frequency ratio").is_some_and(|x| x.iter().any(|x| x.is_finite())));
    let curves = response.as_ref().map(|r| curves(r, by_ratio)).unwrap_or_default();
    if curves.is_empty() {
        source.notes.push("response.csv holds no curve.".into());
    }
    let mut report = Report {
        kind: "Frequency response".into(),
        title: source.title(),
        headline: headline(&curves, by_ratio),
        versions: versions(summary.as_ref()),
        ..Report::default()
    };
    report.cards = peak_cards(&curves, by_ratio);
    if let Some(s) = &summary {
        report
            .cards
            .extend(summary_cards(s).into_iter().filter(|c| c.label == "Computed in" || c.label == "Energy residual"));
        if curves.is_empty() {
            report.cards.extend(result_cards(s, 4));
        }
        let failed = s.claims.iter().filter(|c| !c.pass).count();
        report.verdict = Some(match (s.status, failed) {
            (tsubu_frame::Status::Finished, 0) => (Tone::Good, "finished".into()),
            (tsubu_frame::Status::Finished, n) => (Tone::Bad, format!("{n} claims failed")),
            (status, _) => (Tone::Warning, status.word().into()),
        });
    }
    let charts = charts(source, &curves, cases.as_ref(), by_ratio);
    let energy = causes.map(|t| cause_blocks(source, &t)).unwrap_or_default();
    let pictures = picture_blocks(source);
    let mut remarks = source.note_blocks();
    for warning in summary.iter().flat_map(|s| &s.warnings) {
        remarks.push(Block::Note(Tone::Warning, warning.clone()));
    }
    report.section("To be noted", remarks);
    report.section("Response", charts);
    report.section("Cases", cases.iter().map(shown).collect());
    report.section("Energy by cause", energy);
    report.section("Grains", pictures);
    if let Some(s) = &summary {
        if !s.claims.is_empty() {
            report.section("Claims", vec![claims_table(&s.claims.iter().collect::<Vec<_>>())]);
        }
        report.section("Results", results_table(s).into_iter().collect());
        report.section("Cost", vec![cost_table(&[(method_name(&s.method), s)])]);
    }
    source.scene_and_verdict(&mut report);
    report
}

fn curves(table: &Table, by_ratio: bool) -> Vec<Curve> {
    let rows = table.rows.len();
    let numbers = |name: &str| table.numbers(name).unwrap_or_else(|| vec![f64::NAN; rows]);
    let texts = |name: &str| table.texts(name).unwrap_or_else(|| vec![String::new(); rows]);
    let (case, method) = (texts("case"), texts("method"));
    let several = method.iter().any(|m| *m != method[0]);
    let x = numbers(if by_ratio { "frequency ratio" } else { "frequency" });
    let (rms, peak) = (numbers("rms displacement"), numbers("peak displacement"));
    let (low, high) = (numbers("rms spread low"), numbers("rms spread high"));
    let mut curves: Vec<Curve> = Vec::new();
    for i in 0..rows {
        let name = match (case[i].as_str(), several) {
            ("", _) => method_name(&method[i]).to_owned(),
            (case, true) => format!("{case}, {}", method_name(&method[i])),
            (case, false) => case.to_owned(),
        };
        let point = [x[i], rms[i], peak[i], low[i], high[i]];
        match curves.iter_mut().find(|c| c.name == name) {
            Some(curve) => curve.points.push(point),
            None => curves.push(Curve { name, points: vec![point] }),
        }
    }
    for curve in &mut curves {
        curve.points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    }
    curves
}

fn headline(curves: &[Curve], by_ratio: bool) -> String {
    let tops: Vec<_> = curves.iter().filter_map(|c| c.top().map(|t| (c, t))).collect();
    let by_height = |a: &&(&Curve, [f64; 5]), b: &&(&Curve, [f64; 5])| a.1[1].total_cmp(&b.1[1]);
    let (Some((quiet, low)), Some((loud, high))) = (tops.iter().min_by(by_height), tops.iter().max_by(by_height))
    else {
        return "No response was found in this folder.".into();
    };
    let place = |t: &[f64; 5]| {
        if by_ratio {
            format!("at {} of the natural frequency", short(t[0]))
        } else {
            format!("at {}", spoken(t[0], "Hz"))
        }
    };
    if tops.len() == 1 {
        return format!("The rms displacement peaks at {} {}.", spoken(low[1], "m"), place(low));
    }
    format!(
        "The lowest peak is that of {}: {} rms {}, {} % below that of {}.",
        quiet.name,
        spoken(low[1], "m"),
        place(low),
        short((100.0 * (1.0 - low[1] / high[1])).round()),
        loud.name
    )
}

fn peak_cards(curves: &[Curve], by_ratio: bool) -> Vec<crate::page::Card> {
    curves
        .iter()
        .take(6)
        .filter_map(|c| {
            let top = c.top()?;
            let (value, unit) = quantity(top[1], "m");
            let place =
                if by_ratio { format!("at f/f₀ = {}", short(top[0])) } else { format!("at {} Hz", short(top[0])) };
            Some(card(&format!("Peak rms, {}", c.name), value, &unit, place, Tone::Plain))
        })
        .collect()
}

fn charts(source: &mut Source, curves: &[Curve], cases: Option<&Table>, by_ratio: bool) -> Vec<Block> {
    let x = if by_ratio { Axis::new("frequency / natural frequency", "-") } else { Axis::new("frequency", "Hz") };
    let mut rms = Figure::new("", x.clone(), Axis::new("rms displacement", "m"));
    let mut peak = Figure::new("", x, Axis::new("peak displacement", "m"));
    let mut spread = false;
    for curve in curves {
        let style = if curve.points.len() <= 60 { Style::LineAndPoints } else { Style::Line };
        let pick = |k: usize| curve.points.iter().map(|p| (p[0], p[k])).collect::<Vec<_>>();
        let mut series = Series::line(&curve.name, pick(1)).styled(style);
        if curve.points.iter().any(|p| p[4] > p[3]) {
            series = series.with_band(curve.points.iter().map(|p| (p[3], p[4])).collect());
            spread = true;
        }
        rms = rms.with(series);
        peak = peak.with(Series::line(&curve.name, pick(2)).styled(style));
    }
    rms.height = 420 + 12 * curves.len() as u32;
    peak.height = rms.height;
    let limits = added_mass_limits(curves, cases.filter(|_| by_ratio));
    let dashed = if limits.is_empty() {
        ""
    } else {
        " Dashed: where each case would peak if its grains were fixed to the host."
    };
    for (curve, limit) in limits {
        rms = rms.marked(Mark { colour: Some(curve), ..Mark::vertical(limit, "") });
    }
    let band = if spread { " The bands span the seeds." } else { "" };
    let caption = format!("Steady rms displacement of the host against the frequency of excitation.{band}{dashed}");
    let mut blocks = Vec::new();
    blocks.extend(source.figure("response_rms", &rms, &caption));
    if let Some(chart) = source.figure("response_peak", &peak, "The largest displacement at each frequency.") {
        blocks.push(crate::source::folded("Peak displacement", vec![chart]));
    }
    blocks
}

/// Curve and frequency ratio of each case's added-mass limit.
fn added_mass_limits(curves: &[Curve], cases: Option<&Table>) -> Vec<(usize, f64)> {
    let Some((table, limits)) = cases.and_then(|t| Some((t, t.numbers("added-mass limit")?))) else {
        return Vec::new();
    };
    let (case, method) = (table.texts("case"), table.texts("method"));
    let mut found: Vec<(usize, f64)> = Vec::new();
    for (row, limit) in limits.into_iter().enumerate().filter(|(_, x)| x.is_finite() && *x < 1.0) {
        let text = |column: &Option<Vec<String>>| column.as_ref().map_or(String::new(), |c| c[row].clone());
        let (case, method) = (text(&case), text(&method));
        let named = |c: &Curve| c.name == case || c.name == format!("{case}, {}", method_name(&method));
        let curve = curves.iter().position(named);
        // Methods share the limit of a case; one line says it.
        if let Some(curve) = curve.filter(|_| !found.iter().any(|f| f.1 == limit)) {
            found.push((curve, limit));
        }
    }
    found
}

fn cause_blocks(source: &mut Source, table: &Table) -> Vec<Block> {
    let cases = table.texts("case").unwrap_or_else(|| (1..=table.rows.len()).map(|i| i.to_string()).collect());
    let parts = table
        .header
        .iter()
        .filter(|h| split_unit(h).1.is_some_and(|u| u.starts_with('J')))
        .filter_map(|h| Some((split_unit(h).0.to_owned(), table.numbers(h)?)))
        .filter(|(_, values)| values.iter().any(|v| *v != 0.0))
        .collect();
    let bars = Bars { categories: cases, parts, stacked: true, horizontal: false };
    let mut figure = Figure::of_bars("", Axis::new("energy per cycle", "J"), bars);
    figure.height = 400;
    let mut blocks = Vec::new();
    blocks.extend(source.figure("energy_by_cause", &figure, "Energy taken out of the host in a cycle, by cause."));
    blocks.push(crate::source::folded("Energy per cycle in numbers", vec![shown(table)]));
    blocks
}

/// Strips of the folder itself and of the cases inside it that kept snapshots.
fn picture_blocks(source: &mut Source) -> Vec<Block> {
    const MOST: usize = 4;
    let history = source.table("history.csv");
    let mut blocks = moments::blocks(source, history.as_ref(), "");
    let mut inside: Vec<String> = std::fs::read_dir(&source.dir)
        .into_iter()
        .flatten()
        .filter_map(Result::ok)
        .filter(|e| e.path().join("frames").is_dir())
        .map(|e| e.file_name().to_string_lossy().into_owned())
        .collect();
    inside.sort();
    for name in inside.into_iter().take(MOST) {
        let mut case = source.inside(&name);
        let history = case.table("history.csv");
        let drawn = moments::blocks(&mut case, history.as_ref(), &format!("{name}_"));
        if !drawn.is_empty() {
            blocks.push(Block::Text(format!("Case {name}:")));
            blocks.extend(drawn);
        }
        source.files.append(&mut case.files);
        source.notes.extend(case.notes.into_iter().map(|n| format!("{name}: {n}")));
    }
    blocks
}
