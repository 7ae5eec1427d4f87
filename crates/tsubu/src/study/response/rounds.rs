//! Which frequencies a response measures: those that were asked for, then round by round more.

use super::curve::CaseResult;
use super::{Done, Key, Task, refine, tasks};
use crate::study::journal::Exact;
use std::collections::BTreeSet;

/// The frequencies of all cases, round by round. What is asked for in a round follows from the points of those before, never from how
/// far a round that was interrupted had come.
pub(super) struct Rounds<'a> {
    /// Points of an earlier, interrupted response.
    earlier: Option<&'a Done>,
    /// Runs that failed elsewhere: they are not tried again, and not waited for.
    given_up: BTreeSet<Key>,
    /// All that was asked for.
    pub asked: BTreeSet<Key>,
    /// What is still to be measured of the last round, long runs first, so that no core is left with one at the end.
    pub missing: Vec<Key>,
    /// What has been measured in the rounds before, and after the end in all.
    pub points: Done,
    /// What an earlier response has measured of the last round.
    fresh: Done,
}

impl<'a> Rounds<'a> {
    pub fn new(task: &Task, earlier: Option<&'a Done>) -> Self {
        Self::without(task, earlier, BTreeSet::new())
    }

    /// The same without runs that are given up.
    pub fn without(task: &Task, earlier: Option<&'a Done>, given_up: BTreeSet<Key>) -> Self {
        let (asked, missing) = (BTreeSet::new(), Vec::new());
        let mut rounds = Self { earlier, given_up, asked, missing, points: Done::new(), fresh: Done::new() };
        let cases = 0..task.plans.len();
        let first = cases.flat_map(|case| task.wanted.frequency_ratio.iter().map(move |ratio| (case, *ratio)));
        rounds.ask(task, first.collect());
        rounds.go_on(task);
        rounds
    }

    /// Ends a round with its points; runs that failed are not tried again.
    pub fn next(&mut self, task: &Task, points: Done) {
        self.end(points);
        self.missing.clear();
        self.go_on(task);
    }

    /// Puts the points of the last round to those before.
    pub fn end(&mut self, points: Done) {
        self.points.extend(points);
        self.points.append(&mut self.fresh);
    }

    /// Goes on to the next round that has something to measure; none has when nothing is missing.
    fn go_on(&mut self, task: &Task) {
        while self.missing.is_empty() {
            self.end(Done::new());
            let Some(within) = task.wanted.peak_within else { return };
            let curve =
                |case: &CaseResult| -> Vec<(f64, f64)> { case.rows.iter().map(|r| (r.ratio, r.rms[0])).collect() };
            let cases = task.results(&self.points).into_iter().enumerate();
            let more = cases.flat_map(|(i, case)| refine::next(&curve(&case), within).into_iter().map(move |x| (i, x)));
            if !self.ask(task, more.collect()) {
                return;
            }
        }
    }

    /// Asks for more; says whether any of it is new.
    fn ask(&mut self, task: &Task, wanted: Vec<(usize, f64)>) -> bool {
        let seeds = 0..task.wanted.seeds;
        let keys =
            wanted.into_iter().flat_map(|(case, x)| seeds.clone().map(move |seed| Key { case, seed, ratio: Exact(x) }));
        let new: Vec<Key> = keys.filter(|key| self.asked.insert(*key)).collect();
        for key in &new {
            match self.earlier.and_then(|earlier| earlier.get(key)) {
                Some(point) => {
                    self.fresh.insert(*key, point.clone());
                }
                None if self.given_up.contains(key) => {}
                None => self.missing.push(*key),
            }
        }
        self.missing.sort_by_key(|k| std::cmp::Reverse(tasks::weight(&task.plans[k.case])));
        !new.is_empty()
    }
}
