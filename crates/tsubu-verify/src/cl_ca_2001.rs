//! Sakaguchi, Murakami, Hasegawa and Kawai (2001): grains made of lattice points.
//!
//! The paper shows pictures and no numbers, so the claims are signs, order and shape. A perturbation other than 1 takes away
//! what each effect needs: the wall stays, the large grain is as small as the others, the walls are smooth, nothing is
//! poured or pushed.

mod collapse;
mod plate;
mod rules;
mod shaken;

pub(super) use collapse::{collapse, slope, turning, twin};
pub(super) use plate::{plate, plate_twin};
pub(super) use rules::rules;
pub(super) use shaken::{convection, rise};

use super::beds::line;
use super::bench::{Rig, at_least, between};
use super::control::refused;
use super::ensemble;
use crate::case::Judged;
use crate::origin::{closed_form, own};
use collapse::{collapsing, moved};
use glam::DVec3;
use plate::PUSHED;
use tsubu::clca::bed::Bed;
use tsubu::clca::engine::ClCaEngine;
use tsubu::engine::{self, Engine};
use tsubu::lattice::grid::WALL;
use tsubu::ledger::Ledger;
use tsubu::partner::Hosts;
use tsubu_frame::{Claim, State};
use tsubu_scene::Plan;

/// A poured heap: grains that move within the last `pause` seconds before `end`, and where all are then.
fn poured(plan: &Plan, end: f64, pause: f64) -> Result<(f64, Vec<DVec3>), String> {
    let mut rig = Rig::of(plan.clone(), 1.0)?;
    rig.until(end - pause)?;
    let moved = moved(&mut rig, pause, 1e-9)?;
    Ok((moved, rig.vectors("position")))
}

/// Gates on the surface of a heap.
fn surface_gates(grains: &[DVec3]) -> Vec<Claim> {
    let middle = grains.iter().map(|p| p.x).sum::<f64>() / grains.len().max(1) as f64;
    // The surface: the highest grain of every column of 3 mm.
    let width = 3e-3;
    let mut surface = std::collections::BTreeMap::new();
    for p in grains {
        let column = ((p.x - middle) / width).floor() as i64;
        let top = surface.entry(column).or_insert(f64::NEG_INFINITY);
        *top = p.z.max(*top);
    }
    let flank = |side: i64| {
        let points: Vec<(f64, f64)> = surface
            .iter()
            .filter(|(column, top)| side * (2 * **column + 1) > 0 && **top > 4e-3)
            .map(|(column, top)| ((*column as f64 + 0.5) * width, *top))
            .collect();
        -(side as f64) * line(&points).0.atan().to_degrees()
    };
    let tops: Vec<f64> = surface.values().copied().collect();
    let angles: Vec<f64> = tops.windows(4).map(|t| ((t[3] - t[0]) / (3.0 * width)).atan().abs().to_degrees()).collect();
    let share = |of: &dyn Fn(f64) -> bool| {
        angles.iter().filter(|angle| of(**angle)).count() as f64 / angles.len().max(1) as f64
    };
    let some = share(&|angle| (25.0..62.0).contains(&angle));
    let source = own("heaps of hexagons end between the lattice's 30 and 60 degrees").after();
    vec![
        between("left flank degrees", flank(-1), 30.0, 60.0, source),
        between("right flank degrees", flank(1), 30.0, 60.0, source),
        between("share of the surface at 25 to 62 degrees", some, 0.6, 1.0, source),
        between("share of the surface steeper than 62 degrees", share(&|angle| angle > 62.0), 0.0, 0.1, source),
    ]
}

/// C-x3: grains are poured; slopes of the heap, and how often each angle is met along its surface.
pub(super) fn pour(perturbation: f64) -> Judged {
    ensemble::drawn("heap", 1..=8, |seed| {
        let text = include_str!("../../../studies/cl-ca-2001/pour.toml");
        let mut plan = super::bench::plan(text)?;
        plan.watch.clear();
        plan.seed = seed;
        if perturbation != 1.0 {
            plan.cl_ca.fall_height = Some(1e3);
            plan.duration = 0.1;
        }
        let (still, grains) = poured(&plan, plan.duration, 0.2)?;
        let rests = |moved: f64| between("grains that still move", moved, 0.0, 0.0, closed_form("the scene"));
        let mut claims =
            vec![at_least("grains poured", grains.len() as f64, 600.0, closed_form("the scene")), rests(still)];
        claims.extend(surface_gates(&grains));
        let half_way = poured(&plan, 0.3 * plan.duration, 0.1)?.0;
        claims.push(refused("a heap that is still poured", &[rests(half_way)], 1));
        // As wide as the floor: a bed, not a heap.
        let mut wide =
            super::bench::plan(&text.replace("[\"-5 mm\"", "[\"-170 mm\"").replace("[\"5 mm\"", "[\"170 mm\""))?;
        wide.watch.clear();
        wide.seed = seed;
        let level = poured(&wide, wide.duration, 0.2)?.1;
        claims.push(refused("grains poured along the whole floor", &surface_gates(&level), 3));
        Ok(claims)
    })
}

