//! The verdict on what a scene asks for and will not get: parts of the contact law that do nothing, walls that would vanish and files that
//! would be written after the end, hosts that carry nothing.

use super::{Bodies, Verdict};
use crate::contact::Table;
use tsubu_scene::plan::{Plan, Rolling, Strength, Twisting};

/// Judges the contact law of every pair of bodies that can touch.
pub(super) fn parts(verdict: &mut Verdict, plan: &Plan, table: &Table, bodies: &Bodies) {
    // For each part: where the coefficient is, and the largest coefficient of the pairs whose law has it.
    let mut found: [Option<(&str, &str, f64)>; 3] = [None; 3];
    let mut told = [
        ("rolling", "rolling-friction", 0.0_f64),
        ("twisting", "twisting-friction", 0.0),
        ("cohesion", "surface-energy", 0.0),
        ("cohesion", "cohesion", 0.0),
    ];
    for (a, b) in bodies.pairs() {
        let law = plan.contact_of(table.name(a.material), table.name(b.material));
        let constants = table.pair(a.body(), b.body()).constants;
        let rolling = (law.rolling != Rolling::None {}).then_some(("rolling", "rolling-friction", constants.rolling));
        let twisting =
            (law.twisting != Twisting::None {}).then_some(("twisting", "twisting-friction", constants.twisting));
        let cohesion = law.cohesion.strength().map(|strength| match strength {
            Strength::SurfaceEnergy => ("cohesion", "surface-energy", constants.surface_energy),
            Strength::Force | Strength::EnergyDensity => ("cohesion", "cohesion", constants.cohesion),
        });
        let all = [constants.rolling, constants.twisting, constants.surface_energy, constants.cohesion];
        told.iter_mut().zip(all).for_each(|((.., most), one)| *most = most.max(one));
        for (found, part) in found.iter_mut().zip([rolling, twisting, cohesion]) {
            if let Some(part) = part.filter(|part| found.is_none_or(|found| found.2 < part.2)) {
                *found = Some(part);
            }
        }
    }
    for (part, key, _) in told.into_iter().filter(|(.., most)| *most > 0.0) {
        if !found.iter().flatten().any(|(known, ..)| *known == part) {
            verdict.judge(
                false,
                format!("`{key}` of materials does nothing: no pair that can touch has a `contact.{part}`"),
                || format!("`contact.{part}`, or leave `{key}` out"),
            );
        }
    }
    for (part, key, largest) in found.into_iter().flatten() {
        let out = format!("leave `contact.{part}` out");
        let (why, advice) = if part != "cohesion" && !plan.contact.rotation {
            ("grains do not spin, `contact.rotation` is false".to_owned(), out)
        } else if part == "twisting" && plan.dimension == 2 {
            ("grains in the plane do not spin about a normal".to_owned(), out)
        } else if largest == 0.0 {
            let told = format!("`materials.NAME.{key}`, or that of a `[[material-pair]]`; or {out}");
            (format!("`{key}` is 0 for all that touch"), told)
        } else {
            continue;
        };
        verdict.judge(false, format!("`contact.{part}` does nothing: {why}"), || advice);
    }
}

/// Judges the gates.
pub(super) fn gates(verdict: &mut Verdict, plan: &Plan) {
    // In a run of stages a wall may vanish in another one.
    if plan.stage.len() > 1 {
        return;
    }
    let end = plan.duration;
    for (name, wall) in &plan.walls {
        if let Some(until) = wall.until.filter(|until| *until >= end) {
            verdict.judge(
                false,
                format!("wall `{name}` never vanishes: `until` is {until} s, the run ends at {end} s"),
                || format!("`duration`, or `walls.{name}.until`"),
            );
        }
    }
}

/// Judges how often files are written, and whether hosts carry walls.
pub(super) fn outputs(verdict: &mut Verdict, plan: &Plan) {
    let end = plan.duration;
    let intervals =
        [("history-interval", Some(plan.output.history_interval)), ("frame-interval", plan.output.frame_interval)];
    for (key, interval) in intervals.into_iter().filter_map(|(key, interval)| Some((key, interval?))) {
        // A stage may be shorter than what all of them are looked at by.
        if interval > end && plan.stage.len() <= 1 {
            verdict.judge(
                false,
                format!("`output.{key}` is {interval} s, the run ends at {end} s: it writes its begin alone"),
                || format!("`output.{key}`"),
            );
        }
    }
    let formats = [("xyz", plan.output.xyz), ("lammps", plan.output.lammps)];
    for (key, _) in formats.into_iter().filter(|(_, wanted)| *wanted && plan.output.frame_interval.is_none()) {
        verdict.judge(false, format!("`output.{key}` writes nothing: there are no frames"), || {
            "`output.frame-interval`".to_owned()
        });
    }
    for name in plan.hosts.keys() {
        if !plan.walls.values().any(|wall| wall.host.as_ref() == Some(name)) {
            verdict.judge(
                false,
                format!("no wall hangs on the host `{name}`: it moves, and no grain feels it"),
                || format!("`host = \"{name}\"` in a table of walls"),
            );
        }
    }
}
