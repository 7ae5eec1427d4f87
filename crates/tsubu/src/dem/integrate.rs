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

/// After the forces: completes the velocities with the new acceleration.
pub(super) fn after(grains: &mut Grains, halves: &Halves, integrator: Integrator, dt: f64) {
    if integrator == Integrator::VelocityVerlet {
        finish(&mut grains.velocity, &grains.acceleration, &halves.velocity, dt);
        finish(&mut grains.spin, &grains.spin_rate, &halves.spin, dt);
    }
}

/// half = v + a dt/2; v becomes the prediction half + a dt/2.
fn half(v: &mut [DVec3], a: &[DVec3], half: &mut [DVec3], dt: f64) {
    for ((v, a), half) in v.iter_mut().zip(a).zip(half) {
        let kick = *a * (0.5 * dt);
        *half = *v + kick;
        *v = *half + kick;
    }
}

fn finish(v: &mut [DVec3], a: &[DVec3], half: &[DVec3], dt: f64) {
    for ((v, a), half) in v.iter_mut().zip(a).zip(half) {
        *v = *half + *a * (0.5 * dt);
    }
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
