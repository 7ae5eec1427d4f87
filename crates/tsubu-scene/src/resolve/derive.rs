//! Values that follow from others: masses from densities, counts from positions, tables from files.

use super::{join, table};
use crate::complaint::{Complaint, Source};
use crate::files::Files;
use crate::node::Node;
use crate::suggest;
use crate::units::{Dimension, FORCE, LENGTH};
use std::f64::consts::PI;
use toml::Value;

/// Fills what the registry calls derived. Wrong values are already complained about and absent here; the typed tree
/// tells what is absent because nobody gave it.
pub(crate) fn derive(
    resolved: &mut toml::Table,
    root: &Node,
    files: &mut Files,
    sources: &mut Vec<Source>,
) -> Vec<Complaint> {
    let mut complaints = Vec::new();
    particles(resolved, root, &mut complaints);
    boxes(resolved, root, &mut complaints);
    oscillators(resolved, root, &mut complaints);
    signals(resolved, root, files, sources, &mut complaints);
    settings(resolved);
    response(resolved, root, &mut complaints);
    complaints
}

fn particles(resolved: &mut toml::Table, root: &Node, complaints: &mut Vec<Complaint>) {
    let materials = table_at(resolved, "materials").cloned().unwrap_or_default();
    for (name, group) in tables_in(resolved, "particles") {
        let path = ["particles", name.as_str()];
        count(group, root, &path, complaints);
        if group.contains_key("mass") || root.find(&[path[0], path[1], "mass"]).is_some() {
            continue;
        }
        let Some(material) = group.get("material").and_then(Value::as_str) else { continue };
        let density = materials.get(material).and_then(|material| material.get("density")).and_then(Value::as_float);
        match (density, group.get("diameter").and_then(Value::as_float)) {
            (Some(density), Some(diameter)) => {
                group.insert("mass".into(), Value::Float(density * PI / 6.0 * diameter.powi(3)));
            }
            (None, _) if root.find(&["materials", material, "density"]).is_none() => complaints.push(
                Complaint::new(format!("the mass of `{name}` is not known"))
                    .at(&root.locate(&path), "has no `mass`")
                    .hint("give `mass` here, for example \"0.2 g\"")
                    .hint(format!("or give [materials.{material}] a `density`, for example \"1190 kg/m^3\"")),
            ),
            _ => {}
        }
    }
}

fn count(group: &mut toml::Table, root: &Node, path: &[&str; 2], complaints: &mut Vec<Complaint>) {
    let Some(start) = group.get("start") else { return };
    let typed = root.find(&[path[0], path[1], "count"]).is_some();
    let Some(at) = start.get("at") else {
        if !typed {
            complaints.push(
                Complaint::new(format!("missing key `count` in [{}.{}]", path[0], path[1]))
                    .at(&root.locate(path), "needs `count`")
                    .hint("`count`: Number of grains; only `start.at` can do without"),
            );
        }
        return;
    };
    let Some(positions) = at.get("position").and_then(Value::as_array).map(Vec::len) else { return };
    match group.get("count").and_then(Value::as_integer) {
        Some(count) if usize::try_from(count) != Ok(positions) => complaints.push(
            Complaint::new(format!("`count` is {count}, but there are {positions} positions"))
                .at(&root.locate(&[path[0], path[1], "count"]), format!("{positions} in `start.at.position`"))
                .hint("leave `count` out: with `start.at` it is the number of positions"),
        ),
        None if !typed => {
            group.insert("count".into(), Value::Integer(positions as i64));
        }
        _ => {}
    }
}

fn boxes(resolved: &mut toml::Table, root: &Node, complaints: &mut Vec<Complaint>) {
    let space = resolved.get("dimension").and_then(Value::as_integer) == Some(3);
    let diameters = table_at(resolved, "particles").into_iter().flat_map(|groups| groups.iter());
    let largest = diameters.filter_map(|(_, group)| group.get("diameter").and_then(Value::as_float)).reduce(f64::max);
    for (name, wall) in tables_in(resolved, "walls") {
        let path = ["walls", &name, "shape", "box", "depth"];
        let Some(shape) = wall.get_mut("shape").and_then(|shape| shape.get_mut("box")).and_then(Value::as_table_mut)
        else {
            continue;
        };
        if shape.contains_key("depth") || root.find(&path).is_some() {
            continue;
        }
        if space {
            complaints.push(
                Complaint::new(format!("missing key `depth` in [walls.{name}.shape.box]"))
                    .at(&root.locate(&path), "needs `depth`")
                    .hint("`depth`: Inner size along y; only a scene in the plane can do without"),
            );
        } else if let Some(depth) = largest.or_else(|| shape.get("width").and_then(Value::as_float)) {
            shape.insert("depth".into(), Value::Float(depth));
        }
    }
}

