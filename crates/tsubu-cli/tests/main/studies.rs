use crate::support::{Desk, SCENE, designed};
use std::path::Path;

#[test]
fn a_response_leaves_curves_and_a_page() {
    let desk = Desk::new();
    let shown = desk.done("response balls.toml -q").stdout;
    assert!(shown.contains("case") && shown.contains("peak rms mm") && shown.contains("count = 10"), "{shown}");
    for name in ["scene.toml", "summary.json", "response.csv", "report.html"] {
        assert!(desk.path(&format!("out/balls-response/{name}")).exists(), "{name}");
    }
    let header = desk.read("out/balls-response/response.csv");
    assert!(header.starts_with("frequency [Hz],frequency ratio [-],rms displacement [m],peak displacement [m]"));
    assert_eq!(header.lines().count(), 1 + 3 * 4);
    assert!(desk.files().iter().any(|f| f.starts_with("out/balls-response/figures/")));
    let again = desk.done("response balls.toml -q").stdout;
    assert_eq!(shown.lines().next(), again.lines().next());
}

#[test]
fn the_number_of_threads_does_not_change_a_response() {
    let desk = Desk::new();
    for method in ["dem", "lattice"] {
        for threads in [1, 7] {
            let folder = format!("{method}{threads}");
            desk.done(&format!("response balls.toml -q --set method={method} -o {folder} --threads {threads}"));
        }
        assert_eq!(desk.read(&format!("{method}1/response.csv")), desk.read(&format!("{method}7/response.csv")));
    }
}

/// Watches look on while a response measures, and change nothing of it; a case without grains tells of none.
#[test]
fn a_response_tells_what_watches_see() {
    let desk = Desk::new();
    desk.done("response balls.toml -q -o plain");
    std::fs::write(desk.path("watched.toml"), format!("{SCENE}\n[watch.bed]\nevery = \"5 ms\"\ncoordination = {{}}\n[watch.late]\nfrom = \"100 s\"\ncoordination = {{}}\n"))
        .unwrap();
    desk.done("response watched.toml -q -o watched");
    let (plain, watched) = (desk.read("plain/response.csv"), desk.read("watched/response.csv"));
    let header = watched.lines().next().unwrap();
    let columns: Vec<&str> = header.split(',').collect();
    let at = columns.iter().position(|column| *column == "bed mean [-]").unwrap_or_else(|| panic!("{header}"));
    assert_eq!(columns[at + 1..at + 3], ["bed mean spread low [-]", "bed mean spread high [-]"]);
    let particles = columns.iter().position(|column| *column == "particles [-]").unwrap();
    let mut seen = 0;
    for (before, now) in plain.lines().zip(watched.lines()).skip(1) {
        assert!(now.starts_with(before), "{before}\n{now}");
        let cells: Vec<&str> = now.split(',').collect();
        let grains: f64 = cells[particles].parse().unwrap();
        let [mean, low, high] = [0, 1, 2].map(|k| cells[at + k].parse::<f64>().unwrap());
        assert_eq!(grains == 0.0, mean.is_nan(), "{now}");
        assert!(grains == 0.0 || (low <= mean && mean <= high && mean > 0.0 && mean < 12.0), "{now}");
        seen += usize::from(grains > 0.0);
    }
    assert!(seen > 3, "{watched}");
    assert!(desk.path("watched/figures/response_bed_mean.svg").exists());
    let warnings = desk.summary("watched")["warnings"].to_string();
    assert!(warnings.contains("`late` has seen nothing") && !warnings.contains("`bed`"), "{warnings}");
    assert!(desk.read("watched/report.html").contains("in the mean over the measured periods"));
}

#[test]
fn a_response_without_a_word_about_it() {
    let scene = crate::support::SCENE;
    let cut = &scene[..scene.find("[response]").unwrap()];
    let desk = Desk::with(cut);
    insta::assert_snapshot!(desk.shown("response balls.toml"));
    insta::assert_snapshot!(desk.shown("sweep balls.toml --jobs 2"));
    insta::assert_snapshot!(desk.shown("atlas balls.toml"));
}

