//! Lists of words, of names and of whole numbers: at least one entry, each once.

use super::Resolver;
use crate::complaint::Complaint;
use crate::keys::{Key, Kind, Need};
use crate::node::{Node, Value};

impl Resolver<'_> {
    /// A list whose entries are what the kind says.
    pub(super) fn several(&mut self, key: &Key, node: &Node) -> Option<toml::Value> {
        let needs = match key.kind {
            Kind::Wholes => "a list of whole numbers",
            _ => "a list of names in quotes",
        };
        let list = self.list(key, node, needs, |me, item| match key.kind {
            Kind::Wholes => me.whole(key, item),
            Kind::SomeOf(words) => me.one_of(key, words, item),
            Kind::Names(family) => me.name(key, family, item),
            _ => None,
        })?;
        let (Value::List(nodes), Some(values)) = (&node.value, list.as_array()) else { return None };
        // Where nothing is the default, nothing can be asked for.
        if values.is_empty() && !matches!(key.need, Need::Default("[]")) {
            self.complain(
                Complaint::new(format!("`{}` is an empty list", key.name)).at(&node.place, "nothing is asked for"),
            );
            return None;
        }
        // Two equal numbers of points along two axes are no mistake.
        let again = (0..values.len()).find(|&k| values[..k].contains(&values[k]));
        if let (Some(again), false) = (again, matches!(key.kind, Kind::Wholes)) {
            self.complain(
                Complaint::new(format!("`{}` has {} twice", key.name, values[again]))
                    .at(&nodes[again].place, "given again"),
            );
            return None;
        }
        Some(list)
    }
}
