//! Structures that come from files or measures, and what is wrong with them.

use std::fs;
use std::path::Path;
use tsubu_scene::Scene;
use tsubu_scene::plan::Structure;

const GOOD: &str = r#"
method = "dem"
dimension = 3
duration = "1 s"
[materials.steel]
young-modulus = "1 GPa"
poisson-ratio = 0.3
restitution = 0.8
friction = 0.3
[particles.ball]
material = "steel"
diameter = "4 mm"
mass = "1 g"
start.at = { position = [[0, 0, "5 mm"]] }
[walls.cavity]
material = "steel"
host = "frame"
interface = "tip"
shape.box = { width = "20 mm", height = "20 mm", depth = "20 mm" }
[hosts.frame]
"#;

const TABLE: &str = "frequency [Hz], damping ratio, tip z [1/sqrt(kg)], tip ry\n20, 0.01, 2, 0.5\n120, 0.01, -2, 9\n";

fn read(folder: &Path, host: &str) -> Result<Scene, String> {
    Scene::parse("scene.toml", &format!("{GOOD}{host}\n"), folder, &[]).map_err(|complaints| complaints.to_string())
}

/// A table of modes in other units is the same structure: kHz, and vectors of a program that counts in tonnes.
#[test]
fn a_table_of_modes_is_read_with_its_units() {
    let desk = tempfile::tempdir().expect("a folder of its own");
    let host = "structure.modal-table.file = \"modes.csv\"\ninterface.tip.point = [0, 0, 0]";
    let mut plans = Vec::new();
    let root = 1000.0_f64.sqrt();
    let tonnes = format!(
        "frequency [kHz];damping ratio [%];tip ry [rad/m 1/sqrt(t)];tip z [1/sqrt(t)]\n0.02;1;{};{}\n0.12;1;{};{}\n",
        0.5 * root,
        2.0 * root,
        9.0 * root,
        -2.0 * root
    );
    for text in [TABLE, &tonnes] {
        fs::write(desk.path().join("modes.csv"), text).expect("a folder of its own");
        plans.push(read(desk.path(), host).unwrap_or_else(|wrong| panic!("{wrong}")).plan().hosts["frame"].clone());
    }
    let Structure::Modes { mode } = &plans[0].structure else { panic!("modes") };
    assert_eq!((mode[1].frequency, mode[1].damping_ratio, mode[1].mass), (120.0, 0.01, 1.0));
    for (a, b) in plans[0].interface["tip"].translation.iter().zip(&plans[1].interface["tip"].translation) {
        assert!((a[2] - b[2]).abs() < 1e-12 && a[0] == 0.0, "{a:?} {b:?}");
    }
    assert!((plans[1].interface["tip"].rotation[1][1] - 9.0).abs() < 1e-12);
    assert_eq!(plans[0].at.as_deref(), Some("tip"));
}

/// Each wrong structure is refused with its file, line and value.
#[test]
fn structures_that_cannot_be() {
    let desk = tempfile::tempdir().expect("a folder of its own");
    let tip = "\ninterface.tip.point = [0, 0, 0]";
    let table = |text: &str, rest: &str| {
        fs::write(desk.path().join("modes.csv"), text).expect("a folder of its own");
        read(desk.path(), &format!("structure.modal-table.file = \"modes.csv\"{rest}")).err()
    };
    let matrices = |stiffness: &str| {
        for (name, text) in [("m.mtx", "1 1 2\n2 2 1\n"), ("c.mtx", "1 1 0.1\n2 2 0.1\n"), ("k.mtx", stiffness)] {
            let lines = text.lines().count();
            let text = format!("%%MatrixMarket matrix coordinate real general\n2 2 {lines}\n{text}");
            fs::write(desk.path().join(name), text).expect("a folder of its own");
        }
        let files = "structure.matrix-files = { mass = \"m.mtx\", damping = \"c.mtx\", stiffness = \"k.mtx\", units = \"m-kg-s\" }";
        read(desk.path(), &format!("{files}{tip}\ninterface.tip.translation = [[0, 0, 1], [0, 0, 0]]")).err()
    };
    let host = |text: &str| read(desk.path(), text).err();
    let beam = "structure.beam = { length = \"0.3 m\", section.round.diameter = \"5 mm\", young-modulus = \"70 GPa\", density = \"2700 kg/m^3\", damping-ratio = 0.01";
    let wrong = [
        table(&TABLE.replace("\n20,", "\n200,"), tip),
        table(&TABLE.replace("120, 0.01, -2, 9", "120, 0.01, -2"), tip),
        table(&TABLE.replace("120,", "-120,"), tip),
        table(&TABLE.replace("tip z [1/sqrt(kg)]", "tip z [mm]"), tip),
        table(&TABLE.replace("tip ry", "tilt"), tip),
        table(&TABLE.replace("damping ratio", "mass [g]"), tip),
        table(&TABLE.replace(", 2,", ", 2e7,"), tip),
        table(&TABLE.replace("tip ry", "tip z"), tip),
        table(TABLE, &format!("{tip}\nbase.sine = {{ amplitude = \"1 mm\", frequency = \"20 Hz\" }}")),
        table(TABLE, ""),
        matrices("1 1 300\n1 2 -100\n2 1 -90\n2 2 100\n"),
        matrices("1 1 100\n1 2 -100\n2 1 -100\n2 2 100\n"),
        matrices("1 1 300\n3 1 100\n"),
        host(&format!("{beam} }}\ninterface.tip.along = \"0.4 m\"")),
        host(&format!("{beam} }}\ninterface.tip.point = [0, 0, 0]")),
        host(&format!("{beam}, axis = \"z\" }}\ninterface.tip.along = \"0.2 m\"")),
        host(&format!("{beam} }}\ninterface.end.along = \"0.2 m\"")),
        host(&format!(
            "structure.oscillator = {{ mass = 1, stiffness = 100, damping = 0 }}{tip}\ninterface.tip.translation = [[0, 0, 1], [1, 0, 0]]"
        )),
        host("structure.pendulum = { mass = 2, centre = 0.5, inertia = 0.1, arm = 0.5 }"),
    ];
    let told: Vec<String> = wrong
        .into_iter()
        .enumerate()
        .map(|(i, wrong)| wrong.unwrap_or_else(|| panic!("number {i} is not refused")))
        .collect();
    insta::assert_snapshot!(told.join("\n\n"));
}

