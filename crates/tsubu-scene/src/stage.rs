//! Stages: pieces of a run, each with its own values of some keys.
//!
//! A stage is the scene with what this stage and those before it set put in its place, and with its length as the duration: read, checked
//! and resolved like any scene. Which keys may change is said in the table of keys.

use crate::change::{self, Step};
use crate::complaint::{Complaint, Place};
use crate::files::Files;
use crate::keys::{self, Key, Kind};
use crate::node::{Entry, Node, Table, Value};
use crate::plan::{Host, Plan};
use crate::suggest;
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

/// Where a run keeps what others may go on from.
const CHECKPOINT: &str = "checkpoint/state.tsubu";

/// Puts the values of a stage (and of those before it) into a scene; complains about what no stage may say.
pub(crate) fn enter(root: &mut Node, number: usize) -> Vec<Complaint> {
    let mut complaints = Vec::new();
    let Some(list) = stages(root) else { return complaints };
    let places: Vec<Place> = list.iter().map(|stage| stage.place.clone()).collect();
    if let Some(duration) = root.table().and_then(|top| top.entry("duration")) {
        complaints.push(
            Complaint::new("`duration` and `stage` exclude each other")
                .at(&duration.place, "`duration` is given")
                .also(&places[0], "the first stage")
                .hint("every stage has a length of its own: leave `duration` at the top out"),
        );
    }
    let mut names = BTreeSet::new();
    for (index, stage) in list.iter().enumerate().take(number + 1) {
        let Some(table) = stage.table() else { continue };
        complaints.extend(name(table, &mut names));
        if let Err(complaint) = length(table, &stage.place) {
            complaints.push(complaint);
        }
        complaints.extend(table.entry("until").and_then(condition));
        let Some(set) = table.get("set").and_then(Node::table) else { continue };
        complaints.extend(pieces(set, &[]).into_iter().filter_map(|piece| put(root, piece, index).err()));
    }
    let length = list.get(number).and_then(Node::table).and_then(|table| length(table, &places[0]).ok());
    // A wrong length has been complained about.
    let value = length.unwrap_or(Node { value: Value::Number(1.0), place: places[0].clone() });
    if let Value::Table(top) = &mut root.value {
        top.set(Entry { key: "duration".to_owned(), place: value.place.clone(), node: value });
    }
    complaints
}

/// The stages of a scene, where there are any.
fn stages(root: &Node) -> Option<Vec<Node>> {
    match &root.table()?.get("stage")?.value {
        Value::List(list) if !list.is_empty() => Some(list.clone()),
        _ => None,
    }
}

/// What is wrong with the name of a stage.
fn name(stage: &Table, names: &mut BTreeSet<String>) -> Option<Complaint> {
    let entry = stage.entry("name")?;
    let Value::Text(name) = &entry.node.value else { return None };
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    if name.is_empty() || !name.chars().all(plain) {
        let complaint = Complaint::new(format!("`{name}` is no name of a stage")).at(&entry.node.place, "here");
        return Some(complaint.hint("letters, digits, `-` and `_`: results are called NAME.RESULT"));
    }
    let again = !names.insert(name.clone());
    again.then(|| Complaint::new(format!("two stages are called `{name}`")).at(&entry.node.place, "here again"))
}

/// What is wrong with what ends a stage.
fn condition(until: &Entry) -> Option<Complaint> {
    let asked = until.node.table()?;
    if asked.entries.is_empty() {
        return Some(
            Complaint::new("`until` is empty")
                .at(&until.place, "nothing is to come true")
                .hint("say what ends the stage, for example until.kinetic-energy = \"1 nJ\", or give it a `duration`"),
        );
    }
    let bounds = ["above", "below"].map(|key| asked.entry(key));
    match (asked.entry("result"), bounds) {
        (Some(result), [None, None]) => Some(
            Complaint::new("a `result` ends a stage where it is `above` or `below` something")
                .at(&result.place, "neither is given"),
        ),
        (None, [Some(bound), _] | [None, Some(bound)]) => Some(
            Complaint::new(format!("`{}` needs a `result`", bound.key))
                .at(&bound.place, "of what?")
                .hint("`result`: the name of a column of the history, without its unit"),
        ),
        _ => None,
    }
}

