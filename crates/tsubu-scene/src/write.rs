//! The plan as a scene file: what goes into the run folder.
//!
//! Written along the registry, so that it reads like a scene typed by a careful person: tables in the usual order,
//! units in comments, choices without parameters on one line. Numbers are written with the fewest digits that read
//! back to the same double.

use crate::keys::{self, Key, Kind, Need, Variant};
use crate::plan::Plan;
use std::fmt::Write as _;
use toml::Value;

/// Longer lists are broken into lines of about this many characters.
const LINE: usize = 100;

/// The plan as a scene: SI numbers and every default, without what is left open. Reading it gives the same plan, bit by bit.
pub(crate) fn to_toml(plan: &Plan, leave_open: impl FnOnce(&mut toml::Table)) -> String {
    let mut out = String::from("# Every value of the run, defaults included; numbers are in SI units.\n");
    // A plan is plain data with string keys; there is nothing in it that TOML cannot hold.
    let Ok(Value::Table(mut table)) = Value::try_from(plan) else { return out };
    leave_open(&mut table);
    keys_of(&mut out, keys::SCENE, &table, "");
    out
}

/// First what stands on lines of this table, then the tables below it: TOML knows no way back up.
fn keys_of(out: &mut String, keys: &'static [Key], table: &toml::Table, path: &str) {
    for key in keys {
        match (table.get(key.name), key.kind) {
            (None, _) => {
                if let Some(word) = key.word_instead() {
                    let _ = writeln!(out, "{} = {}", key.name, quote(word));
                }
            }
            (Some(value), Kind::Choice(_)) => {
                if let Some(variant) = empty_choice(value) {
                    let _ = writeln!(out, "{}.{variant} = {{}}", key.name);
                }
            }
            (
                Some(_),
                Kind::Table(_) | Kind::Named(..) | Kind::NamedChoice(..) | Kind::Many(_) | Kind::Vary | Kind::Set,
            ) => {}
            (Some(value), kind) => {
                let _ = write!(out, "{} = {}", key.name, text(value, true));
                match kind.dimension().map(|dimension| dimension.si) {
                    Some(unit) if !unit.is_empty() => {
                        let _ = writeln!(out, " # {unit}");
                    }
                    _ => out.push('\n'),
                }
            }
        }
    }
    for key in keys {
        let Some(value) = table.get(key.name) else { continue };
        let here = join(path, key.name);
        match (key.kind, value) {
            // Empty by default: a heading would say nothing.
            (Kind::Table(_), Value::Table(table)) if table.is_empty() && matches!(key.need, Need::Default("{}")) => {}
            (Kind::Table(inner), Value::Table(table)) => section(out, inner, table, &here),
            (Kind::Named(inner, _), Value::Table(named)) => {
                for (name, value) in named {
                    if let Value::Table(table) = value {
                        section(out, inner, table, &join(&here, name));
                    }
                }
            }
            (Kind::Many(inner), Value::Array(list)) => {
                for table in list.iter().filter_map(Value::as_table) {
                    let _ = writeln!(out, "\n[[{here}]]");
                    keys_of(out, inner, table, &here);
                }
            }
            (Kind::Choice(variants), Value::Table(choice)) if empty_choice(value).is_none() => {
                chosen(out, variants, choice, &here);
            }
            (Kind::NamedChoice(variants, _), Value::Table(named)) => {
                for (name, value) in named {
                    if let Value::Table(choice) = value {
                        chosen(out, variants, choice, &join(&here, name));
                    }
                }
            }
            (Kind::Set, Value::Table(set)) if !set.is_empty() => {
                let _ = writeln!(out, "\n[{here}]");
                for (key, value) in set {
                    let _ = writeln!(out, "{} = {}", bare(key), text(value, false));
                }
            }
            (Kind::Vary, Value::Table(varied)) => {
                let _ = writeln!(out, "\n[{here}]");
                for (path, values) in varied {
                    let _ = writeln!(out, "{} = {}", quote(path), text(values, true));
                }
            }
            _ => {}
        }
    }
}

fn section(out: &mut String, keys: &'static [Key], table: &toml::Table, path: &str) {
    let _ = writeln!(out, "\n[{path}]");
    keys_of(out, keys, table, path);
}

fn chosen(out: &mut String, variants: &'static [Variant], choice: &toml::Table, path: &str) {
    for variant in variants {
        if let Some(Value::Table(table)) = choice.get(variant.name) {
            section(out, variant.keys, table, &join(path, variant.name));
        }
    }
}

/// The variant of a choice that has no parameters to write.
fn empty_choice(value: &Value) -> Option<&str> {
    let (name, inner) = value.as_table()?.iter().next()?;
    inner.as_table()?.is_empty().then_some(name)
}

/// A value as it stands in a scene; long lists may be broken into lines.
pub(crate) fn text(value: &Value, may_break: bool) -> String {
    match value {
        Value::String(text) => quote(text),
        Value::Integer(whole) => whole.to_string(),
        Value::Float(number) => float(*number),
        Value::Boolean(flag) => flag.to_string(),
        Value::Datetime(date) => date.to_string(),
        Value::Array(items) => {
            let items: Vec<String> = items.iter().map(|item| text(item, false)).collect();
            let line = format!("[{}]", items.join(", "));
            if !may_break || line.len() <= LINE {
                return line;
            }
            wrapped(&items)
        }
        Value::Table(table) => {
            let entries: Vec<String> =
                table.iter().map(|(key, value)| format!("{} = {}", bare(key), text(value, false))).collect();
            format!("{{ {} }}", entries.join(", "))
        }
    }
}

fn wrapped(items: &[String]) -> String {
    let mut out = String::from("[");
    let mut column = LINE;
    for item in items {
        if column + item.len() > LINE {
            out.push_str("\n   ");
            column = 3;
        }
        let _ = write!(out, " {item},");
        column += item.len() + 2;
    }
    out.push_str("\n]");
    out
}

/// The shortest digits that read back to the same double; with an exponent where zeros would have to be counted.
fn float(number: f64) -> String {
    let size = number.abs();
    if size >= 1e6 || (size < 1e-3 && size > 0.0) { format!("{number:e}") } else { format!("{number:?}") }
}

fn join(path: &str, name: &str) -> String {
    if path.is_empty() { bare(name) } else { format!("{path}.{}", bare(name)) }
}

/// A key, quoted only if it must be.
fn bare(name: &str) -> String {
    let plain = !name.is_empty() && name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'-' || b == b'_');
    if plain { name.to_string() } else { quote(name) }
}

fn quote(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            c if c.is_control() => {
                let _ = write!(out, "\\u{:04X}", u32::from(c));
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
