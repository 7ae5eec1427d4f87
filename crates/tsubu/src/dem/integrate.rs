//! Time integration of grains, split around the evaluation of forces. Both halves go block by block, on many threads where
//! that is worth it.

use super::touch::Block;
use crate::find::Candidates;
use crate::find::candidates::{BLOCK, Incoming, worth_threads};
use crate::find::drift::Drift;
use crate::state::Grains;
use glam::DVec3;
use multiversion::multiversion;
use rayon::prelude::*;
use tsubu_scene::plan::Integrator;

/// What a block reports from a half step; joined in the order of blocks.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Report {
    /// What the block has done since the last search.
    pub drift: Drift,
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

/// One block's part of the columns.
struct Slice<'a> {
    position: &'a mut [DVec3],
    velocity: &'a mut [DVec3],
    acceleration: &'a mut [DVec3],
    spin: &'a mut [DVec3],
    spin_rate: &'a mut [DVec3],
    inverse_mass: &'a [f64],
    inertia: &'a [f64],
    reference: &'a [DVec3],
}

/// Runs `work` on every block and joins the reports in their order.
fn each(
    grains: &mut Grains,
    reference: &[DVec3],
    reports: &mut Vec<Report>,
    work: impl Fn(usize, Slice) -> Report + Sync,
) -> Report {
    let n = grains.len();
    reports.resize(n.div_ceil(BLOCK), Report::default());
    macro_rules! zipped {
        ($chunks:ident, $chunks_mut:ident, $iter:ident $(, $split:ident)?) => {
            grains
                .position
                .$chunks_mut(BLOCK)
                .zip(grains.velocity.$chunks_mut(BLOCK))
                .zip(grains.acceleration.$chunks_mut(BLOCK))
                .zip(grains.spin.$chunks_mut(BLOCK))
                .zip(grains.spin_rate.$chunks_mut(BLOCK))
                .zip(grains.inverse_mass.$chunks(BLOCK))
                .zip(grains.inertia.$chunks(BLOCK))
                .zip(reference.$chunks(BLOCK))
                .zip(reports.$iter())
                .enumerate()
                $(.$split(1))?
                .for_each(
                    |(
                        block,
                        (
                            (
                                ((((((position, velocity), acceleration), spin), spin_rate), inverse_mass), inertia),
                                reference,
                            ),
                            report,
                        ),
                    )| {
                        let slice = Slice {
                            position,
                            velocity,
                            acceleration,
                            spin,
                            spin_rate,
                            inverse_mass,
                            inertia,
                            reference,
                        };
                        *report = work(block, slice);
                    },
                )
        };
    }
    if worth_threads(n) {
        zipped!(par_chunks, par_chunks_mut, par_iter_mut, with_max_len);
    } else {
        zipped!(chunks, chunks_mut, iter_mut);
    }
    let mut total = Report::default();
    for report in reports.iter() {
        total.add(report);
    }
    total
}

/// Before the forces: brings positions to the end of the step, and velocities there too, predicted with the old
/// acceleration, so that forces that depend on velocity see positions and velocities of one time level.
pub(super) fn before(grains: &mut Grains, candidates: &mut Candidates, reports: &mut Vec<Report>, motion: &Motion) {
    let Candidates { reference, drifts, .. } = candidates;
    let drifts = &drifts.of;
    each(grains, reference, reports, |block, mut s| Report {
        drift: go(&mut s, drifts[block], motion),
        ..Report::default()
    });
    keep_drifts(candidates, reports);
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
    let Candidates { reference, drifts, lists, .. } = candidates;
    let (drifts, lists) = (&drifts.of, &*lists);
    let total = each(grains, reference, reports, |block, mut s| {
        let mut report = complete(&mut s, blocks, &lists[block].incoming, block, motion);
        if go_on {
            report.drift = go(&mut s, drifts[block], motion);
        }
        report
    });
    if go_on {
        keep_drifts(candidates, reports);
    }
    total
}

fn keep_drifts(candidates: &mut Candidates, reports: &[Report]) {
    for (drift, report) in candidates.drifts.of.iter_mut().zip(reports) {
        *drift = report.drift;
    }
}

/// First half of a step of one block.
fn go(s: &mut Slice, mut drift: Drift, motion: &Motion) -> Drift {
    drift.offset += drift.velocity * motion.dt;
    let (total, farthest) = drift_on(s, drift.offset, motion);
    drift.velocity = total / s.position.len() as f64;
    drift.farthest = farthest;
    drift
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
fn complete(s: &mut Slice, blocks: &[Block], incoming: &[Incoming], block: usize, motion: &Motion) -> Report {
    let share = motion.predicts();
    let mut report = Report::default();
    let own = &blocks[block].loads;
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
