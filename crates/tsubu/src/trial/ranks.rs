//! What a run takes on several ranks.

use super::span;
use crate::check::Verdict;
use crate::memory::{self, human_memory};
use crate::ranks::RankShare;
use tsubu_scene::plan::Plan;

/// Time that a message takes whatever is in it [s], and bytes a second: ten-gigabit Ethernet.
const NETWORK: [f64; 2] = [30e-6, 1.2e9];

/// Share of a step on one rank that all ranks do alike: sorting, and the rest of making lists anew.
const ALIKE: f64 = 0.04;

/// Steps from one making of lists to the next.
const STEPS_OF_LISTS: f64 = 30.0;

/// Tells what the busiest of so many ranks has and sends, and how long `steps` take whose work on one rank is `cost` [s] each.
pub(super) fn tell(
    verdict: &mut Verdict,
    plan: &Plan,
    ranks: usize,
    share: impl Fn(usize) -> Option<RankShare>,
    steps: f64,
    cost: [f64; 2],
) {
    let Some(busiest) = share(ranks) else {
        let text = format!("ranks: method `{}` runs on one rank alone", plan.method.name());
        verdict.judge(false, text, || "no `--ranks`; many runs go over Slurm or Dask".to_owned());
        return;
    };
    let [first, other] = memory::on_ranks(plan, ranks);
    verdict.say(format!(
        "ranks: of {ranks} each has {} grains at most, and about {} of memory; the first, which writes, {}",
        busiest.grains,
        human_memory(other),
        human_memory(first)
    ));
    verdict.say(format!(
        "ranks: each sends {} messages a step, {} together, and {} more whenever lists are made anew",
        busiest.messages,
        human_memory(busiest.bytes),
        human_memory(busiest.bytes_anew)
    ));
    let time = |ranks: usize| cost.map(|cost| steps * of_a_step(cost, plan.grains(), ranks, share(ranks)));
    let ([low, high], half) = (time(ranks), time(ranks.div_ceil(2)));
    verdict.judge(
        high <= half[1],
        format!("time: about {} on {ranks} ranks of a thread over ten-gigabit Ethernet", span(low, high)),
        || format!("fewer ranks: {} take about {}; or threads", ranks.div_ceil(2), span(half[0], half[1])),
    );
}

/// Seconds that a step takes on ranks, of `cost` [s] on one.
fn of_a_step(cost: f64, grains: usize, ranks: usize, share: Option<RankShare>) -> f64 {
    let share = share.filter(|_| ranks > 1).unwrap_or(RankShare { grains, ..RankShare::default() });
    let [latency, rate] = NETWORK;
    let own = share.grains as f64 / grains.max(1) as f64;
    let sent = share.messages as f64 * latency + (share.bytes + share.bytes_anew / STEPS_OF_LISTS) / rate;
    cost * (ALIKE + (1.0 - ALIKE) * own) + sent
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With shares of equal size and few bytes ranks gain, up to where what all do alike and messages outweigh it.
    #[test]
    fn more_ranks_gain_until_they_do_not() {
        let (grains, cost) = (100_000, 0.02);
        let share =
            |ranks: usize| Some(RankShare { grains: grains / ranks, messages: ranks, bytes: 1e5, bytes_anew: 1e6 });
        let time = |ranks| of_a_step(cost, grains, ranks, share(ranks));
        assert!((time(1) - cost).abs() < 1e-12);
        assert!(time(2) < 0.6 * cost && time(8) < time(2));
        assert!(time(512) > time(8), "messages to all others take over");
    }
}
