//! The surface.

use super::{GRAIN, after, grain};

const WOOD: [&str; 3] = ["materials.quartz.density=500", "water.float=true", "water.surface=0.01"];

/// A sphere half as heavy as water comes to rest with half of its volume under water: its centre in the surface. One of
/// 5/32 of the density, the share of a cap half a radius high, has its centre half a radius above it. Books close through the surface.
#[test]
fn wood_floats_at_its_depth() {
    let (engine, _, missing) = after(GRAIN, &WOOD, 5.0);
    assert!(missing < 1e-3, "{missing:e}");
    let (p, v) = grain(&*engine);
    assert!((p.z - 0.01).abs() < 1e-6 && v.z.abs() < 1e-4, "{p} {v}");
    let light = "materials.quartz.density=156.25";
    let (engine, ..) = after(GRAIN, &[&WOOD[1..], &[light]].concat(), 5.0);
    let (p, _) = grain(&*engine);
    assert!((p.z - 0.0105).abs() < 1e-5, "{p}");
}
