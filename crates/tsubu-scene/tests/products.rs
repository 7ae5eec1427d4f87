use crate::{GOOD, read};
use proptest::prelude::*;
use std::fs;
use std::path::Path;
use tsubu_scene::plan::{Shape, Start};
use tsubu_scene::{Plan, Scene, TEMPLATES, keys, reference, schema};

fn again(plan: &Plan, text: &str) -> Plan {
    let scene = Scene::parse("run/scene.toml", text, Path::new("/nowhere"), &[]);
    let scene = scene.unwrap_or_else(|complaints| panic!("{complaints}\n{text}"));
    assert_eq!(scene.resolved_toml(), text, "writing it again changes nothing");
    assert_eq!(scene.plan(), plan);
    scene.plan().clone()
}

/// A scene that says something about nearly every key.
const EVERYTHING: &str = r#"
title = "quotes \" and \\ and \u0007"
method = "lattice"
seed = 9223372036854775807
duration = 0.1
gravity = ["1 mm/s^2", -9.81]
speed-scale = "1 m/s"
design = { goal = "band", levels = [0.5, 1.0], mass-limit = "15 g", stroke-limit = "5 mm", space-limit = "0.5 L", envelope = { width = "70 mm", height = 0.1 }, cost-limit = 12, cost = { a = { per-kilogram = 3.5 }, "b c" = { per-grain = 0.02 } }, runs = 300, within = 0.02, cheap = "lattice", until = 0.05, seeds = 4, vary = { "contact.attraction" = [false, true], "dem.skin" = { from = 0.1, to = 0.5 } } }
material-pair = [{ between = ["a", "b c"], friction = 0.6, contact.normal.hooke.stiffness = "3 kN/m" }]

[materials.a]
young-modulus = 1e15
poisson-ratio = -0.3333333333333333
density = 1e-9
[materials."b c"]
young-modulus = "3 GPa"

[particles.first]
material = "a"
diameter = "0.1 mm"
start.at = { position = [[0.1, 0.3], [0.2, "1/3 m"]], spin = ["95 rpm", 0.1] }
[particles.second]
material = "a"
count = 7
diameter = 3.3e-3
mass = "0.7 mg"
start.rows = { spacing = 1.1 }

[walls.box]
material = "b c"
shape.box = { width = 1, height = 0.7, floor-centre = [0.05, 0] }
motion = { direction = [1, 2], signal.sine-sweep = { acceleration = "0.1 g", from = 1, to = 10, duration = 3, scale = "logarithmic" } }
[walls.below]
material = "a"
host = "two"
interface = "tip"
shape.plane = { point = [0, -1], normal = [0.1, 1] }

[hosts.one]
structure.oscillator = { mass = 0.1, stiffness = 3, damping-ratio = 0.1 }
base.sine = { amplitude = 0.001, frequency = 3, phase = "40 deg" }
[hosts.two]
copies = 2.5
structure.matrices = { mass = [[2, 0], [0, 1]], damping = [[0.1, 0], [0, 0.1]], stiffness = [[3, -1], [-1, 2]], gyroscopic = [[0, 0.1], [-0.1, 0]], speed = "90 rpm", coordinate = 1 }
force.impact = { peak = "3 N", duration = "2 ms" }
at = "tip"
interface.tip = { point = [0, 0, "3 cm"], translation = [[0, 0, 1], [1, 0, 0]], rotation = [[0, "2 rad/m", 0], [0, 0, 0]] }
[hosts.three]
structure.modes.mode = [{ frequency = 3, damping-ratio = 0.01, mass = 0.2 }, { frequency = 7, damping-ratio = 0.02, mass = 0.1, shape = -0.3 }]
base.table = { time = [0, "10 ms", 0.3], value = [0, "1 mm", 0] }

[contact]
normal.hooke.stiffness = "1 kN/m"
damping.sqrt = {}
tangential.coulomb = {}
rolling.constant = {}
attraction = true

[cl-ca]
spacing = "1 mm"
fall-height = "0.1 m"
rule = "active"
memory = 3
turning = true
region = { low = [-1, 0], high = [1, 2] }
gravity-switch = { down = 20, up = 5 }
shapes.balls.polygon.corners = [[0, 0], [1, 1], [0, 2]]

