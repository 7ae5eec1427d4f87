//! What the keys mean that are about ends of the world, shapes, sizes, starts, motions and the wider contact law; and
//! what a user reads when they are wrong.

use crate::{complaint, read};
use tsubu_scene::plan::*;

/// A grain above a floor in space.
const SPACE: &str = r#"dimension = 3
duration = "2 s"
[materials.steel]
young-modulus = "200 GPa"
density = 6000
[particles.sand]
material = "steel"
count = 1
diameter = "10 mm"
start.at = { position = [[0, 0, "50 mm"]] }
[walls.floor]
material = "steel"
shape.plane = {}
"#;

const START: &str = "start.at = { position = [[0, 0, \"50 mm\"]] }";
const FLAT: &str = "start.at = { position = [[0, \"50 mm\"]] }";

fn edited(from: &str, to: &str) -> String {
    assert!(SPACE.contains(from), "the scene has no `{from}`");
    SPACE.replacen(from, to, 1)
}

/// The same in the plane.
fn flat(text: &str) -> String {
    text.replace("dimension = 3", "dimension = 2").replace(START, FLAT)
}

fn with(more: &str) -> String {
    format!("{SPACE}{more}\n")
}

fn plan(text: &str) -> Plan {
    read(text, &[]).unwrap_or_else(|complaints| panic!("{complaints}\n{text}")).plan().clone()
}

/// The messages about several texts, one after the other.
fn all(texts: &[String]) -> String {
    texts.iter().map(|text| complaint(text, &[])).collect::<Vec<_>>().join("\n\n")
}

fn contact(more: &str) -> Contact {
    plan(&with(&format!("[contact]\n{more}"))).contact
}

#[test]
fn the_contact_law_takes_its_parts() {
    assert_eq!(contact("damping.rate.rate = \"50 1/s\"").damping, Damping::Rate { rate: 50.0 });
    let dashpot = contact("damping.dashpot.coefficient = \"0.5 N s/m\"").damping;
    assert_eq!(dashpot, Damping::Dashpot { coefficient: 0.5 });
    let mindlin = |more: &str| contact(&format!("tangential.mindlin = {{ {more} }}")).tangential;
    assert_eq!(mindlin(""), Tangential::Mindlin { form: MindlinForm::Incremental, damping: None });
    assert_eq!(mindlin("damping = \"automatic\""), mindlin(""));
    let secant = Tangential::Mindlin { form: MindlinForm::Secant, damping: Some(0.0) };
    assert_eq!(mindlin("form = \"secant\", damping = 0"), secant);
    let hooke = "normal.hooke.stiffness = 1e5\n";
    let spring = contact(&format!("{hooke}tangential.spring = {{}}")).tangential;
    assert_eq!(spring, Tangential::Spring { ratio: 2.0 / 7.0, damping: 0.0, cohesion: 0.0 });
    let rolling = |more: &str| contact(&format!("rolling.{more}")).rolling;
    assert_eq!(rolling("viscous.coefficient = \"2 s/m\""), Rolling::Viscous { coefficient: 2.0 });
    assert_eq!(rolling("epsd = {}"), Rolling::Epsd { ratio: 2.25, damping_ratio: 0.3 });
    assert_eq!(rolling("epsd2 = {}"), Rolling::Epsd2 {});
    assert_eq!(rolling("spring.stiffness = \"1 N/mm\""), Rolling::Spring { stiffness: 1000.0, damping: 0.0 });
    assert_eq!(rolling("contact-width = {}"), Rolling::ContactWidth { smoothing_speed: 1e-3 });
    assert_eq!(contact("twisting.sliding = {}").twisting, Twisting::Sliding { smoothing_spin: 1.0 });
    assert_eq!(contact("twisting.spring = {}").twisting, Twisting::Spring {});
    assert_eq!(contact("cohesion.jkr = {}").cohesion, Cohesion::Jkr {});
    assert_eq!(contact("").cohesion, Cohesion::None {});
    let plane = plan(&flat(&with("[contact]\nrolling.epsd = {}"))).contact.rolling;
    assert_eq!(plane, Rolling::Epsd { ratio: 3.0, damping_ratio: 0.3 }, "discs roll stiffer");
}

