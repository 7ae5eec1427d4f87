//! A row of grains that are pushed and cannot climb over one another (figure 22).

use super::super::bench::within;
use super::super::control::refused;
use super::rig;
use crate::case::Judged;
use crate::origin::{closed_form, own};
use tsubu_frame::Claim;

const SCENE: &str = include_str!("../../../../studies/sediment-2004/rod.toml");
/// Diameter [m].
const DIAMETER: f64 = 2e-3;

/// Whether a row with a zigzag of some degrees still is one after 0.2 s: the middle has not left its neighbours.
fn holds(degrees: f64, rotation: bool, perturbation: f64) -> Result<bool, String> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let d = DIAMETER;
    let changes = [
        format!("contact.rotation={rotation}"),
        format!("particles.row.start.at.position=[[{:e}, 0], [{:e}, {:e}], [0, 0]]", -2.0 * d * cos, -d * cos, d * sin),
    ];
    let mut rig = rig(SCENE, &changes, perturbation)?;
    rig.until(0.2)?;
    let places = rig.vectors("position");
    let rise = places[1].z - 0.5 * (places[0].z + places[2].z);
    Ok(rise < d * sin + 0.1 * d)
}

/// Largest zigzag that holds [degrees], to a tenth.
fn largest(rotation: bool, perturbation: f64) -> Result<f64, String> {
    let (mut low, mut high) = (0.0, 60.0);
    while high - low > 0.1 {
        let middle = 0.5 * (low + high);
        if holds(middle, rotation, perturbation)? { low = middle } else { high = middle }
    }
    Ok(0.5 * (low + high))
}

/// B-F22: locked grains form a rod up to the angle of friction; grains that spin do not.
pub(in super::super) fn rod(perturbation: f64) -> Judged {
    let source =
        closed_form("a wedge between two grains holds up to the angle of friction, 38 degrees (Osada 2004, figure 22)");
    let locked =
        |angle| within("pushed row of three, rotation locked: zigzag that holds, degrees", angle, 38.0, 0.5, source);
    let free = largest(true, perturbation)?;
    let name = "pushed row of three, free rotation: zigzag that holds, degrees";
    Ok(vec![
        locked(largest(false, perturbation)?),
        Claim::judge(name, free, None, Some(1.0), own("grains that spin roll over one another at any angle").after()),
        refused("pushed row, free rotation for locked", &[locked(free)], 1),
    ])
}
