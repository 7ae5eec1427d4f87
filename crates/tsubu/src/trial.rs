//! A scene tried before it is run: its verdict, whether it opens, and what a step costs on this machine.

mod cost;
mod ranks;

use crate::bench::Bench;
use crate::check::{Verdict, human_time, verdict};
use crate::engine::{Engine, OpenError};
use crate::methods;
use crate::partner::Hosts;
use crate::threads::WORTH_THREADS;
use std::collections::BTreeMap;
use tsubu_scene::plan::{Method, Particles, Plan, Start};

/// The same plan with grains left where they are dropped from: for a bed that is settled already, or need not be.
pub(crate) fn unsettled(plan: &Plan) -> Plan {
    let mut plan = plan.clone();
    for group in plan.particles.values_mut() {
        if let Start::Settled { time } = &mut group.start {
            *time = 0.0;
        }
    }
    plan
}

/// What a run is estimated for.
#[derive(Clone, Copy, Debug, Default)]
pub struct Target<'a> {
    /// What is known of this machine: with it the estimate is for all its cores too.
    pub bench: Option<&'a Bench>,
    /// On how many ranks it is to run; up to 1: on one.
    pub ranks: usize,
}

/// Builds the scene, judges it, and measures for a moment how fast this machine moves it. `ahead` hears what is known so far, and what comes
/// next: a part that may take long.
pub fn check(plan: &Plan, target: Target, ahead: &mut dyn FnMut(&Verdict, &'static str)) -> Result<Verdict, OpenError> {
    ahead(&Verdict::default(), "placing the grains");
    let mut hosts = Hosts::new(&plan.hosts);
    let settles = |group: &Particles| matches!(group.start, Start::Settled { time } if time > 0.0);
    let mut engine = methods::open(&unsettled(plan), &hosts)?;
    let mut verdict = verdict(plan, &hosts, &*engine);
    let total = plan.duration / engine.time_step();
    if total.round() < 1.0 {
        let (duration, dt) = (plan.duration, engine.time_step());
        verdict.judge(false, format!("the run would have no step: it lasts {duration} s, a step {dt} s"), || {
            format!("`duration`, or `{}`", engine.step_key())
        });
        verdict.fails = true;
        return Ok(verdict);
    }
    if plan.particles.values().any(settles) {
        ahead(&verdict, "settling the grains before time 0");
        match methods::open(plan, &hosts) {
            Ok(settled) => engine = settled,
            Err(OpenError::Settling(fault)) => {
                verdict.fail("settling before time 0 would fail", &fault);
                return Ok(verdict);
            }
            Err(other) => return Err(other),
        }
    }
    ahead(&verdict, "the first steps");
    let now = match cost::trial(&mut *engine, &mut hosts, total) {
        Ok(cost) => cost,
        Err(fault) => {
            verdict.fail("the run would fail", &fault);
            return Ok(verdict);
        }
    };
    ahead(&verdict, "the first steps of a settled bed");
    let dense = cost::of_a_bed(plan).map_or(now, |bed| bed.max(now));
    times(&mut verdict, plan, &hosts, &*engine, [now, dense], target.bench);
    if target.ranks > 1 {
        ranks::tell(&mut verdict, plan, target.ranks, |ranks| engine.on_ranks(ranks), total, [now, dense]);
    }
    Ok(verdict)
}

/// Seconds of work that a step costs on this machine once the grains lie: the dearer of now and of a settled bed. `None` where the
/// scene does not open, or fails at once.
pub(crate) fn step_cost(plan: &Plan) -> Option<f64> {
    let mut hosts = Hosts::new(&plan.hosts);
    let mut engine = methods::open(&unsettled(plan), &hosts).ok()?;
    let total = plan.duration / engine.time_step();
    let now = cost::trial(&mut *engine, &mut hosts, total).ok()?;
    Some(cost::of_a_bed(plan).map_or(now, |bed| bed.max(now)))
}

/// The longest run [s] that is not worth a warning: a month.
const LONGEST: f64 = 30.0 * 86_400.0;

/// How long a run takes, with the cost of a step as it is measured now, and of a settled bed [s].
fn times(
    verdict: &mut Verdict,
    plan: &Plan,
    hosts: &Hosts,
    engine: &dyn Engine,
    cost: [f64; 2],
    bench: Option<&Bench>,
) {
    let total = plan.duration / engine.time_step();
    let [low, high] = cost.map(|cost| cost * total);
    if high <= 0.0 {
        return verdict.say("time: less than can be measured on this machine for one run".to_owned());
    }
    let shorter = || format!("a shorter `duration`, fewer grains, or a longer `{}`", engine.step_key());
    verdict.judge(
        high <= LONGEST,
        format!(
            "time: about {} on this machine for one run ({} a step, one thread{})",
            span(low, high),
            span(cost[0], cost[1]),
            if cost[1] > 1.2 * cost[0] { ", as grains are now to all of them lying on each other" } else { "" }
        ),
        shorter,
    );
    let threaded = plan.method == Method::Dem && engine.grains() >= WORTH_THREADS;
    match bench {
        Some(bench) if threaded && bench.cores > 1 => verdict.say(format!(
            "time: about {} with {} threads, {:.2} times as fast by `tsubu bench`",
            span(low / bench.scaling(), high / bench.scaling()),
            bench.cores,
            bench.scaling()
        )),
        None if threaded => verdict.say("time with more threads: `tsubu bench` measures this machine".to_owned()),
        _ => {}
    }
    studies(verdict, plan, hosts, engine.time_step(), cost);
}

/// How long the studies of a scene take, with a time step [s] and the cost of a step [s].
fn studies(verdict: &mut Verdict, plan: &Plan, hosts: &Hosts, dt: f64, cost: [f64; 2]) {
    // So many runs of so long a simulated time [s], side by side.
    let time = |runs: f64, seconds: f64, vary| {
        let steps = runs * seconds / dt * grains_of_cases(plan, vary);
        cost.map(|cost| cost * steps / rayon::current_num_threads() as f64)
    };
    let number = |vary: &BTreeMap<String, Vec<toml::Value>>| vary.values().map(Vec::len).product::<usize>();
    if let Some(atlas) = &plan.atlas {
        let runs = number(&atlas.vary) as f64 * f64::from(atlas.points() * atlas.seeds);
        let seconds = atlas.periods() / (atlas.frequency[0] * atlas.frequency[1]).sqrt();
        let [low, high] = time(runs, seconds, &atlas.vary);
        verdict.say(format!("time: about {} for `tsubu atlas` ({runs} runs side by side)", span(low, high)));
    }
    if let Some(calibrate) = &plan.calibrate {
        let runs = calibrate.runs + calibrate.checks;
        let [low, high] = time(f64::from(runs), plan.duration, &calibrate.vary);
        verdict.judge(
            high <= LONGEST,
            format!("time: about {} for `tsubu calibrate` ({runs} runs at most, side by side)", span(low, high)),
            || "a lower `calibrate.runs`, or a shorter scene".to_owned(),
        );
    }
    let Some(response) = &plan.response else { return };
    let runs = number(&response.vary) * response.runs_of_case();
    let f0 = hosts.index(&response.host).and_then(|i| hosts.list[i].natural_frequencies().first().copied());
    // A period is that of the drive: at a tenth of the natural frequency ten times as long.
    let inverse: f64 = response.frequency_ratio.iter().map(|ratio| 1.0 / ratio).sum();
    let seconds = response.periods() * inverse / (response.frequency_ratio.len() as f64 * f0.unwrap_or(1.0));
    let [low, high] = time(runs as f64, seconds, &response.vary);
    verdict.judge(
        high <= LONGEST,
        format!("time: about {} for `tsubu response` ({runs} runs side by side)", span(low, high)),
        || "fewer frequencies, cases or periods".to_owned(),
    );
    if let Some(design) = &plan.design {
        let [low, high] = time(f64::from(design.runs), seconds, &design.vary);
        let runs = design.runs;
        verdict.judge(
            high <= LONGEST,
            format!("time: about {} for `tsubu design` ({runs} runs at most, side by side)", span(low, high)),
            || "a lower `design.runs`, or fewer periods".to_owned(),
        );
    }
}

/// Grains of the cases of a study over those of the scene, in the mean.
fn grains_of_cases(plan: &Plan, vary: &BTreeMap<String, Vec<toml::Value>>) -> f64 {
    let all = plan.grains();
    let more = plan.particles.iter().map(|(name, group)| {
        let values = vary.iter().find(|(key, _)| **key == format!("particles.{name}.count")).map(|(_, values)| values);
        let counts = values.into_iter().flatten().filter_map(toml::Value::as_integer);
        let (sum, number) = counts.fold((0.0, 0.0), |(sum, number), count| (sum + count as f64, number + 1.0));
        if number > 0.0 { sum / number - group.count as f64 } else { 0.0 }
    });
    if all > 0 { 1.0 + more.sum::<f64>() / all as f64 } else { 1.0 }
}

/// A time, or from when to when.
fn span(low: f64, high: f64) -> String {
    let [from, to] = [low, high].map(human_time);
    // What is told alike is one number.
    if high <= 1.2 * low || from == to { to } else { format!("{from} to {to}") }
}

#[cfg(test)]
mod tests {
    use super::span;

    /// A run of a moment took "about 1 ms to 1 ms".
    #[test]
    fn a_span_has_two_ends_that_differ() {
        assert_eq!(span(1.0e-3, 1.4e-3), "1 ms");
        assert_eq!(span(0.6e-3, 2.4e-3), "600.0 us to 2 ms");
        assert_eq!(span(2.0, 3.0), "2.0 s to 3.0 s");
    }
}
