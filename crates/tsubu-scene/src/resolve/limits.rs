//! What follows from other values is held to the table of keys as if it had been typed.
//!
//! A mass that follows from a density and a tiny diameter, or an interval that follows from a tiny duration, may be a number
//! that nothing can have. Then the resolved scene, in a run folder, would be refused.

use super::{Read, resolve};
use crate::complaint::{Complaint, Place};
use crate::node::{Entry, Node, Table, Value};
use std::collections::BTreeMap;

/// Complaints about values of the resolved tree that could not be typed.
pub(crate) fn limits(resolved: &toml::Table, root: &Node) -> Vec<Complaint> {
    let tree = Node { value: table(resolved, Some(root), &root.place), place: root.place.clone() };
    let complaints = resolve(&tree, Read::Numbers).1.into_iter();
    let hint = "nobody typed it: it follows from other values, and from defaults";
    let told = complaints.map(|complaint| complaint.hint(hint));
    let placed = |complaint: Complaint| {
        let nowhere = complaint.place() == Some(&root.place);
        if nowhere { complaint.nowhere() } else { complaint }
    };
    told.map(placed).collect()
}

/// A resolved value as a node, at the place of what was typed there, or of what it is in.
fn node(value: &toml::Value, typed: Option<&Node>, around: &Place) -> Node {
    let place = typed.map_or(around, |typed| &typed.place);
    let value = match value {
        toml::Value::String(text) => Value::Text(text.clone()),
        toml::Value::Integer(whole) => Value::Whole(*whole),
        toml::Value::Float(number) => Value::Number(*number),
        toml::Value::Boolean(flag) => Value::Flag(*flag),
        toml::Value::Datetime(_) => Value::Date,
        toml::Value::Array(items) => {
            let typed = match typed.map(|typed| &typed.value) {
                Some(Value::List(list)) => list.as_slice(),
                _ => &[],
            };
            Value::List(items.iter().enumerate().map(|(k, item)| node(item, typed.get(k), place)).collect())
        }
        toml::Value::Table(inner) => table(inner, typed, place),
    };
    Node { value, place: place.clone() }
}

fn table(resolved: &toml::Table, typed: Option<&Node>, around: &Place) -> Value {
    let typed: BTreeMap<&str, &Entry> = typed
        .and_then(Node::table)
        .map(|table| table.entries.iter().map(|entry| (entry.key.as_str(), entry)).collect())
        .unwrap_or_default();
    let entry = |(key, value): (&String, &toml::Value)| {
        let typed = typed.get(key.as_str());
        let place = typed.map_or(around, |entry| &entry.place).clone();
        Entry { key: key.clone(), node: node(value, typed.map(|entry| &entry.node), &place), place }
    };
    Value::Table(Table { entries: resolved.iter().map(entry).collect() })
}
