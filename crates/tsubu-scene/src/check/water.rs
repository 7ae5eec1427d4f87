//! Water and what is in it.

use super::Parts;
use super::place::millimetres;
use crate::complaint::Complaint;
use crate::plan::{Drag, Flow, GrainMotion, GrainShape, Hindrance, Lid, Lift, Particles, Start, Torque, Water};

pub(super) fn check(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    let Some(water) = parts.resolved.get("water").and_then(|water| water.clone().try_into::<Water>().ok()) else {
        return;
    };
    let at = |keys: &[&str]| parts.root.locate(&[&["water"], keys].concat());
    for (name, group) in &parts.particles {
        let here = parts.root.locate(&["particles", name]);
        if group.shape.is_flat() {
            complaints.push(flat(parts, name, group));
            continue;
        }
        if group.shape.is_clump() {
            not_round(parts, &water, name, group, complaints);
        }
        let density = group.mass / group.shape.mass(1.0, group.diameter);
        if density <= water.density && !water.float {
            complaints.push(
                Complaint::new(format!("the grains `{name}` are lighter than the water"))
                    .at(&here, format!("{density:.6} kg/m^3"))
                    .also(&at(&["density"]), format!("{} kg/m^3", water.density))
                    .hint("if they shall float write float = true in [water]"),
            );
        }
    }
    turning(parts, &water, complaints);
    crowd(&water, parts, complaints);
    match &water.flow {
        Flow::Still {} => {}
        Flow::Coupled { bottom, top, shear_velocity, discharge, lid: ends, reach, .. } => {
            if reach.is_some() && (*ends != Lid::Free || discharge.is_none()) {
                complaints.push(
                    Complaint::new("a `reach` is fed by a `discharge` under a free surface")
                        .at(&at(&["flow", "coupled", "reach"]), "this stream has not both")
                        .hint("give lid = \"free\" and a `discharge`, or leave `reach` out"),
                );
            }
            let along = parts.resolved.get("gravity").and_then(|g| g.get(0)).and_then(toml::Value::as_float);
            if *ends == Lid::Free {
                free_surface(parts, &water, along, complaints);
            } else {
                lid(parts, *bottom, *top, complaints);
            }
            if shear_velocity.is_none() && discharge.is_none() && along.is_none_or(|along| along <= 0.0) {
                complaints.push(
                    Complaint::new("nothing drives the stream")
                        .at(&at(&["flow", "coupled"]), "no slope, no `shear-velocity`, no `discharge`")
                        .hint("give slope = \"3 deg\" at the top, or `shear-velocity` or `discharge` here"),
                );
            }
        }
        Flow::Column { bottom, top, .. } => lid(parts, *bottom, *top, complaints),
        Flow::LogLaw { zero_level, .. } => {
            if let Some(surface) = water.surface.filter(|surface| surface <= zero_level) {
                complaints.push(
                    Complaint::new("the stream has no depth")
                        .at(&at(&["surface"]), format!("at z = {}", millimetres(surface)))
                        .also(
                            &at(&["flow", "log-law", "zero-level"]),
                            format!("the bed is at z = {}", millimetres(*zero_level)),
                        ),
                );
            }
        }
        Flow::Table { height, velocity } => {
            if height.is_empty() || height.len() != velocity.len() {
                complaints.push(
                    Complaint::new("the profile of the stream needs as many velocities as heights").at(
                        &at(&["flow", "table"]),
                        format!("{} heights, {} velocities", height.len(), velocity.len()),
                    ),
                );
            } else if let Some(k) = (1..height.len()).find(|&k| height[k] <= height[k - 1]) {
                complaints.push(Complaint::new("the heights of the profile of the stream do not rise").at(
                    &at(&["flow", "table", "height"]),
                    format!("{} after {}", millimetres(height[k]), millimetres(height[k - 1])),
                ));
            }
        }
    }
}

/// Discs and polygons have no volume that water could be displaced by.
fn flat(parts: &Parts<'_>, name: &str, group: &Particles) -> Complaint {
    let (plural, key, instead) = match &group.shape {
        GrainShape::Disc { .. } => ("discs", "disc", "spheres whose centres stay in the plane"),
        shape => {
            let key = shape.clump_key().unwrap_or("polygon");
            (shape.plural(), key, "spheres, or shape.polyhedron with dimension = 3")
        }
    };
    Complaint::new(format!("the grains `{name}` are {plural}; drag and buoyancy are those of bodies with a volume"))
        .at(&parts.root.locate(&["particles", name, "shape", key]), "not in water")
        .also(&parts.root.locate(&["water"]), "there is water")
        .hint(format!("write shape.sphere = {{}}: {instead}"))
}

/// What is known of spheres alone.
fn not_round(parts: &Parts<'_>, water: &Water, name: &str, group: &Particles, complaints: &mut Vec<Complaint>) {
    let shape = group.shape.clump_key().unwrap_or("sphere");
    let body = parts.root.locate(&["particles", name, "shape", shape]);
    if let Some(law) = water.drag.of_spheres() {
        complaints.push(
            Complaint::new(format!(
                "the grains `{name}` are {}; the drag `{law}` is that of spheres",
                group.shape.plural()
            ))
            .at(&parts.root.locate(&["water", "drag"]), "knows no other bodies")
            .also(&body, "no sphere")
            .hint("write drag.haider-levenspiel = {} in [water]: it goes by how round a body is"),
        );
    }
    if !water.lift.is_empty() {
        complaints.push(
            Complaint::new(format!("the grains `{name}` are {}; a lift is that of spheres", group.shape.plural()))
                .at(&parts.root.locate(&["water", "lift"]), "knows no other bodies")
                .also(&body, "no sphere")
                .hint("leave `lift` out"),
        );
    }
}

