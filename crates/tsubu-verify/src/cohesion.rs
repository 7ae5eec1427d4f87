//! Pull-off forces (V-08).

use super::bench::{Rig, near, vectors, within};
use crate::case::Judged;
use crate::origin::closed_form;
use std::f64::consts::PI;
use tsubu_frame::{Kind, Values};

const RADIUS: f64 = 1e-3;
const GAMMA: f64 = 0.05;

const YOUNG: f64 = 1e8;

/// A heavy sphere on a floor that does not stick; from above another sphere, or a plane, comes down on it and is drawn off,
/// slowly.
fn scene(law: &str, plane: bool) -> String {
    let reduced = if plane { RADIUS } else { 0.5 * RADIUS };
    // Three times what can be lifted, pressed into the floor as Hertz says.
    let weight = 3.0 * 4.0 * PI * GAMMA * reduced;
    let depth = (weight / (4.0 / 3.0 * YOUNG / 0.91 * RADIUS.sqrt())).powf(2.0 / 3.0);
    let (height, gap) = (RADIUS - depth, 2e-7);
    let top = height + RADIUS + gap;
    let motion = "direction = [0, 1], signal.sine = { amplitude = 1.5e-6, frequency = 0.3, phase = 3.141592653589793 }";
    let above = if plane {
        format!(
            "[walls.b-lid]\nmaterial = \"sticky\"\nmotion = {{ {motion} }}\nshape.plane = {{ point = [0, {top:e}], normal = [0, -1] }}"
        )
    } else {
        format!(
            "[particles.b-drawn]\nmaterial = \"sticky\"\ndiameter = \"2 mm\"\nmass = 1\nmotion.driven = {{ {motion} }}\nstart.at.position = [[0, {:e}]]",
            top + RADIUS
        )
    };
    format!(
        r#"
        title = "adhesion: a body drawn off a sphere"
        duration = 4
        speed-scale = 0.1
        [materials.sticky]
        young-modulus = {YOUNG:e}
        restitution = 0.1
        surface-energy = {GAMMA}
        [materials.floor]
        young-modulus = 1e14
        restitution = 0.1
        surface-energy = 0
        [particles.a-heavy]
        material = "sticky"
        diameter = "2 mm"
        mass = {mass:e}
        start.at.position = [[0, {height:e}]]
        [walls.a-floor]
        material = "floor"
        shape.plane = {{}}
        {above}
        [contact]
        cohesion.{law} = {{}}
        "#,
        mass = weight / 9.8,
    )
}

/// Largest force [N] with which the sphere is lifted, and the residual of the books over the most that contacts store: what
/// is turned over in a slow cycle is next to nothing.
fn lift(law: &str, plane: bool, perturbation: f64) -> Result<(f64, f64), String> {
    let mut rig = Rig::new(&scene(law, plane), perturbation)?;
    let (mut most, mut stored) = (0.0f64, 0.0f64);
    let before = rig.engine.grain_energies().elastic;
    while rig.engine.time() < 3.0 {
        rig.steps(1)?;
        stored = stored.max((rig.engine.grain_energies().elastic - before).abs());
        let frame = rig.frame();
        let forces = vectors(&frame, Kind::Contact, "force");
        let (Some(Values::Integer(first)), Some(Values::Integer(second))) = (
            frame.column(Kind::Contact, "first").map(|c| &c.values),
            frame.column(Kind::Contact, "second").map(|c| &c.values),
        ) else {
            return Err("a frame without contacts".to_owned());
        };
        for ((force, first), second) in forces.iter().zip(first).zip(second) {
            // Walls are numbered in the order of their names: the floor is -1, the lid -2.
            if *second == -1 {
                continue;
            }
            let upwards = if *first == 0 { force.z } else { -force.z };
            most = most.max(upwards);
        }
    }
    Ok((most, rig.unexplained() / stored))
}

/// V-08: DMT parts at 4 pi gamma R*, JKR at 3 pi gamma R*, gamma the energy of one face.
pub(super) fn pull_off(perturbation: f64) -> Judged {
    let mut claims = Vec::new();
    for (law, factor) in [("dmt", 4.0), ("jkr", 3.0)] {
        for (other, plane, reduced) in [("sphere", false, 0.5 * RADIUS), ("plane", true, RADIUS)] {
            let (force, residual) = lift(law, plane, perturbation)?;
            let closed = factor * PI * GAMMA * reduced;
            let source = closed_form("Derjaguin, Muller, Toporov 1975; Johnson, Kendall, Roberts 1971");
            claims.push(near(format!("pull-off by {law}, sphere and {other} N"), force, closed, 2e-3, source));
            let name = format!("pull-off by {law}, sphere and {other}: energy residual at the default step");
            claims.push(within(name, residual, 0.0, 1e-3, closed_form("conservation of energy")));
        }
    }
    Ok(claims)
}
