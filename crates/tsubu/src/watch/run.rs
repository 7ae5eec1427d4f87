//! The watches of a run: when they look, where their numbers go, what of them a checkpoint holds.

use super::axial::MeanAxis;
use super::means::{Extremes, Means};
use super::{Axes, Sheet, Trigger, Watch, axes, open, wall_load};
use crate::engine::Engine;
use crate::partner::Hosts;
use crate::view::{View, Wants};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;
use tsubu_frame::csv::split_unit;
use tsubu_frame::state::MissingSection;
use tsubu_frame::{FileError, History, Mark, RunFolder, State, Summary};
use tsubu_scene::Plan;

/// What `watch/index.json` says about a watch, for those who draw it.
#[derive(Debug, Serialize)]
struct Entry<'a> {
    name: &'a str,
    kind: &'a str,
    about: String,
    /// Columns of `history.csv`.
    scalars: Vec<String>,
    /// Those of them that are components of an axis.
    axis: Vec<String>,
    /// Its table in the run folder.
    file: Option<String>,
    coordinates: Vec<String>,
    values: Vec<String>,
}

/// All watches of a run, and the walls whose loads are written down in any case: those that move or can be moved.
#[derive(Debug)]
pub struct Watches {
    list: Vec<Watched>,
    walls: Vec<(usize, String)>,
    axes: Axes,
}

#[derive(Debug)]
struct Watched {
    name: String,
    kind: &'static str,
    trigger: Trigger,
    watch: Box<dyn Watch>,
    sheet: Option<Sheet>,
    file: Option<History>,
    /// How far that was when it was last put on the disk.
    mark: Option<Mark>,
    /// Means of the scalars, and of the cells of the table.
    means: [Means; 2],
    /// That of the scalars that are components of an axis.
    axis: Option<MeanAxis>,
    /// The least and the largest of the scalars.
    extremes: Extremes,
    /// What the last look gave.
    last: Vec<f64>,
    /// How often it has looked.
    looks: f64,
}

impl Watched {
    fn column(&self, what: &str) -> String {
        format!("{} {what}", self.name)
    }

    fn entry(&self) -> Entry<'_> {
        let sheet = self.sheet.clone().unwrap_or_default();
        let columns = || self.watch.scalars().into_iter().map(|what| self.column(&what));
        let of_axis = |place: usize| self.axis.as_ref().is_some_and(|axis| axis.has(place));
        Entry {
            name: &self.name,
            kind: self.kind,
            about: self.watch.about().text(),
            scalars: columns().collect(),
            axis: columns().enumerate().filter(|(place, _)| of_axis(*place)).map(|(_, column)| column).collect(),
            file: self.sheet.as_ref().map(|_| file(&self.name)),
            coordinates: sheet.coordinates,
            values: sheet.values,
        }
    }

    fn header(&self) -> Option<Vec<String>> {
        let sheet = self.sheet.as_ref()?;
        let columns = sheet.coordinates.iter().chain(&sheet.values).cloned();
        Some(["time [s]".to_owned()].into_iter().chain(columns).collect())
    }

    /// Of each scalar what stands for the whole: its mean over the looks, of an axis that of the axis, or its last value where that tells
    /// what has been so far.
    fn told(&self) -> Vec<f64> {
        let begins = self.watch.so_far();
        let so_far = |what: &String| begins.iter().any(|begin| what.starts_with(begin));
        let scalars = self.watch.scalars().into_iter().zip(self.means[0].get().zip(&self.last));
        let mut told: Vec<f64> = scalars.map(|(what, (mean, last))| if so_far(&what) { *last } else { mean }).collect();
        if let Some(axis) = &self.axis {
            axis.put(&mut told);
        }
        told
    }

    fn look(&mut self, view: &View) -> Result<(), FileError> {
        let sample = self.watch.take(view);
        self.looks += 1.0;
        self.means[0].take(sample.scalars.iter().copied());
        self.extremes.take(&sample.scalars);
        if let Some(axis) = &mut self.axis {
            axis.take(&sample.scalars);
        }
        self.last = sample.scalars;
        let Some(sheet) = &self.sheet else { return Ok(()) };
        if sheet.steady {
            let cells = sample.rows.iter().flatten().copied().collect::<Vec<_>>();
            self.means[1].take(cells.into_iter());
        }
        let Some(file) = &mut self.file else { return Ok(()) };
        let mut line = vec![view.time];
        for row in &sample.rows {
            line.truncate(1);
            line.extend(row);
            file.append(&line)?;
        }
        Ok(())
    }
}

