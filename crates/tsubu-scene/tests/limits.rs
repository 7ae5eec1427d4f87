//! What is too long, too large or no file at all: said at once, and in few words.

use crate::{GOOD, complaint, edited, read};
use std::fmt::Write as _;
use std::time::Instant;
use tsubu_scene::Scene;

/// A grain number beyond the range of the plan was told as "a mistake in tsubu".
#[test]
fn whole_numbers_out_of_range_are_the_users() {
    let watch = format!("{GOOD}[watch.one]\ntrack.ids = [1000000000000000000]\n");
    let hops = format!("{GOOD}[watch.one]\nhops = {{ most = 9223372036854775807 }}\n");
    let all = [
        complaint(&watch, &[]),
        complaint(&hops, &[]),
        complaint(GOOD, &["seed=99999999999999999999999"]),
        complaint(GOOD, &["particles.balls.count=0x7fffffffffffffff"]),
    ];
    for message in &all {
        assert!(!message.contains("mistake in tsubu"), "{message}");
    }
    insta::assert_snapshot!(all.join("\n\n"));
}

/// A watch's name becomes the name of a file; with 300 letters the run failed instead of being refused.
#[test]
fn names_are_as_short_as_names_of_files() {
    let name = "a".repeat(300);
    insta::assert_snapshot!(complaint(&format!("{GOOD}[watch.{name}]\nslope = {{}}\n"), &[]));
    assert!(read(&format!("{GOOD}[watch.{}]\nslope = {{}}\n", "a".repeat(120)), &[]).is_ok());
    for table in ["materials", "particles", "walls", "hosts", "removal"] {
        let text = complaint(&format!("{GOOD}[{table}.{name}]\n"), &[]);
        assert!(text.contains("is too long"), "{text}");
    }
}

/// A string of a megabyte was echoed whole, and so was a number of 300 digits.
#[test]
fn messages_stay_short() {
    let long = ["x".repeat(300_000), "two words ".repeat(30_000), "9".repeat(300_000), "é".repeat(150_000)];
    for typed in &long {
        for (from, to) in [
            ("\"6 mm\"", format!("\"{typed}\"")),
            ("\"6 mm\"", format!("\"1{typed}\"")),
            ("material = \"acrylic\"", format!("material = \"{typed}\"")),
            ("count = 20", format!("\"{typed}\" = 1")),
            ("[materials.glass]", format!("[materials.\"{typed}\"]")),
            ("title = ", format!("title = [\"{typed}\"]\nold = ")),
            ("title = ", format!("method = \"{typed}\"\ntitle = ")),
        ] {
            let message = complaint(&edited(from, &to), &[]);
            assert!(message.len() < 12_000, "{} bytes", message.len());
        }
        let message = complaint(GOOD, &[&format!("title.{typed}=1"), typed, &format!("duration={typed}")]);
        assert!(message.len() < 12_000, "{} bytes: {message}", message.len());
    }
    insta::assert_snapshot!(complaint(GOOD, &["particles.balls.diameter=1e300", "materials.glass.density=1e-300 kg"]));
}

/// Opening a pipe waited for ever for somebody to write to it.
#[cfg(unix)]
#[test]
fn only_files_are_read() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let pipe = folder.path().join("pipe");
    for ending in ["", ".csv", ".xyz", ".data", ".stl", ".obj"] {
        let made = std::process::Command::new("mkfifo").arg(format!("{}{ending}", pipe.display())).status();
        assert!(made.expect("mkfifo runs").success());
    }
    std::os::unix::fs::symlink("/dev/zero", folder.path().join("zero.obj")).expect("linked");
    let about = |path: &str| {
        let text = Scene::read(&folder.path().join(path), &[]).expect_err("no file").to_string();
        text.replace(&folder.path().display().to_string(), "FOLDER")
    };
    let mut all = vec![about("pipe"), about("zero.obj"), about("")];
    let table = "base.sine = { amplitude = \"0.5 mm\", frequency = \"6 Hz\" }";
    let grains =
        edited("mass = \"0.2 g\"", "mass = \"0.2 g\"\nstart.file.path = \"pipe.ENDING\"").replace("count = 20", "");
    let mesh =
        edited("shape.box = { width = \"60 mm\", height = \"96 mm\" }", "shape.mesh = { path = \"pipe.ENDING\" }");
    let texts = [
        edited(table, "base.table = { file = \"pipe.csv\" }"),
        grains.replace("ENDING", "csv"),
        grains.replace("ENDING", "xyz"),
        grains.replace("ENDING", "data"),
        mesh.replace("ENDING", "stl"),
        mesh.replace("ENDING", "obj"),
        mesh.replace("pipe.ENDING", "zero.obj"),
    ];
    for text in texts {
        let wrong = Scene::parse("scene.toml", &text, folder.path(), &[]).expect_err("no file").to_string();
        all.push(wrong.split("\n\n").find(|one| one.contains("cannot read")).expect("unreadable").to_string());
    }
    insta::assert_snapshot!(all.join("\n\n"));
}

