//! How fast bonded grains vibrate.

use crate::beam::Stiffness;
use crate::sizes;
use std::f64::consts::TAU;
use tsubu_scene::plan::{Bond, GrainMotion, GrainShape, Particles, Plan};

/// Shortest period of bonded grains [s]; infinite without bonds.
///
/// Of the smallest grains, each with as many bonds as it can have neighbours of its size (12, in the plane 6), evenly around it. In the fastest
/// vibration of such a bed neighbours go against each other: then every bond is stretched, sheared and bent by twice what a grain does.
/// Shaking and turning are coupled; the square of the frequency is at most the sum of both.
pub(super) fn shortest_period(plan: &Plan) -> f64 {
    plan.bond.iter().map(|bond| TAU / fastest(plan, bond)).fold(f64::INFINITY, f64::min)
}

/// Largest angular frequency of the grains of a bond [1/s].
fn fastest(plan: &Plan, bond: &Bond) -> f64 {
    let joined = plan.particles.iter().filter(|(name, group)| group.count > 0 && bond.joins(name));
    let free = joined.filter(|(_, group)| matches!(group.motion, GrainMotion::Free {}));
    free.map(|(_, group)| of_smallest(plan, bond, group)).fold(0.0, f64::max)
}

/// What bonds hold.
struct Grain {
    /// Of the sphere that bonds take it for [m].
    radius: f64,
    /// Shortest bond [m].
    length: f64,
    mass: f64,
    /// Least moment of inertia [kg.m^2].
    inertia: f64,
}

/// The smallest of a group; of a clump its smallest sphere, with the mass that it shows there.
fn smallest(plan: &Plan, group: &Particles) -> Grain {
    let smallest = group.smallest_diameter();
    let (mass, flat) = (sizes::mass(group, smallest), plan.dimension == 2);
    let clump = group.shape.clump();
    if let Some(body) = clump.as_ref().filter(|body| body.is_one_piece()) {
        let moments = body.moments.map(|moment| moment * mass * smallest * smallest);
        return Grain {
            radius: body.equivalent_radius(flat) * smallest,
            length: group.shape.sure(smallest),
            mass,
            inertia: if flat { moments[1] } else { moments.into_iter().fold(f64::INFINITY, f64::min) },
        };
    }
    let ([thin, _], lightness) = clump.map_or(([0.5; 2], 1.0), |clump| (clump.radii(), clump.lightness()));
    let (radius, mass) = (thin * smallest, mass / lightness);
    let share = if matches!(group.shape, GrainShape::Disc { .. }) { 0.5 } else { 0.4 };
    Grain { radius, length: 2.0 * radius, mass, inertia: share * mass * radius * radius }
}

fn of_smallest(plan: &Plan, bond: &Bond, group: &Particles) -> f64 {
    let Grain { radius, length, mass, inertia } = smallest(plan, group);
    let Stiffness { stretch, ends, bend, twist } = Stiffness::of(bond, bond.radius * radius, length);
    // Turned ends of a bond whose grains are shifted: each by the shift over the length.
    let shear = 2.0 * ends / (length * length);
    let turned = ends.max(ends + 2.0 * bend);
    // Neighbours, and what of their bonds each direction has: shaking meets 1 / D along a bond and the rest across it, turning in the plane all of them.
    let (neighbours, shaken, turned) = if plan.dimension == 2 {
        (6.0, 0.5 * stretch + 0.5 * shear, turned)
    } else {
        (12.0, (stretch + 2.0 * shear) / 3.0, 2.0 * (turned + twist) / 3.0)
    };
    (neighbours * (2.0 * shaken / mass + turned / inertia)).sqrt()
}
