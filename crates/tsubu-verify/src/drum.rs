//! A rotating drum: where grains stay on the wall (V-37).

use super::bench::{Rig, within};
use crate::case::Judged;
use crate::origin::closed_form;

const G: f64 = 9.8;
const DRUM: f64 = 0.1;
const RADIUS: f64 = 2e-3;

/// Spin of the drum at a Froude number [rad/s].
fn turning(froude: f64) -> f64 {
    (froude * G * (DRUM - RADIUS)).sqrt() / DRUM
}

/// One grain that does not spin, on the wall of a rough drum. It moves with the wall's surface, w R, on a circle of R - r: the
/// Froude number is (w R)^2 / ((R - r) g).
fn carried(froude: f64, perturbation: f64) -> Result<Rig, String> {
    let arm = DRUM - RADIUS;
    let spin = turning(froude);
    let text = format!(
        r#"
        title = "a grain carried by a drum"
        gravity = {gravity}
        duration = 10
        speed-scale = 0.1
        [materials.rough]
        young-modulus = 1e9
        restitution = 0.2
        friction = 100
        [particles.grain]
        material = "rough"
        diameter = {diameter}
        mass = 1e-4
        start.at = {{ position = [[0, {low}]], velocity = [[{along}, 0]] }}
        [walls.drum]
        material = "rough"
        shape.cylinder = {{ radius = {DRUM} }}
        rotation = {{ signal.steady.rate = {spin} }}
        [contact]
        rotation = false
        "#,
        gravity = G * perturbation,
        diameter = 2.0 * RADIUS,
        low = -arm,
        along = -spin * DRUM,
    );
    Rig::new(&text, 1.0)
}

/// Angle before the top [degrees] at which the grain leaves the wall; `None` if it stays for two turns.
fn leaves(froude: f64, perturbation: f64) -> Result<Option<f64>, String> {
    let mut rig = carried(froude, perturbation)?;
    let turn = std::f64::consts::TAU / turning(froude);
    rig.until(0.05 * turn)?;
    while rig.engine.time() < 2.0 * turn {
        rig.steps(1)?;
        if rig.engine.contacts() == 0 {
            let p = rig.vector("position", 0);
            return Ok(Some(p.x.abs().atan2(p.z).to_degrees()));
        }
    }
    Ok(None)
}

/// V-37: from a Froude number of 1 on a grain goes round; below it leaves the wall where its cosine from the top is that
/// number.
pub(super) fn centrifuging(perturbation: f64) -> Judged {
    let mut claims = Vec::new();
    let source = closed_form("closed form w^2 R = g cos(angle)");
    for froude in [0.5f64, 0.7, 0.9, 0.98] {
        let found = leaves(froude, perturbation)?.unwrap_or(f64::NAN);
        let name = format!("drum at Froude number {froude}: angle before the top where a grain leaves");
        claims.push(within(name, found, froude.acos().to_degrees(), 1.0, source));
    }
    for froude in [1.02, 1.2] {
        let stays = f64::from(u8::from(leaves(froude, 2.0 - perturbation)?.is_none()));
        let name = format!("drum at Froude number {froude}: whether a grain stays on the wall");
        claims.push(within(name, stays, 1.0, 0.0, closed_form("closed form w^2 R >= g")));
    }
    Ok(claims)
}
