//! The verdict on a scene before it runs.

mod verdict;

pub use verdict::{Line, Verdict, check, human_time, verdict};

use crate::contact::Table;
use crate::partner::Hosts;
use tsubu_scene::plan::{Plan, Shape, Signal, Start};

/// Time step of DEM [s]: told, or the shortest contact time at the scene's speed scale over the wanted steps per contact.
pub fn time_step(plan: &Plan, table: &Table, hosts: &Hosts) -> f64 {
    plan.dem.time_step.unwrap_or_else(|| {
        let speed = speed_scale(plan, hosts);
        let shortest = touching_pairs(plan, table).map(|(a, b)| table.pair(a, b).contact_time(speed));
        let shortest = shortest.fold(f64::INFINITY, f64::min);
        let dt = shortest / plan.dem.steps_per_contact;
        if dt.is_finite() { dt } else { shortest_period(hosts).min(plan.duration) / 200.0 }
    })
}

/// Pairs of species that can touch: all but wall with wall, and none for groups without grains.
pub fn touching_pairs<'a>(plan: &'a Plan, table: &'a Table) -> impl Iterator<Item = (u32, u32)> + 'a {
    let n = table.species.len() as u32;
    let present: Vec<bool> = plan
        .particles
        .values()
        .map(|p| p.count > 0)
        .chain(std::iter::repeat_n(true, table.species.len() - plan.particles.len()))
        .collect();
    (0..n).flat_map(move |a| (a..n).map(move |b| (a, b))).filter(move |&(a, b)| {
        present[a as usize] && present[b as usize] && table.species[a as usize].radius.is_finite()
    })
}

/// Shortest natural period of the hosts [s]; infinite without hosts.
pub fn shortest_period(hosts: &Hosts) -> f64 {
    hosts
        .list
        .iter()
        .filter_map(|h| h.natural_frequencies().last().copied())
        .filter(|f| *f > 0.0)
        .map(|f| 1.0 / f)
        .fold(f64::INFINITY, f64::min)
}

/// Typical fastest relative speed [m/s]: told, or the largest of a fall through the box, the walls' speed, the hosts'
/// speed at resonance without grains, and the speeds at the start; 1 m/s where nothing tells.
pub fn speed_scale(plan: &Plan, hosts: &Hosts) -> f64 {
    if let Some(told) = plan.speed_scale {
        return told;
    }
    let gravity = plan.gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
    let mut speed: f64 = 0.0;
    for wall in plan.walls.values() {
        if let Shape::Box { height, .. } = &wall.shape {
            speed = speed.max((2.0 * gravity * height).sqrt());
        }
        if let Some(motion) = &wall.motion {
            speed = speed.max(fastest(&motion.signal));
        }
    }
    for group in plan.particles.values() {
        match &group.start {
            Start::At { velocity, .. } => {
                let squares = velocity.iter().map(|v| v.iter().map(|x| x * x).sum::<f64>());
                speed = speed.max(squares.fold(0.0, f64::max).sqrt());
            }
            Start::Rows { speed: start, .. } => speed = speed.max(*start),
            Start::Settled { .. } => {}
        }
    }
    for (host, built) in plan.hosts.values().zip(&hosts.list) {
        let w = built.natural_frequencies().first().map_or(0.0, |f| std::f64::consts::TAU * f);
        let gain = 0.5 / built.damping_ratio().max(1e-3);
        speed = speed.max(host.velocity.abs()).max(host.displacement.abs() * w);
        let amplitude = host.base.as_ref().map_or(0.0, peak);
        speed = speed.max(gain * w * amplitude);
        let stiffness = built.effective_mass() * w * w;
        let force = host.force.as_ref().map_or(0.0, peak);
        if stiffness > 0.0 {
            speed = speed.max(gain * w * force / stiffness);
        }
    }
    if speed > 0.0 { speed } else { 1.0 }
}

/// Largest absolute value of a signal.
fn peak(signal: &Signal) -> f64 {
    match signal {
        Signal::Sine { amplitude, .. } | Signal::SineSweep { amplitude, .. } => amplitude.abs(),
        Signal::Impact { peak, .. } => peak.abs(),
        Signal::Table { value, .. } => value.iter().map(|v| v.abs()).fold(0.0, f64::max),
    }
}

/// Largest rate of change of a signal.
fn fastest(signal: &Signal) -> f64 {
    match signal {
        Signal::Sine { amplitude, frequency, .. } => (amplitude * frequency).abs() * std::f64::consts::TAU,
        Signal::SineSweep { amplitude, from, to, .. } => amplitude.abs() * from.max(*to) * std::f64::consts::TAU,
        Signal::Impact { peak, duration, .. } => (peak / duration).abs() * std::f64::consts::PI,
        Signal::Table { time, value } => {
            let slopes = time.windows(2).zip(value.windows(2)).map(|(t, v)| ((v[1] - v[0]) / (t[1] - t[0])).abs());
            slopes.fold(0.0, f64::max)
        }
    }
}
