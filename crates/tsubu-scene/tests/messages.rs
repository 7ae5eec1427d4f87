use crate::{GOOD, complaint, edited, read};
use std::fs;
use std::path::Path;
use tsubu_scene::Scene;
use tsubu_scene::plan::Signal;

/// The message about the good scene with one piece replaced.
fn about(from: &str, to: &str) -> String {
    complaint(&edited(from, to), &[])
}

/// The message about a scene whose base follows `motion.csv` with the given content.
fn about_table(csv: Option<&str>) -> String {
    let folder = tempfile::tempdir().expect("a temporary folder");
    if let Some(csv) = csv {
        fs::write(folder.path().join("motion.csv"), csv).expect("written");
    }
    let text = edited(
        "base.sine = { amplitude = \"0.5 mm\", frequency = \"6 Hz\" }",
        "base.table = { file = \"motion.csv\" }",
    );
    Scene::parse("scene.toml", &text, folder.path(), &[]).expect_err("the table is wrong").to_string()
}

const AT: &str = "mass = \"0.2 g\"\nstart.at = { position = [[0, \"10 mm\"], [0, \"14 mm\"], [0, \"30 mm\"]] }";

#[test]
fn misspelt_key() {
    insta::assert_snapshot!(about("restitution", "restituion"));
}

#[test]
fn key_in_the_wrong_table() {
    insta::assert_snapshot!(about("count = 20", "count = 20\nfriction = 0.5"));
}

#[test]
fn wrong_unit() {
    insta::assert_snapshot!(about("\"6 mm\"", "\"6 kg\""));
}

#[test]
fn unknown_unit() {
    insta::assert_snapshot!(about("\"6 mm\"", "\"6 mn\""));
}

#[test]
fn missing_unit() {
    insta::assert_snapshot!(about("\"6 mm\"", "\"6\""));
}

#[test]
fn ambiguous_unit() {
    insta::assert_snapshot!(about("0.08 N s/m", "0.08 kg m/s m"));
}

#[test]
fn negative_mass() {
    insta::assert_snapshot!(about("\"0.2 g\"", "\"-0.2 g\""));
}

#[test]
fn restitution_above_one() {
    insta::assert_snapshot!(about("0.75", "1.2"));
}

#[test]
fn missing_keys() {
    insta::assert_snapshot!(about("diameter = \"6 mm\"\nmass = \"0.2 g\"", ""));
}

#[test]
fn mass_not_known() {
    insta::assert_snapshot!(about("mass = \"0.2 g\"", ""));
}

#[test]
fn overlapping_balls() {
    insta::assert_snapshot!(complaint(&edited("mass = \"0.2 g\"", AT).replace("count = 20\n", ""), &[]));
}

#[test]
fn ball_outside_the_box() {
    let text = edited("mass = \"0.2 g\"", AT).replace("count = 20\n", "").replace("\"30 mm\"", "\"300 mm\"");
    insta::assert_snapshot!(complaint(&text.replace("\"14 mm\"", "\"20 mm\""), &[]));
}

#[test]
fn count_is_not_the_number_of_positions() {
    insta::assert_snapshot!(complaint(&edited("mass = \"0.2 g\"", AT).replace("\"14 mm\"", "\"20 mm\""), &[]));
}

#[test]
fn more_balls_than_fit() {
    insta::assert_snapshot!(about("count = 20", "count = 161"));
}

#[test]
fn no_box_to_start_in() {
    insta::assert_snapshot!(about("shape.box = { width = \"60 mm\", height = \"96 mm\" }", "shape.plane = {}"));
}

#[test]
fn unknown_material() {
    insta::assert_snapshot!(about("\"acrylic\"\ncount", "\"acryllic\"\ncount"));
}

#[test]
fn host_and_motion() {
    let motion = "host = \"spring\"\nmotion.signal.sine = { amplitude = 0.01, frequency = 6 }";
    insta::assert_snapshot!(about("host = \"spring\"", motion));
}

#[test]
fn choice_with_two_variants() {
    insta::assert_snapshot!(complaint(
        &format!("{GOOD}\n[contact]\ndamping.quarter = {{}}\ndamping.linear = {{}}\n"),
        &[]
    ));
}

#[test]
fn choice_with_unknown_variant() {
    insta::assert_snapshot!(complaint(&format!("{GOOD}\n[contact]\nnormal.herz = {{}}\n"), &[]));
}

#[test]
fn choice_as_text() {
    insta::assert_snapshot!(complaint(&format!("{GOOD}\n[contact]\nnormal = \"hertz\"\n"), &[]));
}

#[test]
fn unknown_word() {
    insta::assert_snapshot!(complaint(&format!("method = \"lattic\"\n{GOOD}"), &[]));
}

#[test]
fn plane_vector_in_space() {
    let text = edited("height = \"96 mm\"", "height = \"96 mm\", depth = \"6 mm\", floor-centre = [0, 0]");
    insta::assert_snapshot!(complaint(&format!("dimension = 3\n{text}"), &[]));
}

