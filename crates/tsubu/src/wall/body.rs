//! A free rigid body: six degrees of freedom under gravity and the forces of the grains.
//!
//! Translation by velocity Verlet. Rotation in the same steps: half kick of the angular momentum L by the torque, free
//! turning, half kick. The free turning is split into turns about the principal axes, x/2 y/2 z y/2 x/2, each the exact
//! flow of its share L_k^2 / (2 I_k) of the energy (an exponential map): time-reversible, symplectic, and L, kept in
//! the world frame, does not change at all (Dullweber, Leimkuhler, McLachlan 1997).

use crate::about::About;
use glam::{DQuat, DVec3};
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;
use tsubu_scene::plan;

pub(crate) const ABOUT: About = About {
    key: "walls.NAME.body",
    formula: "m x'' = m g + sum f,  dL/dt = sum (c - x) x f",
    symbols: "x centre of mass [m], m mass [kg], g gravity [m/s^2], f contact forces at points c [N, m], L angular \
momentum [kg.m^2/s]",
    limits: "Its surface is a wall: two bodies do not touch each other, nor walls. Rotation is a product of exact turns \
about the principal axes, symplectic and time-reversible.",
    reference: "Dullweber, Leimkuhler, McLachlan 1997",
};

/// A rigid body in motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    mass: f64,
    /// Inverse principal moments of inertia [1/(kg.m^2)]; zero where the body cannot turn.
    inverse_inertia: DVec3,
    gravity: DVec3,
    start: DVec3,
    centre: DVec3,
    velocity: DVec3,
    velocity_half: DVec3,
    acceleration: DVec3,
    rotation: DQuat,
    momentum: DVec3,
    momentum_half: DVec3,
    torque: DVec3,
}

impl Body {
    /// At time 0, without grain forces; `gravity` in [m/s^2].
    pub fn new(plan: &plan::Body, gravity: DVec3) -> Self {
        let inertia = DVec3::from_array(plan.inertia);
        let inverse = |i: f64| if i > 0.0 { 1.0 / i } else { 0.0 };
        let centre = DVec3::from_array(plan.centre);
        let momentum = inertia * DVec3::from_array(plan.spin);
        Self {
            mass: plan.mass,
            inverse_inertia: DVec3::new(inverse(inertia.x), inverse(inertia.y), inverse(inertia.z)),
            gravity,
            start: centre,
            centre,
            velocity: DVec3::from_array(plan.velocity),
            velocity_half: DVec3::ZERO,
            acceleration: gravity,
            rotation: DQuat::IDENTITY,
            momentum,
            momentum_half: momentum,
            torque: DVec3::ZERO,
        }
    }

    /// Centre of mass at time 0 [m].
    pub fn drawn_centre(&self) -> DVec3 {
        self.start
    }

    /// Centre of mass [m].
    pub fn centre(&self) -> DVec3 {
        self.centre
    }

    /// Velocity of the centre [m/s]; between `before` and `after` the one predicted for the end of the step.
    pub fn velocity(&self) -> DVec3 {
        self.velocity
    }

    /// Rotation since time 0.
    pub fn rotation(&self) -> DQuat {
        self.rotation
    }

    /// Angular momentum about the centre [kg.m^2/s]; between `before` and `after` predicted.
    pub fn angular_momentum(&self) -> DVec3 {
        self.momentum
    }

    /// Spin [rad/s]: R I^-1 R^T L.
    pub fn spin(&self) -> DVec3 {
        self.rotation * (self.inverse_inertia * (self.rotation.conjugate() * self.momentum))
    }

    /// Momentum [kg.m/s].
    pub fn momentum(&self) -> DVec3 {
        self.mass * self.velocity
    }

    /// Kinetic energy of translation and of rotation [J].
    pub fn kinetic(&self) -> (f64, f64) {
        (0.5 * self.mass * self.velocity.length_squared(), 0.5 * self.spin().dot(self.momentum))
    }

    /// Another gravity pulls from now on [m/s^2].
    pub fn pull(&mut self, gravity: DVec3) {
        self.acceleration += gravity - self.gravity;
        self.gravity = gravity;
    }

    /// Potential energy in gravity, from the origin [J].
    pub fn potential(&self) -> f64 {
        -self.mass * self.gravity.dot(self.centre)
    }

    /// Takes force [N] and torque about the centre [N.m] of the grains at time 0.
    pub fn start(&mut self, force: DVec3, torque: DVec3) {
        self.acceleration = self.gravity + force / self.mass;
        self.torque = torque;
    }

    /// First half of a step: half kick and drift; velocity and angular momentum become predictions.
    pub fn before(&mut self, dt: f64) {
        self.velocity_half = self.velocity + 0.5 * dt * self.acceleration;
        self.centre += dt * self.velocity_half;
        self.velocity = self.velocity_half + 0.5 * dt * self.acceleration;
        self.momentum_half = self.momentum + 0.5 * dt * self.torque;
        self.turn(dt);
        self.momentum = self.momentum_half + 0.5 * dt * self.torque;
    }

    /// Second half: force [N] and torque about the centre [N.m] of the grains are known.
    pub fn after(&mut self, force: DVec3, torque: DVec3, dt: f64) {
        self.start(force, torque);
        self.velocity = self.velocity_half + 0.5 * dt * self.acceleration;
        self.momentum = self.momentum_half + 0.5 * dt * self.torque;
    }

    /// Turns freely for `dt` with the angular momentum of the half step.
    fn turn(&mut self, dt: f64) {
        // L in the body's frame.
        let mut own = self.rotation.conjugate() * self.momentum_half;
        for (axis, share) in [(0, 0.5), (1, 0.5), (2, 1.0), (1, 0.5), (0, 0.5)] {
            let direction = DVec3::AXES[axis];
            let angle = share * dt * own[axis] * self.inverse_inertia[axis];
            let turn = DQuat::from_axis_angle(direction, angle);
            self.rotation *= turn;
            own = turn.conjugate() * own;
        }
        self.rotation = self.rotation.normalize();
    }

    /// Writes itself into a checkpoint.
    pub fn save(&self, name: &str, state: &mut State) {
        let vectors = [self.centre, self.velocity, self.acceleration, self.momentum, self.torque];
        let mut reals: Vec<f64> = vectors.iter().flat_map(DVec3::to_array).collect();
        reals.extend(self.rotation.to_array());
        state.put_real(name, reals);
    }

    /// Takes itself back from a checkpoint.
    pub fn load(&mut self, name: &str, state: &State) -> Result<(), MissingSection> {
        let reals = state.real(name)?;
        if reals.len() != 19 {
            return Err(MissingSection { name: name.to_owned(), kind: "real" });
        }
        let vector = |k: usize| DVec3::from_slice(&reals[3 * k..]);
        (self.centre, self.velocity, self.acceleration) = (vector(0), vector(1), vector(2));
        (self.momentum, self.torque) = (vector(3), vector(4));
        self.rotation = DQuat::from_slice(&reals[15..]);
        Ok(())
    }
}
