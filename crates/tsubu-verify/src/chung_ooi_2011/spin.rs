//! Tests 6 to 8: spheres that come spinning.

use super::oblique::table;
use super::{ALLOY, Material, material};
use crate::bench::{Rig, near, within};
use crate::case::Judged;
use crate::control::refused;
use crate::origin::{closed_form, digitised};
use crate::throw::Throw;

const FRICTION: f64 = 0.4;
const RESTITUTION: f64 = 0.5;
const SPEED: f64 = 0.2;
const RADIUS: f64 = 0.1;
const SECANT: &str = "tangential.mindlin = { form = \"secant\", damping = 0 }";

const AUTHORS: &str = include_str!("../../../../studies/chung-ooi-2011/test-6.csv");

/// Surface speed [m/s] at s = (7/2) mu (1 + e) v_n / v_s.
fn surface_speed(s: f64) -> f64 {
    3.5 * FRICTION * (1.0 + RESTITUTION) * SPEED / s
}

/// Test 6: -v_s'/v_s at a given s, against a rigid plane.
fn against_plane(m: &Material, s: f64, law: &str, perturbation: f64) -> Result<f64, String> {
    let throw = Throw {
        radius: RADIUS,
        restitution: RESTITUTION,
        friction: FRICTION,
        velocity: [0.0, SPEED],
        spin: surface_speed(s) / RADIUS,
        law,
        steps: 500.0,
        ..m.throw()
    };
    let seen = throw.go(perturbation)?;
    Ok((seen.velocity[0] - seen.spin * RADIUS) / surface_speed(s))
}

/// Two spheres that meet along x with relative speed `SPEED`: the rig.
fn pair(m: &Material, large: bool, spins: [f64; 2], law: &str, perturbation: f64) -> Result<Rig, String> {
    let (times, other, speeds) =
        if large { (1000.0, 0.5, [SPEED, 0.0]) } else { (1.0, RADIUS, [0.5 * SPEED, -0.5 * SPEED]) };
    let text = format!(
        r#"
        title = "two spinning spheres"
        gravity = 0
        duration = 2
        speed-scale = {SPEED}
        [materials.small]
        young-modulus = {young:e}
        poisson-ratio = {poisson}
        density = {density:e}
        restitution = {RESTITUTION}
        friction = {FRICTION}
        [materials.large]
        young-modulus = {stiff:e}
        poisson-ratio = {poisson}
        density = {dense:e}
        restitution = {RESTITUTION}
        friction = {FRICTION}
        [particles.a]
        material = "small"
        diameter = {d0:e}
        start.at = {{ position = [[{x0:e}, 0]], velocity = [[{v0:e}, 0]], spin = [{w0:e}] }}
        [particles.b]
        material = "large"
        diameter = {d1:e}
        start.at = {{ position = [[{x1:e}, 0]], velocity = [[{v1:e}, 0]], spin = [{w1:e}] }}
        [contact]
        {law}
        [dem]
        steps-per-contact = 500
        "#,
        young = m.young,
        poisson = m.poisson,
        density = m.density,
        stiff = times * m.young,
        dense = times * m.density,
        d0 = 2.0 * RADIUS,
        d1 = 2.0 * other,
        x0 = -RADIUS - 1e-5,
        x1 = other,
        v0 = speeds[0],
        v1 = speeds[1],
        w0 = spins[0],
        w1 = spins[1],
    );
    let mut rig = Rig::new(&text, perturbation)?;
    rig.impact()?;
    Ok(rig)
}

/// Test 8: -v_s'/v_s against a sphere five times as large, a thousand times as stiff and dense, at rest.
fn against_large(m: &Material, s: f64, law: &str, perturbation: f64) -> Result<f64, String> {
    let speed = surface_speed(s);
    let rig = pair(m, true, [speed / RADIUS, 0.0], law, perturbation)?;
    // Surface velocity of the small one at the contact, along z, relative to the large one.
    let (v, w) = (rig.vectors("velocity"), rig.vectors("spin"));
    let surface = (v[0].z - w[0].y * RADIUS) - (v[1].z + w[1].y * 0.5);
    Ok(surface / speed)
}

