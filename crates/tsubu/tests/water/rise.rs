//! Buoyancy on a slope.

use super::{GRAIN, after, grain};

/// On a slope the pressure and the shear stress of a uniform stream carry (sigma - rho) V g of the weight off in both directions;
/// the pressure alone leaves all of it along the slope. Without drag and added mass: a = (s-1)/s g sin, or g sin.
#[test]
fn the_slope_pulls_less_in_a_stream() {
    let pull = |buoyancy: &str| {
        let changes = ["slope=0.1", "water.drag={none={}}", "water.added-mass=0", buoyancy];
        let (engine, _, missing) = after(GRAIN, &changes, 1e-3);
        assert!(missing < 1e-6, "{missing:e}");
        grain(&*engine).1 / engine.time()
    };
    let (sin, cos) = 0.1f64.sin_cos();
    let (all, pressure) = (pull("water.buoyancy='vertical'"), pull("water.buoyancy='normal'"));
    assert!((all.x - 1.65 / 2.65 * 9.8 * sin).abs() < 1e-9 && (all.z + 1.65 / 2.65 * 9.8 * cos).abs() < 1e-9, "{all}");
    assert!((pressure.x - 9.8 * sin).abs() < 1e-9 && (pressure.z - all.z).abs() < 1e-9, "{pressure}");
}
