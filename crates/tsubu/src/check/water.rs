//! The verdict on grains in water: how fast drag answers, how fast grains sink, and whether the stream moves them.

use super::{Verdict, speed_scale};
use crate::partner::Hosts;
use crate::water::{KARMAN, Stream, Submerged, Water};
use glam::DVec3;
use std::f64::consts::PI;
use tsubu_scene::plan::{self, GrainMotion, Particles, Plan, Torque};

/// Part of the drag relaxation time that a step may be: beyond it the drag of the last moment is not that of this one.
/// With all of it velocity Verlet with predicted velocities is at the end of its stability: of v' = -v/T a step makes a map of
/// velocity and acceleration whose trace is 1 - 3/2 dt/T and whose determinant is -dt/(2 T), so it shrinks for dt < T.
pub const OF_RELAXATION: f64 = 0.1;

/// A grain of a group in the water of a scene.
struct Sunk<'a> {
    water: &'a Water,
    diameter: f64,
    grain: Submerged,
    /// Without added mass [kg].
    mass: f64,
}

impl Sunk<'_> {
    /// Mass that forces move [kg].
    fn moved(&self) -> f64 {
        self.mass + self.water.added_mass * self.displaced()
    }

    fn displaced(&self) -> f64 {
        self.water.density * self.grain.volume()
    }

    /// Time in which drag takes a motion of this speed away from a grain alone, mass times speed over drag [s]; infinite without
    /// drag.
    fn alone(&self, speed: f64) -> f64 {
        self.moved() * speed / self.water.drag(self.grain, speed)
    }

    /// The same in the scene. Where grains slow the stream it is the water of a bed, half of the room there, that answers first; a
    /// crowd hinders tenfold.
    fn relaxation(&self, speed: f64) -> f64 {
        let share = match self.water.stream {
            Stream::Coupled(_) => self.displaced() / 10.0 / self.moved(),
            _ => 1.0,
        };
        share.min(1.0) * self.alone(speed)
    }

    /// Time in which the water takes this spin [rad/s] away, inertia times spin over torque [s]; infinite without torque.
    fn spin_down(&self, spin: f64) -> f64 {
        let radius = self.grain.radius;
        0.4 * self.mass * radius * radius * spin / self.water.torque(radius, spin)
    }
}

/// Groups that have grains which forces move, each with its smallest grain.
fn sunk<'a>(plan: &'a Plan, water: &'a Water) -> impl Iterator<Item = (&'a String, &'a Particles, Sunk<'a>)> {
    let moved = |group: &Particles| group.count > 0 && matches!(group.motion, GrainMotion::Free {});
    let groups = plan.particles.iter().filter(move |(_, group)| moved(group));
    groups.map(move |(name, group)| {
        let diameter = group.smallest_diameter();
        let grain = Submerged::of(&group.shape, diameter);
        (name, group, Sunk { water, diameter, grain, mass: group.mass * (diameter / group.diameter).powi(3) })
    })
}

/// Fastest speed relative to the water [m/s].
fn fastest(plan: &Plan, water: &Water, hosts: &Hosts) -> f64 {
    speed_scale(plan, hosts).max(water.fastest(largest(plan)))
}

/// Diameter of the largest grain [m].
pub(super) fn largest(plan: &Plan) -> f64 {
    plan.particles.values().map(Particles::largest_diameter).fold(0.0, f64::max)
}

/// Longest step that drag and the torque on spin allow [s]; infinite in air.
pub(super) fn longest_step(plan: &Plan, hosts: &Hosts) -> f64 {
    let Some(water) = water(plan) else { return f64::INFINITY };
    let speed = fastest(plan, &water, hosts);
    let gusts = plan.water.as_ref().and_then(|water| water.fluctuation).map_or(f64::INFINITY, |told| told.time);
    let times = sunk(plan, &water).map(|(_, _, sunk)| {
        let turns = sunk.spin_down(rolling(&sunk, speed));
        OF_RELAXATION * sunk.relaxation(speed).min(turns)
    });
    times.fold(OF_RELAXATION * gusts, f64::min)
}

