//! Reports: complete, self-contained, and made of whatever is there.

use std::fs;
use std::path::Path;

use tsubu_frame::{Claim, Formats, Frame, FrameWriter, Kind, Source};
use tsubu_report::page::{Block, Report, Tone};
use tsubu_report::{ReportError, build, report};

use crate::fixture;

fn titles(report: &Report) -> Vec<&str> {
    report.sections.iter().map(|s| s.title.as_str()).collect()
}

fn written(dir: &Path) -> String {
    let page = report(dir).unwrap().page;
    assert_eq!(page, dir.join("report.html"));
    fs::read_to_string(page).unwrap()
}

/// Nothing on the page may ask for anything from outside, and nothing may run but in a frame that reaches nothing.
fn self_contained(html: &str) {
    for frame in html.split("<iframe ").skip(1) {
        let attributes = frame.split('>').next().unwrap();
        assert!(attributes.contains("sandbox=\"allow-scripts allow-downloads\""), "a frame that may reach out");
        assert!(attributes.contains("default-src &#39;none&#39;"), "a frame that may load something");
    }
    let plain = html.replace("http://www.w3.org/2000/svg", "").replace("http://www.w3.org/1999/xlink", "");
    for forbidden in ["http:", "https:", "<script", "<link", "@import", "src=\"/", "onload", "javascript:"] {
        assert!(!plain.contains(forbidden), "the page has {forbidden}");
    }
    assert!(html.ends_with("</html>\n"));
    for tag in ["section", "table", "figure", "details", "svg", "div", "tr"] {
        let open = html.matches(&format!("<{tag}>")).count() + html.matches(&format!("<{tag} ")).count();
        assert_eq!(open, html.matches(&format!("</{tag}>")).count(), "{tag}");
    }
    let ids: Vec<_> = html.split(" id=\"").skip(1).map(|s| s.split('"').next().unwrap()).collect();
    let mut unique = ids.clone();
    unique.sort_unstable();
    unique.dedup();
    assert_eq!(unique.len(), ids.len(), "ids are unique: {ids:?}");
}

/// Once the picture of a hopper by its grains' sizes was three screens tall, and the animation stood below it.
#[test]
fn a_tall_vessel_fits_on_a_screen() {
    let dir = tempfile::tempdir().unwrap();
    fixture::run(dir.path(), "dem", 0);
    let mut frames = FrameWriter::create(dir.path(), Formats::default());
    for step in 0..3_u32 {
        let at = |i: u32| [i % 2, i / 2 % 2, i / 4].map(|n| 0.01 * f64::from(n));
        let mut frame = Frame { time: f64::from(step), step: u64::from(step), ..Frame::default() };
        frame.vector(Kind::Grain, "position", "m", (0..32).map(at).collect::<Vec<_>>());
        frame.vector(Kind::Grain, "velocity", "m/s", vec![[0.0; 3]; 32]);
        frame.scalar(Kind::Grain, "radius", "m", (0..32).map(|i| 0.004 + 0.001 * f64::from(i % 2)).collect::<Vec<_>>());
        frame.integer(Kind::Grain, "id", "-", (0..32).collect::<Vec<_>>());
        frames.write(&frame).unwrap();
    }
    let report = build(dir.path()).unwrap();
    let grains = report.sections.iter().find(|section| section.title == "Grains").unwrap();
    let [Block::View { html, .. }, Block::Drawing { .. }, Block::Picture { bytes, .. }] = grains.blocks.as_slice()
    else {
        panic!("what can be turned, a strip, and a picture by size")
    };
    assert!(html.len() <= 3_000_000, "{} bytes", html.len());
    // Width and height stand at the head of a PNG.
    let [wide, high] = [16, 20].map(|at| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()));
    assert!(wide == 290 && high < 1000, "{wide} x {high}");
}

#[test]
fn the_same_folder_gives_the_same_page() {
    let dir = tempfile::tempdir().unwrap();
    fixture::response(dir.path());
    assert_eq!(written(dir.path()), written(dir.path()));
}

