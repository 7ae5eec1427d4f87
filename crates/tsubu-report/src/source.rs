//! A finished folder as the reports read it: every file may be missing, and what is missing is said.

use std::path::{Path, PathBuf};

use tsubu_frame::summary::mean_beside;
use tsubu_frame::{FileError, ResultValue, Summary, Table, csv::split_unit, unit::for_people};

use crate::claims::range;
use crate::figure::{Axis, Bars, Figure, Mark};
use crate::page::{Block, Card, Grid, Report, Tone};
use crate::text::{count, duration, short};

/// Lists up to this length are told in numbers.
const FEW: usize = 6;

/// A folder, what went amiss in reading it, and the figures made on the way.
#[derive(Debug, Default)]
pub(crate) struct Source {
    pub dir: PathBuf,
    pub notes: Vec<String>,
    /// Watches that saw nothing: no damage.
    nothing_seen: Vec<String>,
    /// The notes that stand on the page already.
    pub damage: Vec<String>,
    pub files: Vec<(String, Vec<u8>)>,
    /// When the stages of the run began [s], for figures against time.
    stages: Vec<(f64, String)>,
}

impl Source {
    pub fn new(dir: &Path) -> Self {
        Self { dir: dir.to_owned(), ..Self::default() }
    }

    /// A view of a folder inside, for comparisons and sweeps.
    pub fn inside(&self, name: &str) -> Self {
        Self::new(&self.dir.join(name))
    }

    /// The scene as it was run; empty where it cannot be read.
    fn scene(&self) -> toml::Table {
        self.text("scene.toml").unwrap_or_default().parse().unwrap_or_default()
    }

    /// The names in a table of the scene, as `particles`, in the order of the alphabet.
    pub fn names(&self, table: &str) -> Vec<String> {
        let scene = self.scene();
        let named = scene.get(table).and_then(toml::Value::as_table);
        let mut names: Vec<String> = named.into_iter().flat_map(|table| table.keys().cloned()).collect();
        names.sort();
        names
    }

    /// The scene's title, else the name of the folder.
    pub fn title(&self) -> String {
        let scene = self.scene();
        if let Some(title) = scene.get("title").and_then(toml::Value::as_str).filter(|title| !title.is_empty()) {
            return title.to_owned();
        }
        let full = std::fs::canonicalize(&self.dir).unwrap_or_else(|_| self.dir.clone());
        full.file_name().map_or_else(|| "tsubu".to_owned(), |n| n.to_string_lossy().into_owned())
    }

    pub fn has(&self, name: &str) -> bool {
        self.dir.join(name).exists()
    }

    pub fn summary(&mut self) -> Option<Summary> {
        if !self.has("summary.json") {
            self.notes.push("There is no summary.json: the run has not ended, or was killed.".into());
            return None;
        }
        let read = Summary::read(&self.dir.join("summary.json"));
        let summary = self.told(read)?;
        self.stages = summary.stages.iter().map(|stage| (stage.begin, stage.name.clone())).collect();
        Some(summary)
    }

    /// The value, or a note on why there is none. A report is mailed, its folder is not: the note leaves out where
    /// the folder stands.
    pub fn told<T>(&mut self, read: Result<T, FileError>) -> Option<T> {
        read.map_err(|error| {
            let here = format!("{}/", self.dir.display());
            self.notes.push(error.to_string().replace(&here, ""));
        })
        .ok()
    }

    pub fn table(&mut self, name: &str) -> Option<Table> {
        if !self.has(name) {
            return None;
        }
        let read = Table::read(&self.dir.join(name));
        let table = self.told(read)?;
        if self.text(name).is_some_and(|text| !text.ends_with('\n')) {
            self.notes.push(format!("{name} ends within a line: it was cut off."));
        }
        if table.rows.is_empty() {
            // A hop ends, a grain leaves: what a watch waits for may not have happened.
            let list = if name.starts_with("watch/") { &mut self.nothing_seen } else { &mut self.notes };
            list.push(format!("{name} has no rows."));
            return None;
        }
        Some(table)
    }