/// How long a stage lasts, or lasts at most.
fn length(stage: &Table, place: &Place) -> Result<Node, Complaint> {
    let [duration, until, most] = ["duration", "until", "at-most"].map(|key| stage.entry(key));
    match (duration, until, most) {
        (Some(duration), None, None) => Ok(duration.node.clone()),
        (None, Some(_), Some(most)) => Ok(most.node.clone()),
        (None, Some(until), None) => Err(Complaint::new("a stage that ends by `until` needs `at-most`")
            .at(&until.place, "this may never come true")
            .hint("`at-most`: how long it lasts at most, for example \"10 s\"")),
        (None, None, _) => {
            Err(Complaint::new("a stage needs `duration`, or `until` and `at-most`").at(place, "this stage"))
        }
        (Some(duration), _, _) => Err(Complaint::new("`duration` excludes `until` and `at-most`")
            .at(&duration.place, "given here")
            .hint("keep `duration`, or `until` with `at-most`")),
    }
}

/// A value to put, and where.
type Piece = (Vec<Step>, Node);

/// The single values of a piece of a scene. A watch or a region of removal is told whole.
fn pieces(table: &Table, before: &[(String, Place)]) -> Vec<Piece> {
    let mut all = Vec::new();
    for entry in &table.entries {
        let mut path = before.to_vec();
        let steps = change::steps(&entry.key, entry.place.source).unwrap_or_default();
        path.extend(steps.into_iter().map(|step| (step.name, entry.place.clone())));
        let whole = path.len() == 2 && matches!(path[0].0.as_str(), "watch" | "removal");
        match &entry.node.value {
            Value::Table(inner) if !inner.entries.is_empty() && !whole => all.extend(pieces(inner, &path)),
            _ => {
                let steps = path.into_iter().map(|(name, place)| Step { name, place }).collect();
                all.push((steps, entry.node.clone()));
            }
        }
    }
    all
}

/// Puts one value into the scene, if a stage may.
fn put(root: &mut Node, (steps, value): Piece, index: usize) -> Result<(), Complaint> {
    let names: Vec<&str> = steps.iter().map(|step| step.name.as_str()).collect();
    let path = names.join(".");
    let Some(first) = names.first() else {
        return Err(Complaint::new("an empty key in `set`").at(&value.place, "set here"));
    };
    let place = steps.last().map_or(value.place.clone(), |step| step.place.clone());
    // The first stage begins the run: it may say what it wants.
    if index > 0 && !may_change(keys::SCENE, &names) {
        return Err(Complaint::new(format!("`{path}` stays as it is from stage to stage"))
            .at(&place, "set here")
            .hint(format!("{}; {}", reason(first), "set it at the top of the scene"))
            .hint(format!("a stage may set {}", suggest::list(changing().iter().map(String::as_str)))));
    }
    let shakes = |host: &str| root.find(&["hosts", host, "structure", "shaker"]).is_some();
    if let ["hosts", host, "base", ..] = names.as_slice()
        && index > 0
        && shakes(host)
    {
        return Err(Complaint::new(format!("the shaker `{host}` would jump to where another `base` is"))
            .at(&place, "set here")
            .hint("write the whole motion as one `base.table`"));
    }
    if names.last() == Some(&"file") {
        return Err(Complaint::new("a stage reads no files")
            .at(&place, "named here")
            .hint("write the table into the scene, as lists `time` and `value`"));
    }
    match &mut root.value {
        Value::Table(top) => change::put(top, keys::SCENE, "", &steps, value),
        _ => Ok(()),
    }
}

/// Whether a stage may change what is at a path; what is not known is complained about elsewhere.
fn may_change(keys: &'static [Key], path: &[&str]) -> bool {
    let [name, rest @ ..] = path else { return false };
    let Some(key) = keys::find(keys, name) else { return true };
    if key.may_change {
        return true;
    }
    match (key.kind, rest) {
        (Kind::Table(inner), rest) | (Kind::Named(inner, _) | Kind::Many(inner), [_, rest @ ..]) => {
            may_change(inner, rest)
        }
        (Kind::Choice(variants), [variant, rest @ ..]) => {
            variants.iter().find(|known| known.name == *variant).is_none_or(|known| may_change(known.keys, rest))
        }
        _ => false,
    }
}

/// Whether a run may go on from another that has another value under a key, as it is written in a resolved scene.
pub(crate) fn may_differ(key: &str) -> bool {
    may_change(keys::SCENE, &key.split('.').collect::<Vec<_>>())
}

/// Every key that a stage may set.
fn changing() -> Vec<String> {
    let mut all = Vec::new();
    keys::walk(&mut |path, keys| {
        // What is below one that may change may change with it.
        let below = all.iter().any(|known: &String| path == known || path.starts_with(&format!("{known}.")));
        if !below {
            let paths = keys.iter().filter(|key| key.may_change).map(|key| match path {
                "" => key.name.to_owned(),
                _ => format!("{path}.{}", key.name),
            });
            all.extend(paths.collect::<Vec<_>>());
        }
    });
    all
}