/// Every pair of materials was looked for in a list of all: twenty seconds for a file that is only long.
#[test]
fn twenty_thousand_materials_are_a_matter_of_a_moment() {
    let mut text = GOOD.to_string();
    for i in 0..20_000 {
        let _ = write!(text, "[materials.m{i}]\nyoung-modulus = 1e9\n");
    }
    let begin = Instant::now();
    let scene = read(&text, &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    assert_eq!(scene.plan().materials.len(), 20_002);
    // Generous: other tests run at the same time.
    assert!(begin.elapsed().as_secs_f64() < 5.0, "{:?}", begin.elapsed());
    let begin = Instant::now();
    assert!(complaint(&text.replace("\"acrylic\"\ncount", "\"acryllic\"\ncount"), &[]).len() < 5000);
    assert!(begin.elapsed().as_secs_f64() < 5.0, "{:?}", begin.elapsed());
}

/// Numbers that nothing can have were accepted, and were squared and divided into infinities and endless counting.
#[test]
fn numbers_that_nothing_can_have_are_refused() {
    let changes = [
        "gravity=1e300",
        "duration=1e300",
        "materials.acrylic.restitution=1e-300",
        "materials.acrylic.young-modulus=1e-300",
        "particles.balls.mass=1e-30 g",
        "walls.box.shape.box.width=1e300 m",
        "dem.time-step=1e-300",
        "hosts.spring.base.sine.frequency=1e30 Hz",
    ];
    insta::assert_snapshot!(complaint(GOOD, &changes));
    // What comes out near zero is no slip, and neither is a number that is large or small.
    for change in ["hosts.spring.displacement=1e-30", "gravity=0", "materials.acrylic.friction=1e6", "duration=1e9"] {
        assert!(read(GOOD, &[change]).is_ok(), "{change}");
    }
}

/// `output.history-interval=1e-14` was counted up one by one, for ever.
#[test]
fn outputs_have_an_end() {
    let watch = format!("{GOOD}[watch.load]\nevery = 1e-14\nwall-load.wall = \"box\"\n");
    let intervals = ["history", "frame", "checkpoint"].map(|what| format!("output.{what}-interval=1e-14"));
    insta::assert_snapshot!(complaint(&watch, &intervals.each_ref().map(String::as_str)));
    assert!(read(GOOD, &["output.history-interval=1e-7"]).is_ok());
    // A change of the duration alone keeps what follows from it.
    assert!(read(GOOD, &["duration=1e10"]).is_ok());
}

/// What follows from other values had no limits: a run of 1e-13 s was accepted, its rows follow each other in 1e-16 s, and the
/// resolved scene in the run folder was refused. The same for the mass of a tiny grain.
#[test]
fn what_follows_is_held_to_the_limits_of_its_key() {
    let light = edited("mass = \"0.2 g\"\n", "").replace("\"6 mm\"", "1e-11");
    let light = light.replace("[materials.acrylic]", "[materials.acrylic]\ndensity = 1000");
    insta::assert_snapshot!([complaint(GOOD, &["duration=1e-13"]), complaint(&light, &[])].join("\n\n"));
}

/// The resolved scene had the mass of a grain written out, so that in a sweep over diameters all grains had one mass and many
/// densities; it was refused where they became lighter than water.
#[test]
fn what_follows_from_what_a_study_varies_is_left_to_follow() {
    let text = edited("mass = \"0.2 g\"\n", "").replace("[materials.acrylic]", "[materials.acrylic]\ndensity = 1190")
        + "[sweep.vary]\n\"particles.balls.diameter\" = [5e-3, 6e-3]\n";
    let scene = read(&text, &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    let again = read(&scene.resolved_toml(), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    assert_eq!((again.plan(), again.resolved_toml()), (scene.plan(), scene.resolved_toml()));
    let case = |scene: &Scene| scene.with(&[("particles.balls.diameter", &toml::Value::Float(5e-3))]).expect("a case");
    assert_eq!(case(&again).plan().particles["balls"].mass, case(&scene).plan().particles["balls"].mass);
    // What is typed, and what nothing varied leads to, stays written out.
    let typed = read(&format!("{GOOD}[sweep.vary]\n\"particles.balls.diameter\" = [5e-3]\n"), &[]).expect("good");
    assert!(typed.resolved_toml().contains("mass = ") && again.resolved_toml().contains("history-interval = "));
}
