//! From what was typed to what it means: SI numbers, every default written out.
//!
//! The tree is walked along the registry. A wrong value is complained about and left out, so that the rest can still
//! be checked; the result is complete only when there are no complaints.

mod beam;
mod derive;
mod limits;
mod matrices;
mod modal_table;
mod several;
mod spectrum;
mod table;
mod value;
mod vary;
mod vector;

pub(crate) use derive::derive;
pub(crate) use limits::limits;

use crate::complaint::{Complaint, Place};
use crate::keys::{self, Family, Key, Kind, Need, Variant};
use crate::node::{self, Entry, Node, Table, Value};
use crate::suggest;

/// A file of results is called after a name, and file systems end at 255 bytes.
const LONGEST_NAME: usize = 120;

/// What of a tree is complained about.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Read {
    /// Everything.
    All,
    /// Not what is missing: after syntax errors half of the file may be, and saying so for every key would bury the cause.
    Broken,
    /// Values alone: a resolved tree has copies that no key says, and lacks what it does without.
    Numbers,
}

/// Walks the typed tree along the registry.
pub(crate) struct Resolver<'a> {
    root: &'a Node,
    /// `None`: the dimension itself is wrong, so vectors of either length are let through.
    dimension: Option<u8>,
    read: Read,
    complaints: Vec<Complaint>,
}

/// The resolved tree and what was wrong on the way.
pub(crate) fn resolve(root: &Node, read: Read) -> (toml::Table, Vec<Complaint>) {
    let empty = Table::default();
    let top = root.table().unwrap_or(&empty);
    let dimension = match top.get("dimension").map(|node| &node.value) {
        None => Some(2),
        Some(Value::Whole(n @ (2 | 3))) => u8::try_from(*n).ok(),
        _ => None,
    };
    let mut resolver = Resolver { root, dimension, read, complaints: Vec::new() };
    let resolved = resolver.table(keys::SCENE, top, &root.place, "");
    (resolved, resolver.complaints)
}

