//! What a bed at rest asks of the time step: its contacts may be pressed deeper than the impacts press them, and a grain is held
//! by many dashpots at once.

use super::Kind;
use crate::contact::Pair;
use tsubu_scene::plan::{GrainMotion, Particles, Plan, Shape};

/// Largest dashpot number c dt / m* of one contact in a bed.
///
/// Grains of mass m = 2 m* in the thickest packing have 12 contacts. Each takes a third of its dashpot in a given direction,
/// and twice that where neighbours move against each other: a rate of 12 (c/m) (2/3) = 4 c/m*. Forces that are found with
/// the velocity that Verlet predicts are stable below a rate of 1/dt: c dt / m* < 1/4.
pub(super) const IN_A_BED: f64 = 0.2;

/// Largest dashpot number of a single impact: a dashpot that takes half of the momentum in a step is not resolved.
pub(super) const IN_AN_IMPACT: f64 = 0.5;

/// Largest number c dt / m* of a film of liquid, whose force ends at touch: a force that comes or goes within a step with the number
/// n leaves n^2/6 of the energy unexplained, here less than 0.03 %.
pub(super) const IN_A_FILM: f64 = 0.04;

/// Weight [N] that rests on one of the lowest grains, if all free grains of the scene lie in one bed: that of the grains in a
/// column as wide as the grain. The bed is as wide as its box or its periodic ends; without them it is as wide as high.
fn weight_on(plan: &Plan, group: &Particles, diameter: f64) -> f64 {
    let gravity = plan.gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
    let free = || plan.particles.values().filter(|group| matches!(group.motion, GrainMotion::Free {}));
    let mass: f64 = free().map(|group| group.mass * group.count as f64).sum();
    let flat = plan.dimension == 2;
    let boxes = plan.walls.values().filter_map(|wall| match wall.shape {
        Shape::Box { width, depth, .. } => Some(if flat { width } else { width * depth }),
        _ => None,
    });
    let length = |ends: Option<[f64; 2]>| ends.map(|[low, high]| high - low);
    let repeats = match (length(plan.periodic.x), length(plan.periodic.y)) {
        (Some(x), _) if flat => Some(x),
        (Some(x), Some(y)) => Some(x * y),
        _ => None,
    };
    let own = if flat { diameter } else { diameter * diameter };
    let share = match boxes.chain(repeats).reduce(f64::max) {
        Some(floor) => own / floor,
        None => (free().map(|group| group.count as f64).sum::<f64>()).powf(1.0 / f64::from(plan.dimension) - 1.0),
    };
    gravity * (mass * share).max(group.mass)
}

/// Deepest overlap [m] of a pair in a bed at rest; `lowest` is its first body.
pub(super) fn overlap(plan: &Plan, pair: &Pair, lowest: &Kind) -> f64 {
    let group = lowest.group.as_ref().and_then(|name| plan.particles.get(name));
    group.map_or(0.0, |group| pair.overlap_under(weight_on(plan, group, 2.0 * lowest.radius)))
}

/// Longest step [s] at which the dashpot of a pair, and the film between them, is stable and resolved, with impacts at `speed` and `depth` the overlap at rest.
pub(super) fn longest_step(pair: &Pair, speed: f64, depth: f64) -> f64 {
    let longest = |number: f64, depth: f64| number * pair.mass / pair.damping_coefficient(depth);
    let film = IN_A_FILM * pair.mass / pair.film;
    longest(IN_A_BED, depth).min(longest(IN_AN_IMPACT, pair.largest_overlap(speed))).min(film)
}