[litwiniszyn]
time-step = "20 ms"

[after-caram-hong]
rate = 0.5
time-step = "20 ms"

[after-savage]
up = 0.1
time-step = "20 ms"

[gutt-haff]
time-step = "0.1 ms"

[after-hemmingsson-herrmann]
split = "random"
arching = 0.1

[fhp]
rules = "two"
walls = "smooth"
spacing = "1 mm"
time-step = "1 ms"

[after-peng-herrmann]
roughness = 0.5
spacing = "1 mm"
time-step = "1 ms"

[after-baxter-behringer]
way = 2
spacing = "1 mm"
time-step = "1 ms"

[after-karolyi-kertesz]
dissipation = 0.5
spacing = "1 mm"
time-step = "1 ms"

[dem]
time-step = "20 us"
integrator = "forward-euler"

[atlas]
host = "two"
frequency = ["4 Hz", "8 Hz"]
acceleration = ["0.1 g", "3 g"]

[response]
host = "one"
frequency-ratio = { from = 0.7, to = 1.3, step = 0.05 }
peak-within = 0.02
discard-periods = 30
discard-periods-empty = 50
vary = { "particles.second.diameter" = ["3 mm", 0.0031], "contact.attraction" = [true, false] }

[calibrate]
runs = 40
within = 0.2
checks = 3
vary = { "contact.attraction" = [false, true] }
[[calibrate.measured]]
result = "peak"
value = 0.01
uncertainty = 0.001
source = "a test"
[calibrate.curve]
quantity = "rms-displacement"
frequency = ["5 Hz", 6]
value = [1e-3, 2e-3]
uncertainty = [1e-4, 1e-4]
source = "a shaker"

[sweep.vary]
"contact.damping" = [{ quarter = {} }, { linear = { reference-speed = "2 m/s" } }]

[output]
frame-interval = 0.01
xyz = true

[[claim]]
result = "peak"
low = 0.1
source = "theory"
[[claim]]
result = "impacts"
high = 2
source = "theory"
"#;

/// Nearly every key that only makes sense in space, or that the other one had no room for.
pub const IN_SPACE: &str = r#"
title = "in space"
bond = [{ particles = ["bed", "wide"], at = "1 ms", gap = 0.02, radius = 0.5, young-modulus = "2 GPa", poisson-ratio = 0.2, damping = 0.1, tensile-strength = "3 MPa", shear-strength = "4 MPa", weibull-modulus = 5 }]
dimension = 3
duration = 1

[materials.steel]
young-modulus = "200 GPa"
density = "7800 kg/m^3"
twisting-friction = 0.1
surface-energy = "50 mJ/m^2"
cohesion = "2 kPa"

[[material-pair]]
between = ["steel", "steel"]
twisting-friction = 0.2
surface-energy = 0.1
cohesion = "1 Pa"

[periodic]
x = ["-0.5 m", "0.5 m"]
y = [-0.25, 0.25]

[removal.below.behind]
point = [0, 0, -1]
[removal.out]
inside.region = { low = [2, 2, 2], high = [3, 3, 3] }

[particles.bed]
material = "steel"
start.file.path = "bed.csv"
motion.frozen = {}
[particles.bed-b]
material = "steel"
start.file = { path = "some/where/all.data", kind = 2 }
motion.driven = { direction = "x", signal.steady.rate = "1 mm/s" }
[particles.wide]
material = "steel"
count = 3
size.uniform = { smallest = "1 mm", largest = "3 mm" }
start.random = { region = { low = [-0.1, -0.1, 0.3], high = [0.1, 0.1, 0.4] }, velocity = [0, 0, -1], speed = 0.1 }
[particles.normal]
material = "steel"
count = 3
size.normal = { mean = "2 mm", deviation = "0.1 mm" }
start.stream = { region = { low = [-0.1, -0.1, 0.5], high = [0.1, 0.1, 0.6] }, rate = "100 1/s", from = "10 ms" }
[particles.log]
material = "steel"
count = 2
size.log-normal = { median = "2 mm", deviation = 0.2, cut = 2 }
start.rows.region = { low = [-0.1, -0.1, 0.7], high = [0.1, 0.1, 0.8] }
[particles.sieved]
material = "steel"
count = 2
size.sieve = { diameter = ["1 mm", "2 mm"], passing = [0, "100 %"] }
start.rows.region = { low = [-0.1, -0.1, 0.9], high = [0.1, 0.1, 1.0] }

