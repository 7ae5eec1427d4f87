//! Two sizes in a box that is shaken up and down.

use super::super::bench::{at_least, between};
use super::super::control::refused;
use super::seen::{Measured, Picture, Seen, Test};
use crate::origin::own;
use tsubu_frame::Claim;

const RISE: &str = "large over small at the end, of the bed's height [-]";
const GAIN: &str = "of that, gained by shaking [-]";
const ROLL: &str = "rise in the middle less that at the walls [mm per period]";

const SUNK: &str = "deepest grain below the floor [mm]";

macro_rules! switched {
    () => {
        "cl-ca.gravity-switch={up=20,down=50}:\
         walls.box={material=\"aluminium\",shape={box={width=0.0606,height=0.1,depth=0.05}}}"
    };
}

pub(super) const TEST: Test = Test {
    name: "shaken",
    title: "shaken box, 40 periods",
    scene: include_str!("../../../../studies/common-test/shaken.toml"),
    draws: 15,
    // CL-CA also in its own way: the box stands, and gravity points up for 20 steps of the 70 that a period has.
    more: concat!("switched=cl-ca:", switched!()),
    controls: concat!(
        "equal-dem=dem:particles.large.diameter=2.778 mm,",
        "equal-switched=cl-ca:particles.large.diameter=2.778 mm:",
        switched!(),
        ",soft=dem:materials.aluminium.young-modulus=1e6:dem.largest-overlap=0.9"
    ),
    spoil: |plan| {
        for wall in plan.walls.values_mut() {
            wall.motion = None;
        }
    },
    measure,
    judge,
    picture: Picture { window: [-0.032, -0.01, 0.032, 0.08], moments: |seen| (seen.last(), None) },
};

/// Half the width of the box [m].
const HALF: f64 = 30.3e-3;

fn measure(seen: &Seen) -> Vec<(&'static str, f64)> {
    let last = seen.last();
    // Twice the mean height is the height of a bed of even density.
    let heights = seen.grains(last).iter().map(|grain| grain.at.z).sum::<f64>();
    let height = 2.0 * heights / seen.grains(last).len() as f64;
    let over = |look: usize| seen.said(look, "sizes height difference [m]") / height;
    // The bed lies after the first ten periods; what its lower two thirds do from picture to picture.
    let (mut middle, mut walls) = ((0.0, 0.0), (0.0, 0.0));
    for look in 10..last {
        for (then, now) in seen.pairs(look, look + 1).into_iter().filter(|(then, _)| then.at.z < 0.7 * height) {
            let place = then.at.x.abs() / HALF;
            let sum = if place > 0.8 { &mut walls } else { &mut middle };
            if !(0.4..0.8).contains(&place) {
                *sum = (sum.0 + 1e3 * (now.at.z - then.at.z), sum.1 + 1.0);
            }
        }
    }
    let lowest = seen.grains(last).iter().map(|grain| grain.at.z - grain.radius).fold(f64::INFINITY, f64::min);
    vec![
        (SUNK, -1e3 * lowest),
        (RISE, over(last)),
        (GAIN, over(last) - over(5)),
        (ROLL, middle.0 / middle.1 - walls.0 / walls.1),
    ]
}

fn judge(of: &Measured) -> Vec<Claim> {
    let rises = |name: &str| {
        let what = format!("shaken, {name}: large over small, gained, of the bed's height");
        at_least(what, of.value(name, GAIN), 0.08, own("large grains rise among small ones").after())
    };
    let sinks = |name: &str| {
        let what = format!("shaken, {name}: deepest grain below the floor, mm");
        let source = own("no grain leaves the box; DEM lets discs sink in by a hundredth of their size").after();
        Claim::judge(what, of.value(name, SUNK), None, Some(0.5), source)
    };
    let walls = own("no roll where walls do not rub; a lattice knows no friction").after();
    let still = |name: &str| {
        let what = format!("shaken, {name}: middle over walls, mm per period");
        between(what, of.value(name, ROLL), -0.05, 0.05, walls)
    };
    let mut claims: Vec<Claim> = ["dem", "rolling", "locked", "switched"].map(rises).to_vec();
    claims.push(refused("shaken, grains of one size by DEM", &[rises("equal-dem")], 1));
    claims.push(refused("shaken, grains of one size by CL-CA", &[rises("equal-switched")], 1));
    claims.push(at_least(
        "shaken, dem: middle over walls, mm per period",
        of.value("dem", ROLL),
        0.1,
        own("up in the middle and down at walls that rub").after(),
    ));
    claims.push(still("switched"));
    claims.push(refused("shaken, discs that rub for hexagons that do not", &[still("dem")], 1));
    claims.extend(["dem", "switched", "cl-ca"].map(sinks));
    claims.push(refused("shaken, discs that are too soft for a floor", &[sinks("soft")], 1));
    claims
}
