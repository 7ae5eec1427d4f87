//! What a scene may say of stages, and what it is told.

use crate::{GOOD, edited, read};

/// A scene whose length the stages say.
fn staged(stages: &str) -> Result<tsubu_scene::Scene, String> {
    let text = edited("duration = \"1 s\"", "");
    read(&format!("{text}\n{stages}"), &[]).map_err(|complaints| complaints.to_string())
}

const TWO: &str = "[[stage]]\nname = \"rest\"\nduration = 1\n[[stage]]\nname = \"move\"\nduration = \"20 ms\"\n";

#[test]
fn every_stage_has_a_plan_of_its_own() {
    let scene = staged(&format!("{TWO}set.gravity = 5\nset.\"dem.largest-overlap\" = 0.2\n")).expect("two stages");
    let [rest, moves] = scene.plans() else { panic!("{} plans", scene.plans().len()) };
    assert_eq!((rest.duration, moves.duration), (1.0, 0.02));
    assert_eq!((rest.gravity[2], moves.gravity[2]), (-10.0, -5.0));
    assert_eq!((rest.dem.largest_overlap, moves.dem.largest_overlap), (0.1, 0.2));
    let again = read(&scene.resolved_toml(), &[]).expect("the same");
    assert_eq!(again.plans(), scene.plans());
    assert_eq!(again.resolved_toml(), scene.resolved_toml());
}

#[test]
fn what_is_wrong_is_said_with_its_place() {
    let refused = |stages: &str, said: &str| {
        let told = staged(stages).expect_err(said);
        assert!(told.contains(said), "{told}");
    };
    refused(&format!("{TWO}set.dimension = 3\n"), "`dimension` stays as it is from stage to stage");
    refused(&format!("{TWO}set.particles.balls.count = 3\n"), "grains are made once");
    refused(&format!("{TWO}set.gravty = 3\n"), "did you mean `gravity`?");
    refused(&format!("{TWO}set.gravity = \"3 m\"\n"), "not an acceleration");
    refused("[[stage]]\nname = \"a\"\n", "a stage needs `duration`, or `until` and `at-most`");
    refused("[[stage]]\nname = \"a\"\nuntil.inserted = 3\n", "needs `at-most`");
    refused("[[stage]]\nname = \"a\"\nduration = 1\nat-most = 2\n", "`duration` excludes `until` and `at-most`");
    let ends = |until: &str| format!("[[stage]]\nname = \"a\"\nuntil = {until}\nat-most = 1\n");
    refused(&ends("{}"), "`until` is empty");
    refused(&ends("{ result = \"kinetic energy\" }"), "where it is `above` or `below` something");
    refused(&ends("{ above = 1 }"), "`above` needs a `result`");
    refused(&TWO.replace("move", "rest"), "two stages are called `rest`");
    refused(&TWO.replace("move", "to and fro"), "is no name of a stage");
    refused(&format!("{TWO}set = 3\n"), "needs a table of scene keys");
    let told = read(&format!("{GOOD}\n{TWO}"), &[]).expect_err("refused").to_string();
    assert!(told.contains("`duration` and `stage` exclude each other"), "{told}");
    let told = read(&format!("start-from = \"nowhere\"\n{GOOD}"), &[]).expect_err("refused").to_string();
    assert!(told.contains("there is no run to start from in `nowhere`"), "{told}");
    let told = read(&format!("start-at-zero = true\n{GOOD}"), &[]).expect_err("refused").to_string();
    assert!(told.contains("`start-at-zero` is of use with `start-from` only"), "{told}");
    let told = read(&format!("start-fingerprint = \"0\"\n{GOOD}"), &[]).expect_err("refused").to_string();
    assert!(told.contains("`start-fingerprint` is of use with `start-from` only"), "{told}");
    let steady = "[[stage]]\nname = \"a\"\nuntil.host-steady = 0.01\nat-most = 1\n";
    let still =
        edited("duration = \"1 s\"", "").replace("base.sine = { amplitude = \"0.5 mm\", frequency = \"6 Hz\" }", "");
    let told = read(&format!("{still}{steady}"), &[]).expect_err("refused").to_string();
    assert!(told.contains("no host is driven by a sine"), "{told}");
    refused(&steady.replace("0.01", "0"), "above 0");
    let interval = |milliseconds: u32| format!("{steady}set.output.history-interval = \"{milliseconds} ms\"\n");
    refused(&interval(30), "rows of the history come too rarely to tell whether a host is steady");
    assert_eq!(staged(&interval(20)).map(|scene| scene.plans().len()), Ok(1));
}
