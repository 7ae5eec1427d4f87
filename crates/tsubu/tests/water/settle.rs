//! The begin of a fall. Terminal speeds are the verification case `settling`.

use super::{GRAIN, after, grain};

/// Density of quartz over that of water, and gravity [m/s^2].
const S: f64 = 2.65;
const G: f64 = 9.8;

/// A sphere let go in still water begins with (s-1) g/(s + 1/2) = 5.13 m/s^2 (Batchelor 1967, section 6.8): after a time t that
/// is short for drag, v = a t. Without added mass it would be (s-1) g/s = 6.10.
#[test]
fn a_sphere_let_go_takes_water_along() {
    let begin = |changes: &[&str]| {
        let (engine, ledger, missing) = after(GRAIN, changes, 1e-3);
        assert!(missing < 1e-6, "{missing:e}");
        for missing in ledger.momentum_residual(engine.momentum()) {
            assert!(missing.abs() < 1e-12 * ledger.gravity_impulse[2].abs(), "{missing:e}");
        }
        -grain(&*engine).1.z / engine.time()
    };
    let wanted = (S - 1.0) * G / (S + 0.5);
    assert!((wanted - 5.13).abs() < 0.005);
    let still = ["water.drag={none={}}"];
    assert!((begin(&still) / wanted - 1.0).abs() < 1e-9, "{}", begin(&still));
    let bare = begin(&["water.drag={none={}}", "water.added-mass=0"]);
    assert!((bare / ((S - 1.0) * G / S) - 1.0).abs() < 1e-9, "{bare}");
    assert!((bare / wanted - 1.0).abs() > 0.1);
}
