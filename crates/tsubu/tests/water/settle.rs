//! Terminal speeds and the begin of a fall.

use super::{GRAIN, after, grain};

/// Density of quartz over that of water, and gravity [m/s^2].
const S: f64 = 2.65;
const G: f64 = 9.8;
const NU: f64 = 1e-6;

/// The speed at which C(Re) v^2 = 4/3 (s-1) g d, by fixed-point iteration.
fn terminal(d: f64, coefficient: fn(f64) -> f64) -> f64 {
    let mut v: f64 = 0.1;
    for _ in 0..10_000 {
        v = 0.5 * (v + (4.0 / 3.0 * (S - 1.0) * G * d / coefficient(v * d / NU)).sqrt());
    }
    v
}

fn schiller_naumann(re: f64) -> f64 {
    if re > 1000.0 { 0.44 } else { 24.0 / re * (1.0 + 0.15 * re.powf(0.687)) }
}

fn sunk(law: &str, millimetres: f64) -> f64 {
    let d = millimetres * 1e-3;
    let changes = [format!("particles.grain.diameter={d}"), format!("water.drag={law}")];
    // A hundred times the time in which the fastest of them reaches its speed, but not much longer.
    let seconds = if millimetres < 1.5 { 0.6 } else { 3.0 };
    let (engine, _, missing) = after(GRAIN, &changes.each_ref().map(String::as_str), seconds);
    assert!(missing < 1e-6, "{law} {millimetres}: {missing:e}");
    -grain(&*engine).1.z
}

/// Every drag law by its own terminal speed, 0.1 %: the table of the literature (3 digits) and the fixed point here.
#[test]
fn grains_sink_at_their_terminal_speed() {
    type Law = (&'static str, fn(f64) -> f64, [f64; 6]);
    let laws: [Law; 4] = [
        ("{schiller-naumann={}}", schiller_naumann, [0.0248, 0.0784, 0.1550, 0.2833, 0.4950, 0.7000]),
        ("{stokes-newton={}}", |re| 0.4 + 24.0 / re, [0.0324, 0.1148, 0.2041, 0.3137, 0.5132, 0.7312]),
        ("{stokes-newton={coefficient=2}}", |re| 2.0 + 24.0 / re, [0.0253, 0.0624, 0.0980, 0.1439, 0.2310, 0.3277]),
        ("{abraham={}}", |re| (0.63 + 4.8 / re.sqrt()).powi(2), [0.0228, 0.0728, 0.1422, 0.2452, 0.4490, 0.6745]),
    ];
    for (law, coefficient, table) in laws {
        for (millimetres, published) in [0.2, 0.5, 1.0, 2.0, 5.0, 10.0].into_iter().zip(table) {
            let (found, exact) = (sunk(law, millimetres), terminal(millimetres * 1e-3, coefficient));
            assert!((found / exact - 1.0).abs() < 1e-3, "{law} {millimetres} mm: {found} instead of {exact}");
            assert!(
                (found - published).abs() <= 1.01e-4 + 1e-3 * published,
                "{law} {millimetres} mm: {found}, {published}"
            );
        }
    }
    // The control: with the weight as Osada et al. print it, which has the added mass in it, the gate would fail.
    let literal = (1.0 - 0.5 * 1000.0 / ((S - 1.0) * 1000.0)).abs().sqrt();
    assert!((literal - 1.0).abs() > 0.1);
}

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
