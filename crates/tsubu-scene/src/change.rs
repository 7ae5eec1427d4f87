//! Changes to a scene from outside: `--set key.path=value`, and the values that a sweep or response varies.
//!
//! A change is made on the typed tree, before anything is checked, so that it is checked like the file itself. It
//! knows the registry for two reasons: choosing a variant (`contact.damping.quarter={}`) must take the place of the
//! one in the file, and a misspelt path must not silently add a table.

use crate::complaint::{Complaint, Place};
use crate::keys::{self, Key, Kind, Variant};
use crate::node::{self, Entry, Node, Table, Value};
use crate::resolve::unknown_key;
use crate::suggest;

/// One step of a path, with its place in the text of the change.
pub(crate) struct Step {
    pub name: String,
    pub place: Place,
}

/// Applies `text` (`key.path=value`, found at index `source` of the sources) to the tree.
pub(crate) fn apply(root: &mut Node, text: &str, source: usize) -> Result<(), Complaint> {
    let whole = Place::new(source, 0..text.len());
    let Some(split) = find_equals(text) else {
        return Err(Complaint::new(format!("`{text}` sets nothing"))
            .at(&whole, "no `=`")
            .hint("write key.path=value, for example particles.balls.count=30"));
    };
    let steps = steps(&text[..split], source).ok_or_else(|| {
        Complaint::new("an empty key in the path").at(&Place::new(source, 0..split), "not a path of keys")
    })?;
    let value = value(&text[split + 1..], source, split + 1)?;
    match &mut root.value {
        Value::Table(table) => put(table, keys::SCENE, "", &steps, value),
        _ => Ok(()),
    }
}

/// The first `=` outside quotes: user-chosen names may hold anything.
fn find_equals(text: &str) -> Option<usize> {
    let mut quoted = false;
    text.char_indices().find_map(|(at, c)| {
        quoted ^= c == '"';
        (c == '=' && !quoted).then_some(at)
    })
}

/// The steps of a path that stands at the begin of its source.
pub(crate) fn steps(path: &str, source: usize) -> Option<Vec<Step>> {
    let mut steps = Vec::new();
    let mut start = 0;
    let mut quoted = false;
    for (at, c) in path.char_indices().chain([(path.len(), '.')]) {
        quoted ^= c == '"';
        // The end of the text closes the last step whatever the quotes say.
        if c == '.' && (!quoted || at == path.len()) {
            let name = path[start..at].trim();
            let begin = start + path[start..at].find(name).unwrap_or(0);
            let place = Place::new(source, begin..begin + name.len());
            let name = name.strip_prefix('"').and_then(|inner| inner.strip_suffix('"')).unwrap_or(name);
            if name.is_empty() {
                return None;
            }
            steps.push(Step { name: name.to_string(), place });
            start = at + 1;
        }
    }
    Some(steps)
}

/// A TOML value, or else bare text: nobody wants to write `'diameter="5 mm"'` for a shell.
fn value(text: &str, source: usize, offset: usize) -> Result<Node, Complaint> {
    let trimmed = text.trim();
    let offset = offset + text.find(trimmed).unwrap_or(0);
    let place = Place::new(source, offset..offset + trimmed.len());
    if trimmed.is_empty() {
        return Err(Complaint::new("no value after `=`").at(&place, "a value is needed here"));
    }
    match node::parse_value(trimmed, source, offset) {
        Ok(node) => Ok(node),
        // What begins like a list, table or quoted text was meant as one.
        Err(complaint) if trimmed.starts_with(['[', '{', '"', '\'']) => Err(complaint),
        Err(_) => Ok(Node { value: Value::Text(trimmed.to_string()), place }),
    }
}

pub(crate) fn put(
    table: &mut Table,
    keys: &'static [Key],
    path: &str,
    steps: &[Step],
    value: Node,
) -> Result<(), Complaint> {
    let [step, rest @ ..] = steps else { return Ok(()) };
    let Some(key) = keys::find(keys, &step.name) else {
        return Err(unknown_key(&step.name, &step.place, keys, path));
    };
    table.entries.retain(|entry| entry.key == key.name || !key.rivals.contains(&entry.key.as_str()));
    if rest.is_empty() {
        table.set(Entry { key: step.name.clone(), place: step.place.clone(), node: value });
        return Ok(());
    }
    let here = join(path, &step.name);
    match key.kind {
        Kind::Table(inner) => put(child(table, step)?, inner, &here, rest, value),
        Kind::Named(inner, _) => put_named(child(table, step)?, inner, &here, rest, value),
        Kind::Many(inner) => put_in_list(table, inner, step, &here, rest, value),
        Kind::Choice(variants) => put_choice(child(table, step)?, variants, &here, rest, value),
        Kind::NamedChoice(variants, _) => {
            let named = child(table, step)?;
            let [step, rest @ ..] = rest else { return Ok(()) };
            if rest.is_empty() {
                named.set(Entry { key: step.name.clone(), place: step.place.clone(), node: value });
                return Ok(());
            }
            if named.entry(&step.name).is_none() {
                let names: Vec<&str> = named.keys().collect();
                return Err(unknown_word(step, &here, names.into_iter()));
            }
            put_choice(child(named, step)?, variants, &join(&here, &step.name), rest, value)
        }
        Kind::Vary | Kind::Set => {
            let names: Vec<&str> = rest.iter().map(|step| step.name.as_str()).collect();
            let entry = Entry { key: names.join("."), place: rest[0].place.clone(), node: value };
            child(table, step)?.set(entry);
            Ok(())
        }
        _ => Err(Complaint::new(format!("`{here}` has no keys of its own")).at(&rest[0].place, "this leads nowhere")),
    }
}

