//! A part: one ingredient of a contact law.

use super::chunk::{Chunk, Column};
use super::pair::{Constants, Pair};
pub use crate::about::About;

/// When a part acts within its law; parts are sorted by it, so a scene cannot misorder them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// Elastic normal force.
    Normal,
    /// Attraction.
    Cohesion,
    /// Damping of the normal motion.
    Damping,
    /// Tangential force.
    Tangential,
    /// Rolling resistance.
    Rolling,
    /// Resistance against spin about the normal.
    Twisting,
    /// Liquid between the bodies: last, as friction does not see what it bears.
    Film,
}

/// What a part wants from the engine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Needs {
    /// Relative rolling: fills the column `roll`.
    pub roll: bool,
    /// Relative spin about the normal: fills the column `twist`.
    pub twist: bool,
}

impl Needs {
    /// Both.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self { roll: self.roll || other.roll, twist: self.twist || other.twist }
    }
}

/// One entry of a contact's history, by what happens to it when the two bodies change places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slot {
    /// Stays as it is: a number that does not know which body is the first.
    Even,
    /// Changes its sign: a component of a force or torque on the first body.
    Odd,
}

/// One ingredient of a contact law.
///
/// A part reads geometry, constants and the results of earlier stages from the chunk and adds its own. It knows nothing
/// of grains, walls, dimensions, threads or of how its history is kept.
pub trait Part: Send + Sync + std::fmt::Debug {
    /// Its text.
    fn about(&self) -> &'static About;

    /// When it acts.
    fn stage(&self) -> Stage;

    /// What it needs: as a rule what it acts against.
    fn needs(&self) -> Needs {
        Needs { roll: self.stage() == Stage::Rolling, twist: self.stage() == Stage::Twisting }
    }

    /// The columns of history that it keeps; zero at first touch.
    fn history(&self) -> &'static [Slot] {
        &[]
    }

    /// How far apart [m] bodies of this pair may be and still hold each other; 0 for laws that end with the overlap.
    /// Such a part is called for every row within reach, touching or not.
    fn reach(&self, _pair: &Pair) -> f64 {
        0.0
    }

    /// Finds the numbers that are the same for a pair of materials; called once per pair, in the order of stages.
    fn prepare(&self, _constants: &mut Constants) {}

    /// Writes what the verdict on the time step wants to know of a pair of bodies; called in the order of stages.
    fn judge(&self, _pair: &mut Pair) {}

    /// Acts on all rows; its history begins at column `at`; `dt` is the time step [s].
    fn apply(&self, chunk: &mut Chunk, at: usize, dt: f64);

    /// Adds the slope of the energy that each row stores over its effective radius, at the same overlap [N]: what it takes to roll to where bodies
    /// are less round. Asked for bodies that are no spheres, after the law has acted.
    fn energy_slopes(&self, _chunk: &Chunk, _slopes: &mut Column) {}

    /// Energy [J] that a history still holds; it is lost when the contact opens. `history` begins with this part's.
    fn held(&self, _history: &[f64]) -> f64 {
        0.0
    }
}

/// A part that keeps nothing and prepares nothing: a text, and a loop with at most one number.
#[derive(Debug)]
pub(super) struct Plain {
    pub about: &'static About,
    pub stage: Stage,
    /// The loop over the rows of a chunk, with the time step [s] and the number.
    pub rows: fn(&mut Chunk, f64, f64),
    pub number: f64,
}

impl Part for Plain {
    fn about(&self) -> &'static About {
        self.about
    }

    fn stage(&self) -> Stage {
        self.stage
    }

    fn apply(&self, chunk: &mut Chunk, _at: usize, dt: f64) {
        (self.rows)(chunk, dt, self.number);
    }
}
