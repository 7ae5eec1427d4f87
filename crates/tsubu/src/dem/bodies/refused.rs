//! What scenes with bodies that are no spheres cannot have yet.

use crate::engine::{Note, Refusal, Verdict};
use tsubu_scene::plan::{GrainShape, Integrator, Measure, Particles, Plan, Quantity, Shape};

/// Refuses it by name.
pub(in crate::dem) fn refused(plan: &Plan) -> Result<(), Refusal> {
    if !plan.particles.values().any(|group| group.shape.is_clump()) {
        return Ok(());
    }
    let mut notes = Vec::new();
    let mut refuse =
        |key: String, text: &str| notes.push(Note { key, verdict: Verdict::Refused, text: text.to_owned() });
    if plan.dem.integrator != Integrator::VelocityVerlet {
        let text = "bodies that are no spheres are moved by `velocity-verlet` alone; leave the key out";
        refuse("dem.integrator".to_owned(), text);
    }
    if !plan.contact.rotation {
        refuse("contact.rotation".to_owned(), "bodies that are no spheres turn; leave the key out");
    }
    one_piece(plan, refuse);
    if notes.is_empty() { Ok(()) } else { Err(Refusal { method: "dem", notes }) }
}

/// What goes with clumps, but not with superellipsoids, polyhedra and polygons.
fn one_piece(plan: &Plan, mut refuse: impl FnMut(String, &str)) {
    let round = |group: &Particles| matches!(group.shape, GrainShape::Superellipsoid { .. });
    let groups = || plan.particles.iter().filter(|(_, group)| round(group) || group.shape.is_polyhedron());
    let Some((_, first)) = groups().next() else { return };
    let plural = first.shape.plural();
    if let Some((name, group)) = groups().find(|(_, group)| round(group) != round(first)) {
        let text =
            format!("{} and {plural} in one scene cannot touch yet; leave one of them out", group.shape.plural());
        refuse(format!("particles.{name}.shape"), &text);
    }
    for (name, wall) in &plan.walls {
        if !matches!(wall.shape, Shape::Plane { .. } | Shape::Box { .. }) {
            let text = format!(
                "{plural} touch planes and boxes alone yet; build it of these, or write shape.clump for the grains"
            );
            refuse(format!("walls.{name}.shape"), &text);
        }
    }
    for (name, _) in groups().filter(|(name, _)| plan.bond.iter().any(|bond| bond.joins(name))) {
        let text = format!("bonds hold spheres and clumps together, no {plural} yet; write shape.clump");
        refuse(format!("particles.{name}.shape"), &text);
    }
    for (name, watch) in &plan.watch {
        let volumes = match &watch.measure {
            Measure::Profile(profile) => profile.quantities.contains(&Quantity::SolidFraction),
            Measure::Bedload(_) | Measure::StressPath(_) => true,
            _ => false,
        };
        if volumes {
            let text = format!(
                "it takes grains for spheres, whose volumes are not those of {plural}; leave it, or its `solid-fraction`, out"
            );
            refuse(format!("watch.{name}"), &text);
        }
    }
}
