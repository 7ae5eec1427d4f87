//! Values that follow from others: masses from densities, counts from positions, tables from files.

mod columns;
mod curve;
mod films;
mod grains;
mod hosts;
mod matrix_files;
mod random;
mod rayleigh;
mod regions;
mod signals;
mod walls;
mod watch;
mod water;

use super::{explain, join, table};
use crate::complaint::{Complaint, Source};
use crate::files::Files;
use crate::keys::{self, Key};
use crate::node::Node;
use crate::suggest;
use toml::Value;

/// What is looked at while values are found.
struct Derive<'a> {
    root: &'a Node,
    files: &'a mut Files,
    sources: &'a mut Vec<Source>,
    complaints: Vec<Complaint>,
}

/// How near frequencies beside the highest come to it where none say how near.
const PEAK_WITHIN: f64 = 0.01;

/// Fills what the registry calls derived. Wrong values are already complained about and absent here; the typed tree
/// tells what is absent because nobody gave it.
pub(crate) fn derive(
    resolved: &mut toml::Table,
    root: &Node,
    files: &mut Files,
    sources: &mut Vec<Source>,
) -> Vec<Complaint> {
    let mut derive = Derive { root, files, sources, complaints: Vec::new() };
    derive.slope(resolved);
    derive.particles(resolved);
    derive.water(resolved);
    derive.walls(resolved);
    derive.hosts(resolved);
    derive.signals(resolved);
    derive.films(resolved);
    settings(resolved, root);
    derive.regions(resolved);
    derive.watches(resolved);
    derive.host_of_study(resolved, "response", "a response needs a host to respond");
    derive.host_of_study(resolved, "atlas", "an atlas needs a host whose walls are shaken");
    derive.response(resolved);
    derive.curve(resolved);
    derive.complaints
}

impl Derive<'_> {
    fn complain(&mut self, complaint: Complaint) {
        self.complaints.push(complaint);
    }

    fn typed(&self, path: &[&str]) -> bool {
        self.root.find(path).is_some()
    }

    /// The fingerprint of a file; a resolved scene carries the one of the file it was run with.
    fn fingerprint(&mut self, table: &mut toml::Table, path: &[&str], name: &str) {
        let Some(found) = self.files.fingerprint(name) else { return };
        let typed = table.insert("fingerprint".into(), Value::String(found.clone()));
        if let Some(typed) = typed.as_ref().and_then(Value::as_str)
            && !typed.eq_ignore_ascii_case(&found)
        {
            let place = self.root.locate(&path.iter().copied().chain(["fingerprint"]).collect::<Vec<_>>());
            self.complain(
                Complaint::new(format!("`{name}` is not the file that this scene was written for"))
                    .at(&place, format!("the file's is {found}"))
                    .hint("leave `fingerprint` out to take the file as it is now"),
            );
        }
    }

    /// Complaints about a file: they point into it, or else at where it is named.
    fn file_is_wrong(&mut self, wrong: Vec<Complaint>, path: &[&str]) {
        let asked = self.root.locate(path);
        self.complaints.extend(wrong.into_iter().map(|complaint| match complaint.place() {
            Some(_) => complaint.also(&asked, "read from here"),
            None => complaint.at(&asked, "named here"),
        }));
    }

    fn response(&mut self, resolved: &mut toml::Table) {
        let Some(response) = resolved.get_mut("response").and_then(Value::as_table_mut) else { return };
        let ratios = |end| self.typed(&["response", "frequency-ratio", end]);
        let apart = response.get("path").and_then(Value::as_str) == Some("apart");
        if apart && ratios("from") && !ratios("step") && !self.typed(&["response", "peak-within"]) {
            response.insert("peak-within".into(), Value::Float(PEAK_WITHIN));
        }
        let host = response.get("host").and_then(Value::as_str).unwrap_or_default().to_owned();
        if !response.contains_key("keep") && !self.typed(&["response", "keep"]) {
            response.insert("keep".into(), self.kept(&host));
        }
    }

    /// What of a base motion stays the same where nobody says it: what its sine is given by.
    fn kept(&self, host: &str) -> Value {
        let given = |key: &&str| self.typed(&["hosts", host, "base", "sine", key]);
        Value::String(["velocity", "acceleration"].into_iter().find(given).unwrap_or("displacement").into())
    }

    /// A study of a host is of the only one where it names none.
    fn host_of_study(&mut self, resolved: &mut toml::Table, study: &str, needs: &str) {
        let hosts = hosts(resolved);
        if let Some(table) = resolved.get_mut(study).and_then(Value::as_table_mut) {
            self.only_host(table, &hosts, &[study], needs, &format!("add [hosts.NAME], or leave [{study}] out"));
        }
    }

    /// What is of a host is of the only one, where it names none.
    fn only_host(&mut self, table: &mut toml::Table, hosts: &[String], path: &[&str], needs: &str, hint: &str) {
        if table.contains_key("host") || self.typed(&[path, &["host"]].concat()) {
            return;
        }
        let place = self.root.locate(path);
        match hosts {
            [host] => {
                table.insert("host".into(), Value::String(host.clone()));
            }
            [] => self.complain(Complaint::new(needs).at(&place, "there are no hosts in this scene").hint(hint)),
            many => self.complain(
                Complaint::new(format!("missing key `host` in [{}]", path.join(".")))
                    .at(&place, "needs `host`")
                    .hint(format!("hosts here: {}", suggest::list(many.iter().map(String::as_str)))),
            ),
        }
    }
}

