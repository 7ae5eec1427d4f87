//! Plane shear under a constant pressure: friction and share of the area against the inertial number.

use super::super::beds::line;
use super::super::control::refused;
use super::super::ensemble::members;
use super::{FRICTION, Flow, published};
use crate::case::Judged;
use crate::origin::{own, remembered};
use std::ops::RangeInclusive;
use tsubu_frame::{Claim, Ensemble, Source};

/// Length of the world, and discs above a unit of it.
const LENGTH: f64 = 14.0;
const LAYERS: f64 = 16.0;
/// Not looked at next to the plates.
const EDGE: f64 = 3.0;
/// Inertial numbers that the speeds of the plate are chosen for.
const INERTIAL: [f64; 3] = [0.05, 0.1, 0.2];
/// Draws of each.
const SEEDS: RangeInclusive<u64> = 1..=24;
/// When the lid has come down.
const PRESSED: f64 = 70.0;

/// What a sheared layer comes to.
struct Sheared {
    inertial: f64,
    friction: f64,
    filled: f64,
    /// Force on the upper over that on the lower plate.
    balance: f64,
}

/// A layer whose plate goes as fast as makes about this inertial number.
fn sheared(inertial: f64, friction: f64, seed: u64, perturbation: f64) -> Result<Sheared, String> {
    let flow = Flow { length: LENGTH, layers: LAYERS, friction, speed: inertial * LAYERS, gravity: 0.0, seed };
    // After a strain of 3, over one of 6.
    let span = [PRESSED + 3.0 / inertial, PRESSED + 9.0 / inertial];
    let seen = flow.seen(span, 1.5, perturbation)?;
    let middle: Vec<&[f64; 3]> =
        seen.slabs.iter().filter(|slab| (EDGE..seen.height - EDGE).contains(&slab[0])).collect();
    let rate = line(&middle.iter().map(|slab| (slab[0], slab[1])).collect::<Vec<_>>()).0.abs();
    Ok(Sheared {
        inertial: rate / seen.pressure.sqrt(),
        friction: 0.5 * (seen.drag[0] - seen.drag[1]).abs() / seen.pressure,
        filled: middle.iter().map(|slab| slab[2]).sum::<f64>() / middle.len() as f64,
        balance: -seen.drag[1] / seen.drag[0],
    })
}

/// Draws of the three layers: of every one friction and share of the area less those of the law, the inertial number, and the balance
/// of forces; then friction at I = 0 and its rise.
fn layers(of: &str, friction: f64, perturbation: f64) -> Result<[Ensemble; 14], String> {
    members(of, SEEDS, |seed| {
        let mut found = [0.0; 14];
        let mut points = Vec::new();
        for (k, inertial) in INERTIAL.into_iter().enumerate() {
            let layer = sheared(inertial, friction, seed, perturbation)?;
            let [law, filled] = published(layer.inertial);
            let values = [layer.friction - law, layer.filled - filled, layer.inertial, layer.balance];
            found[4 * k..4 * k + 4].copy_from_slice(&values);
            points.push((layer.inertial, layer.friction));
        }
        let (rise, rest) = line(&points);
        (found[12], found[13]) = (rest, rise);
        Ok(found)
    })
}

const LAW: Source = remembered("da Cruz et al. 2005: mu = 0.25 + 1.1 I, share of the area 0.81 - 0.3 I");

/// The gates, for layers that are right and for wrong ones.
fn gates(found: &[Ensemble; 14]) -> Vec<Claim> {
    let mut claims = Vec::new();
    let mut gate = |name: String, at: usize, low: f64, high: f64, source: Source<'_>| {
        claims.push(Claim::judge_ensemble(name, found[at].clone(), Some(low), Some(high), source));
    };
    let steady = own("in a steady flow both plates are held back alike");
    let reaches = own("the speed of the plate is chosen for it; what slips at the plates is missing");
    for (k, inertial) in INERTIAL.into_iter().enumerate() {
        let name = |what: &str| format!("plane shear, I about {inertial}: {what}");
        gate(name("friction less that of the law"), 4 * k, -0.03, 0.03, LAW);
        gate(name("share of the area less that of the law"), 4 * k + 1, -0.02, 0.02, LAW);
        gate(name("inertial number"), 4 * k + 2, 0.5 * inertial, 1.2 * inertial, reaches);
        gate(name("drag on the upper over the lower plate"), 4 * k + 3, 0.95, 1.05, steady);
    }
    gate("plane shear: friction at I = 0".to_owned(), 12, 0.22, 0.28, LAW);
    gate("plane shear: rise of the friction with I".to_owned(), 13, 0.85, 1.35, LAW);
    claims
}

/// Discs sheared between two plates follow the law that was found so.
pub(in super::super) fn plane_shear(perturbation: f64) -> Judged {
    let mut claims = gates(&layers("grains that rub", FRICTION, perturbation)?);
    claims.push(refused("discs without friction", &gates(&layers("no friction", 0.0, perturbation)?), 10));
    Ok(claims)
}
