//! Grains from files, and what all files have in common.

use super::mesh_files::{TRIANGLE, with_mesh};
use proptest::prelude::*;
use std::fmt::Write as _;
use std::fs;
use std::sync::Arc;
use tsubu_scene::plan::*;
use tsubu_scene::{Complaints, Scene};

pub(super) const SCENE: &str = r#"duration = 1
dimension = 3
[materials.steel]
young-modulus = "200 GPa"
density = 6000
[particles.sand]
material = "steel"
start.file.path = "NAME"
"#;

pub(super) fn in_folder(files: &[(&str, &[u8])], text: &str) -> Result<Scene, Complaints> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, bytes) in files {
        fs::write(folder.path().join(name), bytes).expect("written");
    }
    Scene::parse("scene.toml", text, folder.path(), &[])
}

fn with_grains(name: &str, content: &str) -> Result<Scene, Complaints> {
    in_folder(&[(name, content.as_bytes())], &SCENE.replace("NAME", name))
}

fn grains(name: &str, content: &str) -> Arc<GrainTable> {
    let scene = with_grains(name, content).unwrap_or_else(|wrong| panic!("{wrong}"));
    let Start::File { grains, .. } = &scene.plan().particles["sand"].start else { panic!("a file") };
    Arc::clone(grains)
}

fn about(name: &str, content: &str) -> String {
    with_grains(name, content).expect_err("the file is wrong").to_string()
}

const BARE: &str = "# 2 0.05 0.0754\n0.01,0.02,0.03,0.001\n0.04,0.05,0.06,0.002\n";
const XYZ: &str = "2\nLattice=\"1 0 0 0 1 0 0 0 1\" Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1:id:I:1 Time=0.5\n\
                   M0 0.01 0.02 0.03 1 2 3 0.001 0\nM0 0.04 0.05 0.06 0 0 -1 0.002 1\n";
const DATA: &str = "LAMMPS data file\n\n2 atoms\n2 atom types\n\n0 1 xlo xhi\n\nMasses\n\n1 2\n\nAtoms # sphere\n\n\
                    3 1 0.002 6000 0.01 0.02 0.03 0 0 -1\n4 2 0.004 6000 0.04 0.05 0.06 0 0 0\n\n\
                    Velocities\n\n4 0 0 -1 7 8 9\n3 1 2 3 4 5 6\n";

#[test]
fn all_formats_say_the_same() {
    let position = vec![[0.01, 0.02, 0.03], [0.04, 0.05, 0.06]];
    let diameter = vec![0.002, 0.004];
    let velocity = vec![[1.0, 2.0, 3.0], [0.0, 0.0, -1.0]];
    let spin = vec![[4.0, 5.0, 6.0], [7.0, 8.0, 9.0]];
    let bare = GrainTable { position, diameter, ..GrainTable::default() };
    assert_eq!(*grains("a.csv", BARE), bare);
    let moving = GrainTable { velocity, ..bare.clone() };
    assert_eq!(*grains("a.xyz", XYZ), moving);
    assert_eq!(*grains("a.data", DATA), GrainTable { spin, ..moving });
    let named = "\u{feff}id; \"x [cm]\"; z; Y [mm]; D\r\n1; 1; 0.03; 20; 0.002\r\n\r\n2; 4; 0.06; 50; 0.004\r\n";
    assert_eq!(*grains("a.CSV", named), bare);
    let round = "x (cm),y (mm),z (m),radius [mm]\n1,20,0.03,1\n4,50,0.06,2\n";
    assert_eq!(*grains("a.csv", round), bare);
    let blanks = "x  y  z  radius\n 0.01 0.02 0.03 0.001\n 0.04 0.05 0.06  0.002\n";
    assert_eq!(*grains("a.csv", blanks), bare);
}

const DUMP: &str = "ITEM: UNITS\nsi\nITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n\
                    ITEM: ATOMS id x y z\n1 0 0 0\nITEM: TIMESTEP\n100\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n0 1\n\
                    0 1\n0 1\nITEM: ATOMS id type x y z vx vy vz omegax omegay omegaz radius mass c_1 ix\n\
                    4 2 0.04 0.05 0.06 0 0 -1 7 8 9 0.002 2.0106193e-4 0.5 1\n\
                    3 1 0.01 0.02 0.03 1 2 3 4 5 6 0.001 2.5132741e-5 0.5 0\n";

