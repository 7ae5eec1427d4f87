//! Water and slopes: what is meant, what follows, what is wrong.

use crate::{GOOD, complaint, read};
use tsubu_scene::plan::{Drag, Film, Flow, Lid};

const STREAM: &str = r#"
slope = "3 deg"
duration = "1 s"

[materials.quartz]
young-modulus = "5 MPa"
density = "2650 kg/m^3"

[particles.sand]
material = "quartz"
count = 3
diameter = "2 mm"
start.at = { position = [[0, "1 mm"], ["3 mm", "1 mm"], ["6 mm", "1 mm"]] }

[water]
drag.schiller-naumann = {}
flow.log-law = { depth = "2 cm" }
"#;

fn about(from: &str, to: &str) -> String {
    assert!(STREAM.contains(from), "the scene has no `{from}`");
    complaint(&STREAM.replacen(from, to, 1), &[])
}

#[test]
fn shear_velocity_roughness_and_surface_follow() {
    let scene = read(STREAM, &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    let plan = scene.plan();
    let (sin, cos) = 3f64.to_radians().sin_cos();
    assert!((plan.gravity[0] - 9.8 * sin).abs() < 1e-12 && (plan.gravity[2] + 9.8 * cos).abs() < 1e-12);
    let water = plan.water.as_ref().expect("water");
    assert_eq!((water.density, water.viscosity, water.added_mass, water.surface), (1000.0, 1e-6, 0.5, Some(0.02)));
    assert_eq!(water.drag, Drag::SchillerNaumann {});
    let Flow::LogLaw { shear_velocity, roughness, zero_level } = water.flow else { panic!("{water:?}") };
    assert!((shear_velocity - (9.8 * sin * 0.02).sqrt()).abs() < 1e-12);
    assert_eq!((roughness, zero_level), (0.002, 0.0));
    let again = read(&scene.resolved_toml(), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    assert_eq!(again.plan(), plan);
    assert_eq!(again.resolved_toml(), scene.resolved_toml());
}

#[test]
fn nothing_drives_the_stream() {
    insta::assert_snapshot!(about("slope = \"3 deg\"", ""));
    insta::assert_snapshot!(about("depth = \"2 cm\"", ""));
    insta::assert_snapshot!(about("depth = \"2 cm\"", "discharge = \"0.01 m^2/s\""));
}

/// `slope = "2 %"` was refused, though roads and rivers have theirs in percent.
#[test]
fn a_slope_may_be_in_percent() {
    let gravity = |slope: &str| {
        let text = format!("slope = {slope}\n{GOOD}");
        read(&text, &[]).unwrap_or_else(|wrong| panic!("{wrong}")).plan().gravity
    };
    let angle = 0.02_f64.atan();
    assert_eq!(gravity("\"2 %\""), [10.0 * angle.sin(), 0.0, -10.0 * angle.cos()]);
    assert_eq!(gravity("\"2 %\""), gravity(&angle.to_string()));
    // 100 % is half a right angle, and no percentage is too steep.
    assert!((gravity("\"100 %\"")[0] - 50.0_f64.sqrt()).abs() < 1e-12);
    assert!(gravity("\"-300 %\"")[0] < -9.0);
}

#[test]
fn too_steep() {
    insta::assert_snapshot!(about("3 deg", "95 deg"));
}

#[test]
fn slope_and_a_direction_of_gravity() {
    insta::assert_snapshot!(about("slope = \"3 deg\"", "slope = \"3 deg\"\ngravity = [1, -9]"));
}

#[test]
fn depth_and_roughness_are_above_zero() {
    insta::assert_snapshot!(about("depth = \"2 cm\"", "depth = \"-2 cm\", roughness = 0"));
}

#[test]
fn wood_must_be_said_to_float() {
    insta::assert_snapshot!(about("2650", "650"));
    let scene = read(&STREAM.replace("2650", "650"), &["water.float=true"]);
    assert!(scene.is_ok());
}

#[test]
fn discs_do_not_swim() {
    insta::assert_snapshot!(about("count = 3", "count = 3\nshape.disc = { thickness = \"1 mm\" }"));
}

#[test]
fn a_profile_rises_and_is_paired() {
    insta::assert_snapshot!(about(
        "log-law = { depth = \"2 cm\" }",
        "table = { height = [0, 2, 1], velocity = [0, 1, 2] }"
    ));
    insta::assert_snapshot!(about(
        "log-law = { depth = \"2 cm\" }",
        "table = { height = [0, 2], velocity = [0, 1, 2] }"
    ));
}

#[test]
fn the_surface_is_above_the_bed() {
    insta::assert_snapshot!(about("[water]", "[water]\nsurface = \"-1 cm\""));
}

#[test]
fn what_acts_on_spin_is_for_grains_that_spin() {
    insta::assert_snapshot!(about(
        "[water]",
        "[contact]\nrotation = false\n\n[water]\ntorque.stokes = {}\nlift = [\"saffman\", \"magnus\"]"
    ));
}

/// The stream in layers.
fn coupled(flow: &str) -> String {
    STREAM.replace("log-law = { depth = \"2 cm\" }", flow)
}

#[test]
fn layers_follow_from_the_world() {
    let text = coupled("coupled = { bottom = 0, top = \"2 cm\" }") + "[periodic]\nx = [0, \"10 mm\"]\n";
    let scene = read(&text, &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    let flow = &scene.plan().water.as_ref().expect("water").flow;
    let Flow::Coupled { layers: 20, area, roughness, .. } = flow else { panic!("{flow:?}") };
    assert!((area - 0.01 * 0.002).abs() < 1e-15 && (roughness - 0.002).abs() < 1e-15);
    assert_eq!(scene.plan().water.as_ref().expect("water").surface, Some(0.02));
    let again = read(&scene.resolved_toml(), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    assert_eq!(again.plan(), scene.plan());
}

/// A reach that is fed is as long as the periodic world; a coupled stream fluctuates for a time that its depth and its drive tell.
#[test]
fn a_free_surface_and_its_reach() {
    let text = coupled("coupled = { bottom = 0, top = \"2 cm\", lid = \"free\", discharge = 0.01 }")
        + "fluctuation = {}\n[periodic]\nx = [0, \"10 mm\"]\n";
    let scene = read(&text, &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    let water = scene.plan().water.as_ref().expect("water");
    let Flow::Coupled { lid: Lid::Free, reach: Some(reach), .. } = water.flow else { panic!("{water:?}") };
    assert!((reach - 0.01).abs() < 1e-15);
    let shear = (9.8 * 3f64.to_radians().sin() * 0.02).sqrt();
    assert!((water.fluctuation.expect("fluctuation").time - 2.0 * 0.02 / (15.0 * shear)).abs() < 1e-12);
    let again = read(&scene.resolved_toml(), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    assert_eq!(again.plan(), scene.plan());
    let beyond = text.replace("[water]", "[water]\nsurface = \"3 cm\"").replace("slope = \"3 deg\"", "");
    insta::assert_snapshot!(complaint(&beyond.replace("[periodic]\nx = [0, \"10 mm\"]\n", ""), &[]));
    insta::assert_snapshot!(complaint(&beyond, &[]));
    let closed =
        complaint(&coupled("coupled = { bottom = 0, top = \"2 cm\", area = \"1 cm^2\", reach = \"1 m\" }"), &[]);
    assert!(closed.contains("a `reach` is fed by a `discharge` under a free surface"), "{closed}");
}

#[test]
fn layers_need_an_area_and_a_depth() {
    insta::assert_snapshot!(complaint(&coupled("coupled = { bottom = 0, top = \"2 cm\" }"), &[]));
    insta::assert_snapshot!(complaint(&coupled("coupled = { bottom = 0, top = \"-2 cm\", area = \"1 cm^2\" }"), &[]));
}

#[test]
fn grains_begin_below_the_lid() {
    insta::assert_snapshot!(complaint(
        &coupled("coupled = { bottom = \"-3 cm\", top = \"-2 cm\", area = \"1 cm^2\" }"),
        &[]
    ));
}

#[test]
fn no_lift_is_counted_twice() {
    insta::assert_snapshot!(about("[water]", "[water]\nlift = [\"saffman\", \"saffman-mei\"]"));
    let scene = read(STREAM, &["water.lift=[]"]).unwrap_or_else(|wrong| panic!("{wrong}"));
    assert_eq!(scene.plan().water.as_ref().expect("water").lift, []);
}

#[test]
fn turbulence_needs_a_log_law_and_a_time() {
    let scene = read(STREAM, &["water.fluctuation={}"]).unwrap_or_else(|wrong| panic!("{wrong}"));
    let water = scene.plan().water.as_ref().expect("water");
    let (Flow::LogLaw { shear_velocity, .. }, Some(told)) = (&water.flow, water.fluctuation) else { panic!() };
    assert!((told.time - 0.02 / (15.0 * shear_velocity)).abs() < 1e-12 && (told.strength - 1.0).abs() < 1e-12);
    // Of 1.785, the root mean square of 2.30, 1.63 and 1.27, a stream has 1.27 upwards.
    let scene = read(STREAM, &["water.fluctuation={strength=1.785,directions='stream'}"]);
    let water = scene.unwrap_or_else(|wrong| panic!("{wrong}")).plan().water.clone().expect("water");
    let time = water.fluctuation.expect("fluctuation").time;
    assert!((time * 15.0 * shear_velocity * 1.27f64.powi(2) / 0.02 - 1.0).abs() < 1e-3, "{time}");
    insta::assert_snapshot!(about("flow.log-law = { depth = \"2 cm\" }", "flow.still = {}\nfluctuation = {}"));
    insta::assert_snapshot!(about("depth = \"2 cm\" }", "shear-velocity = 0.1 }\nfluctuation.strength = 2"));
    insta::assert_snapshot!(about("[water]", "[water]\nfluctuation = { strength = -1, time = 0 }"));
}

#[test]
fn a_level_stream_needs_a_drive() {
    let level = coupled("coupled = { bottom = 0, top = \"2 cm\", area = \"1 cm^2\" }").replace("slope = \"3 deg\"", "");
    insta::assert_snapshot!(complaint(&level, &[]));
}

#[test]
fn a_crowd_needs_layers() {
    insta::assert_snapshot!(about("drag.schiller-naumann = {}", "drag.gidaspow = {}"));
    insta::assert_snapshot!(about("drag.schiller-naumann = {}", "hindrance.di-felice = {}"));
}

#[test]
fn a_film_is_of_something() {
    let scene = read(STREAM, &["contact.film={lubrication={}}"]).unwrap_or_else(|wrong| panic!("{wrong}"));
    let wanted = Film::Lubrication { roughness: 2e-6, reach: 2e-4, viscosity: 1e-3, in_contact: false };
    assert_eq!(scene.plan().contact.film, wanted);
    let again = read(&scene.resolved_toml(), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    assert_eq!(again.plan(), scene.plan());
    let dry = STREAM.split("[water]").next().expect("a head").replace("slope = \"3 deg\"", "");
    insta::assert_snapshot!(complaint(&format!("{dry}[contact]\nfilm.lubrication = {{}}\n"), &[]));
    insta::assert_snapshot!(about(
        "[water]",
        "[contact]\nfilm.lubrication = { roughness = \"1 mm\", viscosity = -1 }\n[water]"
    ));
}
