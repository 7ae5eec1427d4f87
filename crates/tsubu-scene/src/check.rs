//! Checks across tables: what each value alone cannot tell.
//!
//! They work on the parts that could be read, one by one, so that a wrong wall does not hide an overlap of grains.

mod bonds;
mod contact;
mod design;
mod fill;
mod grains;
mod host;
mod overlap;
mod place;
mod polyhedron;
mod rotor;
mod shell;
mod walls;
mod watch;
mod water;
mod world;

use crate::attach;
use crate::complaint::Complaint;
use crate::files::Files;
use crate::node::{Entry, Node, Table};
use crate::plan::{Claim, Host, MaterialPair, Particles, Periodic, Signal, Wall};
use crate::range;
use crate::study;
use serde::de::DeserializeOwned;
use std::collections::BTreeMap;

/// The parts of a scene that are right in themselves.
pub(crate) struct Parts<'a> {
    root: &'a Node,
    resolved: &'a toml::Table,
    particles: BTreeMap<String, Particles>,
    walls: BTreeMap<String, Wall>,
    hosts: BTreeMap<String, Host>,
    periodic: Periodic,
    files: &'a Files,
    /// Whether a part is missing because it is wrong; then counting what is there would mislead.
    incomplete: bool,
}

/// All complaints that need more than one value.
pub(crate) fn check(resolved: &toml::Table, root: &Node, files: &Files) -> Vec<Complaint> {
    let mut particles = named(resolved, "particles");
    let mut walls = named(resolved, "walls");
    let hosts = named(resolved, "hosts");
    let typed = |key: &str| resolved.get(key).and_then(toml::Value::as_table).map_or(0, toml::Table::len);
    let incomplete =
        particles.len() != typed("particles") || walls.len() != typed("walls") || hosts.len() != typed("hosts");
    let space = resolved.get("dimension").and_then(toml::Value::as_integer) == Some(3);
    attach::grains(&mut particles, files, space);
    attach::meshes(&mut walls, files);
    let periodic = resolved.get("periodic").and_then(|ends| ends.clone().try_into().ok()).unwrap_or_default();
    let parts = Parts { root, resolved, particles, walls, hosts, periodic, files, incomplete };
    let mut complaints = Vec::new();
    let rooms = place::rooms(&parts);
    place::check(&parts, &rooms, &mut complaints);
    fill::regions(&parts, &rooms, &mut complaints);
    if !parts.incomplete {
        fill::capacity(&parts, &rooms, &mut complaints);
    }
    grains::check(&parts, &mut complaints);
    walls::check(&parts, &mut complaints);
    world::check(&parts, &mut complaints);
    watch::check(&parts, &rooms, &mut complaints);
    contact::check(&parts, &mut complaints);
    bonds::check(&parts, &mut complaints);
    design::check(&parts, &mut complaints);
    ranges(&parts, &mut complaints);
    host::check(&parts, &mut complaints);
    water::check(&parts, &mut complaints);
    pairs(&parts, &mut complaints);
    claims(&parts, &mut complaints);
    calibrate(&parts, &mut complaints);
    outputs(&parts, &mut complaints);
    response(&parts, &mut complaints);
    complaints
}

impl Parts<'_> {
    fn space(&self) -> bool {
        self.resolved.get("dimension").and_then(toml::Value::as_integer) == Some(3)
    }
}

fn named<T: DeserializeOwned>(resolved: &toml::Table, key: &str) -> BTreeMap<String, T> {
    let tables = resolved.get(key).and_then(toml::Value::as_table).into_iter().flatten();
    tables.filter_map(|(name, value)| Some((name.clone(), value.clone().try_into().ok()?))).collect()
}

fn list<T: DeserializeOwned>(resolved: &toml::Table, key: &str) -> Vec<(String, T)> {
    let items = resolved.get(key).and_then(toml::Value::as_array).into_iter().flatten().enumerate();
    items.filter_map(|(index, value)| Some((index.to_string(), value.clone().try_into().ok()?))).collect()
}