#[test]
fn a_response_names_its_lowest_peak() {
    let dir = tempfile::tempdir().unwrap();
    fixture::response(dir.path());
    self_contained(&written(dir.path()));
    let report = build(dir.path()).unwrap();
    assert!(
        report.headline.starts_with("The lowest peak is that of N = 40: 3.717 mm rms at 0.96"),
        "{}",
        report.headline
    );
    let cards: Vec<_> = report.cards.iter().map(|c| (c.label.as_str(), c.value.as_str())).collect();
    assert_eq!(
        cards[..5],
        [
            ("Peak rms without grains", "16.67"),
            ("Lowest peak rms", "3.717"),
            ("Reduction factor", "4.48"),
            ("Frequency shift", "−4.0"),
            ("Best loss factor", "0.112"),
        ]
    );
    assert!(titles(&report).contains(&"Energy by cause"));
}

/// Where curves up and down part is marked in the figure; it stood in the table alone.
#[test]
fn hysteresis_is_marked() {
    let dir = tempfile::tempdir().unwrap();
    fixture::response(dir.path());
    assert!(!written(dir.path()).contains(">hysteresis<"));
    let path = dir.path().join("cases.csv");
    let text = std::fs::read_to_string(&path).unwrap();
    let more =
        [",hysteresis from [-],hysteresis to [-]", ",0.94,0.98"].into_iter().chain(std::iter::repeat(",NaN,NaN"));
    let lines: Vec<String> = text.lines().zip(more).map(|(line, more)| format!("{line}{more}")).collect();
    std::fs::write(&path, lines.join("\n")).unwrap();
    let html = written(dir.path());
    assert_eq!(html.matches(">hysteresis<").count(), 1);
    assert!(html.contains("Hysteresis: between the grey marks"));
}

#[test]
fn a_response_shows_the_period_it_filmed() {
    let dir = tempfile::tempdir().unwrap();
    fixture::response(dir.path());
    let mut frames = FrameWriter::create(dir.path(), Formats::default());
    for i in 0..9 {
        frames.write(&fixture::frame(10.0 + f64::from(i) / (8.0 * 2.1), 30)).unwrap();
    }
    let html = written(dir.path());
    self_contained(&html);
    assert!(html.contains("N = 40 at its peak, at 2.1 Hz: one period of 0.4762 s, in eighths"));
    for label in [">0°<", ">45°<", ">315°<"] {
        assert!(html.contains(label), "{label}");
    }
    assert!(!html.contains(">360°<") && !html.contains("t = "), "each phase once");
    assert!(dir.path().join("figures/strip.svg").exists());
}

#[test]
fn a_number_that_says_nothing_has_no_card() {
    let dir = tempfile::tempdir().unwrap();
    fixture::response(dir.path());
    let mut summary = fixture::summary("dem");
    summary.particle_steps_per_second = 0.0;
    summary.write(&dir.path().join("summary.json")).unwrap();
    assert!(!written(dir.path()).contains("grain-steps"));
}

#[test]
fn what_a_scene_claims_comes_first() {
    let dir = tempfile::tempdir().unwrap();
    fixture::run(dir.path(), "dem", 3);
    let labels = || build(dir.path()).unwrap().cards.iter().map(|card| card.label.clone()).collect::<Vec<_>>();
    let at = |labels: &[String], label: &str| labels.iter().position(|l| l == label).expect("card");
    let found = labels();
    assert!(at(&found, "rms displacement") < at(&found, "loss factor"), "{found:?}");
    let mut summary = fixture::summary("dem");
    summary.claims.push(Claim::judge("loss factor [-]", 0.0412, Some(0.0), None, Source::scene("closed form")));
    summary.write(&dir.path().join("summary.json")).unwrap();
    let found = labels();
    assert!(at(&found, "loss factor") < at(&found, "rms displacement"), "{found:?}");
}

