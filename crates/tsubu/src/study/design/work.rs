//! The work of a design: search, confirm, draw.

use super::answer::answer;
use super::search::{self, Round};
use super::{Done, Key, Measured, Record, Standing, Task};
use crate::engine::OpenError;
use crate::interrupt::{Interrupt, Watcher};
use crate::run::RunError;
use crate::student::interval_of_mean;
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
    /// What the surrogate had expected of a candidate before it was measured, in the order of the search: logarithm and deviation.
    pub expected: Vec<(usize, Option<[f64; 2]>)>,
}

impl<'a> Work<'a> {
    pub fn new(task: &'a Task<'a>, known: Done, record: Record<'a>, watcher: &'a Watcher<'a>) -> Self {
        Self { task, known, record, watcher, done: Done::new(), failures: BTreeMap::new(), expected: Vec::new() }
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
            let surrogate = search::fit(&task.candidates, &self.values());
            let place = |index: &usize| &task.candidates.list[*index].place;
            self.expected.extend(wanted.iter().map(|one| (*one, surrogate.as_ref().map(|fit| fit.at(place(one))))));
            let keys = wanted.iter().flat_map(|index| self.answers(*index, 1)).collect();
            if !self.measure(keys)? {
                return Ok(None);
            }
            round = self.next();
        }
    }

    /// What would be measured next.
    fn next(&self) -> Round {
        let wanted = &self.task.wanted;
        search::next(&self.task.candidates, &self.values(), &self.closed(), wanted.until.unwrap_or(wanted.within))
    }

    /// Candidates that were measured, or tried in vain.
    pub fn closed(&self) -> Vec<usize> {
        let tried = self.expected.iter().map(|one| one.0).chain(self.failures.keys().copied());
        let all: BTreeSet<usize> = self.done.keys().map(|key| key.candidate).chain(tried).collect();
        all.into_iter().filter(|index| *index < self.task.as_written()).collect()
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

    /// Half of a candidate's 95 % interval over its mean; 0 where all seeds give the same.
    pub fn doubt(&self, candidate: usize) -> f64 {
        let Some(standing) = self.standing(candidate) else { return f64::INFINITY };
        standing.interval.map_or(0.0, |[low, high]| 0.5 * (high - low) / standing.rms)
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
            let mut left = (f64::from(task.wanted.runs) - f64::from(self.runs())) / self.runs_of_one()
                * task.wanted.levels.len() as f64;
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
        let key = |ratio| Key { candidate, level, seed, ratio: Some(Exact(ratio)) };
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
        (0..seeds).flat_map(move |seed| (0..levels).map(move |level| Key { candidate, level, seed, ratio: None }))
    }

    /// Runs that were spent.
    pub fn runs(&self) -> u32 {
        self.done.values().map(Measured::runs).sum()
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

    /// What is known of a candidate.
    pub fn standing(&self, candidate: usize) -> Option<Standing> {
        let task = self.task;
        // The highest of each seed and level, with where it is: of an answer, or of a whole curve.
        let mut tops: BTreeMap<(u32, usize), (f64, f64)> = BTreeMap::new();
        let (mut stroke, mut runs, mut found) = (0.0_f64, 0, true);
        for (key, measured) in self.done.iter().filter(|(key, _)| key.candidate == candidate) {
            (stroke, runs) = (stroke.max(measured.stroke()), runs + measured.runs());
            let ratio = match (measured, key.ratio) {
                (Measured::Answer(answer), _) => answer.ratio,
                (Measured::Point(_), Some(ratio)) if task.wanted.goal == Goal::Peak => ratio.0,
                (Measured::Point(_), _) => continue,
            };
            found &= if let Measured::Answer(answer) = measured { answer.found } else { true };
            let rms = measured.rms() / task.wanted.levels[key.level];
            let top = tops.entry((key.seed, key.level)).or_insert((rms, ratio));
            if rms > top.0 {
                *top = (rms, ratio);
            }
        }
        let mut seeds: BTreeMap<u32, f64> = BTreeMap::new();
        for ((seed, _), (rms, _)) in &tops {
            let worst = seeds.entry(*seed).or_insert(0.0);
            *worst = worst.max(*rms);
        }
        let ratio = tops.values().map(|top| top.1).sum::<f64>() / tops.len() as f64;
        let each: Vec<f64> = seeds.into_values().collect();
        let rms = each.iter().sum::<f64>() / each.len() as f64;
        // Beds that are the same bit for bit are one bed.
        let differ = each.windows(2).any(|two| two[0] != two[1]);
        let interval = differ.then(|| interval_of_mean(&each));
        (!each.is_empty()).then_some(Standing { rms, interval, stroke, ratio, seeds: each.len(), runs, found })
    }

    /// All candidates that are measured, with what is to be low.
    pub fn values(&self) -> Vec<(usize, f64)> {
        let measured: BTreeSet<usize> = self.done.keys().map(|key| key.candidate).collect();
        let candidates = measured.into_iter().filter(|index| *index < self.task.as_written());
        candidates
            .filter(|index| !self.failures.contains_key(index))
            .filter_map(|index| Some((index, self.standing(index)?.rms)))
            .collect()
    }

    /// Whether a candidate keeps within what its host may move.
    pub fn fits(&self, standing: &Standing) -> bool {
        self.task.wanted.stroke_limit.is_none_or(|limit| standing.stroke <= limit)
    }

    /// The lowest that was measured within the limits.
    fn lowest(&self) -> Option<usize> {
        let fits = |index: usize| self.standing(index).is_some_and(|standing| self.fits(&standing));
        let values = self.values().into_iter().filter(|(index, _)| fits(*index));
        values.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
    }

    /// The best of those within the limits: by its seeds where it is confirmed, by the surrogate where it is not.
    fn best(&self) -> Option<usize> {
        let task = self.task;
        let values = self.values();
        let surrogate = search::fit(&task.candidates, &values);
        let likely = |(index, value): &(usize, f64)| {
            let standing = self.standing(*index)?;
            let confirmed = standing.seeds >= task.wanted.seeds as usize;
            let guess = surrogate.as_ref().map(|fit| fit.at(&task.candidates.list[*index].place)[0].exp());
            let value = if confirmed { *value } else { guess.unwrap_or(*value) };
            self.fits(&standing).then_some((*index, value))
        };
        values.iter().filter_map(likely).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
    }

    /// The settled beds of these, each once: all points of a curve begin from one. A candidate whose grains do not settle is out.
    fn beds(&mut self, keys: &[Key]) -> Result<BTreeMap<(usize, usize, u32), State>, CasesError> {
        let task = self.task;
        let wanted: BTreeSet<_> = keys.iter().map(|key| (key.candidate, key.level, key.seed)).collect();
        let settle =
            |(candidate, level, seed)| ((candidate, level, seed), tasks::bed(&task.driven(candidate, level), seed));
        let settled: Vec<_> = wanted.into_par_iter().map(settle).collect();
        let mut beds = BTreeMap::new();
        for (place, bed) in settled {
            match bed {
                Ok(bed) => drop(beds.insert(place, bed)),
                Err(error @ OpenError::Settling(_)) => drop(self.failures.entry(place.0).or_insert(error.into())),
                Err(error) => return Err(CasesError::Run { case: task.name(place.0), error: error.into() }),
            }
        }
        Ok(beds)
    }

    /// Measures all of these, side by side, but for what is known; says whether it came to the end. A candidate with a run that fails is
    /// out; the others go on.
    fn measure(&mut self, keys: Vec<Key>) -> Result<bool, CasesError> {
        let new: Vec<Key> = keys.iter().filter(|key| !self.known.contains_key(key)).copied().collect();
        for key in keys {
            if let Some(measured) = self.known.get(&key) {
                self.done.insert(key, measured.clone());
            }
        }
        let (task, watcher, record) = (self.task, self.watcher, self.record);
        let counter = AtomicU32::new(self.runs());
        let beds = self.beds(&new)?;
        let run = |key: &Key| -> Result<Option<Ran>, CasesError> {
            let bed = beds.get(&(key.candidate, key.level, key.seed));
            let Some(bed) = bed.filter(|_| !watcher.interrupt.asked()) else { return Ok(None) };
            match one(task, key, bed, watcher.interrupt) {
                Ok(None) => Ok(None),
                Ok(Some(measured)) => {
                    record(key, &measured)?;
                    let done = counter.fetch_add(measured.runs(), Ordering::Relaxed) + measured.runs();
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
                Ok(measured) => drop(self.done.insert(key, measured)),
                Err(error) => drop(self.failures.entry(key.candidate).or_insert(error)),
            }
        }
        Ok(!watcher.interrupt.asked())
    }
}

fn one(task: &Task<'_>, key: &Key, bed: &State, interrupt: &Interrupt) -> Result<Option<Measured>, RunError> {
    let plan = task.driven(key.candidate, key.level);
    let Some(ratio) = key.ratio else {
        let found = answer(&plan, task.wanted.goal, task.reference, key.seed, bed, interrupt)?;
        return Ok(found.map(Measured::Answer));
    };
    let Some(response) = &plan.response else { return Ok(None) };
    let point = measure(&plan, response, key.seed, bed, task.reference * ratio.0, &[], interrupt)?;
    Ok(point.map(|point| Measured::Point(Box::new(point))))
}