#[test]
fn cohesion_has_the_unit_of_its_part() {
    let scene = |typed: &str, part: &str| {
        with(&format!("[contact]\ncohesion.{part} = {{}}")).replace("density", &format!("cohesion = {typed}\ndensity"))
    };
    let value = |typed: &str, part: &str| plan(&scene(typed, part)).materials["steel"].cohesion;
    assert_eq!(value("\"3 mN\"", "constant"), 0.003);
    assert_eq!(value("\"3 kPa\"", "sjkr"), 3000.0);
    assert_eq!(value("7", "sjkr"), 7.0);
    assert_eq!((value("\"3 mN\"", "none"), value("\"3 kPa\"", "none")), (0.003, 3000.0), "nobody reads it");
    insta::assert_snapshot!(all(&[
        scene("\"3 kPa\"", "constant"),
        scene("\"3 mN\"", "sjkr"),
        scene("\"3 mm\"", "jkr")
    ]));
}

#[test]
fn contact_parts_that_do_not_go_together() {
    let hooke = "normal.hooke.stiffness = 1e5\n";
    let texts = [
        hooke.to_string(),
        format!("{hooke}tangential.mindlin = {{}}"),
        "tangential.spring = {}".to_string(),
        format!("{hooke}tangential.coulomb = {{}}\ncohesion.jkr = {{}}"),
        "tangential.coulomb = {}\nrolling.epsd2 = {}\ntwisting.spring = {}".to_string(),
    ];
    insta::assert_snapshot!(all(&texts.map(|more| with(&format!("[contact]\n{more}")))));
}

#[test]
fn discs_weigh_what_discs_weigh() {
    let disc = edited(START, &format!("{START}\nshape.disc.thickness = \"2 mm\""));
    let mass = plan(&flat(&disc)).particles["sand"].mass;
    assert!((mass / (6000.0 * std::f64::consts::FRAC_PI_4 * 1e-4 * 2e-3) - 1.0).abs() < 1e-14, "{mass}");
    insta::assert_snapshot!(complaint(&disc, &[]));
}

#[test]
fn a_distribution_tells_its_mean() {
    let sized = |size: &str| {
        edited("diameter = \"10 mm\"", &format!("size.{size}")).replace(START, "start.rows = { spacing = 1 }")
            + "[walls.box]\nmaterial = \"steel\"\nshape.box = { width = 1, height = 1, depth = 1 }\n"
    };
    let diameter = |size: &str| plan(&sized(size)).particles["sand"].diameter;
    assert_eq!(diameter("uniform = { smallest = \"1 mm\", largest = \"3 mm\" }"), 0.002);
    assert_eq!(diameter("normal = { mean = \"4 mm\", deviation = \"1 mm\" }"), 0.004);
    let log = diameter("log-normal = { median = \"4 mm\", deviation = 0.5 }");
    assert!((log / (0.004 * 0.125_f64.exp()) - 1.0).abs() < 1e-14);
    assert!(read(&sized("uniform = { smallest = 0.001, largest = 0.003 }\ndiameter = 0.002"), &[]).is_ok());
    assert!(read(&sized("equal = {}\ndiameter = 0.002"), &[]).is_ok());
    let wrong = [
        "uniform = { smallest = \"3 mm\", largest = \"1 mm\" }",
        "uniform = { smallest = \"1 mm\", largest = \"3 mm\" }\ndiameter = \"1.5 mm\"",
        "normal = { mean = \"4 mm\", deviation = \"2 mm\" }",
        "sieve = { diameter = [0.001, 0.002], passing = [0.1, 0.5, 1] }",
        "sieve = { diameter = [0.002, 0.001, 0.003], passing = [0.1, 0.05, 0.9] }",
        "equal = {}",
        // Per cent instead of shares: one complaint a number, and none of a diameter that the sieves would tell.
        "sieve = { diameter = [0.001, 0.002, 0.003], passing = [0, 50, 100] }",
    ];
    insta::assert_snapshot!(all(&wrong.map(sized)));
}

