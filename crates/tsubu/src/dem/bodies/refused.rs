//! What scenes with bodies that are no spheres cannot have yet.

use crate::engine::{Note, Refusal, Verdict};
use tsubu_scene::plan::{Integrator, Plan};

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
    if notes.is_empty() { Ok(()) } else { Err(Refusal { method: "dem", notes }) }
}