#[test]
fn matrix_without_energy() {
    let structure =
        "structure.matrices = { mass = [[1, 0], [0, 1]], damping = [[0, 0], [1, 0]], stiffness = [[1, -1], [-1, 1]] }";
    let typed = "structure.oscillator = { mass = \"86 g\", stiffness = \"123.4 N/m\", damping = \"0.08 N s/m\" }";
    insta::assert_snapshot!(about(typed, structure));
}

#[test]
fn response_without_a_sine() {
    let text = edited("base.sine = { amplitude = \"0.5 mm\", frequency = \"6 Hz\" }", "displacement = \"1 mm\"");
    insta::assert_snapshot!(complaint(&format!("{text}\n[response]\nfrequency-ratio = [1]\n"), &[]));
}

#[test]
fn varied_values_that_the_scene_does_not_take() {
    let sweep = r#"
[sweep.vary]
"particles.balls.count" = [10, 1000]
"particles.balls.diametre" = ["5 mm"]
"materials.acrylic.friction" = ["0.5 mm"]
"#;
    insta::assert_snapshot!(complaint(&format!("{GOOD}{sweep}"), &[]));
}

/// What the scene says of keys that are varied is nothing that a study runs: here its balls would not fit into the lower box. A value
/// that no other goes with is refused all the same, and so is one that is there twice.
#[test]
fn values_are_tried_beside_those_of_a_study() {
    let study = |counts: &str, heights: &str| {
        format!(
            "{GOOD}[sweep.vary]\n\"particles.balls.count\" = {counts}\n\"walls.box.shape.box.height\" = {heights}\n"
        )
    };
    let read = |text: &str| read(text, &[]).map_err(|wrong| wrong.to_string());
    assert!(read(&study("[4, 8]", "[\"8 mm\", \"60 mm\"]")).is_ok());
    let told = read(&study("[40, 60]", "[\"8 mm\"]")).expect_err("they do not fit");
    assert!(told.contains("cannot vary `walls.box.shape.box.height"), "{told}");
    let told = read(&study("[4, 8, 4]", "[\"60 mm\"]")).expect_err("4 is there twice");
    assert!(told.contains("is varied with 4 twice"), "{told}");
}

#[test]
fn ranges_that_are_none() {
    let sweep = r#"
[sweep.vary]
"particles.balls.count" = { from = 10, to = 30 }
"particles.balls.diameter" = { from = "5 mm", to = "1 cm", step = "1 mm" }
"materials.acrylic.friction" = { from = 0.5, to = 0.1, step = 0.1 }
"#;
    insta::assert_snapshot!(complaint(&format!("{GOOD}{sweep}"), &[]));
}

#[test]
fn a_design_needs_what_its_limits_count() {
    let design = r#"
[response]
frequency-ratio = { from = 0.9, to = 1.1 }
[design]
space-limit = "0.5 kg"
cost-limit = 12
cost = { steel = { per-kilogram = 3 } }
vary = { "particles.balls.count" = { from = 10, to = 20, step = 5 } }
"#;
    insta::assert_snapshot!(complaint(&format!("{GOOD}{design}"), &[]));
    insta::assert_snapshot!(complaint(&format!("{GOOD}{}", design.replace("kg\"", "L\"")), &[]));
}

/// What is no rotor: G that is not skew, or of another size; a spin without G; a base that would tilt it. Without a base it is one.
#[test]
fn a_rotor_needs_a_skew_matrix() {
    let base = "base.sine = { amplitude = 0.001, frequency = 3 }";
    let rotor = |gyroscopic: &str, base: &str| {
        let text = format!(
            "duration = 1\nmaterials.m = {{ young-modulus = 1e7, friction = 0.3 }}\n[particles.b]\nmaterial = \"m\"\ndiameter = 0.004\n\
             mass = 0.001\nstart.at.position = [[0, 0.1]]\n[hosts.rotor]\n{base}\nstructure.matrices = {{ mass = [[2, 0], [0, 2]], \
             damping = [[1, 0], [0, 1]], stiffness = [[9, 0], [0, 9]], {gyroscopic}, coordinate = 1 }}\n"
        );
        read(&text, &[]).map_err(|complaints| complaints.to_string())
    };
    for (gyroscopic, said) in [
        ("speed = 3, gyroscopic = [[0, 0.5], [0.5, 0]]", "is not skew"),
        ("speed = 3, gyroscopic = [[0.1, 0.5], [-0.5, 0]]", "row 1, column 1"),
        ("speed = 3, gyroscopic = [[0]]", "another size than `mass`"),
        ("speed = 3", "spins, but has no `gyroscopic` matrix"),
    ] {
        let told = rotor(gyroscopic, "").expect_err("no rotor");
        assert!(told.contains(said), "{told}");
    }
    let right = "speed = 3, gyroscopic = [[0, 0.5], [-0.5, 0]]";
    assert!(rotor(right, base).expect_err("its base tilts it").contains("a base shifts a rotor"));
    assert!(rotor(&format!("{right}, participation = [0, 0]"), base).is_ok());
    rotor(right, "").unwrap_or_else(|complaints| panic!("{complaints}"));
}

