//! Runs of several stages.

mod frames;
mod walls;
mod water;

use std::path::Path;
use tsubu::interrupt::{Interrupt, Watcher};
use tsubu::run::run;
use tsubu_frame::{Existing, Status, Summary};
use tsubu_scene::Scene;

/// A silo that is filled, comes to rest with other friction and softer grains, and is opened while a lid moves, under less gravity.
const SILO: &str = r#"
seed = 3
[materials.glass]
density = "2500 kg/m^3"
young-modulus = "20 MPa"
restitution = 0.5
friction = 0.4
[particles.beads]
material = "glass"
count = 120
diameter = "4 mm"
start.stream = { region = { low = [-0.02, 0.16], high = [0.02, 0.2] }, rate = "800 1/s", velocity = [0, -0.5] }
[walls]
left = { material = "glass", shape.plane = { point = [-0.03, 0], normal = "x" } }
right = { material = "glass", shape.plane = { point = [0.03, 0], normal = "-x" } }
floor = { material = "glass", shape.plane = {} }
lid = { material = "glass", shape.plane = { point = [0, 0.25], normal = "-z" } }
[removal.below.behind]
point = [0, -0.05]
normal = "z"
[contact]
normal.hertz = {}
tangential.mindlin = {}
[output]
history-interval = "2 ms"
checkpoint-interval = "5 ms"
"#;

const FILL: &str = r#"
[[stage]]
name = "fill"
until.inserted = 120
at-most = "1 s"
"#;

const SETTLE: &str = r#"
[[stage]]
name = "settle"
until.kinetic-energy = "2e-8 J"
at-most = "0.4 s"
[stage.set]
materials.glass = { friction = 0.7, young-modulus = "10 MPa" }
"#;

const OPEN: &str = r#"
[[stage]]
name = "open"
duration = "0.12 s"
[stage.set]
gravity = "6 m/s^2"
walls.floor.until = "20 ms"
walls.lid.motion = { direction = "-z", signal.sine = { amplitude = "5 mm", frequency = "20 Hz" } }
[stage.set.watch.touching]
coordination = {}
every = "10 ms"
"#;

fn scene(text: &str) -> Scene {
    Scene::parse("silo", text, Path::new("."), &[]).unwrap_or_else(|complaints| panic!("{complaints}"))
}

fn go(text: &str, folder: &Path, existing: Existing) -> Summary {
    let watcher = Watcher { interrupt: &Interrupt::new(), progress: &|_| {} };
    run(&scene(text), folder, existing, &watcher).unwrap_or_else(|error| panic!("{error}"))
}

/// Interrupts the run when so much of it is done.
fn cut(text: &str, folder: &Path, existing: Existing, share: f64) -> Summary {
    let interrupt = Interrupt::new();
    let progress = |done| {
        if done > share {
            interrupt.ask();
        }
    };
    run(&scene(text), folder, existing, &Watcher { interrupt: &interrupt, progress: &progress }).unwrap()
}

fn rows(folder: &Path) -> String {
    std::fs::read_to_string(folder.join("history.csv")).unwrap()
}

/// A stage that would end by a result that no run has ran to its `at-most`.
#[test]
fn a_stage_that_ends_by_nothing_is_refused() {
    let desk = tempfile::tempdir().unwrap();
    let watch = "[watch.sample]\ncoordination = {}\n";
    let until = "[[stage]]\nname = \"wait\"\nuntil = { result = \"sample man\", above = 1 }\nat-most = \"1 s\"\n";
    let watcher = Watcher { interrupt: &Interrupt::new(), progress: &|_| {} };
    let folder = desk.path().join("run");
    let told =
        run(&scene(&format!("{SILO}{watch}{until}")), &folder, Existing::Refuse, &watcher).unwrap_err().to_string();
    assert!(told.contains("stage.0.until.result") && told.contains("did you mean `sample mean`?"), "{told}");
    assert!(!folder.exists());
}

