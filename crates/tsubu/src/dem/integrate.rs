//! Time integration of grains, split around the evaluation of forces.

use crate::state::Grains;
use glam::DVec3;
use tsubu_scene::plan::Integrator;

/// Velocities half-way through a step, kept between the two halves.
#[derive(Clone, Debug, Default)]
pub(super) struct Halves {
    velocity: Vec<DVec3>,
    spin: Vec<DVec3>,
}

/// Before the forces: brings positions to the end of the step, and velocities there too, predicted with the old
/// acceleration, so that forces that depend on velocity see positions and velocities of one time level.
pub(super) fn before(grains: &mut Grains, halves: &mut Halves, integrator: Integrator, dt: f64) {
    match integrator {
        Integrator::VelocityVerlet => {
            halves.velocity.resize(grains.len(), DVec3::ZERO);
            halves.spin.resize(grains.len(), DVec3::ZERO);
            half(&mut grains.velocity, &grains.acceleration, &mut halves.velocity, dt);
            half(&mut grains.spin, &grains.spin_rate, &mut halves.spin, dt);
            drift(&mut grains.position, &halves.velocity, dt);
        }
        Integrator::SymplecticEuler => {
            kick(grains, dt);
            drift(&mut grains.position, &grains.velocity, dt);
        }
        Integrator::ForwardEuler => {
            drift(&mut grains.position, &grains.velocity, dt);
            kick(grains, dt);
        }
    }
}

/// After the forces: completes the velocities with the new acceleration. Returns what the losses, which were computed with
/// the predicted velocities, must be corrected by [W].
///
/// The path that Verlet's positions trace has the velocity (x(t+dt) - x(t-dt)) / 2 dt - (dt^2/6) da/dt, which to this
/// order is one third of the predicted and two thirds of the completed velocity; the energy that a force takes along the
/// path is force times that. Without the correction the books of an impact at 20 steps per contact miss 0.4 % of its
/// energy, with it 0.02 %.
pub(super) fn after(
    grains: &mut Grains,
    halves: &Halves,
    integrator: Integrator,
    dt: f64,
    lossy: &[DVec3],
    torque: &[DVec3],
) -> f64 {
    if integrator != Integrator::VelocityVerlet {
        return 0.0;
    }
    let linear = finish(&mut grains.velocity, &grains.acceleration, &halves.velocity, dt, lossy);
    let angular = finish(&mut grains.spin, &grains.spin_rate, &halves.spin, dt, torque);
    -2.0 / 3.0 * (linear + angular)
}

/// half = v + a dt/2; v becomes the prediction half + a dt/2.
fn half(v: &mut [DVec3], a: &[DVec3], half: &mut [DVec3], dt: f64) {
    for ((v, a), half) in v.iter_mut().zip(a).zip(half) {
        let kick = *a * (0.5 * dt);
        *half = *v + kick;
        *v = *half + kick;
    }
}

/// Completes the velocities; returns the work that the changes take from the given forces.
fn finish(v: &mut [DVec3], a: &[DVec3], half: &[DVec3], dt: f64, force: &[DVec3]) -> f64 {
    let mut power = 0.0;
    for (((v, a), half), force) in v.iter_mut().zip(a).zip(half).zip(force) {
        let complete = *half + *a * (0.5 * dt);
        power += force.dot(complete - *v);
        *v = complete;
    }
    power
}

fn drift(position: &mut [DVec3], velocity: &[DVec3], dt: f64) {
    for (p, v) in position.iter_mut().zip(velocity) {
        *p += *v * dt;
    }
}

fn kick(grains: &mut Grains, dt: f64) {
    for (v, a) in grains.velocity.iter_mut().zip(&grains.acceleration) {
        *v += *a * dt;
    }
    for (w, a) in grains.spin.iter_mut().zip(&grains.spin_rate) {
        *w += *a * dt;
    }
}
