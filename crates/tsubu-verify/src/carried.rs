//! A grain that friction holds on a belt going up: on its way neighbour lists are rebuilt thousands of times, and the spring that holds it
//! must be there after each.

use super::bench::{Rig, near};
use super::control::refused;
use crate::case::Judged;
use crate::origin::closed_form;
use tsubu_frame::Claim;

const G: f64 = 9.8;
const RADIUS: f64 = 5e-3;
const MASS: f64 = 1e-3;
/// Normal stiffness [N/m]: a weight presses a thousandth of the radius.
const STIFFNESS: f64 = MASS * G / (1e-3 * RADIUS);
/// Tangential over normal stiffness.
const RATIO: f64 = 2.0 / 7.0;
/// Tangent of the slope, and speed of the belt [m/s].
const SLOPE: f64 = 0.2;
const BELT: f64 = 2.0;
const TIME: f64 = 2.0;

fn belt(tangential: &str, perturbation: f64) -> Result<Rig, String> {
    let slope = SLOPE.atan();
    let text = format!(
        r#"
        title = "a grain on a belt"
        gravity = [{gx}, {gz}]
        duration = {TIME}
        [materials.hard]
        young-modulus = 1e9
        restitution = 0.3
        friction = 0.6
        [particles.grain]
        material = "hard"
        diameter = {diameter}
        mass = {MASS}
        start.at = {{ position = [[0, {height}]], velocity = [[{BELT}, 0]] }}
        [walls.belt]
        material = "hard"
        shape.plane = {{}}
        motion = {{ direction = "x", signal.steady.rate = {BELT} }}
        [contact]
        rotation = false
        normal.hooke = {{ stiffness = {STIFFNESS} }}
        damping.linear = {{}}
        {tangential}
        "#,
        gx = -G * slope.sin(),
        gz = -G * slope.cos(),
        diameter = 2.0 * RADIUS,
        height = RADIUS * (1.0 - 1e-3),
    );
    Rig::new(&text, perturbation)
}

/// How far the grain has stayed behind the belt, over the stretch m g sin(slope) / k_t that holds it.
fn stayed_behind(tangential: &str, perturbation: f64) -> Result<Claim, String> {
    let mut rig = belt(tangential, perturbation)?;
    rig.until(TIME)?;
    let behind = BELT * rig.engine.time() - rig.vector("position", 0).x;
    let stretch = MASS * G * SLOPE.atan().sin() / (RATIO * STIFFNESS);
    let source = closed_form("m g sin(slope) = k_t times the stretch, wherever the belt has taken the grain");
    let way = format!("a grain held by a spring for {} m on a belt", BELT * TIME);
    Ok(near(format!("{way}: what it stays behind m"), behind, stretch, 0.01, source))
}

/// The spring of a contact goes on over every rebuild of the neighbour lists.
pub(super) fn held(perturbation: f64) -> Judged {
    let held = stayed_behind("tangential.spring.damping = 1", perturbation)?;
    let creeps = stayed_behind("tangential.coulomb.smoothing-speed = 1e-3", perturbation)?;
    Ok(vec![held, refused("friction without a spring, which creeps", &[creeps], 1)])
}