/// tsubu wrote dump files and could not begin from them; nor from those of LAMMPS.
#[test]
fn the_last_snapshot_of_a_dump_is_read() {
    assert_eq!(grains("a.lammpstrj", DUMP), grains("a.data", DATA));
    let chosen = SCENE.replace("path = \"NAME\"", "path = \"a.lammpstrj\"\nstart.file.kind = 2");
    let scene = in_folder(&[("a.lammpstrj", DUMP.as_bytes())], &chosen).unwrap_or_else(|wrong| panic!("{wrong}"));
    assert_eq!(scene.plan().particles["sand"].count, 1);
    // Where a grain went round the world, its place in it counts.
    let unwrapped = DUMP.replace("x y z vx", "xu yu zu vx");
    assert_eq!(grains("a.lammpstrj", &unwrapped), grains("a.data", DATA));
    let both = DUMP.replace("c_1 ix", "xu yu").replace("0.5 ", "5 ");
    assert_eq!(grains("a.lammpstrj", &both), grains("a.data", DATA));
}

#[test]
fn dumps_that_are_wrong() {
    let changed = |from: &str, to: &str| {
        assert!(DUMP.contains(from), "{from}");
        about("a.lammpstrj", &DUMP.replace(from, to))
    };
    let cut = DUMP.rsplit_once("\n3").expect("a row").0;
    let all = [
        changed("si", "cgs"),
        changed("ITEM: TIMESTEP", "ITEM: STEP"),
        about("a.lammpstrj", "1 0 0 0\n"),
        about("a.lammpstrj", &format!("{cut}\n")),
        about("a.lammpstrj", &DUMP[..DUMP.len() - 10]),
        about("a.lammpstrj", DUMP.split_once("ITEM: ATOMS id type").expect("a section").0),
        changed("\n3 1", "\n4 1"),
        changed("x y z vx", "xs ys zs vx"),
        changed("radius mass", "radius weight"),
        changed("2.0106193e-4", "2.6e-4"),
        changed("type x y", "type x z"),
        in_folder(
            &[("a.lammpstrj", DUMP.as_bytes())],
            &SCENE.replace("path = \"NAME\"", "path = \"a.lammpstrj\"\nstart.file.kind = 5"),
        )
        .expect_err("there is no 5")
        .to_string(),
    ];
    insta::assert_snapshot!(all.join("\n\n"));
}

/// `write_data` writes atoms in the order in which LAMMPS holds them; grains took that order, and their numbers with it.
#[test]
fn grains_stand_in_the_order_of_their_ids() {
    let expected = grains("a.data", DATA);
    let turned = DATA.replace(
        "3 1 0.002 6000 0.01 0.02 0.03 0 0 -1\n4 2 0.004 6000 0.04 0.05 0.06 0 0 0\n",
        "4 2 0.004 6000 0.04 0.05 0.06 0 0 0\n3 1 0.002 6000 0.01 0.02 0.03 0 0 -1\n",
    );
    assert_ne!(turned, DATA);
    assert_eq!(grains("a.data", &turned), expected);
    let (head, last) = XYZ.trim_end().rsplit_once('\n').expect("rows");
    let (head, first) = head.rsplit_once('\n').expect("rows");
    assert_eq!(grains("a.xyz", &format!("{head}\n{last}\n{first}\n")), grains("a.xyz", XYZ));
}

/// Densities in a file that were not the material's were passed over: the grains weighed something else.
#[test]
fn densities_of_a_file_and_of_the_scene_agree() {
    let other = about("a.data", &DATA.replace("4 2 0.004 6000", "4 2 0.004 2500"));
    let all = about("a.data", &DATA.replace("6000", "2650"));
    let csv = about("a.csv", "x,y,z,d,density [g/cm^3]\n0,0,0,0.001,6\n1,0,0,0.001,7.8\n");
    insta::assert_snapshot!([other, all, csv].join("\n\n"));
    // Rounding in the file is no difference, and what is held in place weighs nothing.
    assert!(with_grains("a.data", &DATA.replace("6000", "6000.01")).is_ok());
    let frozen = SCENE.replace("NAME", "a.data") + "motion.frozen = {}\n";
    let still = DATA.split_once("Velocities").expect("velocities").0.replace("6000", "2650");
    assert!(in_folder(&[("a.data", still.as_bytes())], &frozen).is_ok());
}