/// Spin of a grain that rolls at this speed [rad/s].
fn rolling(sunk: &Sunk, speed: f64) -> f64 {
    2.0 * speed / sunk.diameter
}

/// Judges the step by the torque on spin, or tells what its absence means.
fn turning(verdict: &mut Verdict, plan: &Plan, name: &str, sunk: &Sunk, speed: f64, dt: f64) {
    let Some(told) = plan.water.as_ref().filter(|_| plan.contact.rotation) else { return };
    let spin = rolling(sunk, speed);
    if told.torque != (Torque::None {}) {
        let time = sunk.spin_down(spin);
        verdict.judge(
            dt <= OF_RELAXATION * time * (1.0 + 1e-9),
            format!(
                "{name} in water: its torque takes a spin of {spin:.0} rad/s away in {time:.3e} s, {:.0} steps (wanted: 10 or more)",
                time / dt
            ),
            || format!("`dem.time-step` to {:.2e} s or less, or leave it out", OF_RELAXATION * time),
        );
        return;
    }
    let turned = plan::Water { torque: Torque::FiniteReynolds {}, ..told.clone() };
    let water = Water::new(&turned, DVec3::from_array(plan.gravity));
    let time = Sunk { water: &water, ..*sunk }.spin_down(spin);
    verdict.say(format!(
        "{name} in water: nothing but contacts slows its spin; `water.torque.finite-reynolds = {{}}` would take {spin:.0} rad/s away in {time:.3e} s"
    ));
}

/// The water of a plan.
pub(super) fn water(plan: &Plan) -> Option<Water> {
    plan.water.as_ref().map(|water| Water::new(water, DVec3::from_array(plan.gravity)))
}

/// Judges the grains of a scene in its water.
pub(super) fn judge(verdict: &mut Verdict, plan: &Plan, hosts: &Hosts, dt: f64) {
    let Some(water) = water(plan) else { return };
    let speed = fastest(plan, &water, hosts);
    let gravity = DVec3::from_array(plan.gravity).length();
    let mut linear = false;
    for (name, group, sunk) in sunk(plan, &water) {
        let time = sunk.relaxation(speed);
        if time.is_finite() {
            verdict.judge(
                dt <= OF_RELAXATION * time * (1.0 + 1e-9),
                format!(
                    "{name} in water: drag takes a motion of {speed:.3} m/s away in {time:.3e} s, {:.0} steps (wanted: 10 or more, below 1 it blows up)",
                    time / dt
                ),
                || format!("`dem.time-step` to {:.2e} s or less, or leave it out", OF_RELAXATION * time),
            );
        }
        turning(verdict, plan, name, &sunk, speed, dt);
        linear |= contacts(verdict, (plan, hosts), (name, group), &sunk, time);
        let terminal = water.terminal(sunk.grain, sunk.mass, gravity);
        if let Some(terminal) = terminal {
            let reynolds = terminal * 2.0 * sunk.grain.radius / water.viscosity;
            let way = if sunk.mass < sunk.displaced() { "rises" } else { "sinks" };
            verdict.say(format!("{name} in water: {way} at {terminal:.4} m/s in the end (Re = {reynolds:.3})"));
        }
        let Some(shear) = water.stream.shear_velocity() else { continue };
        // At the mean grain, as in published transport rates.
        let d = group.shape.nominal_diameter(group.diameter);
        let density = group.mass / group.shape.mass(1.0, group.diameter);
        let relative = density / water.density - 1.0;
        if relative > 0.0 && gravity > 0.0 {
            let shields = shear * shear / (relative * gravity * d);
            let fate = match shields {
                s if s < 0.045 => "it should lie still",
                s if s < 1.0 => "it rolls and leaps",
                _ => "it flows as a sheet",
            };
            verdict.say(format!(
                "{name} in the stream as typed, before grains take from it: Shields number {shields:.3} (motion begins near 0.045: {fate}), U* = {shear:.4} m/s, U* d/nu = {:.0}",
                shear * d / water.viscosity
            ));
        }
        if let Some(terminal) = terminal {
            let rouse = terminal / (KARMAN * shear);
            let fate = match &water.fluctuation {
                _ if rouse > 2.5 => "moves along the bed",
                Some(_) => "turbulence lifts it",
                None => "turbulence would lift it: `water.fluctuation` is not there",
            };
            verdict.say(format!("{name} in the stream: Rouse number {rouse:.2} ({fate})"));
        }
    }
    if linear {
        verdict.say(
            "stiffness and cost: ten times stiffer takes 3.2 times as long, ten times softer a third of the time"
                .to_owned(),
        );
    }
}

