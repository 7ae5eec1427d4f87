//! Watches on the page of a run: numbers over time, profiles, paths, maps.

use std::fs;
use std::path::Path;

use tsubu_frame::{Cell, Table};
use tsubu_report::page::{Block, Report};
use tsubu_report::raster::from_svg;
use tsubu_report::{build, report};

use crate::fixture;

const INDEX: &str = r#"[
  {"name": "layers", "kind": "profile", "about": "", "scalars": [], "file": "watch/layers.csv",
   "coordinates": ["z [m]"], "values": ["solid fraction [-]", "nothing [-]"]},
  {"name": "field", "kind": "coarse-grain", "about": "", "scalars": [], "file": "watch/field.csv",
   "coordinates": ["x [m]", "z [m]"], "values": ["density [kg/m^2]"]},
  {"name": "some", "kind": "track", "about": "", "scalars": [], "file": "watch/some.csv",
   "coordinates": ["id [-]"], "values": ["position z [m]"]},
  {"name": "sand", "kind": "hops", "about": "", "scalars": [], "file": "watch/sand.csv",
   "coordinates": ["id [-]"], "values": ["start [s]", "height [m]", "restitution [-]"]},
  {"name": "out", "kind": "discharge", "about": "",
   "scalars": ["out passed mass [kg]", "out force x [N]", "out force z [N]", "out rate [1/s]"], "file": null,
   "coordinates": [], "values": []}
]"#;

/// A run with watches: a bed that empties.
fn watched(dir: &Path) {
    fixture::run(dir, "dem", 0);
    fixture::text(dir, "watch/index.json", INDEX);
    let mut history = Table::read(&dir.join("history.csv")).unwrap();
    for (k, name) in ["out passed mass [kg]", "out force x [N]", "out force z [N]", "out rate [1/s]"].iter().enumerate()
    {
        history.header.push((*name).to_owned());
        for row in &mut history.rows {
            let t = row[0].number().unwrap();
            row.push(Cell::Number(if k == 3 && t < 1.0 { f64::NAN } else { (1.0 + k as f64) * t }));
        }
    }
    history.write(&dir.join("history.csv")).unwrap();
    let mut layers = Table::new(["time [s]", "z [m]", "solid fraction [-]", "nothing [-]"]);
    let mut field = Table::new(["time [s]", "x [m]", "z [m]", "density [kg/m^2]"]);
    let mut some = Table::new(["time [s]", "id [-]", "position z [m]"]);
    for look in 0..9 {
        let t = 0.5 * f64::from(look);
        for k in 0..12 {
            let z = 0.01 * f64::from(k);
            layers.push([t, z, 0.6 - 0.05 * t - z, 0.0].map(Cell::Number));
            for i in 0..5 {
                let blank = i == 0 && k == 0;
                field.push([t, 0.01 * f64::from(i), z, if blank { f64::NAN } else { z * t }].map(Cell::Number));
            }
        }
        for id in [7.0, 3.0] {
            some.push([t, id, id * t].map(Cell::Number));
        }
    }
    let mut sand = Table::new(["time [s]", "id [-]", "start [s]", "height [m]", "restitution [-]"]);
    for (time, id, start, height) in [(1.0, 4.0, 0.5, 0.01), (1.5, 9.0, 0.2, 0.02), (2.0, 4.0, 1.1, 0.005)] {
        sand.push([time, id, start, height, f64::NAN].map(Cell::Number));
    }
    sand.write(&dir.join("watch/sand.csv")).unwrap();
    layers.write(&dir.join("watch/layers.csv")).unwrap();
    field.write(&dir.join("watch/field.csv")).unwrap();
    some.write(&dir.join("watch/some.csv")).unwrap();
}

/// Results have the unit they were given; one that came to no number is no headline of the page.
#[test]
fn results_have_their_units() {
    let dir = tempfile::tempdir().unwrap();
    watched(dir.path());
    let mut summary = fixture::summary("dem");
    summary.results = tsubu_frame::Named::default();
    summary.give("out rate", "1/s", f64::NAN);
    summary.give("out passed mass final", "kg", 0.25);
    summary.write(&dir.path().join("summary.json")).unwrap();
    let report = build(dir.path()).unwrap();
    let card = |label: &str| report.cards.iter().find(|card| card.label == label).map(|card| card.unit.as_str());
    assert_eq!([card("out rate"), card("out passed mass final")], [None, Some("kg")]);
    let Some(Block::Table(table)) = section(&report, "Results").first() else { panic!("no table") };
    let units: Vec<_> = table.rows.iter().map(|(_, row)| [row[0].as_str(), row[2].as_str()]).collect();
    assert_eq!(units, [["out rate", "1/s"], ["out passed mass final", "kg"]]);
}