impl Resolver<'_> {
    fn complain(&mut self, complaint: Complaint) {
        self.complaints.push(complaint);
    }

    fn table(&mut self, keys: &'static [Key], typed: &Table, place: &Place, path: &str) -> toml::Table {
        let mut misspelt = Vec::new();
        for entry in &typed.entries {
            if self.read != Read::Numbers && keys::find(keys, &entry.key).is_none() {
                misspelt.extend(suggest::nearest(&entry.key, keys.iter().map(|key| key.name)));
                self.complain(unknown_key(&entry.key, &entry.place, keys, path));
            }
        }
        let mut resolved = toml::Table::new();
        let mut missing = Vec::new();
        for (index, key) in keys.iter().enumerate() {
            let value = if let Some(entry) = typed.entry(key.name) {
                for rival in keys[..index].iter().filter(|other| key.rivals.contains(&other.name)) {
                    if let Some(other) = typed.entry(rival.name) {
                        self.complain(
                            Complaint::new(format!("`{}` and `{}` exclude each other", rival.name, key.name))
                                .at(&entry.place, format!("`{}` is given", key.name))
                                .also(&other.place, format!("`{}` is given too", rival.name))
                                .hint("keep one of the two"),
                        );
                    }
                }
                self.value(key, &entry.node, &entry.place, path)
            } else {
                match key.need {
                    Need::Default(text) => self.default(key, text, path),
                    Need::Required => {
                        // One slip, one complaint: a misspelt key is there in spirit.
                        if !misspelt.contains(&key.name) {
                            missing.push(key);
                        }
                        None
                    }
                    Need::Optional | Need::Word(_) | Need::Derived(_) | Need::DerivedOrWord(..) => None,
                }
            };
            if let Some(value) = value {
                resolved.insert(key.name.to_string(), value);
            }
        }
        if !missing.is_empty() && self.read == Read::All {
            self.complain(missing_keys(&missing, place, path));
        }
        resolved
    }

    /// A default is read as if it had been typed.
    fn default(&mut self, key: &'static Key, text: &str, path: &str) -> Option<toml::Value> {
        let node = node::parse_value(text, 0, 0).ok()?;
        let place = node.place.clone();
        self.value(key, &node, &place, path)
    }

    fn value(&mut self, key: &'static Key, node: &Node, key_place: &Place, path: &str) -> Option<toml::Value> {
        let here = join(path, key.name);
        match key.kind {
            Kind::Table(keys) => {
                let typed = self.expect_table(key, node)?;
                Some(self.table(keys, typed, key_place, &here).into())
            }
            Kind::Named(keys, _) => {
                let mut named = toml::Table::new();
                for entry in &self.expect_table(key, node)?.entries {
                    let path = join(&here, &entry.key);
                    self.name_is_short(entry);
                    let Some(typed) = entry.node.table() else {
                        self.complain(
                            Complaint::new(format!("[{path}] needs a table, not {}", entry.node.kind()))
                                .at(&entry.node.place, format!("this is {}", entry.node.kind()))
                                .hint(format!(
                                    "keys of [{here}.NAME]: {}",
                                    suggest::list(keys.iter().map(|key| key.name))
                                )),
                        );
                        continue;
                    };
                    named.insert(entry.key.clone(), self.table(keys, typed, &entry.place, &path).into());
                }
                Some(named.into())
            }
            Kind::Many(keys) => self.many(key, keys, node, key_place, &here),
            Kind::NamedChoice(variants, _) => {
                let mut named = toml::Table::new();
                for entry in &self.expect_table(key, node)?.entries {
                    let path = join(&here, &entry.key);
                    self.name_is_short(entry);
                    if let Some(value) = self.choice(&entry.key, variants, &entry.node, &entry.place, &path) {
                        named.insert(entry.key.clone(), value);
                    }
                }
                Some(named.into())
            }
            Kind::Choice(variants) => self.choice(key.name, variants, node, key_place, &here),
            _ => self.leaf(key, node),
        }
    }

    fn many(
        &mut self,
        key: &'static Key,
        keys: &'static [Key],
        node: &Node,
        key_place: &Place,
        here: &str,
    ) -> Option<toml::Value> {
        let Value::List(items) = &node.value else {
            self.complain(
                Complaint::new(format!("`{}` needs a list of tables, not {}", key.name, node.kind()))
                    .at(key_place, format!("this is {}", node.kind()))
                    .hint(format!("begin each with [[{here}]] on a line of its own")),
            );
            return None;
        };
        let mut list = Vec::new();
        for item in items {
            let Some(typed) = item.table() else {
                self.complain(
                    Complaint::new(format!("an entry of `{}` must be a table, not {}", key.name, item.kind()))
                        .at(&item.place, format!("this is {}", item.kind())),
                );
                continue;
            };
            list.push(self.table(keys, typed, &item.place, here).into());
        }
        Some(toml::Value::Array(list))
    }

    fn choice(
        &mut self,
        name: &str,
        variants: &'static [Variant],
        node: &Node,
        key_place: &Place,
        here: &str,
    ) -> Option<toml::Value> {
        let names = || variants.iter().map(|variant| variant.name);
        let choices = format!("choices: {}", suggest::list(names()));
        let Some(typed) = node.table() else {
            let mut complaint = Complaint::new(format!("`{}` needs one of its tables, not {}", name, node.kind()))
                .at(&node.place, format!("this is {}", node.kind()));
            if let Value::Text(text) = &node.value
                && let Some(near) = suggest::nearest(text, names())
            {
                complaint = complaint.hint(format!("write {name}.{near} = {{}}"));
            }
            self.complain(complaint.hint(choices));
            return None;
        };
        for entry in &typed.entries {
            if !names().any(|name| name == entry.key) {
                let mut complaint = Complaint::new(format!("unknown choice `{}` for `{}`", entry.key, name))
                    .at(&entry.place, "not one of the choices");
                if let Some(near) = suggest::nearest(&entry.key, names()) {
                    complaint = complaint.hint(format!("did you mean `{near}`?"));
                }
                self.complain(complaint.hint(choices.clone()));
                return None;
            }
        }
        match typed.entries.as_slice() {
            [entry] => {
                let variant = variants.iter().find(|variant| variant.name == entry.key)?;
                let Some(inner) = entry.node.table() else {
                    self.complain(
                        Complaint::new(format!("[{here}.{}] needs a table, not {}", variant.name, entry.node.kind()))
                            .at(&entry.node.place, format!("this is {}", entry.node.kind()))
                            .hint(match variant.keys {
                                [] => format!("write {}.{} = {{}}", name, variant.name),
                                keys => format!("its keys: {}", suggest::list(keys.iter().map(|key| key.name))),
                            }),
                    );
                    return None;
                };
                let resolved = self.table(variant.keys, inner, &entry.place, &join(here, variant.name));
                Some(toml::Table::from_iter([(variant.name.to_string(), resolved.into())]).into())
            }
            [] => {
                self.complain(
                    Complaint::new(format!("nothing is chosen for `{name}`")).at(key_place, "empty").hint(choices),
                );
                None
            }
            [first, second, ..] => {
                self.complain(
                    Complaint::new(format!("`{name}` is chosen twice: only one of its tables can be given"))
                        .at(&second.place, "and here")
                        .also(&first.place, "chosen here")
                        .hint(format!("keep `{}` or `{}`", first.key, second.key)),
                );
                None
            }
        }
    }

    /// Names stand in the names of files and in every line of a table.
    fn name_is_short(&mut self, entry: &Entry) {
        if entry.key.len() > LONGEST_NAME {
            self.complain(
                Complaint::new(format!("the name `{}` is too long", entry.key))
                    .at(&entry.place, format!("{} bytes", entry.key.len()))
                    .hint(format!("names have at most {LONGEST_NAME} bytes")),
            );
        }
    }

    fn expect_table<'n>(&mut self, key: &Key, node: &'n Node) -> Option<&'n Table> {
        let table = node.table();
        if table.is_none() {
            self.complain(
                Complaint::new(format!("`{}` needs a table, not {}", key.name, node.kind()))
                    .at(&node.place, format!("this is {}", node.kind())),
            );
        }
        table
    }

    /// The names that are defined in the scene, whether their tables are right or not.
    fn names(&self, family: Family) -> Vec<&str> {
        let table = self.root.table().and_then(|top| top.get(family.table())).and_then(Node::table);
        table.map(|table| table.keys().collect()).unwrap_or_default()
    }
}