/// An atlas by the automaton, and a prediction from it, with the same bits for any number of threads; what is no atlas, or has another
/// cavity, is refused and nothing is written.
#[test]
fn an_atlas_tells_the_response_of_a_structure() {
    let wanted = "[atlas]\nfrequency = [\"5 Hz\", \"7 Hz\"]\nacceleration = [\"2 m/s^2\", \"40 m/s^2\"]\n\
                  at-most = 30\nvary = { \"particles.balls.count\" = [10, 20] }\n";
    let steady = SCENE.replace("discard-periods = 1\ndiscard-periods-empty = 1\n", "");
    let desk = Desk::with(&format!(
        "{}\n{wanted}",
        steady.replace("5 mm", "0.5 mm").replace("[0.9, 0.95, 1.0, 1.05]", "{ from = 0.9, to = 1.05 }")
    ));
    for threads in [1, 7] {
        desk.done(&format!("atlas balls.toml -q --set method=lattice -o atlas{threads} --threads {threads}"));
    }
    assert_eq!(desk.read("atlas1/atlas.csv"), desk.read("atlas7/atlas.csv"));
    let page = desk.read("atlas1/report.html");
    assert!(page.contains("Atlas of cavities") && page.contains("effective mass / mass of the grains"));
    let shown = desk.done("predict balls.toml atlas1 -q --set method=lattice").stdout;
    for said in ["peak ratio", "count = 0", "count = 20", "predicted in"] {
        assert!(shown.contains(said), "{said}: {shown}");
    }
    let page = desk.read("out/balls-prediction/report.html");
    assert!(page.contains("Predicted response") && page.contains("simulated in full"));
    // Without grains the closed form is all there is.
    let summary = desk.summary("out/balls-prediction");
    let error = summary["results"]["error of the peak count = 0"].as_f64().unwrap();
    assert!(error.abs() < 0.1, "{error}");
    // What was simulated is not simulated again.
    let simulated = || desk.read("out/balls-prediction/progress.jsonl").lines().filter(|line| !line.is_empty()).count();
    let once = (simulated(), desk.read("out/balls-prediction/cases.csv"));
    assert_eq!(once.0, 1 + 3, "a line of its own for each case");
    desk.done("predict balls.toml atlas1 -q --set method=lattice --resume");
    assert_eq!((simulated(), desk.read("out/balls-prediction/cases.csv")), once);
    // An atlas that was cut was taken for one of empty boxes.
    let whole = desk.read("atlas7/atlas.csv");
    for (cut, said) in [(1, "no point of the case"), (9, "points of the case")] {
        std::fs::write(desk.path("atlas7/atlas.csv"), whole.split_inclusive('\n').take(cut).collect::<String>())
            .unwrap();
        let ended = desk.run("predict balls.toml atlas7 -q --set method=lattice -o new");
        assert!(ended.code == Some(2) && ended.stderr.contains(said), "{}", ended.stderr);
    }
    let before = desk.files().len();
    for command in ["predict balls.toml atlas1 -o new", "predict balls.toml balls -o new", "predict balls.toml -o new"]
    {
        insta::assert_snapshot!(desk.shown(command));
    }
    assert_eq!(desk.files().len(), before);
}

#[test]
fn two_methods_side_by_side() {
    let desk = Desk::new();
    let shown = desk.done("compare balls.toml --methods dem,lattice -q").stdout;
    assert!(shown.contains("computing time"), "{shown}");
    // Every number stood under `[SI]`, whatever it measured.
    let table = desk.read("out/balls-compare/compare.csv");
    assert!(table.starts_with("quantity [text],unit [text],dem,lattice\ncomputing time,s,"), "{table}");
    assert!(table.contains("\nhost spring rms displacement,m,") && table.contains("\nkinetic,J,"), "{table}");
    for name in ["compare.csv", "report.html", "dem/summary.json", "lattice/summary.json"] {
        assert!(desk.path(&format!("out/balls-compare/{name}")).exists(), "{name}");
    }
}

