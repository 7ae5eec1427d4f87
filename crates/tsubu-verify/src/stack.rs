//! Two spheres stacked between two planes (V-07).

use super::bench::{Rig, near, within};
use crate::case::Judged;
use crate::origin::closed_form;

const RADIUS: f64 = 5e-3;
const MASS: [f64; 2] = [1e-3, 3e-3];
const STIFFNESS: f64 = 1e5;
/// Overlap of all three contacts at the start [m].
const OVERLAP: f64 = 5e-4 * 2.0 * RADIUS;
/// Such that the sag stays within the overlap: no contact opens.
const GRAVITY: f64 = 20.0;

fn rig(normal: &str, steps: f64, perturbation: f64) -> Result<Rig, String> {
    let [low, high] = [RADIUS - OVERLAP, 3.0 * RADIUS - 2.0 * OVERLAP];
    let text = format!(
        r#"
        title = "two spheres pressed between two planes"
        gravity = {GRAVITY}
        duration = 1
        speed-scale = 0.01
        [materials.hard]
        young-modulus = 1e9
        restitution = 1
        friction = 0.5
        [particles.a-low]
        material = "hard"
        diameter = {diameter}
        mass = {m0}
        start.at.position = [[0, {low:e}]]
        [particles.b-high]
        material = "hard"
        diameter = {diameter}
        mass = {m1}
        start.at.position = [[0, {high:e}]]
        [walls.floor]
        material = "hard"
        shape.plane = {{}}
        [walls.lid]
        material = "hard"
        shape.plane = {{ point = [0, {lid:e}], normal = [0, -1] }}
        [contact]
        {normal}
        damping.none = {{}}
        [dem]
        steps-per-contact = {steps}
        "#,
        diameter = 2.0 * RADIUS,
        lid = 4.0 * RADIUS - 3.0 * OVERLAP,
        m0 = MASS[0],
        m1 = MASS[1],
    );
    Rig::new(&text, perturbation)
}

/// Displacement of both from where they began, under equal linear springs: -(1 - cos(sqrt(A) t)) A^-1 g.
fn closed(t: f64) -> [f64; 2] {
    let [a, b] = MASS.map(|m| STIFFNESS / m);
    // A = [[2a, -a], [-b, 2b]]
    let (mean, half) = (a + b, ((a - b) * (a - b) + a * b).sqrt());
    let determinant = 3.0 * a * b;
    let rest = [-GRAVITY * (2.0 * b + a) / determinant, -GRAVITY * (2.0 * a + b) / determinant];
    let applied = [2.0 * a * rest[0] - a * rest[1], -b * rest[0] + 2.0 * b * rest[1]];
    let mut z = rest;
    for (own, other) in [(mean + half, mean - half), (mean - half, mean + half)] {
        let swing = (own.sqrt() * t).cos() / (own - other);
        for i in 0..2 {
            z[i] -= swing * (applied[i] - other * rest[i]);
        }
    }
    z
}

/// V-07: both move as two masses on three springs, and elastic energy is not lost.
pub(super) fn stacked(perturbation: f64) -> Judged {
    let mut claims = Vec::new();
    let hooke = format!("normal.hooke.stiffness = {STIFFNESS}\ntangential.none = {{}}");
    let mut stack = rig(&hooke, 1000.0, perturbation)?;
    let low = RADIUS - OVERLAP;
    let high = 3.0 * RADIUS - 2.0 * OVERLAP;
    for part in 1..=3 {
        stack.until(0.01 * f64::from(part))?;
        let (z, expected) = (stack.vectors("position"), closed(stack.engine.time()));
        for (name, z, expected) in [("lower", z[0].z - low, expected[0]), ("upper", z[1].z - high, expected[1])] {
            let name = format!("stack, {} ms: displacement of the {name} sphere m", 10 * part);
            claims.push(within(
                name,
                z,
                expected,
                2e-3 * OVERLAP,
                closed_form("closed form: two masses, three springs"),
            ));
        }
    }
    for (name, law) in [("Hooke", hooke.as_str()), ("Hertz", "")] {
        let mut stack = rig(law, 20.0, perturbation)?;
        let start = stack.engine.grain_energies().total();
        let held = stack.engine.grain_energies().elastic;
        let mut worst = 0.0f64;
        for _ in 0..100 {
            stack.steps(400)?;
            worst = worst.max((stack.engine.grain_energies().total() - start).abs());
        }
        // Verlet's energy swings by (w dt)^2/8 of the energy that swings, and does not drift.
        let source = closed_form("conservation of energy");
        let name = format!("stack, {name}: energy error within 40000 default steps over elastic energy");
        claims.push(within(name, worst / held, 0.0, 1e-3, source));
    }
    let held = rig("", 20.0, perturbation)?.engine.grain_energies().elastic;
    claims.push(near(
        "stack: elastic energy at the start over Hertz's",
        held / hertz(),
        1.0,
        1e-6,
        closed_form("Hertz"),
    ));
    Ok(claims)
}

/// Elastic energy of the three contacts at the start [J].
fn hertz() -> f64 {
    let young = 0.5 * 1e9 / (1.0 - 0.3 * 0.3);
    let energy = |radius: f64| 8.0 / 15.0 * young * radius.sqrt() * OVERLAP.powf(2.5);
    2.0 * energy(RADIUS) + energy(0.5 * RADIUS)
}