impl Watches {
    /// The watches of a plan, before their first look.
    pub fn new(plan: &Plan, engine: &dyn Engine) -> Self {
        let list = plan.watch.iter().map(|(name, watch)| {
            let kind = watch.measure.name();
            let trigger = Trigger::new(watch, engine.time_step()).beginning(engine.stage_begin().0);
            let watch = open(&watch.measure, plan);
            let last = vec![f64::NAN; watch.scalars().len()];
            let means = [Means::new(last.len()), Means::default()];
            let first = watch.axis().and_then(|begin| watch.scalars().iter().position(|what| what.starts_with(begin)));
            Watched {
                name: name.clone(),
                kind,
                trigger,
                sheet: watch.sheet(),
                watch,
                file: None,
                mark: None,
                means,
                axis: first.map(|first| MeanAxis::new(first, axes(plan))),
                extremes: Extremes::new(last.len()),
                last,
                looks: 0.0,
            }
        });
        let moves = |wall: &tsubu_scene::plan::Wall| {
            let tsubu_scene::plan::Wall {
                material: _,
                shape: _,
                host,
                interface: _,
                motion,
                rotation,
                servo,
                body,
                until: _,
            } = wall;
            host.is_some() || motion.is_some() || rotation.is_some() || servo.is_some() || body.is_some()
        };
        let walls = plan.walls.iter().enumerate().filter(|(_, (_, wall))| engine.offers().walls && moves(wall));
        let walls = walls.map(|(k, (name, _))| (k, name.clone())).collect();
        Self { list: list.collect(), walls, axes: axes(plan) }
    }

    /// The files that they write.
    pub fn files(&self) -> Vec<String> {
        let tables = self.list.iter().filter(|w| w.sheet.is_some()).map(|w| file(&w.name));
        tables.chain((!self.list.is_empty()).then(|| INDEX.to_owned())).collect()
    }

    /// Makes the files, and a list of what is in them.
    pub fn create(&mut self, folder: &RunFolder) -> Result<(), FileError> {
        for watched in &mut self.list {
            if let Some(header) = watched.header() {
                watched.file = Some(History::create(&folder.file(&file(&watched.name)), &header)?);
            }
        }
        if self.list.is_empty() { Ok(()) } else { folder.write_json(INDEX, &self.index()) }
    }

    /// Goes on in another stage: tables that both stages have grow on, others begin.
    pub fn go_on(&mut self, earlier: Self, folder: &RunFolder) -> Result<(), FileError> {
        let mut files: BTreeMap<String, (Option<Vec<String>>, Option<History>)> =
            earlier.list.into_iter().map(|w| (w.name.clone(), (w.header(), w.file))).collect();
        for watched in &mut self.list {
            let Some(header) = watched.header() else { continue };
            watched.file = match files.remove(&watched.name) {
                Some((before, file)) if before.as_ref() == Some(&header) => file,
                _ => Some(History::create(&folder.file(&file(&watched.name)), &header)?),
            };
        }
        if self.list.is_empty() { Ok(()) } else { folder.write_json(INDEX, &self.index()) }
    }

    /// Their times count from step `begin`, with which the stage began.
    pub fn begin(&mut self, begin: u64) {
        for watched in &mut self.list {
            watched.trigger = watched.trigger.beginning(begin);
        }
    }

    /// Goes on with the files of a run that was cut; the checkpoint was loaded.
    pub fn resume(&mut self, folder: &Path) -> Result<(), FileError> {
        for watched in &mut self.list {
            if let (Some(header), Some(mark)) = (watched.header(), watched.mark) {
                watched.file = Some(History::resume(&folder.join(file(&watched.name)), &header, mark)?);
            }
        }
        Ok(())
    }

