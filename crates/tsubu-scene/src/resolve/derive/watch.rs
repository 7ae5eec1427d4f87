//! Watches: when they look, where, and at whom, if nobody says.

use super::{Derive, groups_by_name, hosts, table_at, tables_in};
use crate::complaint::Complaint;
use crate::key::{self, Kind, Need};
use crate::plan::Measure;
use crate::suggest;
use toml::Value;

impl Derive<'_> {
    pub(super) fn watches(&mut self, resolved: &mut toml::Table) {
        let interval = table_at(resolved, "output").and_then(|output| output.get("history-interval")).cloned();
        let groups: Vec<String> = groups_by_name(resolved).into_iter().map(|(name, _)| name.clone()).collect();
        let inside = inside_of_the_box(resolved);
        let walls = table_at(resolved, "walls").cloned().unwrap_or_default();
        let hosts = hosts(resolved);
        for (name, watch) in tables_in(resolved, "watch") {
            // Of hops the contact is to be seen, which is a few steps long; of spectra the fastest vibration.
            if !["hops", "spectrum"].iter().any(|kind| watch.contains_key(*kind))
                && let Some(interval) = interval.clone()
                && !self.typed(&["watch", &name, "every"])
            {
                watch.entry("every").or_insert(interval);
            }
            for kind in in_a_region() {
                if let Some(measure) = watch.get_mut(kind).and_then(Value::as_table_mut) {
                    self.region(measure, &["watch", &name, kind], inside.as_ref());
                }
            }
            if let Some(slope) = watch.get_mut("slope").and_then(Value::as_table_mut) {
                centre(slope);
            }
            if let Some(bedload) = watch.get_mut("bedload").and_then(Value::as_table_mut)
                && let Some(speed) = bedload.get("moving-speed").and_then(Value::as_float)
                && !self.typed(&["watch", &name, "bedload", "resting-speed"])
            {
                bedload.entry("resting-speed").or_insert(Value::Float(0.5 * speed));
            }
            if let Some(segregation) = watch.get_mut("segregation").and_then(Value::as_table_mut) {
                self.groups(segregation, &["watch", &name, "segregation"], &groups);
            }
            for kind in ["spectrum", "resonance"] {
                let Some(measure) = watch.get_mut(kind).and_then(Value::as_table_mut) else { continue };
                let needs = format!("a {kind} is of a host");
                self.only_host(
                    measure,
                    &hosts,
                    &["watch", &name, kind],
                    &needs,
                    "add [hosts.NAME], or leave the watch out",
                );
            }
            if let Some(load) = watch.get_mut("wall-load").and_then(Value::as_table_mut)
                && load.contains_key("area")
            {
                self.direction(load, &["watch", &name, "wall-load"], &walls);
            }
        }
    }

    fn region(&mut self, measure: &mut toml::Table, path: &[&str], inside: Option<&Value>) {
        if measure.contains_key("region") || self.typed(&[path, &["region"]].concat()) {
            return;
        }
        if let Some(inside) = inside {
            measure.insert("region".into(), inside.clone());
            return;
        }
        let place = self.root.locate(path);
        self.complain(
            Complaint::new(format!("missing key `region` in [{}]", path.join(".")))
                .at(&place, "needs `region`: only the inside of a single box is known without")
                .hint("region = { low = [\"-30 mm\", 0], high = [\"30 mm\", \"96 mm\"] }, three entries each in space"),
        );
    }

    fn groups(&mut self, segregation: &mut toml::Table, path: &[&str], groups: &[String]) {
        let at = [path, &["groups"]].concat();
        let given = segregation.get("groups").and_then(Value::as_array).map(Vec::len);
        match (given, groups) {
            (Some(2), _) => {}
            (Some(count), _) => {
                let place = self.root.locate(&at);
                self.complain(
                    Complaint::new("segregation is between two groups").at(&place, format!("{count} in this list")),
                );
            }
            (None, [first, second]) if !self.typed(&at) => {
                let names = [first, second].map(|name| Value::String(name.clone()));
                segregation.insert("groups".into(), Value::Array(names.to_vec()));
            }
            (None, _) if !self.typed(&at) => {
                let place = self.root.locate(path);
                let known = suggest::list(groups.iter().map(String::as_str));
                self.complain(
                    Complaint::new(format!("missing key `groups` in [{}]", path.join(".")))
                        .at(&place, "needs the two `groups`")
                        .hint(format!("groups here: {known}")),
                );
            }
            (None, _) => {}
        }
    }

    /// A plane is pressed against its normal.
    fn direction(&mut self, load: &mut toml::Table, path: &[&str], walls: &toml::Table) {
        if load.contains_key("direction") || self.typed(&[path, &["direction"]].concat()) {
            return;
        }
        let wall = load.get("wall").and_then(Value::as_str).and_then(|name| walls.get(name));
        let Some(shape) = wall.and_then(|wall| wall.get("shape")).and_then(Value::as_table) else { return };
        let normal = shape.get("plane").and_then(|plane| plane.get("normal")).and_then(Value::as_array);
        if let Some(normal) = normal {
            // Not -n: that would make negative zeros.
            let against = normal.iter().filter_map(Value::as_float).map(|n| Value::Float(0.0 - n));
            load.insert("direction".into(), Value::Array(against.collect()));
        } else {
            let place = self.root.locate(path);
            self.complain(
                Complaint::new("the direction of the pressure is not known")
                    .at(&place, "needs `direction`: only that of a plane is known without")
                    .hint("direction = \"-z\" for the floor of a box"),
            );
        }
    }
}

/// Watches that need a region, and have that of the box if nobody says.
fn in_a_region() -> impl Iterator<Item = &'static str> {
    let derived = |keys| key::find(keys, "region").is_some_and(|region| matches!(region.need, Need::Derived(_)));
    let needed = Measure::KEYS.iter().filter(move |kind| matches!(kind.kind, Kind::Table(keys) if derived(keys)));
    needed.map(|kind| kind.name)
}

/// The region that a single box encloses as drawn.
fn inside_of_the_box(resolved: &toml::Table) -> Option<Value> {
    let walls = table_at(resolved, "walls")?.values();
    let mut boxes = walls.filter_map(|wall| wall.get("shape")?.get("box"));
    let (shape, None) = (boxes.next()?, boxes.next()) else { return None };
    let number = |key: &str| shape.get(key).and_then(Value::as_float);
    let (width, depth, height) = (number("width")?, number("depth")?, number("height")?);
    let centre: Vec<f64> = shape.get("floor-centre")?.as_array()?.iter().filter_map(Value::as_float).collect();
    let &[x, y, z] = centre.as_slice() else { return None };
    let flat = resolved.get("dimension").and_then(Value::as_integer) != Some(3);
    let depth = if flat { 0.0 } else { depth };
    let corner =
        |share: f64, z: f64| Value::Array([x + share * width, y + share * depth, z].map(Value::Float).to_vec());
    let ends = [("low".to_string(), corner(-0.5, z)), ("high".to_string(), corner(0.5, z + height))];
    Some(Value::Table(ends.into_iter().collect()))
}

fn centre(slope: &mut toml::Table) {
    let axis = usize::from(slope.get("axis").and_then(Value::as_str) == Some("y"));
    let end = |corner: &str| slope.get("region")?.get(corner)?.get(axis)?.as_float();
    if let (Some(low), Some(high)) = (end("low"), end("high")) {
        slope.entry("centre").or_insert(Value::Float(0.5 * (low + high)));
    }
}
