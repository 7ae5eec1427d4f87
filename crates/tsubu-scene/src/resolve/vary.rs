//! What a study varies: keys with lists of values, or with ranges.

use super::Resolver;
use crate::complaint::Complaint;
use crate::keys::Key;
use crate::node::{Node, Value};
use crate::range;

/// What a range looks like.
const RANGE: &str =
    "for example \"walls.box.shape.box.height\" = { from = \"60 mm\", to = \"120 mm\", step = \"10 mm\" }";

impl Resolver<'_> {
    /// Only the form is checked here; whether the scene takes the values is tried once the scene itself is right.
    pub(super) fn vary(&mut self, key: &'static Key, node: &Node) -> Option<toml::Value> {
        let mut varied = toml::Table::new();
        for entry in &self.expect_table(key, node)?.entries {
            let plain = || entry.node.plain();
            let complaint = match &entry.node.value {
                Value::Table(range) if range.entry("from").is_some() || range.entry("to").is_some() => {
                    match plain().as_ref().and_then(toml::Value::as_table).map(range::listed) {
                        Some(Ok(values)) => {
                            varied.insert(entry.key.clone(), values.into());
                            continue;
                        }
                        wrong => Complaint::new(format!("`{}` cannot be varied so", entry.key))
                            .at(&entry.node.place, wrong.and_then(Result::err).unwrap_or_default())
                            .hint(RANGE),
                    }
                }
                Value::List(items) if !items.is_empty() => {
                    if let Some(list) = plain() {
                        if let Some(value) = twice(&list) {
                            self.complain(
                                Complaint::new(format!("`{}` is varied with {value} twice", entry.key))
                                    .at(&entry.node.place, "each value is a case of its own"),
                            );
                        }
                        varied.insert(entry.key.clone(), list);
                        continue;
                    }
                    Complaint::new("a date is no value of any key")
                        .at(&entry.node.place, "there is a date in this list")
                }
                Value::List(_) => {
                    Complaint::new(format!("no values for `{}`", entry.key)).at(&entry.node.place, "the list is empty")
                }
                Value::Table(_) => Complaint::new("a varied key must be in quotes")
                    .at(&entry.place, "without quotes the points make tables")
                    .hint("for example \"particles.balls.count\" = [10, 30, 50]"),
                _ => Complaint::new(format!("`{}` needs a list of values", entry.key))
                    .at(&entry.node.place, format!("this is {}", entry.node.kind()))
                    .hint("for example \"particles.balls.count\" = [10, 30, 50]"),
            };
            self.complain(complaint);
        }
        Some(varied.into())
    }
}

/// A value that is in a list twice.
fn twice(list: &toml::Value) -> Option<&toml::Value> {
    let list = list.as_array()?;
    (1..list.len())
        .map(|k| (&list[k], &list[..k]))
        .find(|(value, before)| before.contains(value))
        .map(|(value, _)| value)
}