    fn index(&self) -> Vec<Entry<'_>> {
        self.list.iter().map(Watched::entry).collect()
    }

    /// The next step at which one of them looks; `u64::MAX` if none does any more.
    pub fn next(&self, now: u64) -> u64 {
        self.list.iter().map(|w| w.trigger.at_or_after(now + 1)).min().unwrap_or(u64::MAX)
    }

    /// Lets all look whose time it is.
    pub fn look(&mut self, engine: &dyn Engine, hosts: &Hosts) -> Result<(), FileError> {
        let step = engine.steps();
        let due = |w: &Watched| w.trigger.due(step);
        let wants = self.list.iter().filter(|w| due(w)).map(|w| w.watch.wants()).reduce(Wants::and);
        let Some(wants) = wants else { return Ok(()) };
        let view = View { hosts: &hosts.list, ..engine.view(wants) };
        self.list.iter_mut().filter(|w| w.trigger.due(step)).try_for_each(|w| w.look(&view))
    }

    /// Columns that they add to the history: loads on walls that move, then what every watch measures.
    pub fn header(&self) -> Vec<String> {
        let walls = self.walls.iter().flat_map(|(_, name)| {
            wall_load::names(self.axes).into_iter().map(move |what| format!("wall {name} {what}"))
        });
        walls.chain(self.scalars()).collect()
    }

    /// Columns of what every watch measures.
    pub fn scalars(&self) -> impl Iterator<Item = String> {
        self.list.iter().flat_map(|w| w.watch.scalars().into_iter().map(|what| w.column(&what)))
    }

    /// What every watch has measured, in the mean over its looks or so far; not a number where it saw nothing.
    pub fn told(&self) -> impl Iterator<Item = f64> {
        self.list.iter().flat_map(Watched::told)
    }

    /// Their values in a row of the history: of walls now, of watches at their last look.
    pub fn row(&self, engine: &dyn Engine) -> Vec<f64> {
        let mut row = Vec::new();
        if !self.walls.is_empty() {
            let view = engine.view(Wants::WALLS);
            row.extend(self.walls.iter().flat_map(|(k, _)| wall_load::values(&view.walls[*k], self.axes)));
        }
        row.extend(self.list.iter().flat_map(|w| &w.last));
        row
    }

    /// Hands all rows to the system.
    pub fn flush(&mut self) -> Result<(), FileError> {
        self.list.iter_mut().filter_map(|watched| watched.file.as_mut()).try_for_each(History::flush)
    }

    /// Hands all rows to the disk, before a checkpoint is written.
    pub fn sync(&mut self) -> Result<(), FileError> {
        for watched in &mut self.list {
            watched.mark = watched.file.as_mut().map(History::sync).transpose()?;
        }
        Ok(())
    }

    /// Means and last values, for the summary; `last`: of the last stage of a run.
    pub fn results(&self, summary: &mut Summary, last: bool) {
        for w in &self.list {
            if w.looks == 0.0 {
                summary.warnings.push(format!("the watch `{}` has not looked once: it begins later", w.name));
            }
            summary.warnings.extend(w.watch.remark(last).map(|remark| format!("the watch `{}`: {remark}", w.name)));
            let means = w.told().into_iter().zip(w.means[0].spreads()).zip(&w.extremes.0).zip(&w.last);
            for (place, (what, (((mean, spread), [least, largest]), last))) in
                w.watch.scalars().iter().zip(means).enumerate()
            {
                let (what, unit) = split_unit(what);
                let unit = unit.unwrap_or("-");
                summary.give(w.column(what), unit, mean);
                let ends = [("spread", spread), ("least", *least), ("largest", *largest), ("final", *last)];
                // Of n and -n neither is the larger.
                let skipped = if w.axis.as_ref().is_some_and(|axis| axis.has(place)) { 3 } else { 0 };
                for (which, value) in ends.into_iter().skip(skipped) {
                    summary.give(w.column(&format!("{what} {which}")), unit, value);
                }
            }
            // Lists of fields over two axes would fill the summary; they are in the table.
            let Some(sheet) = w.sheet.as_ref().filter(|s| s.steady && s.coordinates.len() == 1) else { continue };
            let names: Vec<&String> = sheet.coordinates.iter().chain(&sheet.values).collect();
            let cells: Vec<f64> = w.means[1].get().collect();
            for (k, what) in names.iter().enumerate() {
                let column: Vec<f64> = cells.iter().skip(k).step_by(names.len()).copied().collect();
                let (what, unit) = split_unit(what);
                summary.give(w.column(&format!("{what} profile")), unit.unwrap_or("-"), column);
            }
        }
    }

    /// Writes what a resumed run needs.
    pub fn save(&self, state: &mut State) {
        for w in &self.list {
            let name = format!("watch.{}", w.name);
            state.put_real(&format!("{name}.last"), [&[w.looks], w.last.as_slice()].concat());
            state.put_real(&format!("{name}.extremes"), w.extremes.0.concat());
            for (means, what) in w.means.iter().zip(["scalars", "cells"]) {
                state.put_real(&format!("{name}.{what}"), means.numbers());
            }
            if let Some(axis) = &w.axis {
                state.put_real(&format!("{name}.axis"), axis.numbers());
            }
            if let Some(mark) = w.mark {
                state.put_integer(&format!("{name}.file"), mark.numbers());
            }
            w.watch.save(&name, state);
        }
    }

    /// Takes it back.
    pub fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        for w in &mut self.list {
            let name = format!("watch.{}", w.name);
            let (looks, last) = match state.real(&format!("{name}.last"))? {
                [looks, last @ ..] if last.len() == w.last.len() => (looks, last),
                _ => return Err(MissingSection { name, kind: "real" }),
            };
            (w.looks, w.last) = (*looks, last.to_vec());
            let extremes = state.real(&format!("{name}.extremes"))?.as_chunks::<2>().0;
            if extremes.len() != w.extremes.0.len() {
                return Err(MissingSection { name, kind: "real" });
            }
            w.extremes = Extremes(extremes.to_vec());
            if let Some(axis) = &mut w.axis {
                let key = format!("{name}.axis");
                if !axis.load(state.real(&key)?) {
                    return Err(MissingSection { name: key, kind: "real" });
                }
            }
            for (means, what) in w.means.iter_mut().zip(["scalars", "cells"]) {
                *means = Means::from_numbers(state.real(&format!("{name}.{what}"))?);
            }
            if w.sheet.is_some() {
                let file = format!("{name}.file");
                let mark = Mark::from_numbers(state.integer(&file)?);
                w.mark = Some(mark.ok_or(MissingSection { name: file, kind: "integer" })?);
            }
            w.watch.load(&name, state)?;
        }
        Ok(())
    }
}

/// Says what is where.
const INDEX: &str = "watch/index.json";

/// The table of a watch in the run folder.
fn file(name: &str) -> String {
    format!("watch/{name}.csv")
}
