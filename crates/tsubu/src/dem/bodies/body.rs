//! One rigid body: how it moves and turns.

#![allow(clippy::inline_always, reason = "a call inside a row would end the vector code of its loop")]

use super::Piece;
use super::felt::Felt;
use crate::polyhedron::Faceted;
use crate::superellipsoid::Superellipsoid;
use crate::superellipsoid::ellipsoids::Ellipsoid;
use crate::superellipsoid::symmetric::Symmetric;
use crate::water::Submerged;
use glam::{DMat3, DQuat, DVec3};
use multiversion::multiversion;
use std::ops::Range;

/// Rounds of the midpoint rule; at usual steps it takes five to eight.
const ROUNDS: usize = 60;

/// A rigid body. What every block asks of those that it sees stands first, in few lines of the cache, what a step asks of each next.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub struct Body {
    /// Of a polyhedron a path that no point of it has exceeded since the lists were made [m].
    pub path: f64,
    /// The polyhedron that is there.
    pub polyhedron: Option<Faceted>,
    pub axes: DMat3,
    /// Inverse inertia in space [1/(kg.m^2)].
    pub inverse_inertia: DMat3,
    /// Centre of mass, never wrapped [m].
    pub centre: DVec3,
    /// Velocity of the centre [m/s].
    pub velocity: DVec3,
    pub spin: DVec3,
    /// Acceleration of the centre at the last time level [m/s^2].
    pub acceleration: DVec3,
    /// Angular momentum about the centre, in space [kg.m^2/s].
    pub angular_momentum: DVec3,
    /// Torque about the centre at the last time level [N.m].
    pub torque: DVec3,
    /// Turns the principal axes from x, y, z to where they are.
    pub orientation: DQuat,
    /// Moments of inertia about the principal axes [kg.m^2].
    pub moments: DVec3,
    pub mass: f64,
    /// Mass of the water that moves along with it [kg].
    pub added_mass: f64,
    /// What the losses of its contacts must be corrected by [W].
    pub correction: f64,
    /// Where its pieces are in the list of places; none where it is not there.
    pub pieces: Range<usize>,
    /// See [`super::Bodies`].
    pub number: u32,
    /// What is in the place of its one sphere.
    pub superellipsoid: Option<Superellipsoid>,
    /// The ellipsoid with the semi-axes of the superellipsoid.
    pub ellipsoid: Ellipsoid,
    /// Radius of the sphere of its volume, in the plane of the disc of its area, where it is one piece [m].
    pub equivalent_radius: Option<f64>,
    /// What water sees of it.
    pub submerged: Submerged,
}

impl Body {
    /// Whether it is among the grains.
    pub fn is_there(&self) -> bool {
        !self.pieces.is_empty()
    }

    /// Finds what follows from attitude and angular momentum.
    #[inline(always)]
    pub fn follow(&mut self, plane: bool) {
        self.axes = DMat3::from_quat(self.orientation);
        if let Some(shape) = &self.superellipsoid {
            self.ellipsoid.squared = Symmetric::along(shape.semi_axes * shape.semi_axes, &self.axes);
            self.ellipsoid.inverse_inertia = Symmetric::along(self.moments.recip(), &self.axes);
            self.inverse_inertia = self.ellipsoid.inverse_inertia.full();
        } else {
            self.inverse_inertia = self.axes * DMat3::from_diagonal(self.moments.recip()) * self.axes.transpose();
        }
        self.turn(plane);
    }

    /// Finds the spin in an attitude.
    #[inline(always)]
    fn turn(&mut self, plane: bool) {
        self.spin = self.inverse_inertia * self.angular_momentum;
        if plane {
            self.spin = DVec3::new(0.0, self.spin.y, 0.0);
        }
    }

    /// From the centre of mass to that of a piece [m].
    #[inline(always)]
    pub(super) fn arm(&self, piece: &Piece, plane: bool) -> DVec3 {
        let mut arm = self.axes * piece.offset;
        if plane {
            arm.y = 0.0;
        }
        arm
    }

