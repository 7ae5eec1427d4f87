//! What a step costs: measured for a moment, and for the same grains lying on each other.

use crate::engine::{self, Engine, Fault};
use crate::ledger::Ledger;
use crate::methods;
use crate::partner::Hosts;
use std::collections::BTreeMap;
use std::fs;
use std::time::Instant;
use tsubu_scene::plan::{Flow, GrainMotion, Method, Particles, Periodic, Plan, Size, Start};

/// Seconds of a trial.
const TRIAL: f64 = 0.3;
/// The same of a bed.
const BED: f64 = 0.1;
/// Grains along an edge of a bed, in the plane and in space.
const EDGE: [usize; 2] = [40, 12];
/// Distance of centres in a bed over the diameter.
const PITCH: f64 = 0.999;

/// Time that this thread has worked [s]: other programs do not count. Time on the clock where the system does not tell.
fn worked(begun: Instant) -> f64 {
    let text = fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = text.and_then(|text| text.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| begun.elapsed().as_secs_f64(), |ns| 1e-9 * ns)
}

/// Steps an engine for a moment, `total` steps at most; gives seconds of work a step.
pub(super) fn trial(engine: &mut dyn Engine, hosts: &mut Hosts, total: f64) -> Result<f64, Fault> {
    let mut ledger = Ledger::open(engine::energies(engine, hosts), engine.momentum());
    alone(|| go(engine, hosts, &mut ledger, total, TRIAL))
}

/// On one thread, which is measured.
fn alone<R: Send>(work: impl FnOnce() -> R + Send) -> R {
    match rayon::ThreadPoolBuilder::new().num_threads(1).build() {
        Ok(pool) => pool.install(work),
        Err(_) => work(),
    }
}

fn go(engine: &mut dyn Engine, hosts: &mut Hosts, ledger: &mut Ledger, total: f64, long: f64) -> Result<f64, Fault> {
    let (begun, first) = (Instant::now(), engine.steps());
    let start = worked(begun);
    let mut block = 1;
    // A block that takes long is not doubled: what a step costs is known then.
    // Among many programs a moment of work takes several on the clock.
    let late = || begun.elapsed().as_secs_f64() > 4.0 * long;
    while worked(begun) - start < long && !late() && ((engine.steps() - first) as f64) < total {
        let (before, left) = (worked(begun), total - (engine.steps() - first) as f64);
        engine.advance(block.min(left.ceil() as u64), hosts, ledger)?;
        if worked(begun) - before < 0.25 * long {
            block *= 2;
        }
    }
    Ok((worked(begun) - start) / (engine.steps() - first).max(1) as f64)
}

/// Seconds of work a step once all grains of a scene, those that are yet to come as well, lie on each other: measured with a
/// piece of a bed in which each touches as many as in the loosest lattice, under the scene's laws and in its water. `None`
/// where nothing can lie: no gravity, no free grains, or another method.
pub(super) fn of_a_bed(plan: &Plan) -> Option<f64> {
    // Water that grains change needs its layers.
    let coupled = plan
        .water
        .as_ref()
        .is_some_and(|water| !matches!(water.flow, Flow::Still {} | Flow::LogLaw { .. } | Flow::Table { .. }));
    if plan.method != Method::Dem || plan.gravity == [0.0; 3] || coupled {
        return None;
    }
    let free = || plan.particles.iter().filter(|(_, group)| matches!(group.motion, GrainMotion::Free {}));
    let count: usize = free().map(|(_, group)| group.count).sum();
    let (name, group) = free().max_by_key(|(_, group)| group.count)?;
    let piece = piece(plan, name, group);
    let hosts = &mut Hosts::default();
    let mut engine = methods::open(&piece, hosts).ok()?;
    let grains = engine.grains();
    let mut ledger = Ledger::open(engine::energies(&*engine, hosts), engine.momentum());
    let cost = alone(|| go(&mut *engine, hosts, &mut ledger, f64::INFINITY, BED)).ok()?;
    (count > 0 && grains > 0).then(|| cost / grains as f64 * count as f64)
}

/// A piece of a bed that repeats itself, of grains of one group.
fn piece(plan: &Plan, name: &str, group: &Particles) -> Plan {
    let space = plan.dimension == 3;
    let edge = EDGE[usize::from(space)];
    let (pitch, long) = (PITCH * group.diameter, PITCH * group.diameter * edge as f64);
    let at = |k: usize| (k as f64 + 0.5) * pitch;
    let columns = if space { edge } else { 1 };
    let position = (0..edge * columns * edge)
        .map(|k| [at(k % edge), if space { at(k / edge % columns) } else { 0.0 }, at(k / edge / columns)]);
    let start = Start::At { position: position.collect(), velocity: Vec::new(), spin: Vec::new() };
    let count = edge * columns * edge;
    let group = Particles { count, start, size: Size::Equal {}, motion: GrainMotion::Free {}, ..group.clone() };
    let ends = Some([0.0, long]);
    Plan {
        particles: [(name.to_owned(), group)].into(),
        walls: BTreeMap::new(),
        hosts: BTreeMap::new(),
        removal: BTreeMap::new(),
        watch: toml::map::Map::new(),
        response: None,
        sweep: None,
        claim: Vec::new(),
        periodic: Periodic { x: ends, y: if space { ends } else { None }, z: ends },
        ..plan.clone()
    }
}