#[test]
fn places_and_drawn_sizes_exclude_each_other() {
    let size = "size.uniform = { smallest = 0.001, largest = 0.003 }";
    insta::assert_snapshot!(complaint(&edited("diameter = \"10 mm\"", size), &[]));
}

#[test]
fn regions_may_be_round() {
    let start = |text: &str| edited(START, &format!("start.random = {{ region.{text} }}"));
    let Start::Random { region: Some(ball), .. } =
        &plan(&start("sphere = { centre = [0, 0, \"2 m\"], radius = \"1 m\" }")).particles["sand"].start.clone()
    else {
        panic!("no region")
    };
    assert_eq!((ball.low, ball.high), ([-1.0, -1.0, 1.0], [1.0, 1.0, 3.0]));
    let wrong = [
        "low = [0, 0, 0]",
        "sphere.centre = [0, 0, 0]",
        "sphere = { centre = [0, 0, 2], radius = 1 }, region.low = [0, 0, 0]",
        "cylinder = { radius = 1, length = 1 }, region.sphere.radius = 1",
    ];
    insta::assert_snapshot!(all(&wrong.map(|text| edited(START, &format!("start.random = {{ region.{text} }}")))));
}

#[test]
fn grains_start_in_regions() {
    let region = "region = { low = [-0.1, -0.1, 0], high = [0.1, 0.1, \"20 cm\"] }";
    let start = |text: &str| plan(&edited(START, text)).particles["sand"].start.clone();
    let expected = Region::of_box([-0.1, -0.1, 0.0], [0.1, 0.1, 0.2]);
    let random = start(&format!("start.random = {{ {region}, velocity = [0, 0, \"-1 m/s\"] }}"));
    let down = [0.0, 0.0, -1.0];
    assert_eq!(random, Start::Random { region: Some(expected.clone()), velocity: down, speed: 0.0 });
    let stream = start(&format!("start.stream = {{ {region}, rate = \"60 1/min\", from = \"1 s\" }}"));
    let velocity = [0.0; 3];
    assert_eq!(stream, Start::Stream { region: expected.clone(), rate: 1.0, velocity, speed: 0.0, from: 1.0 });
    let rows = start(&format!("start.rows = {{ {region} }}"));
    assert_eq!(rows, Start::Rows { spacing: 1.05, jitter: 0.5, speed: 0.0, region: Some(expected) });
}

#[test]
fn regions_that_cannot_be() {
    let region = |low: &str, high: &str| format!("region = {{ low = {low}, high = {high} }}");
    let good = region("[-0.1, -0.1, 0]", "[0.1, 0.1, 0.2]");
    let start = |text: String| edited(START, &format!("start.{text}"));
    let boxed = |text: String| {
        start(text) + "[walls.box]\nmaterial = \"steel\"\nshape.box = { width = 0.1, height = 1, depth = 1 }\n"
    };
    let texts = [
        start(format!("random.{}", region("[-0.1, 0.1, 0]", "[0.1, -0.1, 0.2]"))),
        start(format!("random.{}", region("[0, 0, 0]", "[0.001, 0.1, 0.2]"))),
        start(format!("random.{good}")).replace("count = 1", "count = 100000"),
        start(format!("rows.{good}")).replace("count = 1", "count = 100000"),
        start(format!("stream = {{ {good}, rate = 0 }}")),
        start(format!("stream = {{ {good}, rate = 10, from = \"2 s\" }}")),
        start("stream.rate = 10".to_string()),
        start("random = {}".to_string()),
        boxed(format!("random.{good}")),
        start(format!("random.{}", region("[-0.1, -0.1, -0.01]", "[0.1, 0.1, 0.2]"))),
        start(format!("random.{good}")) + "[periodic]\nx = [-0.05, 0.05]\n",
        with("[removal.out]\ninside.region = { low = [0, 0, 1], high = [1, 1, 1] }"),
    ];
    insta::assert_snapshot!(all(&texts));
}

