//! The work of a design: search, confirm, draw.

use super::answer::answer;
use super::search::{self, Guess, Round};
use super::{Done, Key, Measured, Record, Task};
use crate::engine::OpenError;
use crate::interrupt::{Interrupt, Watcher};
use crate::run::RunError;
use crate::study::cases::CasesError;
use crate::study::journal::Exact;
use crate::study::response::{measure, refine, tasks};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicU32, Ordering};
use tsubu_frame::State;
use tsubu_scene::plan::Goal;

/// Seeds that the best gets at a time until it is known well enough.
const MORE_SEEDS: u32 = 4;

/// What came of a design.
pub(super) struct Found {
    pub best: usize,
    /// Whether all neighbours of the best are confirmed, too.
    pub confirmed: bool,
    /// Whether nothing better was expected when the search ended.
    pub searched: bool,
    /// Whether it ended because the best is known as well as `until` asks and nothing better is expected.
    pub ended_by_until: bool,
}

/// What came of a run.
type Ran = (Key, Result<Measured, RunError>);

/// A design on its way.
pub(super) struct Work<'a> {
    pub task: &'a Task<'a>,
    known: Done,
    record: Record<'a>,
    watcher: &'a Watcher<'a>,
    pub done: Done,
    pub failures: BTreeMap<usize, RunError>,
    /// What was measured by the cheap method.
    pub cheaply: Done,
    /// Logarithm of what that is expected to give, with its deviation, candidate by candidate; empty before it is known.
    pub cheap: Vec<[f64; 2]>,
    /// What the surrogate had expected of a candidate before it was measured, in the order of the search: logarithm and deviation.
    pub expected: Vec<(usize, Option<[f64; 2]>)>,
    /// Where runs are done apart, which.
    pub apart: Option<Share>,
}

/// What a process does of a round whose runs are done apart.
#[derive(Default)]
pub(super) struct Share {
    /// Runs that failed elsewhere, and what was said of them.
    pub lost: BTreeMap<Key, String>,
    /// The run that is done here, if any.
    pub only: Option<Key>,
    /// All that the round asks for and has no result.
    pub asked: Vec<Key>,
}

impl<'a> Work<'a> {
    pub fn new(task: &'a Task<'a>, known: Done, record: Record<'a>, watcher: &'a Watcher<'a>) -> Self {
        Self {
            task,
            known,
            record,
            watcher,
            done: Done::new(),
            failures: BTreeMap::new(),
            cheaply: Done::new(),
            cheap: Vec::new(),
            expected: Vec::new(),
            apart: None,
        }
    }

    /// Searches, confirms, and draws the curves; nothing where it was interrupted or no candidate can be.
    pub fn design(&mut self) -> Result<Option<Found>, CasesError> {
        let mut share = 0.5;
        let (best, confirmed, searched, ended_by_until) = loop {
            let Some(searched) = self.search(share)? else { return Ok(None) };
            let Some((best, confirmed)) = self.confirm()? else { return Ok(None) };
            let Some(until) = self.task.wanted.until else { break (best, confirmed, searched, false) };
            let (round, known) = (self.next(), self.doubt(best) <= until);
            let expected = !round.chosen.is_empty() && (round.better || round.beside > 0);
            let left = self.left(1.0);
            if known && !expected || left < 1.0 {
                break (best, confirmed, !expected, known && !expected);
            }
            // What is not known of the best comes first: seeds cost the least.
            if !known {
                let (first, number) = (self.seeds(best), left.floor().min(f64::from(MORE_SEEDS)) as u32);
                let keys = self.answers(best, first + number).filter(|key| key.seed >= first).collect();
                if !self.measure(keys)? {
                    return Ok(None);
                }
            }
            share = 1.0;
        };
        if !self.curves(best)? {
            return Ok(None);
        }
        Ok(Some(Found { best, confirmed, searched, ended_by_until }))
    }

