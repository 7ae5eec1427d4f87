//! Watches: what is asked for, what follows from the rest of the scene, what cannot be seen.

use crate::{GOOD, complaint, edited, read};
use tsubu_scene::plan::watch::{Bedload, Profile, Segregation, Slope, WallLoad};
use tsubu_scene::plan::{Axis, Measure, Quantity, Watch};

/// The good scene with watches.
fn with(watches: &str) -> String {
    format!("{GOOD}\n{watches}\n")
}

fn watches(text: &str) -> Vec<(String, Watch)> {
    let scene = read(&with(text), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    let again = read(&scene.resolved_toml(), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    assert_eq!(again.plan(), scene.plan());
    assert_eq!(again.resolved_toml(), scene.resolved_toml());
    scene.plan().watch.clone().into_iter().collect()
}

fn about(text: &str) -> String {
    complaint(&with(text), &[])
}

const SECOND: &str = "[particles.more]\nmaterial = \"glass\"\ncount = 3\ndiameter = \"6 mm\"\n";

#[test]
fn times_and_the_region_follow_from_the_scene() {
    let all = watches(
        "[watch.layers]\nprofile = {}\n[watch.late]\nfrom = \"0.5 s\"\nevery = \"5 ms\"\nuntil = 0.7\ncoordination = {}",
    );
    let (name, layers) = &all[0];
    let (other, late) = &all[1];
    assert_eq!((other.as_str(), late.from, late.every, late.until), ("late", 0.5, Some(0.005), Some(0.7)));
    assert_eq!((name.as_str(), layers.from, layers.until, layers.every), ("layers", 0.0, None, Some(0.001)));
    let Measure::Profile(Profile { axis: Axis::Z, bins: 20, quantities, region }) = &layers.measure else {
        panic!("{layers:?}")
    };
    assert_eq!(quantities[..], [Quantity::SolidFraction, Quantity::Velocity, Quantity::GranularTemperature]);
    assert_eq!((region.low, region.high), ([-0.03, 0.0, 0.0], [0.03, 0.0, 0.096]));
}

/// Watches stood in the order of the alphabet, and so did their results: a calibration showed eight densities and never came
/// to its heap angle, for which it was made and which it named first.
#[test]
fn watches_keep_the_order_in_which_they_are_typed() {
    let all =
        watches("[watch.heap]\nslope.touching = false\n[watch.density]\nprofile = {}\n[watch.a]\ncoordination = {}");
    assert_eq!(all.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), ["heap", "density", "a"]);
}

/// The groups of a mixer stood as they were typed, so that the same scene with its keys in another order had left and right
/// the other way round.
#[test]
fn the_order_of_groups_is_that_of_their_names() {
    let watch = "[watch.a]\nsegregation.cell = \"12 mm\"";
    let before = edited("[particles.balls]", &format!("{SECOND}\n[particles.balls]"));
    for text in [format!("{before}\n{watch}"), with(&format!("{SECOND}{watch}"))] {
        let scene = read(&text, &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
        let Measure::Segregation(Segregation { groups, .. }) = &scene.plan().watch["a"].measure else {
            panic!("no segregation")
        };
        assert_eq!(groups, &["balls", "more"].map(String::from));
    }
}

#[test]
fn every_kind_survives_the_run_folder() {
    let text = format!(
        "{SECOND}
[watch.a]
coarse-grain = {{ kernel = \"gaussian\", width = \"3 mm\", axes = [\"x\", \"z\"], points = [10, 12] }}
[watch.b]
slope = {{ axis = \"x\", share = \"50 %\", touching = false, region = {{ low = [0, 0], high = [\"20 mm\", \"30 mm\"] }} }}
[watch.c]
discharge = {{ point = [0, \"10 mm\"], group = \"more\" }}
[watch.d]
coordination = {{ fewest = 3, region = {{ low = [0, 0], high = [1, 1] }} }}
[watch.e]
fabric = {{}}
[watch.f]
forces.bins = 7
[watch.g]
segregation.cell = \"12 mm\"
[watch.h]
wall-load = {{ wall = \"box\", area = \"1 cm^2\", direction = \"-z\" }}
[watch.i]
track.ids = [0, 22]
[watch.j]
hops = {{ bed = [\"walls\", \"free-grains\"], group = \"more\", along = \"-x\", lowest = \"1 mm\", most = 30 }}
[watch.k]
bedload = {{ group = \"more\", width = \"6 mm\", moving-speed = \"2 cm/s\", fluid-density = 1000 }}
[watch.l]
run-out = {{ direction = \"-x\", share = \"95 %\", bins = 7 }}
"
    );
    let all = watches(&text);
    assert_eq!(all.len(), 12);
    let Measure::Bedload(Bedload { resting_speed, .. }) = all[10].1.measure else { panic!("bedload") };
    assert_eq!(resting_speed, 0.01);
    let Measure::Slope(Slope { centre, .. }) = all[1].1.measure else { panic!("a slope") };
    assert_eq!(centre, 0.01);
    let Measure::Segregation(Segregation { groups, .. }) = &all[6].1.measure else { panic!("segregation") };
    assert_eq!(groups, &["balls", "more"].map(String::from));
}

/// Hops are looked at in every step unless the scene says how often; others are if it asks for it.
#[test]
fn a_watch_can_look_at_every_step() {
    let all = watches(
        "[watch.a]\nhops = {}\n[watch.b]\nevery = \"1 us\"\nhops = {}\n[watch.c]\nevery = \"step\"\nfabric = {}\n[watch.d]\nfabric = {}",
    );
    let every: Vec<Option<f64>> = all.iter().map(|(_, watch)| watch.every).collect();
    assert_eq!(every, [None, Some(1e-6), None, Some(0.001)]);
}

#[test]
fn hops_that_nobody_could_see() {
    let text = "[watch.a]\nevery = \"steps\"\nhops = { most = 0, lowest = \"-1 mm\" }\n[watch.b]\nhops = { bed = [], up = \"x\" }\n[watch.c]\nhops = { bed = [\"sand\"] }\n[watch.d]\nhops.along = [1, 0.1]\n[watch.e]\nhops.bed = [\"fixed-grains\"]";
    insta::assert_snapshot!(about(text));
}

#[test]
fn transport_that_cannot_be() {
    let text = "[watch.a]\nbedload = { axis = \"y\", moving-speed = \"1 mm/s\", resting-speed = \"2 mm/s\" }\n[watch.b]\nbedload = { width = 0, fluid-density = \"20000 kg/m^3\" }\n[watch.c]\nbedload = { moving-speed = 0, group = \"bals\" }\n[watch.d]\nrun-out = { direction = \"y\", share = 1.5, bins = 0 }\n[watch.e]\nrun-out.direction = \"z\"";
    insta::assert_snapshot!(about(text));
    let weightless = "[watch.a]\nbedload.fluid-density = 1000";
    insta::assert_snapshot!(complaint(&with(weightless), &["gravity=0"]));
}

#[test]
fn a_plane_is_pressed_against_its_normal() {
    let all = watches(
        "[walls.floor]\nmaterial = \"glass\"\nshape.plane.point = [0, -1]\n[watch.w]\nwall-load = { wall = \"floor\", area = 1 }",
    );
    let Measure::WallLoad(WallLoad { direction, .. }) = all[0].1.measure else { panic!("a load") };
    assert_eq!(direction, Some([0.0, 0.0, -1.0]));
}

#[test]
fn another_kind_can_be_set_from_outside() {
    let text = with("[watch.a]\nprofile.bins = 3");
    let measure = |changes: &[&str]| {
        read(&text, changes).unwrap_or_else(|wrong| panic!("{wrong}")).plan().watch["a"].measure.clone()
    };
    let Measure::Profile(Profile { bins: 3, axis: Axis::X, .. }) = measure(&["watch.a.profile.axis=x"]) else {
        panic!("a profile")
    };
    assert_eq!(measure(&["watch.a.fabric={}"]).name(), "fabric");
}

#[test]
fn watches_that_say_nothing_or_too_much() {
    insta::assert_snapshot!(about(
        "[watch.a]\nevery = 0.1\n[watch.b]\nfabric = {}\ncoordination = {}\n[watch.\"c/d\"]\nfabric = {}\n[watch.e]\nprofil = {}"
    ));
}

#[test]
fn times_that_never_come() {
    insta::assert_snapshot!(about(
        "[watch.a]\nevery = 0\nfabric = {}\n[watch.c]\nfrom = 0.5\nuntil = 0.3\nfabric = {}"
    ));
}

#[test]
fn places_where_nothing_is() {
    let text = "[watch.a]\nprofile.region = { low = [0, -2], high = [1, -1] }\n[watch.b]\nprofile.region = { low = [0, 0], high = [0, 1] }\n";
    let still = with(text).replace("host = \"spring\"\n", "");
    insta::assert_snapshot!(complaint(&still, &[]));
}

#[test]
fn regions_that_nobody_can_guess() {
    let text = with("[watch.a]\nprofile = {}\n[watch.b]\nslope.region = { low = [-1, 0], high = [0.5, 1] }");
    let plane = text
        .replace("host = \"spring\"\nshape.box = { width = \"60 mm\", height = \"96 mm\" }", "shape.plane = {}")
        .replace(
            "mass = \"0.2 g\"",
            "mass = \"0.2 g\"\nstart.random.region = { low = [-0.1, 0.1], high = [0.1, 0.2] }",
        );
    insta::assert_snapshot!(complaint(&plane, &["periodic.x=[-0.5, 0.5]"]));
}

#[test]
fn names_that_are_not_there() {
    insta::assert_snapshot!(about(
        "[watch.a]\nwall-load.wall = \"bax\"\n[watch.b]\ndischarge.group = \"bals\"\n[watch.c]\nsegregation = { groups = [\"balls\", \"sand\"], cell = 1 }\n[watch.d]\ntrack.ids = [3, 20]\n[watch.e]\ntrack.ids = [3, 3]"
    ));
}

#[test]
fn numbers_that_make_no_sense() {
    insta::assert_snapshot!(about(
        "[watch.a]\nprofile = { bins = 0, quantities = [] }\n[watch.b]\ncoarse-grain = { width = 0, points = [0] }\n[watch.c]\ncoarse-grain = { width = 1, axes = [\"x\", \"x\"], points = [3] }\n[watch.d]\ncoarse-grain = { width = 1, axes = [\"x\", \"z\"], points = [3] }\n[watch.e]\ncoarse-grain = { width = 1, axes = [\"x\", \"z\"], points = [3000, 3000] }\n[watch.f]\nprofile = { axis = \"y\", quantities = [\"solid-fracton\"] }\n[watch.g]\nslope = { axis = \"z\", share = 1.5 }"
    ));
}

#[test]
fn groups_and_directions_that_are_missing() {
    insta::assert_snapshot!(about(
        "[watch.a]\nsegregation.cell = 1\n[watch.b]\nsegregation = { cell = 1, groups = [\"balls\"] }\n[watch.c]\nwall-load = { wall = \"box\", area = 1 }\n[watch.d]\nwall-load = { wall = \"box\", direction = \"x\" }\n[watch.e]\nprofile.axis = \"y\""
    ));
}

/// The face of a box that turns has no direction of its own: its load was that of another side once the pendulum had swung.
#[test]
fn a_face_is_of_a_box_that_does_not_turn() {
    let face = "[watch.a]\nwall-load = { wall = \"box\", face = \"floor\" }\n";
    let (oscillator, pendulum) = (
        "structure.oscillator = { mass = \"86 g\", stiffness = \"123.4 N/m\", damping = \"0.08 N s/m\" }\n\
         base.sine = { amplitude = \"0.5 mm\", frequency = \"6 Hz\" }",
        "structure.pendulum = { mass = 2, centre = 0.5, inertia = 1, arm = 0.5 }",
    );
    let still = format!("{}\n{face}", edited(oscillator, oscillator));
    read(&still, &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    let text = complaint(&format!("{}\n{face}", edited(oscillator, pendulum)), &[]);
    assert!(text.contains("has no `face` of its own"), "{text}");
}

/// What cannot be mixed, sorted or stayed in is refused, with the place and what to do.
#[test]
fn mixing_residence_and_sizes_are_refused_where_they_mean_nothing() {
    for (watch, said) in [
        ("discharge.sizes = [\"2 mm\", \"1 mm\"]", "`sizes` needs diameters that rise"),
        ("discharge.sizes = []", "`sizes` needs diameters that rise"),
        ("discharge.sizes = [\"2 kg\"]", "kg"),
        ("discharge.sizes = [0]", "0"),
        ("mixing = { cell = 1, groups = [\"balls\"] }", "mixing is of two groups or more"),
        ("mixing = { cell = 1, groups = [\"balls\", \"balls\"] }", "\"balls\" twice"),
        ("mixing = { cell = 1, groups = [\"balls\", \"sand\"] }", "sand"),
        ("mixing.cell = 0", "0"),
        ("mixing.cell = 1", "has nothing to mix"),
        ("mixing = {}", "cell"),
        ("residence.region = { low = [0, 0], high = [0, 0] }", "region"),
        ("residence = { region = { low = [0, 0], high = [1, 1] }, group = \"sand\" }", "sand"),
        ("residence.time = 1", "time"),
    ] {
        let text = about(&format!("[watch.a]\n{watch}"));
        assert!(text.contains(said) && text.contains("error"), "{watch}: {text}");
    }
}
