//! What a step costs: measured for a moment, and for the same grains lying on each other.

use crate::engine::{self, Engine, Fault};
use crate::ledger::Ledger;
use crate::methods;
use crate::partner::Hosts;
use std::collections::BTreeMap;
use std::fs;
use std::time::Instant;
use tsubu_scene::plan::{Flow, GrainMotion, Method, Particles, Periodic, Plan, Size, Start, Water};

/// Seconds of a trial.
const TRIAL: f64 = 0.3;
/// The same of a bed.
const BED: f64 = 0.1;
/// Grains of a bed, in the plane and in space: 40 and 12 along an edge.
const GRAINS: [f64; 2] = [1600.0, 1728.0];
/// A bed is at least so many diameters wide.
const WIDE: f64 = 3.0;
/// How deep grains of a bed lie in each other, over what they measure; of rounded edges over twice their radius.
const DEEP: [f64; 2] = [1e-3, 1e-2];

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

/// Seconds of work a step once all grains of a scene, those that are yet to come as well, lie on each other: measured with pieces of beds in
/// which each touches as many as in the loosest lattice, under the scene's laws. Spheres of all groups cost the same, bodies of each group
/// their own. `None` where nothing can lie: no gravity, no free grains, or another method.
pub(super) fn of_a_bed(plan: &Plan) -> Option<f64> {
    if plan.method != Method::Dem || plan.gravity == [0.0; 3] {
        return None;
    }
    let free: Vec<(&String, &Particles)> = plan
        .particles
        .iter()
        .filter(|(_, group)| group.count > 0 && matches!(group.motion, GrainMotion::Free {}))
        .collect();
    let (bodies, spheres): (Vec<_>, Vec<_>) = free.into_iter().partition(|(_, group)| group.shape.is_clump());
    let all: usize = spheres.iter().map(|(_, group)| group.count).sum();
    let most = spheres.into_iter().max_by_key(|(_, group)| group.count);
    let kinds: Vec<_> =
        bodies.into_iter().map(|kind| (kind, kind.1.count)).chain(most.map(|kind| (kind, all))).collect();
    let long = BED / kinds.len().max(1) as f64;
    let costs = kinds.iter().map(|((name, group), count)| Some(of_a_grain(plan, name, group, long)? * *count as f64));
    costs.sum::<Option<f64>>().filter(|_| !kinds.is_empty())
}

/// Seconds of work a step for one grain of a group in a bed of its like.
fn of_a_grain(plan: &Plan, name: &str, group: &Particles, long: f64) -> Option<f64> {
    let piece = piece(plan, name, group);
    let hosts = &mut Hosts::default();
    let mut engine = methods::open(&piece, hosts).ok()?;
    let mut ledger = Ledger::open(engine::energies(&*engine, hosts), engine.momentum());
    let cost = alone(|| go(&mut *engine, hosts, &mut ledger, f64::INFINITY, long)).ok()?;
    Some(cost / piece.grains() as f64)
}

/// A piece of a bed that repeats itself, of grains of one group: bodies turned as drawn, as far apart along each axis as they measure there.
fn piece(plan: &Plan, name: &str, group: &Particles) -> Plan {
    let axes: &[usize] = if plan.dimension == 3 { &[0, 1, 2] } else { &[0, 2] };
    let body = group.shape.clump();
    let deep =
        body.as_ref().and_then(|body| body.polyhedron.as_ref()).map_or(1.0, |body| 2.0 * body.rounding * DEEP[1]);
    let extent = body.map_or([1.0; 3], |body| body.extent());
    let pitch = extent.map(|extent| (extent - deep.min(DEEP[0] * extent)) * group.diameter);
    let volume: f64 = axes.iter().map(|&a| pitch[a]).product();
    let wide = (GRAINS[axes.len() - 2] * volume).powf(1.0 / axes.len() as f64).max(WIDE * group.diameter);
    let along = |a: usize| if axes.contains(&a) { (wide / pitch[a]).round().max(1.0) as usize } else { 1 };
    let number = [0, 1, 2].map(along);
    let count = number.into_iter().product();
    let at = |a: usize, k: usize| if axes.contains(&a) { (k as f64 + 0.5) * pitch[a] } else { 0.0 };
    let position = (0..count)
        .map(|k| [at(0, k % number[0]), at(1, k / number[0] % number[1]), at(2, k / number[0] / number[1])])
        .collect();
    let start = Start::At { position, velocity: Vec::new(), spin: Vec::new() };
    let shape = group.shape.clone().as_drawn();
    let group = Particles { count, start, shape, size: Size::Equal {}, motion: GrainMotion::Free {}, ..group.clone() };
    let ends = |a: usize| axes.contains(&a).then(|| [0.0, pitch[a] * number[a] as f64]);
    // Water that grains change needs its layers.
    let coupled = |water: &Water| !matches!(water.flow, Flow::Still {} | Flow::LogLaw { .. } | Flow::Table { .. });
    Plan {
        particles: [(name.to_owned(), group)].into(),
        walls: BTreeMap::new(),
        hosts: BTreeMap::new(),
        removal: BTreeMap::new(),
        water: plan.water.clone().filter(|water| !coupled(water)),
        watch: toml::map::Map::new(),
        response: None,
        sweep: None,
        claim: Vec::new(),
        periodic: Periodic { x: ends(0), y: ends(1), z: ends(2) },
        ..plan.clone()
    }
}