/// What needs grains that spin, and lifts that exclude each other.
fn turning(parts: &Parts<'_>, water: &Water, complaints: &mut Vec<Complaint>) {
    let at = |keys: &[&str]| parts.root.locate(keys);
    let contact = parts.resolved.get("contact").and_then(toml::Value::as_table);
    let locked = contact.and_then(|contact| contact.get("rotation")).and_then(toml::Value::as_bool) == Some(false);
    let torque = match water.torque {
        Torque::None {} => None,
        Torque::Stokes {} => Some("stokes"),
        Torque::FiniteReynolds {} => Some("finite-reynolds"),
    };
    let torque = torque.map(|name| (format!("`water.torque.{name}`"), at(&["water", "torque", name])));
    let lift = |lift: Lift| water.lift.contains(&lift);
    let magnus = [(Lift::Magnus, "magnus"), (Lift::MagnusOesterleDinh, "magnus-oesterle-dinh")]
        .into_iter()
        .filter(|(word, _)| lift(*word))
        .map(|(_, name)| (format!("`{name}` in `water.lift`"), at(&["water", "lift"])));
    for (name, place) in torque.into_iter().chain(magnus).filter(|_| locked) {
        complaints.push(
            Complaint::new(format!("{name} is for grains that spin"))
                .at(&place, "acts on spin")
                .also(&at(&["contact", "rotation"]), "they do not")
                .hint("leave it out, or write rotation = true in [contact]"),
        );
    }
    for (slow, any, what, names) in [
        (Lift::Saffman, Lift::SaffmanMei, "shear", ["saffman", "saffman-mei"]),
        (Lift::Magnus, Lift::MagnusOesterleDinh, "spin", ["magnus", "magnus-oesterle-dinh"]),
    ] {
        if lift(slow) && lift(any) {
            complaints.push(
                Complaint::new(format!("the lift by {what} would be counted twice"))
                    .at(&at(&["water", "lift"]), format!("`{}` is `{}`, corrected", names[1], names[0]))
                    .hint(format!("leave one of them out; `{}` alone is for slow flow", names[0])),
            );
        }
    }
}

/// What a crowd of grains does to the drag needs to be known where the crowd is.
fn crowd(water: &Water, parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    let at = |keys: &[&str]| parts.root.locate(&[&["water"], keys].concat());
    let hinders = water.hindrance != (Hindrance::None {});
    let crowded = matches!(water.drag, Drag::Gidaspow {});
    let key = if crowded { "drag" } else { "hindrance" };
    if (hinders || crowded) && water.flow.ends().is_none() {
        complaints.push(
            Complaint::new(format!("`{key}` asks how much room the grains leave to the water, which only layers know"))
                .at(&at(&[key]), "needs layers")
                .also(&at(&["flow"]), "has none")
                .hint("use flow.coupled or flow.column"),
        );
    }
    if hinders && crowded {
        complaints.push(
            Complaint::new("`drag.gidaspow` has the crowd in it; `hindrance` would count it twice")
                .at(&at(&["hindrance"]), "leave it out"),
        );
    }
}

/// What does not go with a surface that finds its level.
fn free_surface(parts: &Parts<'_>, water: &Water, along: Option<f64>, complaints: &mut Vec<Complaint>) {
    let at = |keys: &[&str]| parts.root.locate(&[&["water"], keys].concat());
    let Flow::Coupled { top, discharge, .. } = water.flow else { return };
    if water.surface != Some(top) {
        complaints.push(
            Complaint::new("a free surface is where the water ends, and begins at `top`")
                .at(&at(&["surface"]), "another surface")
                .also(&at(&["flow", "coupled", "lid"]), "finds its level")
                .hint("leave out `surface`"),
        );
    }
    if discharge.is_some() && along.is_none_or(|along| along <= 0.0) {
        complaints.push(
            Complaint::new("with a free surface nothing but the slope drives what the discharge brings")
                .at(&at(&["flow", "coupled", "discharge"]), "comes in")
                .also(&at(&["flow", "coupled", "lid"]), "no pressure along the stream")
                .hint("give slope = \"3 deg\" at the top, or lid = \"rigid\""),
        );
    }
}

/// Grains that begin outside water that ends at a lid.
fn lid(parts: &Parts<'_>, bottom: f64, top: f64, complaints: &mut Vec<Complaint>) {
    for (name, group) in &parts.particles {
        let Start::At { position, .. } = &group.start else { continue };
        let r = 0.5 * group.diameter;
        let free = matches!(group.motion, GrainMotion::Free {});
        if let Some((k, p)) = position.iter().enumerate().find(|(_, p)| free && (p[2] - r > top || p[2] + r < bottom)) {
            complaints.push(
                Complaint::new(format!("a grain of `{name}` begins outside the water"))
                    .at(
                        &parts.root.locate(&["particles", name, "start", "at", "position", &k.to_string()]),
                        format!("at z = {}", millimetres(p[2])),
                    )
                    .also(
                        &parts.root.locate(&["water", "flow"]),
                        format!("from z = {} to {}", millimetres(bottom), millimetres(top)),
                    ),
            );
        }
    }
}
