//! A bed loses its right wall.

use super::super::bench::{at_least, between};
use super::super::cl_ca_2001::slope;
use super::super::control::refused;
use super::seen::{Measured, Picture, Seen, Test};
use crate::origin::{closed_form, own};
use tsubu_frame::Claim;

const FRONT: &str = "front beyond the wall's place [mm]";
const ANGLE: &str = "slope [deg]";
const BEYOND: &str = "share beyond the wall's place [-]";
const STILL: &str = "share that has not moved [-]";

/// Where the wall stood [m], and until when [s].
const WALL: f64 = 60.6e-3;
const GOES: f64 = 0.6;

pub(super) const TEST: Test = Test {
    name: "collapse",
    title: "collapse",
    scene: include_str!("../../../../studies/common-test/collapse.toml"),
    draws: 5,
    more: "",
    controls: "stays=cl-ca:walls.right.until=100",
    spoil: |plan| {
        if let Some(wall) = plan.walls.get_mut("right") {
            wall.until = None;
        }
    },
    measure,
    judge,
    picture: Picture { window: [0.0, 0.0, 0.16, 0.09], moments: |seen| (seen.last(), Some(seen.near(GOES))) },
};

fn measure(seen: &Seen) -> Vec<(&'static str, f64)> {
    let last = seen.last();
    let places: Vec<_> = seen.grains(last).iter().map(|grain| grain.at).collect();
    let (outside, front, angle) = slope(&places, WALL);
    let pairs = seen.pairs(seen.near(GOES), last);
    let still = pairs.iter().filter(|(then, now)| then.at.distance(now.at) < 2e-3).count();
    vec![
        (FRONT, front - 1e3 * WALL),
        (ANGLE, angle),
        (BEYOND, outside / places.len() as f64),
        (STILL, still as f64 / pairs.len() as f64),
    ]
}

fn judge(of: &Measured) -> Vec<Claim> {
    let front = |name: &str| of.value(name, FRONT);
    let further = |more: &str, less: &str| {
        let source = own("the more grains turn, the farther they run (Osada 2004, figure 19)").after();
        at_least(
            format!("collapse, way of the front by {more} over that by {less}"),
            front(more) / front(less),
            1.2,
            source,
        )
    };
    let fair = own("the fair twin: discs of the same areas that do not turn").after();
    let alike = |name: &str| {
        let slope = of.value(name, ANGLE) - of.value("locked", ANGLE);
        [
            between(
                format!("collapse, {name}: way of the front over that of locked discs"),
                front(name) / front("locked"),
                0.8,
                1.25,
                fair,
            ),
            between(format!("collapse, {name}: slope less that of locked discs, degrees"), slope, -10.0, 10.0, fair),
        ]
    };
    let mut claims = vec![further("dem", "rolling"), further("rolling", "locked")];
    claims.push(refused("collapse, locked discs for free ones", &[further("locked", "dem")], 1));
    claims.extend(alike("cl-ca"));
    claims.push(refused("collapse, free discs for hexagons", &alike("dem"), 2));
    let stays = |name: &str| {
        let source = closed_form("nothing else lets them out");
        between("collapse, the wall stays: share beyond it", of.value(name, BEYOND), 0.0, 0.0, source)
    };
    claims.push(stays("stays"));
    claims.push(refused("collapse, a wall that goes for one that stays", &[stays("cl-ca")], 1));
    claims
}
