//! Impacts that leave a dent: Luding's hysteretic law against its closed forms.

use super::bench::{Rig, near, within};
use super::control::refused;
use crate::case::Judged;
use crate::origin::closed_form;

const MASS: f64 = 1e-5;
const RADIUS: f64 = 1e-3;
/// k1 [N/m].
const STIFFNESS: f64 = 1e3;
/// K over k1 [-].
const UNLOADING: f64 = 5.0;
/// phi [-].
const DEPTH: f64 = 0.02;

/// What an impact leaves.
struct Impact {
    /// Rebound speed over impact speed [-]; 0 where the ball stays.
    restitution: f64,
    /// Strongest pull on the ball [N].
    pull: f64,
    /// Energy residual over the energy of the ball [-].
    residual: f64,
}

/// A ball thrown at a floor.
fn impact(adhesion: f64, speed: f64, perturbation: f64) -> Result<Impact, String> {
    let text = format!(
        r#"
        title = "an impact that leaves a dent"
        gravity = 0
        duration = "5 ms"
        speed-scale = {speed}
        [materials.soft]
        young-modulus = "1 GPa"
        friction = 0
        [particles.ball]
        material = "soft"
        diameter = {diameter}
        mass = {MASS:e}
        start.at = {{ position = [[0, {height:e}]], velocity = [[0, {down}]] }}
        [walls.floor]
        material = "soft"
        shape.plane = {{}}
        [contact]
        damping.none = {{}}
        tangential.none = {{}}
        [contact.normal.luding]
        stiffness = {STIFFNESS}
        unloading-ratio = {ratio}
        adhesion-ratio = {adhesion}
        plasticity-depth = {DEPTH}
        [dem]
        steps-per-contact = 1000
        "#,
        diameter = 2.0 * RADIUS,
        height = 1.001 * RADIUS,
        down = -speed,
        ratio = UNLOADING * perturbation,
    );
    let mut rig = Rig::new(&text, 1.0)?;
    let (dt, mut before, mut pull) = (rig.engine.time_step(), -speed, 0.0_f64);
    let end = rig.plan.duration;
    while rig.engine.time() < end && (rig.engine.contacts() > 0 || before < 0.0) {
        rig.steps(1)?;
        let now = rig.vector("velocity", 0).z;
        pull = pull.max(MASS * (before - now) / dt);
        before = now;
    }
    let parted = rig.engine.contacts() == 0;
    let restitution = if parted { before / speed } else { 0.0 };
    Ok(Impact { restitution, pull, residual: rig.unexplained() / (0.5 * MASS * speed * speed) })
}

/// Restitution and strongest pull by the closed forms, with the k2 of the depth that the impact reaches.
fn closed(adhesion: f64, speed: f64) -> (f64, f64) {
    let full = UNLOADING / (UNLOADING - 1.0) * 2.0 * RADIUS * DEPTH;
    let depth = (speed * (MASS / STIFFNESS).sqrt()).min(full);
    let (k2, kc) = (STIFFNESS * (1.0 + (UNLOADING - 1.0) * depth / full), adhesion * STIFFNESS);
    let rest = (1.0 - STIFFNESS / k2) * depth;
    let lost = 0.5 * STIFFNESS * depth * rest + 0.5 * kc * k2 * rest * rest / (k2 + kc);
    let left = 1.0 - lost / (0.5 * MASS * speed * speed);
    (left.max(0.0).sqrt(), kc * (k2 - STIFFNESS) / (k2 + kc) * depth)
}

/// Luding 2008: an impact without adhesion returns sqrt(k1/k2), k2 of its depth; with adhesion slow and fast ones come back and
/// those between stay; the strongest pull is kc d_min.
pub(super) fn dent(perturbation: f64) -> Judged {
    let source = closed_form("Luding 2008, by the areas under his forces");
    let (mut claims, mut simple) = (Vec::new(), Vec::new());
    for adhesion in [0.0, 0.5] {
        for speed in [0.05, 0.15, 0.4, 1.0] {
            let found = impact(adhesion, speed, perturbation)?;
            let (restitution, pull) = closed(adhesion, speed);
            let name = format!("dent by {speed} m/s, kc = {adhesion} k1");
            claims.push(within(format!("{name}: restitution"), found.restitution, restitution, 1e-3, source));
            if adhesion > 0.0 {
                claims.push(near(format!("{name}: strongest pull N"), found.pull, pull, 5e-3, source));
            } else {
                let stiff = UNLOADING.recip().sqrt();
                simple.push(within("restitution", found.restitution, stiff, 1e-3, source));
            }
            claims.push(within(
                format!("{name}: energy residual over the ball's energy"),
                found.residual,
                0.0,
                1e-4,
                closed_form("conservation of energy"),
            ));
        }
    }
    claims.push(refused("one k2 for all depths", &simple, 4));
    Ok(claims)
}
