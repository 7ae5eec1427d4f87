//! Studies: many runs that answer one question.

pub mod cases;
pub mod compare;
pub mod response;
pub mod ring_down;
pub mod sweep;
pub mod variant;

use tsubu_scene::plan::{Plan, Start};

/// The same plan with grains left where they are dropped from: for a bed that is settled already, or need not be.
pub(crate) fn unsettled(plan: &Plan) -> Plan {
    let mut plan = plan.clone();
    for group in plan.particles.values_mut() {
        if let Start::Settled { time } = &mut group.start {
            *time = 0.0;
        }
    }
    plan
}