#[test]
fn the_world_repeats_itself() {
    let world = plan(&with("[periodic]\nx = [\"-30 mm\", \"20 mm\"]\ny = [-1, 1]")).periodic;
    assert_eq!(world, Periodic { x: Some([-0.03, 0.02]), y: Some([-1.0, 1.0]), z: None });
    assert_eq!(plan(SPACE).periodic, Periodic::default());
    // Grains touch across the ends.
    let pair = |x: &str| edited(START, &format!("start.at.position = [[0.001, 0, 0.05], [{x}, 0, 0.05]]"));
    let scene = |x: &str| pair(x).replace("count = 1", "count = 2") + "[periodic]\nx = [0, 0.1]\n";
    assert!(read(&scene("0.09"), &[]).is_ok());
    let closed =
        "[walls.box]\nmaterial = \"steel\"\nshape.box = { width = 1, height = 1, depth = 1 }\n[periodic]\nz = [0, 1]";
    let texts = [
        scene("0.092"),
        scene("0.2"),
        with("[periodic]\nx = [1, 1]"),
        with("[periodic]\nx = [0]"),
        with("[periodic]\nx = 3"),
        with("[periodic]\nx = [\"-10 mm\", \"10 mm\"]"),
        flat(&with("[periodic]\ny = [0, 1]")),
        with(closed),
    ];
    insta::assert_snapshot!(all(&texts));
}

#[test]
fn grains_vanish_where_they_are_told_to() {
    let text = with(
        "[removal.out.inside]\nregion = { low = [0, 0, 0], high = [1, 1, 1] }\n[removal.low]\nbehind.normal = [0, 0, 2]",
    );
    let removal = plan(&text).removal;
    assert_eq!(removal["out"], Removal::Inside { region: Region::of_box([0.0; 3], [1.0; 3]) });
    assert_eq!(removal["low"], Removal::Behind { point: [0.0; 3], normal: [0.0, 0.0, 1.0] });
    let change = |text: &str| read(&with("[removal.low.behind]"), &[text]);
    let moved = change("removal.low.behind.point=[0, 0, -1]").unwrap_or_else(|wrong| panic!("{wrong}"));
    assert_eq!(moved.plan().removal["low"], Removal::Behind { point: [0.0, 0.0, -1.0], normal: [0.0, 0.0, 1.0] });
    let region = "removal.low.inside={ region = { low = [0, 0, 0], high = [1, 1, 1] } }";
    assert!(matches!(change(region).expect("chosen").plan().removal["low"], Removal::Inside { .. }));
    let texts = [
        with("[removal.low.below]\npoint = [0, 0, 0]"),
        with("[removal.low]"),
        with("[removal]\nlow = 3"),
        with("[removal.low.behind]\nregion = 1"),
    ];
    let changed = ["removal.high.behind={}", "removal.low.beyond={}"]
        .map(|change| complaint(&with("[removal.low.behind]"), &[change]));
    insta::assert_snapshot!([all(&texts), changed.join("\n\n")].join("\n\n"));
}

/// No time to settle in skipped it, and grains began in the air without a word.
#[test]
fn settling_takes_time() {
    let text = edited(START, "start.settled.time = 0");
    let refused = read(&text, &[]).expect_err("no time").to_string();
    assert!(refused.contains("`time` must be above 0"), "{refused}");
}

