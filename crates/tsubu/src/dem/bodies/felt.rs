//! What bodies feel by their pieces.

use super::{Body, Piece};
use crate::state::Grains;
use glam::DVec3;

/// What the pieces of a body feel, summed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Felt {
    pub force: DVec3,
    /// About the centre of mass [N.m].
    pub torque: DVec3,
    /// The part of both that takes energy away.
    pub loss: [DVec3; 2],
}

impl Felt {
    /// Leaves out what rounding would bring out of the plane, where round bodies are looked for as in space.
    pub fn stay_in_plane(&mut self) {
        self.force.y = 0.0;
        self.torque = DVec3::new(0.0, self.torque.y, 0.0);
    }
}

/// The pieces of all bodies, with what each feels in the columns of the grains, see [`super::super::integrate`].
pub struct Pieces<'a> {
    pub grains: &'a Grains,
    pub sorted: &'a [Piece],
    pub places: &'a [u32],
    /// See [`super::Bodies`].
    pub plane: bool,
    pub locked: bool,
}

impl Pieces<'_> {
    /// What a body feels.
    #[inline]
    pub fn felt(&self, body: &Body) -> Felt {
        let Self { grains, sorted, places, plane, locked } = *self;
        let mut felt = Felt::default();
        for &place in &places[body.pieces.clone()] {
            let i = place as usize;
            let (force, torque, dissipative) =
                (grains.acceleration[i], grains.angular_acceleration[i], grains.velocity[i]);
            let arm = body.arm(&sorted[i], plane);
            felt.force += force;
            felt.torque += torque + arm.cross(force);
            felt.loss[0] += dissipative;
            felt.loss[1] += torque + arm.cross(dissipative);
        }
        if locked {
            (felt.torque, felt.loss[1]) = (DVec3::ZERO, DVec3::ZERO);
        }
        if plane {
            felt.stay_in_plane();
        }
        felt
    }
}
