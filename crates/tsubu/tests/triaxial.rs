//! The shipped triaxial test, with fewer grains: what its planes do.

use std::path::Path;
use tsubu::interrupt::{Interrupt, Watcher};
use tsubu::run::run;
use tsubu_frame::{Existing, Status, Summary};
use tsubu_scene::Scene;

/// 100 grains, sheared to a fifth; and more changes.
fn scene(more: &[&str]) -> Scene {
    let fewer = [
        "particles.grains.count=100",
        "particles.grains.start.random.region.high=['12 mm','12 mm','12 mm']",
        "walls.right.shape.plane.point=['12 mm',0,0]",
        "walls.back.shape.plane.point=[0,'12 mm',0]",
        "walls.lid.shape.plane.point=[0,0,'12 mm']",
        "stage.2.duration='0.12 s'",
        "stage.2.set.walls.lid.motion.signal.steady.rate='15 mm/s'",
        "output.checkpoint-interval='20 ms'",
    ];
    let changes: Vec<String> = fewer.iter().chain(more).map(|change| (*change).to_owned()).collect();
    let text = include_str!("../../../scenes/triaxial.toml");
    Scene::parse("triaxial", text, Path::new("."), &changes).unwrap_or_else(|complaints| panic!("{complaints}"))
}

/// Runs until so much of it is done.
fn go(scene: &Scene, folder: &Path, existing: Existing, share: f64) -> Summary {
    let interrupt = Interrupt::new();
    let progress = |done| {
        if done > share {
            interrupt.ask();
        }
    };
    let watcher = Watcher { interrupt: &interrupt, progress: &progress };
    run(scene, folder, existing, &watcher).unwrap_or_else(|error| panic!("{error}"))
}

/// A column of the history.
fn column(folder: &Path, name: &str) -> Vec<f64> {
    let text = std::fs::read_to_string(folder.join("history.csv")).unwrap();
    let mut lines = text.lines();
    let at = lines.next().unwrap().split(',').position(|cell| cell.trim_matches('"') == name).unwrap();
    lines.map(|line| line.split(',').nth(at).unwrap().parse().unwrap_or(f64::NAN)).collect()
}

mod patient {
    use super::*;

    /// A pressure on a face keeps the stress while the box changes its shape, where one on a given area does not; books close over the
    /// work of a force that changes, and a run that was stopped in the shear has the same bits.
    #[test]
    #[ignore = "6 s: cargo xtask patient"]
    fn a_pressure_on_a_face_keeps_the_stress() {
        let desk = tempfile::tempdir().unwrap();
        let path = |name: &str| desk.path().join(name);
        let whole = go(&scene(&[]), &path("whole"), Existing::Refuse, 2.0);
        assert_eq!(whole.stages.len(), 3);
        assert!(whole.energy.residual_relative.abs() < 1e-3, "{}", whole.energy.residual_relative);
        let late = |folder: &str| {
            let values = column(&path(folder), "sample stress x [Pa]");
            let late = &values[values.len() - 50..];
            late.iter().sum::<f64>() / 50.0
        };
        assert!((late("whole") / 100e3 - 1.0).abs() < 0.06, "{}", late("whole"));
        // As large as the face is when it is pressed: it is a tenth smaller at the end.
        let area =
            "walls.right.servo={direction='-x',pressure='100 kPa',area='82 mm^2',mass='1.5 g',damping='20 N s/m'}";
        go(&scene(&[area]), &path("area"), Existing::Refuse, 2.0);
        assert!((late("area") / 100e3 - 1.0).abs() > 0.06, "the gate would let it pass: {}", late("area"));
        let stopped = go(&scene(&[]), &path("again"), Existing::Refuse, 0.95);
        assert_eq!((stopped.status, stopped.stages.len()), (Status::Interrupted, 2));
        let resumed = go(&scene(&[]), &path("again"), Existing::Resume, 2.0);
        assert_eq!(resumed.state_hash, whole.state_hash);
        assert_eq!(
            std::fs::read(path("again").join("history.csv")).unwrap(),
            std::fs::read(path("whole").join("history.csv")).unwrap()
        );
    }
}