#[test]
fn a_comparison_says_what_each_method_cost() {
    let dir = tempfile::tempdir().unwrap();
    fixture::compare(dir.path());
    self_contained(&written(dir.path()));
    let report = build(dir.path()).unwrap();
    assert!(report.headline.contains("91.9 times as long"), "{}", report.headline);
    let differs = report.sections.iter().find(|s| s.title == "What differs").expect("section");
    let table = differs.blocks.iter().find_map(|b| if let Block::Table(table) = b { Some(table) } else { None });
    let rows: Vec<_> = table.expect("table").rows.iter().map(|(_, row)| row[0].as_str()).collect();
    assert_eq!(rows, ["rms displacement", "lift-off phase"], "what no method has to say anything about is left out");
}

#[test]
fn a_sweep_is_drawn_over_what_varied() {
    let dir = tempfile::tempdir().unwrap();
    fixture::sweep(dir.path());
    self_contained(&written(dir.path()));
    let report = build(dir.path()).unwrap();
    assert!(report.headline.starts_with("6 cases"), "{}", report.headline);
    assert_eq!(titles(&report), ["Results over what varied", "Cases", "Scene"]);
    assert!(dir.path().join("figures/sweep_rms_displacement.svg").exists());
}

/// Seeds made a curve each, angles stood in radians under the unit `[SI]`, only the first eight results were drawn, and the
/// computing times of cases that ran side by side were added up as if that were how long it took.
#[test]
fn a_sweep_over_seeds_has_bands_degrees_and_all_results() {
    let dir = tempfile::tempdir().unwrap();
    fixture::calibration(dir.path());
    let html = written(dir.path());
    self_contained(&html);
    let angle = fs::read_to_string(dir.path().join("figures/sweep_heap_angle.svg")).expect("the tenth result");
    assert!(angle.contains("heap angle [°]"), "angles are read in degrees");
    assert!(!angle.contains("seed"), "seeds are no curves");
    assert!(html.contains("Lines: mean over the seeds; bands: the least and the largest."));
    assert!(html.contains("<summary>More results over what varied</summary>"));
    assert!(!html.contains(">SI<") && !html.contains("[SI]"));
    let report = build(dir.path()).unwrap();
    assert_eq!(report.headline, "9 cases in 10 s by the clock, 2 side by side; their own times add up to 18 s.");
    assert_eq!(report.verdict, Some((Tone::Bad, "1 case failed".into())));
    let cases = report.sections.iter().find(|s| s.title == "Cases").expect("section");
    let Block::Table(table) = &cases.blocks[0] else { panic!("{:?}", cases.blocks[0]) };
    let (tone, row) = table.rows.last().expect("row");
    assert_eq!(*tone, Tone::Bad);
    assert!(row.contains(&"grain 7 overlaps its neighbour".to_owned()), "{row:?}");
}

#[test]
fn a_sweep_of_seeds_alone_has_a_table_of_spreads() {
    let dir = tempfile::tempdir().unwrap();
    let head = "case [text],seed [text],status [text],heap angle [rad],remark [text]\n";
    let rows = "a,1,finished,0.4,\nb,2,finished,0.5,\nc,3,finished,0.6,\n";
    fixture::text(dir.path(), "sweep.csv", &format!("{head}{rows}"));
    let report = build(dir.path()).unwrap();
    let spread = report.sections.iter().find(|s| s.title == "Over the seeds").expect("section");
    let Block::Table(table) = &spread.blocks[0] else { panic!("{:?}", spread.blocks[0]) };
    assert_eq!(table.rows[0].1, ["heap angle", "28.65", "22.92", "34.38", "°"]);
}

