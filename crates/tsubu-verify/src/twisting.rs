//! A sphere that spins about the normal of a plane: twisting friction (Marshall 2009).

use super::bench::{Rig, near, within};
use crate::case::Judged;
use crate::origin::closed_form;

const G: f64 = 9.8;
const RADIUS: f64 = 5e-3;
const MASS: f64 = 1e-3;
/// Overlap under its own weight, over the radius.
const PRESSED: f64 = 1e-5;
/// Twisting friction.
const TWISTING: f64 = 0.5;
/// Tangential over normal stiffness.
const RATIO: f64 = 0.3;

/// It stands on the plane, pressed in by its weight, and spins with `spin` [rad/s].
fn top(law: &str, spin: f64, perturbation: f64) -> Result<Rig, String> {
    let text = format!(
        r#"
        title = "a sphere that spins on a plane"
        dimension = 3
        gravity = {gravity}
        duration = 1
        [materials.hard]
        young-modulus = 1e9
        restitution = 0.9
        friction = 0.3
        twisting-friction = {TWISTING}
        [particles.grain]
        material = "hard"
        diameter = {diameter}
        mass = {MASS}
        start.at = {{ position = [[0, 0, {height:e}]], spin = [[0, 0, {spin}]] }}
        [walls.floor]
        material = "hard"
        shape.plane = {{ normal = "z" }}
        [contact]
        normal.hooke = {{ stiffness = {stiffness:e} }}
        damping.none = {{}}
        tangential.spring = {{ ratio = {RATIO} }}
        {law}
        "#,
        // With the stiffness, so that it stands still: the spring of a sphere that bounces is pulled down.
        gravity = G * perturbation,
        diameter = 2.0 * RADIUS,
        height = RADIUS * (1.0 - PRESSED),
        stiffness = MASS * G / (PRESSED * RADIUS),
    );
    Rig::new(&text, perturbation)
}

/// A spin that slides is slowed at a constant rate, by both models; below its limit the spring swings as a pendulum.
pub(super) fn spin_about_normal(perturbation: f64) -> Judged {
    let mut claims = Vec::new();
    let source = closed_form("Marshall 2009: torque 2/3 mu_t a f_n of a disc under even pressure");
    let (disc, inertia) = (RADIUS * PRESSED.sqrt(), 0.4 * MASS * RADIUS * RADIUS);
    let limit = 2.0 / 3.0 * TWISTING * disc * MASS * G;
    for (name, law) in [("sliding", "twisting.sliding = {}"), ("spring", "twisting.spring = {}")] {
        let mut rig = top(law, 10.0, perturbation)?;
        rig.until(0.1)?;
        let (spin, time) = (rig.vector("spin", 0).z, rig.engine.time());
        rig.until(0.3)?;
        let rate = (spin - rig.vector("spin", 0).z) / (rig.engine.time() - time);
        claims.push(near(format!("twisting, {name}: rate rad/s^2"), rate, limit / inertia, 5e-3, source));
        let residual = closed_form("conservation of energy");
        claims.push(within(format!("twisting, {name}: energy residual"), rig.residual(), 0.0, 1e-3, residual));
    }
    let stiffness = 0.5 * RATIO * MASS * G / (PRESSED * RADIUS) * disc * disc;
    let half = std::f64::consts::PI * (inertia / stiffness).sqrt();
    // A quarter of the spin at which it would slide.
    let mut rig = top("twisting.spring = {}", 0.25 * limit / (stiffness * inertia).sqrt(), perturbation)?;
    let quarter = crossing(&mut rig, half)?;
    let three = crossing(&mut rig, half)?;
    let source = closed_form("a pendulum of k_t a^2 / 2");
    claims.push(near("twisting, spring: half a swing s", three - quarter, half, 5e-3, source));
    Ok(claims)
}

/// When the spin changes its sign next [s], between two steps by a straight line; not-a-number where it has not after `half` and half of it.
fn crossing(rig: &mut Rig, half: f64) -> Result<f64, String> {
    let end = rig.engine.time() + 1.5 * half;
    let (mut spin, mut time) = (rig.vector("spin", 0).z, rig.engine.time());
    while rig.engine.time() < end {
        rig.steps(1)?;
        let (next, now) = (rig.vector("spin", 0).z, rig.engine.time());
        if next * spin <= 0.0 && next != spin {
            return Ok(time + (now - time) * spin / (spin - next));
        }
        (spin, time) = (next, now);
    }
    Ok(f64::NAN)
}
