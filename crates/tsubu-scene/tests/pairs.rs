//! Contact laws of pairs of materials.

use crate::{complaint, read};
use std::path::Path;
use tsubu_scene::Scene;
use tsubu_scene::plan::*;

/// Two materials and what one wants to say about them.
fn scene(more: &str) -> String {
    format!(
        r#"duration = 1
[materials.glass]
young-modulus = "60 GPa"
density = 2500
[materials.wax]
young-modulus = "1 GPa"
[particles.beads]
material = "glass"
diameter = "2 mm"
start.at = {{ position = [[0, "50 mm"]] }}
[walls.floor]
material = "wax"
shape.plane = {{}}
{more}
"#
    )
}

/// What the pair says in its own table.
fn pair(contact: &str, own: &str) -> String {
    scene(&format!("[contact]\n{contact}\n[[material-pair]]\nbetween = [\"wax\", \"glass\"]\n{own}"))
}

fn plan(text: &str, changes: &[&str]) -> Plan {
    read(text, changes).unwrap_or_else(|complaints| panic!("{complaints}\n{text}")).plan().clone()
}

#[test]
fn what_a_pair_does_not_name_is_as_in_the_scene() {
    let text = pair(
        "damping.sqrt = {}\nrotation = false\nattraction = true",
        "contact.cohesion.jkr = {}\ncontact.rolling.epsd = {}\ncontact.attraction = false",
    );
    let plan = plan(&text, &[]);
    let law = Contact {
        cohesion: Cohesion::Jkr {},
        rolling: Rolling::Epsd { ratio: 3.0, damping_ratio: 0.3 },
        attraction: false,
        ..plan.contact.clone()
    };
    assert_eq!(plan.contact_of("glass", "wax"), &law);
    assert_eq!(plan.contact_of("wax", "glass"), &law, "whichever is named first");
    assert_eq!(plan.contact_of("glass", "glass"), &plan.contact);
    assert!(plan.contact.attraction && !law.rotation && law.damping == Damping::Sqrt { reference_speed: 1.0 });
}

#[test]
fn a_pair_of_the_run_folder_means_the_same() {
    let text = pair("normal.hooke.stiffness = 1e4\ntangential.spring = {}", "contact.normal.hooke.stiffness = 3e4");
    let scene = read(&text, &[]).expect("right");
    let written = scene.resolved_toml();
    let again = Scene::parse("scene.toml", &written, Path::new("/nowhere"), &[]);
    let again = again.unwrap_or_else(|complaints| panic!("{complaints}\n{written}"));
    assert_eq!((again.plan(), again.resolved_toml()), (scene.plan(), written.clone()));
    let tail = written.split("[[material-pair]]").nth(1).and_then(|text| text.split("\n[particles").next());
    insta::assert_snapshot!(tail.expect("a pair"));
}

#[test]
fn a_pairs_law_can_be_changed_and_varied() {
    let text = pair("", "friction = 0.1");
    let damping = |changes: &[&str]| plan(&text, changes).contact_of("glass", "wax").damping.clone();
    assert_eq!(damping(&[]), Damping::Quarter {});
    assert_eq!(damping(&["material-pair.0.contact.damping.none={}"]), Damping::None {});
    assert_eq!(damping(&["contact.damping.none={}"]), Damping::None {}, "the pair has no law of its own");
    let varied = text + "[sweep.vary]\n\"material-pair.0.contact.damping\" = [{ none = {} }, { quarter = {} }]\n";
    assert!(read(&varied, &[]).is_ok());
}

#[test]
fn laws_of_pairs_that_cannot_be() {
    let hooke = "normal.hooke.stiffness = 1e5\ntangential.spring = {}";
    let texts = [
        pair("", "contact = {}"),
        pair("", "contact.cohesion = { jrk = {} }"),
        pair("", "contact.rotation = false"),
        pair("", "contact.normal.hooke = {}"),
        pair("", "contact.normal.hooke.stiffness = 1e5"),
        pair("tangential.mindlin = {}", "contact.normal.hooke.stiffness = 1e5"),
        pair(hooke, "contact.cohesion.jkr = {}"),
        pair("", "contact.normal.hooke.stiffness = 1e5\ncontact.tangential.none = {}\ncontact.cohesion.dmt = {}"),
        // One mistake, one complaint: the pair only inherits it.
        pair("normal.hooke.stiffness = 1e5", "contact.damping.none = {}"),
    ];
    insta::assert_snapshot!(texts.map(|text| complaint(&text, &[])).join("\n\n"));
}

#[test]
fn the_cohesion_of_a_pair_has_the_unit_of_its_part() {
    let with = |glass: &str, wax: &str, own: &str| {
        pair("cohesion.constant = {}", &format!("contact.cohesion.sjkr = {{}}\n{own}"))
            .replace("density = 2500", &format!("density = 2500\ncohesion = {glass}"))
            .replace("\"1 GPa\"", &format!("\"1 GPa\"\ncohesion = {wax}"))
    };
    let good = plan(&with("\"3 mN\"", "\"1 mN\"", "cohesion = \"2 kPa\""), &[]);
    let read = [good.materials["glass"].cohesion, good.pair("glass", "wax").and_then(|p| p.cohesion).unwrap_or(0.0)];
    assert_eq!(read, [3e-3, 2e3]);
    plan(&with("0.003", "0.001", ""), &[]);
    let wrong = [
        with("\"3 mN\"", "\"1 mN\"", ""),
        with("\"3 mN\"", "\"1 mN\"", "cohesion = \"2 mN\""),
        with("\"3 kPa\"", "\"1 mN\"", "cohesion = \"2 kPa\""),
    ];
    insta::assert_snapshot!(wrong.map(|text| complaint(&text, &[])).join("\n\n"));
}
