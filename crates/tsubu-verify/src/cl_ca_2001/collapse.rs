//! C-F9 to F11: a bed that loses a side wall, by CL-CA, by DEM, and of grains that may turn.

use super::super::beds::line;
use super::super::bench::{Rig, at_least, between};
use super::super::control::refused;
use super::super::ensemble;
use crate::case::Judged;
use crate::origin::{closed_form, own};
use glam::DVec3;
use std::path::Path;
use std::time::Instant;
use tsubu_frame::{Claim, Source};
use tsubu_scene::Scene;

const SOURCE: Source = own("Sakaguchi et al. (2001), figures 9 to 11: pictures").after();

/// The scene of the collapse by a method, with changes; the wall on the right stays if `opened` is false.
pub(super) fn collapsing(method: &str, opened: bool, changes: &[&str]) -> Result<Rig, String> {
    let text = include_str!("../../../../scenes/collapse.toml");
    let method = format!("method={method}");
    let changes: Vec<String> = changes.iter().chain([&method.as_str()]).map(|change| (*change).to_owned()).collect();
    let scene = Scene::parse("collapse", text, Path::new("."), &changes).map_err(|c| c.to_string())?;
    let mut plan = scene.plan().clone();
    // Looks are taken here.
    plan.watch.clear();
    plan.claim.clear();
    if !opened && let Some(wall) = plan.walls.get_mut("right") {
        wall.until = None;
    }
    Rig::of(plan, 1.0)
}

/// Grains that are elsewhere after `time` [s] more.
pub(super) fn moved(rig: &mut Rig, time: f64, least: f64) -> Result<f64, String> {
    let before = rig.vectors("position");
    rig.until(rig.engine.time() + time)?;
    let moved = before.iter().zip(rig.vectors("position")).filter(|(a, b)| a.distance(*b) > least);
    Ok(moved.count() as f64)
}

/// Where the wall stood [m].
const WALL: f64 = 86.6e-3;

/// Of grains at places: how many are beyond the place of the wall [m], the front [mm], and the slope of the surface from
/// there to the left [degrees].
pub(in super::super) fn slope(grains: &[DVec3], wall: f64) -> (f64, f64, f64) {
    let outside = grains.iter().filter(|p| p.x > wall).count() as f64;
    let mut x: Vec<f64> = grains.iter().map(|p| p.x).collect();
    x.sort_by(f64::total_cmp);
    // The front is where 99 % of the grains are behind: single ones may roll on by DEM.
    let front = x[x.len() * 99 / 100];
    let bins = 30;
    let width = front / bins as f64;
    let mut surface = vec![f64::NEG_INFINITY; bins];
    for p in grains {
        let bin = (p.x / width) as usize;
        if bin < bins {
            surface[bin] = surface[bin].max(p.z);
        }
    }
    // A straight line through the lower and middle part of the right flank: the last 60 % of the way.
    let points: Vec<(f64, f64)> = (0..bins)
        .filter(|bin| bin * 10 >= bins * 4 && surface[*bin].is_finite())
        .map(|bin| ((bin as f64 + 0.5) * width, surface[bin]))
        .collect();
    (outside, 1e3 * front, -line(&points).0.atan().to_degrees())
}

/// C-F9 to F11: dropped, at rest, a side wall removed, at rest again.
pub(in super::super) fn collapse(perturbation: f64) -> Judged {
    ensemble::drawn("collapse", 1..=8, |seed| {
        let drawn = format!("seed={seed}");
        let mut rig = collapsing("cl-ca", perturbation == 1.0, &[&drawn])?;
        rig.until(0.5)?;
        let still =
            |when: &str, moved: f64| between(format!("{when}: grains that still move"), moved, 0.0, 0.0, SOURCE);
        let mut claims = vec![still("initial", moved(&mut rig, 0.09, 1e-9)?)];
        rig.until(0.62)?;
        let moving = moved(&mut rig, 0.02, 1e-9)?;
        claims.push(at_least("middle: grains that move within 20 ms", moving, 20.0, SOURCE));
        rig.until(1.4)?;
        claims.push(still("late", moved(&mut rig, 0.1, 1e-9)?));
        claims.push(refused("a bed that has just lost its wall, as one at rest", &[still("middle", moving)], 1));
        let (outside, front, angle) = slope(&rig.vectors("position"), WALL);
        claims.push(between("late: grains beyond the place of the wall", outside, 20.0, 270.0, SOURCE));
        claims.push(between("late: front mm", front, 100.0, 300.0, SOURCE));
        let lattice = own("between nothing and the steepest side of the lattice, 60 degrees").after();
        claims.push(between("late: slope degrees", angle, 20.0, 60.0, lattice));
        let beyond = |opened: bool| -> Result<Claim, String> {
            let mut rig = collapsing("cl-ca", opened, &[&drawn])?;
            rig.until(1.4)?;
            let grains = slope(&rig.vectors("position"), WALL).0;
            let name = "control, the wall stays: grains beyond it";
            Ok(between(name, grains, 0.0, 0.0, closed_form("nothing else lets them out")))
        };
        claims.push(beyond(false)?);
        claims.push(refused("a wall that goes for one that stays", &[beyond(true)?], 1));
        Ok(claims)
    })
}

