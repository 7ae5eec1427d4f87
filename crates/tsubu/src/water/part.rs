//! A part: one force of the water.

use super::Parcel;
use crate::about::About;

/// What becomes of the work of a force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WorkKind {
    /// All of it is the grain's: pressure.
    Pressure,
    /// It goes with the motion relative to the water: to a grain that goes along with the stream it does the stream's work,
    /// what is missing from that is lost.
    Relative,
    /// The same for a torque and the spin relative to that of the water; the part writes a torque and no force.
    Turning,
}

/// One force of the water on grains.
///
/// A part reads the columns of the parcel and writes its force (or its torque) into it. It knows nothing of other parts, of
/// threads, or of the books.
pub trait Part: Send + Sync + std::fmt::Debug {
    /// Its text.
    fn about(&self) -> &'static About;

    /// What becomes of its work.
    fn kind(&self) -> WorkKind;

    /// Whether it reads spins, of the grains or of the water, or writes a torque.
    fn rotates(&self) -> bool {
        self.kind() == WorkKind::Turning
    }

    /// Writes the force or torque on every grain of the parcel.
    fn apply(&self, parcel: &mut Parcel);
}