[walls.floor]
material = "steel"
shape.plane.point = [0, 0, -2]
motion.signal.steady.rate = -0.1
[walls.drum]
material = "steel"
shape.cylinder = { point = [5, 0, 0], radius = 1, length = 2 }
rotation = { centre = [5, 0, 0], axis = "-y", signal.steady.rate = "10 rpm" }
[walls.funnel]
material = "steel"
shape.cone = { point = [0, 0, 1.5], radius = 0.1, end-radius = 0.5, length = 0.4 }
servo = { direction = "-z", pressure = "1 kPa", area = "20 cm^2", mass = 3 }
[walls.ball]
material = "steel"
shape.sphere = { centre = [0, 0, 3], radius = 0.2 }
body = { mass = 10, inertia = [1, 2, 3], centre = [0, 0, 3], spin = [0, 0, "1 rpm"] }
[walls.mesh]
material = "steel"
shape.mesh = { path = "a.stl", scale = 0.001, shift = [0, 0, -3] }

[contact]
tangential.mindlin = { form = "secant", damping = 0.5 }
rolling.epsd = {}
twisting.spring = {}
cohesion.sjkr = {}
damping.rate.rate = "300 1/s"
"#;

#[test]
fn a_scene_with_files_means_the_same_in_its_run_folder() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        fs::write(path, text).expect("written");
    };
    write("bed.csv", "x [mm],y [mm],z [mm],d [mm],vx [cm/s]\n0,0,-10,2,1\n3,0,-10,4,-1\n");
    let atoms = "1 1 0.01 1 0 0 0\n7 2 0.02 1 0.1 0.1 0.1\n";
    write(
        "some/where/all.data",
        &format!("title\n2 atoms\n\nAtoms # sphere\n\n{atoms}\nVelocities\n\n1 0 0 0 0 0 0\n7 1 2 3 4 5 6\n"),
    );
    write("a.stl", "solid a\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\nendsolid a\n");
    let scene = Scene::parse("scene.toml", IN_SPACE, folder.path(), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    let Start::File { grains, path, .. } = &scene.plan().particles["bed"].start else { panic!("from a file") };
    assert_eq!(
        (path.as_str(), grains.position[1], grains.diameter[1]),
        ("particles-bed.csv", [0.003, 0.0, -0.01], 0.004)
    );
    let Start::File { grains, .. } = &scene.plan().particles["bed-b"].start else { panic!("from a file") };
    assert_eq!((grains.velocity[0], grains.spin[0]), ([1.0, 2.0, 3.0], [4.0, 5.0, 6.0]));
    let Shape::Mesh { triangles, .. } = &scene.plan().walls["mesh"].shape else { panic!("a mesh") };
    assert_eq!(triangles[0][1], [0.001, 0.0, -3.0]);

    let run = tempfile::tempdir().expect("a temporary folder");
    let names: Vec<String> = scene.companions().into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["particles-bed.csv", "particles-bed-b.data", "walls-mesh.stl"]);
    for (name, bytes) in scene.companions() {
        fs::write(run.path().join(name), bytes).expect("written");
    }
    let text = scene.resolved_toml();
    let again = Scene::parse("scene.toml", &text, run.path(), &[]).unwrap_or_else(|wrong| panic!("{wrong}\n{text}"));
    assert_eq!(again.plan(), scene.plan());
    assert_eq!(again.resolved_toml(), text);
    assert_eq!(again.companions(), scene.companions());
    insta::assert_snapshot!(text);
}

#[test]
fn resolved_scenes_mean_the_same_bit_by_bit() {
    let everything = EVERYTHING.replace("\"1/3 m\"", "0.3333333333333333");
    let templates = TEMPLATES.iter().filter(|template| template.files().is_empty());
    for text in [GOOD, &everything].into_iter().chain(templates.map(|template| template.text)) {
        let scene = read(text, &[]).unwrap_or_else(|complaints| panic!("{complaints}"));
        let plan = again(scene.plan(), &scene.resolved_toml());
        assert_eq!(format!("{plan:?}"), format!("{:?}", scene.plan()), "signs of zero too");
    }
}