#[test]
fn what_follows_from_a_file() {
    let scene = with_grains("a.csv", BARE).expect("right");
    let sand = &scene.plan().particles["sand"];
    assert_eq!((sand.count, sand.diameter), (2, 0.003));
    assert_eq!((sand.smallest_diameter(), sand.largest_diameter()), (0.002, 0.004));
    assert!((sand.mass / (6000.0 * std::f64::consts::PI / 6.0 * 27e-9) - 1.0).abs() < 1e-12);
    let Start::File { fingerprint, kind, .. } = &sand.start else { panic!("a file") };
    assert_eq!((fingerprint.len(), *kind), (8, None));
    assert_eq!(scene.companions(), [("particles-sand.csv".to_string(), BARE.as_bytes().to_vec())]);
}

#[test]
fn an_atom_type_can_be_chosen() {
    let text = SCENE.replace("path = \"NAME\"", "path = \"a.data\"\nstart.file.kind = 2");
    let scene = in_folder(&[("a.data", DATA.as_bytes())], &text).unwrap_or_else(|wrong| panic!("{wrong}"));
    let Start::File { grains, .. } = &scene.plan().particles["sand"].start else { panic!("a file") };
    assert_eq!(
        (grains.position.as_slice(), grains.spin.as_slice()),
        (&[[0.04, 0.05, 0.06]][..], &[[7.0, 8.0, 9.0]][..])
    );
    let wrong = in_folder(&[("a.data", DATA.as_bytes())], &text.replace("= 2", "= 3")).expect_err("there is no 3");
    insta::assert_snapshot!(wrong);
}

#[test]
fn the_plane_takes_its_own_columns() {
    let flat = |content: &str| {
        let text = SCENE.replace("dimension = 3", "").replace("NAME", "a.csv");
        in_folder(&[("a.csv", content.as_bytes())], &text)
    };
    let scene = flat("0.1,0.2,0.01\n").unwrap_or_else(|wrong| panic!("{wrong}"));
    let Start::File { grains, .. } = &scene.plan().particles["sand"].start else { panic!("a file") };
    assert_eq!((grains.position[0], grains.diameter[0]), ([0.1, 0.0, 0.2], 0.02));
    assert!(flat("x,z,d,wy\n0,1,0.1,3\n").is_ok());
    let wrong = [flat("0.1,0.3,0.2,0.01\n"), flat("x,z,d,wz\n0,1,0.1,3\n")];
    insta::assert_snapshot!(wrong.map(|wrong| wrong.expect_err("leaves the plane").to_string()).join("\n\n"));
}

#[test]
fn malformed_csv() {
    let texts = [
        "",
        "# nothing\n",
        "x,y,z\n",
        "0.1,0.2,0.3,0.001\n0.1,0.2,nan,0.001\n0.1,0.2,0.3,-1\n0.1,0.2,0.3\n0.1,0.2,0.3,0.001,7\n0.1,zero,0.3,0.001\n,,,\n",
        "0.1,0.2\n",
        "x,y,diamter\n1,2,3\n",
        "x,y,d\n1,2,3\n",
        "x,y,z,d,r\n1,2,3,1,0.5\n",
        "x [s],y [m],z,d [furlong]\n1,2,3,1\n",
        "x,y,z,d\n1,2,3,1e400\n",
        "x,y,z\n1,2,3\n",
        "x,y,z,d [mm\n1,2,3,1\n",
        "x,y,z,d_mm\n1,2,3,1\n",
        "x,y,z,size\n1,2,3,1\n",
        "# x [mm], y [mm], z [mm], radius [mm]\n1,2,3,1\n",
    ];
    insta::assert_snapshot!(texts.map(|text| about("a.csv", text)).join("\n\n"));
}

#[test]
fn malformed_xyz() {
    let texts = [
        "",
        "two\n",
        "1\n",
        "2\nProperties=species:S:1:pos:R:3:radius:R:1\nA 1 2 3 1\n",
        "1\nProperties=species:S:1:pos:R:3:radius:R:1\nA 1 2 3 1\n1\nProperties=...\nA 1 2 3 1\n",
        "1\nProperties=species:S:1:radius:R:1\nA 1\n",
        "1\nProperties=species:S:1:pos:R:2\nA 1 2\n",
        "1\nProperties=species:S\nA 1 2\n",
        "1\nProperties=species:S:many:pos:R:3\nA 1 2\n",
        "1\nProperties=species:S:1:pos:R:3:radius:R:1\nA 1 2 3 0\n",
        "1\nProperties=species:S:1:pos:R:3:radus:R:1\nA 1 2 3 1\n",
    ];
    insta::assert_snapshot!(texts.map(|text| about("a.xyz", text)).join("\n\n"));
}

