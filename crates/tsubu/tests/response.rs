//! Responses that choose their own frequencies, and begin in motion.

use std::f64::consts::TAU;
use std::fs;
use tsubu::interrupt::{Interrupt, Watcher};
use tsubu::study::response::{curves, response};
use tsubu_scene::Scene;

const DAMPER: &str = include_str!("../../../scenes/damper.toml");

fn scene(changes: &[&str]) -> Scene {
    let changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
    Scene::parse("damper.toml", DAMPER, std::path::Path::new("."), &changes).unwrap_or_else(|e| panic!("{e}"))
}

/// The empty structure against its closed form, amplitude over that of the base: sqrt((k^2 + (c w)^2) / ((k - m w^2)^2 + (c w)^2)).
/// It begins in its steady motion, so that nothing needs to die away, and the frequencies that it chooses find the peak. Control:
/// begun at rest, after as many periods, it is off by more than ten times as much.
#[test]
fn an_empty_structure_follows_its_closed_form() {
    let worst = |changes: &[&str]| {
        let empty = ["response.vary={}", "particles.balls.count=0", "dem.time-step=2e-4"];
        let cases = curves(&scene(&[&empty, changes].concat())).unwrap();
        let (m, c, k) = (0.086, 0.08, 123.4);
        let off = cases[0].rows.iter().map(|row| {
            let w = TAU * row.frequency;
            let gain = ((k * k + (c * w).powi(2)) / ((k - m * w * w).powi(2) + (c * w).powi(2))).sqrt();
            (row.rms[0] / (0.5e-3 * gain / 2.0_f64.sqrt()) - 1.0).abs()
        });
        (off.fold(0.0, f64::max), cases[0].peak.unwrap())
    };
    let (off, peak) = worst(&["response.peak-within=0.003"]);
    assert!(off < 1e-3, "{off}");
    assert!((peak.ratio - 1.0).abs() < 1e-3 && peak.within <= 0.003, "{peak:?}");
    let (at_rest, _) = worst(&["response.discard-periods-empty=6"]);
    assert!(at_rest > 1e-2, "{at_rest}");
}

/// Stopped in its second round and gone on with, a response has the curves of one that was not: what a round asks for, and how its
/// runs begin, follows from the rounds before alone.
#[test]
fn rounds_go_on_where_they_were() {
    let changes = [
        "response.vary={}",
        "particles.balls.count=2",
        "dem.time-step=2e-5",
        "response.frequency-ratio=[0.9, 0.95, 1, 1.05]",
        "response.peak-within=0.02",
        "response.measure-periods=2",
    ];
    let scene = scene(&changes);
    let desk = tempfile::tempdir().unwrap();
    let run = |folder: &str, stop: f64| {
        let interrupt = Interrupt::new();
        let progress = |done: f64| {
            if done >= stop {
                interrupt.ask();
            }
        };
        let path = desk.path().join(folder);
        let summary = response(&scene, &path, false, &Watcher { interrupt: &interrupt, progress: &progress }).unwrap();
        (summary.status, fs::read_to_string(path.join("response.csv")).unwrap())
    };
    let (_, whole) = run("whole", 2.0);
    // Twelve runs are expected: four in the first round.
    let (status, part) = run("part", 0.4);
    assert_eq!(status, tsubu_frame::Status::Interrupted);
    assert!(part.lines().count() < whole.lines().count());
    let (status, gone_on) = run("part", 2.0);
    assert_eq!(status, tsubu_frame::Status::Finished);
    assert_eq!(gone_on, whole);
    assert!(whole.lines().count() > 1 + 4, "{whole}");
}
