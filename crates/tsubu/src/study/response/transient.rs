//! How a run of a response begins, and when its transient has died away.

use super::point::Point;
use crate::engine::Engine;
use crate::interrupt::Interrupt;
use crate::ledger::{Account, Ledger};
use crate::partner::{Ballast, Host, Hosts};
use crate::run::RunError;
use nalgebra::Complex;
use std::f64::consts::PI;
use tsubu_scene::plan::Plan;

/// Periods of a block whose root mean square is compared with those of the two before: of two blocks alone a beat may be alike.
const BLOCK: u32 = 3;
/// How little the three must differ, over the largest.
const STEADY: f64 = 0.02;
/// After so many periods the measurement begins, steady or not: its drift says so.
pub(super) const LONGEST: u32 = 60;
/// What grains lose before anything is known of them, as a share of their mass.
const LOSSY_SHARE: f64 = 0.3;
/// How far walls may stand from where they were drawn when a run begins, over the smallest diameter, and how much they may tilt.
const DISPLACED: f64 = 1e-3;

/// Puts structure and grains into the motion expected at `frequency` [Hz], from what the nearest of the points already known says of
/// the grains. Where grains cannot be set in motion with it, as some of their walls do not hang on it, everything begins at rest.
pub(super) fn begin(
    plan: &Plan,
    known: &[&Point],
    frequency: f64,
    engine: &mut dyn Engine,
    hosts: &mut Hosts,
    host: usize,
) {
    let carried = |wall: &tsubu_scene::plan::Wall| wall.host.as_deref() == Some(hosts.names()[host].as_str());
    if !plan.walls.values().all(carried) || plan.water.is_some() {
        return;
    }
    let structure = &mut hosts.list[host];
    let direction = glam::DVec3::from_array(structure.direction);
    let mass = plan.grain_mass();
    let weight = mass * glam::DVec3::from_array(plan.gravity).dot(direction);
    let near = known.iter().min_by(|a, b| (a.frequency - frequency).abs().total_cmp(&(b.frequency - frequency).abs()));
    let riding = Ballast { mass, lossy_mass: 0.0, weight };
    let speed = 2.0 * PI * frequency;
    let acceleration = structure.steady_amplitude(frequency, riding) * speed * speed;
    let ballast = match near {
        // Grains ride on the floor as long as it does not fall faster than they do.
        _ if acceleration * mass < weight.abs() => riding,
        Some(point) if point.amplitude > 0.0 => Ballast { weight, ..shown(point) },
        _ => Ballast { weight, ..unknown(mass) },
    };
    let at_rest = structure.clone();
    let velocity = structure.begin_in_motion(frequency, ballast);
    // What hangs on a point that moves in other directions too may begin elsewhere, and would tear the walls from the grains.
    let interfaces = plan.walls.values().filter_map(|wall| structure.interface(wall.interface.as_deref()));
    let smallest = plan.particles.values().map(|group| group.diameter).fold(f64::INFINITY, f64::min);
    let apart = interfaces.map(|interface| structure.placed(interface)).any(|placed| {
        let angle = placed.rotation.map_or(0.0, |rotation| rotation.to_scaled_axis().length());
        placed.offset.length() > DISPLACED * smallest || angle > DISPLACED
    });
    if mass > 0.0 && (apart || !engine.set_in_motion((direction * velocity).into())) {
        *structure = at_rest;
    }
}

/// What grains of this mass [kg] are taken for before anything is known of them.
pub(in crate::study) fn unknown(mass: f64) -> Ballast {
    Ballast { mass, lossy_mass: LOSSY_SHARE * mass, weight: 0.0 }
}

/// What the grains were to the structure in a run.
pub(in crate::study) fn shown(point: &Point) -> Ballast {
    let lost = |account: &Account| !account.is_work() && *account != Account::HostDamping;
    let flows = Account::ALL.iter().zip(&point.flows).filter(|(account, _)| lost(account));
    let loss: f64 = flows.map(|(_, flow)| flow).sum();
    let speed = 2.0 * PI * point.frequency * point.amplitude;
    Ballast { mass: point.apparent_mass, lossy_mass: (loss / (PI * speed * speed)).max(0.0), weight: 0.0 }
}

