//! Bodies in water, which acts on each as on the sphere of its volume, with the drag that its sphericity gives it.

use super::{Bodies, Body};
use crate::state::{Grains, moved_along};
use glam::DVec3;
use std::borrow::Cow;

impl Bodies {
    /// Whether a grain is a piece of a body, but not the one that water acts on for the whole.
    pub fn follows(&self, i: usize) -> bool {
        self.body(i).is_some() && self.led_by(i).is_none()
    }

    /// The body that water acts on where this grain is, its first piece, and the way there from the centre of mass [m].
    #[inline]
    pub fn led_by(&self, i: usize) -> Option<(&Body, DVec3)> {
        let body = self.body(i)?;
        (self.places[body.pieces.start] as usize == i).then(|| (body, body.arm(&self.sorted[i], self.plane)))
    }

    /// Centres [m] and radii [m] of the spheres that make room in water: of the grains, and in the place of bodies one of the volume of each.
    pub fn spheres_in_water<'a>(&self, grains: &'a Grains) -> (Cow<'a, [DVec3]>, Cow<'a, [f64]>) {
        if self.is_empty() {
            return ((&grains.position).into(), (&grains.radius).into());
        }
        let sphere = |i: usize| match self.led_by(i) {
            Some((body, arm)) => (grains.position[i] - arm, body.submerged.radius),
            None => (grains.position[i], grains.radius[i]),
        };
        let (position, radius): (Vec<DVec3>, Vec<f64>) =
            (0..grains.len()).filter(|i| !self.follows(*i)).map(sphere).unzip();
        (position.into(), radius.into())
    }

    /// Gives bodies the mass of the water that moves along with each [kg], `added` says how much with which at what height [m] of its centre.
    pub fn add_mass(&mut self, grains: &mut Grains, mut added: impl FnMut(&Body, f64) -> f64) {
        for rank in &self.rank {
            let k = *rank as usize;
            let body = &self.list[k];
            let Some(&first) = self.places.get(body.pieces.start).filter(|_| body.is_there()) else { continue };
            let first = first as usize;
            let arm = body.arm(&self.sorted[first], self.plane);
            let inverse = 1.0 / (body.mass + added(body, grains.position[first].z - arm.z));
            let body = &mut self.list[k];
            body.added_mass = moved_along(body.mass, inverse);
            for place in &self.places[body.pieces.clone()] {
                grains.inverse_mass[*place as usize] = inverse;
            }
        }
    }

    /// Gives every piece its part by mass of what its body feels [N]: the sum over the pieces, and what moves the water that goes along.
    pub fn share_water_force(&self, grains: &Grains, forces: &mut [DVec3]) {
        for body in self.there() {
            let pieces = || self.places[body.pieces.clone()].iter().map(|place| *place as usize);
            let all = pieces().map(|i| forces[i]).sum::<DVec3>() + body.added_mass * body.acceleration;
            pieces().for_each(|i| forces[i] = grains.mass[i] / body.mass * all);
        }
    }
}