#[test]
fn varied_key_without_quotes() {
    insta::assert_snapshot!(complaint(&format!("{GOOD}\n[sweep.vary]\nparticles.balls.count = [10]\n"), &[]));
}

#[test]
fn claim_without_bounds() {
    insta::assert_snapshot!(complaint(&format!("{GOOD}\n[[claim]]\nresult = \"peak\"\nsource = \"theory\"\n"), &[]));
}

#[test]
fn unreadable_table() {
    insta::assert_snapshot!(about_table(None));
}

#[test]
fn not_a_number_in_a_table() {
    insta::assert_snapshot!(about_table(Some("time [s],displacement [mm]\n0.0,0.0\n0.1,NaN\n0.2,0.5\n")));
}

#[test]
fn words_and_falling_time_in_a_table() {
    insta::assert_snapshot!(about_table(Some("time,value\n0.0,0.0\n0.2,lots\n0.3,1\n0.1,1\n0.4,1,2\n")));
}

#[test]
fn wrong_unit_in_the_header_of_a_table() {
    insta::assert_snapshot!(about_table(Some("time [s],force [N]\n0.0,0.0\n0.2,1\n")));
}

/// Units in round brackets, in names and in comments were passed over: milliseconds and millimetres were read as seconds
/// and metres, wrong by a thousand.
#[test]
fn units_in_the_header_of_a_table_are_never_passed_over() {
    let rows = "0,0\n100,1\n";
    let folder = tempfile::tempdir().expect("a temporary folder");
    let text = edited(
        "base.sine = { amplitude = \"0.5 mm\", frequency = \"6 Hz\" }",
        "base.table = { file = \"motion.csv\" }",
    );
    for head in ["time [ms],value [mm]", "time (ms),value (mm)", "\"t (ms)\",\"base (mm)\""] {
        fs::write(folder.path().join("motion.csv"), format!("{head}\n{rows}")).expect("written");
        let scene = Scene::parse("scene.toml", &text, folder.path(), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
        let base = scene.plan().hosts["spring"].base.clone();
        let Some(Signal::Table { time, value }) = base else { panic!("a table") };
        assert_eq!((time, value), (vec![0.0, 0.1], vec![0.0, 0.001]), "{head}");
    }
    let heads = [
        "time [s],value [mm",
        "time [s],value mm]",
        "time [ms] of,value",
        "time [s],value (mm) up",
        "time,value_mm",
        "time/ms,value",
        "value,time",
        "# time [ms],value [mm]",
    ];
    insta::assert_snapshot!(heads.map(|head| about_table(Some(&format!("{head}\n{rows}")))).join("\n\n"));
}

#[test]
fn several_errors_at_once() {
    let text = GOOD
        .replace("duration", "durration")
        .replace("\"0.2 g\"", "\"-0.2 g\"")
        .replace("material = \"glass\"", "material = \"glas\"")
        .replace("\"123.4 N/m\"", "\"123.4 N\"");
    insta::assert_snapshot!(complaint(&text, &["particles.balls.diameter=6 g"]));
}

#[test]
fn broken_syntax_and_a_wrong_value() {
    insta::assert_snapshot!(about("count = 20\ndiameter = \"6 mm\"", "count = \ndiameter = \"6 kg\"\nmass = = 3"));
}

#[test]
fn bad_changes() {
    let changes =
        ["particles.balls.count", "particles.bals.count=3", "contact.damping.quart={}", "=3", "dem.skin=", "seed={"];
    insta::assert_snapshot!(complaint(GOOD, &changes));
}

#[test]
fn a_change_out_of_range() {
    insta::assert_snapshot!(complaint(GOOD, &["particles.balls.mass = -1 g"]));
}

#[test]
fn missing_scene_file() {
    insta::assert_snapshot!(Scene::read(Path::new("no-such-scene.toml"), &[]).expect_err("there is none"));
}

#[test]
fn scene_file_that_is_no_text() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("scene.toml");
    fs::write(&path, b"title = \"a\"\n\xff\xfe").expect("written");
    let message = Scene::read(&path, &[]).expect_err("not text").to_string();
    insta::assert_snapshot!(message.replace(&path.display().to_string(), "scene.toml"));
}

#[test]
fn a_forgotten_unit_makes_giants() {
    insta::assert_snapshot!(about("\"6 mm\"", "6"));
}

#[test]
fn a_fraction_of_a_ball() {
    insta::assert_snapshot!(about("count = 20", "count = 20.5"));
}

#[test]
fn an_empty_scene_says_what_it_needs() {
    insta::assert_snapshot!(complaint("", &[]));
}

#[test]
fn colours_only_when_asked_for() {
    let complaints = read("", &[]).expect_err("empty");
    assert!(!complaints.render(false).contains('\u{1b}'));
    assert!(complaints.render(true).contains('\u{1b}'));
}