/// C-F9 to F11 by CL-CA and by DEM, one after the other on one machine. Hexagons cannot turn, so their fair twins are discs
/// that do not turn; discs that roll, freely or with resistance, stand beside them.
pub(in super::super) fn twin(perturbation: f64) -> Judged {
    ensemble::drawn("collapse by both", 1..=5, |seed| {
        let drawn = format!("seed={seed}");
        let run = |method: &str, changes: &[&str]| -> Result<_, String> {
            let mut rig = collapsing(method, perturbation == 1.0, &[changes, &[&drawn]].concat())?;
            let begun = Instant::now();
            rig.until(1.6)?;
            Ok((slope(&rig.vectors("position"), WALL), begun.elapsed().as_secs_f64()))
        };
        let (lattice, quick) = run("cl-ca", &[])?;
        let (free, slow) = run("dem", &[])?;
        let (locked, slow_too) = run("dem", &["contact.rotation=false"])?;
        let (rough, _) = run("dem", &["contact.rotation=false", "materials.aluminium.friction=0.5"])?;
        let (rolling, _) = run("dem", &["contact.rolling.epsd={}", "materials.aluminium.rolling-friction=0.2"])?;
        let source = own("a hundredth of the time of its DEM twin, measured in one run").after().timed();
        let fair = own("the fair twin: DEM of discs of the same areas that do not turn; a quarter either way").after();
        let near = own("the fair twin: DEM of discs of the same areas that do not turn; 10 degrees either way").after();
        let gates = |name: &str, of: (f64, f64, f64), twin: (f64, f64, f64)| {
            [
                between(
                    format!("way of the front, {name}"),
                    (of.1 - 1e3 * WALL) / (twin.1 - 1e3 * WALL),
                    0.8,
                    1.25,
                    fair,
                ),
                between(format!("slope in degrees, {name}"), of.2 - twin.2, -10.0, 10.0, near),
            ]
        };
        let turns =
            own("the more grains turn, the farther and flatter they run out (Osada 2004, figures 19 and 23)").after();
        let order = |more: &str, most: (f64, f64, f64), less: &str, least: (f64, f64, f64)| {
            let way = (most.1 - 1e3 * WALL) / (least.1 - 1e3 * WALL);
            [
                at_least(format!("way of the front, {more} over {less}"), way, 1.2, turns),
                at_least(format!("slope in degrees, {less} less {more}"), least.2 - most.2, 3.0, turns),
            ]
        };
        let cost = |of: f64| at_least("time of DEM over that of CL-CA", slow / of, 100.0, source);
        let mut claims = vec![cost(quick), refused("DEM in the place of CL-CA", &[cost(slow_too)], 1)];
        claims.extend(gates("CL-CA against DEM without rotation", lattice, locked));
        let twin = "CL-CA against DEM without rotation, friction 0.5";
        claims.extend(gates(twin, lattice, rough));
        claims.push(refused("CL-CA against discs that roll freely", &gates(twin, lattice, free), 2));
        let [most, middle, least] = ["discs that roll freely", "discs with resistance", "discs that do not turn"];
        claims.extend(order(most, free, middle, rolling));
        claims.extend(order(middle, rolling, least, locked));
        let turned_round = [order(most, locked, middle, free), order(middle, locked, least, free)].concat();
        claims.push(refused("discs that do not turn for free ones", &turned_round, 4));
        Ok(claims)
    })
}

/// The collapse of triangles that may turn by 60 degrees, against those that may not (C-7). What turning
/// does to discs says [`twin`], to hexagons and rods the case `common-shapes`.
pub(in super::super) fn turning(perturbation: f64) -> Judged {
    ensemble::drawn("triangles that turn", 1..=24, |seed| {
        // 6 and 21 points, for the 7 and 19 of the hexagons.
        const TRIANGLES: &str = "cl-ca.shapes={ small = { polygon = { corners = [[0, 0], [0, 4], [2, 2]] } }, \
                             large = { polygon = { corners = [[0, 0], [0, 10], [5, 5]] } } }";
        let drawn = format!("seed={seed}");
        let run = |shapes: &[&str], turning: bool, opened: bool| -> Result<_, String> {
            let turning = format!("cl-ca.turning={}", turning && perturbation == 1.0);
            let mut rig = collapsing("cl-ca", opened, &[shapes, &[turning.as_str(), &drawn]].concat())?;
            rig.until(0.59)?;
            let height = rig.engine.centre_of_mass()[2];
            rig.until(1.4)?;
            let (_, front, slope) = slope(&rig.vectors("position"), WALL);
            Ok((height, front - 1e3 * WALL, slope))
        };
        let (stiff, turned) = (run(&[TRIANGLES], false, true)?, run(&[TRIANGLES], true, true)?);
        let (hexagons, same) = (run(&[], false, true)?, run(&[], true, true)?);
        let room = own("grains that turn find room that others leave open").after();
        let closer = |name: &str, turned: f64, stiff: f64| between(name, turned / stiff, 0.5, 0.95, room);
        let pattern =
            own("the lattice makes the slope, not whether grains turn: what comes out is close to what does not turn")
                .after();
        let alike = |turned: (f64, f64, f64)| {
            let way = turned.1 / stiff.1;
            [
                between("way of the front, triangles that turn over those that do not", way, 0.75, 1.33, pattern),
                between(
                    "slope in degrees, triangles that turn less those that do not",
                    turned.2 - stiff.2,
                    -10.0,
                    10.0,
                    pattern,
                ),
            ]
        };
        let height = "height of the bed at rest, triangles that turn over those that do not";
        let mut claims = vec![
            closer(height, turned.0, stiff.0),
            refused("hexagons, which look alike when turned", &[closer(height, same.0, hexagons.0)], 1),
        ];
        claims.extend(alike(turned));
        claims.push(refused("triangles whose wall stays", &alike(run(&[TRIANGLES], true, false)?), 2));
        Ok(claims)
    })
}
