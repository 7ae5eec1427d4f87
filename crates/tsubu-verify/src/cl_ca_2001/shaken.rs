//! C-x1 and C-x2: a shaken box, in which a large grain rises and rough walls make grains roll round.

use super::super::bench::{Rig, at_least, between};
use super::super::control::refused;
use super::super::ensemble;
use crate::case::Judged;
use crate::origin::own;
use glam::DVec3;
use std::path::Path;
use tsubu::lattice::shape::Shape;
use tsubu_scene::Scene;

const RISE: &str = include_str!("../../../../studies/cl-ca-2001/rise.toml");
const CONVECTION: &str = include_str!("../../../../studies/cl-ca-2001/convection.toml");

/// A scene of the study with changes, to be looked at here, and steps of a cycle of its shaking.
fn shaken(scene: &str, changes: &[String], less: &[&str]) -> Result<(Rig, u64), String> {
    let scene = Scene::parse("shaken", scene, Path::new("."), changes).map_err(|c| c.to_string())?;
    let mut plan = scene.plan().clone();
    plan.watch.clear();
    for group in less {
        plan.particles.remove(*group);
    }
    let switch = plan.cl_ca.gravity_switch.ok_or("a shaken box without a switch")?;
    Ok((Rig::of(plan, 1.0)?, u64::from(switch.up + switch.down)))
}

/// Cycles that a grain has to rise in.
const CYCLES: u64 = 200;

/// How high a grain of some radius has risen over the bed, and the cycles that it took to the top: of those that it had, if it did not come there.
fn risen(radius: usize, seed: u64) -> Result<[f64; 2], String> {
    let diameter = 1e-3 * Shape::hexagon(radius).diameter();
    let changes = [format!("particles.intruder.diameter={diameter:e}"), format!("seed={seed}")];
    let (mut rig, cycle_steps) = shaken(RISE, &changes, &[])?;
    let mut reached = CYCLES;
    let mut share = 0.0;
    for cycle in 1..=CYCLES {
        rig.steps(cycle_steps)?;
        let places = rig.vectors("position");
        // Groups come in the order of their names: hexagons, then the intruder.
        let intruder = places[200].z;
        let mut others: Vec<f64> = places.iter().enumerate().filter(|(id, _)| *id != 200).map(|(_, p)| p.z).collect();
        others.sort_by(f64::total_cmp);
        share = intruder / others[others.len() * 95 / 100];
        if share > 0.8 {
            reached = reached.min(cycle);
        }
    }
    Ok([share, reached as f64])
}

/// C-x1: a large grain rises to the top, the sooner the larger; one as small as the others does not.
pub(in super::super) fn rise(perturbation: f64) -> Judged {
    ensemble::drawn("boxes", 1..=6, |seed| {
        let source = own("the large grain rises, a grain as small as the others does not").after();
        let mut claims = Vec::new();
        let mut times = Vec::new();
        for radius in 1..=4 {
            let [height, time] = risen(if perturbation == 1.0 { radius } else { 1 }, seed)?;
            let name = format!("radius {radius}: height over that of the bed after {CYCLES} cycles");
            claims.push(match radius {
                1 => between(name, height, 0.0, 0.7, source),
                _ => between(name, height, 0.75, 1.2, source),
            });
            times.push(time);
        }
        claims.push(at_least("cycles to the top, radius 2 over radius 4", times[1] / times[3], 1.5, source));
        claims.push(at_least("cycles to the top, radius 1 over radius 4", times[0] / times[3], 2.0, source));
        Ok(claims)
    })
}

/// Mean rise per cycle [mm] in seven slices between the side walls, in the middle of the bed's height.
fn rolls(rough: bool, seed: u64) -> Result<[f64; 7], String> {
    const CYCLES: usize = 300;
    let smooth: &[&str] = if rough { &[] } else { &["bumps"] };
    let (mut rig, cycle_steps) = shaken(CONVECTION, &[format!("seed={seed}")], smooth)?;
    let first = if rough { 48 } else { 0 };
    let (mut sum, mut count) = ([0.0; 7], [0.0; 7]);
    let free = |rig: &Rig| -> Vec<DVec3> { rig.vectors("position").split_off(first) };
    // Bumps come first: groups are in the order of their names.
    for cycle in 0..CYCLES {
        let before = free(&rig);
        rig.steps(cycle_steps)?;
        for (a, b) in before.iter().zip(free(&rig)) {
            let slice = (a.x / 60.7e-3 * 7.0) as usize;
            if cycle > CYCLES / 10 && (8e-3..28e-3).contains(&a.z) && slice < 7 {
                sum[slice] += 1e3 * (b.z - a.z);
                count[slice] += 1.0;
            }
        }
    }
    Ok(std::array::from_fn(|slice| if count[slice] > 0.0 { sum[slice] / count[slice] } else { 0.0 }))
}

/// C-x2: down along rough walls, up beside that; along smooth walls next to nothing.
pub(in super::super) fn convection(perturbation: f64) -> Judged {
    ensemble::drawn("rolls", 1..=3, |seed| {
        let source = own("convection needs rough walls").after();
        let rough = rolls(perturbation == 1.0, seed)?;
        let smooth = rolls(false, seed)?;
        let outer = |v: &[f64; 7]| 0.5 * (v[0] + v[6]);
        let inner = |v: &[f64; 7]| 0.5 * (v[1] + v[5]);
        let strength = |v: &[f64; 7]| inner(v) - outer(v);
        let none = |rolls: &[f64; 7]| {
            between("smooth walls: strength of the roll mm a cycle", strength(rolls), -0.1, 0.1, source)
        };
        Ok(vec![
            between("rough walls: rise at the walls mm a cycle", outer(&rough), -5.0, -0.05, source),
            between("rough walls: rise beside that mm a cycle", inner(&rough), 0.05, 5.0, source),
            none(&smooth),
            refused("rough walls for smooth ones", &[none(&rough)], 1),
            at_least("strength, rough over smooth", strength(&rough) / strength(&smooth).abs().max(0.02), 5.0, source),
        ])
    })
}
