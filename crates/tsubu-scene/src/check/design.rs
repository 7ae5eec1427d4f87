//! What a design needs: a response, and the cost of what a limit of cost counts.

use super::Parts;
use crate::complaint::Complaint;
use crate::suggest;

/// What is designed for is the response.
pub(super) fn check(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    costs(parts, complaints);
    let asked = |study| parts.root.find(&[study]).is_some();
    if asked("design") && !asked("response") {
        complaints.push(
            Complaint::new("a design is for a low response, and the scene has no `[response]`")
                .at(&parts.root.locate(&["design"]), "asked for here")
                .hint("add [response] with frequency-ratio = { from = 0.85, to = 1.15 }"),
        );
    }
}

/// A limit of cost needs the cost of all that is used; a cost is that of a material.
fn costs(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    let Some(design) = parts.resolved.get("design") else { return };
    let told = design.get("cost").and_then(toml::Value::as_table);
    let materials = parts.resolved.get("materials").and_then(toml::Value::as_table);
    for name in told.into_iter().flat_map(toml::Table::keys) {
        if materials.is_some_and(|materials| !materials.contains_key(name)) {
            let known = materials.into_iter().flat_map(toml::Table::keys).map(String::as_str);
            complaints.push(
                Complaint::new(format!("`design.cost` has a material `{name}` that is not in [materials]"))
                    .at(&parts.root.locate(&["design", "cost", name]), "no such material")
                    .hint(format!("materials here: {}", suggest::list(known))),
            );
        }
    }
    if design.get("cost-limit").is_none() {
        return;
    }
    for group in parts.particles.values() {
        let name = &group.material;
        if !told.is_some_and(|told| told.contains_key(name)) {
            complaints.push(
                Complaint::new(format!("`design.cost-limit` needs the cost of `{name}`, of which grains are made"))
                    .at(&parts.root.locate(&["design", "cost-limit"]), "a limit for the cost of all grains")
                    .hint(format!("add [design.cost] with {name}.per-kilogram = 3 or {name}.per-grain = 0.02")),
            );
            return;
        }
    }
}
