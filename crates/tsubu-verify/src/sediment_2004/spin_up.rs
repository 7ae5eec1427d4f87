//! Osada 2004, figure 21 (B-F21): a grain that is free to spin is spun up from impact to impact.

use super::super::bench::Rig;
use super::super::control::refused;
use super::super::ensemble::{drawn, members};
use super::saltation::{D, DRAWS, FREE, IN_WATER, grain, leaping, spinning_of};
use crate::case::Judged;
use crate::origin::printed;
use tsubu_frame::{Claim, Ensemble};

/// Spin that the paper's grain comes to [rad/s], and impacts that are recorded.
const PUBLISHED: f64 = 900.0;
const IMPACTS: usize = 40;

/// Spin [rad/s] that the grain, thrown in without any, has when it comes to each of its impacts.
fn spins(changes: &[&str], seed: u64, perturbation: f64) -> Result<Vec<f64>, String> {
    let start =
        format!("particles.grain.start.at={{position=[[{D},{}]],velocity=[[0.4,0]]}}", (2.0 + 0.01 * seed as f64) * D);
    let changes: Vec<&str> = changes.iter().copied().chain([start.as_str()]).collect();
    let mut rig: Rig = leaping(1e4, &changes, perturbation)?;
    let mut spins = Vec::with_capacity(IMPACTS);
    while spins.len() < IMPACTS {
        while rig.engine.contacts() == 0 {
            rig.steps(1)?;
        }
        spins.push(grain(&rig).2);
        while rig.engine.contacts() > 0 {
            rig.steps(1)?;
        }
    }
    Ok(spins)
}

/// Of grains thrown in from ten heights: share of the impacts on the way to nine tenths of the published spin that make the grain spin
/// faster, how many those are, and the mean spin of the later half.
fn spun_up(of: &str, changes: &[&str], perturbation: f64) -> Result<[Ensemble; 3], String> {
    members(of, 1..=10, |seed| {
        let spins = spins(changes, seed, perturbation)?;
        let way = spins.iter().position(|spin| *spin >= 0.9 * PUBLISHED).unwrap_or(spins.len() - 1);
        let faster = spins[..=way].windows(2).filter(|pair| pair[1] > pair[0]).count();
        let late = &spins[IMPACTS / 2..];
        Ok([faster as f64 / way as f64, way as f64, late.iter().sum::<f64>() / late.len() as f64])
    })
}

/// That spin grows from impact to impact, to what the paper prints; the torque of the water would have taken it away between them.
fn spun_up_claims(perturbation: f64) -> Judged {
    let source =
        printed("Osada et al. 2004, figure 21: at each impact, to about -900 rad/s, 143 turns a second").after();
    let gates = |[share, _, level]: [Ensemble; 3]| {
        [
            Claim::judge_ensemble(
                "leaping grain, share of impacts that make it spin faster, until 0.9 of 900 rad/s",
                share,
                Some(0.9),
                None,
                source,
            ),
            Claim::judge_ensemble(
                "leaping grain, mean spin from the 20th impact on [rad/s]",
                level,
                Some(0.8 * PUBLISHED),
                Some(1.2 * PUBLISHED),
                source,
            ),
        ]
    };
    let free = spun_up("free to spin", FREE, perturbation)?;
    let wet = gates(spun_up("torque of the water", IN_WATER, perturbation)?);
    let mut claims = gates(free).to_vec();
    claims.push(refused("water that resists the spin of a leaping grain", &wet, 2));
    Ok(claims)
}

/// B-F20, B-F21: free to spin, grains leap higher and farther, friction holds them half as much, and they spin up to what rolling
/// would have; the torque of the water, which the paper leaves out, takes most of the spin away.
pub(in super::super) fn spinning(perturbation: f64) -> Judged {
    let mut claims = drawn("leaping grains", DRAWS, |draw| spinning_of(draw, perturbation))?;
    claims.extend(spun_up_claims(perturbation)?);
    Ok(claims)
}