fn oscillators(resolved: &mut toml::Table, root: &Node, complaints: &mut Vec<Complaint>) {
    for (name, host) in tables_in(resolved, "hosts") {
        let path = ["hosts", &name, "structure", "oscillator"];
        let Some(oscillator) =
            host.get_mut("structure").and_then(|s| s.get_mut("oscillator")).and_then(Value::as_table_mut)
        else {
            continue;
        };
        let ratio = oscillator.remove("damping-ratio").and_then(|ratio| ratio.as_float());
        let number = |key: &str| oscillator.get(key).and_then(Value::as_float);
        if let (Some(ratio), Some(mass), Some(stiffness)) = (ratio, number("mass"), number("stiffness")) {
            oscillator.insert("damping".into(), Value::Float(2.0 * ratio * (stiffness * mass).sqrt()));
        }
        let typed = |key| root.find(&[path[0], path[1], path[2], path[3], key]).is_some();
        if !typed("damping") && !typed("damping-ratio") {
            complaints.push(
                Complaint::new(format!("missing key `damping` in [hosts.{name}.structure.oscillator]"))
                    .at(&root.locate(&path), "needs `damping` or `damping-ratio`")
                    .hint("`damping`: C, for example \"0.08 N s/m\"")
                    .hint("or `damping-ratio`: C over its critical value, for example 0.01"),
            );
        }
    }
}

fn settings(resolved: &mut toml::Table) {
    let duration = resolved.get("duration").and_then(Value::as_float);
    if let Some(lattice) = resolved.get_mut("lattice").and_then(Value::as_table_mut)
        && let Some(mode) = lattice.get("mode").and_then(Value::as_str)
    {
        let extended = mode == "extended";
        let collision = if extended { "pairwise" } else { "literal" };
        lattice.entry("resting-impulses").or_insert(Value::Boolean(extended));
        lattice.entry("collision").or_insert(Value::String(collision.to_string()));
    }
    if let (Some(output), Some(duration)) = (resolved.get_mut("output").and_then(Value::as_table_mut), duration) {
        output.entry("history-interval").or_insert(Value::Float(duration / 1000.0));
        output.entry("checkpoint-interval").or_insert(Value::Float(duration / 10.0));
    }
}

fn response(resolved: &mut toml::Table, root: &Node, complaints: &mut Vec<Complaint>) {
    let hosts: Vec<String> =
        table_at(resolved, "hosts").map(|hosts| hosts.keys().cloned().collect()).unwrap_or_default();
    let Some(response) = resolved.get_mut("response").and_then(Value::as_table_mut) else { return };
    if response.contains_key("host") || root.find(&["response", "host"]).is_some() {
        return;
    }
    match hosts.as_slice() {
        [host] => {
            response.insert("host".into(), Value::String(host.clone()));
        }
        [] => complaints.push(
            Complaint::new("a response needs a host to respond")
                .at(&root.locate(&["response"]), "there are no hosts in this scene")
                .hint("add [hosts.NAME], or leave [response] out"),
        ),
        many => complaints.push(
            Complaint::new("missing key `host` in [response]")
                .at(&root.locate(&["response"]), "needs `host`")
                .hint(format!("hosts here: {}", suggest::list(many.iter().map(String::as_str)))),
        ),
    }
}

