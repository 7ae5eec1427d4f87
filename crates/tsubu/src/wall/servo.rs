//! A wall that a constant force or pressure pushes against the grains.
//!
//! M s'' = F - c s' + F_grains, s the displacement along the guide; velocity Verlet in step with the grains, the damper
//! implicit, so any c is stable.

use super::mover::Exchange;
use crate::about::About;
use glam::DVec3;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;
use tsubu_scene::plan;

pub(crate) const ABOUT: About = About {
    key: "walls.NAME.servo",
    formula: "M s'' = F - c s' + F_grains",
    symbols: "s displacement along the guide [m], M moving mass [kg], F constant force, or pressure times area [N], c \
damping of the guide [N.s/m], F_grains force of the grains along the guide [N]",
    limits: "Velocity Verlet in step with the grains, the damper implicit, so any c is stable. The force keeps its direction. A \
pressure without an area acts on the face of a box of planes as large as it is at the time: the stress stays, whatever becomes of the \
box.",
    reference: "Newton's second law",
};

/// A mass on a guide.
#[derive(Clone, Debug, PartialEq)]
pub struct Servo {
    /// Unit direction of the guide and of the force.
    pub direction: DVec3,
    force: f64,
    pressure: Option<f64>,
    /// The force at the end of the step.
    next_force: f64,
    mass: f64,
    damping: f64,
    displacement: f64,
    velocity: f64,
    velocity_half: f64,
    acceleration: f64,
}

impl Servo {
    /// At rest where it was drawn, without grain forces.
    pub fn new(plan: &plan::Servo) -> Self {
        Self {
            direction: DVec3::from_array(plan.direction),
            force: plan.force.unwrap_or_default(),
            pressure: plan.pressure,
            next_force: plan.force.unwrap_or_default(),
            mass: plan.mass,
            damping: plan.damping,
            displacement: 0.0,
            velocity: 0.0,
            velocity_half: 0.0,
            acceleration: plan.force.unwrap_or_default() / plan.mass,
        }
    }

    /// Displacement s [m].
    pub fn displacement(&self) -> f64 {
        self.displacement
    }

    /// Velocity s' [m/s]; between `before` and `after` the one predicted for the end of the step.
    pub fn velocity(&self) -> f64 {
        self.velocity
    }

    /// Kinetic energy [J].
    pub fn kinetic(&self) -> f64 {
        0.5 * self.mass * self.velocity * self.velocity
    }

    /// Takes the area that a pressure acts on at the end of the step [m^2].
    pub fn cover(&mut self, area: f64) {
        if let Some(pressure) = self.pressure {
            self.next_force = pressure * area;
        }
    }

    /// Whether a pressure on a face moves it.
    pub fn is_pressed(&self) -> bool {
        self.pressure.is_some()
    }

    /// Takes the force of the grains at time 0 [N].
    pub fn start(&mut self, grain_force: DVec3) {
        self.force = self.next_force;
        let net = self.force - self.damping * self.velocity + grain_force.dot(self.direction);
        self.acceleration = net / self.mass;
    }

    /// First half of a step: half kick and drift; the velocity becomes a prediction.
    pub fn before(&mut self, dt: f64) {
        self.velocity_half = self.velocity + 0.5 * dt * self.acceleration;
        self.displacement += dt * self.velocity_half;
        self.velocity = self.velocity_half + 0.5 * dt * self.acceleration;
    }

    /// Second half: the grains' force [N] is known. Returns the work of the step by the trapezoidal rule.
    pub fn after(&mut self, grain_force: DVec3, dt: f64) -> Exchange {
        let old = self.velocity_half - 0.5 * dt * self.acceleration;
        let net = self.next_force - self.damping * self.velocity_half + grain_force.dot(self.direction);
        self.acceleration = net / (self.mass + 0.5 * dt * self.damping);
        self.velocity = self.velocity_half + 0.5 * dt * self.acceleration;
        let force = std::mem::replace(&mut self.force, self.next_force);
        Exchange {
            work: 0.5 * dt * (force * old + self.force * self.velocity),
            lost: 0.5 * dt * self.damping * (old * old + self.velocity * self.velocity),
        }
    }

    /// Writes itself into a checkpoint.
    pub fn save(&self, name: &str, state: &mut State) {
        let force = self.is_pressed().then_some(self.force);
        let numbers = [self.displacement, self.velocity, self.acceleration].into_iter().chain(force);
        state.put_real(name, numbers.collect::<Vec<_>>());
    }

    /// Takes itself back from a checkpoint.
    pub fn load(&mut self, name: &str, state: &State) -> Result<(), MissingSection> {
        let (&[displacement, velocity, acceleration], force) = match state.real(name)?.split_first_chunk::<3>() {
            Some((numbers, force)) if force.len() == usize::from(self.is_pressed()) => (numbers, force),
            _ => return Err(MissingSection { name: name.to_owned(), kind: "real" }),
        };
        if let [force] = force {
            (self.force, self.next_force) = (*force, *force);
        }
        (self.displacement, self.velocity, self.acceleration) = (displacement, velocity, acceleration);
        Ok(())
    }
}
