//! The report of a parameter sweep.

use std::collections::BTreeSet;
use std::path::{Component, Path};

use serde::Deserialize;
use tsubu_frame::summary::{mean_beside, read_json};
use tsubu_frame::{Summary, Table, csv::split_unit};

use crate::figure::{Axis, Figure, Series, Style};
use crate::moments;
use crate::page::{Block, Grid, Report, Tone, folded};
use crate::quantity::{of_one_unit, prefix};
use crate::source::{Source, shown};
use crate::summary::versions;
use crate::text::{duration, short};

/// Figures that are seen without unfolding, and columns of results in the first table.
const OPEN: usize = 8;
/// More figures than this make a page too heavy to open; the table has all results.
const MOST_FIGURES: usize = 40;

/// What `sweep.json` says of the sweep as a whole.
#[derive(Debug, Deserialize)]
struct Took {
    wall_seconds: f64,
    jobs: usize,
}

/// `sweep.csv` taken apart.
struct Sweep<'a> {
    table: &'a Table,
    /// What varied, and its value in each case.
    keys: Vec<(&'a str, Vec<String>)>,
    /// Columns of results, in the order in which the scene asks for them.
    results: Vec<usize>,
}

pub(crate) fn build(source: &mut Source) -> Report {
    let table = source.table("sweep.csv").unwrap_or_default();
    let sweep = Sweep::of(&table);
    let mut report = Report {
        kind: "Parameter sweep".into(),
        title: source.title(),
        headline: headline(source, &table),
        verdict: verdict(&table),
        versions: versions(None),
        ..Report::default()
    };
    let charts = sweep.charts(source);
    let mut remarks = source.note_blocks();
    remarks.extend(common_warnings(source, &table).into_iter().map(|text| Block::Note(Tone::Warning, text)));
    report.section("To be noted", remarks);
    report.section("Results over what varied", charts);
    report.section("Over the seeds", sweep.repeated().into_iter().collect());
    report.section("Cases", sweep.listed());
    let pictures = picture_blocks(source, &table);
    report.section("To be noted of the pictures", source.note_blocks());
    report.section("Grains", pictures);
    source.scene_and_verdict(&mut report);
    report
}

/// How many cases, by the clock on the wall and added up: cases run side by side.
fn headline(source: &mut Source, table: &Table) -> String {
    let added: f64 = table.numbers("wall seconds").unwrap_or_default().iter().filter(|x| x.is_finite()).sum();
    let cases = table.rows.len();
    let read = source.has("sweep.json").then(|| read_json::<Took>(&source.dir.join("sweep.json")));
    match read.and_then(|read| source.told(read)) {
        Some(took) => format!(
            "{cases} cases in {} by the clock, {} side by side; their own times add up to {}.",
            duration(took.wall_seconds),
            took.jobs,
            duration(added)
        ),
        None => format!("{cases} cases; their computing times add up to {}.", duration(added)),
    }
}

/// A case that did not come to its end is said at the head of the page.
fn verdict(table: &Table) -> Option<(Tone, String)> {
    let status = table.texts("status")?;
    let count = |word: &str| status.iter().filter(|status| *status == word).count();
    let (failed, missing, all) = (count("failed"), count("missing"), count("finished") == status.len());
    let cases = |n: usize| if n == 1 { "1 case".to_owned() } else { format!("{n} cases") };
    Some(match (failed, missing) {
        (0, 0) if all => (Tone::Good, "finished".into()),
        (0, 0) => (Tone::Warning, "unfinished".into()),
        (_, 0) => (Tone::Bad, format!("{} failed", cases(failed))),
        (0, _) => (Tone::Bad, format!("{} missing", cases(missing))),
        _ => (Tone::Bad, format!("{} failed, {missing} missing", cases(failed))),
    })
}

/// What every case warns of; `sweep.csv` has the rest, case by case.
fn common_warnings(source: &Source, table: &Table) -> Vec<String> {
    let folders = folders(table);
    let mut read =
        folders.iter().filter_map(|folder| Summary::read(&source.dir.join(folder).join("summary.json")).ok());
    let (Some(first), Some(second)) = (read.next(), read.next()) else { return Vec::new() };
    let mut common = first.warnings;
    for other in [second].into_iter().chain(read) {
        common.retain(|warning| other.warnings.contains(warning));
    }
    common.into_iter().map(|warning| format!("Every case: {warning}")).collect()
}

/// Where the runs of the cases are; a table that was altered leads nowhere else.
fn folders(table: &Table) -> Vec<String> {
    let inside = |folder: &String| Path::new(folder).components().all(|part| matches!(part, Component::Normal(_)));
    let folders = table.texts("folder").unwrap_or_default();
    folders.into_iter().map(|folder| if inside(&folder) { folder } else { String::new() }).collect()
}