/// Methods that cannot run the scene say why; those that can stand side by side, a variant under its name.
#[test]
fn all_methods_and_a_variant_side_by_side() {
    let desk = Desk::new();
    let methods = "all,locked=dem:contact.rotation=false,dem:contact.rotation=false";
    let shown = desk.done(&format!("compare balls.toml --methods {methods} -q")).stdout;
    let header = shown.lines().next().unwrap();
    for name in ["dem ", "lattice ", "locked ", "dem-contact.rotation=false"] {
        assert!(header.contains(name), "{name}: {header}");
    }
    assert!(!header.contains("cl-ca"), "{header}");
    assert!(shown.contains("cl-ca cannot run it: walls.box.host: "), "{shown}");
    let hash = |name: &str| desk.hash(&format!("out/balls-compare/{name}"));
    assert_eq!(hash("locked"), hash("dem-contact.rotation=false"));
    assert_ne!(hash("locked"), hash("dem"));
    assert!(desk.path("out/balls-compare/figures/methods.svg").exists());
    let page = desk.read("out/balls-compare/report.html");
    assert!(page.contains("Who cannot run it") && page.contains("walls.box.host"), "refusals are not on the page");
    // Every folder of the comparison is known for what it is, and replaced.
    desk.done("compare balls.toml --methods dem -q --overwrite");
    assert!(!desk.path("out/balls-compare/locked").exists());
}

#[test]
fn a_verification_prints_a_line_a_claim() {
    let desk = Desk::empty();
    let shown = desk.done("verify restitution -q -o out").stdout;
    let claims = shown.lines().filter(|line| line.starts_with("pass  contact ")).count();
    assert!(claims > 10, "{shown}");
    assert!(shown.ends_with(&format!("{claims} claims, all pass\n")), "{shown}");
    let written: serde_json::Value = serde_json::from_str(&desk.read("out/verify.json")).unwrap();
    assert_eq!(written["claims"].as_array().unwrap().len(), claims);
    let run = &written["runs"][0];
    assert!(
        run["case"] == "restitution" && run["cores"].as_u64() > Some(0) && run["date"].as_str().unwrap().len() == 10
    );
    assert!(desk.path("out/report.html").exists());
    // What is done is asked for again only where that is said.
    let refused = desk.run("verify restitution -q -o out");
    assert!(refused.code == Some(2) && refused.stderr.contains("--resume"), "{}", refused.stderr);
    assert_eq!(desk.done("verify restitution -q -o out --resume").stdout, shown);
    let compared = desk.done("verify restitution -q --against stored").stdout;
    assert!(compared.ends_with(&format!("{claims} stored claims of 1 cases, none moved\n")), "{compared}");
    // Controls are no claims.
    let shown = desk.done("verify three-spheres -q").stdout;
    let controls = shown.lines().filter(|line| line.contains("wrong on purpose: ")).count();
    let claims = shown.lines().filter(|line| line.starts_with("pass  ")).count() - controls;
    let counted = format!("{claims} claims, all pass\n{controls} controls, each is refused\n");
    assert!(controls > 0 && shown.ends_with(&counted), "{shown}");
}

/// The scenes of the comparison of open-source codes run in the reduced size that their head names, close their books, and
/// do what they are about. What a scene names there is what is tested here.
fn reduced(desk: &Desk, scene: &str) -> serde_json::Value {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../studies/open-dem-benchmark");
    let text = std::fs::read_to_string(folder.join(scene)).unwrap();
    let line = text.lines().find_map(|line| line.strip_prefix("#reduced: tsubu run ")).unwrap();
    let options = line.split_once(".toml ").unwrap().1;
    desk.done(&format!("run '{}' -q -o out {options} --set output.xyz=true", folder.join(scene).display()));
    let summary = desk.summary("out");
    assert_eq!(summary["status"], "finished");
    let residual = summary["energy"]["residual_relative"].as_f64().unwrap();
    assert!(residual.abs() < 1e-3, "{scene}: the energy residual is {residual:e}");
    summary
}

