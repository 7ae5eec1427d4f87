//! A part: one ingredient of a contact law.

use super::chunk::Chunk;
use super::table::Pair;

/// Text of a part, with fixed sections; shown to users.
#[derive(Clone, Copy, Debug)]
pub struct About {
    /// Name in the scene file.
    pub name: &'static str,
    /// What it models.
    pub models: &'static str,
    /// The formula.
    pub formula: &'static str,
    /// Symbols with units.
    pub symbols: &'static str,
    /// Where it stops being right.
    pub limits: &'static str,
    /// Author, year, equation.
    pub reference: &'static str,
}

/// When a part acts within its law; parts are sorted by it, so a scene cannot misorder them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// Elastic normal force.
    Normal,
    /// Damping of the normal motion.
    Damping,
    /// Tangential force.
    Tangential,
    /// Rolling resistance.
    Rolling,
}

/// What a part wants from the engine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Needs {
    /// Contact history.
    pub history: bool,
    /// Relative spin.
    pub roll: bool,
}

/// One ingredient of a contact law.
pub trait Part: Send + Sync + std::fmt::Debug {
    /// Its text.
    fn about(&self) -> &'static About;

    /// When it acts.
    fn stage(&self) -> Stage;

    /// What it needs.
    fn needs(&self) -> Needs {
        Needs::default()
    }

    /// Writes the coefficient that this part reads for a pair of species; called once per pair, in the order of stages.
    fn prepare(&self, pair: &mut Pair);

    /// Acts on all rows; `dt` is the time step [s].
    fn apply(&self, chunk: &mut Chunk, dt: f64);
}
