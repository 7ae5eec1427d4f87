//! What `cohesion` is, a force or an energy density, where the pairs of a scene do not agree.
//!
//! Reading has checked the unit where the whole scene has one of the two parts.

use super::Parts;
use crate::complaint::Complaint;
use crate::node::Value;
use crate::plan::{Cohesion, Contact, MaterialPair, Strength};
use crate::units::{self, Dimension, ENERGY_DENSITY, FORCE};

/// What a part reads, and what the other one does.
fn reads(cohesion: &Cohesion) -> Option<[&'static Dimension; 2]> {
    match cohesion.strength()? {
        Strength::Force => Some([&FORCE, &ENERGY_DENSITY]),
        Strength::EnergyDensity => Some([&ENERGY_DENSITY, &FORCE]),
        Strength::SurfaceEnergy => None,
    }
}

pub(super) fn check(
    parts: &Parts<'_>,
    scene: &Contact,
    pairs: &[(String, MaterialPair)],
    complaints: &mut Vec<Complaint>,
) {
    let all = pairs.iter().filter_map(|(_, pair)| pair.contact.as_ref()).chain([scene]);
    let strengths: Vec<Strength> = all.filter_map(|contact| contact.cohesion.strength()).collect();
    if ![Strength::Force, Strength::EnergyDensity].iter().all(|strength| strengths.contains(strength)) {
        return;
    }
    let text = |path: &[&str]| match parts.root.find(path).map(|node| &node.value) {
        Some(Value::Text(text)) => Some(text.as_str()),
        _ => None,
    };
    // Whether what stands at `path` is what the other part reads.
    let other = |path: &[&str], [_, other]: [&Dimension; 2]| text(path).is_some_and(|t| units::read(t, other).is_ok());
    let of_scene = reads(&scene.cohesion);
    let materials = parts.resolved.get("materials").and_then(toml::Value::as_table);
    for name in materials.into_iter().flat_map(toml::Table::keys) {
        let path = ["materials", name, "cohesion"];
        if let Some(dimensions) = of_scene
            && other(&path, dimensions)
        {
            complaints.push(unlike(parts, &path, dimensions).hint("`[contact]` says so; a pair may have its own"));
        }
    }
    for (index, pair) in pairs {
        let contact = pair.contact.as_ref().unwrap_or(scene);
        let Some(dimensions) = reads(&contact.cohesion) else { continue };
        let own = ["material-pair", index, "cohesion"];
        if other(&own, dimensions) {
            complaints.push(unlike(parts, &own, dimensions).hint("the `contact` of the pair says so"));
        }
        if pair.cohesion.is_some() || of_scene == Some(dimensions) {
            continue;
        }
        for name in &pair.between {
            let path = ["materials", name, "cohesion"];
            if other(&path, dimensions) {
                let ([wanted, is], [a, b]) = (dimensions, &pair.between);
                complaints.push(
                    Complaint::new(format!("`cohesion` of `{a}` and `{b}` is {}, not {}", wanted.name, is.name))
                        .at(&parts.root.locate(&["material-pair", index, "contact", "cohesion"]), "chosen here")
                        .also(&parts.root.locate(&path), format!("the pair would read this, {}", is.name))
                        .hint(format!("give the pair a `cohesion` of its own, for example {}", wanted.examples_text())),
                );
                break;
            }
        }
    }
}

fn unlike(parts: &Parts<'_>, path: &[&str], [wanted, is]: [&Dimension; 2]) -> Complaint {
    Complaint::new(format!("`cohesion` is {} here, not {}", wanted.name, is.name))
        .at(&parts.root.locate(path), format!("needs {}, for example {}", wanted.name, wanted.examples_text()))
}
