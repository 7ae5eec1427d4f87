use crate::{GOOD, complaint, edited, read};
use std::fs;
use tsubu_scene::Scene;
use tsubu_scene::plan::*;

fn plan(text: &str) -> Plan {
    read(text, &[]).unwrap_or_else(|complaints| panic!("{complaints}")).plan().clone()
}

#[test]
fn defaults_are_the_documented_ones() {
    let plan = plan(GOOD);
    assert_eq!(plan.method, Method::Dem);
    assert_eq!((plan.dimension, plan.seed), (2, 1));
    assert_eq!(plan.gravity, [0.0, 0.0, -10.0]);
    assert_eq!(plan.speed_scale, None);
    assert_eq!(plan.materials["acrylic"].friction, 0.5);
    assert_eq!(plan.particles["balls"].start, Start::Settled { time: 1.0 });
    assert_eq!(plan.contact.normal, Normal::Hertz {});
    assert_eq!(plan.contact.damping, Damping::Quarter {});
    assert_eq!(plan.contact.tangential, Tangential::Mindlin { form: MindlinForm::Incremental, damping: None });
    assert_eq!(plan.contact.rolling, Rolling::None {});
    assert!(plan.contact.rotation && !plan.contact.attraction);
    assert_eq!(plan.dem.time_step, None);
    assert_eq!(plan.dem.integrator, Integrator::VelocityVerlet);
    assert_eq!(plan.lattice.time_step, 1e-4);
    assert!(plan.lattice.resting_impulses);
    assert_eq!(plan.output.history_interval, 1e-3);
    assert_eq!(plan.output.checkpoint_interval, 0.1);
    assert_eq!(plan.output.frame_interval, None);
    assert_eq!(plan.response, None);
}

#[test]
fn gravity_is_downward_or_a_vector() {
    assert_eq!(plan(&edited("gravity = \"10 m/s^2\"", "")).gravity, [0.0, 0.0, -9.8]);
    assert_eq!(plan(&edited("\"10 m/s^2\"", "[\"1 m/s^2\", -2]")).gravity, [1.0, 0.0, -2.0]);
    let none = plan(&edited("\"10 m/s^2\"", "0")).gravity;
    assert_eq!(none.map(f64::to_bits), [0; 3], "no gravity is a plain zero");
}

#[test]
fn masses_follow_from_densities() {
    let plan = plan(&edited("material = \"acrylic\"", "material = \"glass\"").replace("mass = \"0.2 g\"", ""));
    let sphere = std::f64::consts::PI / 6.0 * 0.006_f64.powi(3);
    assert!((plan.particles["balls"].mass / (2500.0 * sphere) - 1.0).abs() < 1e-14);
}

#[test]
fn damping_ratio_becomes_damping() {
    let plan = plan(&edited("damping = \"0.08 N s/m\"", "damping-ratio = 0.0122787"));
    let Structure::Oscillator { damping, .. } = plan.hosts["spring"].structure else { panic!("an oscillator") };
    assert!((damping - 0.08).abs() < 1e-6, "{damping}");
}

#[test]
fn directions_are_axes_or_vectors_of_any_length() {
    let direction = |text: &str| {
        let host = format!("direction = {text}\nbase.sine");
        plan(&edited("base.sine", &host)).hosts["spring"].direction
    };
    assert_eq!(direction("\"-x\""), [-1.0, 0.0, 0.0]);
    assert_eq!(direction("\"z\""), [0.0, 0.0, 1.0]);
    assert_eq!(direction("[3, 4]"), [0.6, 0.0, 0.8]);
    assert_eq!(direction("[0, -1e200]"), [0.0, 0.0, -1.0]);
}

