//! A silo runs out through a slot in its floor.

use super::super::bench::{at_least, between};
use super::super::control::{refused, refused_number};
use super::seen::{Measured, Picture, Seen, Test, spread};
use crate::origin::{own, remembered};
use tsubu_frame::Claim;

const RATE: &str = "discharge [1/s]";
const STEADY: &str = "rate of the later half over that of the earlier [-]";
const WIDTH: &str = "width of the flow 40 to 60 mm above the slot [mm]";
const STAGNANT: &str = "share of the bed that has not moved when half is out [-]";
const LEFT: &str = "share left at the end [-]";

/// Models with grains that let out 70 % of the bed; discs that do not turn jam in the slot in some draws.
const RUN_OUT: [&str; 9] = [
    "dem",
    "rolling",
    "locked",
    "cl-ca",
    "litwiniszyn",
    "after-caram-hong",
    "gutt-haff",
    "after-peng-herrmann",
    "after-baxter-behringer",
];

/// When the slide opens [s].
const OPENS: f64 = 0.8;

pub(super) const TEST: Test = Test {
    name: "hopper",
    title: "silo, 40 % out",
    scene: include_str!("../../../../studies/common-test/hopper.toml"),
    draws: 15,
    more: "",
    controls: "",
    spoil: |plan| {
        if let Some(wall) = plan.walls.get_mut("slide") {
            wall.until = None;
        }
    },
    measure,
    judge,
    picture: Picture {
        window: [-0.03, -0.02, 0.03, 0.2],
        moments: |seen| (reaches(seen, 0.4).map_or(seen.last(), |(look, _)| look), Some(seen.near(OPENS))),
    },
};

/// Grains in the silo at a look.
fn inside(seen: &Seen, look: usize) -> f64 {
    seen.grains(look).iter().filter(|grain| grain.at.z > -2e-3).count() as f64
}

/// The first look at which a share is out, and when that was, by linear interpolation.
fn reaches(seen: &Seen, share: f64) -> Option<(usize, f64)> {
    let all = inside(seen, 0);
    let out = |look: usize| 1.0 - inside(seen, look) / all;
    let look = (1..seen.frames.len()).find(|&look| out(look) >= share)?;
    let (before, now) = (out(look - 1), out(look));
    let part = if now > before { (share - before) / (now - before) } else { 1.0 };
    Some((look, seen.time(look - 1) + part * (seen.time(look) - seen.time(look - 1))))
}

fn measure(seen: &Seen) -> Vec<(&'static str, f64)> {
    let all = inside(seen, 0);
    let when = |share: f64| reaches(seen, share).map_or(f64::NAN, |(_, time)| time);
    let rate = |from: f64, to: f64| (to - from) * all / (when(to) - when(from));
    let opened = seen.near(OPENS);
    let at = |share: f64| reaches(seen, share).map(|(look, _)| look);
    // Where grains of a layer have gone down, and how far.
    let flowing = at(0.1).map(|look| {
        let layer = seen.pairs(opened, look).into_iter().filter(|(then, _)| (0.04..0.06).contains(&then.at.z));
        layer.map(|(then, now)| (then.at.x, (then.at.z - now.at.z).max(0.0))).collect::<Vec<_>>()
    });
    let still = at(0.5).map(|look| {
        let left: Vec<_> = seen.pairs(opened, look).into_iter().filter(|(_, now)| now.at.z > -2e-3).collect();
        left.iter().filter(|(then, now)| then.at.distance(now.at) < 2e-3).count() as f64 / left.len() as f64
    });
    vec![
        (RATE, rate(0.1, 0.7)),
        // A bed that jams lets nothing out in its later half.
        (STEADY, if when(0.7).is_finite() { rate(0.4, 0.7) / rate(0.1, 0.4) } else { 0.0 }),
        (WIDTH, flowing.map_or(f64::NAN, |layer| 1e3 * spread(&layer))),
        (STAGNANT, still.unwrap_or(f64::NAN)),
        (LEFT, inside(seen, seen.last()) / all),
    ]
}

fn judge(of: &Measured) -> Vec<Claim> {
    let source =
        own("independent of the height of the bed, unlike a liquid, 0.77 (Sakaguchi et al. 2001, figure 1)").after();
    let steady = |name: &str, ratio: f64| {
        between(format!("hopper, {name}: rate of the later half over the earlier"), ratio, 0.85, 1.18, source)
    };
    let flowing = of.names().filter(|name| of.value(name, STEADY) > 0.0).count();
    let mut claims = vec![at_least(
        "hopper: models that let out 70 % of the bed",
        flowing as f64,
        5.0,
        own("three kinds of DEM, CL-CA, and one more at least").after(),
    )];
    // A plain lattice gas is a fluid: no grains, and a second thing for the gate to refuse.
    claims.extend(RUN_OUT.map(|name| steady(name, of.value(name, STEADY))));
    claims.push(refused("hopper, a gas (FHP)", &[steady("fhp", of.value("fhp", STEADY))], 1));
    // The speed of a liquid goes with the root of what is left: so does the time to let out the next share.
    let time = |from: f64, to: f64| f64::sqrt(1.0 - from) - f64::sqrt(1.0 - to);
    claims.push(refused_number("hopper, a liquid", &[steady("", time(0.1, 0.4) / time(0.4, 0.7))], 1));
    let narrow = remembered("one grain a site spreads voids too little (B = 0.144 d, experiments 1 to 3.5 d)");
    let width = |name: &str| {
        let ratio = of.value(name, WIDTH) / of.value("dem", WIDTH);
        between(format!("hopper, {name}: width of the flow over that of free discs"), ratio, 0.2, 0.9, narrow)
    };
    claims.push(width("after-caram-hong"));
    claims.push(refused("hopper, free discs for voids", &[width("dem")], 1));
    claims
}
