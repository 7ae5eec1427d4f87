//! What a run tells of itself in `summary.json`.

use super::Run;
use crate::engine;
use crate::ledger::Account;
use tsubu_frame::{Claim, RanksSummary, ResultValue, Source, Status, Summary};
use tsubu_scene::{Plan, nearest};

impl Run<'_> {
    pub(super) fn summary(&self, status: Status) -> Summary {
        let energies = engine::energies(&*self.engine, &self.hosts);
        let wall_seconds = self.wall_seconds();
        let mut summary = Summary {
            tsubu_version: crate::VERSION.to_owned(),
            status,
            method: self.plan.method.name().to_owned(),
            dimension: u32::from(self.plan.dimension),
            particles: self.engine.grains() as u64,
            steps: self.engine.steps(),
            time_step: self.engine.time_step(),
            simulated_seconds: self.engine.time(),
            wall_seconds,
            threads: rayon::current_num_threads() as u32,
            ranks: ranks(self.engine.worked()),
            particle_steps_per_second: self.engine.grain_steps() as f64 / wall_seconds,
            contacts_mean: self.measured.contacts_mean(),
            state_hash: self.state().hash(),
            ..Summary::default()
        };
        for (name, value) in energies.terms() {
            summary.energy.terms.insert(name, value);
        }
        for account in Account::ALL {
            summary.energy.terms.insert(account.name(), self.ledger.flow(account));
        }
        let residual = self.ledger.residual_relative(&energies);
        summary.energy.terms.insert("residual", self.ledger.residual(&energies));
        summary.energy.residual_relative = residual;
        let finite =
            self.ledger.residual(&energies).is_finite() && energies.terms().iter().all(|(_, value)| value.is_finite());
        if !finite {
            summary
                .warnings
                .push("energies of this run are not finite: its energy residual is worth nothing".to_owned());
        }
        let tolerance = self.plan.dem.energy_tolerance;
        if residual.abs() > tolerance {
            summary.warnings.push(format!(
                "the energy residual is {residual:.2e} of the energy turned over, more than `dem.energy-tolerance` = {tolerance:e}: shorten `dem.time-step`"
            ));
        }
        for note in self.engine.notes() {
            summary.warnings.push(format!("{}: {}", note.key, note.text));
        }
        summary.warnings.extend(self.lost.told(self.plan));
        self.stages.tell(&mut summary);
        self.tell(&mut summary);
        summary
            .stages
            .extend((status == Status::Finished).then(|| self.span()).filter(|_| self.stages.name().is_some()));
        for (name, grains) in self.engine.traffic() {
            summary.give(name, "-", grains as f64);
        }
        let momentum = self.ledger.momentum_residual(self.engine.momentum());
        summary.give("momentum residual", "N.s", momentum.iter().map(|p| p * p).sum::<f64>().sqrt());
        judge(self.plan, &mut summary);
        summary
    }

    /// What was watched in this stage.
    pub(super) fn tell(&self, summary: &mut Summary) {
        let mut seen = Summary::default();
        self.watches.results(&mut seen, self.stages.is_last());
        self.measured.results(&self.hosts, &mut seen);
        // Where nothing is watched, this is what happened.
        if self.plan.watch.is_empty() {
            let energies = engine::energies(&*self.engine, &self.hosts);
            self.measured.tell(self.seen(&energies), &mut seen);
        }
        summary.take(self.stages.name(), seen);
    }
}

/// The nearest of some names to one that is none of them, as the end of a sentence.
pub(super) fn meant<'a>(name: &str, names: impl IntoIterator<Item = &'a str>) -> String {
    nearest(name, names).map_or_else(String::new, |near| format!("; did you mean `{near}`?"))
}

/// Holds the scene's own claims against the results.
pub(crate) fn judge(plan: &Plan, summary: &mut Summary) {
    for (index, claim) in plan.claim.iter().enumerate() {
        let value = match summary.results.get(&claim.result) {
            Some(ResultValue::Number(value)) => *value,
            // Of a run that has not come to its end some results are still missing.
            None if summary.status == Status::Finished => {
                let meant = meant(&claim.result, summary.results.iter().map(|(name, _)| name));
                summary.warnings.push(format!("claim.{index}: the run has no result `{}`{meant}", claim.result));
                f64::NAN
            }
            Some(_) | None => f64::NAN,
        };
        summary.claims.push(Claim::judge(&claim.result, value, claim.low, claim.high, Source::scene(&claim.source)));
    }
}

/// How ranks that have worked for so long have shared a run [s]; nothing of one alone.
fn ranks(worked: &[f64]) -> Option<RanksSummary> {
    let most = worked.iter().copied().reduce(f64::max)?;
    let mean = worked.iter().sum::<f64>() / worked.len() as f64;
    Some(RanksSummary { count: worked.len() as u32, imbalance: if mean > 0.0 { most / mean } else { 1.0 } })
}