#[test]
fn a_silo_empties() {
    let desk = Desk::empty();
    let summary = reduced(&desk, "silo.toml");
    let left = summary["particles"].as_u64().unwrap();
    let passed = summary["results"]["outflow passed grains final"].as_f64().unwrap();
    // Those that have passed the plane of counting and not yet reached that of removal, 5.4 mm below, are counted twice.
    let last = desk.read("out/frames/grains_000006.xyz");
    let heights = last.lines().skip(2).map(|row| row.split(' ').nth(3).unwrap().parse::<f64>().unwrap());
    let falling = heights.filter(|&z| z < -0.07).count();
    assert_eq!(passed + left as f64, 400.0 + falling as f64, "{left} are left and {passed} have passed");
    // Beverloo: 140 a second, 0.35 s open; half as many in the first moments to twice as many pass. A wall with a hole
    // loses all, a lid that stays none.
    assert!((300..=375).contains(&left), "{left} of 400 grains are left");
}

#[test]
fn a_drum_lifts_its_bed() {
    let desk = Desk::empty();
    assert_eq!(reduced(&desk, "drum.toml")["particles"], 380);
    let history = desk.read("out/history.csv");
    let header: Vec<&str> = history.lines().next().unwrap().split(',').collect();
    let column = |name: &str| header.iter().position(|cell| cell.starts_with(name)).unwrap();
    let (time, work) = (column("time"), column("wall work"));
    let rows = history.lines().skip(1).map(|row| row.split(',').map(|cell| cell.parse::<f64>().unwrap()).collect());
    let rows: Vec<Vec<f64>> = rows.collect();
    let still = rows.iter().rfind(|row| row[time] < 0.19).unwrap()[work];
    let last = rows.last().unwrap()[work];
    assert!(still.abs() < 1e-12, "a drum at rest did {still} J of work");
    assert!(last > 1e-3, "turning the bed took {last} J");
}

#[test]
fn a_ball_is_stopped_by_a_bed() {
    let desk = Desk::empty();
    assert_eq!(reduced(&desk, "impact.toml")["particles"], 392);
    let history = desk.read("out/history.csv");
    let kinetic = |row: &str| row.split(',').nth(1).unwrap().parse::<f64>().unwrap();
    let rows: Vec<f64> = history.lines().skip(1).map(kinetic).collect();
    let begun = std::f64::consts::PI / 6.0 * 7200.0 * 0.02f64.powi(3) * 25.0 / 2.0;
    let most = rows.iter().copied().fold(0.0, f64::max);
    assert!((0.95..1.1).contains(&(most / begun)), "the ball came with {most} J, not {begun} J");
    assert!(rows.last().unwrap() / begun < 0.1, "after the impact {} J are left", rows.last().unwrap());
}

/// A response that went on told how long its last part had taken, as if that were all.
#[test]
fn a_response_that_goes_on_tells_the_time_of_all_its_parts() {
    let desk = Desk::new();
    desk.done("response balls.toml -q -o out");
    let journal = desk.read("out/progress.jsonl");
    let lines: Vec<&str> = journal.lines().filter(|line| !line.is_empty()).collect();
    std::fs::write(desk.path("out/progress.jsonl"), lines[..lines.len() - 1].join("\n")).unwrap();
    let mut summary = desk.summary("out");
    summary["wall_seconds"] = 1000.0.into();
    std::fs::write(desk.path("out/summary.json"), summary.to_string()).unwrap();
    desk.done("response balls.toml -q -o out");
    let took = desk.summary("out")["wall_seconds"].as_f64().unwrap();
    assert!((1000.0..1100.0).contains(&took), "{took}");
}

