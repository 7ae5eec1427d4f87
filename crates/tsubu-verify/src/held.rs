//! A small sphere between two large ones (V-16), and a linear tangential spring without slip (V-15).

use super::bench::{Rig, near, within};
use super::control::refused;
use super::throw::Throw;
use crate::case::Judged;
use crate::origin::{closed_form, own};
use tsubu_frame::Claim;

const MASS: f64 = 1e-3;
const RADIUS: f64 = 1e-3;
const FRICTION: f64 = 0.5;
const YOUNG: f64 = 1e9;
const POISSON: f64 = 0.3;
/// Overlap at both sides, over the diameter of the small one.
const PINCH: f64 = 5e-4;

/// Force [N] that presses on each side, and tangential stiffness [N/m] of one side, at a ratio of radii.
fn pinch(ratio: f64) -> (f64, f64) {
    let reduced = RADIUS * ratio / (1.0 + ratio);
    let overlap = 2.0 * PINCH * RADIUS;
    let disc = (reduced * overlap).sqrt();
    let young = 0.5 * YOUNG / (1.0 - POISSON * POISSON);
    let shear = 0.5 * YOUNG / (2.0 * (1.0 + POISSON) * (2.0 - POISSON));
    (4.0 / 3.0 * young * disc * overlap, 8.0 * shear * disc)
}

/// The small sphere hangs in friction by `share` of what it can hold, one large sphere at each side.
fn squeezed(ratio: f64, share: f64, perturbation: f64) -> Result<Rig, String> {
    let gravity = share * 2.0 * FRICTION * pinch(ratio).0 / MASS;
    let x = RADIUS * (1.0 + ratio - 2.0 * PINCH);
    let text = format!(
        r#"
        title = "a small sphere held between two large ones"
        dimension = 3
        gravity = {gravity:e}
        duration = 1
        speed-scale = 0.1
        [materials.hard]
        young-modulus = {YOUNG:e}
        poisson-ratio = {POISSON}
        restitution = 0.5
        friction = {FRICTION}
        [particles.a-small]
        material = "hard"
        diameter = {small:e}
        mass = {MASS}
        start.at.position = [[0, 0, 0]]
        [particles.b-large]
        material = "hard"
        diameter = {large:e}
        mass = 1
        motion.frozen = {{}}
        start.at.position = [[{x:e}, 0, 0], [-{x:e}, 0, 0]]
        "#,
        small = 2.0 * RADIUS,
        large = 2.0 * ratio * RADIUS,
    );
    Rig::new(&text, perturbation)
}

/// V-16: friction holds the small sphere at any ratio of sizes: it sags as the springs say, does not drift, and falls when
/// it is too heavy.
pub(super) fn three_spheres(perturbation: f64) -> Judged {
    let mut claims = Vec::new();
    let source = closed_form("statics; after the three spheres of Vyas et al. 2025");
    for ratio in [1.0, 3.0, 10.0, 30.0, 100.0] {
        let (press, stiffness) = pinch(ratio);
        let sag = 0.45 * FRICTION * press / stiffness;
        let mut rig = squeezed(ratio, 0.45, perturbation)?;
        rig.steps(4000)?;
        let height = rig.vector("position", 0).z;
        claims.push(near(format!("three spheres, ratio {ratio}: sag m"), -height, sag, 0.01, source));
        rig.steps(20_000)?;
        let drift = (rig.vector("position", 0).z - height) / sag;
        claims.push(within(
            format!("three spheres, ratio {ratio}: drift in 20000 steps over sag"),
            drift,
            0.0,
            1e-3,
            source,
        ));
        let mut rig = squeezed(ratio, 0.97, perturbation)?;
        rig.steps(20_000)?;
        let (speed, held) = (rig.vector("velocity", 0).length(), -rig.vector("position", 0).z / RADIUS);
        claims.push(within(
            format!("three spheres, ratio {ratio}: speed at 0.97 of the limit m/s"),
            speed,
            0.0,
            1e-6,
            source,
        ));
        let mut rig = squeezed(ratio, 1.03, perturbation)?;
        rig.steps(20_000)?;
        let fell = -rig.vector("position", 0).z / RADIUS;
        let falls = |fell: f64| {
            let name = format!("three spheres, ratio {ratio}: fall at 1.03 of the limit, in radii");
            Claim::judge(name, fell, Some(0.1), None, own("beyond the limit it falls").after())
        };
        claims.push(falls(fell));
        claims.push(refused(&format!("0.97 of the limit, ratio {ratio}"), &[falls(held)], 1));
    }
    Ok(claims)
}

/// V-15: tangential restitution of a linear spring that does not slip.
pub(super) fn no_slip(perturbation: f64) -> Judged {
    let mut claims = Vec::new();
    for (name, shape, inverse) in [("sphere", "sphere = {}", 3.5f64), ("disc", "disc = { thickness = 1e-3 }", 3.0)] {
        for ratio in [0.1, 2.0 / 7.0, 0.5, 1.0] {
            let law = format!("normal.hooke.stiffness = 1e9\ntangential.spring.ratio = {}", ratio * perturbation);
            let throw =
                Throw { friction: 1e6, velocity: [0.5, 1.0], shape, law: &law, steps: 5000.0, ..Throw::default() };
            let seen = throw.go(1.0)?;
            let value = (seen.velocity[0] - seen.spin * throw.radius) / 0.5;
            let closed = (std::f64::consts::PI * (inverse * ratio).sqrt()).cos();
            let name = format!("linear spring, {name}, k_t/k_n = {ratio:.4}: tangential restitution");
            claims.push(within(name, value, closed, 2e-3, closed_form("closed form")));
        }
    }
    Ok(claims)
}