    pub fn text(&self, name: &str) -> Option<String> {
        let bytes = std::fs::read(self.dir.join(name)).ok()?;
        Some(String::from_utf8_lossy(&bytes).into_owned())
    }

    /// A figure on the page and as a file; nothing if there is nothing to see.
    pub fn figure(&mut self, name: &str, figure: &Figure, caption: &str) -> Option<Block> {
        if figure.is_idle() {
            return None;
        }
        let stages = self.stages.iter().filter(|_| figure.x.label == "time" && !figure.x.log);
        let marked = |figure: Figure, (at, name): &(f64, String)| figure.marked(Mark::vertical(*at, name));
        let figure = stages.fold(figure.clone(), marked);
        self.files.push((format!("figures/{name}.svg"), figure.to_svg().into_bytes()));
        Some(Block::Drawing { svg: figure.to_inline_svg(), caption: caption.to_owned() })
    }

    /// The same for a ready drawing.
    pub fn drawing(&mut self, name: &str, svg: String, caption: &str) -> Block {
        let file = crate::figure::on_white(&svg).into_bytes();
        self.files.push((format!("figures/{name}.svg"), file));
        Block::Drawing { svg, caption: caption.to_owned() }
    }

    /// The notes as blocks, for the head of the page.
    pub fn note_blocks(&mut self) -> Vec<Block> {
        self.damage.extend_from_slice(&self.notes);
        let all = self.notes.drain(..).chain(self.nothing_seen.drain(..));
        all.map(|n| Block::Note(Tone::Warning, n)).collect()
    }

    /// Scene and verdict, folded away at the end.
    pub fn scene_and_verdict(&self, report: &mut Report) {
        let mut blocks = Vec::new();
        if let Some(text) = self.text("check.txt") {
            blocks.push(folded("The verdict of tsubu check", vec![Block::Typed(text)]));
        }
        if let Some(text) = self.text("scene.toml") {
            blocks.push(Block::Text(
                "The scene as run, with every default written out: running it again gives the same numbers.".into(),
            ));
            blocks.push(folded("scene.toml", vec![Block::Typed(text)]));
        }
        report.section("Scene", blocks);
    }
}

pub(crate) fn folded(summary: &str, inside: Vec<Block>) -> Block {
    Block::Folded { summary: summary.to_owned(), inside }
}

pub(crate) fn card(label: &str, value: String, unit: &str, note: String, tone: Tone) -> Card {
    Card { label: label.to_owned(), value, unit: unit.to_owned(), note, tone }
}

/// A quantity with the prefix that makes it short.
pub(crate) fn quantity(x: f64, unit: &str) -> (String, String) {
    let (factor, unit) = crate::figure::prefix(unit, x.abs());
    (short(x * factor), if unit == "-" { String::new() } else { unit })
}

/// The same as one text.
pub(crate) fn spoken(x: f64, unit: &str) -> String {
    let (value, unit) = quantity(x, unit);
    if unit.is_empty() { value } else { format!("{value} {unit}") }
}

/// Cards that every summary gives.
/// How a study of many runs ended, for the head of its page.
pub(crate) fn ended(summary: &Summary) -> (Tone, String) {
    let failed = summary.claims.iter().filter(|claim| !claim.pass).count();
    match (summary.status, failed) {
        (tsubu_frame::Status::Finished, 0) => (Tone::Good, "finished".into()),
        (tsubu_frame::Status::Finished, n) => (Tone::Bad, format!("{n} claims failed")),
        (status, _) => (Tone::Warning, status.word().into()),
    }
}

pub(crate) fn summary_cards(summary: &Summary) -> Vec<Card> {
    let residual = summary.energy.residual_relative;
    let closes = if residual.abs() < 1e-3 { Tone::Good } else { Tone::Warning };
    vec![
        card(
            "Grains",
            count(summary.particles),
            "",
            format!("{}, {}-D", method_name(&summary.method), summary.dimension),
            Tone::Plain,
        ),
        card(
            "Simulated",
            short(summary.simulated_seconds),
            "s",
            format!("{} steps of {}", count(summary.steps), spoken(summary.time_step, "s")),
            Tone::Plain,
        ),
        card(
            "Computed in",
            duration(summary.wall_seconds),
            "",
            // A response counts no steps of its own.
            if summary.particle_steps_per_second > 0.0 {
                format!("{} grain-steps/s", short(summary.particle_steps_per_second))
            } else {
                format!("on {} threads", summary.threads)
            },
            Tone::Plain,
        ),
        card("Energy residual", short(residual), "", "of the energy turned over".into(), closes),
    ]
}

