//! Places in the tree of a scene, each with what the table of keys says of it.

use toml::{Table, Value};
use tsubu_scene::keys::{self, Key, Kind, Variant};

/// One step down the tree.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// Into a table.
    Key(String),
    /// Into a list.
    Item(usize),
}

/// An entry of the scene.
#[derive(Clone, Debug)]
pub struct Spot {
    /// The way there.
    pub path: Vec<Step>,
    /// What it is; `None` for names that the user chooses and for the tables of a choice.
    pub key: Option<&'static Key>,
    /// The words that could stand here; `None` where anything can.
    pub words: Option<Vec<&'static str>>,
}

impl Spot {
    /// The last word of the way.
    pub fn name(&self) -> &str {
        match self.path.last() {
            Some(Step::Key(name)) => name,
            _ => "",
        }
    }

    /// The path as `--set` wants it.
    pub fn dotted(&self) -> String {
        let word = |step: &Step| match step {
            Step::Key(name) if name.contains('.') => format!("\"{name}\""),
            Step::Key(name) => name.clone(),
            Step::Item(index) => index.to_string(),
        };
        self.path.iter().map(word).collect::<Vec<_>>().join(".")
    }
}

/// Every entry of a scene, the tables before what is in them.
pub fn spots(root: &Table) -> Vec<Spot> {
    let mut out = Vec::new();
    of_table(keys::SCENE, root, &[], &mut out);
    out
}

fn of_table(keys: &'static [Key], table: &Table, path: &[Step], out: &mut Vec<Spot>) {
    for (name, value) in table {
        let Some(key) = keys.iter().find(|key| key.name == name) else { continue };
        let path = [path, &[Step::Key(name.clone())]].concat();
        let words = Some(keys.iter().map(|key| key.name).collect());
        out.push(Spot { path: path.clone(), key: Some(key), words });
        inside(key.kind, value, &path, out);
    }
}

fn inside(kind: Kind, value: &Value, path: &[Step], out: &mut Vec<Spot>) {
    match (kind, value) {
        (Kind::Table(keys), Value::Table(table)) => of_table(keys, table, path, out),
        (Kind::Many(keys), Value::Array(list)) => {
            for (index, item) in list.iter().enumerate() {
                if let Value::Table(table) = item {
                    of_table(keys, table, &[path, &[Step::Item(index)]].concat(), out);
                }
            }
        }
        (Kind::Choice(variants), Value::Table(table)) => chosen(variants, table, path, out),
        (Kind::Named(..) | Kind::NamedChoice(..), Value::Table(table)) => {
            for (name, value) in table {
                let path = [path, &[Step::Key(name.clone())]].concat();
                out.push(Spot { path: path.clone(), key: None, words: None });
                match (kind, value) {
                    (Kind::Named(keys, _), Value::Table(table)) => of_table(keys, table, &path, out),
                    (Kind::NamedChoice(variants, _), Value::Table(table)) => chosen(variants, table, &path, out),
                    _ => {}
                }
            }
        }
        _ => {}
    }
}

fn chosen(variants: &'static [Variant], table: &Table, path: &[Step], out: &mut Vec<Spot>) {
    for (name, value) in table {
        let path = [path, &[Step::Key(name.clone())]].concat();
        let words = Some(variants.iter().map(|variant| variant.name).collect());
        out.push(Spot { path: path.clone(), key: None, words });
        let variant = variants.iter().find(|variant| variant.name == name);
        if let (Some(variant), Value::Table(table)) = (variant, value) {
            of_table(variant.keys, table, &path, out);
        }
    }
}

/// What stands at the end of the way.
pub fn at<'a>(root: &'a mut Table, path: &[Step]) -> Option<&'a mut Value> {
    let (first, rest) = path.split_first()?;
    let Step::Key(name) = first else { return None };
    rest.iter().try_fold(root.get_mut(name)?, |value, step| match (step, value) {
        (Step::Key(name), Value::Table(table)) => table.get_mut(name),
        (Step::Item(index), Value::Array(list)) => list.get_mut(*index),
        _ => None,
    })
}

/// The table that holds the entry.
pub fn home<'a>(root: &'a mut Table, path: &[Step]) -> Option<&'a mut Table> {
    match path {
        [] => None,
        [_] => Some(root),
        [above @ .., _] => at(root, above)?.as_table_mut(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seeds::seeds;

    /// If the walk misses a kind of table, nothing in it is ever tried.
    #[test]
    fn every_leaf_of_every_scene_is_found() {
        for seed in seeds() {
            let mut table = seed.table.clone();
            let spots = spots(&table);
            for spot in &spots {
                assert!(at(&mut table, &spot.path).is_some(), "{}", spot.dotted());
            }
            let keys = spots.iter().filter(|spot| spot.key.is_some()).count();
            let lines = seed.text.lines().filter(|line| !line.starts_with(['#', '[']) && line.contains(" = ")).count();
            assert!(keys >= lines, "{keys} of {lines}: {}", seed.text);
        }
    }
}