/// Why a key stays as it is.
fn reason(first: &str) -> &'static str {
    match first {
        "particles" => "grains are made once; what a stream of grains does may change",
        "walls" => "walls keep their shape and material; who moves them and when they vanish may change",
        "hosts" => "structures stay; what drives them may change",
        "materials" | "material-pair" => "the mass of grains hangs on it",
        "water" => {
            "what moves along with grains hangs on it; how the water flows and what holds grains in it may change"
        }
        "bond" => "bonds are part of the grains; `at` says when they are made",
        "periodic" => "the places of all grains hang on it",
        "method" | "dimension" | "seed" | "dem" => "the run is one from beginning to end",
        _ => "it is of the run as a whole",
    }
}

/// Rows of the history that a period of a host must have for its rms displacement to be known.
const ROWS_A_PERIOD: f64 = 8.0;

/// What keeps the hosts of a stage from ever being found steady.
pub(crate) fn never_steady(plan: &Plan, number: usize, root: &Node) -> Option<Complaint> {
    plan.stage.get(number)?.until.as_ref()?.host_steady?;
    let place = root.locate(&["stage", &number.to_string(), "until", "host-steady"]);
    let Some(period) = plan.hosts.values().filter_map(Host::period).reduce(f64::min) else {
        return Some(
            Complaint::new("no host is driven by a sine, and none becomes steady").at(&place, "waits for one"),
        );
    };
    let interval = plan.output.history_interval;
    (interval > period / ROWS_A_PERIOD).then(|| {
        Complaint::new("rows of the history come too rarely to tell whether a host is steady")
            .at(&place, format!("a period is {period} s, a row comes every {interval} s"))
            .hint("set `output.history-interval` to an eighth of a period or less")
    })
}

/// What is left out of a resolved scene of stages: lengths, and what follows from them where nobody tells it.
pub(crate) fn leave_open(resolved: &mut toml::Table, typed: &Node) {
    if stages(typed).is_none() {
        return;
    }
    resolved.remove("duration");
    let Some(output) = resolved.get_mut("output").and_then(toml::Value::as_table_mut) else { return };
    for key in ["history-interval", "checkpoint-interval"] {
        if typed.find(&["output", key]).is_none() {
            output.remove(key);
        }
    }
}

/// Finds the run that a scene goes on from; complains where there is none.
pub(crate) fn find_start(resolved: &mut toml::Table, root: &Node, files: &Files) -> Option<Complaint> {
    let Some(toml::Value::String(folder)) = resolved.get_mut("start-from") else {
        let mut beside = ["start-at-zero", "start-fingerprint"].into_iter();
        let alone = |key| root.find(&[key]).filter(|_| root.find(&["start-from"]).is_none()).map(|node| (key, node));
        return beside.find_map(alone).map(|(key, node)| {
            Complaint::new(format!("`{key}` is of use with `start-from` only"))
                .at(&node.place, "nothing to start from")
                .hint("leave it out: every other run begins at 0")
        });
    };
    let path = files.absolute(folder);
    let named = std::mem::replace(folder, path.to_string_lossy().into_owned());
    let Some(found) = last_written(&path.join(CHECKPOINT)) else {
        return Some(
            Complaint::new(format!("there is no run to start from in `{named}`"))
                .at(&root.locate(&["start-from"]), format!("no {CHECKPOINT} there"))
                .hint("name the folder of a run that came to its end or was interrupted"),
        );
    };
    resolved.insert("start-fingerprint".into(), toml::Value::String(found.clone()));
    let from = root.find(&["start-from"])?;
    // One that was told before a change named another run is of the run before.
    let told = root.find(&["start-fingerprint"]).filter(|told| told.place.source >= from.place.source)?;
    let same = told.plain().is_some_and(|told| told.as_str().is_some_and(|told| told.eq_ignore_ascii_case(&found)));
    (!same).then(|| {
        Complaint::new(format!("the run in `{named}` has gone on, or was made anew, since this scene was resolved"))
            .at(&told.place, format!("its checkpoint's is {found}"))
            .hint("leave `start-fingerprint` out to start from where it is now")
    })
}

/// What tells a checkpoint from another: the CRC-32 that it ends with, in hex.
fn last_written(checkpoint: &Path) -> Option<String> {
    let mut file = File::open(checkpoint).ok()?;
    let mut crc = [0; 4];
    file.seek(SeekFrom::End(-4)).and_then(|_| file.read_exact(&mut crc)).ok()?;
    Some(format!("{:08x}", u32::from_le_bytes(crc)))
}
