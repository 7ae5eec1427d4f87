//! Water whose flow changes from stage to stage.

use super::{cut, go, scene};
use std::path::Path;
use tsubu::interrupt::{Interrupt, Watcher};
use tsubu::run::run;
use tsubu_frame::Existing;

/// Grains on a rough bottom, under water; what flows is left open.
const BED: &str = r#"
seed = 5
gravity = "9.8 m/s^2"
speed-scale = "0.4 m/s"
[materials.sand]
young-modulus = "5 MPa"
density = "2650 kg/m^3"
restitution = 0.5
friction = 0.5
[particles.base]
material = "sand"
count = 10
diameter = "2 mm"
motion.frozen = {}
start.rows = { spacing = 1, jitter = 0, region = { low = [0, 0], high = ["20 mm", "2 mm"] } }
[particles.sand]
material = "sand"
count = 40
diameter = "2 mm"
start.rows = { spacing = 1.02, jitter = 0.5, region = { low = [0, "2 mm"], high = ["20 mm", "16 mm"] } }
[periodic]
x = [0, "20 mm"]
[contact]
tangential.mindlin = {}
[watch.upper]
every = "5 ms"
track.ids = [40, 41, 42, 43, 44, 45, 46, 47, 48, 49]
[output]
history-interval = "5 ms"
checkpoint-interval = "10 ms"
"#;

/// Grains settle in water at rest, then a stream runs over them, then a thicker one holds them more.
const STREAM: &str = r#"
[[stage]]
name = "settle"
duration = "40 ms"
[[stage]]
name = "flow"
duration = "40 ms"
set.water.flow.log-law = { shear-velocity = "8 cm/s", zero-level = "6 mm", roughness = "2 mm" }
[[stage]]
name = "thick"
duration = "40 ms"
set.water = { viscosity = "1e-5 m^2/s", drag.schiller-naumann = {} }
"#;

/// A stream that grains slow is driven harder.
const HARDER: &str = r#"
[[stage]]
name = "slow"
duration = "40 ms"
[[stage]]
name = "fast"
duration = "40 ms"
set.water.flow.coupled.shear-velocity = "9 cm/s"
"#;

/// Where the upper grains are along x in the mean [m], at these times [s].
fn middles(folder: &Path, times: &[f64]) -> Vec<f64> {
    let text = std::fs::read_to_string(folder.join("watch/upper.csv")).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let at = lines.next().unwrap().iter().position(|cell| cell.starts_with("position x [")).unwrap();
    let rows: Vec<(f64, f64)> = lines.map(|cells| (cells[0].parse().unwrap(), cells[at].parse().unwrap())).collect();
    let mean = |time: f64| {
        let places: Vec<f64> = rows.iter().filter(|row| (row.0 - time).abs() < 1e-3).map(|row| row.1).collect();
        // Where one stage ends and another begins each has looked.
        assert!([10, 20].contains(&places.len()), "{} grains at {time} s", places.len());
        places.iter().sum::<f64>() / places.len() as f64
    };
    times.iter().map(|time| mean(*time)).collect()
}

#[test]
fn a_stream_begins_when_grains_have_settled() {
    let desk = tempfile::tempdir().unwrap();
    let path = |name: &str| desk.path().join(name);
    let text = format!("{BED}[water]\n{STREAM}");
    let whole = go(&text, &path("whole"), Existing::Refuse);
    assert!(whole.energy.residual_relative.abs() < 1e-3, "{}", whole.energy.residual_relative);
    let at = middles(&path("whole"), &[0.0, 0.04, 0.08, 0.12]);
    let ways: Vec<f64> = at.windows(2).map(|pair| pair[1] - pair[0]).collect();
    assert!(ways[0].abs() < 1e-4 && ways[1] > 2e-4 && ways[2] > 1.2 * ways[1], "{ways:?}");
    for (name, share) in [("settle", 0.2), ("flow", 0.5), ("thick", 0.8)] {
        cut(&text, &path(name), Existing::Refuse, share);
        let resumed = go(&text, &path(name), Existing::Resume);
        assert_eq!(resumed.state_hash, whole.state_hash, "stopped in {name}");
    }
    // One by one is the same run.
    let one = format!("{BED}[water]\n{}", STREAM.split("[[stage]]\nname = \"flow\"").next().unwrap());
    go(&one, &path("one"), Existing::Refuse);
    let rest = STREAM.split_once("duration = \"40 ms\"\n").unwrap().1;
    let two = go(&format!("start-from = {:?}\n{BED}[water]\n{rest}", path("one")), &path("two"), Existing::Refuse);
    assert_eq!(two.state_hash, whole.state_hash);
}

#[test]
fn a_stream_that_grains_slow_is_driven_harder() {
    let desk = tempfile::tempdir().unwrap();
    let path = |name: &str| desk.path().join(name);
    let flow = "[water]\nflow.coupled = { bottom = 0, top = \"24 mm\", layers = 24, shear-velocity = \"4 cm/s\" }\n";
    let text = format!("{BED}{flow}{HARDER}");
    let whole = go(&text, &path("whole"), Existing::Refuse);
    assert!(whole.energy.residual_relative.abs() < 1e-3, "{}", whole.energy.residual_relative);
    let at = middles(&path("whole"), &[0.0, 0.04, 0.08]);
    let even = go(&text.replace("9 cm/s", "4 cm/s"), &path("even"), Existing::Refuse);
    assert_ne!(even.state_hash, whole.state_hash);
    assert!(at[2] > middles(&path("even"), &[0.08])[0], "{at:?}");
    for (name, share) in [("slow", 0.3), ("fast", 0.8)] {
        cut(&text, &path(name), Existing::Refuse, share);
        let resumed = go(&text, &path(name), Existing::Resume);
        assert_eq!(resumed.state_hash, whole.state_hash, "stopped in {name}");
    }
}

/// What is part of the state is refused by name.
#[test]
fn water_that_would_jump_is_refused() {
    let desk = tempfile::tempdir().unwrap();
    let refused = |water: &str, set: &str, said: &str| {
        let stages = format!(
            "[[stage]]\nname = \"a\"\nduration = \"1 ms\"\n[[stage]]\nname = \"b\"\nduration = \"1 ms\"\n{set}\n"
        );
        let watcher = Watcher { interrupt: &Interrupt::new(), progress: &|_| {} };
        let told =
            run(&scene(&format!("{BED}{water}{stages}")), &desk.path().join("run"), Existing::Overwrite, &watcher);
        let told = told.expect_err(said).to_string();
        assert!(told.contains(said), "{told}");
    };
    let coupled = "[water]\nflow.coupled = { bottom = 0, top = \"24 mm\", shear-velocity = \"4 cm/s\" }\n";
    refused("", "set.water.flow.still = {}", "water is there from the first stage on, or never");
    refused("[water]\n", "set.gravity = 5", "in water gravity stays as it is");
    refused(coupled, "set.water.flow.still = {}", "a stream in layers goes on with the same layers");
    refused(coupled, "set.water.flow.coupled.top = \"20 mm\"", "a stream in layers goes on with the same layers");
    let log_law = "[water]\nfluctuation = {}\nflow.log-law = { depth = \"20 mm\", shear-velocity = \"4 cm/s\" }\n";
    refused(
        log_law,
        "set.water.flow.log-law.depth = \"15 mm\"",
        "the mass of water that moves with grains hangs on it",
    );
}
