//! Steps that are longer than drag needs.

use super::{GRAIN, after};
use std::f64::consts::PI;
use std::path::Path;
use tsubu::methods;
use tsubu::partner::Hosts;
use tsubu_scene::Scene;

/// Drag of Stokes alone: the relaxation time of 2 mm of quartz is the same at all speeds [s].
const SLOW: [&str; 3] = ["gravity=9.8", "water.drag={stokes-newton={coefficient=0}}", "speed-scale='1 mm/s'"];
const MOVED: f64 = (2650.0 + 500.0) * 4.0 / 3.0 * PI * 1e-9;
const RELAXATION: f64 = MOVED / (6.0 * PI * 1e-3 * 1e-3);

fn opened(step: f64) -> Result<(), String> {
    let changes: Vec<String> = SLOW.iter().map(|c| (*c).to_owned()).chain([format!("dem.time-step={step}")]).collect();
    let scene = Scene::parse("test", GRAIN, Path::new("."), &changes).unwrap_or_else(|c| panic!("{c}"));
    methods::open(scene.plan(), &Hosts::new(&scene.plan().hosts)).map(|_| ()).map_err(|e| e.to_string())
}

/// Just below the relaxation time a grain that is let go still comes to its terminal speed; above it the scene is refused, and the message says which key, which group and which step would do.
#[test]
fn a_step_longer_than_the_relaxation_is_refused() {
    assert!(opened(0.98 * RELAXATION).is_ok());
    let refused = opened(1.02 * RELAXATION).unwrap_err();
    for told in ["dem.time-step", "`grain`", &format!("{:.2e} s or less", 0.1 * RELAXATION)] {
        assert!(refused.contains(told), "{told}: {refused}");
    }
    let terminal = 1650.0 / 3150.0 * 9.8 * RELAXATION;
    // Share of the terminal speed that it has after some steps.
    let speed = |share: f64, steps: f64| {
        let step = format!("dem.time-step={}", share * RELAXATION);
        let (engine, ..) = after(GRAIN, &[&SLOW[..], &[&step]].concat(), steps * share * RELAXATION);
        -super::grain(&*engine).1.z / terminal
    };
    let later = speed(0.98, 400.0);
    assert!((later - 1.0).abs() < 0.01, "{later}");
    // A tenth of it is followed.
    let followed = speed(0.1, 10.0);
    assert!((followed / (1.0 - (-1f64).exp()) - 1.0).abs() < 0.01, "{followed}");
}
