//! Cases of scenes: shipped ones, with something changed.

use crate::bundle::Bundle;
use crate::draw::Draw;
use crate::nasty;
use crate::reading::Expect;
use crate::seeds::{Seed, seeds};
use crate::spoil;
use crate::spots::{self, Spot, Step, spots};
use toml::{Table, Value};
use tsubu_scene::keys::{self, Key, Kind, Need};
use tsubu_scene::units::{self, Dimension};

/// A case: a scene that is right with one change whose outcome is known, or with several.
pub fn draw(draw: &mut Draw) -> Bundle {
    let seed = draw.pick(seeds());
    let (change, expect, table) = match draw.below(8) {
        0 => return as_text(draw, seed),
        1 => return with_changes(draw, seed),
        2 => ("a key misspelt", Expect::Refuse, misspelt(draw, &seed.table)),
        3 => ("another number", Expect::Other, another_number(draw, &seed.table)),
        4 => ("another unit", Expect::Other, another_unit(draw, &seed.table)),
        5 => ("a unit of another kind", Expect::Refuse, a_wrong_unit(draw, &seed.table)),
        6 => ("keys in another order", Expect::Same, Some(in_another_order(draw, &seed.table))),
        _ => ("", Expect::Survive, None),
    };
    let (change, expect, table) = match table {
        Some(table) => (change, expect, table),
        None => ("nasty values and keys", Expect::Survive, nasty(draw, &seed.table)),
    };
    let Ok(mut text) = toml::to_string(&table) else { return seed.bundle.clone() };
    if matches!(expect, Expect::Same) {
        text = spoil::same_text(draw, &text);
    }
    expect.of(change, seed.bundle.clone().with("scene.toml", text), &seed.bundle)
}

/// Damage that knows nothing of TOML, and depths that nobody types.
fn as_text(draw: &mut Draw, seed: &Seed) -> Bundle {
    let other = draw.pick(seeds());
    let mut text = seed.text.clone().into_bytes();
    if draw.one_in(20) {
        let depth = 1 << draw.below(17);
        let deep = match draw.below(4) {
            0 => format!("x = {}", "[".repeat(depth)),
            1 => format!("title = {}{}", "[".repeat(depth), "]".repeat(depth)),
            2 => format!("x = {}", "{a=".repeat(depth)),
            _ => format!("{} = 1", vec!["a"; depth].join(".")),
        };
        text = format!("{deep}\n{}", seed.text).into_bytes();
    } else {
        for _ in 0..=draw.below(3) {
            text = spoil::bytes(draw, &text, other.text.as_bytes());
        }
    }
    Expect::Survive.of("a damaged text", seed.bundle.clone().with("scene.toml", text), &seed.bundle)
}

/// Changes on the command line.
fn with_changes(draw: &mut Draw, seed: &Seed) -> Bundle {
    let spots = spots(&seed.table);
    let mut changes = Vec::new();
    for _ in 0..=draw.below(2) {
        let spot = draw.pick(&spots);
        let mut path = spot.dotted();
        if draw.one_in(8) {
            path = nasty::misspelt(draw, &path);
        }
        let value = match spot.key {
            Some(key) if draw.one_in(2) => fitting(draw, key).to_string(),
            _ => nasty::text(draw),
        };
        changes.push(if draw.one_in(20) { path } else { format!("{path}={value}") });
    }
    let changes = serde_json::to_vec(&changes).unwrap_or_default();
    Expect::Survive.of("changes", seed.bundle.clone().with("changes.json", changes), &seed.bundle)
}

/// Up to four changes that may go with each other or not.
fn nasty(draw: &mut Draw, table: &Table) -> Table {
    let mut table = table.clone();
    for _ in 0..=draw.below(4) {
        let spots = spots(&table);
        if spots.is_empty() {
            break;
        }
        let spot = draw.pick(&spots);
        match draw.below(8) {
            0 => {
                if let Some(home) = spots::home(&mut table, &spot.path) {
                    home.remove(spot.name());
                }
            }
            1 => add_a_key(draw, &mut table),
            2 => graft(draw, &mut table, spot),
            3 => {
                let value = spots::at(&mut table, &spot.path).cloned();
                let other = draw.pick(&spots);
                if let (Some(value), Some(there)) = (value, spots::at(&mut table, &other.path)) {
                    *there = value;
                }
            }
            4 | 5 => {
                let value = spot.key.map(|key| fitting(draw, key));
                if let (Some(value), Some(there)) = (value, spots::at(&mut table, &spot.path)) {
                    *there = value;
                }
            }
            _ => {
                let value = nasty::value(draw);
                if let Some(there) = spots::at(&mut table, &spot.path) {
                    *there = value;
                }
            }
        }
    }
    table
}

