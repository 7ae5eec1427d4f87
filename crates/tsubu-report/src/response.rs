//! The report of a frequency response.

use tsubu_frame::{Table, csv::split_unit};

use crate::figure::{Axis, Bars, Figure, Mark, Series, Style};
use crate::moments;
use crate::page::{Block, Card, Report, Tone, card, folded};
use crate::quantity::{quantity, spoken};
use crate::source::{Source, shown};
use crate::summary::{claims_and_results, ended, method_name, residual_card, result_cards, versions, wall_time_card};
use crate::text::short;

mod cost;
mod watched;

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
    let summary = source.summary_of_study();
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
    let listed = cases.as_ref().map(cases_of).unwrap_or_default();
    let mut report = Report {
        kind: "Frequency response".into(),
        title: source.title(),
        headline: headline(&curves, &listed, by_ratio),
        versions: versions(summary.as_ref()),
        ..Report::default()
    };
    report.cards = key_cards(&listed);
    if let Some(s) = &summary {
        report.cards.extend([wall_time_card(s), residual_card(s)]);
        if curves.is_empty() {
            report.cards.extend(result_cards(s, 4));
        }
        report.verdict = Some(ended(s));
    }
    let charts = charts(source, &curves, cases.as_ref(), by_ratio);
    let watches = response.map(|table| watched::blocks(source, &table, by_ratio)).unwrap_or_default();
    let energy = causes.map(|t| cause_blocks(source, &t)).unwrap_or_default();
    let pictures = picture_blocks(source, &listed);
    report.section("To be noted", source.note_blocks());
    report.section("Response", charts);
    report.section("Watches", watches);
    report.section("Cases", cases.as_ref().map(|c| shown(&told_once(c))).into_iter().collect());
    report.section("Energy by cause", energy);
    report.section("Grains", pictures);
    if let Some(s) = &summary {
        claims_and_results(&mut report, s);
        report.section("Cost", cost::blocks(&listed, &curves, s));
    }
    source.scene_and_verdict(&mut report);
    report
}

/// The curve that each row belongs to: its case, its method where there are several.
fn curve_names(table: &Table) -> Vec<String> {
    let texts = |name: &str| table.texts(name).unwrap_or_else(|| vec![String::new(); table.rows.len()]);
    let (case, method) = (texts("case"), texts("method"));
    let several = method.iter().any(|m| *m != method[0]);
    let named = |(case, method): (&String, &String)| match (case.as_str(), several) {
        ("", _) => method_name(method).to_owned(),
        (case, true) => format!("{case}, {}", method_name(method)),
        (case, false) => case.to_owned(),
    };
    case.iter().zip(&method).map(named).collect()
}

/// The axis that curves are drawn along, and its column.
fn abscissa(by_ratio: bool) -> (Axis, &'static str) {
    if by_ratio {
        (Axis::new("frequency / natural frequency", "-"), "frequency ratio")
    } else {
        (Axis::new("frequency", "Hz"), "frequency")
    }
}

