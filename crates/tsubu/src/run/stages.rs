//! A run of several stages: when one is over, and how the next begins.

use super::steady::Steady;
use super::told::meant;
use super::{Run, RunError, steps};
use crate::check;
use crate::engine::{self, Engine, Note, Refusal, Verdict};
use crate::ledger::Account;
use crate::partner::Hosts;
use crate::watch::Watches;
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;
use tsubu_frame::csv::split_unit;
use tsubu_frame::state::MissingSection;
use tsubu_frame::summary::StageSpan;
use tsubu_frame::{RunFolder, State, Summary};
use tsubu_scene::Plan;
use tsubu_scene::plan::Until;

/// The stages of a run and what has become of those that are over.
pub(super) struct Stages<'a> {
    /// Their plans; of most scenes one.
    pub plans: &'a [Plan],
    /// Which of them the run is in.
    at: usize,
    /// What `check` says of each that has begun.
    pub verdicts: String,
    told: Told,
    /// What is known of the hosts of this stage.
    pub steady: Steady,
    /// The columns of the history, those of all stages.
    pub columns: Vec<String>,
    /// Where they stand in a row of this stage; empty: in order.
    places: Vec<Option<usize>>,
}

/// What is told of stages that are over.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Told {
    spans: Vec<StageSpan>,
    results: Summary,
}

/// Sections of a checkpoint: the stage it is in; what was told of those before.
pub(super) const AT: &str = "run.stage";
const TOLD: &str = "run.stages";

impl<'a> Stages<'a> {
    pub(super) fn new(plans: &'a [Plan], engine: &dyn Engine, hosts: &Hosts) -> Self {
        let verdicts = check::verdict(&plans[0], hosts, engine).to_string();
        let mut stages = Self {
            plans,
            at: 0,
            verdicts,
            told: Told::default(),
            steady: Steady::new(&plans[0], 0),
            columns: Vec::new(),
            places: Vec::new(),
        };
        if let Some(name) = stages.name() {
            stages.verdicts = format!("stage {name}\n{}", stages.verdicts);
        }
        stages
    }

    /// The number of the present stage.
    pub(super) fn at(&self) -> usize {
        self.at
    }

    pub(super) fn is_last(&self) -> bool {
        self.at + 1 == self.plans.len()
    }

    /// The name of the present stage, where a scene has stages.
    pub(super) fn name(&self) -> Option<&str> {
        self.plans[self.at].stage.get(self.at).map(|stage| stage.name.as_str())
    }

    /// How much of a run is done, with this share of the present stage.
    pub(super) fn share_done(&self, share: f64) -> f64 {
        let lengths = |plans: &[Plan]| plans.iter().map(|plan| plan.duration).sum::<f64>();
        let done = lengths(&self.plans[..self.at]) + share * self.plans[self.at].duration;
        done / lengths(self.plans)
    }

    /// The results of stages that are over.
    pub(super) fn tell(&self, summary: &mut Summary) {
        summary.stages.clone_from(&self.told.spans);
        summary.take(None, self.told.results.clone());
    }

    pub(super) fn save(&self, state: &mut State) {
        self.steady.save(state);
        if self.plans.len() > 1 {
            state.put_integer(AT, vec![self.at as i64]);
            // Plain numbers and texts make JSON in any case.
            state.put_text(TOLD, serde_json::to_string(&self.told).unwrap_or_default());
        }
    }
}

/// Engine and hosts go over from one plan to the next; gives what they hold more by it [J].
pub(super) fn change(engine: &mut dyn Engine, hosts: &mut Hosts, plans: [&Plan; 2]) -> Result<f64, RunError> {
    let before = engine::energies(engine, hosts).total();
    hosts.change(&plans[1].hosts, engine.time());
    engine.change(plans, hosts)?;
    Ok(engine::energies(engine, hosts).total() - before)
}

/// The stage that a checkpoint is of.
pub(super) fn stage_of(state: &State, plans: &[Plan]) -> Result<usize, MissingSection> {
    if plans.len() <= 1 {
        return Ok(0);
    }
    match state.integer(AT)? {
        &[at] if (at as usize) < plans.len() => Ok(at as usize),
        _ => Err(MissingSection { name: AT.to_owned(), kind: "integer" }),
    }
}

