//! One figure and one table of a study that ran several scenes by several methods: rows are scenes, columns methods.

use std::fmt::Write as _;

use tsubu_frame::{Table, read_frame, snapshots, summary::read_json};

use crate::balls::{Balls, ColourBy, Look};
use crate::compare::Refused;
use crate::legend::time_label;
use crate::moments;
use crate::page::{Block, Grid, Tone, folded};
use crate::plot::INK;
use crate::source::Source;
use crate::strip::{Panel, strip};
use crate::summary::method_name;
use crate::text::{escape, short};

/// What stands in a scene's `gallery.json`.
#[derive(Debug, serde::Deserialize)]
struct Scene {
    title: String,
    /// Left, bottom, right, top [m].
    window: [f64; 4],
    /// Who ran; each has a folder of that name.
    panels: Vec<String>,
    refused: Vec<Refused>,
    /// Name of its folder.
    #[serde(skip)]
    name: String,
}

/// Figure, table and refusals of a study's folder; nothing where it has none.
pub(crate) fn blocks(source: &mut Source, study: &str) -> Vec<Block> {
    let scenes = scenes(source, study);
    let mut columns: Vec<String> = Vec::new();
    for name in scenes.iter().flat_map(|scene| &scene.panels) {
        if !columns.contains(name) {
            columns.push(name.clone());
        }
    }
    if columns.is_empty() {
        return Vec::new();
    }
    let mut rows = Vec::new();
    for scene in &scenes {
        let look = Look { window: Some(scene.window), ..Look::default() };
        let panels: Vec<Panel> = columns.iter().map(|name| panel(source, study, scene, name)).collect();
        rows.push(Row {
            title: scene.title.clone(),
            names: columns.clone(),
            svg: strip(&panels, &look, columns.len()),
        });
    }
    let caption = "Rows: scenes. Columns: methods. Colours: the height at which a grain began, or its size.";
    let mut blocks = vec![source.drawing(study, stacked(&rows), caption)];
    let (table, text) = table(source, study, &scenes, &columns);
    source.files.push((format!("{study}.csv"), text.into_bytes()));
    blocks.push(table);
    blocks.push(folded("Who could not run a scene, and why", vec![refusals(&scenes)]));
    blocks
}

/// The scenes of a study's folder, by name.
fn scenes(source: &mut Source, study: &str) -> Vec<Scene> {
    let entries = std::fs::read_dir(source.dir.join(study)).into_iter().flatten().filter_map(Result::ok);
    let mut folders: Vec<_> = entries.map(|entry| entry.path()).filter(|p| p.join("gallery.json").exists()).collect();
    folders.sort();
    let mut scenes = Vec::new();
    for folder in folders {
        let read = read_json::<Scene>(&folder.join("gallery.json"));
        let name = folder.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        scenes.extend(source.told(read).map(|scene| Scene { name, ..scene }));
    }
    scenes
}

/// The last of a method's snapshots, coloured by where grains were in the first if there are two, else by their sizes.
fn panel(source: &mut Source, study: &str, scene: &Scene, name: &str) -> Panel {
    // A variant of one scene alone is no answer to the others.
    let label = if scene.refused.iter().any(|refused| refused.method == name) { "cannot" } else { "–" };
    let cannot = Panel { label: label.into(), ..Panel::default() };
    let read = snapshots(&source.dir.join(study).join(&scene.name).join(name));
    let found = source.told(read).unwrap_or_default();
    let (Some(first), Some(last)) = (found.first(), found.last()) else { return cannot };
    let frames = read_frame(&first.path).and_then(|first| Ok((first, read_frame(&last.path)?)));
    let Some((first, last)) = source.told(frames) else { return cannot };
    let colour = if found.len() > 1 {
        ColourBy::Given("height before".into(), "m".into(), moments::heights(&first, &last))
    } else {
        ColourBy::Column("radius".into())
    };
    let balls = Balls::of(&last, &Look { colour, ..Look::default() });
    // Many columns have no room for "t =".
    let label = time_label(last.time, last.time).trim_start_matches("t = ").to_owned();
    Panel { balls, label, arrow: None }
}