fn captions(blocks: &[Block]) -> Vec<String> {
    let mut found = Vec::new();
    for block in blocks {
        match block {
            Block::Drawing { caption, .. } => found.push(caption.clone()),
            Block::Folded { inside, .. } => found.extend(captions(inside)),
            _ => {}
        }
    }
    found
}

fn section<'a>(report: &'a Report, title: &str) -> &'a [Block] {
    report.sections.iter().find(|s| s.title == title).map_or(&[], |s| s.blocks.as_slice())
}

#[test]
fn what_watches_saw_is_drawn() {
    let dir = tempfile::tempdir().unwrap();
    watched(dir.path());
    report(dir.path()).unwrap();
    let page = build(dir.path()).unwrap();
    assert_eq!(
        captions(section(&page, "Watches")),
        [
            "layers (profile): solid fraction",
            "field (coarse grain): density, mean over time",
            "some (track): position z",
            "sand (hops): height",
            "out (discharge): passed mass",
            "out (discharge): force",
            "out (discharge): rate",
        ]
    );
    // Once on the page, not among the history's figures too.
    assert!(!captions(section(&page, "Motion")).iter().any(|c| c.contains("out ")));
    let figure = |name: &str| fs::read_to_string(dir.path().join("figures").join(name)).unwrap();
    for (name, said) in [
        ("watch_layers_solid_fraction_profile.svg", "t = 2.000 s"),
        ("watch_layers_solid_fraction_profile.svg", "mean over time"),
        ("watch_some_position_z_paths.svg", "grain 7"),
        ("watch_sand_height_events.svg", "grain 9"),
        ("watch_sand_height_events.svg", "start"),
        ("watch_out_force.svg", "force z"),
    ] {
        assert!(figure(name).contains(said), "{name}: {said}");
    }
    let map = figure("watch_field_density_map.svg");
    assert!(from_svg(&map, 1.0).is_some());
    // Sixty points, one of them blank; the ground, the frame and the colour bar.
    assert_eq!(map.matches("<rect").count(), 59 + 3);
    assert!(map.contains("density [kg/m²]"));
}

#[test]
fn damaged_tables_of_watches_become_notes() {
    let dir = tempfile::tempdir().unwrap();
    watched(dir.path());
    fixture::text(dir.path(), "watch/field.csv", "time [s],x [m]\n1\n");
    let page = build(dir.path()).unwrap();
    assert!(page.to_html().contains("watch/field.csv"));
    assert!(captions(section(&page, "Watches")).len() == 6);
    fixture::text(dir.path(), "watch/index.json", "[{");
    assert!(section(&build(dir.path()).unwrap(), "Watches").is_empty());
}

/// The report of a short run in which no grain had ended a hop was called one of damaged results, with exit code 3.
#[test]
fn a_watch_that_saw_nothing_is_no_damage() {
    let dir = tempfile::tempdir().unwrap();
    watched(dir.path());
    let damage = || tsubu_report::report(dir.path()).unwrap().damage;
    let before = damage();
    fixture::text(dir.path(), "watch/field.csv", "time [s],x [m]\n");
    assert_eq!(damage(), before);
    assert!(build(dir.path()).unwrap().to_html().contains("watch/field.csv has no rows"));
    fixture::text(dir.path(), "watch/field.csv", "time [s],x [m]\n1,2");
    assert_ne!(damage(), before);
}

/// A page of 44 figures, two a number, in one heap. What is the same in all cases stands in the table alone.
#[test]
fn a_sweep_draws_each_number_once_and_watch_by_watch() {
    let dir = tempfile::tempdir().unwrap();
    let names = |watch: &str| (0..6).map(|k| format!("{watch} F{k} [N],{watch} F{k} final [N]")).collect::<Vec<_>>();
    let head = [names("lid"), names("lid-shear"), vec!["lid-shear still [N]".to_owned()]].concat().join(",");
    let row = |value: u32| format!("a,{value},finished,{},5\n", vec![value.to_string(); 24].join(","));
    let table = format!("case [text],seed.of [text],status [text],{head}\n{}{}", row(1), row(2));
    fixture::text(dir.path(), "sweep.csv", &table);
    fixture::text(dir.path(), "scene.toml", "[watch.lid]\n[watch.lid-shear]\n");
    let report = build(dir.path()).unwrap();
    let over = report.sections.iter().find(|s| s.title == "Results over what varied").expect("section");
    let Some(Block::Folded { summary, inside }) = over.blocks.get(8) else { panic!("{:?}", over.blocks.last()) };
    assert_eq!((over.blocks.len(), summary.as_str(), inside.len()), (9, "More results over what varied: lid-shear", 4));
}
