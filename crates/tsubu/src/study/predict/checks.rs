//! Spot checks: some frequencies of a prediction, simulated in full.

use super::{Curve, Row, Task};
use crate::engine::OpenError;
use crate::interrupt::Watcher;
use crate::run::RunError;
use crate::study::cases::CasesError;
use crate::study::journal::{Exact, Journal};
use crate::study::response::{Point, measure, tasks};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::f64::consts::SQRT_2;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The flanks are where the curve has fallen to the peak over this.
const FLANK: f64 = 1.5;

/// What is simulated: the case, and the frequency over the natural frequency.
pub(super) type Key = (usize, Exact);

/// All that was simulated.
pub(super) type Done = BTreeMap<Key, Point>;

/// A frequency at which a case was simulated in full.
pub(super) struct Check {
    pub case: usize,
    /// Over the natural frequency.
    pub ratio: f64,
    /// Root mean square of what was predicted [m].
    pub predicted: f64,
    pub point: Point,
}

/// What was simulated in full, and what could not be, each in a sentence.
#[derive(Default)]
pub(super) struct Checks {
    pub done: Vec<Check>,
    pub failures: Vec<String>,
}

/// So many frequencies of each case: the predicted peak, and then its flanks.
pub(super) fn wanted(curves: &[Curve], number: usize) -> Vec<Key> {
    let mut wanted = Vec::new();
    for (case, curve) in curves.iter().enumerate() {
        let Some((top, height)) = curve.peak() else { continue };
        let low = |row: &&Row| row.largest().is_some_and(|motion| motion.amplitude / SQRT_2 < height / FLANK);
        let below = curve.rows.iter().filter(|row| row.ratio < top).rfind(low);
        let above = curve.rows.iter().filter(|row| row.ratio > top).find(low);
        let flanks = [below, above].into_iter().flatten().map(|row| row.ratio);
        wanted.extend(std::iter::once(top).chain(flanks).take(number).map(|ratio| (case, Exact(ratio))));
    }
    wanted
}

impl Task<'_> {
    /// Simulates these in full, side by side, but for what is known; what fails is told, and the others go on.
    pub(super) fn check(
        &self,
        curves: &[Curve],
        wanted: &[Key],
        known: &Done,
        journal: &Journal,
        watcher: &Watcher,
    ) -> Result<Checks, CasesError> {
        let counter = AtomicUsize::new(0);
        let one = |key: &Key| {
            let found = match known.get(key) {
                Some(point) => Ok(Some(point.clone())),
                None => self.simulated(key, journal, watcher)?,
            };
            (watcher.progress)((counter.fetch_add(1, Ordering::Relaxed) + 1) as f64 / wanted.len() as f64);
            Ok(found)
        };
        let all: Result<Vec<_>, CasesError> = wanted.par_iter().map(one).collect();
        let mut checks = Checks::default();
        for (&(case, Exact(ratio)), found) in wanted.iter().zip(all?) {
            let predicted =
                curves[case].nearest(ratio).and_then(Row::largest).map_or(f64::NAN, |m| m.amplitude) / SQRT_2;
            match found {
                Ok(found) => checks.done.extend(found.map(|point| Check { case, ratio, predicted, point })),
                Err(failure) => checks.failures.push(failure),
            }
        }
        Ok(checks)
    }

    /// Simulates one, and writes it down; nothing where that was interrupted. The inner error is a failure, in a sentence.
    fn simulated(
        &self,
        key: &Key,
        journal: &Journal,
        watcher: &Watcher,
    ) -> Result<Result<Option<Point>, String>, CasesError> {
        let (case, Exact(ratio)) = *key;
        if watcher.interrupt.asked() {
            return Ok(Ok(None));
        }
        let (name, plan) = (&self.cases[case].name, &self.plans[case]);
        let failed = |error: RunError| {
            Ok(Err(format!("case `{name}`, frequency ratio {ratio:.4}: the simulation failed: {error}")))
        };
        let bed = match tasks::bed(plan, 0) {
            Ok(bed) => bed,
            Err(error @ OpenError::Settling(_)) => return failed(error.into()),
            Err(error) => return Err(self.fail(case, error.into())),
        };
        match measure(plan, &self.wanted, 0, &bed, self.reference * ratio, &[], watcher.interrupt) {
            Ok(found) => {
                found.iter().try_for_each(|point| journal.record(key, point))?;
                Ok(Ok(found))
            }
            Err(error @ RunError::Fault(_)) => failed(error),
            Err(error) => Err(self.fail(case, error)),
        }
    }
}
