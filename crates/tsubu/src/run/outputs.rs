//! What a run writes as it goes.

use tsubu_frame::{Formats, FrameWriter, History};
use tsubu_scene::Plan;

/// What grows as the run goes.
pub(super) struct Outputs {
    pub history: History,
    pub frames: FrameWriter,
}

/// What is written in frames beside grains and walls.
pub(crate) const fn formats(plan: &Plan) -> Formats {
    Formats { contacts: plan.output.contacts, xyz: plan.output.xyz, lammps: plan.output.lammps }
}
