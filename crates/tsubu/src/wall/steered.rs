//! Walls that somebody outside the program moves: with a velocity and a spin that hold until others are told.

use super::{Mover, Pose, Wall};
use glam::{DQuat, DVec3};
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;

/// Velocity of a wall as somebody tells it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Velocity {
    /// Of its centre of rotation [m/s].
    pub linear: DVec3,
    /// Spin about that centre [rad/s].
    pub spin: DVec3,
}

/// The motion since the last word.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steered {
    since: f64,
    offset: DVec3,
    rotation: DQuat,
    velocity: Velocity,
}

impl Steered {
    pub(super) fn displacement(&self, time: f64) -> (DVec3, DVec3) {
        (self.offset + self.velocity.linear * (time - self.since), self.velocity.linear)
    }

    pub(super) fn rotation(&self, time: f64) -> (DQuat, DVec3) {
        let spin = self.velocity.spin;
        if spin == DVec3::ZERO {
            return (self.rotation, spin);
        }
        (DQuat::from_scaled_axis(spin * (time - self.since)) * self.rotation, spin)
    }

    fn numbers(&self) -> [f64; 14] {
        let ([x, y, z], [i, j, k, w]) = (self.offset.to_array(), self.rotation.to_array());
        let ([u, v, s], [a, b, c]) = (self.velocity.linear.to_array(), self.velocity.spin.to_array());
        [self.since, x, y, z, i, j, k, w, u, v, s, a, b, c]
    }

    fn of([since, x, y, z, i, j, k, w, u, v, s, a, b, c]: [f64; 14]) -> Self {
        let velocity = Velocity { linear: DVec3::new(u, v, s), spin: DVec3::new(a, b, c) };
        Self { since, offset: DVec3::new(x, y, z), rotation: DQuat::from_xyzw(i, j, k, w), velocity }
    }
}

impl Wall {
    /// Moves with this velocity from `time` [s] on, from where it stands; what moved it before has no say any more. In the plane only
    /// what lies in it counts. Says why not where forces move it.
    pub fn steer(&mut self, time: f64, mut velocity: Velocity) -> Result<(), String> {
        let forced = match self.mover {
            Mover::Host { .. } => "a host",
            Mover::Servo(_) => "a servo",
            Mover::Body(_) => "the grains",
            Mover::Still | Mover::Motion(..) | Mover::Steered(_) => "",
        };
        if !forced.is_empty() {
            return Err(format!("{forced} moves it by forces; steer a wall that stands still or has a `motion`"));
        }
        if self.in_plane && (velocity.linear.y != 0.0 || velocity.spin.x != 0.0 || velocity.spin.z != 0.0) {
            return Err("in the plane a wall moves along x and z and turns about y".to_owned());
        }
        if !(velocity.linear.is_finite() && velocity.spin.is_finite()) {
            return Err("a velocity is a finite number".to_owned());
        }
        // No minus zeros: a wall that rests is drawn as one that never moved.
        velocity.linear += DVec3::ZERO;
        let Pose { offset, rotation, .. } = self.pose;
        self.mover = Mover::Steered(Steered { since: time, offset, rotation, velocity });
        (self.turning, self.begun) = (None, None);
        (self.pose.velocity, self.pose.spin) = (velocity.linear, velocity.spin);
        Ok(())
    }

    /// Whether somebody outside moves it.
    pub fn steered(&self) -> bool {
        matches!(self.mover, Mover::Steered(_))
    }

    pub(super) fn save_steered(&self, state: &mut State) {
        if let Mover::Steered(steered) = &self.mover {
            state.put_real(&self.steered_section(), steered.numbers().to_vec());
        }
    }

    pub(super) fn load_steered(&mut self, state: &State) -> Result<(), MissingSection> {
        let section = self.steered_section();
        let Ok(values) = state.real(&section) else { return Ok(()) };
        let Ok(numbers) = <[f64; 14]>::try_from(values) else {
            return Err(MissingSection { name: section, kind: "real" });
        };
        self.mover = Mover::Steered(Steered::of(numbers));
        (self.turning, self.begun) = (None, None);
        Ok(())
    }

    fn steered_section(&self) -> String {
        format!("wall.{}.steered", self.name)
    }
}