    /// Adds to the path of a polyhedron, with what rounding may lose.
    fn go(&mut self, way: f64) {
        if let Some(body) = &self.polyhedron {
            self.path += (1.0 + 1e-9) * way + 1e-12 * body.size;
        }
    }

    pub fn vectors(&self) -> [DVec3; 5] {
        [self.centre, self.velocity, self.acceleration, self.angular_momentum, self.torque]
    }

    pub fn vectors_mut(&mut self) -> [&mut DVec3; 5] {
        let Self { centre, velocity, acceleration, angular_momentum, torque, .. } = self;
        [centre, velocity, acceleration, angular_momentum, torque]
    }

    /// Takes forces and torques, and completes the velocities, which the old ones have brought `share` [s] of the way.
    #[inline(always)]
    pub fn second_half(&mut self, felt: &Felt, gravity: DVec3, share: f64, plane: bool) {
        let acceleration = felt.force / (self.mass + self.added_mass) + gravity;
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

/// Up to [`TOGETHER`] bodies go to the end of a step, velocities predicted with the old acceleration as those of spheres are.
#[multiversion(targets = "simd")]
pub fn first_half(bodies: &mut [Body], dt: f64, plane: bool) {
    let mut turns = Turns::default();
    for (k, body) in bodies.iter_mut().enumerate().filter(|(_, body)| body.is_there()) {
        let kick = body.acceleration * (0.5 * dt);
        let half = body.velocity + kick;
        body.centre += half * dt;
        body.go(half.length() * dt);
        body.velocity = half + kick;
        body.angular_momentum += body.torque * (0.5 * dt);
        turns.set(k, body.orientation, body.angular_momentum, body.moments, dt);
    }
    turn(&mut turns);
    for (k, body) in bodies.iter_mut().enumerate().filter(|(_, body)| body.is_there()) {
        body.orientation = turns.turned(k, body.orientation);
        // It turns by twice the arc tangent of this, about its centre.
        body.go(body.polyhedron.as_ref().map_or(0.0, |body| at(&turns.a, k).length() * body.size));
        body.angular_momentum += body.torque * (0.5 * dt);
        body.follow(plane);
    }
}

/// Bodies that go together: vectors hold them side by side.
pub const TOGETHER: usize = 16;

type Columns = [[f64; TOGETHER]; 3];

/// Where free rotation brings orientations in a step, with angular momenta in space and moments about the principal axes.
///
/// In the body the momentum p obeys dp/dt = p x w, w = I^-1 p. The midpoint m of both ends obeys m + a x m = p with a = w dt/2, so
/// m = (p + a (a.p) - a x p) / (1 + a^2), and the attitude turns by the quaternion (1, a), normalised.
#[derive(Default)]
struct Turns {
    /// p, in the body.
    momentum: Columns,
    /// dt/2 over the moments.
    slowness: Columns,
    a: Columns,
}

impl Turns {
    #[inline(always)]
    fn set(&mut self, k: usize, orientation: DQuat, momentum: DVec3, moments: DVec3, dt: f64) {
        let p = orientation.conjugate() * momentum;
        let slowness = moments.recip() * (0.5 * dt);
        for (columns, v) in [(&mut self.momentum, p), (&mut self.slowness, slowness), (&mut self.a, p * slowness)] {
            (columns[0][k], columns[1][k], columns[2][k]) = (v.x, v.y, v.z);
        }
    }

    /// An orientation after the turn.
    #[inline(always)]
    fn turned(&self, k: usize, orientation: DQuat) -> DQuat {
        let a = at(&self.a, k);
        (orientation * DQuat::from_xyzw(a.x, a.y, a.z, 1.0).normalize()).normalize()
    }
}

#[inline(always)]
fn at(columns: &Columns, k: usize) -> DVec3 {
    DVec3::new(columns[0][k], columns[1][k], columns[2][k])
}

/// Finds a of all; each stays where it is once it has been found.
#[multiversion(targets = "simd")]
fn turn(turns: &mut Turns) {
    let Turns { momentum, slowness, a: columns } = turns;
    let mut found = [0.0; TOGETHER];
    for _ in 0..ROUNDS {
        for k in 0..TOGETHER {
            let (p, a) = (at(momentum, k), at(columns, k));
            let middle = (p + a * a.dot(p) - a.cross(p)) / (1.0 + a.length_squared());
            let next = middle * at(slowness, k);
            let same = (next - a).length_squared() <= 1e-32 * next.length_squared();
            let before = found[k];
            let next = if before > 0.0 { a } else { next };
            (columns[0][k], columns[1][k], columns[2][k]) = (next.x, next.y, next.z);
            found[k] = if same { 1.0 } else { before };
        }
        if !found.contains(&0.0) {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rotated(orientation: DQuat, momentum: DVec3, moments: DVec3, dt: f64) -> DQuat {
        let mut turns = Turns::default();
        turns.set(0, orientation, momentum, moments, dt);
        turn(&mut turns);
        turns.turned(0, orientation)
    }

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

    /// A heavy symmetric top (Goldstein 1980, section 5.7) that goes around steadily: its axis keeps its tilt t where
    /// I1 W^2 cos t - I3 w W + G = 0, with the rate W of the axis about the vertical, the spin w about the axis and G the torque over
    /// sin t. Turned as bodies are, torques in two halves around it, 1e5 turns of 40 steps: the angular momentum about the vertical
    /// keeps to rounding, the energy and the rate to the square of the step, without a drift: the second half is no farther off than
    /// the first. With a whole torque before each turn, and the spin of its beginning, the energy goes away.
    #[test]
    fn a_top_keeps_its_energy_and_its_angular_momentum() {
        const TURNS: usize = 100_000;
        let (moments, tilt, spin, torque) = (DVec3::new(2.0, 2.0, 1.0), 0.5_f64, 1.0_f64, 0.02_f64);
        let (a, b) = (moments.x * tilt.cos(), moments.z * spin);
        let rate = 2.0 * torque / (b + (b * b - 4.0 * a * torque).sqrt());
        let axis = |q: DQuat| q * DVec3::Z;
        let energy = |q: DQuat, l: DVec3| {
            let p = q.conjugate() * l;
            0.5 * p.dot(p / moments) + torque * axis(q).z
        };
        let push = |q: DQuat| torque * axis(q).cross(DVec3::NEG_Z);
        let begin = DQuat::from_rotation_x(-tilt);
        let momentum =
            begin * (moments * (begin.conjugate() * DVec3::Z * rate * DVec3::new(1.0, 1.0, 0.0) + DVec3::Z * spin));
        let dt = std::f64::consts::TAU / 40.0;
        let run = |turns: usize, step: &dyn Fn(DQuat, DVec3) -> (DQuat, DVec3)| {
            let (mut q, mut l, mut off, mut around, mut momentum_off) = (begin, momentum, [0.0_f64; 2], 0.0, 0.0_f64);
            for k in 0..40 * turns {
                let before = axis(q);
                (q, l) = step(q, l);
                let after = axis(q);
                around += (before.x * after.y - before.y * after.x).atan2(before.x * after.x + before.y * after.y);
                let half = &mut off[k / (20 * turns)];
                *half = half.max((energy(q, l) / energy(begin, momentum) - 1.0).abs());
                momentum_off = momentum_off.max((l.z / momentum.z - 1.0).abs());
            }
            (off, around / (40 * turns) as f64 / dt, momentum_off)
        };
        let ours = |q: DQuat, l: DVec3| {
            let half = l + 0.5 * dt * push(q);
            let turned = rotated(q, half, moments, dt);
            (turned, half + 0.5 * dt * push(turned))
        };
        let (off, found, momentum_off) = run(TURNS, &ours);
        assert!(momentum_off < 1e-10, "{momentum_off:e}");
        assert!(off[0] < 1e-4 && off[1] < 1.01 * off[0], "{off:?}");
        assert!((found / rate - 1.0).abs() < 1e-2, "{found} {rate}");
        let naive = |q: DQuat, l: DVec3| {
            let l = l + dt * push(q);
            let p = q.conjugate() * l;
            ((q * DQuat::from_scaled_axis(p / moments * dt)).normalize(), l)
        };
        let (off, ..) = run(TURNS / 100, &naive);
        assert!(off[1] > 1e-2, "{off:?}");
    }
}