/// The complaint about a key that is not in its table.
pub(crate) fn unknown_key(name: &str, place: &Place, keys: &'static [Key], path: &str) -> Complaint {
    let table = if path.is_empty() { "at the top of the scene".to_string() } else { format!("in [{path}]") };
    let complaint = Complaint::new(format!("unknown key `{name}` {table}")).at(place, "not a key here");
    let known = keys.iter().map(|key| key.name);
    let homes = keys::homes(name);
    let complaint = match suggest::nearest(name, known.clone()) {
        // What is right elsewhere is hardly misspelt.
        _ if !homes.is_empty() => {
            complaint.hint(format!("`{name}` belongs in {}", homes[..homes.len().min(4)].join(" or ")))
        }
        Some(near) => complaint.hint(format!("did you mean `{near}`?")),
        None => complaint,
    };
    if keys.is_empty() {
        return complaint.hint("this table has no keys: write {}");
    }
    complaint.hint(format!("keys here: {}", suggest::list(known)))
}

fn missing_keys(missing: &[&'static Key], place: &Place, path: &str) -> Complaint {
    let names = suggest::list(missing.iter().map(|key| key.name));
    let table = if path.is_empty() { "at the top of the scene".to_string() } else { format!("in [{path}]") };
    let plural = if missing.len() == 1 { "" } else { "s" };
    Complaint::new(format!("missing key{plural} {names} {table}"))
        .at(place, format!("needs {names}"))
        .hints(missing.iter().map(|key| explain(key)))
}

/// A key in one line: what it is and what could be typed.
fn explain(key: &Key) -> String {
    let example = match key.kind {
        Kind::Quantity(dimension) => format!(", for example {}", dimension.examples_text()),
        Kind::Choice(variants) => format!("; one of {}", suggest::list(variants.iter().map(|variant| variant.name))),
        Kind::OneOf(words) => format!("; one of {}", suggest::list(words.iter().map(|word| word.name))),
        Kind::Name(family) => format!(", one of those in [{}]", family.table()),
        Kind::Names(family) => format!(", some of those in [{}]", family.table()),
        Kind::SomeOf(words) => format!("; some of {}", suggest::list(words.iter().map(|word| word.name))),
        _ => String::new(),
    };
    format!("`{}`: {}{example}", key.name, key.about)
}

fn join(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_string() } else { format!("{path}.{name}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_default_is_a_value_that_could_be_typed() {
        let root = Node { value: Value::Table(Table::default()), place: Place::new(0, 0..0) };
        keys::walk(&mut |path, keys| {
            for key in keys {
                let Need::Default(text) = key.need else { continue };
                let mut resolver =
                    Resolver { root: &root, dimension: Some(2), read: Read::All, complaints: Vec::new() };
                assert!(resolver.default(key, text, path).is_some(), "{path}.{}: {text}", key.name);
                assert!(resolver.complaints.is_empty(), "{path}.{}: {:?}", key.name, resolver.complaints);
            }
        });
    }
}