/// Name and SI unit of a result; a name may carry its unit itself.
fn named<'a>(summary: &'a Summary, result: &'a str) -> (&'a str, &'a str) {
    match split_unit(result) {
        (name, Some(unit)) => (name, unit),
        (name, None) => (name, summary.unit(result)),
    }
}

/// Results that are single numbers, as cards, in the order in which the scene asks for them. The mean of a watch and its
/// value at the end share a card.
pub(crate) fn result_cards(summary: &Summary, most: usize) -> Vec<Card> {
    let mut cards = Vec::new();
    for (result, value) in summary.results_in_order() {
        // The energy residual is no result to be proud of; the energy has its own card. What came to no number is none.
        let ResultValue::Number(x) = value else { continue };
        if result.contains("residual") || !x.is_finite() {
            continue;
        }
        let claim = summary.claims.iter().find(|claim| claim.name == result);
        if claim.is_none() && mean_beside(result).is_some_and(|mean| summary.results.get(mean).is_some()) {
            continue;
        }
        let (name, unit) = named(summary, result);
        let (value, shown) = quantity(*x, unit);
        let (tone, note) = match (claim, summary.results.get(&format!("{result} final"))) {
            (Some(claim), _) => {
                let tone = if claim.pass { Tone::Good } else { Tone::Bad };
                (tone, format!("claimed: {}", range(claim, unit)))
            }
            (None, Some(ResultValue::Number(last))) => {
                (Tone::Plain, format!("mean; {} at the end", spoken(*last, unit)))
            }
            _ => (Tone::Plain, String::new()),
        };
        cards.push(card(name, value, &shown, note, tone));
    }
    cards.truncate(most);
    cards
}

/// All results as a table. A list is a profile, which a figure shows.
pub(crate) fn results_table(summary: &Summary) -> Option<Block> {
    if summary.results.is_empty() {
        return None;
    }
    let mut grid = Grid::new(["result", "value", "unit"]);
    for (result, value) in summary.results_in_order() {
        let (name, unit) = named(summary, result);
        let (factor, unit) = for_people(unit);
        let value = match value {
            ResultValue::Number(x) => short(x * factor),
            ResultValue::List(list) if list.len() <= FEW => {
                list.iter().map(|x| short(x * factor)).collect::<Vec<_>>().join(", ")
            }
            ResultValue::List(list) => format!("{} values, see figure", list.len()),
        };
        let unit = if unit == "-" { String::new() } else { crate::text::unit(unit) };
        grid.push(Tone::Plain, [name, value.as_str(), unit.as_str()]);
    }
    Some(Block::Table(grid))
}

/// What the run cost.
pub(crate) fn cost_table(runs: &[(&str, &Summary)]) -> Block {
    let mut grid = Grid::new([
        "method",
        "grains",
        "steps",
        "time step [s]",
        "threads",
        "wall time [s]",
        "grain-steps [1/s]",
        "wall / simulated",
    ]);
    for (name, s) in runs {
        grid.push(
            Tone::Plain,
            [
                (*name).to_owned(),
                count(s.particles),
                count(s.steps),
                short(s.time_step),
                s.threads.to_string(),
                short(s.wall_seconds),
                short(s.particle_steps_per_second),
                short(s.wall_seconds / s.simulated_seconds),
            ],
        );
    }
    Block::Table(grid)
}