#[test]
fn malformed_data() {
    let texts = [
        "title\n\n2 atoms\n".to_string(),
        DATA.replace("2 atoms", "3 atoms"),
        DATA.replace("# sphere", "# atomic"),
        DATA.replace("4 2 0.004", "4 2 0"),
        DATA.replace("4 2 0.004", "3 2 0.004"),
        DATA.replace("4 2 0.004 6000", "four 2 0.004 6000").replace("0.06 0 0 0", "0.06 0 0 0 0"),
        DATA.replace("0.05 0.06 0 0 0", "0.05 0.06"),
        DATA.replace("4 0 0 -1 7 8 9", "4 0 0 -1"),
        // Once passed over in silence: velocities of nobody, of one atom alone, before the atoms, and a type too many.
        DATA.replace("4 0 0 -1 7 8 9", "5 0 0 -1 7 8 9"),
        DATA.replace("4 0 0 -1 7 8 9", ""),
        DATA.replace("Atoms # sphere", "Velocities\n\n3 0 0 0 0 0 0\n\nAtoms # sphere"),
        DATA.replace("4 2 0.004", "4 3 0.004"),
        // Once passed over in silence: no number of atoms, so that a file that was cut off is whole; a section, a line
        // and units that nobody reads.
        DATA.replace("2 atoms\n", ""),
        DATA.replace("Velocities", "Velocitys"),
        DATA.replace("0 1 xlo xhi", "0 1 xlow xhi"),
        DATA.replace("LAMMPS data file", "LAMMPS data file via write_data, timestep = 7, units = cgs"),
        // Once passed over in silence: a density that is no number.
        DATA.replace("4 2 0.004 6000", "4 2 0.004 heavy"),
    ];
    insta::assert_snapshot!(texts.map(|text| about("a.data", &text)).join("\n\n"));
}

#[test]
fn files_that_cannot_be_read() {
    let no_text = in_folder(&[("a.csv", b"x,y\n1,\xff\n")], &SCENE.replace("NAME", "a.csv")).expect_err("no text");
    let no_mesh = with_mesh("a.obj", b"v 0 0 0\nv 1 \xe9 0\n", "").expect_err("no text");
    let missing = in_folder(&[], &SCENE.replace("NAME", "b.csv")).expect_err("missing");
    let packed = in_folder(&[], &SCENE.replace("NAME", "a.csv.gz")).expect_err("packed");
    let strange = in_folder(&[], &SCENE.replace("NAME", "a.txt")).expect_err("strange");
    let pathless =
        in_folder(&[], &SCENE.replace("start.file.path = \"NAME\"", "start.file = {}")).expect_err("no path");
    let kind = SCENE.replace("path = \"NAME\"", "path = \"a.csv\"\nstart.file.kind = 2");
    let kind = in_folder(&[("a.csv", BARE.as_bytes())], &kind).expect_err("a kind of CSV");
    let all = [no_text, no_mesh, missing, packed, strange, pathless, kind];
    insta::assert_snapshot!(all.map(|wrong| wrong.to_string()).join("\n\n"));
}

#[test]
fn a_scene_that_contradicts_its_file() {
    let typed = |more: &str| {
        let text =
            SCENE.replace("NAME", "a.csv").replace("material = \"steel\"", &format!("material = \"steel\"\n{more}"));
        in_folder(&[("a.csv", BARE.as_bytes())], &text).expect_err("a contradiction").to_string()
    };
    let more = [
        "count = 3",
        "diameter = \"2 mm\"",
        "size.uniform = { smallest = 0.001, largest = 0.002 }",
        "start.file.fingerprint = \"00000000\"",
    ];
    insta::assert_snapshot!(more.map(typed).join("\n\n"));
}

#[test]
fn grains_of_a_file_that_overlap_or_stand_in_a_wall() {
    // Beds of other codes lie under load: up to 0.05 diameters is no mistake.
    let pair = |x: f64| format!("x,y,z,d\n0,0,0.1,0.1\n{x},0,0.1,0.1\n");
    assert!(with_grains("a.csv", &pair(0.0951)).is_ok());
    let wall = "[walls.floor]\nmaterial = \"steel\"\nshape.plane = {}\n[walls.drum]\nmaterial = \"steel\"\n\
                shape.cylinder.radius = 0.4\n[periodic]\ny = [-1, 1]\n";
    let text = format!("{}{wall}", SCENE.replace("NAME", "a.csv"));
    let low = "x,y,z,d\n0,0,0.03,0.1\n0.2,0,0.3,0.1\n0,2,0.1,0.1\n";
    let walls = in_folder(&[("a.csv", low.as_bytes())], &text).expect_err("in the walls").to_string();
    insta::assert_snapshot!([about("a.csv", &pair(0.09)), walls].join("\n\n"));
}

