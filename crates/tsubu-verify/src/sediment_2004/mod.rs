//! Osada 2004: sediment as grains of a discrete element model.

mod avalanche;
mod contact;
mod dam_break;
mod dense_flow;
mod mobile_bed;
mod paths;
mod rod;
mod saltation;
mod settling;
mod space;
mod spin_up;

pub(super) use avalanche::{avalanche, avalanche_stiff};
pub(super) use contact::{contact_time, damped, overlap};
pub(super) use dam_break::{dam_break, dam_break_rolling};
pub(super) use dense_flow::dense_flow;
pub(super) use mobile_bed::mobile_bed;
pub(super) use rod::rod;
pub(super) use saltation::{saltation, softest};
pub(super) use settling::settling;
pub(super) use space::{dam_break_space, saltation_space};
pub(super) use spin_up::spinning;

use super::bench::Rig;
use std::f64::consts::PI;
use std::path::Path;
use tsubu_scene::Scene;

/// Density of the grains [kg/m^3]; the paper's contact times imply it.
const DENSITY: f64 = 2650.0;
/// Damping ratio that returns a restitution of 0.7 when the dashpot may pull: e = exp(-pi z / sqrt(1 - z^2)).
const DAMPING_RATIO: f64 = 0.112_808;

/// Mass of a sphere [kg].
fn mass(diameter: f64) -> f64 {
    DENSITY * PI / 6.0 * diameter.powi(3)
}

/// Contact time [s] of a grain with a fixed one, without damping (B8).
fn contact_seconds(diameter: f64, stiffness: f64) -> f64 {
    PI * (mass(diameter) / stiffness).sqrt()
}

/// Stiffness [N/m] that gives a contact time.
fn stiffness_for(diameter: f64, seconds: f64) -> f64 {
    mass(diameter) * (PI / seconds).powi(2)
}

/// Dashpot [N.s/m] of the paper: one for all contacts, made for a restitution of 0.7 against a fixed grain.
fn dashpot(diameter: f64, stiffness: f64) -> f64 {
    2.0 * DAMPING_RATIO * (mass(diameter) * stiffness).sqrt()
}

/// How a scene of the study is integrated. The paper: by forward differences, with at least 10 steps per contact.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Way {
    integrator: &'static str,
    /// Steps in the contact of a grain with a fixed one.
    steps: u32,
}

const FORWARD: &str = "forward-euler";
const VERLET: &str = "velocity-verlet";

/// The changes that give a scene's grains a stiffness [N/m], its dashpot, and a way to integrate.
fn law(diameter: f64, stiffness: f64, way: Way) -> Vec<String> {
    vec![
        format!("contact.normal.hooke.stiffness={stiffness:e}"),
        format!("contact.damping.dashpot.coefficient={:e}", dashpot(diameter, stiffness)),
        format!("dem.integrator={}", way.integrator),
        format!("dem.time-step={:e}", contact_seconds(diameter, stiffness) / f64::from(way.steps)),
    ]
}

/// A scene of the study with some keys changed, at time 0.
fn rig(text: &str, changes: &[String], perturbation: f64) -> Result<Rig, String> {
    let scene = Scene::parse("study scene", text, Path::new("."), changes).map_err(|c| c.to_string())?;
    Rig::of(scene.plan().clone(), perturbation)
}
