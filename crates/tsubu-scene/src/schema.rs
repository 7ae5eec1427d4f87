//! The JSON Schema of the scene file (draft 2020-12), for editors that complete and check TOML.

use crate::keys::{self, Bound, Key, Kind, Need, Range, Variant, Word};
use crate::units::Dimension;
use serde_json::{Map, Value, json};

/// The schema, made from the table of keys.
pub fn schema() -> Value {
    let mut schema = table(keys::SCENE, "A scene of the granular-dynamics simulator tsubu");
    let head = json!({ "$schema": "https://json-schema.org/draft/2020-12/schema", "title": "tsubu scene" });
    merge(head, &mut schema)
}

/// `first` with the entries of `second` behind its own.
fn merge(first: Value, second: &mut Value) -> Value {
    let (Value::Object(mut merged), Value::Object(rest)) = (first, second.take()) else { return Value::Null };
    merged.extend(rest);
    Value::Object(merged)
}

fn table(keys: &'static [Key], about: &str) -> Value {
    let properties: Map<String, Value> = keys.iter().map(|key| (key.name.to_string(), property(key))).collect();
    let required: Vec<&str> =
        keys.iter().filter(|key| matches!(key.need, Need::Required)).map(|key| key.name).collect();
    let mut schema = json!({
        "type": "object",
        "description": about,
        "additionalProperties": false,
        "properties": properties,
    });
    if !required.is_empty() {
        schema["required"] = json!(required);
    }
    schema
}

fn property(key: &'static Key) -> Value {
    let mut schema = kind(key);
    if let Some(word) = key.word_instead() {
        schema = json!({ "anyOf": [{ "const": word }, schema] });
    }
    schema["description"] = json!(crate::reference::describe(key));
    if let Need::Default(text) = key.need
        && let Some(default) = default(text)
    {
        schema["default"] = default;
    }
    schema
}

fn kind(key: &'static Key) -> Value {
    match key.kind {
        Kind::Quantity(dimension) => quantity(dimension, key.range),
        Kind::Whole => limited(json!({ "type": "integer" }), key.range),
        Kind::Text | Kind::Name(_) => json!({ "type": "string" }),
        Kind::Wholes => {
            let item = limited(json!({ "type": "integer" }), key.range);
            json!({ "type": "array", "minItems": 1, "items": item })
        }
        Kind::Names(_) => {
            json!({ "type": "array", "minItems": 1, "uniqueItems": true, "items": { "type": "string" } })
        }
        Kind::Flag => json!({ "type": "boolean" }),
        Kind::OneOf(words) => one_of(words),
        Kind::SomeOf(words) => {
            json!({ "type": "array", "minItems": 1, "uniqueItems": true, "items": one_of(words) })
        }
        Kind::Vector(dimension) => json!({ "anyOf": [{ "const": "origin" }, vector(dimension)] }),
        Kind::Vectors(dimension) => json!({ "type": "array", "items": vector(dimension) }),
        Kind::Turning(dimension) => turning(dimension),
        Kind::Turnings(dimension) => json!({ "type": "array", "items": turning(dimension) }),
        Kind::Direction | Kind::Axis => {
            let axes = json!({ "enum": ["x", "-x", "y", "-y", "z", "-z"] });
            json!({ "anyOf": [axes, vector(&crate::units::NUMBER)] })
        }
        Kind::Slope => quantity(&crate::units::ANGLE, key.range),
        Kind::Gravity => {
            let dimension = &crate::units::ACCELERATION;
            json!({ "anyOf": [quantity(dimension, key.range), vector(dimension)] })
        }
        Kind::Quantities(dimension) => json!({ "type": "array", "items": quantity(dimension, key.range) }),
        Kind::Ends(dimension) => {
            let end = quantity(dimension, key.range);
            json!({ "type": "array", "minItems": 2, "maxItems": 2, "items": end })
        }
        Kind::Cohesion => {
            let [force, density] =
                [&crate::units::FORCE, &crate::units::ENERGY_DENSITY].map(|dimension| quantity(dimension, key.range));
            json!({ "anyOf": [force, density] })
        }
        Kind::Matrix(dimension) => {
            let row = json!({ "type": "array", "minItems": 1, "items": quantity(dimension, Range::ANY) });
            json!({ "type": "array", "minItems": 1, "items": row })
        }
        Kind::Ratios => {
            let number = || quantity(&crate::units::NUMBER, Range::ANY);
            json!({ "anyOf": [
                { "type": "array", "minItems": 1, "items": number() },
                {
                    "type": "object",
                    "additionalProperties": false,
                    "required": ["from", "to"],
                    "properties": { "from": number(), "to": number(), "step": number() },
                },
            ] })
        }
        Kind::NamePair => json!({ "type": "array", "minItems": 2, "maxItems": 2, "items": { "type": "string" } }),
        Kind::Table(keys) => table(keys, key.about),
        Kind::Named(keys, about) => json!({ "type": "object", "additionalProperties": table(keys, about) }),
        Kind::Many(keys) => json!({ "type": "array", "items": table(keys, key.about) }),
        Kind::Choice(variants) => choice(variants),
        Kind::NamedChoice(variants, _) => json!({ "type": "object", "additionalProperties": choice(variants) }),
        Kind::Set => json!({ "type": "object" }),
        Kind::Vary => {
            let ends = ["from", "to", "step"].map(|name| (name.to_owned(), json!({ "type": ["number", "string"] })));
            let range = json!({
                "type": "object",
                "additionalProperties": false,
                "required": ["from", "to"],
                "properties": ends.into_iter().collect::<Map<String, Value>>(),
            });
            let list = json!({ "type": "array", "minItems": 1 });
            json!({ "type": "object", "additionalProperties": { "anyOf": [list, range] } })
        }
    }
}