/// A strip with what stands over it.
struct Row {
    title: String,
    /// Names of the columns.
    names: Vec<String>,
    svg: String,
}

/// Strips below each other, titles and names over each.
fn stacked(rows: &[Row]) -> String {
    const TITLE: f64 = 44.0;
    let size = |svg: &str, name: &str| -> f64 {
        let value = svg.split_once(&format!(" {name}=\"")).and_then(|(_, rest)| rest.split('"').next());
        value.and_then(|value| value.parse().ok()).unwrap_or(0.0)
    };
    let width = rows.iter().map(|row| size(&row.svg, "width")).fold(0.0, f64::max);
    let height: f64 = rows.iter().map(|row| size(&row.svg, "height") + TITLE).sum();
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
         viewBox=\"0 0 {width:.1} {height:.1}\" font-family=\"system-ui, -apple-system, Segoe UI, Roboto, Helvetica, \
         Arial, sans-serif\" fill=\"{INK}\">"
    );
    let mut top = 0.0;
    for Row { title, names, svg } in rows {
        let _ = write!(out, "<text x=\"0\" y=\"{:.1}\" font-size=\"14\">{}</text>", top + 16.0, escape(title));
        for (index, name) in names.iter().enumerate() {
            let middle = width * (index as f64 + 0.5) / names.len() as f64;
            // Whether a model is "after" its authors the table says; here it has no room.
            let name = method_name(name).trim_start_matches("after-");
            // Two authors stand below each other.
            let lines = if name.len() > 8 { 2 } else { 1 };
            for (line, word) in name.rsplitn(lines, '-').enumerate() {
                let _ = write!(
                    out,
                    "<text x=\"{middle:.1}\" y=\"{:.1}\" font-size=\"9\" text-anchor=\"middle\">{}</text>",
                    top + 38.0 - 10.0 * line as f64,
                    escape(word)
                );
            }
        }
        out.push_str(&svg.replacen("<svg ", &format!("<svg y=\"{:.1}\" ", top + TITLE), 1));
        top += TITLE + size(svg, "height");
    }
    out.push_str("</svg>");
    out
}

/// All quantities of all scenes, on the page and as text.
fn table(source: &mut Source, study: &str, scenes: &[Scene], columns: &[String]) -> (Block, String) {
    let header = || ["scene [text]", "quantity [text]"].map(str::to_owned).into_iter();
    let mut kept = Table::new(header().chain(columns.iter().map(|name| format!("{name} [unit of the row]"))));
    let mut grid = Grid::new(
        ["scene", "quantity"].map(str::to_owned).into_iter().chain(columns.iter().map(|n| method_name(n).to_owned())),
    );
    for scene in scenes {
        let Some(measured) = source.inside(study).inside(&scene.name).table("measures.csv") else { continue };
        for row in &measured.rows {
            let what = row[0].to_string();
            let value = |name: &String| measured.index(name).and_then(|at| row[at].number()).unwrap_or(f64::NAN);
            let values: Vec<f64> = columns.iter().map(value).collect();
            let words = [scene.name.clone(), what.clone()];
            kept.push(words.clone().map(Into::into).into_iter().chain(values.iter().map(|x| (*x).into())));
            grid.push(Tone::Plain, words.into_iter().chain(values.iter().map(|x| short(*x))));
        }
    }
    (Block::Table(grid), kept.to_csv())
}

fn refusals(scenes: &[Scene]) -> Block {
    let mut grid = Grid::new(["scene", "method", "key", "why"]);
    for scene in scenes {
        for Refused { method, because } in &scene.refused {
            for (key, why) in because {
                grid.push(Tone::Plain, [&scene.name, method_name(method), key, why]);
            }
        }
    }
    Block::Table(grid)
}