impl<'a> Sweep<'a> {
    fn of(table: &'a Table) -> Self {
        let own = ["case", "status", "remark", "folder", "wall seconds", "energy residual"];
        let (mut keys, mut results) = (Vec::new(), Vec::new());
        for (column, header) in table.header.iter().enumerate() {
            match split_unit(header) {
                (name, _) if own.contains(&name) => {}
                (key, Some("text")) => keys.push((key, table.rows.iter().map(|r| r[column].to_string()).collect())),
                _ => results.push(column),
            }
        }
        Self { table, keys, results }
    }

    fn number(&self, row: usize, column: usize) -> f64 {
        self.table.rows[row][column].number().unwrap_or(f64::NAN)
    }

    /// Whether a result is not the same in all cases.
    fn varies(&self, column: usize) -> bool {
        let mut values = (0..self.table.rows.len()).map(|row| self.number(row, column)).filter(|x| x.is_finite());
        values.next().is_none_or(|first| values.any(|other| other != first))
    }

    /// The key with the most values that are numbers; cases that differ in the seed alone are one case tried again.
    fn along(&self) -> Option<&(&'a str, Vec<String>)> {
        let distinct = |values: &[String]| values.iter().collect::<BTreeSet<_>>().len();
        let keys = self.keys.iter().filter(|(key, values)| *key != "seed" && of_one_unit(values).is_some());
        keys.max_by_key(|(_, values)| distinct(values)).filter(|(_, values)| distinct(values) > 1)
    }

    /// Each result over the key with the most values; the other keys make the curves, the seeds a band.
    fn charts(&self, source: &mut Source) -> Vec<Block> {
        let Some((along, (x, unit))) = self.along().and_then(|(key, values)| Some((key, of_one_unit(values)?))) else {
            return Vec::new();
        };
        let watches = source.names("watch");
        let watch_of = |name: &str| {
            let own = |watch: &&String| name.strip_prefix(watch.as_str()).is_some_and(|rest| rest.starts_with(' '));
            watches.iter().filter(own).max_by_key(|watch| watch.len()).cloned().unwrap_or_default()
        };
        let mut drawn: Vec<(String, Block)> = Vec::new();
        // The energy residual is told in the table, and so is what is the same in all cases.
        let told = |column: &&usize| {
            let header = &self.table.header;
            let name = split_unit(&header[**column]).0;
            // What is told beside a mean comes before it only where the scene asks for it.
            let mean = mean_beside(name);
            let asked = mean.is_none_or(|mean| header.iter().position(|c| split_unit(c).0 == mean) > Some(**column));
            !name.contains("residual") && asked && self.varies(**column)
        };
        for &column in self.results.iter().filter(told).take(MOST_FIGURES) {
            let header = &self.table.header[column];
            let name = split_unit(header).0;
            let mut figure = Figure::new("", Axis::new(*along, unit.as_str()), Axis::from_header(header));
            let (curves, spread) = self.curves(along, &x, column);
            for (curve, points) in curves {
                let series = Series::line(curve, points.iter().map(|p| (p.x, p.mean)).collect());
                let series = series.styled(Style::LineAndPoints);
                let band = points.iter().map(|p| (p.least, p.largest)).collect();
                figure.series.push(if spread { series.with_band(band) } else { series });
            }
            let file = format!("sweep_{}", name.replace(|c: char| !c.is_ascii_alphanumeric(), "_"));
            let band = if spread { " Lines: mean over the seeds; bands: the least and the largest." } else { "" };
            let figure = source.figure(&file, &figure, &format!("{name} over {along}.{band}"));
            drawn.extend(figure.map(|figure| (watch_of(name), figure)));
        }
        let rest = drawn.split_off(drawn.len().min(OPEN));
        let mut blocks: Vec<Block> = drawn.into_iter().map(|(_, figure)| figure).collect();
        // Behind the first ones, those of each watch by themselves.
        for of_one in rest.chunk_by(|a, b| a.0 == b.0) {
            let of = if of_one[0].0.is_empty() { String::new() } else { format!(": {}", of_one[0].0) };
            let figures = of_one.iter().map(|(_, figure)| figure.clone()).collect();
            blocks.push(folded(&format!("More results over what varied{of}"), figures));
        }
        blocks
    }