proptest! {
    #[test]
    fn any_number_survives_the_run_folder(
        // Every mass that can be meant, and every length down to the smallest number.
        mass in (1.0..10.0_f64, -26..17_i32).prop_map(|(mantissa, exponent)| mantissa * 10.0_f64.powi(exponent)),
        direction in [-1e3..1e3_f64, 1e-3..1e3_f64],
        height in (-10.0..10.0_f64, -308..8_i32).prop_map(|(mantissa, exponent)| mantissa * 10.0_f64.powi(exponent)),
    ) {
        let [x, z] = direction;
        let text = format!("{GOOD}direction = [{x:?}, {z:?}]\ndisplacement = {height:?}\n");
        let scene = read(&text, &[&format!("particles.balls.mass={mass:?}")]).unwrap_or_else(|wrong| panic!("{wrong}"));
        prop_assert_eq!(scene.plan().particles["balls"].mass, mass);
        again(scene.plan(), &scene.resolved_toml());
    }
}

#[test]
fn the_resolved_form_reads_well() {
    insta::assert_snapshot!(read(GOOD, &[]).expect("good").resolved_toml());
}

#[test]
fn every_field_of_the_plan_is_a_key_and_is_written() {
    // What is not in the registry would be lost in the run folder; comparing the trees finds it.
    let everything = EVERYTHING.replace("\"1/3 m\"", "0.3333333333333333");
    // What follows from diameters that a study varies is left out.
    let everything = everything.replace("\"particles.second.diameter\" = [\"3 mm\", 0.0031]", "\"gravity\" = [9.81]");
    let scene = read(&everything, &[]).unwrap_or_else(|complaints| panic!("{complaints}"));
    let mut of_plan = toml::Table::try_from(scene.plan()).expect("plain data");
    of_plan.retain(|_, value| value.as_table().is_none_or(|table| !table.is_empty()));
    // Whether grains spin is said once, for all laws.
    let of_pair = of_plan["material-pair"][0]["contact"].as_table_mut().expect("a law");
    of_pair.retain(|key, _| key != "rotation" && key != "slip-lever");
    let written: toml::Table = scene.resolved_toml().parse().expect("valid");
    assert_eq!(written, of_plan);
}

#[test]
fn templates_are_right_and_named_once() {
    let mut names: Vec<&str> = TEMPLATES.iter().map(|template| template.name).collect();
    for template in TEMPLATES {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
        let scene = Scene::parse("scene.toml", template.text, &folder, &[])
            .unwrap_or_else(|complaints| panic!("{}: {complaints}", template.name));
        assert!(!scene.plan().title.is_empty());
        assert!(template.text.lines().all(|line| line.len() <= 120), "{} has long lines", template.name);
    }
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), TEMPLATES.len());
}

#[test]
fn the_damper_runs_by_both_methods() {
    for method in ["dem", "lattice"] {
        let scene =
            read(TEMPLATES[0].text, &[&format!("method={method}")]).unwrap_or_else(|complaints| panic!("{complaints}"));
        let response = scene.plan().response.as_ref().expect("a response");
        assert_eq!((response.frequency_ratio.len(), response.peak_within), (9, Some(0.01)));
        assert_eq!(response.vary["particles.balls.count"].len(), 4);
    }
}

#[test]
fn the_schema_names_every_key() {
    let text = schema().to_string();
    for key in keys::SCENE {
        assert!(text.contains(&format!("\"{}\"", key.name)), "{}", key.name);
    }
    assert_eq!(schema()["$schema"], "https://json-schema.org/draft/2020-12/schema");
    let small = [&schema()["properties"]["output"], &schema()["properties"]["periodic"]];
    insta::assert_snapshot!(serde_json::to_string_pretty(&small).expect("json"));
}

#[test]
fn the_reference_page_has_a_section_for_every_table() {
    let page = reference();
    for heading in [
        "## `[materials.NAME]`",
        "## `[[claim]]`",
        "### Choice `contact.damping`",
        "`[hosts.NAME.structure.oscillator]`",
    ] {
        assert!(page.contains(heading), "{heading}");
    }
}