/// Energy by cause: bars for the eye, the table for the books. Several runs stand side by side.
pub(crate) fn energy_blocks(source: &mut Source, runs: &[(&str, &Summary)]) -> Vec<Block> {
    let mut names: Vec<&str> = Vec::new();
    for (_, summary) in runs {
        for (name, _) in summary.energy.terms.iter() {
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    if names.is_empty() {
        return Vec::new();
    }
    let value = |s: &Summary, name: &str| s.energy.terms.get(name).map_or(f64::NAN, |j| j.0);
    // A bar too short to be seen stands in the table only.
    let largest = names.iter().flat_map(|n| runs.iter().map(|(_, s)| value(s, n).abs())).fold(0.0, f64::max);
    let moved = |name: &&str| runs.iter().any(|(_, s)| value(s, name).abs() > 1e-3 * largest);
    let drawn: Vec<&str> = names.iter().copied().filter(moved).collect();
    let parts = runs.iter().map(|(run, s)| ((*run).to_owned(), drawn.iter().map(|n| value(s, n)).collect())).collect();
    let bars =
        Bars { categories: drawn.iter().map(|n| (*n).to_owned()).collect(), parts, stacked: false, horizontal: true };
    let mut figure = Figure::of_bars("", Axis::new("energy at the end", "J"), bars);
    figure.height = (90 + 30 * drawn.len() as u32 * runs.len().max(1) as u32).clamp(180, 700);
    let mut blocks = Vec::new();
    blocks.extend(source.figure("energy_by_cause", &figure, "Where the energy went, by cause."));
    let mut grid = Grid::new(std::iter::once("cause".to_owned()).chain(
        runs.iter().map(|(run, _)| if runs.len() == 1 { "energy [J]".to_owned() } else { format!("{run} [J]") }),
    ));
    for name in &names {
        let cells = runs.iter().map(|(_, s)| short(value(s, name)));
        grid.push(Tone::Plain, std::iter::once((*name).to_owned()).chain(cells));
    }
    let residuals = runs.iter().map(|(_, s)| short(s.energy.residual_relative));
    grid.push(Tone::Plain, std::iter::once("residual, relative".to_owned()).chain(residuals));
    blocks.push(folded("Energy terms in numbers", vec![Block::Table(grid)]));
    blocks
}

/// A CSV table for the eye: numbers rounded to what can be read.
pub(crate) fn shown(table: &Table) -> Block {
    let scales: Vec<(f64, String)> = table
        .header
        .iter()
        .enumerate()
        .map(|(c, header)| {
            let largest = table.rows.iter().filter_map(|r| r[c].number()).fold(0.0_f64, |a, x| a.max(x.abs()));
            match split_unit(header) {
                (name, Some("text")) => (1.0, name.to_owned()),
                (name, Some("kg")) if largest < 0.1 => (1e3, format!("{name} [g]")),
                (name, Some(unit @ ("m" | "J" | "rad"))) => {
                    let (factor, unit) = crate::figure::prefix(unit, largest);
                    (factor, format!("{name} [{unit}]"))
                }
                _ => (1.0, header.clone()),
            }
        })
        .collect();
    let mut grid = Grid::new(scales.iter().map(|s| s.1.clone()));
    for row in &table.rows {
        let cells = row.iter().zip(&scales).map(|(cell, (factor, _))| match cell {
            tsubu_frame::Cell::Number(x) => short(*x * factor),
            tsubu_frame::Cell::Text(text) => text.clone(),
        });
        grid.push(Tone::Plain, cells);
    }
    Block::Table(grid)
}

/// Versions for the foot of the page.
pub(crate) fn versions(summary: Option<&Summary>) -> Vec<(String, String)> {
    let mut versions = Vec::new();
    if let Some(s) = summary {
        versions.push(("tsubu".to_owned(), s.tsubu_version.clone()));
        if !s.state_hash.is_empty() {
            versions.push(("state hash".to_owned(), s.state_hash.clone()));
        }
    }
    versions.push(("report".to_owned(), env!("CARGO_PKG_VERSION").to_owned()));
    versions
}

/// A method as readers call it.
pub(crate) fn method_name(method: &str) -> &str {
    match method {
        "dem" => "DEM",
        "lattice" => "lattice automaton",
        "cl-ca" => "CL-CA",
        other => other,
    }
}