/// Reads the files of all table signals and checks the tables that were typed.
fn signals(
    resolved: &mut toml::Table,
    root: &Node,
    files: &mut Files,
    sources: &mut Vec<Source>,
    complaints: &mut Vec<Complaint>,
) {
    let places: [(&str, &[&str], &Dimension); 3] =
        [("walls", &["motion", "signal"], &LENGTH), ("hosts", &["base"], &LENGTH), ("hosts", &["force"], &FORCE)];
    for (family, keys, dimension) in places {
        for (name, owner) in tables_in(resolved, family) {
            let mut path = vec![family, name.as_str()];
            let mut table = Some(owner);
            for key in keys.iter().copied().chain(["table"]) {
                path.push(key);
                table = table.and_then(|table| table.get_mut(key)).and_then(Value::as_table_mut);
            }
            let Some(table) = table else { continue };
            match table.remove("file") {
                Some(Value::String(file)) => {
                    from_file(table, &file, dimension, &path, (root, files), sources, complaints);
                }
                _ => typed_table(table, &path, root, complaints),
            }
        }
    }
}

fn from_file(
    table: &mut toml::Table,
    file: &str,
    dimension: &Dimension,
    path: &[&str],
    (root, files): (&Node, &mut Files),
    sources: &mut Vec<Source>,
    complaints: &mut Vec<Complaint>,
) {
    let path: Vec<&str> = path.iter().copied().chain(["file"]).collect();
    let asked = root.locate(&path);
    let text = match files.read(file) {
        Ok(text) => text,
        Err(reason) => {
            complaints.push(
                Complaint::new(format!("cannot read `{file}`: {reason}"))
                    .at(&asked, "named here")
                    .hint("the path starts at the folder of the scene file"),
            );
            return;
        }
    };
    let source = sources.len();
    sources.push(Source { name: file.to_string(), text: text.to_string(), numbered: true });
    match table::read(&text, source, dimension) {
        Ok(columns) => {
            let list = |numbers: Vec<f64>| Value::Array(numbers.into_iter().map(Value::Float).collect());
            table.insert("time".into(), list(columns.time));
            table.insert("value".into(), list(columns.value));
        }
        Err(wrong) => complaints.extend(wrong.into_iter().map(|complaint| complaint.also(&asked, "read from here"))),
    }
}

fn typed_table(table: &toml::Table, path: &[&str], root: &Node, complaints: &mut Vec<Complaint>) {
    let typed = |key: &str| root.find(&path.iter().copied().chain([key]).collect::<Vec<_>>()).is_some();
    if !typed("time") || !typed("value") {
        if !typed("file") {
            complaints.push(
                Complaint::new(format!("[{}] has no table", path.join(".")))
                    .at(&root.locate(path), "needs `file`, or `time` and `value`")
                    .hint("file = \"motion.csv\"")
                    .hint("or time = [0, 0.1, 0.2] and value = [0, 0.001, 0]"),
            );
        }
        return;
    }
    let numbers = |key: &str| -> Option<Vec<f64>> {
        table.get(key)?.as_array().map(|list| list.iter().filter_map(Value::as_float).collect())
    };
    let (Some(time), Some(value)) = (numbers("time"), numbers("value")) else { return };
    let place = |key: &str| root.locate(&path.iter().copied().chain([key]).collect::<Vec<_>>());
    if time.is_empty() || time.len() != value.len() {
        complaints.push(
            Complaint::new(format!("`{}` needs as many values as times", join(&path.join("."), "value")))
                .at(&place("value"), format!("{} values for {} times", value.len(), time.len())),
        );
    }
    if let Some(index) = time.windows(2).position(|pair| pair[0] >= pair[1]) {
        let item = (index + 1).to_string();
        let place = root.locate(&path.iter().copied().chain(["time", item.as_str()]).collect::<Vec<_>>());
        complaints.push(
            Complaint::new(format!("time does not rise: {} s after {} s", time[index + 1], time[index]))
                .at(&place, "must be later than the one before"),
        );
    }
}

fn table_at<'a>(resolved: &'a toml::Table, key: &str) -> Option<&'a toml::Table> {
    resolved.get(key).and_then(Value::as_table)
}

/// The user-named tables of a family, to be changed.
fn tables_in<'a>(resolved: &'a mut toml::Table, family: &str) -> Vec<(String, &'a mut toml::Table)> {
    let tables = resolved.get_mut(family).and_then(Value::as_table_mut);
    let entries = tables.into_iter().flat_map(|tables| tables.iter_mut());
    entries.filter_map(|(name, value)| Some((name.clone(), value.as_table_mut()?))).collect()
}