/// The same bits by any number of threads and after a stop in every stage, and books that close over the changes: without the
/// account of these they would not.
#[test]
fn stages_have_the_same_bits_and_close_their_books() {
    let desk = tempfile::tempdir().unwrap();
    let text = format!("{SILO}{FILL}{SETTLE}{OPEN}");
    let whole = go(&text, &desk.path().join("whole"), Existing::Refuse);
    let names: Vec<(&str, &str)> = whole.stages.iter().map(|s| (s.name.as_str(), s.ended.as_str())).collect();
    assert_eq!(names, [("fill", "until"), ("settle", "until"), ("open", "duration")]);
    assert!(whole.stages.windows(2).all(|pair| pair[0].end == pair[1].begin && pair[0].steps > 0));
    assert!(whole.warnings.is_empty(), "{:?}", whole.warnings);
    let changes = whole.energy.terms.get("changes of stage").unwrap().0;
    let residual = whole.energy.residual_relative;
    assert!(residual.abs() < 1e-3, "{residual}");
    let missed = whole.energy.terms.get("residual").unwrap().0;
    let without = residual * (missed + changes) / missed;
    assert!(without.abs() > 1e-3, "the gate would let it pass: {without}");
    assert!(whole.results.get("open.touching mean").is_some() && whole.results.get("fill.contacts").is_some());
    for threads in [1, 2, 7] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let other = pool.install(|| go(&text, &desk.path().join(format!("by {threads}")), Existing::Refuse));
        assert_eq!(other.state_hash, whole.state_hash, "{threads} threads");
    }
    // Shares of the longest time that the stages may take: the first is over at 0.10, the second at about 0.7.
    let total = 1.0 + 0.4 + 0.12;
    let spans = &whole.stages;
    let inside = [0.05, (1.0 + 0.5 * (spans[1].end - spans[1].begin)) / total, (1.4 + 0.06) / total];
    for (name, share) in ["fill", "settle", "open"].into_iter().zip(inside) {
        let folder = desk.path().join(name);
        let stopped = cut(&text, &folder, Existing::Refuse, share);
        assert_eq!(stopped.status, Status::Interrupted);
        let over: Vec<&str> = stopped.stages.iter().map(|s| s.name.as_str()).collect();
        assert_eq!(over, ["fill", "settle", "open"][..over.len()], "{name}");
        assert_eq!(over.len(), ["fill", "settle", "open"].iter().position(|n| *n == name).unwrap(), "{name}: {share}");
        let resumed = go(&text, &folder, Existing::Resume);
        assert_eq!(resumed.state_hash, whole.state_hash, "stopped in {name}");
        assert_eq!(rows(&folder), rows(&desk.path().join("whole")), "stopped in {name}");
        assert_eq!(resumed.stages, whole.stages);
        let results = |summary: &Summary| serde_json::to_string(&summary.results).unwrap();
        assert_eq!(results(&resumed), results(&whole), "stopped in {name}");
    }
}

/// What a later stage does not touch goes on; what it sets begins from where things stand.
#[test]
fn one_by_one_is_the_same_run() {
    let desk = tempfile::tempdir().unwrap();
    let whole = go(&format!("{SILO}{FILL}{SETTLE}{OPEN}"), &desk.path().join("whole"), Existing::Refuse);
    let path = |name: &str| desk.path().join(name);
    go(&format!("{SILO}{FILL}"), &path("one"), Existing::Refuse);
    let from = |name: &str| format!("start-from = {:?}\n", path(name));
    go(&format!("{}{SILO}{SETTLE}", from("one")), &path("two"), Existing::Refuse);
    // What was set stays set: whoever goes on says it at the top.
    let set = SILO.replace("\"20 MPa\"", "\"10 MPa\"").replace("friction = 0.4", "friction = 0.7");
    let three = format!("{}{set}{OPEN}", from("two"));
    let last = go(&three, &path("three"), Existing::Refuse);
    assert_eq!(last.state_hash, whole.state_hash);
    cut(&three, &path("again"), Existing::Refuse, 0.5);
    assert_eq!(go(&three, &path("again"), Existing::Resume).state_hash, whole.state_hash);
    // The scene of the folder is the same run.
    let written = std::fs::read_to_string(path("three").join("scene.toml")).unwrap();
    assert_eq!(go(&written, &path("copy"), Existing::Refuse).state_hash, whole.state_hash);
    let staged = std::fs::read_to_string(path("whole").join("scene.toml")).unwrap();
    assert_eq!(go(&staged, &path("staged"), Existing::Refuse).state_hash, whole.state_hash);
}

