//! The report of a parameter sweep.

use tsubu_frame::{Table, csv::split_unit};

use crate::figure::{Axis, Figure, Series, Style};
use crate::moments;
use crate::page::{Block, Report};
use crate::source::{Source, shown, versions};
use crate::text::duration;

/// More figures than this tell less than the table.
const MOST_FIGURES: usize = 8;

pub(crate) fn build(source: &mut Source) -> Report {
    let table = source.table("sweep.csv").unwrap_or_default();
    let wall: f64 = table.numbers("wall seconds").unwrap_or_default().iter().filter(|x| x.is_finite()).sum();
    let mut report = Report {
        kind: "Parameter sweep".into(),
        title: source.title(),
        headline: format!("{} cases, computed in {} of machine time.", table.rows.len(), duration(wall)),
        versions: versions(None),
        ..Report::default()
    };
    let charts = charts(source, &table);
    report.section("To be noted", source.note_blocks());
    report.section("Results over what varied", charts);
    report.section("Cases", if table.rows.is_empty() { Vec::new() } else { vec![shown(&table)] });
    let pictures = picture_blocks(source, &table);
    report.section("To be noted of the pictures", source.note_blocks());
    report.section("Grains", pictures);
    source.scene_and_verdict(&mut report);
    report
}

/// Each result over the key with the most values; the other keys make the curves.
fn charts(source: &mut Source, table: &Table) -> Vec<Block> {
    let keys: Vec<(&str, Vec<String>)> = table
        .header
        .iter()
        .filter(|h| split_unit(h).1 == Some("text") && split_unit(h).0 != "case")
        .filter_map(|h| Some((split_unit(h).0, table.texts(h)?)))
        .collect();
    let distinct = |values: &[String]| values.iter().collect::<std::collections::BTreeSet<_>>().len();
    let numeric = keys.iter().filter(|(_, v)| v.iter().all(|t| leading_number(t).is_some()));
    let Some((along, x)) = numeric.max_by_key(|(_, v)| distinct(v)).filter(|(_, v)| distinct(v) > 1) else {
        return Vec::new();
    };
    // What the books miss is told in the table.
    let results =
        table.header.iter().filter(|h| matches!(split_unit(h), (name, Some("SI")) if !name.contains("residual")));
    let mut blocks = Vec::new();
    for header in results.take(MOST_FIGURES) {
        let Some(values) = table.numbers(header) else { continue };
        let name = split_unit(header).0;
        let unit = x.first().and_then(|t| t.split_once(' ')).map_or("-", |(_, unit)| unit);
        let mut figure = Figure::new("", Axis::new(*along, unit), Axis::new(name, "-"));
        for (row, value) in values.iter().enumerate() {
            let curve: Vec<String> =
                keys.iter().filter(|(k, _)| k != along).map(|(k, v)| format!("{k} = {}", v[row])).collect();
            let curve = curve.join(", ");
            let point = (leading_number(&x[row]).unwrap_or(f64::NAN), *value);
            match figure.series.iter_mut().find(|s| s.name == curve) {
                Some(series) => series.points.push(point),
                None => figure.series.push(Series::line(curve, vec![point]).styled(Style::LineAndPoints)),
            }
        }
        for series in &mut figure.series {
            series.points.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        let file = format!("sweep_{}", name.replace(|c: char| !c.is_ascii_alphanumeric(), "_"));
        blocks.extend(source.figure(&file, &figure, &format!("{name} (SI units) over {along}.")));
    }
    blocks
}

/// Strips of the cases that kept snapshots; `cases/` numbers them as the table does.
fn picture_blocks(source: &mut Source, table: &Table) -> Vec<Block> {
    const MOST: usize = 6;
    let names = table.texts("case").unwrap_or_default();
    let mut blocks = Vec::new();
    for (i, name) in names.iter().enumerate() {
        let mut case = source.inside(&format!("cases/{i:04}"));
        if blocks.len() >= 2 * MOST || !case.has("frames") {
            continue;
        }
        let history = case.table("history.csv");
        let drawn = moments::blocks(&mut case, history.as_ref(), &format!("case_{i:04}_"));
        if let Some(strip) = drawn.into_iter().find(|b| matches!(b, Block::Drawing { .. })) {
            blocks.extend([Block::Text(format!("Case {name}:")), strip]);
        }
        source.files.extend(case.files.into_iter().filter(|(file, _)| file.ends_with("strip.svg")));
        source.notes.extend(case.notes.into_iter().map(|n| format!("{name}: {n}")));
    }
    blocks
}

/// The number of `6 mm`.
fn leading_number(text: &str) -> Option<f64> {
    text.split_whitespace().next()?.parse().ok()
}