/// The mean of a watch and its value at the end share a card; an angle is read in degrees; a profile is for a figure.
#[test]
fn results_are_told_as_people_read_them() {
    let dir = tempfile::tempdir().unwrap();
    let mut summary = fixture::summary("dem");
    summary.results = tsubu_frame::Named::default();
    summary.give("heap angle", "rad", 0.4);
    summary.give("heap angle final", "rad", 0.5);
    summary.give("bed density profile", "kg/m^3", vec![1.0; 90]);
    summary.claims = vec![Claim::judge("heap angle final", 0.5, Some(0.4), Some(0.6), Source::scene("measured"))];
    summary.write(&dir.path().join("summary.json")).unwrap();
    let report = build(dir.path()).unwrap();
    let cards: Vec<_> =
        report.cards.iter().skip(4).map(|c| (c.label.as_str(), c.value.as_str(), &*c.unit, &*c.note)).collect();
    assert_eq!(
        cards,
        [
            ("heap angle final", "28.65", "°", "claimed: 22.92 … 34.38 °"),
            ("heap angle", "22.92", "°", "mean; 28.65 ° at the end")
        ]
    );
    let html = written(dir.path());
    assert!(html.contains("90 values, see figure") && html.contains("22.92 … 34.38 °"));
}

/// Marks of code stood on pages as they are typed in messages; charts of zeros alone filled them; labels longer than their
/// axis were cut off.
#[test]
fn pages_have_no_marks_no_empty_charts_and_no_cut_labels() {
    let dir = tempfile::tempdir().unwrap();
    let mut summary = fixture::summary("dem");
    summary.warnings = vec!["shorten `dem.time-step`, then `a < b`".into()];
    summary.write(&dir.path().join("summary.json")).unwrap();
    let long = "force of the grains on the eastern wall along x";
    let head = format!("time [s],nothing [N],{long} [N]");
    fixture::text(dir.path(), "history.csv", &format!("{head}\n0,0,1\n1,0,2\n2,0,1\n"));
    let html = written(dir.path());
    self_contained(&html);
    assert!(html.contains("shorten <code>dem.time-step</code>, then <code>a &lt; b</code>"));
    assert!(!html.contains("[N]</text>") || !html.contains(">nothing [N]<"), "a chart of zeros");
    assert!(!dir.path().join("figures/history_nothing.svg").exists());
    let name = format!("history_{}.svg", long.replace(' ', "_"));
    let chart = fs::read_to_string(dir.path().join("figures").join(name)).unwrap();
    let label = chart.split("<text ").find(|text| text.contains(long)).expect("label");
    assert!(!label.contains("rotate"), "the label is longer than the axis: {label}");
}

#[test]
fn a_failed_claim_cannot_be_overlooked() {
    let dir = tempfile::tempdir().unwrap();
    fixture::verify(dir.path(), true);
    assert_eq!(build(dir.path()).unwrap().verdict, Some((Tone::Good, "all pass".into())));
    fixture::verify(dir.path(), false);
    let report = build(dir.path()).unwrap();
    assert_eq!(report.verdict, Some((Tone::Bad, "1 FAIL".into())));
    assert_eq!(report.sections[0].title, "What does not hold");
    let html = written(dir.path());
    self_contained(&html);
    assert!(html.contains("FAIL") && html.contains("V-60 peak"));
    assert!(html.contains("number the sections of the project"), "codes in the sources are explained");
}

#[test]
fn a_folder_without_results_is_refused() {
    let dir = tempfile::tempdir().unwrap();
    let error = build(dir.path()).unwrap_err();
    assert!(matches!(error, ReportError::NoResults { .. }));
    assert!(error.to_string().contains("summary.json"), "{error}");
    let error = build(&dir.path().join("none")).unwrap_err().to_string();
    assert!(error.contains("is not a folder"), "{error}");
    assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 0, "nothing is written");
}

#[test]
fn without_a_host_the_box_gives_the_period() {
    let dir = tempfile::tempdir().unwrap();
    fixture::run(dir.path(), "dem", 60);
    fs::remove_file(dir.path().join("history.csv")).unwrap();
    let html = written(dir.path());
    assert!(html.contains("0° is where the box passes its middle going up"));
    assert!(html.contains("One period of 0.476"));
}