/// Another number of grains is another run, and refused by name.
#[test]
fn what_no_stage_may_change_must_be_as_it_was() {
    let desk = tempfile::tempdir().unwrap();
    let one = desk.path().join("one");
    go(&format!("{SILO}{FILL}"), &one, Existing::Refuse);
    let text = format!("start-from = {one:?}\n{}{SETTLE}", SILO.replace("count = 120", "count = 121"));
    let watcher = Watcher { interrupt: &Interrupt::new(), progress: &|_| {} };
    let error = run(&scene(&text), &desk.path().join("two"), Existing::Refuse, &watcher).unwrap_err().to_string();
    assert!(error.contains("`particles.beads.count` was 120, is 121"), "{error}");
    assert!(!desk.path().join("two").exists());
}

/// A run may begin at 0 where another has ended: grains move on as they would with its clock, a gate that has gone stays away, and
/// books are those of this run alone. Who is moved by a signal from time 0 on is refused.
#[test]
fn a_run_may_start_at_zero_from_another() {
    let desk = tempfile::tempdir().unwrap();
    let path = |name: &str| desk.path().join(name);
    let settled = go(&format!("{SILO}{FILL}{SETTLE}"), &path("settled"), Existing::Refuse);
    let set = SILO.replace("\"20 MPa\"", "\"10 MPa\"").replace("friction = 0.4", "friction = 0.7");
    let open = OPEN.replace("0.12 s", "30 ms");
    let zero = format!("start-from = {:?}\nstart-at-zero = true\n{set}{open}", path("settled"));
    let found = go(&zero, &path("zero"), Existing::Refuse);
    let on = go(&zero.replace("start-at-zero = true", ""), &path("on"), Existing::Refuse);
    assert_eq!((found.stages[0].begin, on.stages[0].begin), (0.0, settled.stages[1].end));
    assert_eq!((found.stages[0].steps, found.particles), (on.stages[0].steps, on.particles));
    assert!(found.energy.residual_relative.abs() < 1e-3, "{}", found.energy.residual_relative);
    let touching = |summary: &Summary| serde_json::to_string(&summary.results.get("open.touching mean")).unwrap();
    assert_eq!(touching(&found), touching(&on));
    cut(&zero, &path("again"), Existing::Refuse, 0.5);
    assert_eq!(go(&zero, &path("again"), Existing::Resume).state_hash, found.state_hash);
    // The floor has gone there, and does not come back for 20 ms.
    let gone = set.replace("shape.plane = {} }", "shape.plane = {}, until = \"20 ms\" }");
    let fall = "[[stage]]\nname = \"fall\"\nduration = \"10 ms\"\n";
    let gone = format!("start-from = {:?}\nstart-at-zero = true\ngravity = \"6 m/s^2\"\n{gone}{fall}", path("zero"));
    go(&gone, &path("gone"), Existing::Refuse);
    let text = rows(&path("gone"));
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let at = lines.next().unwrap().iter().position(|cell| cell.contains("centre of mass")).unwrap();
    let heights: Vec<f64> = lines.map(|cells| cells[at].parse().unwrap()).collect();
    assert!(heights.windows(2).all(|pair| pair[1] < pair[0]), "{heights:?}");
}

/// A box on a spring that a sine pushes.
const HOST: &str = r#"
[materials.steel]
density = "7800 kg/m^3"
young-modulus = "10 MPa"
[hosts.box]
structure.oscillator = { mass = 0.1, stiffness = 1579.1, damping = 1.2566 }
force.sine = { amplitude = "1 N", frequency = "20 Hz" }
[walls.box]
material = "steel"
host = "box"
shape.box = { width = "20 mm", height = "20 mm", depth = "4 mm" }
[dem]
time-step = "50 us"
[output]
history-interval = "1 ms"
frame-interval = "50 ms"
checkpoint-interval = "20 ms"
[[stage]]
name = "begin"
until.host-steady = 0.01
at-most = "2 s"
[[stage]]
name = "on"
duration = "0.1 s"
set.output.xyz = true
"#;

