//! Time integration of grains, split around the evaluation of forces. Both halves go block by block, on many threads where
//! that is worth it.

use super::sweep::{Row, Way, sweep};
use super::touch::Block;
use crate::find::Candidates;
use crate::find::candidates::{BLOCK, List, shares};
use crate::find::drift::Drift;
use crate::state::Grains;
use glam::DVec3;
use multiversion::multiversion;
use tsubu_scene::plan::Integrator;

/// What a block reports from a half step; joined in the order of blocks.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Report {
    /// Correction of the power lost in contacts [W], see [`after`].
    pub correction: f64,
    /// Contact force on grains that forces do not move [N].
    pub fixed_force: DVec3,
    /// Power that driven grains put into the others [W].
    pub driven_power: f64,
}

impl Report {
    fn add(&mut self, other: &Self) {
        self.correction += other.correction;
        self.fixed_force += other.fixed_force;
        self.driven_power += other.driven_power;
    }
}

/// The columns of some blocks.
struct Slice<'a> {
    position: &'a mut [DVec3],
    velocity: &'a mut [DVec3],
    acceleration: &'a mut [DVec3],
    spin: &'a mut [DVec3],
    spin_rate: &'a mut [DVec3],
    inverse_mass: &'a [f64],
    inertia: &'a [f64],
    reference: &'a [DVec3],
    // One a block.
    lists: &'a [List],
    drifts: &'a mut [Drift],
    reports: &'a mut [Report],
}

impl<'a> Slice<'a> {
    fn new(grains: &'a mut Grains, candidates: &'a mut Candidates, reports: &'a mut Vec<Report>) -> Self {
        reports.resize(candidates.lists.len(), Report::default());
        Self {
            position: &mut grains.position,
            velocity: &mut grains.velocity,
            acceleration: &mut grains.acceleration,
            spin: &mut grains.spin,
            spin_rate: &mut grains.spin_rate,
            inverse_mass: &grains.inverse_mass,
            inertia: &grains.inertia,
            reference: &candidates.reference,
            lists: &candidates.lists,
            drifts: &mut candidates.drifts.of,
            reports,
        }
    }
}

impl Row for Slice<'_> {
    fn lists(&self) -> &[List] {
        self.lists
    }

    fn cut(self, blocks: usize) -> (Self, Self) {
        let grains = (blocks * BLOCK).min(self.position.len());
        let (position, positions) = self.position.split_at_mut(grains);
        let (velocity, velocities) = self.velocity.split_at_mut(grains);
        let (acceleration, accelerations) = self.acceleration.split_at_mut(grains);
        let (spin, spins) = self.spin.split_at_mut(grains);
        let (spin_rate, spin_rates) = self.spin_rate.split_at_mut(grains);
        let (inverse_mass, inverse_masses) = self.inverse_mass.split_at(grains);
        let (inertia, inertias) = self.inertia.split_at(grains);
        let (reference, references) = self.reference.split_at(grains);
        let (list, lists) = self.lists.split_at(blocks);
        let (drift, drifts) = self.drifts.split_at_mut(blocks);
        let (report, reports) = self.reports.split_at_mut(blocks);
        let first = Self {
            position,
            velocity,
            acceleration,
            spin,
            spin_rate,
            inverse_mass,
            inertia,
            reference,
            lists: list,
            drifts: drift,
            reports: report,
        };
        let others = Self {
            position: positions,
            velocity: velocities,
            acceleration: accelerations,
            spin: spins,
            spin_rate: spin_rates,
            inverse_mass: inverse_masses,
            inertia: inertias,
            reference: references,
            lists,
            drifts,
            reports,
        };
        (first, others)
    }
}

/// Before the forces: brings positions to the end of the step, and velocities there too, predicted with the old
/// acceleration, so that forces that depend on velocity see positions and velocities of one time level.
pub(super) fn before(grains: &mut Grains, candidates: &mut Candidates, reports: &mut Vec<Report>, motion: &Motion) {
    let shares = shares(grains.len());
    sweep(Slice::new(grains, candidates, reports), Way::There, shares, &|mut s: Slice| go(&mut s, motion));
}

/// After the forces: sums what blocks hold for every grain, finds the new accelerations and completes the velocities. With
/// `go_on` every block begins the next step at once, as [`before`] would: its columns are in the cache.
pub(super) fn after(
    grains: &mut Grains,
    blocks: &[Block],
    candidates: &mut Candidates,
    reports: &mut Vec<Report>,
    motion: &Motion,
    go_on: bool,
) -> Report {
    let shares = shares(grains.len());
    sweep(Slice::new(grains, candidates, reports), Way::Back, shares, &|mut s: Slice| {
        s.reports[0] = complete(&mut s, blocks, motion);
        if go_on {
            go(&mut s, motion);
        }
    });
    let mut total = Report::default();
    for report in reports.iter() {
        total.add(report);
    }
    total
}