fn list(numbers: Vec<f64>) -> Value {
    Value::Array(numbers.into_iter().map(Value::Float).collect())
}

fn numbers(table: &toml::Table, key: &str) -> Option<Vec<f64>> {
    table.get(key)?.as_array().map(|list| list.iter().filter_map(Value::as_float).collect())
}

/// The names of all hosts.
fn hosts(resolved: &toml::Table) -> Vec<String> {
    table_at(resolved, "hosts").map(|hosts| hosts.keys().cloned().collect()).unwrap_or_default()
}

fn settings(resolved: &mut toml::Table, root: &Node) {
    let duration = resolved.get("duration").and_then(Value::as_float);
    if let Some(lattice) = resolved.get_mut("lattice").and_then(Value::as_table_mut)
        && let Some(mode) = lattice.get("mode").and_then(Value::as_str)
    {
        let extended = mode == "extended";
        let collision = if extended { "pairwise" } else { "literal" };
        lattice.entry("resting-impulses").or_insert(Value::Boolean(extended));
        lattice.entry("collision").or_insert(Value::String(collision.to_string()));
    }
    let turns = resolved.get("contact").and_then(|contact| contact.get("rotation")).and_then(Value::as_bool);
    let groups = resolved.get("particles").and_then(Value::as_table);
    let cells = groups.is_some_and(|groups| groups.values().any(tells_cells));
    if let Some(cl_ca) = resolved.get_mut("cl-ca").and_then(Value::as_table_mut) {
        cl_ca.entry("turning").or_insert(Value::Boolean(turns == Some(true) && cells));
    }
    if let (Some(output), Some(duration)) = (resolved.get_mut("output").and_then(Value::as_table_mut), duration) {
        output.entry("history-interval").or_insert(Value::Float(duration / 1000.0));
        output.entry("checkpoint-interval").or_insert(Value::Float(duration / 10.0));
    }
    // Ai 2011: k_r = 2.25 k_n (mu_r R)^2 for spheres, 3 k_n (mu_r R)^2 for discs.
    let ratio = if is_space(resolved) { 2.25 } else { 3.0 };
    let scene = resolved.get_mut("contact").and_then(Value::as_table_mut).map(|contact| {
        rolling_ratio(contact, ratio);
        contact.clone()
    });
    let pairs = resolved.get_mut("material-pair").and_then(Value::as_array_mut).into_iter().flatten();
    for (index, pair) in pairs.enumerate() {
        let Some(contact) = pair.get_mut("contact").and_then(Value::as_table_mut) else { continue };
        rolling_ratio(contact, ratio);
        let index = index.to_string();
        let typed = |key: &str| root.find(&["material-pair", &index, "contact", key]).is_some();
        for (key, value) in scene.iter().flatten().filter(|(key, _)| !typed(key)) {
            contact.insert(key.clone(), value.clone());
        }
    }
}

fn tells_cells(group: &Value) -> bool {
    group.get("shape").is_some_and(|shape| shape.get("cells").is_some())
}

fn rolling_ratio(contact: &mut toml::Table, ratio: f64) {
    let epsd = contact.get_mut("rolling").and_then(|rolling| rolling.get_mut("epsd"));
    if let Some(epsd) = epsd.and_then(Value::as_table_mut) {
        epsd.entry("ratio").or_insert(Value::Float(ratio));
    }
}

fn is_space(resolved: &toml::Table) -> bool {
    resolved.get("dimension").and_then(Value::as_integer) == Some(3)
}

/// A key of a table in one line, as in the complaints about required keys.
fn explained(keys: &'static [Key], name: &str) -> String {
    keys::find(keys, name).map(explain).unwrap_or_default()
}

fn table_at<'a>(resolved: &'a toml::Table, key: &str) -> Option<&'a toml::Table> {
    resolved.get(key).and_then(Value::as_table)
}

/// The groups of grains in the order of their names: nothing hangs on the order in which a scene tells them.
fn groups_by_name(resolved: &toml::Table) -> Vec<(&String, &Value)> {
    let mut groups: Vec<_> = table_at(resolved, "particles").into_iter().flatten().collect();
    groups.sort_by_key(|(name, _)| *name);
    groups
}

/// The user-named tables of a family, to be changed.
fn tables_in<'a>(resolved: &'a mut toml::Table, family: &str) -> Vec<(String, &'a mut toml::Table)> {
    let tables = resolved.get_mut(family).and_then(Value::as_table_mut);
    let entries = tables.into_iter().flat_map(|tables| tables.iter_mut());
    entries.filter_map(|(name, value)| Some((name.clone(), value.as_table_mut()?))).collect()
}
