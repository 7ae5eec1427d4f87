//! Which cavity of an atlas a scene has: the same grains between the same walls, wherever they hang.

use crate::study::atlas::Cavity;
use serde_json::Value;
use tsubu_scene::Plan;

/// What of a plan makes a cavity.
const PARTS: [&str; 14] = [
    "method",
    "dimension",
    "gravity",
    "materials",
    "material-pair",
    "particles",
    "walls",
    "periodic",
    "removal",
    "water",
    "contact",
    "bond",
    "lattice",
    "cl-ca",
];
/// Keys of walls that say who moves them, and keys of shapes that say where they are. A mesh is told by its fingerprint, not by its name.
const CARRIED: [&str; 2] = ["host", "interface"];
const NAMED: &str = "path";
const PLACED: [&str; 4] = ["floor-centre", "point", "centre", "shift"];

/// The cavity of the atlases that a scene's case has; otherwise what is another, in the atlas that comes nearest.
pub(super) fn find<'a>(plan: &Plan, host: &str, cavities: &'a [Cavity]) -> Result<&'a Cavity, String> {
    let own = parts(plan, host);
    let mut nearest: Option<(usize, String)> = None;
    for cavity in cavities {
        let mut differences = Vec::new();
        compare("", &own, &parts(&cavity.plan, &cavity.host), &mut differences);
        if differences.is_empty() {
            return Ok(cavity);
        }
        let told = format!("{} (cavity `{}`)", differences[0], cavity.name);
        if nearest.as_ref().is_none_or(|(number, _)| differences.len() < *number) {
            nearest = Some((differences.len(), told));
        }
    }
    Err(nearest.map_or_else(|| "there is none in it".to_owned(), |(_, told)| told))
}

/// The parts of a plan that make its cavity, as if it were drawn at the origin, and the direction in which its host shakes it.
fn parts(plan: &Plan, host: &str) -> Value {
    let mut all = serde_json::to_value(plan).unwrap_or_default();
    let Some(table) = all.as_object_mut() else { return Value::Null };
    table.retain(|key, _| PARTS.contains(&key.as_str()));
    if let Some(host) = plan.hosts.get(host) {
        table.insert("direction of the host".to_owned(), host.direction.to_vec().into());
    }
    if let Some(lattice) = table.get_mut("lattice").and_then(Value::as_object_mut) {
        lattice.remove("head-room");
    }
    let mut origin: Option<Vec<f64>> = None;
    let walls = table.get_mut("walls").and_then(Value::as_object_mut);
    for wall in walls.into_iter().flatten().filter_map(|(_, wall)| wall.as_object_mut()) {
        wall.retain(|key, _| !CARRIED.contains(&key.as_str()));
        let shape = wall.get_mut("shape").and_then(Value::as_object_mut);
        for measures in shape.into_iter().flatten().filter_map(|(_, measures)| measures.as_object_mut()) {
            measures.remove(NAMED);
            for place in PLACED {
                let Some(vector) = measures.get(place).and_then(numbers) else { continue };
                let from = origin.get_or_insert_with(|| vector.clone());
                // What is moved is rounded; a picometre is no other place.
                let rounded = |x: f64| (x * 1e12).round() * 1e-12;
                let moved: Vec<f64> = vector.iter().zip(from.iter()).map(|(x, o)| rounded(x - o)).collect();
                measures.insert(place.to_owned(), moved.into());
            }
        }
    }
    all
}

fn numbers(value: &Value) -> Option<Vec<f64>> {
    value.as_array()?.iter().map(Value::as_f64).collect()
}

/// Every place where two values differ, with both.
fn compare(path: &str, own: &Value, other: &Value, differences: &mut Vec<String>) {
    match (own, other) {
        (Value::Object(a), Value::Object(b)) => {
            let keys: std::collections::BTreeSet<&String> = a.keys().chain(b.keys()).collect();
            for key in keys {
                let inner = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                compare(&inner, a.get(key).unwrap_or(&Value::Null), b.get(key).unwrap_or(&Value::Null), differences);
            }
        }
        (own, other) if own == other => {}
        (own, other) => differences.push(format!("`{path}` is {} there, {} here", told(other), told(own))),
    }
}

/// A value in a few words.
fn told(value: &Value) -> String {
    match value {
        Value::Null => "not said".to_owned(),
        Value::Object(_) | Value::Array(_) => {
            let text = value.to_string();
            if text.len() > 60 { "another".to_owned() } else { text }
        }
        plain => plain.to_string(),
    }
}