impl Run<'_> {
    /// Columns of the history: those of the first stage, then what others watch beside that. A stage that ends by another one is refused.
    pub(super) fn columns(&self) -> Result<Vec<String>, RunError> {
        let mut columns = self.header();
        for plan in self.stages.plans {
            let more = Watches::new(plan, &*self.engine).header();
            let more: Vec<String> = more.into_iter().filter(|column| !columns.contains(column)).collect();
            columns.extend(more);
        }
        let names = || columns.iter().map(|column| split_unit(column).0);
        for (index, stage) in self.plan.stage.iter().enumerate() {
            let Some(name) = stage.until.as_ref().and_then(|until| until.result.as_ref()) else { continue };
            if !names().any(|known| known == name) {
                let text = format!("the history has no column `{name}`{}", meant(name, names()));
                let key = format!("stage.{index}.until.result");
                let notes = vec![Note { key, verdict: Verdict::Refused, text }];
                return Err(RunError::Open(Refusal { method: self.plan.method.name(), notes }.into()));
            }
        }
        Ok(columns)
    }

    /// A row of this stage in the columns of the history.
    pub(super) fn in_columns(&self, row: Vec<f64>) -> Vec<f64> {
        if self.stages.places.is_empty() {
            return row;
        }
        self.stages.places.iter().map(|place| place.map_or(f64::NAN, |at| row[at])).collect()
    }

    /// Finds where the columns stand in the rows of this stage.
    pub(super) fn find_places(&mut self) {
        let (columns, here) = (&self.stages.columns, self.header());
        let place = |column: &String| here.iter().position(|name| name == column);
        self.stages.places = if *columns == here { Vec::new() } else { columns.iter().map(place).collect() };
    }

    /// Whether what ends the present stage has come true, by a row of the history.
    pub(super) fn over(&self, row: &[f64]) -> bool {
        let stage = self.plan.stage.get(self.stages.at);
        let Some(until) = stage.and_then(|stage| stage.until.as_ref()) else { return false };
        let Until { kinetic_energy, kinetic_over_potential, host_steady, result, above, below, inserted, removed } =
            until;
        let energies = engine::energies(&*self.engine, &self.hosts);
        let kinetic = energies.kinetic + energies.rotational;
        let traffic = |what: &str| -> u64 {
            let all = self.engine.traffic();
            all.iter().filter(|(name, _)| name.starts_with(what)).map(|(_, grains)| grains).sum()
        };
        let value = result.as_ref().and_then(|name| {
            let at = self.stages.columns.iter().position(|column| split_unit(column).0 == name)?;
            row.get(at).copied()
        });
        kinetic_energy.is_none_or(|limit| kinetic < limit * self.engine.grains() as f64)
            && kinetic_over_potential.is_none_or(|limit| kinetic < limit * energies.potential.abs())
            && host_steady.is_none_or(|share| self.stages.steady.within(share))
            && above.is_none_or(|limit| value.is_some_and(|value| value > limit))
            && below.is_none_or(|limit| value.is_some_and(|value| value < limit))
            && inserted.is_none_or(|grains| traffic("stream ") >= grains)
            && removed.is_none_or(|grains| traffic("removal ") >= grains)
    }

    /// Goes over to the next stage at this moment.
    pub(super) fn next_stage(&mut self, folder: &RunFolder) -> Result<(), RunError> {
        let mut seen = Summary::default();
        self.tell(&mut seen);
        self.stages.told.results.take(None, seen);
        let span = self.span();
        if span.ended == "at-most" {
            let text = format!("stage `{}` ended by `at-most`: its `until` did not come true", span.name);
            self.stages.told.results.warnings.push(text);
        }
        self.stages.told.spans.push(span);
        self.watches.sync()?;
        let stored = self.change_plan()?;
        self.ledger.post(Account::Stages, stored);
        self.measured = self.measured.next();
        let watches = Watches::new(self.plan, &*self.engine);
        let earlier = std::mem::replace(&mut self.watches, watches);
        self.watches.go_on(earlier, folder)?;
        self.judge_stage();
        folder.write("check.txt", self.stages.verdicts.as_bytes())?;
        // What is there at the begin of the stage is looked at; the row of this moment has been written.
        self.watches.look(&*self.engine, &self.hosts)?;
        Ok(())
    }

    /// Engine and hosts go over to the plan of the next stage; gives what they hold more by it [J].
    fn change_plan(&mut self) -> Result<f64, RunError> {
        let (earlier, now) = (self.plan, &self.stages.plans[self.stages.at + 1]);
        let stored = change(&mut *self.engine, &mut self.hosts, [earlier, now])?;
        self.stages.at += 1;
        self.plan = now;
        self.stages.steady = Steady::new(now, self.stages.at);
        let (begin, _) = self.engine.stage_begin();
        self.last = begin + steps(now, &*self.engine)?;
        self.find_places();
        Ok(stored)
    }

    /// Brings a run that was just opened to the stage that a checkpoint is of.
    pub(super) fn enter_stage(&mut self, state: &State) -> Result<(), RunError> {
        let at = stage_of(state, self.stages.plans)?;
        while self.stages.at < at {
            self.change_plan()?;
            self.watches = Watches::new(self.plan, &*self.engine);
            self.judge_stage();
        }
        self.stages.steady.load(state)?;
        if self.stages.plans.len() > 1 {
            let missing = |_| MissingSection { name: TOLD.to_owned(), kind: "text" };
            self.stages.told = serde_json::from_str(state.text(TOLD)?).map_err(missing)?;
        }
        Ok(())
    }

    /// After the state of a checkpoint was taken: the steps of its stage count from where it began.
    pub(super) fn place_stage(&mut self) -> Result<(), RunError> {
        let (begin, _) = self.engine.stage_begin();
        self.last = begin + steps(self.plan, &*self.engine)?;
        self.watches.begin(begin);
        Ok(())
    }

    fn judge_stage(&mut self) {
        let name = self.stages.name().unwrap_or_default().to_owned();
        let verdict = check::verdict(self.plan, &self.hosts, &*self.engine);
        let _ = write!(self.stages.verdicts, "\nstage {name}\n{verdict}");
    }

    /// The present stage as far as it has come.
    pub(super) fn span(&self) -> StageSpan {
        let (first, begin) = self.engine.stage_begin();
        let steps_done = self.engine.steps() - first;
        let full = steps(self.plan, &*self.engine).unwrap_or_default();
        let has_until = self.plan.stage.get(self.stages.at).is_some_and(|stage| stage.until.is_some());
        let ended = match (has_until, steps_done < full) {
            (false, _) => "duration",
            (true, true) => "until",
            (true, false) => "at-most",
        };
        let name = self.stages.name().unwrap_or_default().to_owned();
        StageSpan { name, begin, end: self.engine.time(), steps: steps_done, ended: ended.to_owned() }
    }
}