/// At resonance the amplitude comes up as 1 - exp(-z w t): from period to period by less than a share from some time on. What is
/// written beside frames may change with a stage.
#[test]
fn a_stage_waits_until_hosts_are_steady() {
    let desk = tempfile::tempdir().unwrap();
    let path = |name: &str| desk.path().join(name);
    let whole = go(HOST, &path("whole"), Existing::Refuse);
    assert_eq!(whole.stages[0].ended, "until");
    let decay = (-0.05 * std::f64::consts::TAU).exp();
    let envelope = |period: i32| (1.0 - decay.powi(period + 1)) / (1.0 - decay.powi(period));
    let expected = (1..100).find(|&period| envelope(period) < 1.01).unwrap();
    let periods = whole.stages[0].end * 20.0;
    assert!((periods - f64::from(expected)).abs() < 2.5, "{periods} of {expected}");
    let never = go(&HOST.replace("0.01", "1e-9"), &path("never"), Existing::Refuse);
    assert_eq!(never.stages[0].ended, "at-most", "the gate would let it pass");
    cut(HOST, &path("again"), Existing::Refuse, 0.1);
    let resumed = go(HOST, &path("again"), Existing::Resume);
    assert_eq!((resumed.state_hash, resumed.stages), (whole.state_hash, whole.stages));
    let frames = |ending: &str| {
        let files = std::fs::read_dir(path("whole").join("frames")).unwrap().flatten();
        files.filter(|file| file.file_name().to_string_lossy().ends_with(ending)).count()
    };
    assert_eq!((frames(".xyz"), frames(".vtp") > 4), (2, true));
}

/// Grains that a signal moves from where they were at time 0 would jump.
#[test]
fn who_goes_with_the_clock_does_not_start_at_zero() {
    let desk = tempfile::tempdir().unwrap();
    let driven = "[particles.base]\nmaterial = \"glass\"\ndiameter = \"4 mm\"\nstart.at.position = [[0, 0.22]]\n\
                  motion.driven.signal.steady.rate = \"1 mm/s\"\n";
    let stage = "[[stage]]\nname = \"a\"\nduration = \"10 ms\"\n";
    let one = desk.path().join("one");
    go(&format!("{SILO}{driven}{stage}"), &one, Existing::Refuse);
    let text = format!("start-from = {one:?}\nstart-at-zero = true\n{SILO}{driven}{stage}");
    let watcher = Watcher { interrupt: &Interrupt::new(), progress: &|_| {} };
    let error = run(&scene(&text), &desk.path().join("two"), Existing::Refuse, &watcher).unwrap_err().to_string();
    assert!(error.contains("particles.base.motion"), "{error}");
    assert!(!desk.path().join("two").exists());
}

/// Keys of a stage are swept like others, each case with the stages of its own.
#[test]
fn what_a_stage_sets_may_be_swept() {
    let desk = tempfile::tempdir().unwrap();
    let fewer = SILO.replace("count = 120", "count = 20");
    let text = format!("{fewer}{FILL}{OPEN}[sweep]\nvary = {{ \"stage.1.set.gravity\" = [3, 6] }}\n");
    let text = text.replace("inserted = 120", "inserted = 20");
    let watcher = Watcher { interrupt: &Interrupt::new(), progress: &|_| {} };
    let cases = tsubu::study::sweep::sweep(&scene(&text), &desk.path().join("sweep"), false, &watcher).unwrap();
    let [slow, fast] = &cases[..] else { panic!("{} cases", cases.len()) };
    assert_eq!(slow.stages[0], fast.stages[0]);
    assert_ne!(slow.state_hash, fast.state_hash);
    let alone = go(&text, &desk.path().join("alone"), Existing::Refuse);
    assert_eq!(alone.state_hash, fast.state_hash);
}