#[test]
fn grains_are_free_frozen_or_driven() {
    let motion = |text: &str| plan(&edited(START, &format!("{START}\nmotion.{text}"))).particles["sand"].motion.clone();
    assert_eq!(motion("frozen = {}"), GrainMotion::Frozen {});
    let signal = Signal::Steady { rate: 0.01 };
    assert_eq!(
        motion("driven = { direction = \"-x\", signal.steady.rate = \"10 mm/s\" }"),
        GrainMotion::Driven { direction: [-1.0, 0.0, 0.0], signal }
    );
    let held = |start: &str| edited(START, &format!("{start}\nmotion.frozen = {{}}"));
    let region = "region = { low = [-0.1, -0.1, 0], high = [0.1, 0.1, 0.2] }";
    let texts = [
        held("start.settled = {}"),
        held(&format!("start.stream = {{ {region}, rate = 1 }}")),
        held(&format!("start.random = {{ {region}, velocity = [0, 0, 1] }}")),
        held("start.at = { position = [[0, 0, 1]], velocity = [[0, 0, 1]] }"),
        held("start.at = { position = [[0, 0, 1]], spin = [[0, 0, 1]] }"),
    ];
    insta::assert_snapshot!(all(&texts));
}

#[test]
fn frozen_grains_may_overlap_and_stand_in_walls() {
    let bed = "start.at.position = [[0, 0, 0], [0.005, 0, 0]]\nmotion.frozen = {}";
    assert!(read(&edited(START, bed).replace("count = 1", "count = 2"), &[]).is_ok());
    let free = edited(START, &bed.replace("frozen", "free")).replace("count = 1", "count = 2");
    assert_eq!(read(&free, &[]).expect_err("overlap, and in the floor").len(), 3);
    let other = "[particles.other]\nmaterial = \"steel\"\ndiameter = 0.01\nstart.at.position = [[0.005, 0, 0.005]]\n";
    let mixed = edited(START, bed).replace("count = 1", "count = 2") + other;
    let message = read(&mixed, &[]).expect_err("a free grain in a frozen one").to_string();
    assert!(message.contains("grains 0 of `other` and 1 of `sand` overlap"), "{message}");
}

#[test]
fn walls_have_shapes() {
    let shape = |text: &str| plan(&edited("shape.plane = {}", &format!("shape.{text}"))).walls["floor"].shape.clone();
    let axis = [0.0, 1.0, 0.0];
    assert_eq!(
        shape("cylinder = { radius = \"1 m\" }"),
        Shape::Cylinder { point: [0.0; 3], axis, radius: 1.0, length: None }
    );
    let cone = Shape::Cone { point: [0.0; 3], axis: [0.0, 0.0, 1.0], radius: 0.0, end_radius: 1.0, length: 2.0 };
    assert_eq!(shape("cone = { radius = 0, end-radius = 1, length = 2 }"), cone);
    assert_eq!(
        shape("sphere = { centre = [0, 0, 1], radius = 0.5 }"),
        Shape::Sphere { centre: [0.0, 0.0, 1.0], radius: 0.5 }
    );
    let drum = flat(&edited("shape.plane = {}", "shape.cylinder = { axis = \"-y\", radius = 1 }"));
    assert!(matches!(plan(&drum).walls["floor"].shape, Shape::Cylinder { axis: [0.0, -1.0, 0.0], .. }));
    let bad = |text: &str| edited("shape.plane = {}", &format!("shape.{text}"));
    let texts = [
        bad("cylinder = {}"),
        flat(&bad("cylinder = { radius = 1, length = 2 }")),
        bad("cone = { radius = 0, end-radius = 0, length = 2 }"),
        flat(&bad("cone = { axis = \"y\", radius = 0, end-radius = 1, length = 2 }")),
        bad("sphere = { centre = [0, 0, 0], radius = \"48 mm\" }"),
    ];
    insta::assert_snapshot!(all(&texts));
}