    /// The curves of a result, and whether a point of them has several seeds.
    fn curves(&self, along: &str, x: &[f64], column: usize) -> (Vec<(String, Vec<Point>)>, bool) {
        let mut curves: Vec<(String, Vec<Point>)> = Vec::new();
        let status = self.table.texts("status").unwrap_or_default();
        for (row, &x) in x.iter().enumerate().filter(|(row, _)| status.get(*row).is_none_or(|s| s != "failed")) {
            let others = self.keys.iter().filter(|(key, _)| *key != along && *key != "seed");
            let curve: Vec<String> = others.map(|(key, values)| format!("{key} = {}", values[row])).collect();
            let curve = curve.join(", ");
            let index = curves.iter().position(|(name, _)| *name == curve).unwrap_or_else(|| {
                curves.push((curve, Vec::new()));
                curves.len() - 1
            });
            let points = &mut curves[index].1;
            let value = self.number(row, column);
            match points.iter_mut().find(|point| point.x == x) {
                Some(point) => point.take(value),
                None => points.push(Point::new(x, value)),
            }
        }
        for (_, points) in &mut curves {
            points.sort_by(|a, b| a.x.total_cmp(&b.x));
        }
        let spread = curves.iter().flat_map(|(_, points)| points).any(|point| point.count > 1.0);
        (curves, spread)
    }

    /// Mean, least and largest of every result where nothing but the seed varied.
    fn repeated(&self) -> Option<Block> {
        let [("seed", seeds)] = &self.keys[..] else { return None };
        let mut grid = Grid::new(["result", "mean", "least", "largest", "unit"]);
        for &column in &self.results {
            let mut point = Point::new(0.0, self.number(0, column));
            (1..seeds.len()).for_each(|row| point.take(self.number(row, column)));
            let (name, unit) = split_unit(&self.table.header[column]);
            let (factor, unit) = prefix(unit.unwrap_or("-"), point.least.abs().max(point.largest.abs()));
            let unit = if unit == "-" { String::new() } else { unit };
            let [mean, least, largest] = [point.mean, point.least, point.largest].map(|x| short(x * factor));
            grid.push(Tone::Plain, [name.to_owned(), mean, least, largest, unit]);
        }
        Some(Block::Table(grid))
    }

    /// The cases with their first results and what is to be noted of them; all numbers behind.
    fn listed(&self) -> Vec<Block> {
        let columns = |wanted: &[&str]| -> Vec<usize> { wanted.iter().filter_map(|w| self.table.index(w)).collect() };
        let says = |column: &usize| self.table.rows.iter().any(|row| !row[*column].to_string().is_empty());
        let mut kept = columns(&["case [text]", "status [text]"]);
        kept.extend(columns(&["remark [text]"]).iter().filter(|column| says(column)));
        kept.extend(self.results.iter().take(OPEN));
        kept.extend(columns(&["wall seconds [s]"]));
        let mut first = Table::new(kept.iter().map(|&column| self.table.header[column].clone()));
        for row in &self.table.rows {
            first.push(kept.iter().map(|&column| row[column].clone()));
        }
        if first.rows.is_empty() {
            return Vec::new();
        }
        let mut block = shown(&first);
        let status = self.table.texts("status").unwrap_or_default();
        let remark = self.table.texts("remark").unwrap_or_default();
        if let Block::Table(grid) = &mut block {
            for (i, (tone, _)) in grid.rows.iter_mut().enumerate() {
                *tone = match (status.get(i).map(String::as_str), remark.get(i).map(String::as_str)) {
                    (Some("failed" | "missing"), _) => Tone::Bad,
                    (Some("interrupted"), _) => Tone::Warning,
                    (_, Some(remark)) if !remark.is_empty() => Tone::Warning,
                    _ => Tone::Plain,
                };
            }
        }
        let mut blocks = vec![block];
        if self.results.len() > OPEN {
            blocks.push(folded("Every number of every case", vec![shown(self.table)]));
        }
        blocks
    }
}

/// A point of a curve over the seeds that it was tried with.
struct Point {
    x: f64,
    mean: f64,
    least: f64,
    largest: f64,
    count: f64,
}

impl Point {
    fn new(x: f64, value: f64) -> Self {
        let mut point = Self { x, mean: f64::NAN, least: f64::NAN, largest: f64::NAN, count: 0.0 };
        point.take(value);
        point
    }

    /// A case without this result, such as one that failed, says nothing.
    fn take(&mut self, value: f64) {
        if value.is_finite() {
            self.count += 1.0;
            let before = if self.count > 1.0 { self.mean } else { 0.0 };
            self.mean = before + (value - before) / self.count;
            self.least = self.least.min(value);
            self.largest = self.largest.max(value);
        }
    }
}

/// Strips of the cases that kept snapshots.
fn picture_blocks(source: &mut Source, table: &Table) -> Vec<Block> {
    const MOST: usize = 6;
    let names = table.texts("case").unwrap_or_default();
    let mut blocks = Vec::new();
    let folders = folders(table);
    for (i, (name, folder)) in names.iter().zip(&folders).enumerate() {
        let mut case = source.inside(folder);
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
