//! Ring-down: damping from how a free structure comes to rest.

use crate::engine::{self, OpenError};
use crate::ledger::{Account, Ledger};
use crate::methods;
use crate::partner::Hosts;
use tsubu_scene::plan::Plan;

/// One cycle of a decay, from one upward crossing of the mean to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle {
    /// Largest displacement from the rest position in the cycle [m].
    pub amplitude: f64,
    /// Length [s].
    pub period: f64,
    /// Energy lost [J].
    pub loss: f64,
}

/// Lets the first host of a plan swing freely for the plan's duration and cuts the motion into cycles about `rest` [m].
pub fn ring_down(plan: &Plan, rest: f64) -> Result<Vec<Cycle>, OpenError> {
    let mut hosts = Hosts::new(&plan.hosts);
    let mut engine = methods::open(plan, &hosts)?;
    let mut ledger = Ledger::open(engine::energies(&*engine, &hosts), engine.momentum());
    let lost = |ledger: &Ledger| -> f64 { Account::ALL.iter().filter(|a| !a.is_work()).map(|&a| ledger.flow(a)).sum() };
    let mut cycles = Vec::new();
    let (mut amplitude, mut begin): (f64, Option<(f64, f64)>) = (0.0, None);
    let mut before = hosts.list[0].displacement() - rest;
    let steps = (plan.duration / engine.time_step()) as u64;
    for _ in 0..steps {
        engine.advance(1, &mut hosts, &mut ledger)?;
        let now = hosts.list[0].displacement() - rest;
        amplitude = amplitude.max(now.abs());
        if before < 0.0 && now >= 0.0 {
            let time = engine.time() - engine.time_step() * now / (now - before);
            if let Some((start, loss)) = begin {
                cycles.push(Cycle { amplitude, period: time - start, loss: lost(&ledger) - loss });
            }
            begin = Some((time, lost(&ledger)));
            amplitude = 0.0;
        }
        before = now;
    }
    Ok(cycles)
}
