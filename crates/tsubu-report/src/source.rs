//! A finished folder as the reports read it: every file may be missing, and what is missing is said.

use std::path::{Path, PathBuf};

use tsubu_frame::{FileError, Summary, Table, csv::split_unit};

use crate::figure::{Figure, Mark};
use crate::page::{Block, Grid, Report, Tone, folded};
use crate::quantity::prefix;
use crate::text::short;

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
    /// What the run warned of.
    warnings: Vec<String>,
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

    /// The summary of a run, which must have one.
    pub fn summary(&mut self) -> Option<Summary> {
        if !self.has("summary.json") {
            self.notes.push("There is no summary.json: the run has not ended, or was killed.".into());
            return None;
        }
        let read = Summary::read(&self.dir.join("summary.json"));
        let summary = self.told(read)?;
        self.stages = summary.stages.iter().map(|stage| (stage.begin, stage.name.clone())).collect();
        self.warnings.clone_from(&summary.warnings);
        Some(summary)
    }

    /// The summary of a study, which has none before its runs are done.
    pub fn summary_of_study(&mut self) -> Option<Summary> {
        if self.has("summary.json") { self.summary() } else { None }
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

    /// The notes and what the run warned of, as blocks for the head of the page.
    pub fn note_blocks(&mut self) -> Vec<Block> {
        self.damage.extend_from_slice(&self.notes);
        let all = self.notes.drain(..).chain(self.nothing_seen.drain(..)).chain(self.warnings.drain(..));
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
                    let (factor, unit) = prefix(unit, largest);
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