/// First half of a step of one block.
fn go(s: &mut Slice, motion: &Motion) {
    let drift = &mut s.drifts[0];
    drift.offset += drift.velocity * motion.dt;
    let offset = drift.offset;
    let (total, farthest) = drift_on(s, offset, motion);
    let velocity = total / s.position.len() as f64;
    s.drifts[0] = Drift { offset, velocity, farthest };
}

/// Moves the grains; returns the sum of the velocities they went with [m/s] and how far the farthest is from where it was
/// at the search and from `offset` [m].
#[multiversion(targets = "simd")]
fn drift_on(s: &mut Slice, offset: DVec3, motion: &Motion) -> (DVec3, f64) {
    // What the velocity gets before and after the drift.
    let dt = motion.dt;
    let (first, second) = match motion.integrator {
        Integrator::VelocityVerlet => (0.5 * dt, 0.5 * dt),
        Integrator::SymplecticEuler => (dt, 0.0),
        Integrator::ForwardEuler => (0.0, dt),
    };
    let (mut farthest, mut sum, mut total) = (0.0f64, 0.0, DVec3::ZERO);
    for i in 0..s.position.len() {
        let half = s.velocity[i] + s.acceleration[i] * first;
        s.position[i] += half * dt;
        s.velocity[i] = half + s.acceleration[i] * second;
        total += half;
        let away = (s.position[i] - s.reference[i] - offset).length_squared();
        farthest = if away > farthest { away } else { farthest };
        sum += away;
    }
    if motion.rotation {
        for (spin, rate) in s.spin.iter_mut().zip(&*s.spin_rate) {
            *spin += *rate * dt;
        }
    }
    // The sum catches what a maximum hides: a coordinate that is no longer a number.
    (total, if sum.is_finite() { farthest.sqrt() } else { f64::NAN })
}

/// Second half of a step of one block.
///
/// The report's correction is what the losses, which were computed with the predicted velocities, must be corrected by.
/// The path that Verlet's positions trace has the velocity (x(t+dt) - x(t-dt)) / 2 dt - (dt^2/6) da/dt, which to this
/// order is one third of the predicted and two thirds of the completed velocity; the energy that a force takes along the
/// path is force times that. Without the correction the books of an impact at 20 steps per contact miss 0.4 % of its
/// energy, with it 0.02 %.
#[multiversion(targets = "simd")]
fn complete(s: &mut Slice, blocks: &[Block], motion: &Motion) -> Report {
    let share = motion.predicts();
    let List { first, incoming, .. } = &s.lists[0];
    let mut report = Report::default();
    let own = &blocks[first / BLOCK].loads;
    let mut next = 0;
    for (i, load) in own.iter().take(s.position.len()).enumerate() {
        let mut load = *load;
        while let Some(other) = incoming.get(next)
            && other.own as usize == i
        {
            load.add(&blocks[other.block as usize].loads[other.place as usize]);
            next += 1;
        }
        if s.inverse_mass[i] == 0.0 {
            report.fixed_force += load.force;
            report.driven_power -= load.force.dot(s.velocity[i]);
            continue;
        }
        let acceleration = load.force * s.inverse_mass[i] + motion.gravity;
        let change = (acceleration - s.acceleration[i]) * share;
        s.acceleration[i] = acceleration;
        s.velocity[i] += change;
        report.correction += load.lossy.as_dvec3().dot(change);
        if motion.rotation {
            let rate = load.torque * (1.0 / s.inertia[i]);
            let change = (rate - s.spin_rate[i]) * share;
            s.spin_rate[i] = rate;
            s.spin[i] += change;
            report.correction += load.torque.dot(change);
        }
    }
    report.correction *= -2.0 / 3.0;
    report
}

/// How grains are moved.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    pub integrator: Integrator,
    pub gravity: DVec3,
    pub rotation: bool,
    pub dt: f64,
}

impl Motion {
    /// How long velocities go with the old acceleration until [`after`] puts the new one in its place [s].
    pub fn predicts(&self) -> f64 {
        if self.integrator == Integrator::VelocityVerlet { 0.5 * self.dt } else { 0.0 }
    }
}