/// A design by the automaton, with the same bits for any number of threads; the best runs as a scene of its own. What cannot be is refused
/// and nothing is written.
#[test]
fn a_design_finds_the_best() {
    let desk = Desk::with(&designed());
    let mut shown = Vec::new();
    for threads in [1, 7] {
        let command = format!("design balls.toml -q --set method=lattice -o design{threads} --threads {threads}");
        shown.push(desk.done(&command).stdout.replace(&format!("design{threads}"), "design"));
    }
    assert_eq!(shown[0], shown[1]);
    for said in ["best", "as written", "rms mm", "the scene of the best"] {
        assert!(shown[0].contains(said), "{said}: {}", shown[0]);
    }
    for file in ["design.csv", "steps.csv", "curves.csv", "best.toml"] {
        assert_eq!(desk.read(&format!("design1/{file}")), desk.read(&format!("design7/{file}")));
    }
    let page = desk.read("design1/report.html");
    assert!(page.contains("Before and after") && page.contains("front of mass and response"));
    desk.done("run design1/best.toml -q --set duration=0.1");
    // Where nothing keeps within a limit that is known only after runs, no run has failed.
    let tight = desk.run("design balls.toml -q -o tight --set method=lattice --set 'design.stroke-limit=1 um'");
    assert_eq!(tight.code, Some(3), "{}", tight.stderr);
    assert!(tight.stdout.contains("keeps within `design.stroke-limit`"), "{}", tight.stdout);
    assert!(tight.stderr.contains("no candidate keeps within the limits"), "{}", tight.stderr);
    assert!(!tight.stderr.contains("failed"), "{}", tight.stderr);
    let before = desk.files().len();
    for change in ["design.mass-limit=1e-6", "design.vary={}"] {
        insta::assert_snapshot!(desk.shown(&format!("design balls.toml -o new --set {change}")));
    }
    assert_eq!(desk.files().len(), before);
}

/// A calibration of the scene that ships, with the same bits for any number of threads and after it was typed again; its page has what
/// it is read for. What cannot be is refused, before anything is written where that is known.
#[test]
fn a_calibration_finds_what_fits() {
    let desk = Desk::with(include_str!("../../../../scenes/calibrate.toml"));
    let mut shown = Vec::new();
    for threads in [1, 7] {
        let command = format!("calibrate balls.toml -q --set calibrate.runs=16 -o fit{threads} --threads {threads}");
        shown.push(desk.done(&command).stdout.replace(&format!("fit{threads}"), "fit"));
    }
    assert_eq!(shown[0], shown[1]);
    insta::assert_snapshot!(shown[0]);
    for file in ["posterior.csv", "parameters.csv", "correlations.csv", "measured.csv", "runs.csv", "best.toml"] {
        assert_eq!(desk.read(&format!("fit1/{file}")), desk.read(&format!("fit7/{file}")));
    }
    let page = desk.read("fit1/report.html");
    for said in
        ["What was measured, and what fresh runs gave", "What is told apart", "Samples of materials.quartz.restitution"]
    {
        assert!(page.contains(said), "{said}");
    }
    desk.done("calibrate balls.toml -q --set calibrate.runs=16 -o fit1");
    assert_eq!(desk.read("fit1/posterior.csv"), desk.read("fit7/posterior.csv"));
    desk.done("run fit1/best.toml -q --set duration=0.01");
    let before = desk.files().len();
    for change in [
        "calibrate.vary={}",
        "calibrate.vary={\"materials.quartz.restitution\"=[0.3,0.5,0.9]}",
        "calibrate.vary={\"materials.quartz.restitution\"=[0.9,0.3]}",
        "calibrate.vary={\"materials.quartz.restitution\"=[0.3,1.3]}",
        "calibrate.measured=[]",
        "calibrate.measured=[{result=\"hops\",value=1,uncertainty=0}]",
    ] {
        let shown = desk.shown(&format!("calibrate balls.toml -o new --set {change}"));
        // Whether short runs left a checkpoint depends on how fast they were.
        let (said, _) = shown.split_once("\n--- files").expect("all is shown");
        insta::assert_snapshot!(said);
    }
    assert_eq!(desk.files().len(), before);
}