fn pairs(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    let mut seen: BTreeMap<[String; 2], String> = BTreeMap::new();
    for (index, pair) in list::<MaterialPair>(parts.resolved, "material-pair") {
        let place = parts.root.locate(&["material-pair", &index, "between"]);
        let contact = parts.root.find(&["material-pair", &index, "contact"]).and_then(Node::table);
        let mut names = pair.between.clone();
        names.sort();
        let title = format!("the pair `{}` and `{}`", names[0], names[1]);
        if let Some(first) = seen.insert(names, index) {
            complaints.push(
                Complaint::new(format!("{title} is given twice"))
                    .at(&place, "given again")
                    .also(&parts.root.locate(&["material-pair", &first, "between"]), "given here"),
            );
        }
        let MaterialPair { between: _, restitution, friction, rolling_friction, twisting_friction, .. } = &pair;
        let values = [restitution, friction, rolling_friction, twisting_friction, &pair.surface_energy, &pair.cohesion];
        if values.iter().all(|value| value.is_none()) && contact.is_none_or(|contact| contact.entries.is_empty()) {
            complaints.push(
                Complaint::new(format!("{title} changes nothing"))
                    .at(&place, "no value for this pair")
                    .hint("give at least one of `restitution`, `friction`, `rolling-friction`, `twisting-friction`, `surface-energy`, `cohesion`, or a part of a `contact` law"),
            );
        }
    }
}

/// Looks, rows or frames of a run, of which nobody wants more; a step gives one at most.
const MOST_OUTPUTS: f64 = 1e8;

/// An interval of a slip of the pen would be counted up for ever.
fn outputs(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    let Some(duration) = parts.resolved.get("duration").and_then(toml::Value::as_float) else { return };
    let intervals = ["history-interval", "frame-interval", "checkpoint-interval"].map(|key| vec!["output", key]);
    let watches = parts.resolved.get("watch").and_then(toml::Value::as_table).into_iter().flatten();
    let looks = watches.map(|(name, _)| vec!["watch", name.as_str(), "every"]);
    for path in intervals.into_iter().chain(looks) {
        let typed = parts.root.find(&path).is_some();
        let top = parts.resolved.get(path[0]);
        let value = top.and_then(|top| path[1..].iter().try_fold(top, |table, key| table.get(*key)));
        let Some(interval) = value.and_then(toml::Value::as_float).filter(|_| typed) else { continue };
        let count = duration / interval;
        if count > MOST_OUTPUTS {
            complaints.push(
                Complaint::new(format!("`{}` asks for {count:.0e} outputs", path.join(".")))
                    .at(&parts.root.locate(&path), format!("{interval} s, in {duration} s"))
                    .hint(format!("take at least {:.1e} s; a step gives one output at most", duration / MOST_OUTPUTS)),
            );
        }
    }
}

fn claims(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    for (index, claim) in list::<Claim>(parts.resolved, "claim") {
        let at = |key: &str| parts.root.locate(&["claim", &index, key]);
        // A bound that was typed but wrong has its own complaint.
        let typed = ["low", "high"].iter().any(|key| at(key) != at("result") && is_typed(parts, &index, key));
        match (claim.low, claim.high) {
            (None, None) if !typed => complaints.push(
                Complaint::new(format!("the claim on `{}` accepts any number", claim.result))
                    .at(&at("result"), "neither `low` nor `high`")
                    .hint("give at least one of the two"),
            ),
            (Some(low), Some(high)) if low > high => complaints.push(
                Complaint::new(format!("the claim on `{}` accepts no number", claim.result))
                    .at(&at("high"), format!("{high} is below `low` = {low}")),
            ),
            _ => {}
        }
    }
}

/// A range without steps is for studies that vary a key continuously.
fn ranges(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    for family in study::STUDIES.into_iter().filter(|family| !study::CONTINUOUS.contains(family)) {
        let varied = parts.root.find(&[family, "vary"]).and_then(Node::table);
        let open = |range: &Table| range.entry("from").is_some() && range.entry("step").is_none();
        let table = |entry: &&Entry| entry.node.table().is_some_and(open);
        for entry in varied.into_iter().flat_map(|varied| &varied.entries).filter(table) {
            complaints.push(
                Complaint::new(format!("the range of `{}` has no `step`", entry.key))
                    .at(&entry.place, format!("[{family}] runs single values"))
                    .hint("add `step`, or list the values"),
            );
        }
    }
}

