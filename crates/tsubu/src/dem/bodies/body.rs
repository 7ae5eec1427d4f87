//! One rigid body: how it moves and turns.

use super::Piece;
use crate::superellipsoid::Superellipsoid;
use glam::{DMat3, DQuat, DVec3};
use std::ops::Range;

/// Rounds of the midpoint rule; at usual steps it takes five to eight.
const ROUNDS: usize = 60;

/// A rigid body.
#[derive(Clone, Debug)]
pub struct Body {
    pub mass: f64,
    /// Moments of inertia about the principal axes [kg.m^2].
    pub moments: DVec3,
    /// What is in the place of its one sphere.
    pub superellipsoid: Option<Superellipsoid>,
    /// The number of the polyhedron that is there, and its diameter [m].
    pub polyhedron: Option<(u32, f64)>,
    /// Where its pieces are in the list of places; none where it is not there.
    pub pieces: Range<usize>,
    /// Centre of mass, never wrapped [m].
    pub centre: DVec3,
    /// Velocity of the centre [m/s].
    pub velocity: DVec3,
    /// Acceleration of the centre at the last time level [m/s^2].
    pub acceleration: DVec3,
    /// Turns the principal axes from x, y, z to where they are.
    pub orientation: DQuat,
    /// Angular momentum about the centre, in space [kg.m^2/s].
    pub angular_momentum: DVec3,
    /// Torque about the centre at the last time level [N.m].
    pub torque: DVec3,
    // What follows from these.
    pub axes: DMat3,
    /// Inverse inertia in space [1/(kg.m^2)].
    pub inverse_inertia: DMat3,
    pub spin: DVec3,
    /// What the losses of its contacts must be corrected by [W].
    pub correction: f64,
}

/// What the pieces of a body feel, summed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Felt {
    pub force: DVec3,
    /// About the centre of mass [N.m].
    pub torque: DVec3,
    /// The part of both that takes energy away.
    pub loss: [DVec3; 2],
}

impl Body {
    /// Whether it is among the grains.
    pub fn is_there(&self) -> bool {
        !self.pieces.is_empty()
    }

    /// Finds what follows from attitude and angular momentum.
    pub fn follow(&mut self, plane: bool) {
        self.axes = DMat3::from_quat(self.orientation);
        self.inverse_inertia = self.axes * DMat3::from_diagonal(self.moments.recip()) * self.axes.transpose();
        self.turn(plane);
    }

    /// Finds the spin in an attitude.
    fn turn(&mut self, plane: bool) {
        self.spin = self.inverse_inertia * self.angular_momentum;
        if plane {
            self.spin = DVec3::new(0.0, self.spin.y, 0.0);
        }
    }

    /// From the centre of mass to that of a piece [m].
    #[inline]
    pub fn arm(&self, piece: &Piece, plane: bool) -> DVec3 {
        let mut arm = self.axes * piece.offset;
        if plane {
            arm.y = 0.0;
        }
        arm
    }

    /// To the end of a step, velocities predicted with the old acceleration as those of spheres are.
    pub fn first_half(&mut self, dt: f64, plane: bool) {
        let kick = self.acceleration * (0.5 * dt);
        let half = self.velocity + kick;
        self.centre += half * dt;
        self.velocity = half + kick;
        let kick = self.torque * (0.5 * dt);
        let half = self.angular_momentum + kick;
        self.orientation = rotated(self.orientation, half, self.moments, dt);
        self.angular_momentum = half + kick;
        self.follow(plane);
    }

    pub fn vectors(&self) -> [DVec3; 5] {
        [self.centre, self.velocity, self.acceleration, self.angular_momentum, self.torque]
    }

    pub fn vectors_mut(&mut self) -> [&mut DVec3; 5] {
        let Self { centre, velocity, acceleration, angular_momentum, torque, .. } = self;
        [centre, velocity, acceleration, angular_momentum, torque]
    }

    /// Takes forces and torques, and completes the velocities, which the old ones have brought `share` [s] of the way.
    pub fn second_half(&mut self, felt: &Felt, gravity: DVec3, share: f64, plane: bool) {
        let acceleration = felt.force / self.mass + gravity;
        let change = (acceleration - self.acceleration) * share;
        self.acceleration = acceleration;
        self.velocity += change;
        let turn = (felt.torque - self.torque) * share;
        self.torque = felt.torque;
        self.angular_momentum += turn;
        let before = self.spin;
        self.turn(plane);
        self.correction = felt.loss[0].dot(change) + felt.loss[1].dot(self.spin - before);
    }
}

/// Where free rotation brings an orientation in `dt` [s], with an angular momentum in space and moments about the principal axes.
///
/// In the body the momentum p obeys dp/dt = p x w, w = I^-1 p. The midpoint m of both ends obeys m + a x m = p with a = w dt/2, so
/// m = (p + a (a.p) - a x p) / (1 + a^2), and the attitude turns by the quaternion (1, a), normalised.
fn rotated(orientation: DQuat, momentum: DVec3, moments: DVec3, dt: f64) -> DQuat {
    let p = orientation.conjugate() * momentum;
    let slowness = moments.recip() * (0.5 * dt);
    let mut a = p * slowness;
    for _ in 0..ROUNDS {
        let middle = (p + a * a.dot(p) - a.cross(p)) / (1.0 + a.length_squared());
        let next = middle * slowness;
        let same = (next - a).length_squared() <= 1e-32 * next.length_squared();
        a = next;
        if same {
            break;
        }
    }
    (orientation * DQuat::from_xyzw(a.x, a.y, a.z, 1.0).normalize()).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Free tumbling about the middle axis (Dzhanibekov), moments 1 : 50 : 100, 40 steps a turn, 1e5 turns: the energy keeps to rounding
    /// that grows as a random walk does. The same with the spin of the beginning of each step, which is of first order, is refused.
    #[test]
    fn a_tumbling_body_keeps_its_energy() {
        let moments = DVec3::new(1.0, 50.0, 100.0);
        let momentum = DVec3::new(0.02, 50.0, 0.03);
        let energy = |q: DQuat| {
            let p = q.conjugate() * momentum;
            0.5 * p.dot(p / moments)
        };
        let dt = std::f64::consts::TAU / 40.0;
        let drift = |steps: usize, turn: &dyn Fn(DQuat) -> DQuat| {
            let (mut q, mut farthest, mut flipped) = (DQuat::IDENTITY, 0.0_f64, false);
            for _ in 0..steps {
                q = turn(q);
                farthest = farthest.max((energy(q) / energy(DQuat::IDENTITY) - 1.0).abs());
                flipped |= (q * DVec3::Y).y < -0.9;
            }
            (farthest, flipped)
        };
        let (off, flipped) = drift(4_000_000, &|q| rotated(q, momentum, moments, dt));
        assert!(flipped && off < 1e-11, "{off:e}");
        let naive = |q: DQuat| {
            let p = q.conjugate() * momentum;
            (q * DQuat::from_scaled_axis(p / moments * dt)).normalize()
        };
        let (off, _) = drift(4000, &naive);
        assert!(off > 1e-3, "{off:e}");
    }
}
