//! Judges how tsubu reads a scene and its files.

use crate::bundle::Bundle;
use crate::outcome::Outcome;
use std::fs;
use std::path::Path;
use toml::Value;
use tsubu_scene::{Complaints, Plan, Scene};

/// What must come of a scene, beside that it ends in a plan or in complaints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expect {
    /// Nothing more.
    Survive,
    /// Complaints.
    Refuse,
    /// The same numbers as the scene in `before/`.
    Same,
    /// The same numbers, or complaints.
    SameOrRefuse,
    /// Complaints, or other numbers than those of the scene in `before/`.
    Other,
}

impl Expect {
    const ALL: [(&'static str, Self); 5] = [
        ("survive", Self::Survive),
        ("refuse", Self::Refuse),
        ("same-or-refuse", Self::SameOrRefuse),
        ("same", Self::Same),
        ("other", Self::Other),
    ];

    /// Writes it into the bundle, with what was changed and with what was there before.
    pub fn of(self, change: &str, mut bundle: Bundle, before: &Bundle) -> Bundle {
        let name = Self::ALL.iter().find(|(_, expect)| *expect == self).map_or("", |(name, _)| name);
        bundle.put("expect", format!("{name}: {change}\n"));
        if matches!(self, Self::Same | Self::SameOrRefuse | Self::Other) {
            bundle.put_inside("before", before);
        }
        bundle
    }

    /// What the bundle says.
    pub fn read(bundle: &Bundle) -> Self {
        let text = bundle.text("expect").unwrap_or_default();
        let word = text.split([':', '\n']).next().unwrap_or_default();
        Self::ALL.iter().find(|(name, _)| *name == word).map_or(Self::Survive, |(_, expect)| *expect)
    }
}

/// Longer messages help nobody.
const LONGEST_MESSAGE: usize = 64 << 10;

/// Numbers of two files that say the same in other words may differ in the last place.
const SAME: f64 = 1e-12;

/// Reads the scene of a bundle in `folder` and holds what comes of it against what must.
pub fn judge(bundle: &Bundle, folder: &Path) -> Result<Outcome, String> {
    let expect = Expect::read(bundle);
    let change = bundle.text("expect").unwrap_or_default();
    let change = change.trim();
    let scene = match read(bundle, &folder.join("scene")) {
        Err(complaints) => {
            of_complaints(&complaints)?;
            let title = complaints.titles().next().unwrap_or_default();
            return match expect {
                Expect::Same => Err(format!("refused ({change}): {title}")),
                _ => Ok(Outcome::Refused),
            };
        }
        Ok(scene) => scene,
    };
    again(&scene, &folder.join("again"))?;
    match expect {
        Expect::Survive => {}
        Expect::Refuse => return Err(format!("accepted ({change})")),
        Expect::Same | Expect::SameOrRefuse | Expect::Other => {
            let before = read(&bundle.inside("before"), &folder.join("before"))
                .map_err(|complaints| format!("what was there before is wrong: {complaints}"))?;
            let different = difference(&numbers(before.plan()), &numbers(scene.plan()));
            match (expect, different) {
                (Expect::Other, None) => return Err(format!("accepted ({change}), and nothing is different")),
                (Expect::Same | Expect::SameOrRefuse, Some(text)) => {
                    return Err(format!("accepted ({change}): {text}"));
                }
                _ => {}
            }
        }
    }
    Ok(Outcome::Accepted)
}

/// Reads the scene of a bundle from a folder of its own, which is gone afterwards.
pub fn read(bundle: &Bundle, folder: &Path) -> Result<Scene, Complaints> {
    let changes: Vec<String> =
        bundle.bytes("changes.json").and_then(|bytes| serde_json::from_slice(bytes).ok()).unwrap_or_default();
    let written = bundle.write(folder);
    assert!(written.is_ok(), "cannot write to {}: {written:?}", folder.display());
    let scene = Scene::read(&folder.join("scene.toml"), &changes);
    // What is left of one case must not be read by the next.
    let _ = fs::remove_dir_all(folder);
    scene
}

fn of_complaints(complaints: &Complaints) -> Result<(), String> {
    let text = complaints.to_string();
    let _ = complaints.render(true);
    if text.contains("mistake in tsubu") {
        return Err(format!("calls itself mistaken: {}", text.lines().next().unwrap_or_default()));
    }
    if text.len() > LONGEST_MESSAGE {
        return Err(format!("a message longer than {LONGEST_MESSAGE} bytes: {text:.60}"));
    }
    if text.lines().any(|line| line.contains('\u{1b}')) {
        return Err("a message with the control characters of what was read".to_owned());
    }
    Ok(())
}

/// The resolved scene means the same, read again beside its files.
fn again(scene: &Scene, folder: &Path) -> Result<(), String> {
    let text = scene.resolved_toml();
    let mut bundle = Bundle::default().with("scene.toml", text.as_bytes());
    for (name, bytes) in scene.companions() {
        bundle.put(name, bytes);
    }
    let read = read(&bundle, folder).map_err(|complaints| {
        format!("the resolved scene is refused: {}", complaints.titles().next().unwrap_or_default())
    })?;
    if read.plan() != scene.plan() {
        let text = difference(&numbers(scene.plan()), &numbers(read.plan()));
        return Err(format!("the resolved scene means something else: {}", text.unwrap_or_default()));
    }
    if read.resolved_toml() != text {
        return Err("the resolved scene is written differently the second time".to_owned());
    }
    Ok(())
}

/// What a plan says: every value with the way to it, and what was read from files.
fn numbers(plan: &Plan) -> Vec<(String, Value)> {
    let mut out = Vec::new();
    match Value::try_from(plan) {
        Ok(value) => leaves(String::new(), &value, &mut out),
        Err(error) => out.push(("error".to_owned(), Value::String(error.to_string()))),
    }
    // Watches stand in the order of the scene, which says only where their results are shown.
    out.sort_by(|(a, _), (b, _)| a.cmp(b));
    for (name, group) in &plan.particles {
        if let tsubu_scene::plan::Start::File { grains, .. } = &group.start {
            let columns = [&grains.position, &grains.velocity, &grains.spin];
            let all = columns.iter().flat_map(|column| column.iter().flatten()).chain(&grains.diameter);
            out.extend(all.map(|number| (format!("grains of {name}"), Value::Float(*number))));
        }
    }
    for (name, wall) in &plan.walls {
        if let tsubu_scene::plan::Shape::Mesh { triangles, .. } = &wall.shape {
            let all = triangles.iter().flatten().flatten();
            out.extend(all.map(|number| (format!("triangles of {name}"), Value::Float(*number))));
        }
    }
    out
}

fn leaves(path: String, value: &Value, out: &mut Vec<(String, Value)>) {
    match value {
        Value::Table(table) => {
            // Two files that say the same are not the same file.
            let of_a_file = |name: &str| table.contains_key("fingerprint") && ["path", "fingerprint"].contains(&name);
            for (name, value) in table.iter().filter(|(name, _)| !of_a_file(name)) {
                leaves(format!("{path}.{name}"), value, out);
            }
        }
        Value::Array(list) => list.iter().for_each(|value| leaves(path.clone(), value, out)),
        other => out.push((path, other.clone())),
    }
}

/// The first thing that two plans say differently.
fn difference(before: &[(String, Value)], after: &[(String, Value)]) -> Option<String> {
    let same = |a: &Value, b: &Value| match (a, b) {
        (Value::Float(a), Value::Float(b)) => a == b || (a - b).abs() <= SAME * a.abs().max(b.abs()),
        _ => a == b,
    };
    if let Some((before, after)) = before.iter().zip(after).find(|(a, b)| a.0 != b.0 || !same(&a.1, &b.1)) {
        return Some(format!("{} = {} was {} = {}", after.0, after.1, before.0, before.1));
    }
    (before.len() != after.len()).then(|| format!("{} values instead of {}", after.len(), before.len()))
}