fn one_of(words: &[Word]) -> Value {
    let words: Vec<Value> = words.iter().map(|word| json!({ "const": word.name, "description": word.about })).collect();
    json!({ "oneOf": words })
}

fn choice(variants: &'static [Variant]) -> Value {
    let properties: Map<String, Value> =
        variants.iter().map(|variant| (variant.name.to_string(), table(variant.keys, variant.about))).collect();
    json!({
        "type": "object",
        "minProperties": 1,
        "maxProperties": 1,
        "additionalProperties": false,
        "properties": properties,
    })
}

/// A number in SI, or text; the range can only be told for the number.
fn quantity(dimension: &Dimension, range: Range) -> Value {
    let text = json!({ "type": "string", "pattern": r"^\s*[+-]?[0-9_.]+([eE][+-]?[0-9]+)?\s*[^\s0-9].*$" });
    json!({ "anyOf": [limited(json!({ "type": "number" }), range), text], "examples": dimension.examples })
}

fn vector(dimension: &Dimension) -> Value {
    json!({ "type": "array", "minItems": 2, "maxItems": 3, "items": quantity(dimension, Range::ANY) })
}

fn turning(dimension: &Dimension) -> Value {
    json!({ "anyOf": [quantity(dimension, Range::ANY), vector(dimension)] })
}

fn limited(mut schema: Value, range: Range) -> Value {
    let mut limit = |bound: Bound, including: &str, excluding: &str| match bound {
        Bound::Open => {}
        Bound::Including(x) => schema[including] = json!(x),
        Bound::Excluding(x) => schema[excluding] = json!(x),
    };
    limit(range.low, "minimum", "exclusiveMinimum");
    limit(range.high, "maximum", "exclusiveMaximum");
    schema
}

/// A default of the registry as JSON.
fn default(text: &str) -> Option<Value> {
    let table: toml::Table = format!("default = {text}").parse().ok()?;
    serde_json::to_value(table.get("default")?).ok()
}