/// A scene written out in full says of every host that it begins at 0, and that was refused of a shaker: no run of one could be run
/// again from its folder, or be started from.
#[test]
fn a_shaker_written_out_is_read_again() {
    let host = "structure.shaker = {}\nbase.sine = { amplitude = \"1 mm\", frequency = \"30 Hz\" }";
    let text = format!("{}{host}\n", GOOD.replace("interface = \"tip\"\n", ""));
    let read = |text: &str| Scene::parse("scene.toml", text, Path::new("."), &[]);
    let written = read(&text).expect("a scene").resolved_toml();
    assert!(written.contains("displacement = 0"), "{written}");
    assert_eq!(read(&written).expect("the same scene").resolved_toml(), written);
    assert!(read(&written.replace("displacement = 0.0", "displacement = 0.1")).is_err());
}

/// A shaker is where its base is, and an atlas shakes walls along a line: what has no effect, or cannot be, is refused.
#[test]
fn shakers_and_atlases_that_cannot_be() {
    let along = GOOD.replace("interface = \"tip\"\n", "");
    let refused = |host: &str, rest: &str| {
        let text = format!("{along}{host}\n{rest}");
        Scene::parse("scene.toml", &text, Path::new("."), &[]).map_err(|complaints| complaints.to_string()).err()
    };
    let staged = |host: &str, rest: &str| {
        let text = format!("{}{host}\n{rest}", along.replace("duration = \"1 s\"\n", ""));
        Scene::parse("scene.toml", &text, Path::new("."), &[]).map_err(|complaints| complaints.to_string()).err()
    };
    let shaker = "structure.shaker = {}\nbase.sine = { acceleration = \"2 g\", frequency = \"30 Hz\" }";
    let asked = "[atlas]\nfrequency = [\"20 Hz\", \"40 Hz\"]\nacceleration = [\"0.1 g\", \"3 g\"]\n";
    assert_eq!(refused(shaker, asked), None);
    let stages = "[[stage]]\nname = \"one\"\nduration = \"1 s\"\n[[stage]]\nname = \"two\"\nduration = \"1 s\"\n\
                  set = { \"hosts.frame.base.sine.acceleration\" = \"3 g\" }\n";
    let wrong = [
        refused("structure.shaker = {}\nforce.sine = { amplitude = 1, frequency = 30 }\nvelocity = 1", ""),
        staged(shaker, stages),
        refused(shaker, &asked.replace("[\"20 Hz\", \"40 Hz\"]", "[\"40 Hz\", \"20 Hz\"]").replace("0.1 g", "0 g")),
        refused("structure.pendulum = { mass = 2, centre = 0.5, inertia = 1, arm = 0.5 }", asked),
        refused(&format!("{shaker}\n[hosts.other]\n{shaker}"), &asked.replace("[atlas]", "[atlas]\nhost = \"other\"")),
        refused(&format!("{shaker}\n[hosts.other]\n{shaker}"), asked),
    ];
    let told: Vec<String> = wrong
        .into_iter()
        .enumerate()
        .map(|(i, wrong)| wrong.unwrap_or_else(|| panic!("number {i} is not refused")))
        .collect();
    insta::assert_snapshot!(told.join("\n\n"));
}