#[test]
fn walls_turn() {
    let turn = |text: &str| plan(&with(text)).walls["floor"].rotation.clone().expect("turns");
    let rotation = turn("rotation = { axis = \"z\", signal.steady.rate = \"30 rpm\" }");
    assert_eq!((rotation.centre, rotation.axis), ([0.0; 3], [0.0, 0.0, 1.0]));
    assert_eq!(rotation.signal, Signal::Steady { rate: std::f64::consts::PI });
    let rocking = "rotation = { axis = [0, 0, 1], signal.sine = { amplitude = \"180 deg\", frequency = 1 } }";
    assert!(matches!(turn(rocking).signal, Signal::Sine { amplitude: std::f64::consts::PI, .. }));
    let both = "motion.signal.steady.rate = \"1 m/s\"\nrotation = { axis = \"z\", signal.steady.rate = 1 }";
    assert!(plan(&with(both)).walls["floor"].motion.is_some());
    let spin = "rotation = { axis = \"x\", signal.steady.rate = 1 }";
    let drum = edited("shape.plane = {}", "shape.cylinder = { axis = \"z\", radius = 1 }");
    let texts = [
        with(spin),
        format!("{drum}{spin}\n"),
        flat(&with(spin)),
        with("rotation = { axis = \"z\", signal.steady.rate = \"1 m/s\" }"),
        with("rotation = { axis = \"z\", signal.sine = { amplitude = \"1 mm\", frequency = 1 } }"),
        with("motion.signal.steady.rate = \"1 rad/s\""),
        with(
            "host = \"a\"\nrotation = { axis = \"z\", signal.steady.rate = 1 }\n[hosts.a]\nstructure.oscillator = { mass = 1, stiffness = 1, damping = 0 }",
        ),
    ];
    insta::assert_snapshot!(all(&texts));
    let round = format!("{}{}\n", drum.replace("radius = 1", "radius = 1, length = 1"), spin);
    assert!(read(&round, &[]).is_ok(), "a piece may turn about anything");
}

#[test]
fn walls_are_pushed_or_free() {
    let servo = |text: &str| with(&format!("servo = {{ direction = \"-z\", mass = 2, {text} }}"));
    let pushed = |text: &str| plan(&servo(text)).walls["floor"].servo.clone().expect("pushed");
    let expected = Servo { direction: [0.0, 0.0, -1.0], force: Some(20.0), mass: 2.0, pressure: None, damping: 0.0 };
    assert_eq!(pushed("force = \"20 N\""), expected);
    assert_eq!(pushed("pressure = \"1 kPa\", area = \"200 cm^2\""), expected);
    let body =
        |shape: &str, text: &str| edited("shape.plane = {}", &format!("shape.{shape}\nbody = {{ mass = 2, {text} }}"));
    let ball = "sphere = { centre = [0, 0, 1], radius = 0.1 }";
    let free = plan(&body(ball, "inertia = [1, \"2 kg m^2\", 3], centre = [0, 0, 1]")).walls["floor"].body.clone();
    let expected =
        Body { mass: 2.0, inertia: [1.0, 2.0, 3.0], centre: [0.0, 0.0, 1.0], velocity: [0.0; 3], spin: [0.0; 3] };
    assert_eq!(free, Some(expected));
    let disc =
        flat(&body("sphere = { centre = [0, 1], radius = 0.1 }", "inertia = 3, centre = [0, 1], spin = \"1 rad/s\""));
    let disc = plan(&disc).walls["floor"].body.clone().expect("free");
    assert_eq!((disc.inertia, disc.spin), ([0.0, 3.0, 0.0], [0.0, 1.0, 0.0]));
    let texts = [
        servo("damping = 1"),
        servo("pressure = \"1 kPa\""),
        servo("force = 1, area = 1, pressure = 1"),
        with("servo = { force = 1 }"),
        body("plane = {}", "inertia = [1, 1, 1], centre = [0, 0, 0]"),
        body(ball, "inertia = [1, 1, 3], centre = [0, 0, 1]"),
        body(ball, "inertia = [1, 1, 0], centre = [0, 0, 1]"),
        body(ball, "inertia = 1, centre = [0, 0, 1]"),
        body(ball, "inertia = [1, 1, 1], centre = [0, 0, 1]") + "motion.signal.steady.rate = 1\n",
    ];
    insta::assert_snapshot!(all(&texts));
}