/// C-6: what holds after every step, whatever the scene: the collapse under the active rule, the pushed plate under the passive
/// one. The perturbation takes a point away from a grain.
pub(super) fn invariants(perturbation: f64) -> Judged {
    const STEPS: u64 = 400;
    let plate = super::bench::plan(include_str!("../../../studies/cl-ca-2001/plate.toml"))?;
    let scenes = [("active rule", collapsing("cl-ca", true, &[])?.plan, 0.6), ("passive rule", plate, PUSHED)];
    let source = closed_form("every step");
    let mut claims = Vec::new();
    for (name, plan, begin) in scenes {
        let owned = name == "active rule";
        let hosts = &mut Hosts::new(&plan.hosts);
        // From a little before the wall goes, or the plate meets the bed, on.
        let run = |threads: usize, seed: u64, hosts: &mut Hosts| -> Result<_, String> {
            let plan = Plan { seed, ..plan.clone() };
            let mut engine = ClCaEngine::new(&plan, hosts).map_err(|refusal| refusal.to_string())?;
            let mut ledger = Ledger::open(engine::energies(&engine, hosts), engine.momentum());
            let grains = engine.grains();
            let threads = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(|e| e.to_string())?;
            threads.install(|| {
                let before = (begin / engine.time_step()) as u64 - STEPS / 2;
                engine.advance(before, hosts, &mut ledger).map_err(|fault| fault.to_string())?;
                let mut broken = 0;
                for _ in 0..STEPS {
                    let before = engine.bed().grains.cell.clone();
                    engine.advance(1, hosts, &mut ledger).map_err(|fault| fault.to_string())?;
                    broken += u32::from(engine.bed().fault(owned, &before).is_some());
                }
                let mut state = State::default();
                engine.save(&mut state);
                let hash = state.hash();
                Ok((engine, broken, grains, hash))
            })
        };
        let (engine, broken, grains, hash) = run(1, plan.seed, hosts)?;
        let (seven, other) = (run(7, plan.seed, hosts)?.3, run(7, plan.seed + 1, hosts)?.3);
        let mut bed = engine.bed().clone();
        let cells = bed.grains.cell.clone();
        bed.grains.last.fill(None);
        let gate = |bed: &Bed, broken: u32| {
            let broken = broken + u32::from(bed.fault(owned, &cells).is_some());
            let place = if owned { "shared or on a wall" } else { "on a wall" };
            let what = format!("steps with a point {place}, or a grain lost or moved by more than one spacing");
            between(format!("{name}: of {STEPS}, {what}"), f64::from(broken), 0.0, 0.0, source)
        };
        let Some(free) = bed.present().find(|&grain| bed.kind(grain).free) else { return Err("no grain".to_owned()) };
        let mut wrong = bed.clone();
        wrong.grid.set(cells[free] as usize, WALL);
        claims.push(gate(if perturbation == 1.0 { &bed } else { &wrong }, broken));
        claims.push(refused("a wall where a grain is", &[gate(&wrong, 0)], 1));
        let lost = |left: usize| between(format!("{name}: grains lost"), (grains - left) as f64, 0.0, 0.0, source);
        claims.push(lost(engine.grains()));
        bed.remove(free);
        claims.push(refused("a grain that is taken away", &[lost(bed.present().count())], 1));
        let same = |other| {
            let same = f64::from(u8::from(hash == other));
            between(format!("{name}: same bits at 1 and 7 threads"), same, 1.0, 1.0, source)
        };
        claims.push(same(seven));
        claims.push(refused("other random numbers at 7 threads", &[same(other)], 1));
    }
    Ok(claims)
}
