//! Runs by a cheap method, which tell where those of the scene's own are worth their time.

use super::search::Guess;
use super::work::Work;
use super::{Key, Measured};
use crate::study::cases::CasesError;
use crate::study::surrogate::Surrogate;

/// Candidates that are looked at cheaply, at most: the process of them grows with their cube.
const MOST: usize = 512;
/// Side by side; what they cost is looked at after each.
const ROUND: usize = 32;
/// What of the runs they may cost, at most.
const SHARE: f64 = 0.1;

/// How the cheap method and the scene's own differ over the candidates that both have measured with one seed.
pub(super) struct Differences {
    /// Candidates that both have measured.
    pub number: usize,
    /// Mean of the logarithm of the scene's over the cheap one's.
    pub mean: f64,
    /// Its standard deviation.
    pub deviation: f64,
    /// Correlation of their logarithms.
    pub correlation: f64,
    /// rho of the two processes.
    pub factor: f64,
}

impl Work<'_> {
    /// Measures candidates cheaply, the first of those that lie far from each other first, until all are or they have cost their share, and
    /// guesses all others. Says whether it came to the end.
    pub(super) fn look_cheaply(&mut self) -> Result<bool, CasesError> {
        let task = self.task;
        let order = task.candidates.spread(MOST);
        for round in order.chunks(ROUND) {
            if self.cheap_cost() > SHARE * f64::from(task.wanted.runs) {
                break;
            }
            let levels = 0..task.wanted.levels.len();
            let of_one = |candidate: &usize| {
                let candidate = *candidate;
                levels.clone().map(move |level| Key { candidate, level, seed: 0, ratio: None, cheap: true })
            };
            if !self.measure(round.iter().flat_map(of_one).collect())? {
                return Ok(false);
            }
        }
        let known: Vec<(usize, f64)> =
            order.iter().filter_map(|index| Some((*index, self.cheap_value(*index)?.ln()))).collect();
        let (places, values): (Vec<_>, Vec<_>) =
            known.into_iter().map(|(index, value)| (task.candidates.list[index].place.clone(), value)).unzip();
        let of_all = |fit: Surrogate| task.candidates.list.iter().map(|one| fit.at(&one.place)).collect();
        self.cheap = Surrogate::fit(&places, &values).map_or_else(|| vec![[0.0; 2]; task.as_written()], of_all);
        Ok(true)
    }

    /// What the cheap method gives for a candidate: the worst of its levels, where all are measured.
    pub fn cheap_value(&self, candidate: usize) -> Option<f64> {
        self.of_first_seed(candidate, true)
    }

    /// Candidates that were measured cheaply.
    pub fn cheap_values(&self) -> usize {
        (0..self.task.as_written()).filter(|index| self.cheap_value(*index).is_some()).count()
    }

    /// What the cheap runs cost, in runs of the scene's own method: by their computing times.
    pub fn cheap_cost(&self) -> f64 {
        let all: f64 = self.cheaply.values().map(|one| one.wall_of_run() * f64::from(one.runs())).sum();
        let runs: u32 = self.done.values().map(Measured::runs).sum();
        let own: f64 = self.done.values().map(|one| one.wall_of_run() * f64::from(one.runs())).sum();
        if all > 0.0 && own > 0.0 { all * f64::from(runs) / own } else { 0.0 }
    }

    /// How the two methods differ; nothing where fewer than three candidates were measured by both.
    pub fn differences(&self) -> Option<Differences> {
        let both: Vec<[f64; 2]> = self
            .values()
            .into_iter()
            .filter_map(|(index, _)| Some([self.cheap_value(index)?.ln(), self.of_first_seed(index, false)?.ln()]))
            .collect();
        if both.len() < 3 {
            return None;
        }
        let number = both.len() as f64;
        let mean = |of: &dyn Fn(&[f64; 2]) -> f64| both.iter().map(of).sum::<f64>() / number;
        let (cheap, own) = (mean(&|x| x[0]), mean(&|x| x[1]));
        let of_two = |a: [f64; 2], b: [f64; 2]| {
            mean(&|x| (a[0] * (x[0] - cheap) + a[1] * (x[1] - own)) * (b[0] * (x[0] - cheap) + b[1] * (x[1] - own)))
        };
        let (first, second) = ([1.0, 0.0], [0.0, 1.0]);
        let factor = Guess::fit(&self.task.candidates, &self.values(), &self.cheap)?.factor();
        Some(Differences {
            number: both.len(),
            mean: own - cheap,
            deviation: of_two([-1.0, 1.0], [-1.0, 1.0]).sqrt(),
            correlation: of_two(first, second) / (of_two(first, first) * of_two(second, second)).sqrt(),
            factor,
        })
    }

    /// What the few runs of the first seed gave by one of the methods, the worst of all levels.
    fn of_first_seed(&self, candidate: usize, cheap: bool) -> Option<f64> {
        let levels = &self.task.wanted.levels;
        let done = if cheap { &self.cheaply } else { &self.done };
        let of_level = |level: usize| {
            let key = Key { candidate, level, seed: 0, ratio: None, cheap };
            Some(done.get(&key)?.rms() / levels[level])
        };
        (0..levels.len()).map(of_level).try_fold(0.0, |worst, one| Some(f64::max(worst, one?)))
    }
}
