//! Lift by spin and by shear.

use super::{GRAIN, after, grain};
use glam::DVec3;
use std::f64::consts::PI;

const BARE: [&str; 3] = ["gravity=0", "water.drag={none={}}", "water.added-mass=0"];
const MASS: f64 = 2650.0 * 4.0 / 3.0 * PI * 1e-9;

/// Velocity after some seconds of a grain that began with `velocity` along x and `spin` about y, and how many they were.
fn flown(velocity: f64, spin: f64, changes: &[&str], seconds: f64) -> (DVec3, f64) {
    let start =
        format!("particles.grain.start.at={{position=[[0,0,0]],velocity=[[{velocity},0,0]],spin=[[0,{spin},0]]}}");
    let (engine, _, missing) = after(GRAIN, &[&BARE[..], &[start.as_str()], changes].concat(), seconds);
    assert!(missing < 1e-5, "{missing:e}");
    (grain(&*engine).1, engine.time())
}

/// Backspin lifts: the path in still water is a circle, upwards, once around in 2 pi/(3/4 rho/sigma w), at the speed of the begin.
/// With the spin turned, or half the force, the gate fails.
#[test]
fn magnus_bends_a_path_into_a_circle() {
    let rate = 0.75 / 2.65 * 900.0;
    let (v, time) = flown(1.0, -900.0, &["water.lift=['magnus']"], 5e-3);
    let angle = v.z.atan2(v.x);
    assert!((angle / (rate * time) - 1.0).abs() < 1e-3, "{angle}");
    assert!((v.length() - 1.0).abs() < 1e-5 && v.y == 0.0, "{v}");
    let (top, _) = flown(1.0, 900.0, &["water.lift=['magnus']"], 5e-3);
    assert!((top.z + v.z).abs() < 1e-12 && v.z > 0.5);
}

/// Upward force [N] at the begin.
fn lift(velocity: f64, spin: f64, changes: &[&str]) -> f64 {
    // So short that neither speed nor direction changes.
    let (v, time) = flown(velocity, spin, changes, 1e-4);
    MASS * v.z / time
}

/// Oesterle and Dinh's lift is that of Rubinow and Keller in slow flow, and ends at a lift coefficient of 0.45, whatever the
/// spin; Rubinow and Keller's would be four times that.
#[test]
fn lift_by_spin_has_both_limits() {
    let of = |word: &str, v, w, nu: f64| {
        lift(v, w, &[format!("water.lift=['{word}']").as_str(), format!("water.viscosity={nu}").as_str()])
    };
    let slow = of("magnus-oesterle-dinh", 0.1, -100.0, 1.0) / of("magnus", 0.1, -100.0, 1.0);
    assert!((slow - 1.0).abs() < 0.01, "{slow}");
    let wanted = 0.45 * 500.0 * PI * 1e-6;
    for spin in [-1000.0, -2000.0] {
        let fast = of("magnus-oesterle-dinh", 1.0, spin, 1e-6);
        assert!((fast / wanted - 1.0).abs() < 0.01, "{fast} {wanted}");
    }
    assert!(of("magnus", 1.0, -1000.0, 1e-6) / wanted > 4.0);
}

/// Where the stream gets faster upwards, a grain that lags is lifted and one that leads is pressed down, by 6.46 mu r^2 v
/// sqrt(G/nu) (Saffman 1968); four times that, with the diameter for the radius, is refused.
#[test]
fn saffman_lifts_what_lags() {
    for (v, shear) in [(-0.01, 10.0f64), (0.01, 10.0), (-0.02, 40.0), (-0.01, -10.0)] {
        let table = format!("water.flow.table={{height=[-1,1],velocity=[{},{shear}]}}", -shear);
        let found = lift(v, 0.0, &[&table, "water.lift=['saffman']"]);
        let wanted = -6.46 * 1e-3 * 1e-6 * v * f64::sqrt(shear.abs() / 1e-6) * f64::signum(shear);
        assert!((found / wanted - 1.0).abs() < 1e-3, "{v} {shear}: {found} {wanted}");
        assert!((found / (4.0 * wanted) - 1.0).abs() > 0.1);
    }
    assert_eq!(lift(1.0, 0.0, &["water.lift=['saffman','magnus']"]), 0.0);
}

/// Mei's lift is Saffman's in slow flow; in fast flow inertia makes it, and the viscosity no longer matters.
#[test]
fn lift_by_shear_has_both_limits() {
    let of = |word: &str, v: f64, shear: f64, nu: f64| {
        let table = format!("water.flow.table={{height=[-1,1],velocity=[{},{shear}]}}", -shear);
        let lift_by = format!("water.lift=['{word}']");
        lift(v, 0.0, &[&table, &lift_by, &format!("water.viscosity={nu}")])
    };
    let slow = of("saffman-mei", -0.001, 1.0, 1e-3) / of("saffman", -0.001, 1.0, 1e-3);
    assert!((slow - 1.0).abs() < 0.01, "{slow}");
    let thin = of("saffman-mei", -0.5, 10.0, 1e-6) / of("saffman-mei", -0.5, 10.0, 2e-6);
    let same = of("saffman", -0.5, 10.0, 1e-6) / of("saffman", -0.5, 10.0, 2e-6);
    assert!((thin - 1.0).abs() < 1e-3 && (same - 0.5f64.sqrt()).abs() < 1e-3, "{thin} {same}");
}
