//! Volumes of grains of any shape.

use crate::state::sphere;
use crate::view::View;
use std::f64::consts::PI;
use tsubu_scene::plan::{Particles, Plan};

/// Volumes of grains [m^3], or where it is `flat` their areas in the plane [m^2].
#[derive(Clone, Debug)]
pub(super) struct Volumes {
    flat: bool,
    /// By the numbers of the groups.
    of: Vec<Volume>,
}

/// Of the grains of a group.
#[derive(Clone, Copy, Debug)]
enum Volume {
    /// That of a sphere, or of a disc, times so much: of the spheres of a clump the same share each, so that what overlaps counts once.
    OfSphere(f64),
    /// So much for a kilogram [m^3/kg or m^2/kg].
    OfMass(f64),
}

impl Volumes {
    pub fn new(plan: &Plan, flat: bool) -> Self {
        let of = |group: &Particles| {
            let Some(body) = group.shape.clump() else { return Volume::OfSphere(1.0) };
            if !flat {
                Volume::OfMass(group.shape.mass(1.0, group.diameter) / group.mass)
            } else if group.shape.is_flat() {
                Volume::OfMass(body.volume * group.diameter * group.diameter / group.mass)
            } else {
                Volume::OfSphere(body.area() / body.pieces.iter().map(|(_, r)| PI * r * r).sum::<f64>())
            }
        };
        Self { flat, of: plan.particles.values().map(of).collect() }
    }

    /// Of a grain, which may be one of the spheres of a clump.
    pub fn of(&self, view: &View, i: usize) -> f64 {
        let (r, group) = (view.grains.radius[i], view.grains.group[i] as usize);
        match self.of.get(group).copied().unwrap_or(Volume::OfSphere(1.0)) {
            Volume::OfSphere(share) if self.flat => share * (PI * r * r),
            Volume::OfSphere(share) => share * sphere::volume(r),
            Volume::OfMass(per_mass) => per_mass * view.grains.mass[i],
        }
    }
}
