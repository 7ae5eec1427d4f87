//! A heap grows below a funnel.

use super::super::bench::{at_least, between};
use super::super::control::refused;
use super::seen::{Measured, Picture, Seen, Test, quantile};
use crate::origin::{closed_form, own};
use tsubu_frame::{Claim, Source};

const ANGLE: &str = "slope of the heap [deg]";
const TOP: &str = "height of the heap [mm]";
const FOOT: &str = "half-width that holds 80 % [mm]";
const FLOOR: &str = "share that has come down [-]";

/// Below the outlet of the funnel [m].
const BELOW: f64 = 90e-3;

pub(super) const TEST: Test = Test {
    name: "heap",
    title: "heap below a funnel",
    scene: include_str!("../../../../studies/common-test/heap.toml"),
    draws: 15,
    more: "",
    controls: "",
    spoil: |plan| {
        plan.walls.remove("floor");
    },
    measure,
    judge,
    picture: Picture { window: [-0.085, 0.0, 0.085, 0.14], moments: |seen| (seen.last(), Some(0)) },
};

fn measure(seen: &Seen) -> Vec<(&'static str, f64)> {
    let grains = seen.grains(seen.last());
    let down: Vec<_> = grains.iter().filter(|grain| grain.at.z < BELOW).collect();
    let top = down.iter().map(|grain| grain.at.z + grain.radius).fold(f64::NAN, f64::max);
    vec![
        (ANGLE, seen.said(seen.last(), "heap heap angle [rad]").to_degrees()),
        (TOP, 1e3 * top),
        (FOOT, 1e3 * quantile(down.iter().map(|grain| grain.at.x.abs()).collect(), 0.8)),
        (FLOOR, down.len() as f64 / grains.len() as f64),
    ]
}

fn judge(of: &Measured) -> Vec<Claim> {
    let angle = |name: &str| of.value(name, ANGLE);
    let gate = |more: &str, less: &str, difference: f64, source: Source<'_>| {
        at_least(format!("heap, slope by {more} less that by {less}, degrees"), difference, 3.0, source)
    };
    let steeper = |more: &str, less: &str, source| gate(more, less, angle(more) - angle(less), source);
    let turns = own("the less grains turn, the steeper they lie (Osada 2004, figures 19 and 23)").after();
    let lattice = own("a lattice has its own slope, steeper than friction 0.3 holds").after();
    vec![
        steeper("rolling", "dem", turns),
        steeper("locked", "rolling", turns),
        steeper("cl-ca", "locked", lattice),
        between(
            "heap, slope by after-caram-hong, degrees",
            angle("after-caram-hong"),
            55.0,
            65.0,
            closed_form("60: the lattice"),
        ),
        refused(
            "heap, discs that do not turn for free ones",
            &[gate("rolling", "dem", angle("rolling") - angle("locked"), turns)],
            1,
        ),
    ]
}