#[test]
fn positions_set_the_count_and_spins_are_about_y() {
    let at = "start.at = { position = [[0, \"10 mm\"], [\"1 cm\", 0.02]], velocity = [[1, 0], [0, \"5 mm/s\"]], spin = [\"60 rpm\", -1] }";
    let plan = plan(&edited("count = 20", at));
    let balls = &plan.particles["balls"];
    assert_eq!(balls.count, 2);
    let Start::At { position, velocity, spin } = &balls.start else { panic!("placed") };
    assert_eq!(position[1], [0.01, 0.0, 0.02]);
    assert_eq!(velocity[1], [0.0, 0.0, 0.005]);
    assert_eq!(spin[1], [0.0, -1.0, 0.0]);
}

#[test]
fn a_box_may_be_empty_and_full() {
    assert_eq!(plan(&edited("count = 20", "count = 0")).particles["balls"].count, 0);
    assert_eq!(plan(&edited("count = 20", "count = 160")).particles["balls"].count, 160);
    assert!(read(&edited("count = 20", "count = 161"), &[]).is_err());
}

#[test]
fn touching_grains_may_overlap_a_little() {
    let at = |x: &str| edited("count = 20", &format!("start.at = {{ position = [[0, 0.01], [{x}, 0.01]] }}"));
    assert!(read(&at("0.005995"), &[]).is_ok());
    assert!(read(&at("0.00599"), &[]).is_err());
}

#[test]
fn literal_lattice_has_no_resting_impulses_unless_asked() {
    let lattice = |more: &str| plan(&format!("{GOOD}\n[lattice]\nmode = \"literal\"\n{more}")).lattice.resting_impulses;
    assert!(!lattice(""));
    assert!(lattice("resting-impulses = true"));
}

#[test]
fn frequency_ratios_are_the_numbers_one_means() {
    let text = format!("{GOOD}\n[response]\nfrequency-ratio = {{ from = 0.85, to = 1.15, step = 0.01 }}\n");
    let response = plan(&text).response.expect("a response");
    assert_eq!(response.host, "spring");
    assert_eq!(response.frequency_ratio.len(), 31);
    assert_eq!(response.frequency_ratio[7], 0.92);
    assert_eq!((response.frequency_ratio[30], response.peak_within), (1.15, None));
}

#[test]
fn automatic_can_be_said() {
    let text = format!("{GOOD}\n[dem]\ntime-step = \"automatic\"\n[output]\nframe-interval = \"none\"\n");
    assert_eq!(plan(&text), plan(GOOD));
}

#[test]
fn a_table_is_read_with_its_units_and_kept_as_numbers() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let csv = "\u{feff}# measured\r\ntime [ms]; displacement [mm]\r\n0; 0\r\n\r\n10; 1.5\r\n";
    fs::write(folder.path().join("motion.csv"), csv).expect("written");
    let text =
        edited("base.sine = { amplitude = \"0.5 mm\", frequency = \"6 Hz\" }", "base.table.file = \"motion.csv\"");
    let scene = Scene::parse("scene.toml", &text, folder.path(), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    let expected = Signal::Table { time: vec![0.0, 0.01], value: vec![0.0, 0.0015] };
    assert_eq!(scene.plan().hosts["spring"].base, Some(expected));

    fs::remove_file(folder.path().join("motion.csv")).expect("removed");
    let again = Scene::parse("run/scene.toml", &scene.resolved_toml(), folder.path(), &[]).expect("needs no file");
    assert_eq!(again.plan(), scene.plan());
    assert!(scene.with(&[("seed", &toml::Value::Integer(2))]).is_ok(), "the file was read once and for all");
}

#[test]
fn a_scene_file_is_read_with_the_files_beside_it() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("push.csv"), "0 0\n0.1   2.5\n").expect("written");
    let text =
        edited("base.sine = { amplitude = \"0.5 mm\", frequency = \"6 Hz\" }", "force.table.file = \"push.csv\"");
    fs::write(folder.path().join("scene.toml"), text).expect("written");
    let scene = Scene::read(&folder.path().join("scene.toml"), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    let expected = Signal::Table { time: vec![0.0, 0.1], value: vec![0.0, 2.5] };
    assert_eq!(scene.plan().hosts["spring"].force, Some(expected));
}

