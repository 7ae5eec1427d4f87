//! What is said of grains that begin where they cannot, or beside their vessel.

use super::open_text;
use std::fmt::Write as _;
use std::path::Path;
use tsubu::engine::Engine;
use tsubu::methods;
use tsubu::partner::Hosts;
use tsubu_frame::Kind;
use tsubu_scene::Scene;

const GLASS: &str = "
dimension = 3
duration = \"0.1 s\"
speed-scale = 1
[materials.glass]
young-modulus = \"10 MPa\"
density = \"2500 kg/m^3\"
";

fn opened(text: &str, folder: &Path) -> Result<Box<dyn Engine>, String> {
    let scene = Scene::parse("test", text, folder, &[]).map_err(|c| c.to_string())?;
    methods::open(scene.plan(), &Hosts::new(&scene.plan().hosts)).map_err(|error| error.to_string())
}

/// A rough floor of frozen grains reached behind a gate: the run ended in its first step, "grain 496 overlaps its neighbour by
/// 532 of its diameter". What nothing moves may lie in what nothing moves.
#[test]
fn frozen_grains_may_lie_in_walls_that_stand() {
    let scene = |motion: &str| {
        format!(
            "{GLASS}[particles.floor]\nmaterial = \"glass\"\ndiameter = \"6 mm\"\nmotion.{motion} = {{}}\n\
             start.at = {{ position = [[0.05, 0, 0], [0.5, 0, 0.003]] }}\n\
             [walls.gate]\nmaterial = \"glass\"\nshape.plane = {{ point = [0.1, 0, 0], normal = \"-x\" }}\nuntil = 0.05\n\
             [walls.floor]\nmaterial = \"glass\"\nshape.plane.point = [0, 0, 0]\n"
        )
    };
    let (mut engine, mut hosts, mut ledger) = open_text(&scene("frozen"), &[]);
    engine.advance(100, &mut hosts, &mut ledger).unwrap();
    assert_eq!(engine.contacts(), 0);
    // Free ones may not, and the wall is named.
    let free = opened(&scene("free"), Path::new(".")).err().unwrap_or_default();
    assert!(free.contains("gate") && free.contains("floor"), "{free}");
}

/// Walls whose place the reading of the scene does not judge: one that is moved, and a mesh.
#[test]
fn a_grain_in_a_wall_is_refused_with_the_name_of_the_wall() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("sheet.obj"), "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n")
        .unwrap();
    for wall in [
        "shape.plane = {}\nmotion = { direction = \"z\", signal.sine = { amplitude = \"1 mm\", frequency = 1 } }",
        "shape.mesh.path = \"sheet.obj\"",
    ] {
        let scene = |height: &str| {
            format!(
                "{GLASS}[particles.beads]\nmaterial = \"glass\"\ndiameter = \"6 mm\"\n\
                 start.at = {{ position = [[0.1, 0, \"9 mm\"], [0, 0, \"{height}\"]] }}\n\
                 [walls.plate]\nmaterial = \"glass\"\n{wall}\n"
            )
        };
        let deep = opened(&scene("1 mm"), folder.path()).err().unwrap_or_default();
        assert!(deep.contains("particles.beads.start.at.position[1]"), "{deep}");
        assert!(deep.contains("grain 1 begins 0.333 of its diameter deep in the wall `plate`; move"), "{deep}");
        // A little deep is only said.
        let engine = opened(&scene("2.9 mm"), folder.path()).unwrap();
        assert!(engine.notes().iter().any(|note| note.text.contains("the wall `plate`")), "{:?}", engine.notes());
        assert!(opened(&scene("3 mm"), folder.path()).unwrap().notes().is_empty());
    }
}

/// Two groups in rows of one region: the run ended in its first step with a word about neighbours.
#[test]
fn grains_that_begin_in_each_other_are_refused() {
    let group = |name: &str| {
        format!(
            "[particles.{name}]\nmaterial = \"glass\"\ndiameter = \"6 mm\"\ncount = 8\n\
             start.rows.region = {{ low = [0, 0, 0], high = [0.02, 0.02, 0.02] }}\n"
        )
    };
    let refused = opened(&format!("{GLASS}{}{}", group("a"), group("b")), Path::new(".")).err().unwrap_or_default();
    assert!(refused.contains("particles.a.start.rows") && refused.contains("deep in grain"), "{refused}");
    assert!(refused.contains("and 4 more like it"), "{refused}");
}

/// A tube of triangles about z from the floor to 0.1 m, of radius 0.05 m; with a floor, and with a lid.
fn tube(floor: bool, lid: bool) -> String {
    let n = 24;
    let mut text = String::new();
    for z in [0.0, 0.1] {
        for k in 0..n {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(n);
            let _ = writeln!(text, "v {} {} {z}", 0.05 * angle.cos(), 0.05 * angle.sin());
        }
    }
    text += "v 0 0 0\nv 0 0 0.1\n";
    for k in 0..n {
        let (a, b) = (k + 1, (k + 1) % n + 1);
        let _ = writeln!(text, "f {a} {b} {}\nf {a} {} {}", b + n, b + n, a + n);
        if floor {
            let _ = writeln!(text, "f {b} {a} {}", 2 * n + 1);
        }
        if lid {
            let _ = writeln!(text, "f {} {} {}", a + n, b + n, 2 * n + 2);
        }
    }
    text
}

