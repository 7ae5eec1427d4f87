//! An inelastic ball on a shaken floor (V-39).

use super::bench;
use crate::case::Judged;
use crate::origin::{closed_form, own};
use tsubu::engine;
use tsubu::ledger::Ledger;
use tsubu::methods;
use tsubu::partner::Hosts;
use tsubu_frame::Claim;

/// Flight times over the period, in the order they happen, after the first eighteen periods.
fn flights(gamma: f64, perturbation: f64) -> Result<Vec<f64>, String> {
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
        restitution = 1e-4
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
        # Near critical damping: no rebound, without a dashpot that is fast against the contact.
        normal.hooke = {{ stiffness = 1e6 }}
        damping.linear = {{}}
        attraction = true
        tangential.none = {{}}
        [dem]
        steps-per-contact = 50
        "#
    );
    let mut plan = bench::plan(&text)?;
    // No constant of the law enters an inelastic flight: here the perturbation acts on gravity.
    plan.gravity[2] *= perturbation;
    let mut hosts = Hosts::new(&plan.hosts);
    let mut engine = methods::open(&plan, &hosts).map_err(|e| e.to_string())?;
    let mut ledger = Ledger::open(engine::energies(&*engine, &hosts), engine.momentum());
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

/// Flight time is one period for sqrt(1 + pi^2) <= Gamma <= sqrt(4 + pi^2), shorter below, of two lengths above. The
/// tolerance is the time that a contact of this stiffness lasts.
pub(super) fn locking(perturbation: f64) -> Judged {
    let source = closed_form("closed form and event-driven integration");
    let mut claims = Vec::new();
    for (gamma, expected) in [(3.25, 0.9922), (3.32, 1.0), (3.6, 1.0)] {
        let found = flights(gamma, perturbation)?;
        for (label, value) in [
            ("shortest", found.iter().copied().fold(f64::NAN, f64::min)),
            ("longest", found.iter().copied().fold(f64::NAN, f64::max)),
        ] {
            let name = format!("inelastic ball at {gamma} g: {label} flight over period");
            claims.push(Claim::judge(name, value, Some(expected - 0.003), Some(expected + 0.003), source));
        }
    }
    let mut found = flights(3.74, perturbation)?;
    // Long and short ones take turns: an even number of them for the mean.
    found.truncate(found.len() / 2 * 2);
    let mean = found.iter().sum::<f64>() / found.len() as f64;
    let spread = found.iter().copied().fold(f64::NAN, f64::max) - found.iter().copied().fold(f64::NAN, f64::min);
    let name = "inelastic ball at 3.74 g: mean of its two flights over period";
    claims.push(Claim::judge(name, mean, Some(0.997), Some(1.003), source));
    // So near to where the period doubles, the difference (0.068 for no restitution at all) hangs on the last per mille of
    // restitution; that there is one does not.
    let name = "inelastic ball at 3.74 g: difference of its two flights over period";
    claims.push(Claim::judge(
        name,
        spread,
        Some(0.034),
        Some(0.136),
        own("0.068 without restitution, a factor of 2").after(),
    ));
    Ok(claims)
}