/// A key that is not there yet, in a table that is.
fn add_a_key(draw: &mut Draw, table: &mut Table) {
    let mut homes: Vec<(Vec<Step>, &'static [Key])> = vec![(Vec::new(), keys::SCENE)];
    for spot in spots(table) {
        if let Some(Key { kind: Kind::Table(keys), .. }) = spot.key {
            homes.push((spot.path.clone(), keys));
        }
        if let Some(Key { kind: Kind::Named(keys, _), .. }) = spot.key
            && let Some(Value::Table(named)) = spots::at(table, &spot.path)
        {
            let inner = |name: &String| [spot.path.as_slice(), &[Step::Key(name.clone())]].concat();
            homes.extend(named.keys().map(|name| (inner(name), *keys)));
        }
    }
    homes.retain(|(_, keys)| !keys.is_empty());
    let (path, keys) = draw.pick(&homes);
    let key = draw.pick(keys);
    let value = fitting(draw, key);
    let home = if path.is_empty() { Some(table) } else { spots::at(table, path).and_then(Value::as_table_mut) };
    if let Some(home) = home {
        home.insert(key.name.to_owned(), value);
    }
}

/// The same place as in another scene.
fn graft(draw: &mut Draw, table: &mut Table, spot: &Spot) {
    let mut other = draw.pick(seeds()).table.clone();
    let scions = spots(&other);
    let scion = draw.pick(&scions);
    let Some(value) = spots::at(&mut other, &scion.path).cloned() else { return };
    if scion.path.len() == 1 {
        table.insert(scion.name().to_owned(), value);
    } else if let Some(home) = spots::home(table, &spot.path) {
        home.insert(scion.name().to_owned(), value);
    }
}

/// A value of the kind that the key wants, small or large.
fn fitting(draw: &mut Draw, key: &Key) -> Value {
    let number = |draw: &mut Draw| 10_f64.powi(draw.below(13) as i32 - 8) * (1.0 + 9.0 * draw.share());
    match key.kind {
        Kind::Quantity(dimension) if draw.one_in(2) && !dimension.units.is_empty() => {
            Value::String(format!("{} {}", number(draw) as f32, draw.pick(dimension.units)))
        }
        Kind::Quantity(_) => Value::Float(number(draw)),
        Kind::Whole => Value::Integer(1 << draw.below(34)),
        Kind::Flag => Value::Boolean(draw.one_in(2)),
        Kind::OneOf(words) => Value::String(draw.pick(words).name.to_owned()),
        Kind::SomeOf(words) => Value::Array(vec![Value::String(draw.pick(words).name.to_owned())]),
        Kind::Vector(_) | Kind::Direction | Kind::Axis | Kind::Ends(_) | Kind::Turning(_) => {
            let length = 2 + draw.below(2);
            Value::Array((0..length).map(|_| Value::Float(number(draw))).collect())
        }
        Kind::Table(keys) => Value::Table(filled(draw, keys)),
        Kind::Many(keys) => Value::Array((0..draw.below(3)).map(|_| Value::Table(filled(draw, keys))).collect()),
        Kind::Named(keys, _) => Value::Table(Table::from_iter([("a".to_owned(), Value::Table(filled(draw, keys)))])),
        Kind::Choice(variants) => {
            let variant = draw.pick(variants);
            Value::Table(Table::from_iter([(variant.name.to_owned(), Value::Table(filled(draw, variant.keys)))]))
        }
        _ => match key.need {
            Need::Word(word) | Need::DerivedOrWord(_, word) if draw.one_in(2) => Value::String(word.to_owned()),
            _ => nasty::value(draw),
        },
    }
}

/// A table with what it must have, and some of the rest.
fn filled(draw: &mut Draw, keys: &'static [Key]) -> Table {
    let mut table = Table::new();
    for key in keys {
        if matches!(key.need, Need::Required) || draw.one_in(6) {
            let value = fitting(draw, key);
            table.insert(key.name.to_owned(), value);
        }
    }
    table
}

/// One key with a slip of the hand; `None` where the slip gives another key.
fn misspelt(draw: &mut Draw, table: &Table) -> Option<Table> {
    let mut table = table.clone();
    let spots: Vec<Spot> = spots(&table).into_iter().filter(|spot| spot.words.is_some()).collect();
    let spot = draw.pick(&spots);
    let word = nasty::misspelt(draw, spot.name());
    if word == spot.name() || spot.words.as_ref()?.contains(&word.as_str()) {
        return None;
    }
    let home = spots::home(&mut table, &spot.path)?;
    let value = home.remove(spot.name())?;
    home.insert(word, value);
    Some(table)
}

/// One number a little larger.
fn another_number(draw: &mut Draw, table: &Table) -> Option<Table> {
    change_a_number(draw, table, |draw, value, _| {
        Some(match value {
            Value::Integer(number) => Value::Integer(*number + 1),
            Value::Float(number) if *number == 0.0 => Value::Float(0.125),
            Value::Float(number) => Value::Float(*number * (1.01 + draw.share())),
            Value::String(text) => {
                let (number, unit) = split(text)?;
                Value::String(format!("{} {unit}", if number == 0.0 { 0.125 } else { number * (1.01 + draw.share()) }))
            }
            _ => return None,
        })
    })
}

/// One quantity in another unit of its kind, with the same number.
fn another_unit(draw: &mut Draw, table: &Table) -> Option<Table> {
    change_a_number(draw, table, |draw, value, dimension| {
        let (number, unit) = split(value.as_str()?)?;
        let other = draw.pick(dimension.units);
        let size = |unit: &str| units::read(&format!("1 {unit}"), dimension).ok();
        let changes = number != 0.0 && size(unit)? != size(other)?;
        changes.then(|| Value::String(format!("{number} {other}")))
    })
}

/// One quantity in a unit of another kind.
fn a_wrong_unit(draw: &mut Draw, table: &Table) -> Option<Table> {
    change_a_number(draw, table, |_, value, dimension| {
        let (number, _) = split(value.as_str()?)?;
        // Not g, which may be a gram and the acceleration of gravity.
        let wrong = if dimension.si == "kg" { "mm" } else { "mg" };
        Some(Value::String(format!("{number} {wrong}")))
    })
}

/// Number and unit of a quantity.
fn split(text: &str) -> Option<(f64, &str)> {
    let (number, unit) = text.split_once(' ')?;
    Some((number.parse().ok()?, unit))
}

type Change = fn(&mut Draw, &Value, &'static Dimension) -> Option<Value>;

/// Changes one number of the scene.
fn change_a_number(draw: &mut Draw, table: &Table, change: Change) -> Option<Table> {
    let mut table = table.clone();
    let mut numbers: Vec<(Spot, &'static Dimension)> = Vec::new();
    for spot in spots(&table) {
        let dimension = match spot.key.map(|key| key.kind) {
            Some(Kind::Whole) => &units::NUMBER,
            // It may be told in percent.
            None | Some(Kind::Slope) => continue,
            Some(kind) => match kind.dimension() {
                Some(dimension) => dimension,
                None => continue,
            },
        };
        numbers.push((spot, dimension));
    }
    let (spot, dimension) = numbers.get(draw.below(numbers.len().max(1)))?;
    let mut value = spots::at(&mut table, &spot.path)?;
    while let Value::Array(list) = value {
        let item = draw.below(list.len().max(1));
        value = list.get_mut(item)?;
    }
    *value = change(draw, value, dimension)?;
    Some(table)
}

/// The same scene with its keys in another order.
fn in_another_order(draw: &mut Draw, table: &Table) -> Table {
    let mut entries: Vec<(String, Value)> = table.clone().into_iter().collect();
    draw.shuffle(&mut entries);
    let inner = |(name, value)| match value {
        Value::Table(table) => (name, Value::Table(in_another_order(draw, &table))),
        other => (name, other),
    };
    entries.into_iter().map(inner).collect()
}
