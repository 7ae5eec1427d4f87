//! Drives: what they are realised as, and what is wrong with them.

use crate::{GOOD, read};
use std::f64::consts::TAU;
use std::fs;
use std::path::Path;
use tsubu_scene::Scene;
use tsubu_scene::plan::{Keep, Signal};

const SINE: &str = "base.sine = { amplitude = \"0.5 mm\", frequency = \"6 Hz\" }";

fn driven(drive: &str) -> String {
    GOOD.replace(SINE, drive)
}

fn base(drive: &str, set: &[&str]) -> Signal {
    let set: Vec<String> = set.iter().map(|&set| set.to_owned()).collect();
    let scene = Scene::parse("scene.toml", &driven(drive), Path::new("."), &set);
    let scene = scene.unwrap_or_else(|complaints| panic!("{complaints}"));
    scene.plan().hosts["spring"].base.clone().expect("a base that moves")
}

/// Mean square of the acceleration of sines whose amplitudes are displacements [m^2/s^4].
fn square(signal: &Signal) -> f64 {
    let Signal::Sines { amplitude, frequency, .. } = signal else { panic!("sines: {signal:?}") };
    amplitude.iter().zip(frequency).map(|(a, f)| 0.5 * (a * (TAU * f).powi(2)).powi(2)).sum()
}

const FLAT: &str = "base.random = { frequency = [\"20 Hz\", \"80 Hz\"], psd = [\"0.01 g^2/Hz\", \"0.01 g^2/Hz\"] }";

/// 0.01 g^2/Hz over 60 Hz: the mean square of the acceleration is 0.6 g^2, whatever the seed. Control: a one-sided density that is taken for a two-sided
/// one gives twice that. The seed is the scene's, unless one is given; the vibration begins at 0.
#[test]
fn a_random_base_has_its_mean_square() {
    let wanted = 0.6 * 9.80665_f64.powi(2);
    let first = base(FLAT, &[]);
    assert!((square(&first) / wanted - 1.0).abs() < 1e-12 && (2.0 * square(&first) / wanted - 1.0).abs() > 0.9);
    let other = base(FLAT, &["seed=2"]);
    assert!((square(&other) / wanted - 1.0).abs() < 1e-12 && other != first);
    assert_eq!(base(&FLAT.replace(" }", ", seed = 2 }"), &[]), other);
    let Signal::Sines { amplitude, phase, offset, frequency } = first else { panic!("sines") };
    assert_eq!(frequency.len(), 400);
    assert!((offset + amplitude.iter().zip(&phase).map(|(a, p)| a * p.sin()).sum::<f64>()).abs() < 1e-15);
}

/// The same from a file with units, and as a force, whose amplitudes are not divided by the square of the angular frequency.
#[test]
fn a_density_from_a_file_and_of_a_force() {
    let desk = tempfile::tempdir().expect("a folder of its own");
    fs::write(desk.path().join("psd.csv"), "f [kHz], psd [g^2/Hz]\n0.02, 0.01\n0.08, 0.01\n").expect("written");
    let text = driven("base.random.file = \"psd.csv\"");
    let scene = Scene::parse("scene.toml", &text, desk.path(), &[]).unwrap_or_else(|complaints| panic!("{complaints}"));
    let filed = scene.plan().hosts["spring"].base.clone().expect("a base");
    let wanted = 0.6 * 9.80665_f64.powi(2);
    assert!((square(&filed) / wanted - 1.0).abs() < 1e-12);
    let text = driven("force.random = { frequency = [20, 80], psd = [\"2 N^2/Hz\", 2], lines = 50 }");
    let scene = read(&text, &[]).unwrap_or_else(|complaints| panic!("{complaints}"));
    let force = scene.plan().hosts["spring"].force.clone().expect("a force");
    let Signal::Sines { amplitude, offset, .. } = force else { panic!("sines") };
    let square: f64 = amplitude.iter().map(|a| 0.5 * a * a).sum();
    assert!((square / 120.0 - 1.0).abs() < 1e-12 && offset == 0.0);
}

