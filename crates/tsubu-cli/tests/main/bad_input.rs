//! What is said about bad input of the wider keys; nothing may be written.

use crate::support::Desk;
use insta::assert_snapshot;
use std::fs;

const SCENE: &str = r#"dimension = 3
duration = "1 ms"

[materials.glass]
young-modulus = "10 MPa"
density = "2500 kg/m^3"
surface-energy = "10 mJ/m^2"

[particles.beads]
material = "glass"
count = 1
diameter = "6 mm"
start.at = { position = [[0, 0, "10 mm"]] }

[walls.floor]
material = "glass"
shape.plane = { normal = "z" }
"#;

/// Runs the scene with something else in the place of something; `files` are beside it.
fn refused(find: &str, replace: &str, files: &[(&str, &[u8])]) -> String {
    assert!(SCENE.contains(find), "{find}");
    let desk = Desk::with(&SCENE.replacen(find, replace, 1));
    for (name, bytes) in files {
        fs::write(desk.path(name), bytes).unwrap();
    }
    let before = desk.files();
    let shown = desk.shown("run balls.toml");
    assert!(shown.contains("--- exit code 2"), "{shown}");
    assert_eq!(desk.files(), before);
    shown
}

const PLANE: &str = "shape.plane = { normal = \"z\" }";
const AT: &str = "count = 1\ndiameter = \"6 mm\"\nstart.at = { position = [[0, 0, \"10 mm\"]] }";

#[test]
fn a_mesh_that_is_not_there() {
    assert_snapshot!(refused(PLANE, "shape.mesh = { path = \"hopper.stl\" }", &[]));
}

#[test]
fn a_mesh_that_is_cut_off() {
    let mut cut = vec![0; 80];
    cut.extend(1000_u32.to_le_bytes());
    cut.extend([0; 70]);
    assert_snapshot!(refused(PLANE, "shape.mesh = { path = \"hopper.stl\" }", &[("hopper.stl", &cut)]));
}

#[test]
fn a_mesh_with_a_triangle_that_is_a_line() {
    let line = b"v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n";
    assert_snapshot!(refused(PLANE, "shape.mesh = { path = \"sheet.obj\" }", &[("sheet.obj", line)]));
}

#[test]
fn a_grain_file_with_a_word_for_a_number() {
    let file = b"x,y,z,diameter\n0,0,0.01,0.006\n0.02,zero,0.01,0.006\n";
    assert_snapshot!(refused(AT, "start.file = { path = \"bed.csv\" }", &[("bed.csv", file)]));
}

#[test]
fn a_grain_file_of_an_unknown_kind() {
    assert_snapshot!(refused(AT, "start.file = { path = \"bed.xlsx\" }", &[("bed.xlsx", b"")]));
}

#[test]
fn a_world_too_short_to_repeat() {
    let text = format!("{PLANE}\n[periodic]\nx = [0, \"10 mm\"]");
    assert_snapshot!(refused(PLANE, &text, &[]));
}

#[test]
fn a_removal_of_an_unknown_kind() {
    let text = format!("{PLANE}\n[removal.out.beyond]\npoint = [0, 0, 0]");
    assert_snapshot!(refused(PLANE, &text, &[]));
}

#[test]
fn a_wall_with_two_masters() {
    let text = format!(
        "{PLANE}\nservo = {{ direction = \"z\", force = \"1 N\", mass = \"1 kg\" }}\n\
         motion = {{ signal.sine = {{ amplitude = \"1 mm\", frequency = \"5 Hz\" }} }}"
    );
    assert_snapshot!(refused(PLANE, &text, &[]));
}

#[test]
fn adhesion_of_curved_bodies_on_linear_springs() {
    let text = format!("{PLANE}\n[contact]\nnormal.hooke.stiffness = \"1 kN/m\"\ncohesion.jkr = {{}}");
    assert_snapshot!(refused(PLANE, &text, &[]));
}

#[test]
fn a_disc_in_space() {
    assert_snapshot!(refused("count = 1\n", "count = 1\nshape.disc = { thickness = \"2 mm\" }\n", &[]));
}

#[test]
fn a_sieve_that_falls() {
    let size = "count = 1\nsize.sieve = { diameter = [\"2 mm\", \"1 mm\"], passing = [0, 1] }\n";
    assert_snapshot!(refused("count = 1\ndiameter = \"6 mm\"\n", size, &[]));
}

#[test]
fn more_random_grains_than_fit_between_walls() {
    let drum = "shape.cylinder = { axis = \"y\", radius = \"10 mm\", length = \"20 mm\" }";
    let start = "count = 40\ndiameter = \"6 mm\"\nstart.random = { region = { low = [\"-10 mm\", 0, \"-10 mm\"], high = [\"10 mm\", \"20 mm\", \"10 mm\"] } }";
    let scene = SCENE.replacen(AT, start, 1).replacen(PLANE, drum, 1);
    let desk = Desk::with(&scene);
    assert_snapshot!(desk.shown("run balls.toml"));
}

/// Each of them would make the whole run, all in one folder.
#[cfg(not(feature = "mpi"))]
#[test]
fn several_ranks_without_mpi_are_refused() {
    let desk = Desk::with(SCENE);
    let started = |rank: &str| {
        let mut command = desk.command("run balls.toml");
        let out = command.envs([("OMPI_COMM_WORLD_SIZE", "3"), ("OMPI_COMM_WORLD_RANK", rank)]).output().unwrap();
        (out.status.code(), String::from_utf8(out.stderr).unwrap())
    };
    let (code, said) = started("0");
    assert_eq!(code, Some(2));
    assert!(said.contains("3 ranks were started, and this program was built without MPI"), "{said}");
    assert!(said.contains("libopenmpi-dev"), "{said}");
    // With an error of its own it would have a launcher end the first, perhaps before that has spoken.
    assert_eq!(started("1"), (Some(0), String::new()));
    assert!(!desk.path("out").exists());
}
