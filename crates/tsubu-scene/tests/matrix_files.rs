//! Structures by files of matrices, held against the program that wrote them: a clamped beam of steel, 100 x 10 x 5 mm in three bricks,
//! by CalculiX 2.20 (`structures/beam.inp`; `*FREQUENCY, SOLVER=MATRIXSTORAGE` writes its matrices).

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use tsubu_scene::Scene;
use tsubu_scene::plan::{Host, Mode, Structure};

const MASS: &str = include_str!("structures/beam.mas");
const STIFFNESS: &str = include_str!("structures/beam.sti");
const NODES: &str = include_str!("structures/beam.dof");
const AS_STORED: &str = r#"mass = "m", stiffness = "k", nodes = "n""#;
const OTHERWISE: &str = r#"mass = "m", stiffness = "k""#;

/// What CalculiX finds without `SOLVER`: frequencies [Hz], and participation of a base that moves along z [1000^0.5 kg^0.5].
const FOUND: [(f64, f64); 4] = [(1769.792, 4.898_752e-3), (1920.211, 0.0), (6829.326, 0.0), (12_048.41, 2.403_360e-3)];

fn host(mass: &str, stiffness: &str, keys: &str) -> Result<Host, String> {
    let desk = tempfile::tempdir().expect("a folder of its own");
    for (name, text) in [("m", mass), ("k", stiffness), ("n", NODES)] {
        fs::write(desk.path().join(name), text).expect("a folder of its own");
    }
    read(desk.path(), keys, "node = 13")
}

fn read(folder: &Path, keys: &str, tip: &str) -> Result<Host, String> {
    let text = format!(
        r#"
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
start.at = {{ position = [[0.1, 0, "5 mm"]] }}
[walls.cavity]
material = "steel"
host = "beam"
interface = "tip"
shape.box = {{ width = "20 mm", height = "20 mm", depth = "20 mm", floor-centre = [0.1, 0, 0] }}
[hosts.beam]
structure.matrix-files = {{ {keys} }}
interface.tip = {{ point = [0.1, 0, 0], {tip} }}
base.sine = {{ amplitude = "1 mm", frequency = "10 Hz" }}
"#
    );
    let scene = Scene::parse("scene.toml", &text, folder, &[]).map_err(|complaints| complaints.to_string())?;
    Ok(scene.plan().hosts["beam"].clone())
}

fn modes(host: &Host) -> &[Mode] {
    let Structure::Modes { mode } = &host.structure else { panic!("modes") };
    mode
}

/// Row, column and value of every line.
fn entries(text: &str) -> impl Iterator<Item = (usize, usize, f64)> {
    text.lines().map(|line| {
        let mut words = line.split_whitespace();
        let mut next = || words.next().expect("three words");
        (next().parse().expect("a row"), next().parse().expect("a column"), next().parse().expect("a value"))
    })
}

/// Node and direction, as a file of the form `name` writes them.
fn names() -> Vec<(String, String)> {
    let name = |line: &str| line.split_once('.').map(|(node, direction)| (node.to_owned(), direction.to_owned()));
    NODES.lines().map(|line| name(line.trim()).expect("node.direction")).collect()
}

fn market(text: &str) -> String {
    let lines: Vec<String> = entries(text).map(|(row, column, value)| format!("{column} {row} {value:e}")).collect();
    format!("%%MatrixMarket matrix coordinate real symmetric\n36 36 {}\n{}\n", lines.len(), lines.join("\n"))
}

fn abaqus(text: &str) -> String {
    let names = names();
    let line = |(row, column, value): (usize, usize, f64)| {
        let ((a, i), (b, j)) = (&names[row - 1], &names[column - 1]);
        format!("{a},{i}, {b},{j}, {value:.15e}\n")
    };
    format!("** the lower triangle\n{}", entries(text).map(line).collect::<String>())
}

fn nastran(name: &str, text: &str) -> String {
    let names = names();
    let mut out = format!("$ condensed\nDMIG    {name:8}       0       6       2       0              36\n");
    for (column, (node, direction)) in names.iter().enumerate() {
        let _ = writeln!(out, "DMIG*   {name:8}        {node:>16}{direction:>16}");
        for (row, _, value) in entries(text).filter(|entry| entry.1 == column + 1 && entry.2 != 0.0) {
            let (node, direction) = &names[row - 1];
            let value = format!("{value:.9e}").replace('e', "D");
            let _ = writeln!(out, "*       {node:>16}{direction:>16}{value:>16}");
        }
    }
    out
}