#[test]
fn each_missing_file_costs_only_its_part() {
    for missing in ["summary.json", "history.csv", "frames", "scene.toml", "check.txt"] {
        let dir = tempfile::tempdir().unwrap();
        fixture::run(dir.path(), "dem", 4);
        let path = dir.path().join(missing);
        if path.is_dir() {
            fs::remove_dir_all(path).unwrap();
        } else {
            fs::remove_file(path).unwrap();
        }
        self_contained(&written(dir.path()));
    }
}

#[test]
fn damaged_files_become_notes() {
    let dir = tempfile::tempdir().unwrap();
    fixture::run(dir.path(), "dem", 4);
    fixture::text(dir.path(), "summary.json", "{\"tsubu_version\": ");
    fixture::text(dir.path(), "history.csv", "time [s],x [m]\n1\n");
    let cut = dir.path().join("frames/grains_000002.vtp");
    let bytes = fs::read(&cut).unwrap();
    fs::write(&cut, &bytes[..200]).unwrap();
    let report = build(dir.path()).unwrap();
    let notes: Vec<_> = report.sections[0]
        .blocks
        .iter()
        .filter_map(|b| match b {
            Block::Note(_, text) => Some(text.as_str()),
            _ => None,
        })
        .collect();
    for file in ["summary.json", "history.csv", "grains_000002.vtp"] {
        assert!(notes.iter().any(|n| n.contains(file)), "{file} in {notes:?}");
    }
    let html = written(dir.path());
    self_contained(&html);
    assert!(!html.contains(&dir.path().display().to_string()), "a mailed page tells nobody's folders");
}

#[test]
fn verify_without_readable_claims_says_so() {
    let dir = tempfile::tempdir().unwrap();
    fixture::text(dir.path(), "verify.json", "[{\"name\": 3}]");
    let report = build(dir.path()).unwrap();
    assert_eq!(report.verdict, Some((Tone::Warning, "nothing checked".into())));
    assert_eq!(report.sections[0].title, "To be noted");
}

#[test]
fn nothing_typed_reaches_the_page_as_markup() {
    let nasty = "<img src=x onerror=alert(1)>&\"'\u{1}";
    let mut page = Report { title: nasty.into(), headline: nasty.into(), ..Report::default() };
    page.section(nasty, vec![Block::Text(nasty.into()), Block::Typed(nasty.into())]);
    let html = page.to_html();
    assert!(!html.contains("<img") && !html.contains('\u{1}'));
}

mod patient {
    use super::*;

    #[test]
    #[ignore = "7 s: cargo xtask patient"]
    fn a_run_is_told_whole() {
        let dir = tempfile::tempdir().unwrap();
        fixture::run(dir.path(), "dem", 60);
        let html = written(dir.path());
        self_contained(&html);
        for said in [
            "<h1>Swinging box</h1>",
            "0° is where the host passes its middle going up",
            "30 grains by DEM",
            "The host structure displacement reaches 4.069 mm",
            "2.7·10⁻⁷",
            "the overlap reached 1.3 %",
            "60 steps per contact",
            "&lt;script&gt;alert(1)&lt;/script&gt;",
            "9f2c1ab0d4e85f1170ac66d2381b7c55",
            "The grains, to be turned, played and looked into.",
        ] {
            assert!(html.contains(said), "the page does not say {said}");
        }
        for file in ["host_displacement.svg", "strip.svg", "energy_by_cause.svg", "animation.gif", "last.png"] {
            assert!(dir.path().join("figures").join(file).exists(), "{file}");
        }
        let report = build(dir.path()).unwrap();
        // Charts once came first, and the grains below the second screen, where nobody looked for them.
        assert_eq!(
            titles(&report),
            ["To be noted", "Grains", "Motion", "Energy", "Claims", "Results", "Cost", "Scene"]
        );
    }
}
