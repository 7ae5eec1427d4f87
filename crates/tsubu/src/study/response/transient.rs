//! How a run of a response begins, and when its transient has died away.

use super::tasks::Point;
use crate::engine::Engine;
use crate::interrupt::Interrupt;
use crate::ledger::{Account, Ledger};
use crate::partner::{Ballast, Hosts};
use crate::run::RunError;
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
/// Steps between two looks at the structure, and two questions whether to stop.
const UNSEEN: u64 = 8;

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
    let mass: f64 = plan.particles.values().map(|group| group.mass * group.count as f64).sum();
    let weight = mass * glam::DVec3::from_array(plan.gravity).dot(direction);
    let near = known.iter().min_by(|a, b| (a.frequency - frequency).abs().total_cmp(&(b.frequency - frequency).abs()));
    let riding = Ballast { mass, lossy_mass: 0.0, weight };
    let speed = 2.0 * PI * frequency;
    let acceleration = structure.steady_amplitude(frequency, riding) * speed * speed;
    let ballast = match near {
        // Grains ride on the floor as long as it does not fall faster than they do.
        _ if acceleration * mass < weight.abs() => riding,
        Some(point) if point.amplitude > 0.0 => {
            let lost = |account: &Account| !account.is_work() && *account != Account::HostDamping;
            let flows = Account::ALL.iter().zip(&point.flows).filter(|(account, _)| lost(account));
            let loss: f64 = flows.map(|(_, flow)| flow).sum();
            let speed = 2.0 * PI * point.frequency * point.amplitude;
            Ballast { mass: point.apparent_mass, lossy_mass: (loss / (PI * speed * speed)).max(0.0), weight }
        }
        _ => Ballast { lossy_mass: LOSSY_SHARE * mass, ..riding },
    };
    let at_rest = structure.clone();
    let velocity = structure.begin_in_motion(frequency, ballast);
    if mass > 0.0 && !engine.set_in_motion((direction * velocity).into()) {
        *structure = at_rest;
    }
}

/// Advances until three blocks of periods agree; gives how many periods that took. `None` where it was interrupted.
pub(super) fn die_away(
    frequency: f64,
    engine: &mut dyn Engine,
    hosts: &mut Hosts,
    host: usize,
    ledger: &mut Ledger,
    interrupt: &Interrupt,
) -> Result<Option<u32>, RunError> {
    let begun = engine.steps();
    let mut before = [f64::NAN; 2];
    for block in 1..=LONGEST / BLOCK {
        let end = begun + (f64::from(BLOCK * block) / (frequency * engine.time_step())).round() as u64;
        let (mut number, mut sum, mut squares) = (0.0, 0.0, 0.0);
        while engine.steps() < end {
            if interrupt.asked() {
                return Ok(None);
            }
            engine.advance(UNSEEN.min(end - engine.steps()), hosts, ledger)?;
            let z = hosts.list[host].displacement();
            (number, sum, squares) = (number + 1.0, sum + z, squares + z * z);
        }
        let rms = (squares / number - (sum / number) * (sum / number)).max(0.0).sqrt();
        let three = [before[0], before[1], rms];
        let largest = three.iter().copied().fold(0.0, f64::max);
        // Not before there are three: a difference to nothing is none.
        if three.iter().all(|one| largest - one <= STEADY * largest) {
            return Ok(Some(BLOCK * block));
        }
        before = [before[1], rms];
    }
    Ok(Some(LONGEST))
}
