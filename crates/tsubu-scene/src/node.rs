//! The typed text as a tree in which every key and value knows its place.

use crate::complaint::{Complaint, Place};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A value with its place.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub value: Value,
    pub place: Place,
}

/// What can be typed as a value.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    Text(String),
    Whole(i64),
    Number(f64),
    Flag(bool),
    /// No key of a scene takes a date; kept to be complained about.
    Date,
    List(Vec<Node>),
    Table(Table),
}

/// Entries in the order they were typed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Table {
    pub entries: Vec<Entry>,
}

/// A key, where it stands, and its value.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub key: String,
    pub place: Place,
    pub node: Node,
}

impl Table {
    pub fn entry(&self, key: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.key == key)
    }

    pub fn get(&self, key: &str) -> Option<&Node> {
        self.entry(key).map(|entry| &entry.node)
    }

    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().map(|entry| entry.key.as_str())
    }

    /// Sets an entry, replacing an old one in its position.
    pub fn set(&mut self, entry: Entry) {
        match self.entries.iter_mut().find(|old| old.key == entry.key) {
            Some(old) => *old = entry,
            None => self.entries.push(entry),
        }
    }
}

impl Node {
    pub fn table(&self) -> Option<&Table> {
        match &self.value {
            Value::Table(table) => Some(table),
            _ => None,
        }
    }

    /// What a user would call it.
    pub fn kind(&self) -> &'static str {
        match &self.value {
            Value::Text(_) => "text",
            Value::Whole(_) | Value::Number(_) => "a number",
            Value::Flag(_) => "true or false",
            Value::Date => "a date",
            Value::List(_) => "a list",
            Value::Table(_) => "a table",
        }
    }

    /// The node at a path of table keys and of numbers in lists.
    pub fn find(&self, path: &[&str]) -> Option<&Self> {
        path.iter().try_fold(self, |node, key| match &node.value {
            Value::List(list) => list.get(key.parse::<usize>().ok()?),
            _ => node.table()?.get(key),
        })
    }

    /// The best place for a complaint about the value at `path`: itself, or its nearest existing parent's key.
    pub fn locate(&self, path: &[&str]) -> Place {
        let mut node = self;
        let mut best = self.place.clone();
        for step in path {
            let next = match &node.value {
                Value::Table(table) => table.entry(step).map(|entry| (&entry.place, &entry.node)),
                Value::List(list) => {
                    step.parse::<usize>().ok().and_then(|index| list.get(index)).map(|item| (&item.place, item))
                }
                _ => None,
            };
            let Some((place, child)) = next else { return best };
            // A table is shown by its key: its own span is the header or the whole of an inline table.
            best = if child.table().is_some() { place.clone() } else { child.place.clone() };
            node = child;
        }
        best
    }

    /// The value as plain TOML, as it was typed.
    pub fn plain(&self) -> Option<toml::Value> {
        Some(match &self.value {
            Value::Text(text) => toml::Value::String(text.clone()),
            Value::Whole(whole) => toml::Value::Integer(*whole),
            Value::Number(number) => toml::Value::Float(*number),
            Value::Flag(flag) => toml::Value::Boolean(*flag),
            Value::Date => return None,
            Value::List(list) => toml::Value::Array(list.iter().map(Self::plain).collect::<Option<_>>()?),
            Value::Table(table) => {
                let entries = table.entries.iter().map(|entry| Some((entry.key.clone(), entry.node.plain()?)));
                toml::Value::Table(entries.collect::<Option<_>>()?)
            }
        })
    }
}

/// Where the positions of a parsed text belong: its source, and how far into it the text begins.
#[derive(Clone, Copy)]
struct Base {
    source: usize,
    offset: usize,
}

impl Base {
    fn place(self, span: &std::ops::Range<usize>) -> Place {
        Place::new(self.source, span.start + self.offset..span.end + self.offset)
    }
}

/// Parses a whole scene; what could be understood, and all syntax errors.
pub(crate) fn parse(text: &str, source: usize) -> (Node, Vec<Complaint>) {
    let base = Base { source, offset: 0 };
    let (tree, errors) = DeTable::parse_recoverable(text);
    let mut complaints = Vec::new();
    let mut last_line = None;
    for error in &errors {
        let span = error.span().unwrap_or_default();
        // One slip makes the parser stumble several times in a line; the first time tells.
        let line = text.as_bytes()[..span.start.min(text.len())].iter().rposition(|byte| *byte == b'\n');
        if last_line.replace(line) != Some(line) {
            let at_end = text.get(span.clone()).is_none_or(|here| here.trim().is_empty());
            complaints.push(syntax(error.message(), at_end).at(&base.place(&span), "here"));
        }
    }
    (Node { value: Value::Table(table(tree.get_ref(), base)), place: Place::new(source, 0..0) }, complaints)
}

/// Parses a single value that begins at `offset` of its source.
pub(crate) fn parse_value(text: &str, source: usize, offset: usize) -> Result<Node, Complaint> {
    let base = Base { source, offset };
    match DeValue::parse(text) {
        Ok(value) => Ok(node(&value, base)),
        Err(error) => Err(syntax(error.message(), false).at(&base.place(&error.span().unwrap_or_default()), "here")),
    }
}

/// The parser's message, except where it guesses at what is simply not there.
fn syntax(message: &str, at_end: bool) -> Complaint {
    let unquoted = message.starts_with("string values must be quoted");
    match (unquoted, at_end) {
        (true, true) => Complaint::new("not valid TOML: no value after `=`"),
        (true, false) => Complaint::new("not valid TOML: text must be in quotes"),
        _ => Complaint::new(format!("not valid TOML: {}", message.trim().replace('\n', "; "))),
    }
}

fn table(table: &DeTable<'_>, base: Base) -> Table {
    let entries = table.iter().map(|(key, value)| Entry {
        key: key.get_ref().to_string(),
        place: base.place(&key.span()),
        node: node(value, base),
    });
    Table { entries: entries.collect() }
}

fn node(spanned: &Spanned<DeValue<'_>>, base: Base) -> Node {
    let value = match spanned.get_ref() {
        DeValue::String(text) => Value::Text(text.to_string()),
        DeValue::Integer(digits) => match i64::from_str_radix(digits.as_str(), digits.radix()) {
            Ok(whole) => Value::Whole(whole),
            // More digits than an integer holds: as a number it still means something.
            Err(_) => Value::Number(digits.as_str().parse().unwrap_or(f64::NAN)),
        },
        DeValue::Float(digits) => Value::Number(digits.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(flag) => Value::Flag(*flag),
        DeValue::Datetime(_) => Value::Date,
        DeValue::Array(list) => Value::List(list.iter().map(|item| node(item, base)).collect()),
        DeValue::Table(inner) => Value::Table(table(inner, base)),
    };
    Node { value, place: base.place(&spanned.span()) }
}
