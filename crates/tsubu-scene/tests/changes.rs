use crate::{GOOD, edited, read};
use tsubu_scene::Scene;
use tsubu_scene::plan::{Damping, Start, Structure};

fn changed(changes: &[&str]) -> Scene {
    read(GOOD, changes).unwrap_or_else(|complaints| panic!("{complaints}"))
}

#[test]
fn values_are_toml_or_bare_text() {
    for change in ["5mm", "5 mm", "\"5 mm\"", "'5 mm'", "0.005", " 5 mm "] {
        let scene = changed(&[&format!("particles.balls.diameter={change}")]);
        assert_eq!(scene.plan().particles["balls"].diameter, 0.005, "{change}");
    }
    assert_eq!(changed(&["particles.balls.count=30"]).plan().particles["balls"].count, 30);
    assert_eq!(changed(&["title=a=b"]).plan().title, "a=b");
    assert_eq!(changed(&["dem.time-step=automatic"]).plan().dem.time_step, None);
}

#[test]
fn a_later_change_wins() {
    assert_eq!(changed(&["seed=2", "seed=3"]).plan().seed, 3);
}

#[test]
fn a_choice_takes_the_place_of_the_one_before() {
    let text = format!("{GOOD}\n[contact]\ndamping.linear = {{ reference-speed = 2 }}\n");
    let damping =
        |change: &str| read(&text, &[change]).unwrap_or_else(|c| panic!("{c}")).plan().contact.damping.clone();
    assert_eq!(damping("contact.damping.quarter={}"), Damping::Quarter {});
    assert_eq!(damping("contact.damping.sqrt.reference-speed=3"), Damping::Sqrt { reference_speed: 3.0 });
    assert_eq!(damping("contact.damping.linear.reference-speed=3"), Damping::Linear { reference_speed: 3.0 });
    assert_eq!(damping("contact.damping={none={}}"), Damping::None {});
    let start = changed(&["particles.balls.start.rows.jitter=0"]).plan().particles["balls"].start.clone();
    assert_eq!(start, Start::Rows { spacing: 1.05, jitter: 0.0, speed: 0.0, region: None });
}

#[test]
fn a_rival_key_takes_the_place_of_the_one_before() {
    let scene = changed(&["hosts.spring.structure.oscillator.damping-ratio=0"]);
    assert!(matches!(scene.plan().hosts["spring"].structure, Structure::Oscillator { damping: 0.0, .. }));
}

#[test]
fn list_entries_are_counted_from_zero() {
    let text = format!("{GOOD}\n[[claim]]\nresult = \"peak\"\nlow = 1\nsource = \"theory\"\n");
    let scene = read(&text, &["claim.0.low=2"]).unwrap_or_else(|c| panic!("{c}"));
    assert_eq!(scene.plan().claim[0].low, Some(2.0));
    assert!(read(&text, &["claim.1.low=2"]).is_err());
}

#[test]
fn names_may_hold_points() {
    let text = edited("[particles.balls]", "[particles.\"small.balls\"]");
    let scene = read(&text, &["particles.\"small.balls\".count=3"]).unwrap_or_else(|c| panic!("{c}"));
    assert_eq!(scene.plan().particles["small.balls"].count, 3);
}

#[test]
fn cases_of_a_study_are_changes_too() {
    let scene = changed(&["seed=7"]);
    let case = scene
        .with(&[("particles.balls.count", &toml::Value::Integer(0)), ("duration", &toml::Value::String("3 s".into()))])
        .unwrap_or_else(|c| panic!("{c}"));
    assert_eq!((case.plan().particles["balls"].count, case.plan().duration, case.plan().seed), (0, 3.0, 7));
    assert_eq!(case.plan().output.history_interval, 3e-3, "what follows from the duration follows the new one");
    assert!(scene.with(&[("particles.balls.count", &toml::Value::Integer(-1))]).is_err());
    assert!(scene.with(&[("nonsense", &toml::Value::Integer(1))]).is_err());
}

#[test]
fn the_text_stays_as_it_was_typed() {
    assert_eq!(changed(&["seed=2"]).text(), GOOD);
}
