//! How densely ellipsoids lie that rub against nothing.

use super::bench::{Rig, vectors};
use super::control::refused;
use super::ensemble;
use crate::case::Judged;
use crate::origin::remembered;
use glam::{DMat3, DQuat, DVec3};
use std::f64::consts::PI;
use tsubu_frame::{Claim, Ensemble, Kind, Values};

/// Half the width of the bed, which goes on at its sides [m].
const HALF: f64 = 15e-3;

/// Diameter of the sphere with the volume of a body [m].
const SAME: f64 = 4e-3;

const SPHERE: [f64; 3] = [1.0; 3];

/// 500 bodies fall onto a plane; after half a second they lie.
fn scene(semi_axes: [f64; 3], friction: f64, seed: u64) -> String {
    let longest = semi_axes.into_iter().fold(0.0, f64::max);
    let diameter = SAME * longest / semi_axes.iter().product::<f64>().cbrt();
    format!(
        r#"
        dimension = 3
        duration = 1
        seed = {seed}
        [materials.smooth]
        density = 2500
        young-modulus = 5e7
        poisson-ratio = 0.3
        restitution = 0.3
        friction = {friction}
        [particles.seeds]
        material = "smooth"
        count = 500
        diameter = {diameter}
        shape.superellipsoid.semi-axes = {semi_axes:?}
        start.random.region = {{ low = [-{HALF}, -{HALF}, 0.003], high = [{HALF}, {HALF}, 0.25] }}
        [walls.floor]
        material = "smooth"
        shape.plane = {{ point = [0, 0, 0], normal = [0, 0, 1] }}
        [periodic]
        x = [-{HALF}, {HALF}]
        y = [-{HALF}, {HALF}]
        "#
    )
}

/// Share of a body below a height, its centre at 0 and its reach at 1: that of a sphere, for planes cut an ellipsoid as they cut the sphere it is
/// stretched from.
fn below(height: f64) -> f64 {
    let t = height.clamp(-1.0, 1.0);
    (2.0 + 3.0 * t - t.powi(3)) / 4.0
}

/// Share of the volume that the bodies fill between two and five [`SAME`] above the floor, exactly.
fn filled(semi_axes: [f64; 3], friction: f64, seed: u64) -> Result<[f64; 1], String> {
    let mut rig = Rig::new(&scene(semi_axes, friction, seed), 1.0)?;
    rig.until(0.46)?;
    let frame = rig.frame();
    let (centres, axes) = (vectors(&frame, Kind::Grain, "position"), vectors(&frame, Kind::Grain, "semi-axes"));
    let Some(Values::Quaternion(turned)) = frame.column(Kind::Grain, "orientation").map(|column| &column.values) else {
        return Err("no orientations".to_owned());
    };
    let [low, high] = [2.0 * SAME, 5.0 * SAME];
    let volume = |((centre, axes), [w, x, y, z]): ((&DVec3, &DVec3), &[f64; 4])| {
        let up = DMat3::from_quat(DQuat::from_xyzw(*x, *y, *z, *w)).transpose() * DVec3::Z;
        let reach = (*axes * up).length();
        let part = below((high - centre.z) / reach) - below((low - centre.z) / reach);
        part * 4.0 / 3.0 * PI * axes.element_product()
    };
    let sum: f64 = centres.iter().zip(&axes).zip(turned).map(volume).sum();
    Ok([sum / (4.0 * HALF * HALF * (high - low))])
}

/// Five beds.
fn beds(semi_axes: [f64; 3], friction: f64) -> Result<Ensemble, String> {
    let of = format!("{semi_axes:?}, friction {friction}");
    let [filled] = ensemble::members(&of, 1..=5, |seed| filled(semi_axes, friction, seed))?;
    Ok(filled)
}

/// What is claimed of bodies with these semi-axes.
fn gate(semi_axes: [f64; 3], friction: f64) -> Result<Claim, String> {
    let name = format!("share of the volume that is filled: {semi_axes:?}");
    let (low, high, source) = if semi_axes == SPHERE {
        (0.62, 0.66, "0.64, random close packing of spheres")
    } else {
        (0.70, 0.74, "figure 2: 0.70 to 0.74 about the densest")
    };
    let source = format!("Donev and others 2004 (Science 303, 990), {source}");
    Ok(Claim::judge_ensemble(name, beds(semi_axes, friction)?, Some(low), Some(high), remembered(&source)))
}

/// Frictionless ellipsoids lie denser than spheres.
pub(super) fn ellipsoids(_: f64) -> Judged {
    let all = |friction: f64| [SPHERE, [1.5, 1.0, 1.0], [1.25, 1.0, 0.8]].map(|axes| gate(axes, friction));
    let mut claims = all(0.0).into_iter().collect::<Result<Vec<_>, _>>()?;
    let rough = all(1.0).into_iter().collect::<Result<Vec<_>, _>>()?;
    claims.push(refused("bodies that rub", &rough, 3));
    Ok(claims)
}
