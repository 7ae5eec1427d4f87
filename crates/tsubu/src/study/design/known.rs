//! What a design knows of its candidates.

use super::search::Guess;
use super::work::Work;
use super::{Measured, Standing};
use crate::student::interval_of_mean;
use std::collections::{BTreeMap, BTreeSet};
use tsubu_scene::plan::Goal;

impl Work<'_> {
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
    pub(super) fn lowest(&self) -> Option<usize> {
        let fits = |index: usize| self.standing(index).is_some_and(|standing| self.fits(&standing));
        let values = self.values().into_iter().filter(|(index, _)| fits(*index));
        values.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
    }

    /// The best of those within the limits: by its seeds where it is confirmed, by the surrogate where it is not.
    pub(super) fn best(&self) -> Option<usize> {
        let task = self.task;
        let values = self.values();
        let known = Guess::fit(&task.candidates, &values, &self.cheap);
        let likely = |(index, value): &(usize, f64)| {
            let standing = self.standing(*index)?;
            let confirmed = standing.seeds >= task.wanted.seeds as usize;
            let guess = known.as_ref().map(|known| known.at(*index)[0].exp());
            let value = if confirmed { *value } else { guess.unwrap_or(*value) };
            self.fits(&standing).then_some((*index, value))
        };
        values.iter().filter_map(likely).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
    }

    /// Half of a candidate's 95 % interval over its mean; 0 where all seeds give the same.
    pub fn doubt(&self, candidate: usize) -> f64 {
        let Some(standing) = self.standing(candidate) else { return f64::INFINITY };
        standing.interval.map_or(0.0, |[low, high]| 0.5 * (high - low) / standing.rms)
    }

    /// Candidates that were measured, or tried in vain.
    pub fn closed(&self) -> Vec<usize> {
        let tried = self.expected.iter().map(|one| one.0).chain(self.failures.keys().copied());
        let all: BTreeSet<usize> = self.done.keys().map(|key| key.candidate).chain(tried).collect();
        all.into_iter().filter(|index| *index < self.task.as_written()).collect()
    }
}