    /// Looks for the best with one seed each, until all are measured or this share of the runs is spent, or nothing better is expected where the
    /// scene asks no more. Says whether nothing better was expected at the end; nothing where it was interrupted.
    fn search(&mut self, share: f64) -> Result<Option<bool>, CasesError> {
        let task = self.task;
        let mut round = if self.expected.is_empty() { Round::first(&task.candidates) } else { self.next() };
        loop {
            // As many as the runs that are left allow.
            let mut wanted = round.chosen;
            if task.wanted.until.is_some() && !round.better {
                wanted.truncate(round.beside);
            }
            let all = wanted.is_empty();
            wanted.truncate(self.left(share).floor().max(0.0) as usize);
            if wanted.is_empty() {
                return Ok(Some(all || !round.better));
            }
            let guess = Guess::fit(&task.candidates, &self.values(), &self.cheap);
            let expected: Vec<_> =
                wanted.iter().map(|one| (*one, guess.as_ref().map(|guess| guess.at(*one)))).collect();
            self.expected.extend(expected);
            let keys = wanted.iter().flat_map(|index| self.answers(*index, 1)).collect();
            if !self.measure(keys)? {
                return Ok(None);
            }
            if task.wanted.cheap.is_some() && self.cheap.is_empty() && !self.look_cheaply()? {
                return Ok(None);
            }
            round = self.next();
        }
    }

    /// What would be measured next.
    fn next(&self) -> Round {
        let wanted = &self.task.wanted;
        let within = wanted.until.unwrap_or(wanted.within);
        search::next(&self.task.candidates, &self.values(), &self.cheap, &self.closed(), within)
    }

    /// Candidates that this share of the runs still allows.
    fn left(&self, share: f64) -> f64 {
        (f64::from(self.task.wanted.runs) * share - f64::from(self.runs())) / self.runs_of_one()
    }

    /// Seeds with which a candidate was measured.
    fn seeds(&self, candidate: usize) -> u32 {
        let seeds = self.done.keys().filter(|key| key.candidate == candidate).map(|key| key.seed + 1);
        seeds.max().unwrap_or(0)
    }

    /// Measures the best, its neighbours, and the lowest with all seeds, until it stays the best or the runs are spent; and the scene as it
    /// is written. Says which is best and whether its neighbours are all confirmed.
    fn confirm(&mut self) -> Result<Option<(usize, bool)>, CasesError> {
        let task = self.task;
        let seeds = task.wanted.seeds;
        if !self.measure(self.answers(task.as_written(), seeds).collect())? {
            return Ok(None);
        }
        loop {
            let Some(best) = self.best() else { return Ok(None) };
            let mut around = vec![best];
            // The lowest that was measured is no neighbour of the best where the surrogate takes it for a lucky run, or for an island.
            around.extend(self.lowest().into_iter().chain(task.candidates.neighbours(best)));
            let mut seen = BTreeSet::new();
            let open: Vec<Vec<Key>> = around
                .into_iter()
                .filter(|index| seen.insert(*index) && !self.failures.contains_key(index))
                .map(|index| self.answers(index, seeds).filter(|key| !self.done.contains_key(key)).collect())
                .filter(|keys: &Vec<Key>| !keys.is_empty())
                .collect();
            let confirmed = open.is_empty();
            let mut left = self.left(1.0) * task.wanted.levels.len() as f64;
            // The best itself is always confirmed.
            let itself = open.first().is_some_and(|keys| keys[0].candidate == best);
            let mut keys = Vec::new();
            for (index, more) in open.into_iter().enumerate() {
                left -= more.len() as f64;
                if left >= 0.0 || itself && index == 0 {
                    keys.extend(more);
                }
            }
            if keys.is_empty() {
                keys = self.missing(best);
            }
            if keys.is_empty() {
                return Ok(Some((best, confirmed)));
            }
            if !self.measure(keys)? {
                return Ok(None);
            }
        }
    }

