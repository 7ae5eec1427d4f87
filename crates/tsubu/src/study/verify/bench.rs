//! Small scenes for verification cases, made in code where a scene file would hide the point.

use tsubu_scene::{Plan, Scene};

/// The plan of a scene text that is part of the program.
pub(super) fn plan(text: &str) -> Result<Plan, String> {
    let scene = Scene::parse("verification case", text, std::path::Path::new("."), &[]).map_err(|c| c.to_string())?;
    Ok(scene.plan().clone())
}

/// Multiplies the constants of the contact law: stiffness and restitution.
pub(super) fn spoil(plan: &mut Plan, factor: f64) {
    for material in plan.materials.values_mut() {
        material.young_modulus *= factor;
        material.restitution *= factor;
    }
    if let tsubu_scene::plan::Normal::Hooke { stiffness } = &mut plan.contact.normal {
        *stiffness *= factor;
    }
}

/// The changes that multiply stiffness and restitution of every material of a scene text.
pub(super) fn spoiled_materials(text: &str, factor: f64) -> Result<Vec<String>, String> {
    if factor == 1.0 {
        return Ok(Vec::new());
    }
    let mut changes = Vec::new();
    for (name, material) in plan(text)?.materials {
        changes.push(format!("materials.{name}.young-modulus={:e}", material.young_modulus * factor));
        changes.push(format!("materials.{name}.restitution={}", material.restitution * factor));
    }
    Ok(changes)
}