/// What is measured of a block of periods, to tell whether it is steady.
pub(in crate::study) trait Block {
    /// Steps between two looks.
    const UNSEEN: u64;
    /// Nothing measured yet, at `frequency` [Hz].
    fn begin(frequency: f64) -> Self;
    /// Looks at the host at `time` [s].
    fn look(&mut self, host: &Host, time: f64);
    /// What has come of it.
    fn value(&self) -> Complex<f64>;
}

/// The root mean square of the displacement [m].
struct RmsDisplacement {
    number: f64,
    sum: f64,
    squares: f64,
}

impl Block for RmsDisplacement {
    const UNSEEN: u64 = 8;

    fn begin(_frequency: f64) -> Self {
        Self { number: 0.0, sum: 0.0, squares: 0.0 }
    }

    fn look(&mut self, host: &Host, _time: f64) {
        let z = host.displacement();
        (self.number, self.sum, self.squares) = (self.number + 1.0, self.sum + z, self.squares + z * z);
    }

    fn value(&self) -> Complex<f64> {
        let Self { number, sum, squares } = self;
        (squares / number - (sum / number) * (sum / number)).max(0.0).sqrt().into()
    }
}

/// Advances until the displacement is steady.
pub(super) fn die_away(
    frequency: f64,
    engine: &mut dyn Engine,
    hosts: &mut Hosts,
    host: usize,
    ledger: &mut Ledger,
    interrupt: &Interrupt,
) -> Result<Option<u32>, RunError> {
    until_steady::<RmsDisplacement>(frequency, engine, hosts, host, ledger, interrupt)
}

/// Advances until three blocks of periods agree; gives how many periods that took. `None` where it was interrupted.
pub(in crate::study) fn until_steady<B: Block>(
    frequency: f64,
    engine: &mut dyn Engine,
    hosts: &mut Hosts,
    host: usize,
    ledger: &mut Ledger,
    interrupt: &Interrupt,
) -> Result<Option<u32>, RunError> {
    let begun = engine.steps();
    let mut blocks = Vec::new();
    for block in 1..=LONGEST / BLOCK {
        let end = begun + (f64::from(BLOCK * block) / (frequency * engine.time_step())).round() as u64;
        let mut measured = B::begin(frequency);
        while engine.steps() < end {
            if interrupt.asked() {
                return Ok(None);
            }
            engine.advance(B::UNSEEN.min(end - engine.steps()), hosts, ledger)?;
            measured.look(&hosts.list[host], engine.time());
        }
        blocks.push(measured.value());
        if steady(&blocks) {
            return Ok(Some(BLOCK * block));
        }
    }
    Ok(Some(LONGEST))
}

/// Whether the last three blocks agree; or, where the motion is irregular, whether they differ from the three before by no more than
/// the scatter of either explains.
fn steady(blocks: &[Complex<f64>]) -> bool {
    let Some(last) = blocks.last_chunk::<3>() else { return false };
    let largest = last.iter().map(|one| one.norm()).fold(0.0, f64::max);
    let apart = |a: usize, b: usize| (last[a] - last[b]).norm();
    if apart(0, 1).max(apart(1, 2)).max(apart(0, 2)) <= STEADY * largest {
        return true;
    }
    let Some(before) = blocks[..blocks.len() - 3].last_chunk::<3>() else { return false };
    let mean = |three: &[Complex<f64>; 3]| three.iter().sum::<Complex<f64>>() / 3.0;
    // Square of the standard error of a mean of three.
    let error = |three: &[Complex<f64>; 3]| three.iter().map(|one| (one - mean(three)).norm_sqr()).sum::<f64>() / 6.0;
    (mean(last) - mean(before)).norm_sqr() <= error(last) + error(before)
}

#[cfg(test)]
mod tests {
    fn steady(blocks: &[f64]) -> bool {
        super::steady(&blocks.iter().map(|block| (*block).into()).collect::<Vec<_>>())
    }

    /// A transient that dies away, a beat and a drift are no steady motions; what stays, or scatters about a mean, is one.
    #[test]
    fn only_what_stays_is_steady() {
        assert!(steady(&[5.0, 1.0, 1.005, 0.995]));
        assert!(steady(&[1.0, 1.1, 0.93, 1.02, 0.95, 1.08]));
        assert!(!steady(&[1.0, 1.0]));
        assert!(!steady(&[2.0, 1.6, 1.35, 1.2, 1.12, 1.07]));
        assert!(!steady(&[1.0, 1.03, 1.06, 1.09, 1.12, 1.15]));
        assert!(!steady(&[1.2, 1.0, 1.0]));
    }
}