/// A range has two ends, and something that was measured.
fn calibrate(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    let Some(wanted) = parts.resolved.get("calibrate").and_then(toml::Value::as_table) else { return };
    let example = "for example \"materials.sand.friction\" = [0.2, 0.8]";
    let varied = wanted.get("vary").and_then(toml::Value::as_table);
    let at = |key: &str| parts.root.locate(&["calibrate", "vary", key]);
    if varied.is_some_and(toml::Table::is_empty) {
        let place = parts.root.locate(&["calibrate", "vary"]);
        complaints
            .push(Complaint::new("`calibrate.vary` names no key").at(&place, "which are not known?").hint(example));
    }
    for (key, ends) in varied.into_iter().flatten() {
        let values = ends.as_array().map_or(&[][..], Vec::as_slice);
        let number = values.len();
        if number != 2 && range::ends(values).is_none() {
            complaints.push(
                Complaint::new(format!("`{key}` needs the least and the largest value"))
                    .at(&at(key), format!("{number} values here"))
                    .hint(example),
            );
        }
    }
    let asked = parts.root.find(&["calibrate", "curve"]).is_some();
    if !asked && wanted.get("measured").and_then(toml::Value::as_array).is_some_and(Vec::is_empty) {
        complaints.push(
            Complaint::new("nothing is measured that values could fit")
                .at(&parts.root.locate(&["calibrate", "measured"]), "the list is empty")
                .hint("add [[calibrate.measured]] with `result`, `value` and `uncertainty`")
                .hint("or [calibrate.curve] with the file of a measured response"),
        );
    }
    let response = parts.resolved.get("response");
    let place = parts.root.locate(&["calibrate", "curve"]);
    if asked && response.is_none() {
        complaints.push(
            Complaint::new("a response curve was measured, and the scene has no `[response]`")
                .at(&place, "asked for here")
                .hint("add [response] with frequency-ratio = [1]: those of the curve take its place"),
        );
    }
    let path = response.and_then(|response| response.get("path")).and_then(toml::Value::as_str);
    if asked && path == Some("up-and-down") {
        complaints.push(
            Complaint::new("one curve was measured, and the response has two, up and down")
                .at(&parts.root.locate(&["response", "path"]), "which of both was measured?")
                .hint("path = \"up\", or \"down\""),
        );
    }
}

fn is_typed(parts: &Parts<'_>, index: &str, key: &str) -> bool {
    parts.root.find(&["claim", index, key]).is_some()
}

/// The response varies the frequency of the host's sine; without one it would have nothing to turn.
fn response(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    let told = |key: &str| parts.resolved.get("response").and_then(|response| response.get(key));
    if told("path").and_then(toml::Value::as_str).is_some_and(|path| path != "apart") && told("peak-within").is_some() {
        complaints.push(
            Complaint::new("a response that goes from one frequency to the next adds none between them")
                .at(&parts.root.locate(&["response", "peak-within"]), "only with `path = \"apart\"`")
                .hint("leave it out, and give a `step` that is short enough"),
        );
    }
    let Some(name) =
        parts.resolved.get("response").and_then(|response| response.get("host")).and_then(toml::Value::as_str)
    else {
        return;
    };
    let Some(host) = parts.hosts.get(name) else { return };
    let sines =
        [&host.base, &host.force].into_iter().filter(|signal| matches!(signal, Some(Signal::Sine { .. }))).count();
    let place = parts.root.locate(&["hosts", name]);
    let asked = parts.root.locate(&["response"]);
    match sines {
        1 => {}
        0 => complaints.push(
            Complaint::new(format!("nothing shakes the host `{name}` with a sine, so it has no frequency response"))
                .at(&place, "needs `base.sine` or `force.sine`")
                .also(&asked, "asked for here")
                .hint("base.sine = { amplitude = \"0.5 mm\", frequency = \"6 Hz\" }"),
        ),
        _ => complaints.push(
            Complaint::new(format!("both the base and the force of the host `{name}` are sines"))
                .at(&place, "which of the two has its frequency varied?")
                .also(&asked, "asked for here")
                .hint("leave one of them out"),
        ),
    }
}