/// The region of grains is a box, and the barrel is round: of 20,000 grains 1,803 began beside it, fell past it and were
/// counted as discharged.
#[test]
fn grains_do_not_begin_beside_their_barrel() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = "shape.mesh.path = \"barrel.obj\"";
    let drawn = "shape.cylinder = { point = [0, 0, 0], axis = \"z\", radius = 0.05, length = 0.1 }";
    let within = "region = { low = [-0.055, -0.055, 0.004], high = [0.055, 0.055, 0.09] }";
    let above = "region = { low = [-0.06, -0.06, 0.12], high = [0.06, 0.06, 0.16] }";
    for (name, shape, obj) in [
        ("closed", mesh, tube(true, true)),
        ("open at the top", mesh, tube(true, false)),
        ("open at both ends", mesh, tube(false, false)),
        ("a cylinder", drawn, String::new()),
    ] {
        std::fs::write(folder.path().join("barrel.obj"), obj).unwrap();
        let regions = if name == "closed" { vec![within] } else { vec![within, above] };
        for region in regions {
            for start in ["random", "rows", "stream"] {
                let rate = if start == "stream" { ", rate = 1e7" } else { "" };
                let scene = |wall: &str| {
                    format!(
                        "gravity = 1\n{GLASS}[particles.beads]\nmaterial = \"glass\"\ncount = 300\ndiameter = \"6 mm\"\n\
                         start.{start} = {{ {region}{rate} }}\n{wall}"
                    )
                };
                let beside = |wall: &str| {
                    let (mut engine, mut hosts, mut ledger) = super::run_text(&scene(wall), folder.path(), &[]);
                    engine.advance(50, &mut hosts, &mut ledger).unwrap();
                    assert!(engine.grains() > 100, "{name}, {start}: {} grains", engine.grains());
                    let frame = engine.frame(&hosts);
                    let places = frame.vectors(Kind::Grain, "position");
                    places.iter().filter(|p| p[0].hypot(p[1]) > 0.0501).count()
                };
                let wall = format!("[walls.barrel]\nmaterial = \"glass\"\n{shape}\n");
                assert_eq!(beside(&wall), 0, "{name}, {start}, {region}");
                assert!(beside("") > 0, "{name}, {start}: the region alone keeps them in");
            }
        }
        // Places that are told are named.
        let told = format!(
            "{GLASS}[particles.beads]\nmaterial = \"glass\"\ndiameter = \"6 mm\"\n\
             start.at = {{ position = [[0, 0, 0.05], [0.02, 0, 0.05], [0.051, 0.051, 0.05], [0, 0.02, 0.05]] }}\n\
             [walls.barrel]\nmaterial = \"glass\"\n{shape}\n"
        );
        let engine = opened(&told, folder.path()).unwrap();
        let [note] = engine.notes() else { panic!("{name}: {:?}", engine.notes()) };
        assert!(note.key == "particles.beads.start.at.position[2]", "{name}: {note:?}");
        assert!(note.text.contains("1 of the 4 places") && note.text.contains("`barrel`"), "{name}: {note:?}");
    }
}

/// Grains over a terrain, a slope or a plate are beside nothing, nor are those over a narrow pipe and around it.
#[test]
fn open_country_is_no_vessel() {
    let folder = tempfile::tempdir().unwrap();
    let slope = "v -0.1 -0.1 0\nv 0.1 -0.1 0.06\nv 0.1 0.1 0.06\nv -0.1 0.1 0\nf 1 2 3\nf 1 3 4\n";
    std::fs::write(folder.path().join("slope.obj"), slope).unwrap();
    let slope = "[walls.slope]\nmaterial = \"glass\"\nshape.mesh.path = \"slope.obj\"\n";
    let pipe = "[walls.pipe]\nmaterial = \"glass\"\nshape.cylinder = { point = [0, 0, -0.1], axis = \"z\", radius = 0.02, length = 0.1 }\n";
    let places = |wall: &str| {
        let text = format!(
            "{GLASS}[particles.beads]\nmaterial = \"glass\"\ncount = 300\ndiameter = \"6 mm\"\n\
             start.rows.region = {{ low = [-0.05, -0.05, 0.08], high = [0.05, 0.05, 0.2] }}\n{wall}"
        );
        let (engine, hosts, _) = super::run_text(&text, folder.path(), &[]);
        engine.frame(&hosts).vectors(Kind::Grain, "position").to_vec()
    };
    let free = places("");
    for wall in [slope, pipe] {
        assert_eq!(places(wall), free, "{wall}");
    }
}

