//! A ball dropped in a still box (Komatsuzaki 2003, figure 8).

use super::bench::{self, Rig, near};
use super::control::refused;
use crate::case::Judged;
use crate::origin::closed_form;
use tsubu::engine::{self, Engine};
use tsubu::ledger::Ledger;
use tsubu::methods;
use tsubu::partner::Hosts;
use tsubu_frame::{Claim, Kind, Values};
use tsubu_scene::plan::Method;

const SCENE: &str = include_str!("../../../scenes/drop.toml");
const GRAVITY: f64 = 10.0;
const DROP: f64 = 0.09;

/// Height of the lowest point over the floor and time of every apex after an impact.
fn apexes(method: Method, perturbation: f64, count: usize) -> Result<Vec<(f64, f64)>, String> {
    let mut plan = bench::plan(SCENE)?;
    plan.method = method;
    // At the default 20 steps an impact's restitution is met within 1 %; the gate is finer.
    plan.dem.steps_per_contact = 100.0;
    bench::spoil(&mut plan, perturbation);
    let mut hosts = Hosts::new(&plan.hosts);
    let mut engine = methods::open(&plan, &hosts).map_err(|e| e.to_string())?;
    let mut ledger = Ledger::open(engine::energies(&*engine, &hosts), engine.momentum());
    let mut apexes = Vec::new();
    let mut best = (f64::MIN, 0.0);
    let mut falling = true;
    while apexes.len() < count && engine.time() < plan.duration {
        engine.advance(1, &mut hosts, &mut ledger).map_err(|e| e.to_string())?;
        let rising = engine.momentum()[2] > 0.0;
        if rising {
            if falling {
                best = (f64::MIN, 0.0);
            }
            let height = height(&*engine) - 3e-3;
            if height > best.0 {
                best = (height, engine.time());
            }
        } else if !falling {
            apexes.push(best);
        }
        falling = !rising;
    }
    Ok(apexes)
}

fn height(engine: &dyn Engine) -> f64 {
    match engine.frame(&Hosts::default()).column(Kind::Grain, "position").map(|c| &c.values) {
        Some(Values::Vector(positions)) => positions[0][2],
        _ => f64::NAN,
    }
}

/// Height and time of apex k (from 1) of a point that falls from `DROP` and loses 1 - e of its speed at every impact.
fn bounces(k: i32, e: f64) -> (f64, f64) {
    let fall = (2.0 * DROP / GRAVITY).sqrt();
    let time: f64 = fall + (1..k).map(|i| 2.0 * e.powi(i) * fall).sum::<f64>() + e.powi(k) * fall;
    (DROP * e.powi(2 * k), time)
}

/// V-06 and A-F8 by DEM: heights within 0.5 %, times within 0.2 % (a contact lasts 0.1 % of the first flight).
pub(super) fn dem(perturbation: f64) -> Judged {
    let found = apexes(Method::Dem, perturbation, 4)?;
    let mut claims = Vec::new();
    for k in 1..=4 {
        let (height, time) = bounces(k, 0.75);
        let (h, t) = found.get(k as usize - 1).copied().unwrap_or((f64::NAN, f64::NAN));
        let source = closed_form("closed form h e^(2k); Komatsuzaki 2003, figure 8");
        claims.push(Claim::judge(
            format!("drop, DEM: apex {k} m"),
            h,
            Some(0.995 * height),
            Some(1.005 * height),
            source,
        ));
        claims.push(Claim::judge(format!("drop, DEM: time {k} s"), t, Some(0.998 * time), Some(1.002 * time), source));
    }
    Ok(claims)
}

/// A-F8 by the automaton: apex cells are the whole part of the continuous apex in cells, times within 2 %.
pub(super) fn lattice(perturbation: f64) -> Judged {
    let found = apexes(Method::Lattice, perturbation, 4)?;
    let mut claims = Vec::new();
    for k in 1..=4 {
        let (height, time) = bounces(k, 0.75);
        let (h, t) = found.get(k as usize - 1).copied().unwrap_or((f64::NAN, f64::NAN));
        let cells = (height / 6e-3).floor();
        let source = closed_form("closed form h e^(2k), in whole cells; Komatsuzaki 2003, figure 8");
        let reached = (h / 6e-3 + 1e-9).floor();
        claims.push(Claim::judge(
            format!("drop, automaton: apex {k} cells"),
            reached,
            Some(cells),
            Some(cells),
            source,
        ));
        claims.push(Claim::judge(
            format!("drop, automaton: time {k} s"),
            t,
            Some(0.98 * time),
            Some(1.02 * time),
            source,
        ));
    }
    Ok(claims)
}

/// Two balls of the automaton that meet head-on in one column, without gravity: each leaves with e of its speed. A rebound that is
/// scattered would keep the energy and not the momentum.
pub(super) fn meeting(perturbation: f64) -> Judged {
    let mut claims = Vec::new();
    let run = |e: f64, scatter: bool| {
        let text = format!(
            r#"
            title = "two balls of the automaton meet"
            gravity = 0
            duration = 0.2
            method = "lattice"
            lattice.rebound-scatter = {scatter}
            [materials.acrylic]
            young-modulus = "0.5 GPa"
            restitution = {e}
            [particles.balls]
            material = "acrylic"
            diameter = "6 mm"
            mass = "0.2 g"
            start.at = {{ position = [[3e-3, 15e-3], [3e-3, 75e-3]], velocity = [[0, 0.3], [0, -0.3]] }}
            [walls.box]
            material = "acrylic"
            shape.box = {{ width = "60 mm", height = "96 mm" }}
            "#
        );
        let mut rig = Rig::new(&text, perturbation)?;
        let before = rig.engine.grain_energies().kinetic;
        // They meet after 0.09 s, and are not back at the walls by then.
        rig.until(0.11)?;
        let after = rig.engine.grain_energies().kinetic;
        Ok::<_, String>((after / before, rig.engine.momentum()[2] / (0.2e-3 * 0.3)))
    };
    let kept = |e: f64, momentum: f64| {
        let name = format!("automaton, two balls meet, restitution {e}: momentum over that of one before");
        bench::within(name, momentum, 0.0, 1e-9, closed_form("conservation of momentum"))
    };
    for e in [0.5, 0.75, 1.0] {
        let (energy, momentum) = run(e, false)?;
        let name = format!("automaton, two balls meet, restitution {e}: kinetic energy after over before");
        claims.push(near(name, energy, e * e, 2e-3, closed_form("definition of the restitution")));
        claims.push(kept(e, momentum));
    }
    claims.push(refused("rebounds that are scattered", &[kept(0.75, run(0.75, true)?.1)], 1));
    Ok(claims)
}
