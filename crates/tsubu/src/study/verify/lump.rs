//! An inelastic ball on a shaken floor (V-39).

use super::bench;
use crate::engine;
use crate::ledger::Ledger;
use crate::partner::Hosts;
use tsubu_frame::Claim;

/// Flight times over the period, in the order they happen, after the first eighteen periods.
fn flights(gamma: f64, spoiler: f64) -> Result<Vec<f64>, String> {
    let (gravity, frequency) = (10.0, 6.0);
    let w = std::f64::consts::TAU * frequency;
    let amplitude = gamma * gravity / (w * w);
    let text = format!(
        r#"
        title = "inelastic ball on a shaken floor"
        gravity = 10
        duration = "4 s"
        [materials.putty]
        young-modulus = "0.5 GPa"
        restitution = 0.002
        friction = 0
        [particles.ball]
        material = "putty"
        diameter = "6 mm"
        mass = "0.2 g"
        start.at = {{ position = [[0, "3 mm"]] }}
        [walls.floor]
        material = "putty"
        shape.plane = {{ point = [0, 0], normal = [0, 1] }}
        motion = {{ direction = "z", signal.sine = {{ amplitude = {amplitude}, frequency = {frequency} }} }}
        [contact]
        tangential.none = {{}}
        "#
    );
    let mut plan = bench::plan(&text)?;
    plan.gravity[2] *= spoiler;
    // A restitution of 0.002 takes a dashpot that is fast against the contact.
    plan.dem.steps_per_contact = 2000.0;
    let mut hosts = Hosts::new(&plan.hosts);
    let mut engine = engine::open(&plan, &hosts).map_err(|e| e.to_string())?;
    let mut ledger = Ledger::open(engine::stocks(&*engine, &hosts), engine.momentum());
    let period = 1.0 / frequency;
    let mut flights = Vec::new();
    let mut left = None;
    while engine.time() < plan.duration {
        engine.advance(1, &mut hosts, &mut ledger).map_err(|e| e.to_string())?;
        match (engine.contacts() > 0, left) {
            (false, None) => left = Some(engine.time()),
            (true, Some(start)) => {
                // Hops of the small restitution that is left are no flights.
                let flight = (engine.time() - start) / period;
                if flight > 0.1 && start > 18.0 * period {
                    flights.push(flight);
                }
                left = None;
            }
            _ => {}
        }
    }
    Ok(flights)
}

/// Flight time is one period for sqrt(1 + pi^2) <= Gamma <= sqrt(4 + pi^2), shorter below, of two lengths above.
pub(super) fn locking(spoiler: f64) -> Result<Vec<Claim>, String> {
    let source = "closed form and event-driven integration (V-39)";
    // The spoiler acts on gravity here: the law's constants do not enter an inelastic flight.
    let mut claims = Vec::new();
    for (gamma, expected) in [(3.25, vec![0.9922]), (3.32, vec![1.0]), (3.6, vec![1.0]), (3.74, vec![0.9661, 1.0339])] {
        let mut found = flights(gamma, spoiler)?;
        found.sort_by(f64::total_cmp);
        let n = found.len();
        let ends =
            [found.first().copied().unwrap_or(f64::NAN), found.get(n.wrapping_sub(1)).copied().unwrap_or(f64::NAN)];
        let labels: &[&str] = if expected.len() == 1 { &["shortest", "longest"] } else { &["short", "long"] };
        for (i, label) in labels.iter().enumerate() {
            let wanted = expected[i.min(expected.len() - 1)];
            let name = format!("inelastic ball at {gamma} g: {label} flight over period");
            claims.push(Claim::judge(name, ends[i], Some(wanted - 0.003), Some(wanted + 0.003), source));
        }
    }
    Ok(claims)
}