/// Grains were never taken by a region behind the floor, and nobody said why the bin did not empty.
#[test]
fn removal_behind_a_wall_is_said() {
    let note = |removal: &str, floor: &str| {
        let text = format!(
            "{GLASS}[particles.beads]\nmaterial = \"glass\"\ndiameter = \"6 mm\"\nstart.at.position = [[0, 0, 0.01]]\n\
             [walls.floor]\nmaterial = \"glass\"\n{floor}\n[removal.below]\n{removal}\n"
        );
        let engine = opened(&text, Path::new(".")).unwrap();
        engine.notes().iter().map(|note| format!("{}: {}", note.key, note.text)).collect::<Vec<String>>().join("\n")
    };
    let (plane, bin) = ("shape.plane = {}", "shape.box = { width = 0.1, depth = 0.1, height = 0.1 }");
    let below = "behind = { point = [0, 0, -0.01], normal = \"z\" }";
    for floor in [plane, bin] {
        let said = note(below, floor);
        assert!(said.starts_with("removal.below: no grain leaves there: it lies behind the wall `floor`;"), "{said}");
        assert_eq!(note("behind = { point = [0, 0, 0.01], normal = \"z\" }", floor), "");
    }
    assert_eq!(note(below, "shape.plane = {}\nuntil = 0.05"), "", "a gate opens");
}

/// A normal that points the wrong way took all grains away at once, and the run went on without them and without a word.
#[test]
fn removal_of_all_grains_at_once_is_said() {
    let notes = |removal: &str| {
        let text = format!(
            "{GLASS}[particles.beads]\nmaterial = \"glass\"\ndiameter = \"6 mm\"\n\
             start.at.position = [[0, 0, 0.01], [0, 0, 0.03]]\n[removal.bin]\n{removal}\n"
        );
        let engine = opened(&text, Path::new(".")).unwrap();
        engine.notes().iter().map(|note| format!("{}: {}", note.key, note.text)).collect::<Vec<String>>().join("\n")
    };
    let wrong = notes("behind = { point = [0, 0, 0], normal = \"-z\" }");
    assert!(wrong.starts_with("removal.bin: all grains that forces move begin in there"), "{wrong}");
    assert!(wrong.ends_with("does `normal` point to where grains stay?"), "{wrong}");
    assert!(
        notes("inside.region = { low = [-1, -1, -1], high = [1, 1, 1] }").contains("move it to where grains leave")
    );
    assert_eq!(notes("inside.region = { low = [-1, -1, -1], high = [1, 1, 0.02] }"), "", "one of two is meant so");
    assert_eq!(notes("behind = { point = [0, 0, 0], normal = \"z\" }"), "");
}

/// Over a mesh the speed scale was 1 m/s, whatever grains fell through; contacts and the time step were judged at it.
#[test]
fn the_speed_scale_knows_how_far_grains_fall() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("sheet.obj"), "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n")
        .unwrap();
    let speed = |wall: &str| {
        let text = format!(
            "gravity = 10\n{}[particles.bead]\nmaterial = \"glass\"\ndiameter = \"6 mm\"\nstart.at.position = [[0, 0, 5]]\n\
             [walls.floor]\nmaterial = \"glass\"\n{wall}\n",
            GLASS.replace("speed-scale = 1\n", "")
        );
        let scene = Scene::parse("test", &text, folder.path(), &[]).unwrap_or_else(|c| panic!("{c}"));
        tsubu::check::speed_scale(scene.plan(), &Hosts::default())
    };
    for wall in
        ["shape.mesh.path = \"sheet.obj\"", "shape.plane = {}", "shape.sphere = { centre = [0, 0, 1], radius = 1 }"]
    {
        assert!((speed(wall) - 10.0).abs() < 1e-9, "{wall}: {}", speed(wall));
    }
    // Nothing to fall onto.
    assert_eq!(speed("shape.plane = { point = [1, 0, 0], normal = \"-x\" }"), 1.0);
}

/// Grains that begin in touch and slide: before the first step no tangential spring is stretched, whatever their speed. The book of a pressed core did not close
/// where the energy at time 0 was that of a first step.
#[test]
fn springs_hold_nothing_before_the_first_step() {
    let elastic = |speed: f64| {
        let text = format!(
            "{GLASS}[contact.tangential.mindlin]\n[particles.pair]\nmaterial = \"glass\"\ndiameter = \"6 mm\"\n\
             start.at = {{ position = [[0, 0, 0], [0.005995, 0, 0]], velocity = [[0, 0, {speed}], [0, 0, 0]] }}\n"
        );
        opened(&text, Path::new("")).unwrap().grain_energies().elastic
    };
    let at_rest = elastic(0.0);
    assert!(at_rest > 0.0);
    assert_eq!(elastic(0.5), at_rest);
}
