//! Flow down between two upright rough walls: a plug, and shear beside the walls.

use super::super::control::refused;
use super::super::ensemble::members;
use super::{FRICTION, Flow, published};
use crate::case::Judged;
use crate::origin::{closed_form, remembered};
use std::ops::RangeInclusive;
use tsubu_frame::{Claim, Ensemble};

/// Length of the world, and discs between the walls above a unit of it.
const LENGTH: f64 = 12.0;
const LAYERS: f64 = 20.0;
/// Weight of half the discs over the force on a wall: friction there, where the flow is steady.
const AT_WALLS: f64 = 0.42;
/// Draws.
const SEEDS: RangeInclusive<u64> = 1..=12;
/// When the flow has become steady, and until when it is looked at.
const SPAN: [f64; 2] = [250.0, 450.0];
/// Before that.
const EARLY: [f64; 2] = [20.0, 30.0];

/// Of draws: friction of the walls over the weight that they carry; shear rate in the middle third over that of the sixths at the walls;
/// inertial number between 2 and 5 diameters from the walls over that of the law.
fn chutes(of: &str, friction: f64, span: [f64; 2], perturbation: f64) -> Result<[Ensemble; 3], String> {
    members(of, SEEDS, |seed| {
        let gravity = 2.0 * AT_WALLS / LAYERS;
        let flow = Flow { length: LENGTH, layers: LAYERS, friction, speed: 0.0, gravity, seed };
        let seen = flow.seen(span, 1.5, perturbation)?;
        let weight = seen.mass * gravity;
        let middle = 0.5 * seen.height;
        let (mut core, mut rim, mut law, mut found) = ((0.0, 0.0), (0.0, 0.0), 0.0, 0.0);
        for pair in seen.slabs.windows(2) {
            let [from, to] = [pair[0], pair[1]];
            let (place, rate) = (0.5 * (from[0] + to[0]) - middle, ((to[1] - from[1]) / (to[0] - from[0])).abs());
            let from_wall = middle - place.abs();
            if place.abs() < middle / 3.0 {
                core = (core.0 + rate, core.1 + 1.0);
            } else if place.abs() > 2.0 / 3.0 * middle {
                rim = (rim.0 + rate, rim.1 + 1.0);
            }
            if (2.0..5.0).contains(&from_wall) {
                // The weight of what is nearer to the middle hangs on the slab.
                let friction = weight * place.abs() / seen.height / seen.pressure;
                law += ((friction - published(0.0)[0]) / 1.1).max(0.0);
                found += rate / seen.pressure.sqrt();
            }
        }
        let mean = |(sum, count): (f64, f64)| sum / count;
        Ok([(seen.drag[0] + seen.drag[1]) / weight, mean(core) / mean(rim), found / law])
    })
}

/// The gates, for chutes that are right and for wrong ones.
fn gates([carried, plug, shear]: &[Ensemble; 3]) -> Vec<Claim> {
    let judge = |what: &str, found: &Ensemble, low: f64, high: f64, source| {
        Claim::judge_ensemble(format!("vertical chute: {what}"), found.clone(), Some(low), Some(high), source)
    };
    let midi = remembered("GDR MiDi 2004: a plug in the middle, shear in some diameters beside the walls");
    let local =
        remembered("the law of plane shear, mu = 0.25 + 1.1 I (da Cruz et al. 2005), slab by slab; a factor of 2");
    vec![
        judge("friction of the walls over the weight", carried, 0.97, 1.03, closed_form("balance of forces: steady")),
        judge("shear rate in the middle third over that at the walls", plug, 0.0, 0.1, midi),
        judge("inertial number 2 to 5 diameters from the walls over that of the law", shear, 0.5, 2.0, local),
    ]
}

/// A chute whose walls carry the weight of the discs: in the middle they go down as a block.
pub(in super::super) fn vertical_chute(perturbation: f64) -> Judged {
    let mut claims = gates(&chutes("grains that rub", FRICTION, SPAN, perturbation)?);
    claims.push(refused(
        "discs and walls without friction",
        &gates(&chutes("no friction", 0.0, EARLY, perturbation)?),
        2,
    ));
    let early = chutes("a flow that begins", FRICTION, EARLY, perturbation)?;
    claims.push(refused("a flow that begins", &gates(&early), 1));
    Ok(claims)
}