    /// The curve of the scene as it is written, to be compared with that of the best.
    fn curves(&mut self, best: usize) -> Result<bool, CasesError> {
        for candidate in [self.task.as_written(), best] {
            loop {
                let keys = self.curve(candidate, 0, 0);
                if keys.is_empty() {
                    break;
                }
                if !self.measure(keys)? {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }

    /// What is still missing of the whole curves of a candidate whose peak was found in few runs: those of its first seed, and of all where
    /// they show that it has a higher peak elsewhere.
    fn missing(&self, candidate: usize) -> Vec<Key> {
        let wanted = &self.task.wanted;
        if wanted.goal != Goal::Peak {
            return Vec::new();
        }
        let of_seed = |seed: u32| (0..wanted.levels.len()).flat_map(move |level| self.curve(candidate, level, seed));
        let first: Vec<Key> = of_seed(0).collect();
        let of_first = self.done.iter().filter(|(key, _)| key.candidate == candidate && key.seed == 0);
        let height = |answers: bool| {
            let heights = of_first.clone().filter(|(key, _)| key.ratio.is_none() == answers);
            heights.map(|(key, measured)| measured.rms() / wanted.levels[key.level]).fold(0.0, f64::max)
        };
        if !first.is_empty() || height(false) <= height(true) * (1.0 + wanted.within) {
            return first;
        }
        (1..self.seeds(candidate).max(wanted.seeds)).flat_map(of_seed).collect()
    }

    /// What is still missing of a curve: the frequencies that are asked for, then those where it bends.
    fn curve(&self, candidate: usize, level: usize, seed: u32) -> Vec<Key> {
        let key = |ratio| Key { candidate, level, seed, ratio: Some(Exact(ratio)), cheap: false };
        let Some(response) = &self.task.plan(candidate).response else { return Vec::new() };
        if self.failures.contains_key(&candidate) {
            return Vec::new();
        }
        let asked = response.frequency_ratio.iter().map(|ratio| key(*ratio));
        let asked: Vec<Key> = asked.filter(|key| !self.done.contains_key(key)).collect();
        if !asked.is_empty() {
            return asked;
        }
        let of_it = self
            .done
            .iter()
            .filter(|(other, _)| (other.candidate, other.level, other.seed) == (candidate, level, seed));
        let known: Vec<(f64, f64)> = of_it.filter_map(|(key, point)| Some((key.ratio?.0, point.rms()))).collect();
        let more = response.peak_within.map(|within| refine::next(&known, within)).unwrap_or_default();
        more.into_iter().map(key).collect()
    }

    fn answers(&self, candidate: usize, seeds: u32) -> impl Iterator<Item = Key> + use<> {
        let levels = self.task.wanted.levels.len();
        (0..seeds).flat_map(move |seed| {
            (0..levels).map(move |level| Key { candidate, level, seed, ratio: None, cheap: false })
        })
    }

    /// Runs that were spent, those of the cheap method by their computing time.
    pub fn runs(&self) -> u32 {
        self.done.values().map(Measured::runs).sum::<u32>() + self.cheap_cost().ceil() as u32
    }

    /// What a candidate takes with one seed, at all levels.
    fn runs_of_one(&self) -> f64 {
        /// Before anything is known.
        const EXPECTED: f64 = 4.0;
        let answers = self.done.iter().filter(|(key, _)| key.ratio.is_none()).map(|(_, answer)| answer.runs());
        let one = match answers.clone().count() {
            0 => EXPECTED,
            number => f64::from(answers.sum::<u32>()) / number as f64,
        };
        one * self.task.wanted.levels.len() as f64
    }

    /// The settled beds of these, each once: all points of a curve begin from one. A candidate whose grains do not settle is out; one that the cheap
    /// method cannot begin with is not measured by it.
    fn beds(&mut self, keys: &[Key]) -> Result<BTreeMap<Key, State<'static>>, CasesError> {
        let task = self.task;
        let wanted: BTreeSet<Key> = keys.iter().map(Key::bed).collect();
        let settled: Vec<_> =
            wanted.into_par_iter().map(|key| (key, tasks::bed(&task.driven(&key), key.seed))).collect();
        let mut beds = BTreeMap::new();
        for (key, bed) in settled {
            match bed {
                Ok(bed) => drop(beds.insert(key, bed)),
                Err(_) if key.cheap => {}
                Err(error @ OpenError::Settling(_)) => {
                    self.failures.entry(key.candidate).or_insert(error.into());
                }
                Err(error) => return Err(CasesError::Run { case: task.name(key.candidate), error: error.into() }),
            }
        }
        Ok(beds)
    }

    /// Measures all of these, side by side, but for what is known; says whether it came to the end. A candidate with a run that fails is
    /// out; the others go on.
    pub(super) fn measure(&mut self, keys: Vec<Key>) -> Result<bool, CasesError> {
        let mut new: Vec<Key> = keys.iter().filter(|key| !self.known.contains_key(key)).copied().collect();
        for key in keys {
            if let Some(measured) = self.known.get(&key) {
                self.keep(key, measured.clone());
            }
        }
        // The round ends here where it waits for others.
        let waits = self.share(&mut new);
        if new.is_empty() {
            return Ok(!waits);
        }
        let (task, watcher, record) = (self.task, self.watcher, self.record);
        let counter = AtomicU32::new(self.runs());
        let beds = self.beds(&new)?;
        let run = |key: &Key| -> Result<Option<Ran>, CasesError> {
            let bed = beds.get(&key.bed());
            let Some(bed) = bed.filter(|_| !watcher.interrupt.asked()) else { return Ok(None) };
            match one(task, key, bed, watcher.interrupt) {
                Ok(None) => Ok(None),
                Ok(Some(measured)) => {
                    record(key, &measured)?;
                    let runs = if key.cheap { 0 } else { measured.runs() };
                    let done = counter.fetch_add(runs, Ordering::Relaxed) + runs;
                    (watcher.progress)((f64::from(done) / f64::from(task.wanted.runs)).min(1.0));
                    Ok(Some((*key, Ok(measured))))
                }
                Err(error @ RunError::Fault(_)) => Ok(Some((*key, Err(error)))),
                Err(error) => Err(CasesError::Run { case: task.name(key.candidate), error }),
            }
        };
        let ran: Result<Vec<_>, CasesError> = new.par_iter().map(run).collect();
        for (key, came) in ran?.into_iter().flatten() {
            match came {
                Ok(measured) => self.keep(key, measured),
                Err(_) if key.cheap => {}
                Err(error) => drop(self.failures.entry(key.candidate).or_insert(error)),
            }
        }
        Ok(!waits && !watcher.interrupt.asked())
    }

    /// Leaves of these what is to be run here; says whether the round waits for runs that are done apart.
    fn share(&mut self, new: &mut Vec<Key>) -> bool {
        let Some(share) = &mut self.apart else { return false };
        new.retain(|key| {
            let Some(told) = share.lost.get(key) else { return true };
            if !key.cheap {
                self.failures.entry(key.candidate).or_insert_with(|| RunError::Elsewhere(told.clone()));
            }
            false
        });
        share.asked.clone_from(new);
        new.retain(|key| share.only == Some(*key));
        !share.asked.is_empty()
    }

    fn keep(&mut self, key: Key, measured: Measured) {
        let done = if key.cheap { &mut self.cheaply } else { &mut self.done };
        done.insert(key, measured);
    }
}

fn one(task: &Task<'_>, key: &Key, bed: &State, interrupt: &Interrupt) -> Result<Option<Measured>, RunError> {
    let plan = task.driven(key);
    let Some(ratio) = key.ratio else {
        let found = answer(&plan, task.wanted.goal, task.reference, key.seed, bed, interrupt)?;
        return Ok(found.map(Measured::Answer));
    };
    let Some(response) = &plan.response else { return Ok(None) };
    let point = measure(&plan, response, key.seed, bed, task.reference * ratio.0, &[], interrupt)?;
    Ok(point.map(|point| Measured::Point(Box::new(point))))
}