/// Frequencies and participations are those of CalculiX to the digits that each format keeps, and the structure weighs what the beam
/// does: 7/3 of a third of it moves with its nodes. Its units told wrong, it weighs a thousandth, and the same gate refuses it.
#[test]
fn a_beam_is_that_of_the_program_which_wrote_it() {
    let units = r#", units = "mm-t-s", damping-ratio = 0.01, modes = 4"#;
    let both = nastran("KAAX", STIFFNESS) + &nastran("MAAX", MASS);
    let forms = [
        host(MASS, STIFFNESS, &format!("{AS_STORED}{units}")),
        host(&abaqus(MASS), &abaqus(STIFFNESS), &format!("{OTHERWISE}{units}")),
        host(&both, &both, &format!("{OTHERWISE}{units}")),
        host(&both, "", &format!(r#"mass = "m", stiffness = "m"{units}"#)),
    ];
    let wrong = |host: &Host| {
        let pairs = modes(host).iter().zip(FOUND);
        pairs
            .flat_map(|(mode, (frequency, participation))| {
                let expected = participation * 1000.0_f64.sqrt();
                [mode.frequency / frequency - 1.0, mode.participation.abs() - expected]
            })
            .fold(0.0_f64, |worst, off| worst.max(off.abs()))
    };
    for form in &forms {
        let host = form.as_ref().unwrap_or_else(|complaint| panic!("{complaint}"));
        assert!(modes(host).len() == 4 && wrong(host) < 1e-6, "{}", wrong(host));
        assert_eq!(host.interface["tip"].translation.len(), 4);
    }
    let si = host(MASS, STIFFNESS, &format!("{AS_STORED}{}", units.replace("mm-t-s", "m-kg-s"))).expect("a structure");
    assert!(wrong(&si) > 0.1);

    let whole = host(MASS, STIFFNESS, &format!(r#"{AS_STORED}, units = "mm-t-s", damping-ratio = 0, modes = 36"#))
        .expect("all modes");
    let weight: f64 = modes(&whole).iter().map(|mode| mode.participation.powi(2)).sum();
    let beam = 7.85e-6 * 100.0 * 10.0 * 5.0;
    assert!((weight / (beam * 7.0 / 9.0) - 1.0).abs() < 1e-6, "{weight}");
}

/// With a damping matrix the coordinates stay what they are: node 13 moves by three of them, and the base drives those along z.
#[test]
fn a_damping_matrix_keeps_the_coordinates() {
    let keys = format!(r#"{AS_STORED}, damping = "m", units = "mm-t-s""#);
    let found = host(MASS, STIFFNESS, &keys).unwrap_or_else(|complaint| panic!("{complaint}"));
    let Structure::Matrices { mass, participation, .. } = &found.structure else { panic!("matrices") };
    let names = names();
    for (index, (node, direction)) in names.iter().enumerate() {
        let ours = |axis: &str| f64::from(u8::from(node == "13" && direction == axis));
        assert_eq!(found.interface["tip"].translation[index], [ours("1"), ours("2"), ours("3")]);
        assert_eq!(participation[index], f64::from(u8::from(direction == "3")));
    }
    assert!((mass[0][0] / 9.691_362_870_370_4e-4 - 1.0).abs() < 1e-12);
    // Matrices that only number their coordinates say how each interface moves.
    let desk = tempfile::tempdir().expect("a folder of its own");
    for (name, text) in [("m", market(MASS)), ("k", market(STIFFNESS))] {
        fs::write(desk.path().join(name), text).expect("a folder of its own");
    }
    let rows: Vec<String> = (0..36).map(|index| format!("[0, 0, {}]", u8::from(index == 35))).collect();
    let numbered = read(
        desk.path(),
        &format!(r#"{OTHERWISE}, damping-ratio = 0.01, modes = 2, units = "mm-t-s""#),
        &format!("translation = [{}]", rows.join(", ")),
    );
    let numbered = numbered.unwrap_or_else(|complaint| panic!("{complaint}"));
    let by_node = host(MASS, STIFFNESS, &format!(r#"{AS_STORED}, damping-ratio = 0.01, modes = 2, units = "mm-t-s""#));
    // The last coordinate is node 16 along z; of the first mode it moves as node 13 does.
    let (a, b) =
        (numbered.interface["tip"].translation[0][2], by_node.expect("a structure").interface["tip"].translation[0][2]);
    assert!((a.abs() / b.abs() - 1.0).abs() < 1e-3, "{a} {b}");
}

/// M = 1 and K = [3, -1; -1, 3], whose modes have w^2 = 2 and 4: with C = alpha M + beta K the matrices get C itself and the modes of files the
/// ratios alpha / 2 w + beta w / 2. Control: alpha and beta exchanged are told apart.
#[test]
fn rayleigh_damps_matrices_and_modes_alike() {
    let matrix = "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 ";
    let (mass, stiffness) = (format!("{matrix}1\n2 2 1\n2 1 0\n"), format!("{matrix}3\n2 2 3\n2 1 -1\n"));
    let desk = tempfile::tempdir().expect("a folder of its own");
    fs::write(desk.path().join("m"), mass).expect("written");
    fs::write(desk.path().join("k"), stiffness).expect("written");
    let tip = "translation = [[0, 0, 1], [0, 0, 0]]";
    let files = |damping: &str| read(desk.path(), &format!(r#"{OTHERWISE}, units = "m-kg-s", {damping}"#), tip);
    let ratios = |damping: &str| -> Vec<f64> {
        let host = files(damping).unwrap_or_else(|complaint| panic!("{complaint}"));
        modes(&host).iter().map(|mode| mode.damping_ratio).collect()
    };
    let (alpha, beta) = (0.02, 0.005);
    let wrong = |found: &[f64]| {
        let of = |w: f64| 0.5 * (alpha / w + beta * w);
        found.iter().zip([2.0_f64.sqrt(), 2.0]).map(|(ratio, w)| (ratio / of(w) - 1.0).abs()).fold(0.0, f64::max)
    };
    assert!(wrong(&ratios(r#"rayleigh = { alpha = "0.02 1/s", beta = "5 ms" }"#)) < 1e-12);
    assert!(wrong(&ratios(r#"rayleigh = { alpha = "0.005 1/s", beta = "20 ms" }"#)) > 0.1);
    insta::assert_snapshot!(files("modes = 2").expect_err("no damping"));

    let typed = |damping: &str| {
        let text = format!(
            "method = \"dem\"\ndimension = 2\nduration = 1\n[hosts.two]\n\
             structure.matrices = {{ mass = [[1, 0], [0, 1]], stiffness = [[3, -1], [-1, 3]], {damping} }}\n"
        );
        let scene =
            Scene::parse("scene.toml", &text, Path::new("."), &[]).map_err(|complaints| complaints.to_string())?;
        let Structure::Matrices { damping, .. } = &scene.plan().hosts["two"].structure else { panic!("matrices") };
        Ok::<_, String>(damping.clone())
    };
    let found =
        typed(r#"rayleigh = { alpha = "0.02 1/s", beta = "5 ms" }"#).unwrap_or_else(|complaint| panic!("{complaint}"));
    assert_eq!(found, typed("damping = [[0.035, -0.005], [-0.005, 0.035]]").expect("a structure"));
    insta::assert_snapshot!(typed("coordinate = 0").expect_err("no damping"));
}

/// Each wrong structure is refused with its file, line and value.
#[test]
fn matrix_files_that_cannot_be() {
    let rest = r#", units = "mm-t-s", damping-ratio = 0.01"#;
    let all = format!("{AS_STORED}{rest}");
    let desk = tempfile::tempdir().expect("a folder of its own");
    for (name, text) in [("m", MASS), ("k", STIFFNESS), ("n", NODES)] {
        fs::write(desk.path().join(name), text).expect("a folder of its own");
    }
    let free = "1 1 1.0\n1 2 -1.0\n2 2 1.0\n";
    let two = "1 1 1.0\n2 2 1.0\n";
    let wrong = [
        host(MASS, STIFFNESS, AS_STORED),
        host(MASS, STIFFNESS, &format!(r#"{AS_STORED}, units = "mm-t-s""#)),
        host(MASS, STIFFNESS, &format!(r#"{all}, damping = "m""#)),
        host(MASS, STIFFNESS, &format!("{all}, modes = 37")),
        host(MASS, STIFFNESS, &format!("{OTHERWISE}{rest}")),
        host(MASS, STIFFNESS, &format!("{AS_STORED}{rest}, coordinate = 99")),
        host(&MASS.replacen("9.6913628703704e-07", "0.0", 1), STIFFNESS, &all),
        host(&MASS.replacen("9.6913628703704e-07", "-1.0", 1), STIFFNESS, &all),
        host(MASS, &STIFFNESS.replacen("1.5899579657054e+06", "oops", 1), &all),
        host(two, free, &all),
        host("DMIG,B,0,6,1,0\nDMIG,B,7,1,,7,1,4.\nDMIG,C,0,6,1,0\n", STIFFNESS, &all),
        host(MASS, "*USER ELEMENT,NODES=1\n** ELEMENT NODES\n** 5\n1\n*MATRIX,TYPE=MASS\n1.\n", &all),
        host("nothing of the kind\n", STIFFNESS, &all),
        read(desk.path(), &all, "node = 2"),
        read(desk.path(), &all, "node = 13, along = 0.1"),
    ];
    insta::assert_snapshot!(crate::refusals(wrong));
}