#[test]
fn grains_move_with_a_box_that_begins_displaced() {
    let at = "start.at = { position = [[0, \"-10 mm\"]] }";
    let text = edited("count = 20", at);
    assert!(read(&text, &[]).is_err());
    assert!(read(&text, &["hosts.spring.displacement=-20 mm"]).is_ok());
}

#[test]
fn space_needs_a_depth() {
    let text = format!("dimension = 3\n{GOOD}");
    assert!(read(&text, &[]).expect_err("no depth").to_string().contains("depth"));
    let plan = plan(&text.replace("height = \"96 mm\"", "height = \"96 mm\", depth = \"12 mm\""));
    assert_eq!(plan.dimension, 3);
}

/// A base could be driven by its amplitude alone, and `g` was a gram everywhere.
#[test]
fn a_base_may_be_shaken_by_its_acceleration() {
    let base = |sine: &str| {
        edited("base.sine = { amplitude = \"0.5 mm\", frequency = \"6 Hz\" }", &format!("base.sine = {{ {sine} }}"))
    };
    let scene =
        read(&base("acceleration = \"2 g\", frequency = \"10 Hz\""), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    let Some(Signal::Sine { amplitude, frequency, .. }) = scene.plan().hosts["spring"].base else { panic!("a sine") };
    assert!((amplitude * (std::f64::consts::TAU * frequency).powi(2) - 19.6133).abs() < 1e-12);
    // A change of one takes the place of the other; a change of frequency keeps the acceleration.
    let change = |change: &str| {
        let plan = scene.changed(&[change.to_string()]).unwrap_or_else(|wrong| panic!("{wrong}")).plan().clone();
        let Some(Signal::Sine { amplitude, .. }) = plan.hosts["spring"].base else { panic!("a sine") };
        amplitude
    };
    assert_eq!(change("hosts.spring.base.sine.amplitude=1 mm"), 0.001);
    assert!((change("hosts.spring.base.sine.frequency=20 Hz") / amplitude - 0.25).abs() < 1e-12);
    // A response keeps what the sine is given by.
    let kept = |sine: &str| {
        let text = format!("{}\n[response]\nfrequency-ratio = [1]\n", base(sine));
        read(&text, &[])
            .unwrap_or_else(|wrong| panic!("{wrong}"))
            .plan()
            .response
            .as_ref()
            .map(|response| response.keep)
    };
    assert_eq!(kept("acceleration = \"2 g\", frequency = \"10 Hz\""), Some(Keep::Acceleration));
    assert_eq!(kept("velocity = \"0.1 m/s\", frequency = \"10 Hz\""), Some(Keep::Velocity));
    assert_eq!(kept("amplitude = \"1 mm\", frequency = \"10 Hz\""), Some(Keep::Displacement));
    // So does a sweep, whose amplitude is that at its first frequency.
    let swept = |keys: &str| {
        let scene =
            read(&base(keys).replace("base.sine ", "base.sine-sweep "), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
        let Some(Signal::SineSweep { amplitude, keep, .. }) = scene.plan().hosts["spring"].base else {
            panic!("a sweep")
        };
        (amplitude, keep)
    };
    let sweep = |what: &str| swept(&format!("{what}, from = 2, to = 20, duration = 5"));
    let w = std::f64::consts::TAU * 2.0;
    assert_eq!(sweep("velocity = 0.1"), (0.1 / w, Keep::Velocity));
    assert_eq!(sweep("acceleration = \"1 g\""), (9.80665 / w.powi(2), Keep::Acceleration));
    assert_eq!(sweep("amplitude = 0.1"), (0.1, Keep::Displacement));
    assert_eq!(sweep("amplitude = 0.1, keep = \"velocity\""), (0.1, Keep::Velocity));
    let wrong = [
        complaint(&base("frequency = \"10 Hz\""), &[]),
        complaint(&base("frequency = \"10 Hz\", amplitude = 0.1, acceleration = \"1 g\""), &[]),
        complaint(&base("frequency = \"10 Hz\", acceleration = \"1 kg\""), &[]),
    ];
    insta::assert_snapshot!(wrong.join("\n\n"));
}
