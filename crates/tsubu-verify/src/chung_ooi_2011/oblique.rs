//! Tests 4 and 5: oblique impacts.

use super::{ALLOY, Material, OXIDE, material};
use crate::bench::{near, within};
use crate::case::Judged;
use crate::origin::{closed_form, digitised};
use crate::throw::Throw;

const SECANT: &str = "tangential.mindlin = { form = \"secant\", damping = 0 }";
const AUTHORS: &str = include_str!("../../../../studies/chung-ooi-2011/test-4.csv");

/// Rows of numbers of a small table with comments and a header.
pub(super) fn table<const N: usize>(text: &str) -> Vec<[f64; N]> {
    let rows = text.lines().filter(|l| !l.starts_with('#')).skip(1);
    rows.filter_map(|l| {
        let numbers: Vec<f64> = l.split(',').filter_map(|x| x.trim().parse().ok()).collect();
        numbers.try_into().ok()
    })
    .collect()
}

/// Tangential restitution of the centre, and spin [rad/s] in the paper's sign.
fn hit(m: &Material, angle: f64, law: &str, perturbation: f64) -> Result<(f64, f64), String> {
    let (along, down) = angle.to_radians().sin_cos();
    let throw = Throw {
        restitution: 0.98,
        friction: 0.092,
        velocity: [3.9 * along, 3.9 * down],
        law,
        steps: 500.0,
        ..m.throw()
    };
    let seen = throw.go(perturbation)?;
    Ok((seen.velocity[0] / (3.9 * along), -seen.spin))
}

/// V-10, test 4: exact where the contact slides all the time (from 30 degrees), the authors' curve below 20.
pub(crate) fn kharaz(perturbation: f64) -> Judged {
    let mut claims = on_curve("test 4", SECANT, perturbation)?;
    let source = closed_form("Coulomb, gross sliding");
    for [angle, ..] in table::<5>(AUTHORS).into_iter().filter(|row| row[0] >= 30.0) {
        for m in [&OXIDE, &ALLOY] {
            let (et, spin) = hit(m, angle, SECANT, perturbation)?;
            let name = format!("test 4, {} at {angle} degrees", m.name);
            let (along, normal) = angle.to_radians().sin_cos();
            let closed = 1.0 - 0.092 * 1.98 * normal / along;
            claims.push(near(format!("{name}: tangential restitution"), et, closed, 2e-3, source));
            let closed = -2.5 * 0.092 * 1.98 * 3.9 * normal / 2.5e-3;
            claims.push(near(format!("{name}: spin rad/s"), spin, closed, 2e-3, source));
        }
    }
    Ok(claims)
}

/// V-10, test 4 by the default law: Mindlin's increments, which make no energy on unloading, and a dashpot.
pub(crate) fn kharaz_default(perturbation: f64) -> Judged {
    on_curve("test 4, default law", "", perturbation)
}

/// The authors' curve below 30 degrees, where the contact sticks for a while and laws part.
fn on_curve(test: &str, law: &str, perturbation: f64) -> Judged {
    let source = digitised(
        "Chung and Ooi 2011, figures of test 4: 3 % of the restitution, and of the largest spin for spins, which pass zero",
    );
    let fullest = 618.0;
    let mut claims = Vec::new();
    for [angle, et_oxide, spin_oxide, et_alloy, spin_alloy] in
        table::<5>(AUTHORS).into_iter().filter(|row| row[0] < 30.0)
    {
        for (m, et, spin) in [(&OXIDE, et_oxide, spin_oxide), (&ALLOY, et_alloy, spin_alloy)] {
            let (found_et, found_spin) = hit(m, angle, law, perturbation)?;
            let name = format!("{test}, {} at {angle} degrees", m.name);
            claims.push(near(format!("{name}: tangential restitution"), found_et, et, 0.03, source));
            claims.push(within(format!("{name}: spin rad/s"), found_spin, spin, 0.03 * fullest, source));
        }
    }
    Ok(claims)
}

/// V-11, test 5: contact velocity and spin where the contact slides all the time.
pub(crate) fn gross_sliding(perturbation: f64) -> Judged {
    let steel = material("steel", 208e9, 0.3, 7850.0);
    let polyethylene = material("polyethylene", 1e9, 0.4, 1400.0);
    let mut claims = Vec::new();
    for m in [&steel, &polyethylene] {
        for (form, law) in [("default law", ""), ("secant", SECANT)] {
            for x in [6.5, 7.5, 10.0, 13.0] {
                let (y1, y2) = test_5(m, x, law, perturbation)?;
                let source = closed_form(
                    "Coulomb, gross sliding with the contact at half the overlap; begins as in Maw, Barber, Fawcett 1976",
                );
                let name = format!("test 5, {}, {form}, x = {x}", m.name);
                let spin = -5.0 * (1.0 - shortening(m));
                claims.push(within(format!("{name}: contact velocity after"), y1, x - 2.0 + spin, 0.01, source));
                claims.push(near(format!("{name}: spin after"), y2, spin, 2e-3, source));
            }
        }
    }
    Ok(claims)
}

/// How much shorter than the radius the arm of the friction is, in the mean over an elastic impact of test 5: the contact
/// lies in the middle of the overlap, whose mean under the weight of the force is 0.81757 of the largest. The books say 0:
/// their bodies are rigid. At 5 m/s it is 0.3 % for steel and 1 % for polyethylene.
fn shortening(m: &Material) -> f64 {
    let young = m.young / (1.0 - m.poisson * m.poisson);
    let largest = (1.25 * std::f64::consts::PI * m.density * 25.0 / young).powf(0.4);
    0.5 * 0.817_57 * largest
}

/// Dimensionless velocity of the contact and spin after an elastic impact at x = v_t / (mu v_n).
fn test_5(m: &Material, x: f64, law: &str, perturbation: f64) -> Result<(f64, f64), String> {
    let (friction, down, radius) = (0.3, 5.0, 1e-5);
    let throw = Throw { radius, friction, velocity: [x * friction * down, down], law, steps: 500.0, ..m.throw() };
    let seen = throw.go(perturbation)?;
    let scale = friction * down;
    Ok(((seen.velocity[0] - seen.spin * radius) / scale, -seen.spin * radius / scale))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::format_push_string, reason = "a test that prints")]
mod tests {
    use super::*;

    /// The tables of the study's README: `cargo test -p tsubu-verify chung_ooi -- --ignored --nocapture`.
    #[test]
    #[ignore = "prints tables for the study's README"]
    fn tables() {
        for [angle, et, spin, ..] in table::<5>(AUTHORS) {
            let mut line = format!("| {angle} | {et} / {spin} |");
            for law in [SECANT, "tangential.mindlin = { damping = 0 }", "", "tangential.mindlin.form = \"secant\""] {
                let (e, w) = hit(&OXIDE, angle, law, 1.0).unwrap();
                line += &format!(" {e:.4} / {w:.1} |");
            }
            println!("{line}");
        }
        let steel = material("steel", 208e9, 0.3, 7850.0);
        for x in [0.27, 0.332, 0.88, 1.009, 1.92, 2.0, 2.79, 2.99, 3.97, 4.0, 4.76, 5.0, 5.76, 6.0, 9.12] {
            let mut line = format!("| {x} |");
            for law in [SECANT, "tangential.mindlin = { damping = 0 }"] {
                let (y1, y2) = test_5(&steel, x, law, 1.0).unwrap();
                line += &format!(" {y1:.3} / {y2:.3} |");
            }
            println!("{line}");
        }
    }
}
