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
            // The base carries what the mass takes to be accelerated.
            let acceleration = 0.5e-3 * gain * w * w;
            let told = [
                row.rms[0] / (0.5e-3 * gain / 2.0_f64.sqrt()),
                row.transmissibility / gain,
                row.acceleration / acceleration,
                row.base_force / (m * acceleration),
            ];
            told.map(|ratio| (ratio - 1.0).abs()).into_iter().fold(0.0, f64::max)
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

/// Duffing's oscillator: a spring that hardens leans the peak over, so that between two frequencies a large and a small motion are both
/// steady. Coming from below the large one is found, from above the small one; their amplitudes are the largest and the smallest root
/// of ((K - M w^2 + 3/4 k3 A^2)^2 + (C w)^2) A^2 = F^2 (harmonic balance, without the third harmonic), within 1 %, after 100 periods at each frequency. Control: the
/// linear spring has one curve.
#[test]
fn a_hardening_spring_jumps_both_ways() {
    let (m, c, k, k3, force) = (0.086_f64, 0.24_f64, 123.4_f64, 2.5e5_f64, 0.15_f64);
    let at = |cubic: f64| {
        let text = DAMPER.replace(
            "base.sine = { amplitude = \"0.5 mm\", frequency = \"5.7 Hz\" }",
            "force.sine = { amplitude = \"150 mN\", frequency = \"5.7 Hz\" }",
        );
        let cubic = format!("hosts.leaf-spring.structure.oscillator.cubic-stiffness={cubic}");
        let changes = [
            &cubic,
            "response.vary={}",
            "particles.balls.count=0",
            "dem.time-step=4e-4",
            "hosts.leaf-spring.structure.oscillator.damping=0.24",
            "response.frequency-ratio={ from = 0.95, to = 1.3, step = 0.005 }",
            "response.path=up-and-down",
            "response.discard-periods-empty=100",
        ];
        let changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
        let scene =
            Scene::parse("damper.toml", &text, std::path::Path::new("."), &changes).unwrap_or_else(|e| panic!("{e}"));
        curves(&scene).unwrap()
    };
    let found = at(k3);
    let [up, down] = &found[..] else { panic!("{} curves", found.len()) };
    assert_eq!([up.name.as_str(), down.name.as_str()], ["up", "down"]);
    // Signs of the cubic in A^2 on a fine grid give its roots.
    let roots = |w: f64| -> Vec<f64> {
        let excess = |a: f64| ((k - m * w * w + 0.75 * k3 * a * a).powi(2) + (c * w).powi(2)) * a * a - force * force;
        let grid = (1..40_000).map(|i| 1e-6 * f64::from(i));
        grid.filter(|&a| (excess(a) > 0.0) != (excess(a + 1e-6) > 0.0)).map(|a| a + 5e-7).collect()
    };
    let all: Vec<Vec<f64>> = up.rows.iter().map(|row| roots(TAU * row.frequency)).collect();
    let both: Vec<f64> =
        up.rows.iter().zip(&all).filter(|(_, roots)| roots.len() == 3).map(|(row, _)| row.ratio).collect();
    for (i, (up, down)) in up.rows.iter().zip(&down.rows).enumerate() {
        // Beside a fold, which the third harmonic shifts, a motion that is no longer there goes so slowly that it seems to be.
        let near = i.saturating_sub(3)..(i + 4).min(all.len());
        if all[near].iter().any(|roots| roots.len() != all[i].len()) {
            continue;
        }
        for (row, root) in [(up, all[i].last()), (down, all[i].first())] {
            let (amplitude, root) = (row.rms[0] * 2.0_f64.sqrt(), root.unwrap());
            assert!((amplitude / root - 1.0).abs() < 0.01, "{}: {amplitude} {root}", row.ratio);
        }
    }
    let hysteresis = up.hysteresis.unwrap();
    assert!(both.len() > 5, "{both:?}");
    assert!(
        (hysteresis.ratios[0] - both[0]).abs() < 0.016 && (hysteresis.ratios[1] - both[both.len() - 1]).abs() < 0.016
    );
    assert_eq!(at(0.0)[0].hysteresis, None);
}

/// A shaker that keeps its acceleration moves the base by 1 / w^2 of what it does at the frequency of the scene, 5.7 Hz; one that keeps
/// its velocity by 1 / w. The empty structure is linear: its curve is that of a constant amplitude, scaled.
#[test]
fn a_shaker_may_keep_its_acceleration() {
    let rows = |keep: &str| {
        let empty = ["response.vary={}", "particles.balls.count=0", "dem.time-step=2e-4", keep];
        let cases = curves(&scene(&[&empty[..], &["response.frequency-ratio=[0.8, 1.2]"]].concat())).unwrap();
        let (frequency, rms): (Vec<f64>, Vec<f64>) =
            cases[0].rows.iter().map(|row| (row.frequency, row.rms[0])).unzip();
        (frequency, rms)
    };
    let (frequency, plain) = rows("response.keep=displacement");
    for (keep, power) in [("response.keep=velocity", 1), ("response.keep=acceleration", 2)] {
        for ((f, plain), kept) in frequency.iter().zip(&plain).zip(rows(keep).1) {
            let expected = (5.7 / f).powi(power);
            assert!((kept / plain / expected - 1.0).abs() < 1e-9, "{keep} at {f}");
        }
    }
}

/// Transmissibility of the empty structure with a damping ratio of 0.3, by its base and by a force, up to 2.5 times the natural frequency: sqrt(1 + (2 zeta r)^2) /
/// sqrt((1 - r^2)^2 + (2 zeta r)^2), of both the same. Control: what a force moves, the same without the root above, is off by more than a tenth.
#[test]
fn transmissibility_of_base_and_force_is_the_same() {
    let (m, k, zeta) = (0.086_f64, 123.4_f64, 0.3);
    let base = "base.sine = { amplitude = \"0.5 mm\", frequency = \"5.7 Hz\" }";
    for drive in [base, "force.sine = { amplitude = \"50 mN\", frequency = \"5.7 Hz\" }"] {
        let text = DAMPER.replace(base, drive);
        let changes = [
            "response.vary={}",
            "particles.balls.count=0",
            "dem.time-step=2e-4",
            "response.frequency-ratio=[0.5, 1, 1.5, 2, 2.5]",
            &format!("hosts.leaf-spring.structure.oscillator.damping={}", 2.0 * zeta * (k * m).sqrt()),
        ];
        let changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
        let scene =
            Scene::parse("damper.toml", &text, std::path::Path::new("."), &changes).unwrap_or_else(|e| panic!("{e}"));
        let off = |numerator: &dyn Fn(f64) -> f64| {
            let rows = curves(&scene).unwrap().remove(0).rows;
            assert_eq!(rows.len(), 5);
            let each = rows.iter().map(|row| {
                let r = row.ratio;
                let below = ((1.0 - r * r).powi(2) + (2.0 * zeta * r).powi(2)).sqrt();
                (row.transmissibility / (numerator(2.0 * zeta * r) / below) - 1.0).abs()
            });
            each.fold(0.0, f64::max)
        };
        let gate = off(&|x| (1.0 + x * x).sqrt());
        assert!(gate < 2e-3, "{drive}: {gate}");
        assert!(off(&|_| 1.0) > 0.1);
    }
}
