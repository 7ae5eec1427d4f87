//! Single contacts against closed forms.

use super::bench;
use crate::case::Judged;
use crate::origin::closed_form;
use tsubu::engine;
use tsubu::ledger::Ledger;
use tsubu::methods;
use tsubu::partner::Hosts;
use tsubu_frame::Claim;

/// A ball thrown at a floor, or at another ball, with 1 m/s; 200 steps per contact, 2000 with a linear dashpot.
fn impact(law: &str, restitution: f64, pair: bool, speed: f64, perturbation: f64) -> Result<f64, String> {
    let positions = if pair { "[[-3.1e-3, 0], [3.1e-3, 0]]" } else { "[[0, 3.1e-3]]" };
    let velocities =
        if pair { format!("[[{}, 0], [{}, 0]]", 0.5 * speed, -0.5 * speed) } else { format!("[[0, {}]]", -speed) };
    let text = format!(
        r#"
        title = "one impact"
        gravity = 0
        duration = "10 ms"
        speed-scale = {speed}
        [materials.acrylic]
        young-modulus = "0.5 GPa"
        poisson-ratio = 0.3
        restitution = {restitution}
        friction = 0.5
        [particles.balls]
        material = "acrylic"
        diameter = "6 mm"
        mass = "0.2 g"
        start.at = {{ position = {positions}, velocity = {velocities} }}
        [walls.floor]
        material = "acrylic"
        shape.plane = {{ point = [0, {floor}], normal = [0, 1] }}
        [contact]
        tangential.none = {{}}
        {law}
        [dem]
        steps-per-contact = {steps}
        "#,
        floor = if pair { -1.0 } else { 0.0 },
        // A linear dashpot jumps at first touch: its error falls with the step, not with its square.
        steps = if law.contains("linear") { 2000 } else { 200 },
    );
    let mut plan = bench::plan(&text)?;
    bench::spoil(&mut plan, perturbation);
    let mut hosts = Hosts::new(&plan.hosts);
    let mut engine = methods::open(&plan, &hosts).map_err(|e| e.to_string())?;
    let mut ledger = Ledger::open(engine::energies(&*engine, &hosts), engine.momentum());
    let energy = |engine: &dyn engine::Engine| engine.grain_energies().kinetic;
    let before = energy(&*engine);
    let steps = (plan.duration / engine.time_step()) as u64;
    engine.advance(steps, &mut hosts, &mut ledger).map_err(|e| e.to_string())?;
    Ok((energy(&*engine) / before).sqrt())
}

/// V-05. The restitution that was asked for comes back, to 1e-3, at the speed where the form promises it.
pub(super) fn restitution(perturbation: f64) -> Judged {
    let forms = [
        ("sqrt, attraction", "damping.sqrt = {}\nattraction = true"),
        ("sqrt", "damping.sqrt = {}"),
        ("quarter, attraction", "damping.quarter = {}\nattraction = true"),
        ("quarter", "damping.quarter = {}"),
        ("linear, attraction", "damping.linear = {}\nattraction = true"),
        ("linear", "damping.linear = {}"),
        ("hooke + linear, attraction", "normal.hooke = { stiffness = 1e5 }\ndamping.linear = {}\nattraction = true"),
        ("hooke + linear", "normal.hooke = { stiffness = 1e5 }\ndamping.linear = {}"),
    ];
    let mut claims = Vec::new();
    for (name, law) in forms {
        for e in [0.9, 0.75, 0.5] {
            for pair in [false, true] {
                let value = impact(law, e, pair, 1.0, perturbation)?;
                let where_ = if pair { "pair" } else { "wall" };
                claims.push(Claim::judge(
                    format!("restitution {e} by {name}, {where_}"),
                    value,
                    Some(e - 1e-3),
                    Some(e + 1e-3),
                    closed_form("definition; coefficients: Antypov and Elliott 2011, Thornton et al. 2013"),
                ));
            }
        }
    }
    Ok(claims)
}