/// Overlaps over the diameter between which Osada et al. (2004) want contacts to be: above, grains tremble and sink into one
/// another; below, the run only gets longer.
const WINDOW: [f64; 2] = [0.01, 0.001];

/// What the stiffness does to grains in water: the window of Osada et al. (2004), the contact time beside the times of drag and of a
/// hop; returns whether there is anything to say, a linear spring. `drag`: time of the drag [s].
fn contacts(
    verdict: &mut Verdict,
    (plan, hosts): (&Plan, &Hosts),
    (name, group): (&String, &Particles),
    sunk: &Sunk,
    drag: f64,
) -> bool {
    let law = plan.contact_of(&group.material, &group.material);
    let Some(stiffness) = law.normal.stiffness() else { return false };
    let key = format!("contact.normal.{}.stiffness", law.normal.name());
    let speed = speed_scale(plan, hosts);
    let (m, d) = (sunk.moved(), sunk.diameter);
    // Against a fixed grain and without damping, d = v sqrt(m/k).
    let [softest, stiffest] = WINDOW.map(|overlap| m * (speed / (overlap * d)).powi(2));
    let [longest, shortest] = WINDOW.map(|overlap| PI * overlap * d / speed);
    let place = match stiffness {
        k if k < softest => "softer than that: grains sink into one another",
        k if k > stiffest => "stiffer than that: safe, only slower",
        _ => "inside",
    };
    verdict.judge(
        stiffness >= softest,
        format!(
            "{name} in water: stiffness {stiffness:.3e} N/m; the window of overlap / d from 0.001 to 0.01 at {speed:.3} m/s is {softest:.3e} to {stiffest:.3e} N/m: {place}"
        ),
        || format!("`{key}` to {softest:.2e} N/m or more"),
    );
    verdict.say(format!(
        "{name} in water: the window is one decade of contact time, {shortest:.2e} to {longest:.2e} s: two contact times a hundred apart, as in the avalanche of Osada et al. (2004), are never both inside"
    ));
    let contact = PI * (m / stiffness).sqrt();
    let gravity = DVec3::from_array(plan.gravity).length();
    let weight = (1.0 - sunk.displaced() / sunk.mass) * gravity * sunk.mass / m;
    let hop = if weight > 0.0 { 2.0 * speed / weight } else { f64::INFINITY };
    verdict.judge(
        contact <= 0.1 * drag.min(hop),
        format!(
            "{name} in water: contact time {contact:.2e} s, {:.2} % of the drag's {drag:.2e} s and {:.2} % of a hop's {hop:.2e} s (wanted: 10 % or less)",
            100.0 * contact / drag,
            100.0 * contact / hop
        ),
        || format!("a stiffer `{key}`: the stream changes during a contact"),
    );
    true
}

/// Why a step [s] cannot be: drag takes a motion away from a grain before the step ends, and explicit steps blow up; `None` where
/// it can.
pub fn blows_up(plan: &Plan, hosts: &Hosts, dt: f64) -> Option<String> {
    let water = water(plan)?;
    let speed = fastest(plan, &water, hosts);
    let times = sunk(plan, &water).map(|(name, _, sunk)| (name, sunk.alone(speed), sunk.relaxation(speed)));
    let (name, time, good) = times.min_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, time, _)| dt > *time)?;
    Some(format!(
        "a step of {dt:.2e} s is longer than drag needs to take a motion of {speed:.3} m/s away from a grain of `{name}`, {time:.2e} s: it would blow up; {:.2e} s or less is good, or leave the key out",
        OF_RELAXATION * good
    ))
}