/// Each wrong drive is refused with its line and value, and says what to do.
#[test]
fn drives_that_cannot_be() {
    let desk = tempfile::tempdir().expect("a folder of its own");
    fs::write(desk.path().join("falls.csv"), "frequency [Hz], psd [g^2/Hz]\n20, 0.01\n10, 0.01\n").expect("written");
    fs::write(desk.path().join("one.csv"), "20, 0.01\n").expect("written");
    fs::write(desk.path().join("force.csv"), "f [Hz], psd [N^2/Hz]\n20, 1\n40, 1\n").expect("written");
    fs::write(desk.path().join("turned.csv"), "psd, frequency\n1, 20\n1, 40\n").expect("written");
    let about = |drive: &str| {
        let wrong = Scene::parse("scene.toml", &driven(drive), desk.path(), &[]).expect_err("wrong");
        wrong.to_string()
    };
    let wrong = [
        "base.random = { lines = 10 }",
        "base.random = { frequency = [20, 10], psd = [1, 1] }",
        "base.random = { frequency = [20, 30, 40], psd = [1, 1] }",
        "base.random = { frequency = [20], psd = [1] }",
        "base.random = { frequency = [20, 40], psd = [\"1 g\", 0] }",
        "base.random.file = \"falls.csv\"",
        "base.random.file = \"one.csv\"",
        "base.random.file = \"force.csv\"",
        "base.random.file = \"turned.csv\"",
        "base.random.file = \"none.csv\"",
        "base.sines = { amplitude = [1e-3, 1e-3], frequency = [3] }",
        "base.shock = { acceleration = \"50 mm\", duration = \"11 ms\" }",
    ];
    insta::assert_snapshot!(wrong.map(about).join("\n\n"));
}

/// A dwell has one sine, and nobody else moves its frequency; spectra have segments and looks that can tell their frequencies.
#[test]
fn dwells_and_spectra_that_cannot_be() {
    let about = |drive: &str| read(&driven(drive), &[]).expect_err("wrong").to_string();
    let wrong = [
        "base.table = { time = [0], value = [0] }\ndwell = {}".to_owned(),
        format!("{SINE}\ndwell = {{ lag = \"190 deg\", gain = 2 }}"),
        format!("{SINE}\ndwell = {{}}\n[response]\nfrequency-ratio = [1]"),
        format!("{SINE}\n[watch.w]\nresonance = {{}}"),
        format!("{SINE}\n[watch.w]\nspectrum = {{ frequency = [2, 100], segment = 0.5 }}"),
        format!("{SINE}\n[watch.w]\nspectrum = {{ frequency = [20, 10], segment = 0.5 }}"),
        format!("{SINE}\n[watch.w]\nspectrum = {{ frequency = [20, 20000], segment = 0.5 }}"),
        format!("{SINE}\n[watch.w]\nevery = \"5 ms\"\nspectrum = {{ frequency = [20, 100], segment = 0.5 }}"),
    ];
    insta::assert_snapshot!(wrong.map(|drive| about(&drive)).join("\n\n"));
    let scene = read(&driven(&format!("{SINE}\ndwell = {{}}\n[watch.w]\nresonance = {{}}")), &[]);
    let plan = scene.unwrap_or_else(|complaints| panic!("{complaints}")).plan().clone();
    let dwell = plan.hosts["spring"].dwell.clone().expect("a dwell");
    assert_eq!((dwell.lag, dwell.gain, dwell.keep), (0.5 * std::f64::consts::PI, None, Keep::Displacement));
    assert_eq!(plan.watch["w"].every, Some(plan.output.history_interval));
}

/// A run's own scene has what was realised, and means the same.
#[test]
fn drives_mean_the_same_when_read_again() {
    let drives = [
        FLAT.to_owned(),
        "base.shock = { acceleration = \"50 g\", duration = \"11 ms\", at = 0.1, compensation = \"20 %\" }".to_owned(),
        format!("{SINE}\nforce.sines = {{ amplitude = [1, \"2 N\"], frequency = [3, 5] }}"),
        "base.sine-sweep = { acceleration = \"1 g\", from = 5, to = 50, duration = 9, scale = \"logarithmic\" }"
            .to_owned(),
        format!("{SINE}\ndwell = {{ gain = 0.01 }}"),
        "base.sine = { acceleration = \"0.1 g\", frequency = 3 }\ndwell = {}".to_owned(),
    ];
    for drive in drives {
        let scene = read(&driven(&drive), &[]).unwrap_or_else(|complaints| panic!("{complaints}"));
        let again = read(&scene.resolved_toml(), &[]).unwrap_or_else(|complaints| panic!("{complaints}"));
        assert_eq!(again.plan(), scene.plan());
        assert_eq!(again.resolved_toml(), scene.resolved_toml());
    }
}
