//! Walls from stage to stage: those that hang on hosts, and those that go.

use super::{SILO, cut, go};
use tsubu_frame::Existing;

/// Twenty balls in a box on a spring.
const DAMPER: &str = r#"
[materials.acrylic]
young-modulus = "0.5 GPa"
restitution = 0.75
friction = 0.5
[particles.balls]
material = "acrylic"
count = 20
diameter = "6 mm"
mass = "0.2 g"
start.rows = {}
[walls.box]
material = "acrylic"
host = "spring"
shape.box = { width = "60 mm", height = "96 mm" }
[hosts.spring]
structure.oscillator = { mass = "86 g", stiffness = "123.4 N/m", damping = "0.08 N s/m" }
base.sine = { amplitude = "5 mm", frequency = "6 Hz" }
"#;

const FIRST: &str = "[[stage]]\nname = \"first\"\nduration = \"50 ms\"\n";
const SECOND: &str = "[[stage]]\nname = \"second\"\nduration = \"60 ms\"\n";

/// The box stood where neighbours had last been looked for, and threw its balls: elastic energy of 0.7 J where there had been 1e-7.
#[test]
fn a_box_on_a_host_is_where_its_host_is() {
    let desk = tempfile::tempdir().unwrap();
    let path = |name: &str| desk.path().join(name);
    let whole = go(&format!("{DAMPER}{FIRST}{SECOND}"), &path("whole"), Existing::Refuse);
    go(&format!("{DAMPER}{FIRST}"), &path("one"), Existing::Refuse);
    let from = format!("start-from = {:?}\n", path("one"));
    let next = go(&format!("{from}{DAMPER}{SECOND}"), &path("next"), Existing::Refuse);
    assert_eq!(next.state_hash, whole.state_hash);
    assert!(next.energy.residual_relative.abs() < 1e-6, "{}", next.energy.residual_relative);
    let zero = go(&format!("{from}start-at-zero = true\n{DAMPER}{SECOND}"), &path("zero"), Existing::Refuse);
    assert!(zero.energy.residual_relative.abs() < 1e-6, "{}", zero.energy.residual_relative);
}

/// A wall that a stage lets go after a while was gone at once where the run had been interrupted before, whether the stage moves it or not.
#[test]
fn a_gate_that_has_yet_to_open_stays_shut() {
    let silo = SILO.replace("count = 120", "count = 20");
    let fill = "[[stage]]\nname = \"fill\"\nuntil.inserted = 20\nat-most = \"40 ms\"\n";
    let open = "[[stage]]\nname = \"open\"\nduration = \"60 ms\"\n[stage.set]\nwalls.floor.until = \"40 ms\"\n";
    let moved =
        "walls.floor.motion = { direction = \"z\", signal.sine = { amplitude = \"0.1 mm\", frequency = \"20 Hz\" } }\n";
    for motion in ["", moved] {
        let desk = tempfile::tempdir().unwrap();
        let path = |name: &str| desk.path().join(name);
        let text = format!("{silo}{fill}{open}{motion}");
        let whole = go(&text, &path("whole"), Existing::Refuse);
        // Ten milliseconds after the stage has begun, in shares of the longest time that the stages may take.
        let stopped = cut(&text, &path("cut"), Existing::Refuse, 0.5);
        assert_eq!(stopped.stages.len(), 1, "{:?}", stopped.stages);
        assert_eq!(go(&text, &path("cut"), Existing::Resume).state_hash, whole.state_hash, "{motion}");
        // Whoever starts from there waits as long.
        let short = format!("{silo}{fill}{}{motion}", open.replace("60 ms", "20 ms"));
        go(&short, &path("short"), Existing::Refuse);
        let both = format!("{short}[[stage]]\nname = \"on\"\nduration = \"40 ms\"\n");
        let gate = "floor = { material = \"glass\", until = \"40 ms\", shape.plane = {} }";
        let mut set = silo.replace("floor = { material = \"glass\", shape.plane = {} }", gate);
        if !motion.is_empty() {
            let motion = motion.trim_end().trim_start_matches("walls.floor.");
            set = set.replace("until = \"40 ms\", shape", &format!("until = \"40 ms\", {motion}, shape"));
        }
        let next = format!("start-from = {:?}\n{set}[[stage]]\nname = \"on\"\nduration = \"40 ms\"\n", path("short"));
        let hash = go(&both, &path("both"), Existing::Refuse).state_hash;
        assert_eq!(go(&next, &path("next"), Existing::Refuse).state_hash, hash, "{motion}");
    }
}