fn curves(table: &Table, by_ratio: bool) -> Vec<Curve> {
    let rows = table.rows.len();
    let numbers = |name: &str| table.numbers(name).unwrap_or_else(|| vec![f64::NAN; rows]);
    let x = numbers(abscissa(by_ratio).1);
    let (rms, peak) = (numbers("rms displacement"), numbers("peak displacement"));
    let (low, high) = (numbers("rms spread low"), numbers("rms spread high"));
    let mut curves: Vec<Curve> = Vec::new();
    for (i, name) in curve_names(table).into_iter().enumerate() {
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

/// The lowest peak, as `cases.csv` has it, between the frequencies that were run; else the highest point of each curve.
fn headline(curves: &[Curve], cases: &[Case], by_ratio: bool) -> String {
    let of_case = |c: &Case| (c.name.clone(), c.ratio, c.rms);
    let of_curve = |c: &Curve| c.top().map(|t| (c.name.clone(), t[0], t[1]));
    let mut tops: Vec<(String, f64, f64)> = cases.iter().map(of_case).filter(|t| t.2.is_finite()).collect();
    if tops.is_empty() || !by_ratio {
        tops = curves.iter().filter_map(of_curve).collect();
    }
    let by_height = |a: &&(String, f64, f64), b: &&(String, f64, f64)| a.2.total_cmp(&b.2);
    let (Some(quiet), Some(loud)) = (tops.iter().min_by(by_height), tops.iter().max_by(by_height)) else {
        return "No response was found in this folder.".into();
    };
    let place = if by_ratio {
        format!("at {} of the natural frequency", short(quiet.1))
    } else {
        format!("at {}", spoken(quiet.1, "Hz"))
    };
    if tops.len() == 1 {
        return format!("The rms displacement peaks at {} {place}.", spoken(quiet.2, "m"));
    }
    format!(
        "The lowest peak is that of {}: {} rms {place}, {} % below that of {}.",
        quiet.0,
        spoken(quiet.2, "m"),
        short((100.0 * (1.0 - quiet.2 / loud.2)).round()),
        loud.0
    )
}

/// One row of `cases.csv`: the top of a curve, interpolated, and what belongs to it.
struct Case {
    name: String,
    grains: f64,
    ratio: f64,
    rms: f64,
    loss_factor: f64,
    limit: f64,
    wall: f64,
}

fn cases_of(table: &Table) -> Vec<Case> {
    let column = |name: &str| table.numbers(name).unwrap_or_else(|| vec![f64::NAN; table.rows.len()]);
    let texts = |name: &str| table.texts(name).unwrap_or_else(|| vec![String::new(); table.rows.len()]);
    let (names, methods) = (texts("case"), texts("method"));
    let several = methods.iter().any(|m| *m != methods[0]);
    let (grains, ratio, rms) = (column("particles"), column("peak frequency ratio"), column("peak rms"));
    let (loss_factor, limit, wall) = (column("loss factor"), column("added-mass limit"), column("wall seconds"));
    (0..table.rows.len())
        .map(|i| Case {
            name: if several { format!("{}, {}", names[i], method_name(&methods[i])) } else { names[i].clone() },
            grains: grains[i],
            ratio: ratio[i],
            rms: rms[i],
            loss_factor: loss_factor[i],
            limit: limit[i],
            wall: wall[i],
        })
        .collect()
}

/// The peak without grains against that of the best case, or of the best case against the worst.
fn key_cards(cases: &[Case]) -> Vec<Card> {
    let known = || cases.iter().filter(|c| c.rms.is_finite());
    let Some(best) = known().min_by(|a, b| a.rms.total_cmp(&b.rms)) else { return Vec::new() };
    let peak = |label: &str, case: &Case| {
        let (value, unit) = quantity(case.rms, "m");
        card(label, value, &unit, format!("{}, at f/f₀ = {}", case.name, short(case.ratio)), Tone::Plain)
    };
    let empty = known().find(|c| c.grains == 0.0);
    let reference = empty.or_else(|| known().max_by(|a, b| a.rms.total_cmp(&b.rms))).unwrap_or(best);
    let mut cards = Vec::new();
    if std::ptr::eq(reference, best) {
        cards.push(peak("Peak rms", best));
    } else {
        let (label, than) = if empty.is_some() {
            ("Peak rms without grains", "that without grains")
        } else {
            ("Highest peak rms", "the highest")
        };
        cards.push(peak(label, reference));
        cards.push(peak("Lowest peak rms", best));
        let note = format!(
            "from {than} to the lowest peak: {} % less",
            short((100.0 * (1.0 - best.rms / reference.rms)).round())
        );
        cards.push(card("Reduction factor", decimals(reference.rms / best.rms, 2), "", note, Tone::Plain));
        let shift = 100.0 * (best.ratio / reference.ratio - 1.0);
        let fixed = 100.0 * (best.limit - 1.0);
        let note = if empty.is_some() && fixed.is_finite() {
            format!("of the lowest peak; {} % if its grains were fixed to the host", decimals(fixed, 1))
        } else {
            "of the lowest peak against the highest".to_owned()
        };
        cards.push(card("Frequency shift", decimals(shift, 1), "%", note, Tone::Plain));
    }
    let damped =
        cases.iter().filter(|c| c.loss_factor.is_finite()).max_by(|a, b| a.loss_factor.total_cmp(&b.loss_factor));
    if let Some(case) = damped {
        let without = empty.filter(|e| e.loss_factor.is_finite() && e.grains != case.grains);
        let note = without.map_or_else(
            || case.name.clone(),
            |e| format!("{}; {} without grains", case.name, decimals(e.loss_factor, 3)),
        );
        cards.push(card("Best loss factor", decimals(case.loss_factor, 3), "", note, Tone::Plain));
    }
    cards
}

fn decimals(x: f64, places: usize) -> String {
    format!("{x:.places$}").replace('-', "−")
}

/// The table without what stands elsewhere on the page: the method if there is one only, the computing times.
fn told_once(table: &Table) -> Table {
    let several = table.texts("method").is_some_and(|m| m.iter().any(|x| *x != m[0]));
    let kept: Vec<usize> = (0..table.header.len())
        .filter(|&i| match split_unit(&table.header[i]).0 {
            "method" => several,
            "wall seconds" => false,
            _ => true,
        })
        .collect();
    let mut narrow = Table::new(kept.iter().map(|&i| table.header[i].clone()));
    for row in &table.rows {
        narrow.push(kept.iter().map(|&i| row[i].clone()));
    }
    narrow
}

fn charts(source: &mut Source, curves: &[Curve], cases: Option<&Table>, by_ratio: bool) -> Vec<Block> {
    let x = abscissa(by_ratio).0;
    let mut rms = Figure::new("", x.clone(), Axis::new("rms displacement", "m"));
    let mut peak = Figure::new("", x, Axis::new("peak displacement", "m"));
    let mut spread = false;
    for (i, curve) in curves.iter().enumerate() {
        let style = match curve.points.len() {
            // Dashed, so that the curve below shows through.
            _ if curves[..i].iter().any(|other| covers(curve, other)) => Style::Dashed,
            ..=60 => Style::LineAndPoints,
            _ => Style::Line,
        };
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
    let parted = parted(cases.filter(|_| by_ratio));
    for [from, to] in &parted {
        rms = rms.marked(Mark::vertical(*from, "")).marked(Mark::vertical(*to, "hysteresis"));
    }
    let band = if spread { " The bands span the seeds." } else { "" };
    let hysteresis = if parted.is_empty() {
        ""
    } else {
        " Hysteresis: between the grey marks what comes from below moves otherwise than what comes from above."
    };
    let caption =
        format!("Steady rms displacement of the host against the frequency of excitation.{band}{dashed}{hysteresis}");
    let mut blocks = Vec::new();
    blocks.extend(source.figure("response_rms", &rms, &caption));
    if let Some(chart) = source.figure("response_peak", &peak, "The largest displacement at each frequency.") {
        blocks.push(folded("Peak displacement", vec![chart]));
    }
    blocks
}

/// Whether two curves can hardly be told apart.
fn covers(one: &Curve, other: &Curve) -> bool {
    let top = one.top().map_or(f64::NAN, |t| t[1]);
    let close = |(a, b): (&[f64; 5], &[f64; 5])| a[0] == b[0] && (a[1] - b[1]).abs() < 0.02 * top;
    one.points.len() == other.points.len() && one.points.iter().zip(&other.points).all(close)
}

/// Lowest and highest frequency ratio at which the curves up and down of a case part, each once.
fn parted(cases: Option<&Table>) -> Vec<[f64; 2]> {
    let ends = |name: &str| cases.and_then(|table| table.numbers(name)).unwrap_or_default();
    let mut parted: Vec<[f64; 2]> = Vec::new();
    for (from, to) in ends("hysteresis from").into_iter().zip(ends("hysteresis to")) {
        if from.is_finite() && to.is_finite() && !parted.contains(&[from, to]) {
            parted.push([from, to]);
        }
    }
    parted
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
    // Long names stand beside lying bars; below standing ones they would run into each other.
    let horizontal = cases.iter().map(|c| c.chars().count()).sum::<usize>() > 60;
    let count = cases.len() as u32;
    let bars = Bars { categories: cases, parts, stacked: true, horizontal };
    let mut figure = Figure::of_bars("", Axis::new("energy per cycle", "J"), bars);
    figure.height = if horizontal { 130 + 34 * count } else { 400 };
    let mut blocks = Vec::new();
    blocks.extend(source.figure("energy_by_cause", &figure, "Energy taken out of the host in a cycle, by cause."));
    blocks.push(folded("Energy per cycle in numbers", vec![shown(table)]));
    blocks
}

/// The strip of the filmed period, or of whatever snapshots there are.
fn picture_blocks(source: &mut Source, listed: &[Case]) -> Vec<Block> {
    let history = source.table("history.csv");
    // A response films the case with grains that has the lowest peak.
    let peaks = listed.iter().filter(|c| c.ratio.is_finite() && c.rms.is_finite() && c.grains > 0.0);
    let best = peaks.min_by(|a, b| a.rms.total_cmp(&b.rms));
    let mut blocks = match (&history, best) {
        (None, Some(case)) => {
            let who = format!("{} at its peak,", case.name);
            moments::filmed(source, &who, "the drive passes its middle going up")
        }
        _ => Vec::new(),
    };
    if blocks.is_empty() {
        blocks = moments::blocks(source, history.as_ref(), "");
    }
    blocks
}