/// The variant named first takes the place of the one that was chosen.
fn put_choice(
    chosen: &mut Table,
    variants: &'static [Variant],
    path: &str,
    steps: &[Step],
    value: Node,
) -> Result<(), Complaint> {
    let [step, rest @ ..] = steps else { return Ok(()) };
    let Some(variant) = variants.iter().find(|variant| variant.name == step.name) else {
        return Err(unknown_word(step, path, variants.iter().map(|variant| variant.name)));
    };
    chosen.entries.retain(|entry| entry.key == variant.name);
    if rest.is_empty() {
        chosen.set(Entry { key: variant.name.to_string(), place: step.place.clone(), node: value });
        return Ok(());
    }
    put(child(chosen, step)?, variant.keys, &join(path, variant.name), rest, value)
}

fn put_named(
    table: &mut Table,
    keys: &'static [Key],
    path: &str,
    steps: &[Step],
    value: Node,
) -> Result<(), Complaint> {
    let [step, rest @ ..] = steps else { return Ok(()) };
    if rest.is_empty() {
        table.set(Entry { key: step.name.clone(), place: step.place.clone(), node: value });
        return Ok(());
    }
    if table.entry(&step.name).is_none() {
        let names: Vec<&str> = table.keys().collect();
        return Err(unknown_word(step, path, names.into_iter()));
    }
    put(child(table, step)?, keys, &join(path, &step.name), rest, value)
}

fn put_in_list(
    table: &mut Table,
    keys: &'static [Key],
    key: &Step,
    path: &str,
    steps: &[Step],
    value: Node,
) -> Result<(), Complaint> {
    let list = match table.entries.iter_mut().find(|entry| entry.key == key.name).map(|entry| &mut entry.node.value) {
        Some(Value::List(list)) => list.as_mut_slice(),
        _ => &mut [],
    };
    let count = list.len();
    let [step, rest @ ..] = steps else { return Ok(()) };
    let item = step.name.parse::<usize>().ok().and_then(|index| list.get_mut(index));
    match item.map(|item| &mut item.value) {
        Some(Value::Table(inner)) if !rest.is_empty() => put(inner, keys, &join(path, &step.name), rest, value),
        _ => Err(Complaint::new(format!("`{path}` has no entry `{}` that can be set", step.name))
            .at(&step.place, format!("there are {count}, counted from 0"))
            .hint(format!("for example {path}.0.KEY=VALUE"))),
    }
}

/// The table under a step, made if it is not there.
fn child<'a>(table: &'a mut Table, step: &Step) -> Result<&'a mut Table, Complaint> {
    let known = table.entries.iter().position(|entry| entry.key == step.name);
    let at = known.unwrap_or_else(|| {
        let node = Node { value: Value::Table(Table::default()), place: step.place.clone() };
        table.entries.push(Entry { key: step.name.clone(), place: step.place.clone(), node });
        table.entries.len() - 1
    });
    match &mut table.entries[at].node.value {
        Value::Table(inner) => Ok(inner),
        _ => Err(Complaint::new(format!("`{}` is not a table in the scene", step.name))
            .at(&step.place, "so nothing inside it can be set")),
    }
}

fn unknown_word<'a>(step: &Step, path: &str, names: impl Iterator<Item = &'a str> + Clone) -> Complaint {
    let mut complaint = Complaint::new(format!("there is no `{}` in [{path}]", step.name)).at(&step.place, "not there");
    if let Some(near) = suggest::nearest(&step.name, names.clone()) {
        complaint = complaint.hint(format!("did you mean `{near}`?"));
    }
    let known = suggest::list(names);
    complaint.hint(if known.is_empty() {
        "there are none in this scene".to_string()
    } else {
        format!("known here: {known}")
    })
}

fn join(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_string() } else { format!("{path}.{name}") }
}