/// V-12 and V-14, tests 6 and 8: gross sliding gives s - 1; above, both are one curve.
pub(crate) fn spinning(perturbation: f64) -> Judged {
    let nylon = material("nylon", 2.5e9, 0.4, 1000.0);
    let source = closed_form("Coulomb, gross sliding: s - 1");
    let mut claims = Vec::new();
    for m in [&ALLOY, &nylon] {
        for s in [0.176, 0.352, 0.551, 0.771] {
            // With its dashpot the contact slides from the first moment on; a spring alone sticks first.
            let name = format!("test 6, {}, s = {s}: tangential rebound", m.name);
            claims.push(near(name, against_plane(m, s, "", perturbation)?, s - 1.0, 2e-3, source));
            let name = format!("test 8, {}, s = {s}: tangential rebound", m.name);
            claims.push(near(name, against_large(m, s, "", perturbation)?, s - 1.0, 2e-3, source));
        }
    }
    for [s, beta] in table::<2>(AUTHORS).into_iter().filter(|row| row[0] < 1.0) {
        let name = format!("test 6, {}, s = {s}, secant: tangential rebound", ALLOY.name);
        let source = digitised("Chung and Ooi 2011, figure of test 6, 3 % of its height");
        claims.push(within(name, against_plane(&ALLOY, s, SECANT, perturbation)?, beta, 0.03, source));
    }
    for s in [1.454, 2.996, 7.819] {
        let plane = against_plane(&ALLOY, s, SECANT, perturbation)?;
        let gate = |perturbation: f64| {
            let large = against_large(&ALLOY, s, SECANT, perturbation)?;
            let name = format!("tests 8 and 6, {}, s = {s}: difference of their rebounds", ALLOY.name);
            Ok::<_, String>(within(name, large - plane, 0.0, 2e-3, closed_form("one curve for both tests")))
        };
        claims.push(gate(perturbation)?);
        let what = format!("friction and restitution 5 % too small in one of the tests, s = {s}");
        claims.push(refused(&what, &[gate(0.95 * perturbation)?], 1));
    }
    Ok(claims)
}

/// V-13, test 7: spins that do not slip are left alone, to 1e-10.
pub(crate) fn no_slip(perturbation: f64) -> Judged {
    let mut claims = Vec::new();
    for spin in [0.175, 1.0, 5.0, 22.86] {
        // The constants of the law do not matter here: the perturbation spoils one spin.
        let rig = pair(&ALLOY, false, [spin, -spin * perturbation], "", 1.0)?;
        let (v, w) = (rig.vectors("velocity"), rig.vectors("spin"));
        let source = closed_form("symmetry; Chung and Ooi 2011, test 7");
        let name = |what: &str| format!("test 7, {spin} rad/s: {what}");
        claims.push(within(name("tangential velocity m/s"), v[0].z, 0.0, 1e-10, source));
        claims.push(within(name("change of spin rad/s"), w[0].y - spin, 0.0, 1e-10, source));
    }
    Ok(claims)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::format_push_string, reason = "a test that prints")]
mod tests {
    use super::*;

    /// The table of the study's README: `cargo test -p tsubu-verify chung_ooi -- --ignored --nocapture`.
    #[test]
    #[ignore = "prints tables for the study's README"]
    fn tables() {
        for [s, beta] in table::<2>(AUTHORS) {
            let mut line = format!("| {s} | {beta} |");
            for law in [SECANT, "tangential.mindlin = { damping = 0 }", ""] {
                line += &format!(
                    " {:.3} / {:.3} |",
                    against_plane(&ALLOY, s, law, 1.0).unwrap(),
                    against_large(&ALLOY, s, law, 1.0).unwrap()
                );
            }
            println!("{line}");
        }
    }
}