#[test]
fn a_hundred_thousand_rows_are_a_matter_of_a_moment() {
    let mut text = String::from("x,y,z,r\n");
    for i in 0..100_000 {
        let [x, y, z] = [i % 50, i / 50 % 50, i / 2500].map(|n| 0.01 * f64::from(n));
        let _ = writeln!(text, "{x},{y},{z},0.005");
    }
    let begin = std::time::Instant::now();
    assert_eq!(grains("a.csv", &text).position.len(), 100_000);
    // Generous: other tests run at the same time.
    assert!(begin.elapsed().as_secs_f64() < 5.0, "{:?}", begin.elapsed());
}

#[test]
fn companions_do_not_collide() {
    let groups = ["a b", "a_b", "A_b", "a/b", "c"];
    let mut text = SCENE.split_once("[particles").expect("grains").0.to_string();
    for (i, name) in groups.iter().enumerate() {
        let file = if *name == "c" { "0.csv".to_string() } else { format!("{i}.csv") };
        let _ = write!(
            text,
            "[particles.\"{name}\"]\nmaterial = \"steel\"\nmotion.frozen = {{}}\nstart.file.path = \"{file}\"\n"
        );
    }
    let files: Vec<(String, String)> = (0..4).map(|i| (format!("{i}.csv"), format!("0,0,0,0.{}\n", i + 1))).collect();
    let files: Vec<(&str, &[u8])> = files.iter().map(|(name, text)| (name.as_str(), text.as_bytes())).collect();
    let scene = in_folder(&files, &text).unwrap_or_else(|wrong| panic!("{wrong}"));
    let names: Vec<String> = scene.companions().into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["particles-A_b.csv", "particles-a_b-2.csv", "particles-a_b-3.csv", "particles-a_b-4.csv"]);
    let run = tempfile::tempdir().expect("a temporary folder");
    for (name, bytes) in scene.companions() {
        fs::write(run.path().join(name), bytes).expect("written");
    }
    let again =
        Scene::parse("scene.toml", &scene.resolved_toml(), run.path(), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    assert_eq!(again.plan(), scene.plan());
    assert_eq!(again.companions(), scene.companions());
}

#[test]
fn cases_of_a_study_read_the_file_once() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("a.csv"), BARE).expect("written");
    let text = format!("{}[sweep.vary]\nseed = [1, 2]\n", SCENE.replace("NAME", "a.csv"));
    let scene = Scene::parse("scene.toml", &text, folder.path(), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    fs::remove_file(folder.path().join("a.csv")).expect("removed");
    let case = scene.with(&[("seed", &toml::Value::Integer(2))]).unwrap_or_else(|wrong| panic!("{wrong}"));
    assert_eq!(case.plan().particles, scene.plan().particles);
    assert_eq!(case.companions(), scene.companions());
}

proptest! {
    #[test]
    fn no_file_makes_the_reader_panic(
        which in 0_usize..6,
        cut in 0_usize..300,
        with in proptest::collection::vec(any::<u8>(), 0..40),
        from in 0_usize..300,
    ) {
        let (name, text) = [
            ("a.csv", BARE), ("a.xyz", XYZ), ("a.data", DATA), ("a.obj", TRIANGLE), ("a.stl", "facet\nvertex 1 2 3\n"), ("a.stl", ""),
        ][which];
        let mut bytes = text.as_bytes()[..cut.min(text.len())].to_vec();
        bytes.extend(&with);
        bytes.extend(&text.as_bytes()[from.min(text.len())..]);
        let read = if which < 3 {
            in_folder(&[(name, &bytes)], &SCENE.replace("NAME", name))
        } else {
            with_mesh(name, &bytes, "")
        };
        match read {
            Ok(scene) => prop_assert!(!scene.resolved_toml().is_empty()),
            Err(wrong) => {
                prop_assert!(!wrong.to_string().is_empty());
                let _ = wrong.render(true);
            }
        }
    }
}
