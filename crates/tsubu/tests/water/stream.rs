//! Streams.

use super::{GRAIN, after, grain};
use crate::dem::{self, open_text};
use tsubu::ledger::Account;
use tsubu_frame::{Frame, Kind};

/// A grain as heavy as water goes along with the log law, U = U* (8.5 + 5.75 log10(Z/k)), wherever it is; with natural
/// logarithms instead the same gate fails.
#[test]
fn a_grain_as_heavy_as_water_goes_along() {
    for (z, speed) in
        [(1e-3, 0.1 * (8.5 + 5.75 * 0.5f64.log10())), (4e-3, 0.1 * (8.5 + 5.75 * 2f64.log10())), (0.0, 0.0)]
    {
        let place = format!("particles.grain.start.at.position=[[0,0,{z}]]");
        let changes = [place.as_str(), "gravity=0", "water.flow.log-law={shear-velocity=0.1,roughness=2e-3}"];
        let (engine, ledger, missing) = after(GRAIN, &changes, 4.0);
        let (_, v) = grain(&*engine);
        assert!((v.x - speed).abs() < 2e-4 * speed.max(1.0), "{z}: {} instead of {speed}", v.x);
        assert!(missing < 1e-6, "{missing:e}");
        if z > 2e-3 {
            assert!((v.x - 0.1 * (8.5 + 5.75 * 2f64.ln())).abs() > 0.1);
            // The stream's work is what the grain and its added mass have, and what drag has lost.
            assert!(ledger.flow(Account::StreamWork) > ledger.flow(Account::Drag));
        }
    }
}

/// The depth on a slope, and the discharge, tell the shear velocity: sqrt(g h sin) = 0.0989 m/s for 2 cm on 1 in 20; with the
/// discharge that the log law then carries the same comes back.
#[test]
fn depth_or_discharge_tell_the_shear_velocity() {
    let speed = |changes: &[&str]| {
        let place = ["particles.grain.start.at.position=[[0,0,0.004]]", "water.density=2650", "water.float=true"];
        let (engine, ..) = after(GRAIN, &[&place, changes].concat(), 6.0);
        grain(&*engine).1.x
    };
    let slope = format!("slope={}", 0.05f64.atan());
    let deep = speed(&[slope.as_str(), "water.flow.log-law={depth=0.02,roughness=2e-3}"]);
    let shear = (9.8 * 0.05f64.atan().sin() * 0.02).sqrt();
    let wanted = shear * (8.5 + 5.75 * 2f64.log10());
    assert!((deep / wanted - 1.0).abs() < 1e-3, "{deep} {wanted}");
    // The mean of the log law over 10 roughnesses, by the midpoint rule.
    let n = 100_000;
    let law = |k: u32| (8.5 + 5.75 * ((f64::from(k) + 0.5) / f64::from(n) * 10.0).log10()).max(0.0);
    let mean = (0..n).map(law).sum::<f64>() / f64::from(n);
    let discharge = shear * mean * 0.02;
    let told = format!("water.flow.log-law={{discharge={discharge},depth=0.02,roughness=2e-3}}");
    let carried = speed(&["gravity=9.8", told.as_str()]);
    assert!((carried / wanted - 1.0).abs() < 1e-3, "{carried} {wanted}");
}

/// A profile from a table is followed between its points and stays constant outside.
#[test]
fn a_table_is_followed() {
    let speed = |z: f64| {
        let place = format!("particles.grain.start.at.position=[[0,0,{z}]]");
        let table = "water.flow.table={height=[0,0.01,0.03],velocity=[0.1,0.3,0.2]}";
        let (engine, ..) = after(GRAIN, &[place.as_str(), "gravity=0", table], 6.0);
        grain(&*engine).1.x
    };
    for (z, wanted) in [(-1.0, 0.1), (0.005, 0.2), (0.02, 0.25), (1.0, 0.2)] {
        assert!((speed(z) - wanted).abs() < 1e-3, "{z}: {}", speed(z));
    }
}

/// The leaping grain of the shipped scene: books of energy to 1e-3 and of momentum to round-off, and the same bits after a
/// resume in the middle of the run.
#[test]
fn a_leaping_grain_keeps_its_books_and_bits() {
    let text = tsubu_scene::TEMPLATES.iter().find(|t| t.name == "saltation").unwrap().text;
    let half = (0.5 / open_text(text, &[]).0.time_step()) as u64;
    let end = |resume: bool| {
        let (hash, ()) = dem::hash(
            || open_text(text, &[]),
            [half, half],
            1,
            resume,
            |engine, hosts, ledger| {
                let missing = dem::missing(engine, hosts, ledger);
                assert!(missing < 1e-3, "{missing:e}");
                for missing in ledger.momentum_residual(engine.momentum()) {
                    assert!(missing.abs() < 1e-11 * ledger.gravity_impulse[2].abs(), "{missing:e}");
                }
            },
        );
        hash
    };
    assert_eq!(end(false), end(true));
}

/// A frame tells what a picture shows of the water: its surface as an endless plane with the number -1, the way it goes, and
/// gravity. Water without a surface that stands still has neither; nothing is pulled where gravity is 0.
#[test]
fn a_frame_tells_surface_flow_and_gravity() {
    let frame = |changes: &[&str]| {
        let (engine, hosts, _) = open_text(GRAIN, changes);
        engine.frame(&hosts)
    };
    let told = |frame: &Frame, name: &str| frame.vectors(Kind::Global, name).first().copied();
    let heights = |frame: &Frame| -> Vec<f64> {
        let corners = frame.vectors(Kind::Surface, "position").iter().zip(frame.integers(Kind::Surface, "wall"));
        corners.filter(|(_, wall)| **wall == -1).map(|(corner, _)| corner[2]).collect()
    };
    let stream = frame(&["slope=0.05", "water.surface=0.02", "water.flow.log-law={shear-velocity=0.1,roughness=2e-3}"]);
    let heights_of_stream = heights(&stream);
    assert!(!heights_of_stream.is_empty() && heights_of_stream.iter().all(|z| *z == 0.02), "{heights_of_stream:?}");
    assert_eq!(told(&stream, "flow"), Some([1.0, 0.0, 0.0]));
    let [x, y, z] = told(&stream, "gravity").unwrap();
    assert!(x > 0.0 && y == 0.0 && (x / -z - 0.05f64.tan()).abs() < 1e-12, "{x} {y} {z}");
    let still = frame(&["gravity=0"]);
    assert_eq!((told(&still, "flow"), told(&still, "gravity"), heights(&still).len()), (None, None, 0));
    let upwards = frame(&["water.flow.column={bottom=-0.01,top=0.01,area=1e-4,velocity=0.1}", "water.added-mass=0"]);
    assert_eq!(told(&upwards, "flow"), Some([0.0, 0.0, 1.0]));
}
